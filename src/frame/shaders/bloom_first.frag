#version 450 core
// The picture at half size: where bloom starts. Variant: ACCUMULATED.
#include "frame/display_source.io.glsl"

layout(location = 0) uniform vec4 last;   // xy: largest pixel coordinates of the source
layout(location = 0) out vec4 outRadiance;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy) * 2;
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) sum += displaySource(min(at + ivec2(i & 1, i >> 1), ivec2(last.xy))).rgb;
    outRadiance = vec4(sum * 0.25, 1.0);
}
