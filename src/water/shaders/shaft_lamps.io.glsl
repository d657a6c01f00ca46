// Light of lamps in the water and (from their slices) above it, scattered once to the eye. Lighting::bind() binds the lamps; with LAMP_SHADOWS
// Shadows::bind() the maps of spots that cast shadows.
// Sources: [Kulla & Fajardo 2012] Importance Sampling Techniques for Path Tracing in Participating Media (equiangular).
#ifndef SHOAL_WATER_SHAFT_LAMPS_IO_GLSL
#define SHOAL_WATER_SHAFT_LAMPS_IO_GLSL

#include "frame/brdf.lib.glsl"
#include "frame/lighting.io.glsl"
#ifdef LAMP_SHADOWS
#include "frame/shadow.io.glsl"
#endif
#include "water/light_space.lib.glsl"
#include "water/light_space.shared.h"
#include "water/shaft_slices.io.glsl"
#include "water/shaft_sun.io.glsl"

const int kLampSteps = 16;

// W/(m2 sr) along a path; jitter in [0, 1). Points lie at equal angles as the lamp sees them, so that 1 / d2 is even.
vec3 lampLight(LocalLight lamp, vec3 start, vec3 direction, float lengthM, float jitter) {
    float nearestT = dot(lamp.position.xyz - start, direction);
    float gap = max(distance(start + direction * nearestT, lamp.position.xyz), lamp.direction.w);
    float from = atan(-nearestT, gap), to = atan(lengthM - nearestT, gap), width = (to - from) / float(kLampSteps);
    vec3 beam = waterBlock.beamAttenuation.rgb, sum = vec3(0.0);
    for (int i = 0; i < kLampSteps; ++i) {
        float t = clamp(nearestT + gap * tan(from + (float(i) + jitter) * width), 0.0, lengthM);
        vec3 position = start + direction * t, away = position - lamp.position.xyz;
        float d = max(length(away), 1e-4);
        away /= d;
        float reach = rangeWindow(d, lamp.position.w) * spotCone(dot(lamp.direction.xyz, away), lamp.cone.x, lamp.cone.y);
#ifdef LAMP_SHADOWS
        if (lamp.intensity.w >= 0.0) reach *= spotVisibility(int(lamp.intensity.w), position, vec3(0.0));
#endif
        sum += exp(-beam * (d + t)) * (reach * shaftPhase(-dot(away, direction)));
    }
    return waterBlock.beamScattering.rgb * lamp.intensity.rgb * sum * (width / gap);
}

vec3 lampsInWater(vec3 start, vec3 direction, float lengthM, float jitter) {
    vec3 sum = vec3(0.0);
    int count = lengthM > 0.0 ? int(lightBlock.lightCount.x) : 0;
    for (int i = 0; i < count; ++i) {
        LocalLight lamp = localLights[i];
        if (lamp.position.y < waterBlock.shape.x) sum += lampLight(lamp, start, direction, lengthM, jitter);
    }
    return sum;
}

// The same of the lamp above the water that slices of slot i of the block were traced for. Seen from the water it stands
// at its apparent place.
vec3 lampAboveLight(int i, vec3 start, vec3 direction, float lengthM, vec3 random) {
    int slot = int(shaftBlock.slots[i].w);
    vec4 source = lightSpace.slots[slot].source, mean = lightSpace.slots[slot].mean;
    float level = waterBlock.shape.x, half_ = 0.5 * shaftBlock.grid.x;
    float nearestT = dot(source.xyz - start, direction);
    float gap = max(distance(start + direction * nearestT, source.xyz), 1e-2);
    float from = atan(-nearestT, gap), to = atan(lengthM - nearestT, gap), width = (to - from) / float(kLampSteps);
    vec3 beam = waterBlock.beamAttenuation.rgb, sum = vec3(0.0);
    for (int n = 0; n < kLampSteps; ++n) {
        float t = clamp(nearestT + gap * tan(from + (float(n) + random.x) * width), 0.0, lengthM);
        vec3 position = start + direction * t, way = position - source.xyz;
        float d = length(way), depth = level - position.y;
        vec2 at = shaftTexelOf(slideToLevel(position, level, source, mean), i) - half_;
        bool lit = max(abs(at.x), abs(at.y)) < half_ - 1.0;
        random = fract(random + vec3(0.8191725134, 0.6710436067, 0.5497004779));
        int k = int(min(shaftSlice(depth) + random.z, shaftBlock.grid.y - 1.0));
        ivec2 texel = ivec2(clamp(at + (half_ + 0.5) + random.xy, vec2(0.0), vec2(shaftBlock.grid.x + 1.0)));
        float value = float(texelFetch(shaftSlices, ivec3(texel, i * int(shaftBlock.grid.y) + k), 0).x);
        float spread = lampScale(position.y, level, source.y);
        float inWater = d * clamp(depth / max(source.y - position.y, 1e-3), 0.0, 1.0);
        float light = lit ? value * shaftBlock.units.y * spread * spread * d * d : 0.0;   // d2: of the even angles
        sum += exp(-beam * (inWater + t)) * (light * shaftPhase(-dot(way, direction) / d));
    }
    return waterBlock.beamScattering.rgb * lightSpace.slots[slot].irradiance.rgb * sum * (width / gap);
}

vec3 lampsAbove(vec3 start, vec3 direction, float lengthM, vec3 random) {
    vec3 sum = vec3(0.0);
    int end = lengthM > 0.0 ? SHOAL_SUN_SHAFT_SLOTS + int(shaftBlock.grid.w) : 0;
    for (int i = SHOAL_SUN_SHAFT_SLOTS; i < end; ++i) sum += lampAboveLight(i, start, direction, lengthM, random);
    return sum;
}

#endif
