// The shadow block (std140): what looking up shadows needs to know. Filled in src/frame/shadows.cpp.
// Spots: the k-th light of the frame's list that is a spot with castsShadow has shadow index k.
#ifndef SHOAL_FRAME_SHADOW_SHARED_H
#define SHOAL_FRAME_SHADOW_SHARED_H

#define SHOAL_MAX_CASCADES 4
#define SHOAL_MAX_SPOT_SHADOWS 16

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::frame {
using mat4 = Mat4;
using vec4 = Vec4;
#define SHOAL_SHADOW_BLOCK_BEGIN struct ShadowBlock
#else
#include "frame/bindings.shared.h"
#define SHOAL_SHADOW_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_SHADOW) uniform ShadowBlock
#endif

SHOAL_SHADOW_BLOCK_BEGIN {
    // All cascades look along the sun and share their depth: lateral xy in metres, z in [0, 1], 1 nearest to the sun.
    mat4 sunFromWorld;
    vec4 cascadePlace[SHOAL_MAX_CASCADES];  // uv = sun.xy * x + yz; w: metres a texel
    vec4 cascadeEnd;                        // view depth in metres where each cascade ends; 1e30 for those not used
    vec4 cascadeFade;                       // view depth where it begins to turn into the next one
    vec4 sunShape;  // x: metres of depth from 0 to 1, y: penumbra half width per metre to the blocker,
                    // z: normal bias in texels, w: cascade count, 0 for a sun without shadow
    vec4 sunMap;    // x: texels a side, y: 1 / x
    mat4 spotFromWorld[SHOAL_MAX_SPOT_SHADOWS];  // clip, then uv = 0.5 xy / w + 0.5
    vec4 spotPlace[SHOAL_MAX_SPOT_SHADOWS];      // xyz position; w: metres a texel at one metre's distance
    vec4 spotShape;                              // x: count, y: 1 / texels a side, z: normal bias in texels
}
#ifndef __cplusplus
shadowBlock
#endif
    ;

#ifdef __cplusplus
}  // namespace shoal::frame
#endif
#undef SHOAL_SHADOW_BLOCK_BEGIN

#endif
