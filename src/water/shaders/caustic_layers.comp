#version 450 core
// How many layers of a slot the passes after the deposit work on: two only where a photon met the second; the first
// pass (caustic_spread.comp) none where all footprints were laid down in texels.
#include "water/bindings.shared.h"

layout(local_size_x = 1) in;

layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer Deposits { uint deposits[]; };
layout(std430, binding = SHOAL_STORAGE_WATER + 1) writeonly buffer Commands { uint groups[]; };
layout(std430, binding = SHOAL_STORAGE_WATER + 2) writeonly buffer Layers { uint secondUsed[]; };
// The word that tells whether the second layer and coarse cells are used; commands; slot.
layout(location = 0) uniform ivec3 place;

void main() {
    uint used = deposits[place.x];
    secondUsed[place.z] = used & 1u;
    uint layers = 1u + (used & 1u);
    for (int i = 0; i < place.y; ++i) groups[3 * i + 2] = i > 0 || used >= 2u ? layers : 0u;
}
