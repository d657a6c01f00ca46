// Each pixel's straight way through the water to what it shows: WaterPaths as Surface::trace() leaves them. Needs the
// view's light block (Lighting::prepare), the water block and the three textures bound at the units named here.
#ifndef SHOAL_WATER_PATHS_IO_GLSL
#define SHOAL_WATER_PATHS_IO_GLSL

#include "frame/gbuffer.lib.glsl"
#include "frame/light.shared.h"
#include "water/optics.lib.glsl"
#include "water/water.shared.h"

layout(binding = SHOAL_UNIT_WATER_SURFACE) uniform sampler2D waterSurfaceDepth;    // WaterPaths::surfaceDepth
layout(binding = SHOAL_UNIT_WATER_NORMAL) uniform sampler2D waterSurfaceNormal;    // WaterPaths::surfaceNormal
layout(binding = SHOAL_UNIT_WATER_PATH) uniform sampler2D waterPathTexture;        // WaterPaths::path

const float kFarthestWater = 10000.0;   // metres: a path that meets nothing ends here

struct WaterPath {
    vec3 start;       // world: the end that is nearer to the eye
    vec3 direction;   // unit: away from the eye
    float lengthM;    // metres; 0: no water on this pixel's way
};

// A pixel's ray as long as nothing bends it: where it begins, and what it moves by for a metre of view depth.
struct PixelRay {
    vec3 origin;
    vec3 step;
};

PixelRay rayOfPixel(vec2 pixel) {
    PixelRay r;
    r.origin = lightBlock.origin.xyz + lightBlock.originX.xyz * pixel.x + lightBlock.originY.xyz * pixel.y;
    r.step = lightBlock.ray.xyz + lightBlock.rayX.xyz * pixel.x + lightBlock.rayY.xyz * pixel.y;
    return r;
}

// Where a ray is within the water's area and below `top`: (begin, end) in metres from `from`, end <= begin: nowhere.
// direction unit.
vec2 waterSpan(vec3 from, vec3 direction, float top) {
    // A direction along a side is moved off it by a thousandth of a millimetre a kilometre.
    vec3 d = mix(direction, vec3(1e-9), lessThan(abs(direction), vec3(1e-9)));
    vec2 atLeast = (waterBlock.area.xy - from.xz) / d.xz, atMost = (waterBlock.area.zw - from.xz) / d.xz;
    vec2 enter = min(atLeast, atMost), leave = max(atLeast, atMost);
    float level = (top - from.y) / d.y;
    float begin = max(max(enter.x, enter.y), d.y < 0.0 ? level : 0.0);
    float end = min(min(leave.x, leave.y), d.y < 0.0 ? kFarthestWater : level);
    return vec2(max(begin, 0.0), min(end, max(begin, 0.0) + kFarthestWater));
}

// pixel: gl_FragCoord.xy of the full-size picture; opaqueViewDepth: of that pixel, m along the view axis, 0: nothing.
WaterPath waterPathOf(vec2 pixel, float opaqueViewDepth) {
    ivec2 at = ivec2(pixel);
    float surface = texelFetch(waterSurfaceDepth, at, 0).x;
    vec4 traced = texelFetch(waterPathTexture, at, 0);
    PixelRay ray = rayOfPixel(pixel);
    float stepM = length(ray.step);

    WaterPath path;
    path.start = ray.origin;
    path.direction = ray.step / stepM;
    path.lengthM = traced.z;
    if (surface > 0.0) {   // in through the surface, bent
        vec3 normal = decodeNormal(texelFetch(waterSurfaceNormal, at, 0).xy);
        path.start = ray.origin + ray.step * surface;
        path.direction = refractedDirection(path.direction, normal, waterBlock.shape.y);
    } else {
        // Not bent: from the eye, or in through a side of the area (through the level where no surface is drawn).
        float begin = traced.w > 0.5 ? 0.0 : waterSpan(path.start, path.direction, waterBlock.shape.x).x;
        float opaque = opaqueViewDepth > 0.0 ? opaqueViewDepth * stepM : begin + kFarthestWater;
        path.start += path.direction * begin;
        path.lengthM = min(path.lengthM, max(opaque - begin, 0.0));
    }
    return path;
}

#endif
