#version 450 core
// A photon for each texel (or part of one) of a slot's square, followed down through the slices until it meets something.
// Its place, footprint and direction are exact at every depth (photon.io.glsl), so one tracing serves all slices.
// Sources: [Igehy 1999]; [Hockney & Eastwood 1988] cloud in cell, for spreading a photon over four texels.
#define SHAFT_SLICES_WRITTEN
#include "water/shaft_slices.io.glsl"
#include "water/photon.io.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(location = 0) uniform int firstSlot;

const int kMostParts = 3;   // of a photon's footprint along an axis
// Times what level water lets through: no photon counts for more. All photons of a slot in one texel fill 32 bits.
const float kMostLight = 16.0;

// Spreads `amount` over the four texels around t. The last share is what is left, so that none is lost; `rounding` in
// [0, 1) decides which way the fraction of a unit goes, evenly over all photons.
void deposit(int layer, vec2 t, float amount, float rounding) {
    vec2 at = t + 0.5;   // the border's texel comes first
    vec2 low = floor(at), f = at - low;
    if (any(lessThan(low, vec2(0.0))) || any(greaterThan(low, vec2(shaftBlock.grid.x)))) return;
    uint all = uint(amount + rounding);
    uint upper = uint(float(all) * f.y + 0.5), lower = all - upper;
    uint upperRight = uint(float(upper) * f.x + 0.5), lowerRight = uint(float(lower) * f.x + 0.5);
    ivec3 place = ivec3(low, layer);
    imageAtomicAdd(shaftSlices, place, lower - lowerRight);
    imageAtomicAdd(shaftSlices, place + ivec3(1, 0, 0), lowerRight);
    imageAtomicAdd(shaftSlices, place + ivec3(0, 1, 0), upper - upperRight);
    imageAtomicAdd(shaftSlices, place + ivec3(1, 1, 0), upperRight);
}

float phase(float cosTheta) {
#ifdef FOURNIER_FORAND
    return waterPhase(cosTheta, waterBlock.phase);
#else
    return phaseHenyeyGreenstein(cosTheta, waterBlock.phase.y);
#endif
}

// How much more (or less) of a photon's light turns to the eye than of light on the mean way: the march takes the mean
// one's phase.
float phaseRatio(vec3 position, vec3 direction, vec3 meanDirection) {
    vec3 toEye = shaftBlock.eye.xyz - position;
    toEye *= inversesqrt(max(dot(toEye, toEye), 1e-6));
    float ratio = phase(dot(direction, toEye)) / max(phase(dot(meanDirection, toEye)), 1e-12);
    return clamp(ratio, 0.2, 5.0);
}

void main() {
    int perTexel = int(shaftBlock.grid.z), side = int(shaftBlock.grid.x) * perTexel;
    ivec2 cell = ivec2(gl_GlobalInvocationID.xy);
    int i = firstSlot + int(gl_GlobalInvocationID.z);
    if (any(greaterThanEqual(cell, ivec2(side)))) return;
    int slot = int(shaftBlock.slots[i].w);
    float fraction = 1.0 / float(perTexel);
    vec2 xz = shaftBlock.slots[i].xy + (vec2(cell) + 0.5) * (fraction / shaftBlock.slots[i].z);

    Photon p = photonAt(xz, slot);
    int layer;
    float hit = photonTravel(p, slot, layer);
    float level = lightSpace.slots[slot].reach.z;
    // What is met at the very surface has no water before it.
    float deepest = hit < 0.0 ? 1e30 : level - p.start.y + hit;
    vec3 mean = waterBlock.sunRefracted.xyz;
    float cosMean = -mean.y;
    float levelFluence = waterBlock.toSun.y * waterBlock.sunRefracted.w / cosMean;
    float amount = p.flux * p.perTravel / max(levelFluence, 1e-6);
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
        // What its way differs from the mean one by dims it; the march does the rest.
        float more = waterBlock.beamAttenuation.w * (travel * p.perTravel - depth / cosMean);
        vec2 place = p.start.xz + p.drift * travel;
        float share = amount * exp(-more) * phaseRatio(vec3(place.x, level - depth, place.y), direction, mean);
        share = min(share, kMostLight) * units;

        vec4 j = photonJacobian(p, slot, travel) * fraction;
        ivec2 parts = clamp(ivec2(ceil(vec2(length(j.xy), length(j.zw)) - 0.35)), ivec2(1), ivec2(kMostParts));
        int count = parts.x * parts.y;
        int target = i * int(shaftBlock.grid.y) + k;
        for (int n = 0; n < count; ++n) {
            vec2 part = (vec2(n % parts.x, n / parts.x) + 0.5) / vec2(parts) - 0.5;
            deposit(target, t + j.xy * part.x + j.zw * part.y, share / float(count), rounding);
        }
    }
}
