// What looking caustics up needs to know of a view (std140). Filled in src/water/photons/photons.cpp.
#ifndef SHOAL_WATER_CAUSTIC_SHARED_H
#define SHOAL_WATER_CAUSTIC_SHARED_H

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::water {
using vec4 = Vec4;
#define SHOAL_CAUSTIC_BLOCK_BEGIN struct CausticBlock
#else
#include "water/bindings.shared.h"
#define SHOAL_CAUSTIC_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_WATER_PASS) uniform CausticBlock
#endif

SHOAL_CAUSTIC_BLOCK_BEGIN {
    // World position of pixel p (middles at .5) at view depth z:
    // origin + p.x originX + p.y originY + z (ray + p.x rayX + p.y rayY).
    vec4 origin, originX, originY;
    vec4 ray, rayX, rayY;
    vec4 size;  // x, y: pixels; z: metres a pixel at view depth 1 (perspective), w: at any depth (orthographic)
    vec4 maps;  // x: mip levels of the maps, y: 1 where the sun has a slot, z: maps that a lookup blends at most
}
#ifndef __cplusplus
causticBlock
#endif
    ;

#ifdef __cplusplus
}  // namespace shoal::water
#endif
#undef SHOAL_CAUSTIC_BLOCK_BEGIN

#endif
