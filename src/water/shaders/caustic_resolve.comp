#version 450 core
// Sums of photons to irradiance, both layers of one slot. Variant SHARP: into the map that a disc will blur; else into
// the map itself, with its mips.
#include "water/light_space.io.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer Deposits { uint deposits[]; };
layout(location = 0) uniform ivec4 place;    // texels a side, slot, mip levels (1 or 3)
layout(location = 1) uniform float perUnit;  // irradiance of a unit
#ifdef SHARP
layout(binding = 0, r32f) uniform writeonly image2DArray maps;

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, place.xx))) return;
    uint sum = deposits[(id.z * place.x + id.y) * place.x + id.x];
    imageStore(maps, id, vec4(float(sum) * perUnit));
}
#else
layout(binding = 0, rg32f) uniform writeonly image2DArray maps;

// A thread makes 4 x 4 texels, 2 x 2 of the next level and one of the last (laid out as by caustic_mips.comp).
void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    int side = place.x, layer = 2 * place.y + id.z;
    ivec2 first = 4 * id.xy;
    if (any(greaterThanEqual(first, ivec2(side)))) return;
    vec4 rows = lightSpace.slots[place.y].rows, heights = lightSpace.slots[place.y].height;
    float endless = lightSpace.slots[place.y].mean.w * 1e9;   // height of nothing: behind all
    float total = 0.0, middle = 0.0;
    for (int block = 0; block < 4; ++block) {
        ivec2 corner = first + 2 * ivec2(block & 1, block >> 1);
        float sum = 0.0, height = 0.0;
        for (int i = 0; i < 4; ++i) {
            ivec2 texel = corner + ivec2(i & 1, i >> 1);
            ivec2 inside = min(texel, ivec2(side - 1));
            float value = float(deposits[(id.z * side + inside.y) * side + inside.x]) * perUnit;
            float depth = texelFetch(litDepth, ivec3(texel.x, int(rows.x) * texel.y + int(rows.y), layer), 0).x;
            height = depth > 0.0 ? heightOfDepth(depth, heights) : endless;
            if (all(lessThan(texel, ivec2(side)))) imageStore(maps, ivec3(texel, layer), vec4(value, height, 0.0, 0.0));
            sum += value;
        }
        if (place.z > 1)
            imageStore(maps, ivec3(corner >> 1, layer) + ivec3(0, side, 0), vec4(0.25 * sum, height, 0.0, 0.0));
        total += sum;
        middle = block == 0 ? height : middle;
    }
    ivec3 shelf = ivec3(side >> 1, side, 0);
    if (place.z > 1) imageStore(maps, ivec3(first >> 2, layer) + shelf, vec4(total / 16.0, middle, 0.0, 0.0));
}
#endif
