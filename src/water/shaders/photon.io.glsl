// One photon: a cell of the level plane, lit, followed through the surface of the water to what it meets. Light space
// makes its way short and nearly straight down, and its footprint comes with it: the 2x2 Jacobian of its place in light
// space by (x, z), exact at every height.
//   Photon p = photonAt(xz, slot, c, air);         of a cell of c x c metres; p.flux 0: no light there
//   float travel = photonTravel(p, slot, layer);   metres of height from the surface to what it meets; < 0: nothing
//   photonTravelFrom, photonPlaceFrom: the same of another ray of its cell
//   vec2 s = photonPlace(p, slot, travel);         light space at ANY travel in between (0: at the surface)
//   vec4 j = photonJacobian(p, slot, travel);      columns ds/dx (xy), ds/dz (zw)
//   float e = p.flux * photonLeft(p, slot, travel);   flux a m2 of level plane, in units of the slot's irradiance, over
//                                                  what the channel that is dimmed least keeps in level water
// A cell of c x c metres of the level plane then puts e c^2 onto the parallelogram with edges c j.xy, c j.zw around s.
// What a slot does not need is left out at compile time, for llvmpipe runs both sides of every if: NO_LAMPS (parallel
// light only), NO_WAVE_SHADOWS (light steeper than any slope), NO_AIR (no air layer).
// Sources: [Igehy 1999] Tracing Ray Differentials; [Frisvad et al. 2014] Photon Differential Splatting.
#ifndef SHOAL_WATER_PHOTON_IO_GLSL
#define SHOAL_WATER_PHOTON_IO_GLSL

#ifndef NO_LAMPS
#include "frame/brdf.lib.glsl"
#endif
#include "water/light_space.io.glsl"
#include "water/optics.lib.glsl"
#include "water/water.shared.h"
#include "water/waves.io.glsl"

struct Photon {
    vec3 start;             // world, on the surface
    vec2 drift;             // metres along x, z a metre of travel
    float perTravel;        // metres of path a metre of travel
    float dimming;          // 1/m of travel, by the water
    float flux;             // a m2 of level plane, behind the surface, in units of the slot's irradiance
    vec4 open;              // share of light that reaches the cell's corners (-x -z, +x -z, -x +z, +x +z) through the
                            // air, linear between them: neighbours agree where they meet. Not in the flux.
    vec4 jacobianStart;     // of the place at one height by (x, z): start + travel * perTravel, times the lamp's scale
    vec4 jacobianPerTravel;
};

// Irradiance facing the light in units of the slot's; direction: where light travels at p.
float arrivingLight(vec3 p, int slot, out vec3 direction) {
    vec4 toLight = lightSpace.slots[slot].toLight;
    direction = -toLight.xyz;
#ifndef NO_LAMPS
    if (toLight.w < 0.5) return 1.0;
    vec3 way = p - toLight.xyz;
    float away = max(length(way), 1e-4);
    direction = way / away;
    vec4 spot = lightSpace.slots[slot].spot, cone = lightSpace.slots[slot].cone;
    float nearest = max(away, cone.w);
    return cone.z * rangeWindow(away, spot.w) * spotCone(dot(spot.xyz, direction), cone.x, cone.y) /
           (nearest * nearest);
#else
    return 1.0;
#endif
}

#ifndef NO_WAVE_SHADOWS
// Crests shadow what lies behind them when the sun is lower than their slopes.
float waveVisibility(vec3 p, vec3 direction) {
    const int kSteps = 24;
    float highest = lightSpace.slots[0].reach.z + waveBlock.bounds.x;
    float rise = -direction.y / max(length(direction.xz), 1e-4);   // of the light's way back, a metre
    if (rise >= waveBlock.bounds.y) return 1.0;
    float reach = (highest - p.y) / max(rise, 1e-3);
    // No shorter than half of the shortest wave; so low a sun that this takes more steps gets longer ones.
    float first = max(reach / float(kSteps * kSteps), 0.1 * waveBlock.bounds.z);
    vec2 back = -normalize(direction.xz);
    float visible = 1.0, at = first;
    for (int i = 0; i < kSteps && at < reach && visible > 0.0; ++i) {
        float height = lightSpace.slots[0].reach.z + waveSlopeAt(p.xz + back * at).x;
        if (height > p.y + rise * at) visible = 0.0;
        at *= 1.25;
        at += first;
    }
    return visible;
}
#endif

// How `drift` changes when the slope changes by dg and the light's direction by dd (both along one axis).
vec2 driftChange(vec3 d, vec2 g, vec3 r, float slant, float cosIn, float cosOut, float side, vec2 dg, vec3 dd) {
    float inverse = 1.0 / slant, index = waterBlock.shape.y;
    float dSlant = dot(g, dg) * inverse;
    float dCos = (dot(dd.xz, g) + dot(d.xz, dg) - dd.y - cosIn * dSlant) * inverse;
    bool up = side > 0.0;
    float bend = up ? 2.0 * cosIn : cosIn / index - cosOut;
    float dBend = up ? 2.0 * dCos : -bend / (index * cosOut) * dCos;
    float along = bend * inverse, dAlong = (dBend - along * dSlant) * inverse;
    vec3 dr = (up ? dd : dd / index) + vec3(-dAlong * g.x - along * dg.x, dAlong, -dAlong * g.y - along * dg.y);
    return side * (dr.xz - r.xz * (dr.y / r.y)) / r.y;
}

// xz: middle of its cell of the level plane, cellM wide, metres.
// air: whether something above the water may be in its light's way.
Photon photonAt(vec2 xz, int slot, float cellM, bool air) {
    Photon p;
    Wave wave = waveAt(xz);
    p.start = vec3(xz.x, lightSpace.slots[slot].reach.z + wave.h, xz.y);
    vec3 d;
    float arriving = arrivingLight(p.start, slot, d);
    float index = waterBlock.shape.y, side = lightSpace.slots[slot].mean.w;
    float slant = sqrt(1.0 + dot(wave.slope, wave.slope));
    vec3 normal = vec3(-wave.slope.x, 1.0, -wave.slope.y) / slant;
    float cosIn = max(-dot(d, normal), 0.0);
    float cosOut = sqrt(1.0 - (1.0 - cosIn * cosIn) / (index * index));
    float through = fresnelTransmittance(cosIn, index);
    bool up = side > 0.0;
    vec3 r = up ? d + 2.0 * cosIn * normal : d / index + (cosIn / index - cosOut) * normal;
    // Light that a steep wave throws to the wrong side of the level meets the water again: left out.
    bool lit = cosIn > 0.0 && side * r.y > 0.02;
    r.y = side * max(side * r.y, 0.02);
    p.flux = lit ? arriving * cosIn * slant * (up ? 1.0 - through : through) : 0.0;
    p.perTravel = 1.0 / abs(r.y);
    p.drift = r.xz * p.perTravel;
    vec4 area = waterBlock.area;
    if (any(lessThan(xz, area.xy)) || any(greaterThan(xz, area.zw))) p.flux = 0.0;
    p.dimming = up ? 0.0 : waterBlock.beamAttenuation.w * p.perTravel;
#ifndef NO_WAVE_SHADOWS
    p.flux *= waveVisibility(p.start, d);
#endif
    p.open = vec4(1.0);
#ifndef NO_AIR
    int corners = air && lightSpace.slots[slot].flags.w > 0.0 ? 4 : 0;
    for (int i = 0; i < corners; ++i) {
        vec2 corner = (vec2(i & 1, i >> 1) - 0.5) * cellM;
        p.open[i] = airVisibility(p.start + vec3(corner.x, dot(wave.slope, corner), corner.y), slot);
    }
    if (p.open == vec4(0.0)) p.flux = 0.0;
#endif

    // The place at a height: start + drift * travel, where a slope also changes the travel to that height.
    p.jacobianStart = vec4(1.0, 0.0, 0.0, 1.0) -
                      side * vec4(p.drift * wave.slope.x, p.drift * wave.slope.y);
    vec3 ddx = vec3(0.0), ddz = vec3(0.0);
#ifndef NO_LAMPS
    vec4 toLight = lightSpace.slots[slot].toLight;
    if (toLight.w > 0.5) {
        float inverseAway = 1.0 / max(length(p.start - toLight.xyz), 1e-4);
        vec3 moveX = vec3(1.0, wave.slope.x, 0.0), moveZ = vec3(0.0, wave.slope.y, 1.0);
        ddx = (moveX - d * dot(d, moveX)) * inverseAway;
        ddz = (moveZ - d * dot(d, moveZ)) * inverseAway;
    }
#endif
    p.jacobianPerTravel.xy =
        driftChange(d, wave.slope, r, slant, cosIn, cosOut, side, wave.curvature.xy, ddx);
    p.jacobianPerTravel.zw =
        driftChange(d, wave.slope, r, slant, cosIn, cosOut, side, wave.curvature.yz, ddz);
    return p;
}

// World height at a travel.
float photonHeight(Photon p, int slot, float travel) { return p.start.y + lightSpace.slots[slot].mean.w * travel; }

// How much of it the water lets through, as a multiple of what level water does down to the same place: near 1 however
// murky the water is, so that sums of it keep their digits.
float photonLeft(Photon p, int slot, float travel) {
    vec2 xz = p.start.xz + p.drift * travel;
    vec3 there = vec3(xz.x, photonHeight(p, slot, travel), xz.y);
    return exp(waterBlock.beamAttenuation.w * levelPath(there, slot) - p.dimming * travel);
}

vec2 photonPlace(Photon p, int slot, float travel) {
    vec4 mean = lightSpace.slots[slot].mean;
#ifndef NO_LAMPS
    vec4 source = lightSpace.slots[slot].source;
    // World x, z, slid to the level from this height; written so that a level surface gives exactly its own x, z.
    if (source.w > 0.5) {
        float scale = lampScale(photonHeight(p, slot, travel), lightSpace.slots[slot].reach.z, source.y);
        return source.xz + (p.start.xz + p.drift * travel - source.xz) * scale;
    }
#endif
    float above = mean.w * (p.start.y - lightSpace.slots[slot].reach.z);
    return p.start.xz - mean.xy * above + (p.drift - mean.xy) * travel;
}

vec4 photonJacobian(Photon p, int slot, float travel) {
    vec4 j = p.jacobianStart + p.jacobianPerTravel * travel;
#ifndef NO_LAMPS
    vec4 source = lightSpace.slots[slot].source;
    if (source.w > 0.5) j *= lampScale(photonHeight(p, slot, travel), lightSpace.slots[slot].reach.z, source.y);
#endif
    return j;
}

// photonPlace of the ray that starts `from` (x, z, m) the photon's own, within its cell.
vec2 photonPlaceFrom(Photon p, vec2 from, int slot, float travel) {
    vec4 j = photonJacobian(p, slot, travel);
    return photonPlace(p, slot, travel) + j.xy * from.x + j.zw * from.y;
}

// Metres of travel from the surface to what the photon meets, layer of the depth maps that it lies in; -1: nothing.
// Light space keeps the way short: where the mean direction's depth is looked up at the photon's own place, few steps
// find the place whose depth is its own. Where they do not, the photon passes behind an edge: it meets what lies
// farthest from the light there.
float photonTravelFrom(Photon p, vec2 from, int slot, out int layer) {
    const float kSamePlace = 0.5;   // texels: nearer places look up one height
    // Counts that the compiler does not know: it would unroll the loops, and llvmpipe leaves only real ones early.
    int steps = int(lightSpace.counts.z), passes = int(lightSpace.counts.w);
    int size = int(lightSpace.counts.y);
    vec4 rows = lightSpace.slots[slot].rows;
    vec4 place = lightSpace.slots[slot].place, height = lightSpace.slots[slot].height;
    float side = lightSpace.slots[slot].mean.w, reach = lightSpace.slots[slot].reach.w;
    // Counted from the world's texel 0, so that a map that moved gives the same numbers.
    ivec2 corner = ivec2(floor(place.xy * place.w + 0.5));
    float travel = -1.0;
    layer = 0;
    bool found = false;
    for (int pass = 0; pass < passes && !found; ++pass) {
        travel = 0.0;
        vec2 here = photonPlaceFrom(p, from, slot, 0.0) * place.w;
        for (int i = 0; i < steps && !found; ++i) {
            // Beyond the rim goes on what is at the rim.
            ivec2 texel = clamp(ivec2(floor(here)) - corner, ivec2(0), ivec2(size - 1));
            texel.y = int(rows.x) * texel.y + int(rows.y);
            float depth = texelFetch(litDepth, ivec3(texel, 2 * slot), 0).x;
            layer = 0;
            if (pass == 1) {
                float behind = texelFetch(litDepth, ivec3(texel, 2 * slot + 1), 0).x;
                if (behind > 0.0) layer = 1, depth = behind;
            }
            float next = depth > 0.0 ? max(side * (heightOfDepth(depth, height) - p.start.y), 0.0) : reach;
            vec2 there = photonPlaceFrom(p, from, slot, next) * place.w;
            found = depth > 0.0 && dot(there - here, there - here) < kSamePlace * kSamePlace;
            travel = next;
            here = there;
        }
    }
    return found ? travel : -1.0;
}

float photonTravel(Photon p, int slot, out int layer) { return photonTravelFrom(p, vec2(0.0), slot, layer); }

#endif
