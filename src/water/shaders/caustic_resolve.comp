#version 450 core
// Sums of photons to irradiance, both layers of one slot.
#include "water/bindings.shared.h"

layout(local_size_x = 16, local_size_y = 8) in;

layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer Deposits { uint deposits[]; };
layout(binding = 0, r32f) uniform writeonly image2DArray maps;
layout(location = 0) uniform ivec2 place;    // texels a side, first layer of the map
layout(location = 1) uniform float perUnit;  // irradiance of a unit

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, place.xx))) return;
    uint sum = deposits[(id.z * place.x + id.y) * place.x + id.x];
    imageStore(maps, ivec3(id.xy, place.y + id.z), vec4(float(sum) * perUnit));
}
