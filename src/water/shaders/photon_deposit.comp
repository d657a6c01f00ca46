#version 450 core
// Traces the photons of one slot and lays each one's flux over its footprint, a parallelogram in light space: every
// texel gets the exact area that it shares with it. Sums are integers, so their order does not matter.
// Sources: [Igehy 1999]; [Frisvad et al. 2014]; area coverage by edges as in scanline rasterisers [Catmull 1978].
// Headroom: `units` (photons.cpp) is such that all photons of the slot in one texel do not fill 32 bits.
#include "water/photon.io.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

// Two layers of side x side texels; a word whose bits tell whether the second layer and whether coarse cells are used;
// two layers of cells of 8 x 8 texels, two of 64 x 64: footprints too large for texels are laid down there and spread
// over texels later (caustic_spread.comp). Cells begin at multiples of their size in the world.
layout(std430, binding = SHOAL_STORAGE_WATER) buffer Deposits { uint deposits[]; };

layout(location = 0) uniform int slot;
layout(location = 1) uniform vec4 lattice;   // first cell's x, z; cells along x, z
layout(location = 2) uniform vec4 cell;      // m; texels a metre; units that a photon of flux 1 brings; side in texels
// Of the square, texels from the world's 0; the most flux a photon brings, the most of it left over level water's.
layout(location = 3) uniform vec4 corner;
layout(location = 4) uniform ivec4 coarse;   // of cells of 8, of 64 texels: first word, cells a side

const float kThinnest = 0.06;      // texels: narrower footprints are made this wide
const float kLeastRun = 0.01;      // texels: edges run at least so far along x and z
// Texels (or cells) that a footprint is long, and wide, at most: longer ones take too many turns, and what is wide
// needs no finer cells (and rounding shows in its areas).
const float kLongest = 48.0, kWidest = 16.0;

float awayFromZero(float x) { return x < 0.0 ? min(x, -kLeastRun) : max(x, kLeastRun); }

// x where an edge from `start` along `edge` is at height y, clamped to its ends.
float edgeAt(vec2 start, vec2 edge, float inverseRise, float y) {
    return start.x + clamp((y - start.y) * inverseRise, 0.0, 1.0) * edge.x;
}

void main() {
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, ivec2(lattice.zw)))) return;
    Photon p = photonAt((lattice.xy + vec2(id) + 0.5) * cell.x, slot, cell.x);
    int layer;
    float travel = photonTravel(p, slot, layer);
    vec2 centre = photonPlace(p, slot, travel);
    vec4 inner = lightSpace.slots[slot].inner;
    bool wasted = all(greaterThan(centre, inner.xy)) && all(lessThan(centre, inner.zw));
    vec4 j = photonJacobian(p, slot, travel) * (cell.x * cell.y);
    float left = min(photonLeft(p, slot, max(travel, 0.0)), corner.w);
    float amount = travel >= 0.0 && !wasted ? min(p.flux, corner.z) * left * cell.z : 0.0;

    // Edges of the footprint, in texels or in the cells that it is not too large for; not thinner than what can be laid
    // down.
    float spread = max(abs(j.x) + abs(j.z), abs(j.y) + abs(j.w));
    float size = max(spread / kLongest, abs(j.x * j.w - j.y * j.z) / max(spread * kWidest, 1e-6));
    int level = int(size > 1.0) + int(size > 8.0);
    float shrink = level == 0 ? 1.0 : level == 1 ? 0.125 : 0.015625;
    float side = level == 0 ? cell.w : float(level == 1 ? coarse.y : coarse.w);
    vec2 a = j.xy * shrink, b = j.zw * shrink;
    bool aLonger = dot(a, a) > dot(b, b);
    vec2 longer = aLonger ? a : b;
    float lengthLonger = max(length(longer), 1e-6);
    vec2 across = vec2(-longer.y, longer.x) / lengthLonger;
    float width = dot(aLonger ? b : a, across);
    vec2 widen = across * ((width < 0.0 ? min(width, -kThinnest) : max(width, kThinnest)) - width);
    if (lengthLonger < kThinnest) a = vec2(kThinnest, 0.0), b = vec2(0.0, kThinnest);
    else if (aLonger) b += widen;
    else a += widen;
    a = vec2(awayFromZero(a.x), awayFromZero(a.y));
    b = vec2(awayFromZero(b.x), awayFromZero(b.y));

    // Relative to the texel of the centre, whose number counts from the world's 0: the same wherever the square is.
    vec2 texels = centre * (cell.y * shrink), home = floor(texels);
    vec2 v0 = texels - home - 0.5 * (a + b), v1 = v0 + a, v3 = v0 + b, v2 = v1 + b;
    vec2 lo = floor(min(min(v0, v1), min(v2, v3))), hi = ceil(max(max(v0, v1), max(v2, v3)));
    vec2 origin = home - floor(corner.xy * shrink);
    lo = max(lo, -origin), hi = min(hi, vec2(side) - origin);
    if (amount <= 0.0 || !(lo.x < hi.x && lo.y < hi.y)) hi = lo;
    ivec2 first = ivec2(origin + lo), count = ivec2(hi - lo);

    // Area left of X between two rows: the integral over y of (X - x)+ along the left edges less that along the right
    // ones, (X - x)+^2 rise / (2 run) between an edge's ends.
    float det = a.x * b.y - a.y * b.x;
    det = det < 0.0 ? min(det, -1e-5) : max(det, 1e-5);
    float density = amount / abs(det), turn = sign(det) * density;
    float alongA = -turn * abs(a.y) / (2.0 * a.x), alongB = turn * abs(b.y) / (2.0 * b.x);
    vec2 inverseRise = 1.0 / vec2(a.y, b.y);
    // Edges along a from v0 and v3, along b from v0 and v1; x at the row's lower and upper end.
    vec4 low = vec4(edgeAt(v0, a, inverseRise.x, lo.y), edgeAt(v3, a, inverseRise.x, lo.y),
                    edgeAt(v0, b, inverseRise.y, lo.y), edgeAt(v1, b, inverseRise.y, lo.y));
    vec4 along = vec4(alongA, -alongA, alongB, -alongB);
    float laid = 0.0;
    uint laidUnits = 0u;
#ifndef NO_AIR
    // Where a texel's middle lies between the footprint's corners.
    mat2 withinFootprint = mat2(b.y, -a.y, -b.x, a.x) / det;
#endif
    int row = (layer * int(side) + first.y) * int(side) + first.x;
    row += level == 0 ? 0 : level == 1 ? coarse.x : coarse.z;
    for (int y = 0; y < count.y; ++y) {
        float upperY = lo.y + float(y) + 1.0;
        vec4 high = vec4(edgeAt(v0, a, inverseRise.x, upperY), edgeAt(v3, a, inverseRise.x, upperY),
                         edgeAt(v0, b, inverseRise.y, upperY), edgeAt(v1, b, inverseRise.y, upperY));
        vec4 l = max(vec4(lo.x) - low, vec4(0.0)), h = max(vec4(lo.x) - high, vec4(0.0));
        float before = dot(along, (l - h) * (l + h));
        for (int x = 0; x < count.x; ++x) {
            float upperX = lo.x + float(x) + 1.0;
            l = max(vec4(upperX) - low, vec4(0.0)), h = max(vec4(upperX) - high, vec4(0.0));
            float area = dot(along, (l - h) * (l + h));
            // What is rounded off here is laid down in the next texel.
            float share = max(area - before, 0.0);
#ifndef NO_AIR
            vec2 within = clamp(withinFootprint * (vec2(upperX, upperY) - 0.5 - v0), vec2(0.0), vec2(1.0));
            vec2 between = mix(p.open.xz, p.open.yw, within.x);
            share *= mix(between.x, between.y, within.y);
#endif
            laid += share;
            before = area;
            uint units = uint(laid + 0.5);
            if (units > laidUnits) atomicAdd(deposits[row + x], units - laidUnits);
            laidUnits = units;
        }
        low = high;
        row += int(side);
    }
    uint used = uint(layer) + (level > 0 ? 2u : 0u);
    if (laidUnits > 0u && used > 0u) atomicOr(deposits[coarse.x - 1], used);
}
