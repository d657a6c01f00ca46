// The slots of LightViews as the GPU reads them (std140). Filled in src/water/photons/light_views.cpp.
#ifndef SHOAL_WATER_LIGHT_SPACE_SHARED_H
#define SHOAL_WATER_LIGHT_SPACE_SHARED_H

#define SHOAL_MAX_LIGHT_SLOTS 8

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::water {
using vec4 = Vec4;
#define SHOAL_LIGHT_SPACE_BLOCK_BEGIN struct LightSpaceBlock
#else
#include "water/bindings.shared.h"
#define SHOAL_LIGHT_SPACE_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_LIGHT_SPACE) uniform LightSpaceBlock
#endif

// "Travel" is metres of height below (reflected: above) where light left the surface.
struct LightSlotRecord {
    vec4 place;       // xy: light-space x, z of the corner of texel (0, 0), m; z: texel m; w: 1 / texel
    vec4 source;      // w 0: unit vector towards the apparent light; w 1: its apparent place (world)
    vec4 toLight;     // w 0: unit vector towards the light in the air; w 1: its true place (world)
    vec4 mean;        // xy: metres along x, z a metre of travel of the mean direction (0 for lamps); z: |y| of
                      // that unit direction (1 for lamps); w: -1 light goes down, 1 reflected, up
    vec4 height;      // world y of what a lit depth z shows: (x z + y) / (z z + w)
    vec4 airHeight;   // the same of the air layer
    vec4 reach;       // x: top, y: bottom (world y), z: level, w: greatest travel m
    vec4 flags;       // x: light (-1 sun), y: 1 reflected, z: cascade, w: 1 where the air layer is drawn
    vec4 rows;        // row of a depth texture for texel row j: x j + y; z: the first slot that is of another light or
                      // side; w: metres beyond the square that light which ends in it may start
    vec4 irradiance;  // rgb: W/m2 of map value 1 (sun: E_perp; lamp: right under it on the level); w: radius that the
                      // light's size blurs by, metres a metre of travel right below it
    vec4 disc;        // the mean direction's blur along its azimuth: xy: unit azimuth, z: stretch along it, w: across
    vec4 spot;        // lamps: where a spot shines; w: range m, 0 infinite
    vec4 cone;        // lamps: xy: scale and offset of a spot's cosine (0, 1: a point), z: 1 / unit irradiance per
                      // intensity (m2), w: least distance m
    vec4 inner;       // what finer slots of the group look up: least and greatest light-space x, z (empty: least >
                      // greatest)
};

SHOAL_LIGHT_SPACE_BLOCK_BEGIN {
    vec4 counts;  // x: slots, y: texels a side of a map, z, w: steps and passes of photonTravel
    LightSlotRecord slots[SHOAL_MAX_LIGHT_SLOTS];
}
#ifndef __cplusplus
lightSpace
#endif
    ;

#ifdef __cplusplus
}  // namespace shoal::water
#endif
#undef SHOAL_LIGHT_SPACE_BLOCK_BEGIN

#endif
