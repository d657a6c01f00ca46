// The wave field as the GPU reads it (std140). Filled in gpu_waves.cpp.
#ifndef SHOAL_WATER_WAVES_SHARED_H
#define SHOAL_WATER_WAVES_SHARED_H

#define SHOAL_MAX_PLANE_WAVES 64
#define SHOAL_MAX_WAVE_TILES 4

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::water {
using vec4 = Vec4;
#define SHOAL_WAVE_BLOCK_BEGIN struct WaveBlock
#else
#include "water/bindings.shared.h"
#define SHOAL_WAVE_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_WAVES) uniform WaveBlock
#endif

// Numbers a metre come in two parts, the first of 12 bits: its product with a whole number of metres up to 4096 is
// exact, and so far from the origin nothing is lost by 32-bit arithmetic.
SHOAL_WAVE_BLOCK_BEGIN {
    vec4 counts;                         // x: plane waves, y: tiles, z: texels a side of a tile, w: mip levels
    vec4 bounds;                         // WaveBounds: height m, slope, shortest wavelength m
    vec4 circular;                       // amplitude m (0: none), k 1/m, phase in whole turns, k in turns a metre
    vec4 center;                         // x, z of the circular wave; unit of the planes' first parts, 1 / unit
    vec4 planes[SHOAL_MAX_PLANE_WAVES];  // amplitude m, waves a metre along x, z, phase in whole turns
    vec4 tiles[SHOAL_MAX_WAVE_TILES];    // texels a metre: first part, second part; metres a texel; period m
}
#ifndef __cplusplus
waveBlock
#endif
    ;

#ifdef __cplusplus
}  // namespace shoal::water
#endif
#undef SHOAL_WAVE_BLOCK_BEGIN

#endif
