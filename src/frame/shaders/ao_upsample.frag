#version 450 core
// Occlusion at full resolution: of the four nearest half-resolution values those count that lie at the pixel's depth.
// Drawn with fullscreen.vert and depth test LESS.
#include "frame/bindings.shared.h"

layout(binding = SHOAL_UNIT_PASS) uniform sampler2D openTexture;
layout(binding = SHOAL_UNIT_PASS + 4) uniform sampler2D viewDepthTexture;
layout(location = 0) uniform vec4 tolerance;   // x: as in ao_blur.frag, y: strength

layout(location = 0) out float outOpen;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(viewDepthTexture, at, 0).x;
    ivec2 low = at >> 1, last = textureSize(openTexture, 0) - 1;
    ivec2 high = min(low + (at & 1), last);
    // A half-resolution value stands at its even pixel: odd pixels lie in the middle between two.
    vec2 a = texelFetch(openTexture, low, 0).xy;
    vec2 b = texelFetch(openTexture, ivec2(high.x, low.y), 0).xy;
    vec2 c = texelFetch(openTexture, ivec2(low.x, high.y), 0).xy;
    vec2 d = texelFetch(openTexture, high, 0).xy;
    vec4 open = vec4(a.x, b.x, c.x, d.x);
    vec4 away = abs(vec4(a.y, b.y, c.y, d.y) - depth);
    vec4 near = 1.0 / (away + tolerance.x * depth + 1e-6);
    vec4 weight = near * near;
    float blended = dot(open, weight) / dot(weight, vec4(1.0));
    outOpen = clamp(1.0 - (1.0 - blended) * tolerance.y, 0.0, 1.0);
}
