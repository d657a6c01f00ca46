// A photon of the paper's method from the light to what it meets: through the water surface, refracted, met with the
// shadow map in image space.
// Sources: [Papadopoulos & Papaioannou 2010] section 3.3; [Shah & Konttinen 2007] for the intersection.
// PAPER_LAMP: rays leave a point. NEWTON_STEPS: of the intersection.
#ifndef SHOAL_WATER_PAPER_TRACE_IO_GLSL
#define SHOAL_WATER_PAPER_TRACE_IO_GLSL

#ifndef NEWTON_STEPS
#define NEWTON_STEPS 5
#endif

#include "water/optics.lib.glsl"
#include "water/paper.shared.h"
#include "water/waves.io.glsl"

layout(binding = 0) uniform sampler2D shadowMap;  // reversed depth, 0: nothing
layout(binding = 1) uniform sampler2D waterMask;  // 1: the light sees water

struct Photon {
    float light;     // share of its power that it carries; 0: it never enters the water
    vec3 surface;    // p_s, world
    vec3 direction;  // r_t, world, unit
    float reach;     // metres from p_s to what it meets
    bool meets;      // false: nothing in the light's view, `reach` leads out of it
};

ivec2 shadowTexel(vec2 screen) {
    float size = paper.water.z;
    return ivec2(clamp((screen * 0.5 + 0.5) * size, vec2(0.0), vec2(size - 1.0)));
}

#ifdef PAPER_LAMP
vec2 lightScreen(vec3 p) { return p.xy / -min(p.z, -1e-4) * paper.lightPlane.xy; }
vec3 rayOrigin(vec2 screen) { return paper.ray.xyz; }
vec3 rayDirection(vec2 screen) {
    return mat3(paper.worldFromLight) * normalize(vec3(screen / paper.lightPlane.xy, -1.0));
}
// What the light sees where p stands on its screen.
vec3 seen(vec3 p, float depth) { return p * (paper.lightDepth.x / max(depth, 1e-6) / p.z); }
// A cell of the screen covers less of the sphere away from the axis; a spot has a cone.
float lampShare(vec3 direction, vec2 screen) {
    float cosAxis = inversesqrt(1.0 + dot(screen / paper.lightPlane.xy, screen / paper.lightPlane.xy));
    float within = clamp((dot(direction, paper.lightAxis.xyz) - paper.lightDepth.z) * paper.lightDepth.w, 0.0, 1.0);
    return cosAxis * cosAxis * cosAxis * within * within;
}
#else
vec2 lightScreen(vec3 p) { return p.xy * paper.lightPlane.xy + paper.lightPlane.zw; }
vec3 rayOrigin(vec2 screen) {
    vec2 p = (screen - paper.lightPlane.zw) / paper.lightPlane.xy;
    return (paper.worldFromLight * vec4(p, 0.0, 1.0)).xyz;
}
vec3 rayDirection(vec2 screen) { return paper.ray.xyz; }
vec3 seen(vec3 p, float depth) { return vec3(p.xy, paper.lightDepth.x * depth + paper.lightDepth.y); }
float lampShare(vec3 direction, vec2 screen) { return 1.0; }
#endif

// Metres along `direction` from `start` to what the light sees there [Shah & Konttinen 2007]: the distance to the point
// on the shadow map below the last estimate is the next estimate. Light space is rigid, so lengths are metres in it.
float reachOf(vec3 start, vec3 direction, out bool meets) {
    float reach = 0.0;
    float depth = 0.0;
    for (int i = 0; i < NEWTON_STEPS; ++i) {
        vec3 estimate = start + reach * direction;
        depth = texelFetch(shadowMap, shadowTexel(lightScreen(estimate)), 0).x;
        reach = distance(start, seen(estimate, depth));
    }
    meets = depth > 0.0;
    return reach;
}

// screen: the photon's place on the light's screen, [-1, 1]^2.
Photon tracePhoton(vec2 screen) {
    Photon photon;
    vec3 direction = rayDirection(screen);
    photon.light = direction.y < -1e-3 ? lampShare(direction, screen) : 0.0;
    if (paper.water.w > 0.0) photon.light *= texelFetch(waterMask, shadowTexel(screen), 0).x;

    // Newton's method from the level plane: one step leaves (slope change over the step) x (step), millimetres.
    vec3 origin = rayOrigin(screen);
    float down = min(direction.y, -1e-3);
    photon.surface = origin + direction * ((paper.water.x - origin.y) / down);
    vec3 wave = waveSlopeAt(photon.surface.xz);
    float closing = min(direction.y - dot(wave.yz, direction.xz), -1e-3);
    photon.surface -= direction * ((photon.surface.y - paper.water.x - wave.x) / closing);
    wave = waveSlopeAt(photon.surface.xz);
    vec3 normal = normalize(vec3(-wave.y, 1.0, -wave.z));
    if (dot(normal, direction) >= 0.0) photon.light = 0.0;

    photon.direction = refractedDirection(direction, normal, paper.water.y);
    vec3 start = (paper.lightFromWorld * vec4(photon.surface, 1.0)).xyz;
    photon.reach = reachOf(start, mat3(paper.lightFromWorld) * photon.direction, photon.meets);
    return photon;
}

#endif
