// A line of foam where the water is shallow: patches that thin out with depth and ride on the waves.
#ifndef SHOAL_WATER_SURFACE_FOAM_GLSL
#define SHOAL_WATER_SURFACE_FOAM_GLSL

#include "frame/lighting.io.glsl"
#include "frame/view.shared.h"
#include "water/surface.shared.h"
#include "water/water.shared.h"

const float kFoamAlbedo = 0.75;
const float kFoamCell = 0.35;    // metres of the largest patches
const float kFoamDrift = 0.12;   // m/s

float foamHash(vec2 p) {
    vec3 q = fract(p.xyx * vec3(0.1031, 0.1030, 0.0973));
    q += dot(q, q.yzx + 33.33);
    return fract((q.x + q.y) * q.z);
}

// Value noise in [0, 1].
float foamNoise(vec2 p) {
    vec2 corner = floor(p), f = p - corner;
    f = f * f * (3.0 - 2.0 * f);
    vec2 low = vec2(foamHash(corner), foamHash(corner + vec2(1, 0)));
    vec2 high = vec2(foamHash(corner + vec2(0, 1)), foamHash(corner + vec2(1, 1)));
    vec2 row = mix(low, high, f.y);
    return mix(row.x, row.y, f.x);
}

// depthM: vertical metres of water under the surface point, lengthM: along the seen path.
vec3 withFoam(vec3 radiance, vec3 position, vec3 normal, float depthM, float lengthM) {
    float shallow = 1.0 - min(depthM, lengthM) / max(surfaceBlock.look.z, 1e-3);
    // Particles of a wave move to and fro by its slope: the pattern goes with them.
    vec2 at = (position.xz + 0.25 * normal.xz) / kFoamCell;
    float drift = timing.x * kFoamDrift / kFoamCell;
    float noise = 0.0, weight = 0.5;
    for (int i = 0; i < 4; ++i) {
        noise += weight * foamNoise(at + drift * vec2(1.0, 0.6) * (i % 2 == 0 ? 1.0 : -1.0));
        at = mat2(1.6, 1.2, -1.2, 1.6) * at;
        weight *= 0.5;
    }
    float cover = smoothstep(0.0, 0.25, shallow - noise * 1.05) * clamp(3.0 * shallow, 0.0, 1.0);
    vec3 sun = lightBlock.sunIrradiance.rgb * (lightBlock.toSun.w * max(dot(normal, lightBlock.toSun.xyz), 0.0));
    vec3 lit = (sun + waterBlock.skyIrradiance.rgb) * (kFoamAlbedo / 3.14159265);
    return mix(radiance, lit, 0.9 * cover);
}

#endif
