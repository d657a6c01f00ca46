// Photons that are parted (photon_split.comp), and what tells quickly that one cannot be.
#ifndef SHOAL_WATER_SPLIT_IO_GLSL
#define SHOAL_WATER_SPLIT_IO_GLSL

// Work groups of photon_split.comp, how many photons are listed, their cells of the lattice (x, z as halves of a word).
layout(std430, binding = SHOAL_STORAGE_WATER + 1) buffer Split { uint splitGroups[3]; uint splitCount; uint splitIds[]; };
// Of slots' blocks of 4 x 4 texels and what is around each (light_relief.comp): metres from the lowest to the highest of
// what light meets there; not 0 where there is something above the water.
layout(std430, binding = SHOAL_STORAGE_WATER + 2) readonly buffer Relief { vec2 relief[]; };

// place: light space, m.
vec2 reliefAt(vec2 place) {
    int blocks = (int(lightSpace.counts.y) + 3) / 4;
    ivec2 block = clamp(ivec2(floor(lightTexelOf(place, slot) / 4.0)), ivec2(0), ivec2(blocks - 1));
    return relief[(slot * blocks + block.y) * blocks + block.x];
}

const uint kMostGroups = 16384u;   // (65535 is what OpenGL promises)

// (A loop, not a branch: llvmpipe leaves loops early.)
void list(ivec2 id, bool split) {
    for (int i = 0; i < int(split); ++i) {
        uint place = atomicAdd(splitCount, 1u);
        splitIds[place] = uint(id.x) | uint(id.y) << 16;
        if ((place & 63u) == 0u && place < 64u * kMostGroups) atomicAdd(splitGroups[0], 1u);
    }
}

// What a photon brings to where it ends, in units of sums: nothing where it meets nothing, or where finer maps are
// looked up.
float unitsOf(Photon p, float travel, vec2 centre) {
    vec4 inner = lightSpace.slots[slot].inner;
    bool wasted = all(greaterThan(centre, inner.xy)) && all(lessThan(centre, inner.zw));
    float left = min(photonLeft(p, slot, max(travel, 0.0)), corner.w);
    return travel >= 0.0 && !wasted ? min(p.flux, corner.z) * left * cell.z : 0.0;
}

#endif
