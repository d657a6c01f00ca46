// Light of lamps in the water, scattered once to the eye. Lighting::bind() binds the lamps; with LAMP_SHADOWS
// Shadows::bind() the maps of spots that cast shadows.
// Sources: [Kulla & Fajardo 2012] Importance Sampling Techniques for Path Tracing in Participating Media (equiangular).
#ifndef SHOAL_WATER_SHAFT_LAMPS_IO_GLSL
#define SHOAL_WATER_SHAFT_LAMPS_IO_GLSL

#include "frame/brdf.lib.glsl"
#include "frame/lighting.io.glsl"
#ifdef LAMP_SHADOWS
#include "frame/shadow.io.glsl"
#endif
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

#endif
