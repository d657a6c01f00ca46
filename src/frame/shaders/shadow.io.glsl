// Looks up the shadows of the sun and of spots: 1 lit, 0 in shadow.
#ifndef SHOAL_FRAME_SHADOW_IO_GLSL
#define SHOAL_FRAME_SHADOW_IO_GLSL

#include "frame/shadow.shared.h"
#include "frame/shadow.lib.glsl"

layout(binding = SHOAL_UNIT_SUN_SHADOW) uniform sampler2DArray sunShadowDepth;
layout(binding = SHOAL_UNIT_SUN_SHADOW_CMP) uniform sampler2DArrayShadow sunShadowTest;
layout(binding = SHOAL_UNIT_SPOT_SHADOW) uniform sampler2DArrayShadow spotShadowTest;

const float kTentRadius = 1.5;        // texels that the smallest filter reaches
const float kLargestRadius = 10.0;    // texels that the largest filter reaches
const int kSearchCount = 6;           // gathers of four texels each
const int kFilterCount = 16;

// 3 x 3 tent by four bilinear comparisons. uv, slope (depth per uv), reference depth at uv.
float tentVisibility(sampler2DArrayShadow map, vec2 uv, float layer, float depth, vec2 slope, float texels, float texel) {
    vec2 position = uv * texels + 0.5;
    vec2 corner = floor(position);
    vec2 f = position - corner;
    vec4 x = tentAxis(f.x), y = tentAxis(f.y);
    vec2 base = (corner - 0.5) * texel;
    float sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        bool right = (i & 1) != 0, up = (i & 2) != 0;
        vec2 at = base + vec2(right ? x.y : x.x, up ? y.y : y.x) * texel;
        float weight = (right ? x.w : x.z) * (up ? y.w : y.z);
        sum += weight * texture(map, vec4(at, layer, depth + dot(slope, at - uv)));
    }
    return sum * (1.0 / 16.0);
}

float cascadeVisibility(int cascade, vec3 sunPosition, vec3 sunNormal) {
    vec4 place = shadowBlock.cascadePlace[cascade];
    float metresPerTexel = place.w, texels = shadowBlock.sunMap.x, texel = shadowBlock.sunMap.y;
    float depthPerMetre = 1.0 / shadowBlock.sunShape.x;
    float layer = float(cascade);

    // Off the surface by some texels: a bilinear comparison reaches into neighbours that lie nearer to the sun.
    vec3 receiver = sunPosition + sunNormal * vec3(1, 1, depthPerMetre) * (shadowBlock.sunShape.z * metresPerTexel);
    vec2 uv = receiver.xy * place.x + place.yz;
    vec2 slope = receiverSlope(sunNormal) * (depthPerMetre * metresPerTexel * texels);   // depth per uv

    float texelsPerMetre = 1.0 / metresPerTexel;
    float widest = (1.0 - receiver.z) * shadowBlock.sunShape.x * shadowBlock.sunShape.y * texelsPerMetre;
    if (widest <= kTentRadius) return tentVisibility(sunShadowTest, uv, layer, receiver.z, slope, texels, texel);

    // What blocks the disc of the sun, and how far away it is on average.
    float searchRadius = min(widest, kLargestRadius) * texel;
    float blockerSum = 0.0, blockerCount = 0.0;
    for (int i = 0; i < kSearchCount; ++i) {
        vec2 offset = discPoint(i, kSearchCount) * searchRadius;
        vec4 depths = textureGather(sunShadowDepth, vec3(uv + offset, layer));
        vec4 blocks = vec4(greaterThan(depths, vec4(receiver.z + dot(slope, offset))));
        blockerSum += dot(blocks, depths);
        blockerCount += dot(blocks, vec4(1.0));
    }
    if (blockerCount == 0.0) return 1.0;
    if (blockerCount == 4.0 * float(kSearchCount)) return 0.0;
    float distanceToBlocker = (blockerSum / blockerCount - receiver.z) * shadowBlock.sunShape.x;
    float radius = min(distanceToBlocker * shadowBlock.sunShape.y * texelsPerMetre, kLargestRadius);
    if (radius <= kTentRadius) return tentVisibility(sunShadowTest, uv, layer, receiver.z, slope, texels, texel);

    float sum = 0.0;
    for (int i = 0; i < kFilterCount; ++i) {
        vec2 offset = discPoint(i, kFilterCount) * (radius * texel);
        sum += texture(sunShadowTest, vec4(uv + offset, layer, receiver.z + dot(slope, offset)));
    }
    return sum / float(kFilterCount);
}

// Visible fraction of the sun's disc. worldNormal unit; viewDepth in metres chooses the cascade; pixel is not used: a pattern that
// followed the screen would crawl over moving surfaces.
float sunVisibility(vec3 worldPos, vec3 worldNormal, float viewDepth, vec2 pixel) {
    int count = int(shadowBlock.sunShape.w);
    if (count == 0 || viewDepth >= shadowBlock.cascadeEnd[count - 1]) return 1.0;
    int cascade = 0;
    while (cascade < count - 1 && viewDepth >= shadowBlock.cascadeEnd[cascade]) ++cascade;

    vec3 sunNormal = mat3(shadowBlock.sunFromWorld) * worldNormal;
    sunNormal.z *= shadowBlock.sunShape.x;   // the matrix measures depth in [0, 1]
    vec3 sunPosition = (shadowBlock.sunFromWorld * vec4(worldPos, 1.0)).xyz;
    float visibility = cascadeVisibility(cascade, sunPosition, sunNormal);
    float fadeStart = shadowBlock.cascadeFade[cascade];
    if (viewDepth > fadeStart) {
        float fade = (viewDepth - fadeStart) / (shadowBlock.cascadeEnd[cascade] - fadeStart);
        float next = cascade + 1 < count ? cascadeVisibility(cascade + 1, sunPosition, sunNormal) : 1.0;
        visibility = mix(visibility, next, fade);
    }
    return visibility;
}

// Visible fraction of a spot with a shadow; 1 for an index without one.
float spotVisibility(int shadowIndex, vec3 worldPos, vec3 worldNormal) {
    if (shadowIndex < 0 || shadowIndex >= int(shadowBlock.spotShape.x)) return 1.0;
    vec4 place = shadowBlock.spotPlace[shadowIndex];
    float metresPerTexel = place.w * distance(worldPos, place.xyz);
    vec3 receiver = worldPos + worldNormal * (metresPerTexel * shadowBlock.spotShape.z);
    vec4 clip = shadowBlock.spotFromWorld[shadowIndex] * vec4(receiver, 1.0);
    if (clip.w <= 0.0) return 1.0;
    vec3 ndc = clip.xyz / clip.w;
    float texel = shadowBlock.spotShape.y;
    return tentVisibility(spotShadowTest, ndc.xy * 0.5 + 0.5, float(shadowIndex), ndc.z, vec2(0.0), 1.0 / texel, texel);
}

#endif
