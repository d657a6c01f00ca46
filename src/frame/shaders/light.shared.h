// The light block (std140) and the local lights (std430): what shading knows of light.
// Filled in src/frame/light_block.cpp.
#ifndef SHOAL_FRAME_LIGHT_SHARED_H
#define SHOAL_FRAME_LIGHT_SHARED_H

// Values of LightBlock::background.w.
#define SHOAL_BACKGROUND_ENVIRONMENT 0
#define SHOAL_BACKGROUND_COLOR 1
#define SHOAL_BACKGROUND_TRANSPARENT 2

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::frame {
using vec4 = Vec4;
#define SHOAL_LIGHT_BLOCK_BEGIN struct LightBlock
#else
#include "frame/bindings.shared.h"
#define SHOAL_LIGHT_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_LIGHT) uniform LightBlock
#endif

SHOAL_LIGHT_BLOCK_BEGIN {
    // xyz: world, unit; w: 1 where there is a sun.
    vec4 toSun;
    // rgb: W/m2 facing the sun; w: what the disc adds to a lobe's alpha (half of its angular radius).
    vec4 sunIrradiance;
    // rgb: W/(m2 sr) of the disc behind everything, 0 where it is not drawn; w: 1 where the sun casts shadows.
    vec4 sunDisc;
    // Cosines of the angles from the sun's centre where the drawn disc is full (x) and gone (y).
    vec4 sunEdge;
    // Irradiance / pi of the environment for a normal (x, y, z), intensity included, is the polynomial
    // sum of c[i] * (1, y, z, x, xy, yz, z2, xz, x2 - y2) [Ramamoorthi & Hanrahan 2001].
    vec4 irradiance[9];
    // x: intensity, y: levels of the prefiltered map, z: its texels a side at level 0, w: turn of the sharp map, turns.
    vec4 environment;
    // rgb: W/(m2 sr) of a plain background; w: SHOAL_BACKGROUND_...
    vec4 background;
    // x: level of the prefiltered map for a blurred background, negative: sharp; y: mip level of the sharp map,
    // z: its texels a pixel.
    vec4 backgroundLevel;
    // x: 1 where there is screen-space occlusion, y: strength.
    vec4 occlusion;
    // World position of pixel p (gl_FragCoord.xy) at view depth z:
    // origin + p.x originX + p.y originY + z (ray + p.x rayX + p.y rayY).
    // Perspective eyes have one origin, orthographic eyes one ray.
    vec4 origin, originX, originY;
    vec4 ray, rayX, rayY;
    // The same for what lies at infinity (orthographic: as if seen from afar).
    vec4 backgroundRay, backgroundRayX, backgroundRayY;
    // x: local lights.
    vec4 lightCount;
    // rgb: 1/m, how a medium dims lamps; w: world y that it fills the world up to.
    vec4 medium;
}
#ifndef __cplusplus
lightBlock
#endif
    ;

struct LocalLight {
    vec4 position;   // xyz: world; w: range m, 0 infinite
    vec4 direction;  // xyz: where a spot shines; w: least distance m
    vec4 intensity;  // rgb: W/sr; w: index of its shadow, -1 none
    vec4 cone;       // x, y: scale and offset of the cosine (0, 1 for a point)
};

#ifdef __cplusplus
}  // namespace shoal::frame
#endif
#undef SHOAL_LIGHT_BLOCK_BEGIN

#endif
