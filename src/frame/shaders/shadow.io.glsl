// Looks up the shadows of the sun and of spots: 1 lit, 0 in shadow.
#ifndef SHOAL_FRAME_SHADOW_IO_GLSL
#define SHOAL_FRAME_SHADOW_IO_GLSL

#include "frame/shadow.shared.h"
#include "frame/shadow.lib.glsl"

layout(binding = SHOAL_UNIT_SUN_SHADOW) uniform sampler2DArray sunShadowDepth;
layout(binding = SHOAL_UNIT_SUN_SHADOW_CMP) uniform sampler2DArrayShadow sunShadowTest;
layout(binding = SHOAL_UNIT_SPOT_SHADOW) uniform sampler2DArrayShadow spotShadowTest;

const float kTentRadius = 1.5;        // texels that the smallest filter reaches
const float kMiddleRadius = 4.0;      // texels up to which the lower counts below do
const float kLargestRadius = 10.0;    // texels that the largest filter reaches
const int kSearchCount = 6, kShortSearchCount = 4;     // gathers of four texels each
const int kTentCount = 4, kShortFilterCount = 9, kFilterCount = 16;    // bilinear comparisons

// llvmpipe runs both sides of an `if` and skips nothing but further rounds of a loop, so what can be spared is a loop
// whose length depends on the pixel.

// The next direction of discPoint: turned by the golden angle.
vec2 turned(vec2 d) { return vec2(-0.7373688 * d.x - 0.6754903 * d.y, 0.6754903 * d.x - 0.7373688 * d.y); }

// Tap i of the 3 x 3 tent by four bilinear comparisons: offset from the map's corner in texels (xy), weight (z, sum
// 16).
vec3 tentTap(int i, vec4 x, vec4 y) {
    bool right = (i & 1) != 0, up = (i & 2) != 0;
    return vec3(right ? x.y : x.x, up ? y.y : y.x, (right ? x.w : x.z) * (up ? y.w : y.z));
}

float tentVisibility(sampler2DArrayShadow map, vec2 uv, float layer, float depth, float texels, float texel) {
    vec2 position = uv * texels + 0.5;
    vec2 corner = floor(position);
    vec4 x = tentAxis(position.x - corner.x), y = tentAxis(position.y - corner.y);
    float sum = 0.0;
    for (int i = 0; i < kTentCount; ++i) {
        vec3 tap = tentTap(i, x, y);
        sum += tap.z * texture(map, vec4((corner - 0.5 + tap.xy) * texel, layer, depth));
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
    float radiusPerDepth = shadowBlock.sunShape.x * shadowBlock.sunShape.y / metresPerTexel;   // texels of penumbra

    // Below the map's range (a draft's map holds only a part of the scene) a receiver counts as at its end.
    // What blocks the disc of the sun, and how far away it is on average. A disc smaller than the tent need not be
    // searched.
    float widest = (1.0 - receiver.z) * radiusPerDepth;
    int searchCount = widest <= kTentRadius ? 0 : widest <= kMiddleRadius ? kShortSearchCount : kSearchCount;
    float searchRadius = min(widest, kLargestRadius) * texel;
    vec2 found = vec2(0.0);   // sum of depths, texels
    vec2 direction = vec2(1, 0);
    for (int i = 0; i < searchCount; ++i) {
        vec2 offset = direction * (searchRadius * sqrt(float(i) / float(searchCount)));
        vec4 depths = textureGather(sunShadowDepth, vec3(uv + offset, layer));
        vec4 blocks = vec4(greaterThan(depths, vec4(max(receiver.z + dot(slope, offset), 0.0))));
        found += vec2(dot(blocks, depths), dot(blocks, vec4(1.0)));
        direction = turned(direction);
    }
    bool searched = searchCount > 0;
    bool mixed = !searched || (found.y > 0.0 && found.y < 4.0 * float(searchCount));

    float radius = searched ? min((found.x / max(found.y, 1.0) - receiver.z) * radiusPerDepth, kLargestRadius) : 0.0;
    bool tent = radius <= kTentRadius;
    int tapCount = !mixed ? 0 : tent ? kTentCount : radius <= kMiddleRadius ? kShortFilterCount : kFilterCount;
    vec2 position = uv * texels + 0.5;
    vec2 corner = floor(position);
    vec4 x = tentAxis(position.x - corner.x), y = tentAxis(position.y - corner.y);
    direction = vec2(1, 0);
    vec2 sum = vec2(0.0);   // weighted, weights
    for (int i = 0; i < tapCount; ++i) {
        vec3 tap = tentTap(i, x, y);
        vec2 offset = tent ? (corner - 0.5 + tap.xy) * texel - uv
                           : direction * (radius * texel * sqrt((float(i) + 0.5) / float(tapCount)));
        float weight = tent ? tap.z : 1.0;
        sum += vec2(weight * texture(sunShadowTest, vec4(uv + offset, layer, max(receiver.z + dot(slope, offset), 0.0))), weight);
        direction = turned(direction);
    }
    return mixed ? sum.x / sum.y : found.y > 0.0 ? 0.0 : 1.0;
}

// Visible fraction of the sun's disc, 0 on surfaces that face away. worldNormal unit; viewDepth in metres chooses the
// cascade; pixel is not used: a pattern that followed the screen would crawl over moving surfaces.
float sunVisibility(vec3 worldPos, vec3 worldNormal, float viewDepth, vec2 pixel) {
    int count = int(shadowBlock.sunShape.w);
    // Ends of cascades that there are not lie far away.
    int cascade = int(dot(vec4(greaterThanEqual(vec4(viewDepth), shadowBlock.cascadeEnd)), vec4(1.0)));
    vec3 sunNormal = mat3(shadowBlock.sunFromWorld) * worldNormal;
    sunNormal.z *= shadowBlock.sunShape.x;   // the matrix measures depth in [0, 1]
    vec3 sunPosition = (shadowBlock.sunFromWorld * vec4(worldPos, 1.0)).xyz;

    int inMap = min(cascade, SHOAL_MAX_CASCADES - 1);
    float fadeStart = shadowBlock.cascadeFade[inMap];
    float fade = clamp((viewDepth - fadeStart) / (shadowBlock.cascadeEnd[inMap] - fadeStart), 0.0, 1.0);
    bool facing = count == 0 || sunNormal.z > 0.0;   // a sun without shadow has no axes here
    int end = !facing ? cascade : min(fade > 0.0 ? cascade + 2 : cascade + 1, count);
    float shadow = 0.0;   // beyond the last cascade is light
    for (int c = cascade; c < end; ++c)
        shadow += (c == cascade ? 1.0 - fade : fade) * (1.0 - cascadeVisibility(c, sunPosition, sunNormal));
    return facing ? 1.0 - shadow : 0.0;
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
    return tentVisibility(spotShadowTest, ndc.xy * 0.5 + 0.5, float(shadowIndex), ndc.z, 1.0 / texel, texel);
}

#endif
