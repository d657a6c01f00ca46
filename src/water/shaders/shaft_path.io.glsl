// Each pixel's path through the water: as the surface bent it (PATHS), or straight, where no surface is drawn.
#ifndef SHOAL_WATER_SHAFT_PATH_IO_GLSL
#define SHOAL_WATER_SHAFT_PATH_IO_GLSL

#include "frame/bindings.shared.h"
#include "water/paths.io.glsl"

layout(binding = SHOAL_UNIT_PASS) uniform sampler2D shaftViewDepth;   // full size

WaterPath shaftPathOf(ivec2 at) {
    vec2 pixel = vec2(at) + 0.5;
#ifdef PATHS
    return waterPathOf(pixel, 0.0);   // traced paths end at what is seen
#else
    float viewDepth = texelFetch(shaftViewDepth, at, 0).x;
    PixelRay ray = rayOfPixel(pixel);
    float stepM = length(ray.step);
    WaterPath path;
    path.direction = ray.step / stepM;
    vec2 span = waterSpan(ray.origin, path.direction, waterBlock.shape.x);
    float opaque = viewDepth > 0.0 ? viewDepth * stepM : kFarthestWater;
    path.start = ray.origin + path.direction * span.x;
    path.lengthM = max(min(span.y, opaque) - span.x, 0.0);
    return path;
#endif
}

// What a path's light falls off by, in few steps: the full picture asks for it at every pixel. Below waves a ray goes
// on here as below level water; marching divides by the same.
struct SeenPath {
    float lengthM;      // metres
    float directionY;   // of the unit direction away from the eye
};

SeenPath seenPathOf(ivec2 at) {
    SeenPath seen;
#ifdef PATHS
    vec4 traced = texelFetch(waterPathTexture, at, 0);
    vec3 ray = rayOfPixel(vec2(at) + 0.5).step;
    float y = ray.y * inversesqrt(dot(ray, ray)), index = waterBlock.shape.y;
    bool bent = traced.w < 0.0 || traced.x != 0.0 || traced.y != 0.0;
    seen.directionY = bent ? -sqrt(1.0 - (1.0 - y * y) / (index * index)) : y;
    seen.lengthM = traced.z;
#else
    WaterPath path = shaftPathOf(at);
    seen.directionY = path.direction.y;
    seen.lengthM = path.lengthM;
#endif
    return seen;
}

#endif
