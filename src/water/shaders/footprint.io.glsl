// Lays what a photon brings down over its footprint, a parallelogram in light space: every texel gets the exact area that
// it shares with it. Sums are integers, so their order does not matter.
//   layDown(centre, j, layer, amount, open, height);   centre: light-space x, z; j: columns, its edges in texels of
//   sums; amount: units; open: shares of it at its corners (-a -b, +a -b, -a +b, +a +b); height: world y of what it
//   lies on
// Sources: area coverage by edges as in scanline rasterisers [Catmull 1978].
// Headroom: `units` (caustic_maps.cpp) is such that all photons of the slot in one texel do not fill 32 bits.
#ifndef SHOAL_WATER_FOOTPRINT_IO_GLSL
#define SHOAL_WATER_FOOTPRINT_IO_GLSL

#include "water/light_space.io.glsl"

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
const float kLeastRun = 0.002;     // texels: edges run at least so far along x and z
// Texels (or cells) that a footprint is long, and wide, at most, or that many times what it is under level water: longer
// ones take too many turns, and wider ones are so faint that coarse cells do not show.
const float kLongest = 48.0, kWidest = 24.0, kLonger = 10.0, kWider = 6.0;

float awayFromZero(float x) { return x < 0.0 ? min(x, -kLeastRun) : max(x, kLeastRun); }

#ifdef CHOOSE_LAYERS
// Of the texel's surfaces the one that is nearest to `height`.
int layerOf(ivec2 texel, float height) {
    ivec2 at = ivec2((vec2(texel) + 0.5) * (lightSpace.counts.y / cell.w));
    float first = litHeight(at, slot, 0), second = litHeight(at, slot, 1);
    return abs(second - height) < abs(first - height) ? 1 : 0;
}
#endif

void layDown(vec2 centre, vec4 j, int layer, float amount, vec4 open, float height) {
    // Edges of the footprint, in texels or in the cells that it is not too large for; not thinner than what can be laid
    // down.
    float spread = max(abs(j.x) + abs(j.z), abs(j.y) + abs(j.w));
    float still = cell.x * cell.y, longest = max(kLongest, kLonger * still), widest = max(kWidest, kWider * still);
    float size = max(spread / longest, abs(j.x * j.w - j.y * j.z) / max(spread * widest, 1e-6));
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
    // Columns left of the square are gone through, so that each row begins with nothing on its left.
    lo.y = max(lo.y, -origin.y), hi = min(hi, vec2(side) - origin);
    int hidden = int(max(-origin.x - lo.x, 0.0));
    if (amount <= 0.0 || !(max(lo.x, -origin.x) < hi.x && lo.y < hi.y)) hi = lo;
    ivec2 first = ivec2(origin + lo), count = ivec2(hi - lo);

    // Edges along a from v0 and v3, along b from v0 and v1. In a row an edge from x0 to x1 has left of X the area
    // ((X - x0)+^2 - (X - x1)+^2) rise / (2 run), as a product: of its factors the difference is at most the edge's own
    // run in the row, of which a difference of large numbers would leave few digits.
    float det = a.x * b.y - a.y * b.x;
    det = det < 0.0 ? min(det, -1e-5) : max(det, 1e-5);
    float density = amount / abs(det), turn = sign(det) * density;
    vec4 startX = vec4(v0.x, v3.x, v0.x, v1.x), startY = vec4(v0.y, v3.y, v0.y, v1.y);
    vec4 runs = vec4(a.xx, b.xx), inverseRises = 1.0 / vec4(a.yy, b.yy);
    vec4 weights = 0.5 * turn * vec4(-a.y, a.y, b.y, -b.y) / abs(runs);
    vec4 t = clamp((lo.y - startY) * inverseRises, 0.0, 1.0), low = startX + t * runs;
    float laid = 0.0;
    uint used = uint(layer) + (level > 0 ? 2u : 0u);
    uint laidUnits = 0u;
#ifndef NO_AIR
    // Where a texel's middle lies between the footprint's corners.
    mat2 withinFootprint = mat2(b.y, -a.y, -b.x, a.x) / det;
#endif
    int row = (layer * int(side) + first.y) * int(side) + first.x;
    row += level == 0 ? 0 : level == 1 ? coarse.x : coarse.z;
    for (int y = 0; y < count.y; ++y) {
        float upperY = lo.y + float(y) + 1.0;
        vec4 next = clamp((upperY - startY) * inverseRises, 0.0, 1.0), high = startX + next * runs;
        vec4 run = abs((next - t) * runs), left = min(low, high), right = max(low, high);
        float before = 0.0;
        for (int x = 0; x < count.x; ++x) {
            float upperX = lo.x + float(x) + 1.0;
            vec4 l = max(vec4(upperX) - left, vec4(0.0)), r = max(vec4(upperX) - right, vec4(0.0));
            float area = dot(weights, min(l, run) * (l + r));
            // What is rounded off here is laid down in the next texel.
            float share = max(area - before, 0.0);
#ifndef NO_AIR
            vec2 within = clamp(withinFootprint * (vec2(upperX, upperY) - 0.5 - v0), vec2(0.0), vec2(1.0));
            vec2 between = mix(open.xz, open.yw, within.x);
            share *= mix(between.x, between.y, within.y);
#endif
            laid += share;
            before = area;
            uint units = uint(laid + 0.5);
            int word = row + x;
#ifdef CHOOSE_LAYERS
            int own = level == 0 ? layerOf(first + ivec2(x, y), height) : layer;
            word += (own - layer) * int(side) * int(side);
            if (units > laidUnits) used |= uint(own);
#endif
            if (units > laidUnits && x >= hidden) atomicAdd(deposits[word], units - laidUnits);
            laidUnits = units;
        }
        t = next, low = high;
        row += int(side);
    }
    if (laidUnits > 0u && used > 0u) atomicOr(deposits[coarse.x - 1], used);
}

#endif
