#version 450 core
// Averages the 4 x 4 tile of noise at half resolution over pixels of the same surface. Reads and writes (open fraction,
// view depth).
#include "frame/bindings.shared.h"

layout(binding = SHOAL_UNIT_PASS) uniform sampler2D openTexture;
// x: depth difference, as a part of the depth, at which a neighbour counts no more
layout(location = 0) uniform vec4 tolerance;

layout(location = 0) out vec2 outOpen;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(openTexture, 0) - 1;
    vec2 own = texelFetch(openTexture, at, 0).xy;
    // Slopes of the surface in depth, from the smaller of the two differences on each axis: silhouettes do not tilt the
    // plane.
    float left = texelFetch(openTexture, max(at - ivec2(1, 0), ivec2(0)), 0).y;
    float right = texelFetch(openTexture, min(at + ivec2(1, 0), last), 0).y;
    float below = texelFetch(openTexture, max(at - ivec2(0, 1), ivec2(0)), 0).y;
    float above = texelFetch(openTexture, min(at + ivec2(0, 1), last), 0).y;
    float dx = abs(right - own.y) < abs(own.y - left) ? right - own.y : own.y - left;
    float dy = abs(above - own.y) < abs(own.y - below) ? above - own.y : own.y - below;
    float sharpness = 1.0 / (tolerance.x * max(own.y, 1e-4));

    float sum = 0.0, weights = 0.0;
    for (int y = -2; y < 2; ++y)
        for (int x = -2; x < 2; ++x) {
            vec2 other = texelFetch(openTexture, clamp(at + ivec2(x, y), ivec2(0), last), 0).xy;
            float expected = own.y + dx * float(x) + dy * float(y);
            float weight = max(1.0 - abs(other.y - expected) * sharpness, 0.0);
            sum += other.x * weight;
            weights += weight;
        }
    outOpen = vec2(weights > 0.0 ? sum / weights : own.x, own.y);
}
