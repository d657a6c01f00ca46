#version 450 core
// How far heights of what light meets are apart, and whether anything is above the water: of blocks of 4 x 4 texels of
// every slot first, then with WIDEN_X and WIDEN_Z of some blocks around each. Where there is nothing in the water counts
// as the far end.
#include "water/light_space.io.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Of blocks the least and the greatest depth (reversed) in the water, the greatest above it; the same of the blocks of a
// row that are taken with each.
layout(std430, binding = SHOAL_STORAGE_WATER + 1) buffer Blocks { vec4 blocks[]; };
#if defined(WIDEN_Z)
layout(std430, binding = SHOAL_STORAGE_WATER + 2) writeonly buffer Relief { vec2 relief[]; };
#endif
layout(location = 0) uniform int side;   // blocks
// Of slots: blocks to each side that are taken with one, in the water and above it (-1: as if something were everywhere).
layout(location = 1) uniform ivec2 widths[SHOAL_MAX_LIGHT_SLOTS];

#if defined(WIDEN_X) || defined(WIDEN_Z)
vec3 around(ivec2 block, ivec2 step, int first, ivec2 wide) {
    vec3 all = vec3(1.0, 0.0, 0.0);
    int most = max(wide.x, wide.y), at = block.x * step.x + block.y * step.y;
    for (int i = max(at - most, 0); i <= min(at + most, side - 1); ++i) {
        ivec2 there = block + step * (i - at);
        vec4 other = blocks[first + there.y * side + there.x];
        all.xy = abs(i - at) <= wide.x ? vec2(min(all.x, other.x), max(all.y, other.y)) : all.xy;
        all.z = abs(i - at) <= wide.y ? max(all.z, other.z) : all.z;
    }
    return all;
}
#endif

void main() {
    ivec2 block = ivec2(gl_GlobalInvocationID.xy);
    int slot = int(gl_GlobalInvocationID.z);
    if (any(greaterThanEqual(block, ivec2(side)))) return;
    int first = 2 * slot * side * side, second = first + side * side, word = block.y * side + block.x;
#if defined(WIDEN_X)
    blocks[second + word] = vec4(around(block, ivec2(1, 0), first, widths[slot]), 0.0);
#elif defined(WIDEN_Z)
    vec3 all = around(block, ivec2(0, 1), second, widths[slot]);
    vec4 height = lightSpace.slots[slot].height;
    float apart = abs(heightOfDepth(all.x, height) - heightOfDepth(all.y, height));
    relief[slot * side * side + word] = vec2(apart, widths[slot].y < 0 ? 1.0 : all.z);
#else
    // Four texels at a time, of rows that run either way.
    float size = lightSpace.counts.y;
    bool turned = lightSpace.slots[slot].rows.x < 0.0;
    vec3 all = vec3(1.0, 0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 corner = min(vec2(4 * block + 2 * ivec2(i & 1, i >> 1)) + 1.0, vec2(size - 1.0)) / size;
        vec4 lit = textureGather(litDepth, vec3(corner.x, turned ? 1.0 - corner.y : corner.y, float(2 * slot)));
        vec4 air = textureGather(airDepth, vec3(corner.x, 1.0 - corner.y, float(slot)));
        all.x = min(all.x, min(min(lit.x, lit.y), min(lit.z, lit.w)));
        all.y = max(all.y, max(max(lit.x, lit.y), max(lit.z, lit.w)));
        all.z = max(all.z, max(max(air.x, air.y), max(air.z, air.w)));
    }
    blocks[first + word] = vec4(all, 0.0);
#endif
}
