#version 450 core
// Sums of photons to irradiance, both layers of one slot. Variant SHARP: into the map that a disc will blur.
#include "water/light_space.io.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer Deposits { uint deposits[]; };
#ifdef SHARP
layout(binding = 0, r32f) uniform writeonly image2DArray maps;
#else
layout(binding = 0, rg32f) uniform writeonly image2DArray maps;
#endif
layout(location = 0) uniform ivec2 place;    // texels a side, slot
layout(location = 1) uniform float perUnit;  // irradiance of a unit

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, place.xx))) return;
    uint sum = deposits[(id.z * place.x + id.y) * place.x + id.x];
#ifdef SHARP
    imageStore(maps, id, vec4(float(sum) * perUnit));
#else
    imageStore(maps, ivec3(id.xy, 2 * place.y + id.z),
               vec4(float(sum) * perUnit, litHeightOrFar(id.xy, place.y, id.z), 0.0, 0.0));
#endif
}
