#version 450 core
// Lists the tiles that caustic_lookup.comp flagged, and takes the flags back.
#include "water/bindings.shared.h"

layout(local_size_x = 64) in;

// Groups of two dispatches, then the tiles, x and y in 16 bits each: near the waterline from the start, behind
// something from the end.
layout(std430, binding = SHOAL_STORAGE_WATER) buffer Tiles { uint tileGroups[8]; uint tiles[]; };
layout(std430, binding = SHOAL_STORAGE_WATER + 1) buffer TileFlags { uint tileFlags[]; };
layout(location = 0) uniform ivec2 count;   // tiles along x and y

void main() {
    int id = int(gl_GlobalInvocationID.x);
    if (id >= count.x * count.y) return;
    uint shallow = tileFlags[2 * id], behind = tileFlags[2 * id + 1];
    uint tile = uint(id % count.x) | uint(id / count.x) << 16;
    if (shallow != 0u) tiles[atomicAdd(tileGroups[0], 1u)] = tile;
    if (shallow == 0u && behind != 0u) tiles[tiles.length() - 1 - int(atomicAdd(tileGroups[4], 1u))] = tile;
    tileFlags[2 * id] = 0u;
    tileFlags[2 * id + 1] = 0u;
}
