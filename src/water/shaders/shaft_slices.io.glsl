// The slices: how much light crosses light space at some depths below the level, as a multiple of what level water would
// let through there (its fluence: irradiance facing the light; the sun's slices), or in units of the slot's irradiance
// (lamps). Attenuation is left out. Sums of 32-bit fixed-point numbers, so that their order does not matter.
//   vec2 t = shaftTexelOf(s, i)      texels of slot i of the block, from light space
#ifndef SHOAL_WATER_SHAFT_SLICES_IO_GLSL
#define SHOAL_WATER_SHAFT_SLICES_IO_GLSL

#include "water/shaft.shared.h"

// Layer slices * slot + slice; a texel of border on each side, so that a footprint at the rim has where to go.
#ifdef SHAFT_SLICES_WRITTEN
layout(binding = 0, r32ui) uniform uimage2DArray shaftSlices;
#else
layout(binding = SHOAL_UNIT_SHAFT_SLICES) uniform usampler2DArray shaftSlices;
#endif

vec2 shaftTexelOf(vec2 s, int i) { return (s - shaftBlock.slots[i].xy) * shaftBlock.slots[i].z; }

float shaftDepth(int k) {
    return shaftBlock.depths.x * (uintBitsToFloat(uint(shaftBlock.depths.y * float(k)) + 0x3f800000u) - 1.0);
}
// Slice number, fractional, of a depth.
float shaftSlice(float depth) {
    float power = 1.0 + max(depth, 0.0) / shaftBlock.depths.x;
    return min(float(floatBitsToUint(power) - 0x3f800000u) * shaftBlock.depths.z, shaftBlock.grid.y - 1.0);
}

#endif
