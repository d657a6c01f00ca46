#version 450 core
// One step down of the bloom pyramid: 13 bilinear fetches that do not let small bright things flicker [Jimenez 2014].
#include "frame/bindings.shared.h"

layout(binding = SHOAL_UNIT_PASS) uniform sampler2D finerTexture;   // linear filter
layout(location = 0) out vec4 outRadiance;

void main() {
    vec2 texel = 1.0 / vec2(textureSize(finerTexture, 0));
    vec2 uv = gl_FragCoord.xy * 2.0 * texel;
    vec3 inner = vec3(0.0), edges = vec3(0.0), corners = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 diagonal = vec2((i & 1) * 2 - 1, (i & 2) - 1) * texel;
        vec2 straight = (i < 2 ? vec2((i & 1) * 2 - 1, 0.0) : vec2(0.0, (i & 1) * 2 - 1)) * texel;
        inner += textureLod(finerTexture, uv + diagonal, 0.0).rgb;
        edges += textureLod(finerTexture, uv + straight * 2.0, 0.0).rgb;
        corners += textureLod(finerTexture, uv + diagonal * 2.0, 0.0).rgb;
    }
    vec3 centre = textureLod(finerTexture, uv, 0.0).rgb;
    outRadiance = vec4(centre * 0.125 + inner * 0.125 + edges * 0.0625 + corners * 0.03125, 1.0);
}
