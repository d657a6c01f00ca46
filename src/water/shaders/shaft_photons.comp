#version 450 core
// A photon for each texel (or part of one) of a slot's square, followed down through the slices until it meets something.
// Its place, footprint and direction are exact at every depth (photon.io.glsl), so one tracing serves all slices.
// Variants: those of photon.io.glsl (NO_LAMPS: slots of the sun), FOURNIER_FORAND.
// Sources: [Igehy 1999]; [Hockney & Eastwood 1988] cloud in cell, for spreading a photon over four texels.
#define SHAFT_SLICES_WRITTEN
#include "water/shaft_slices.io.glsl"
#include "water/photon.io.glsl"
#include "water/shaft_sun.io.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(location = 0) uniform int i;      // slot of the block
layout(location = 1) uniform int slot;   // the same among LightViews::slots()
layout(location = 2) uniform ivec4 cells;   // the first that touches the water's area, the first beyond

const float kMostParts = 2.0;   // of a photon's footprint along an axis
// Times what level water lets through: no photon counts for more. All photons of a slot in one texel fill 32 bits.
const float kMostLight = 16.0;

// Spreads `amount` over the three texels around t whose middles make a triangle, in proportion to its barycentric
// coordinates. The last share is what is left, so that none is lost; `rounding` in [0, 1) decides which way the fraction
// of a unit goes, evenly over all photons.
void deposit(int layer, vec2 t, float amount, float rounding) {
    vec2 at = t + 0.5;   // the border's texel comes first
    vec2 low = floor(at), f = at - low;
    if (any(lessThan(low, vec2(0.0))) || any(greaterThan(low, vec2(shaftBlock.grid.x)))) return;
    bool right = f.x > f.y;
    uint all = uint(amount + rounding);
    uint far = min(uint(float(all) * min(f.x, f.y) + 0.5), all), beside = uint(float(all) * abs(f.x - f.y) + 0.5);
    beside = min(beside, all - far);
    ivec3 place = ivec3(low, layer);
    imageAtomicAdd(shaftSlices, place, all - far - beside);
    imageAtomicAdd(shaftSlices, place + (right ? ivec3(1, 0, 0) : ivec3(0, 1, 0)), beside);
    imageAtomicAdd(shaftSlices, place + ivec3(1, 1, 0), far);
}

// How much more (or less) of a photon's light turns to the eye than of light on the mean way: the march takes the mean
// one's phase.
float phaseRatio(vec3 position, vec3 direction, vec3 meanDirection) {
    vec3 toEye = shaftBlock.eye.xyz - position;
    toEye *= inversesqrt(max(dot(toEye, toEye), 1e-6));
    float ratio = shaftPhase(dot(direction, toEye)) / max(shaftPhase(dot(meanDirection, toEye)), 1e-12);
    return clamp(ratio, 0.2, 5.0);
}

// Metres of travel to what the photon meets, in few steps: where they do not agree (it passes an edge), the deeper one,
// so that a shadow begins a little late rather than light is lost.
float shaftTravel(Photon p) {
    const int kSteps = 3;
    const float kNothing = 1e6;
    int size = int(lightSpace.counts.y);
    vec4 rows = lightSpace.slots[slot].rows, place = lightSpace.slots[slot].place, height = lightSpace.slots[slot].height;
    float travel = 0.0, before = 0.0;
    for (int n = 0; n < kSteps; ++n) {
        vec2 here = photonPlace(p, slot, min(travel, lightSpace.slots[slot].reach.w));
        ivec2 texel = clamp(ivec2(floor((here - place.xy) * place.w)), ivec2(0), ivec2(size - 1));
        float depth = texelFetch(litDepth, ivec3(texel.x, int(rows.x) * texel.y + int(rows.y), 2 * slot), 0).x;
        before = travel;
        travel = depth > 0.0 ? max(p.start.y - heightOfDepth(depth, height), 0.0) : kNothing;
    }
    return max(travel, before);
}

void main() {
    int perTexel = int(shaftBlock.grid.z);
    ivec2 cell = cells.xy + ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(cell, cells.zw))) return;
    float fraction = 1.0 / float(perTexel), cellM = fraction / shaftBlock.slots[i].z;
    vec2 xz = shaftBlock.slots[i].xy + (vec2(cell) + 0.5) * cellM;

    Photon p = photonAt(xz, slot, cellM, true);
    float level = lightSpace.slots[slot].reach.z;
    // What is met at the very surface has no water before it.
    float deepest = level - p.start.y + shaftTravel(p);
    vec3 mean = waterBlock.sunRefracted.xyz;
#ifdef NO_LAMPS
    float levelFluence = waterBlock.toSun.y * waterBlock.sunRefracted.w / -mean.y;
#else
    float levelFluence = 1.0;
#endif
    float amount = p.flux * dot(p.open, vec4(0.25)) * p.perTravel / max(levelFluence, 1e-6);
    vec3 direction = vec3(p.drift.x, -1.0, p.drift.y) / p.perTravel;
    float units = shaftBlock.units.x * fraction * fraction;
    float rounding = fract(0.7548777 * float(cell.x & 4095) + 0.5698403 * float(cell.y & 4095));

    // A photon that ends between two slices reaches the lower one as well: light is looked up between slices, and only
    // above what it ends on.
    int slices = amount > 0.0 && deepest > 0.0 ? int(shaftBlock.grid.y) : 0;
    float above = -1.0;
    for (int k = 0; k < slices && above < deepest; ++k) {
        float depth = shaftDepth(k);
        above = depth;
        float travel = p.start.y - level + depth;
        vec2 t = shaftTexelOf(photonPlace(p, slot, travel), i);
        vec2 xzThere = p.start.xz + p.drift * travel;
        vec3 there = vec3(xzThere.x, level - depth, xzThere.y);
#ifndef NO_LAMPS
        mean = normalize(there - lightSpace.slots[slot].source.xyz);
#endif
        // What its way differs from the mean one by dims it; the march does the rest.
        float more = waterBlock.beamAttenuation.w * (travel * p.perTravel + depth / mean.y);
        float share = amount * exp(-more) * phaseRatio(there, direction, mean);
        share = min(share, kMostLight) * units;

        // Parts lie a texel and a third apart, where that takes few: what is spread wider is dim and shows few gaps.
        vec4 j = photonJacobian(p, slot, travel) * fraction, extent = abs(j);
        vec2 parts = clamp(ceil(max(extent.xz, extent.yw) - 0.35), vec2(1.0), vec2(kMostParts));
        vec2 apart = 1.0 / parts;
        float count = parts.x * parts.y;
        share *= apart.x * apart.y;
        int target = i * int(shaftBlock.grid.y) + k;
        for (float n = 0.5; n < count; n += 1.0) {
            float row = floor(n * apart.x);
            vec2 part = vec2(n - row * parts.x, row + 0.5) * apart - 0.5;
            deposit(target, t + j.xy * part.x + j.zw * part.y, share, rounding);
        }
    }
}
