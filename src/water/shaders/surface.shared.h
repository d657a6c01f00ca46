// What the surface's own passes read (std140). Filled in src/water/surface/surface.cpp.
#ifndef SHOAL_WATER_SURFACE_SHARED_H
#define SHOAL_WATER_SURFACE_SHARED_H

#define SHOAL_GRID_CELLS 16      // cells a side of a block of the grid
#define SHOAL_GRID_FADE_FROM 40  // cells from the middle where a level begins to turn into the next, coarser one,
#define SHOAL_GRID_FADE_TO 48    // and where it has: no level ends nearer

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::water {
using vec4 = Vec4;
using mat4 = Mat4;
#define SHOAL_SURFACE_BLOCK_BEGIN struct SurfaceBlock
#else
#include "water/bindings.shared.h"
#define SHOAL_SURFACE_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_WATER_PASS) uniform SurfaceBlock
#endif

SHOAL_SURFACE_BLOCK_BEGIN {
    // Of the views: 0 shows what is above the water, mirrored or through the window, 1 what is under it, mirrored, 2
    // the same along bent rays.
    mat4 clipFromWorld[3];
    vec4 depthRow[3];    // dot with (p, 1): view depth of world point p there
    vec4 mirrorSize[3];  // x, y: pixels; z: 1 where there is such a view
    vec4 bentEye;        // xyz: eye of view 2, world
    vec4 grid;           // x: cell of the finest level m, y, z: x and z of the middle, w: 1 where inscatter is given
    vec4 look;           // x: variance of slope of what no wave shows, y: 1 for foam, z: depth where foam begins m
}
#ifndef __cplusplus
surfaceBlock
#endif
    ;

// A block of the grid: SHOAL_GRID_CELLS cells a side.
struct GridBlock {
    vec4 place;  // x, y: corner in cells from the world's origin; z: metres a cell; w: 1 in the outermost level
};

#ifdef __cplusplus
}  // namespace shoal::water
#endif
#undef SHOAL_SURFACE_BLOCK_BEGIN

#endif
