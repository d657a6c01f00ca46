#version 450 core
// Sums of photons to irradiance, both layers of one slot.
#include "water/bindings.shared.h"

layout(local_size_x = 16, local_size_y = 8) in;

layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer Deposits { uint deposits[]; };
layout(binding = 0, r32f) uniform writeonly image2DArray maps;
layout(location = 0) uniform ivec4 place;    // texels a side of the map, deposit texels a side of its texel, first layer
layout(location = 1) uniform float perUnit;  // irradiance of a unit in a texel of the map

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, place.xx))) return;
    int fine = place.y, side = place.x * fine;
    uint sum = 0u;
    int start = (id.z * side + id.y * fine) * side + id.x * fine;
    for (int y = 0; y < fine; ++y)
        for (int x = 0; x < fine; ++x) sum += deposits[start + y * side + x];
    imageStore(maps, ivec3(id.xy, place.z + id.z), vec4(float(sum) * perUnit));
}
