#version 450 core
// Adds what was laid down in cells of 8 x 8 and of 64 x 64 texels to the sums of texels, bilinearly. Only where there
// is any (caustic_layers.comp).
#include "water/bindings.shared.h"

layout(local_size_x = 16, local_size_y = 8) in;

layout(std430, binding = SHOAL_STORAGE_WATER) buffer Deposits { uint deposits[]; };
layout(location = 0) uniform ivec3 place;    // texels a side; where its corner lies in the world's cells of 64 texels
layout(location = 4) uniform ivec4 coarse;   // of cells of 8, of 64 texels: first word, cells a side

// Mean of a texel.
float cellsAt(ivec3 id, int first, int cells, int size) {
    ivec2 inCell = place.yz & (size - 1);
    vec2 at = (vec2(id.xy + inCell) + 0.5) / float(size) - 0.5, low = floor(at), f = at - low;
    // Cells that lie in the square with all or a part of them.
    ivec2 last = (place.xx - 1 + inCell) / size;
    ivec2 a = clamp(ivec2(low), ivec2(0), last), b = clamp(ivec2(low) + 1, ivec2(0), last);
    int layer = first + id.z * cells * cells;
    vec4 sums = vec4(deposits[layer + a.y * cells + a.x], deposits[layer + a.y * cells + b.x],
                     deposits[layer + b.y * cells + a.x], deposits[layer + b.y * cells + b.x]);
    vec2 rows = mix(sums.xz, sums.yw, f.x);
    return mix(rows.x, rows.y, f.y) / float(size * size);
}

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, place.xx))) return;
    float sum = cellsAt(id, coarse.x, coarse.y, 8) + cellsAt(id, coarse.z, coarse.w, 64);
    deposits[(id.z * place.x + id.y) * place.x + id.x] += uint(sum + 0.5);
}
