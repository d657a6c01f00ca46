#version 450 core
// One step up of the bloom pyramid: a 3 x 3 tent, blended onto the finer level by the caller's constant alpha.
#include "frame/bindings.shared.h"

layout(binding = SHOAL_UNIT_PASS) uniform sampler2D coarserTexture;   // linear filter
layout(location = 0) out vec4 outRadiance;

void main() {
    vec2 texel = 1.0 / vec2(textureSize(coarserTexture, 0));
    vec2 uv = gl_FragCoord.xy * 0.5 * texel;
    vec3 sum = vec3(0.0);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            float weight = (x == 0 ? 2.0 : 1.0) * (y == 0 ? 2.0 : 1.0);
            sum += textureLod(coarserTexture, uv + vec2(x, y) * texel, 0.0).rgb * weight;
        }
    outRadiance = vec4(sum / 16.0, 1.0);
}
