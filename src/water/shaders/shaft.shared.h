// What the passes of the shafts know of their slices (std140). Filled in src/water/shafts/shaft_block.cpp.
#ifndef SHOAL_WATER_SHAFT_SHARED_H
#define SHOAL_WATER_SHAFT_SHARED_H

#define SHOAL_SUN_SHAFT_SLOTS 3  // slots of the sun that shafts are traced for: the finest
#define SHOAL_MAX_SHAFT_SLOTS 8
#define SHOAL_SHAFT_OPEN_CELLS 8  // a side, of shaft_open.comp; a divisor of a slice's texels a side

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::water {
using vec4 = Vec4;
#define SHOAL_SHAFT_BLOCK_BEGIN struct ShaftBlock
#else
#include "water/bindings.shared.h"
#define SHOAL_SHAFT_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_WATER_PASS) uniform ShaftBlock
#endif

SHOAL_SHAFT_BLOCK_BEGIN {
    vec4 grid;    // x: texels a side of a slice, without the border; y: slices of a slot; z: photons a texel's side;
                  // w: lamps above the water
    vec4 depths;  // slice k lies x (p(y k) - 1) m below the level, p(i): the float with the bits of 1, plus i (2 to the
                  // power of i / 2^23, straight lines between whole powers); z: 1 / y, w: depth of the last
    vec4 units;   // x: fixed-point units of the light that level water puts on a texel, y: 1 / x
    vec4 eye;     // xyz: where the eye seems to be from under water
    // The sun's (up to SHOAL_SUN_SHAFT_SLOTS), finest first; from there on lamps'.
    vec4 slots[SHOAL_MAX_SHAFT_SLOTS];  // xy: light space of the corner of texel (0, 0), z: 1 / texel, w: index among
                                        // LightViews::slots()
    vec4 rims[SHOAL_MAX_SHAFT_SLOTS];  // x: texels from the middle that all its light reaches, less y a metre of depth;
                                       // x is negative where there is no slot
    vec4 march;                        // x: steps, y: full pixels a small pixel's side, z, w: shift of the pattern
    vec4 small;  // x: full pixels from the middle of a small pixel to that of the one marched for it; y: the finest
                 // slot whose cells of shaft_open.comp are as wide as smooth light spreads
}
#ifndef __cplusplus
shaftBlock
#endif
    ;

#ifdef __cplusplus
}  // namespace shoal::water
#endif
#undef SHOAL_SHAFT_BLOCK_BEGIN

#endif
