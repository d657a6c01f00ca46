// The slices: how much light crosses light space at some depths below the level, as a multiple of what level water would
// let through there (its fluence: irradiance facing the light; the sun's slices), or in units of the slot's irradiance
// (lamps). Attenuation is left out. Sums of 32-bit fixed-point numbers, so that their order does not matter.
//   vec2 t = shaftTexelOf(s, i)      texels of slot i of the block, from light space
#ifndef SHOAL_WATER_SHAFT_SLICES_IO_GLSL
#define SHOAL_WATER_SHAFT_SLICES_IO_GLSL

#include "water/shaft.shared.h"

#ifdef SHAFT_SLICES_WRITTEN
layout(std430, binding = SHOAL_STORAGE_WATER) buffer ShaftSlices { uint shaftSlices[]; };
#else
layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer ShaftSlices { uint shaftSlices[]; };
#endif

vec2 shaftTexelOf(vec2 s, int i) { return (s - shaftBlock.slots[i].xy) * shaftBlock.slots[i].z; }

// Of slice k of slot i; rows have a texel of border on either side, so that a footprint at the rim has where to go.
int shaftSliceStart(int i, int k) {
    int side = int(shaftBlock.grid.x) + 2;
    return (i * int(shaftBlock.grid.y) + k) * side * side;
}

float shaftDepth(int k) { return shaftBlock.depths.x * (exp2(shaftBlock.depths.y * float(k)) - 1.0); }
// Slice number, fractional, of a depth.
float shaftSlice(float depth) {
    float k = log2(1.0 + max(depth, 0.0) / shaftBlock.depths.x) * shaftBlock.depths.z;
    return min(k, shaftBlock.grid.y - 1.0);
}

#endif
