// Each pixel's path through the water: as the surface bent it (PATHS), or straight, where no surface is drawn.
#ifndef SHOAL_WATER_SHAFT_PATH_IO_GLSL
#define SHOAL_WATER_SHAFT_PATH_IO_GLSL

#include "frame/bindings.shared.h"
#include "water/paths.io.glsl"

layout(binding = SHOAL_UNIT_PASS) uniform sampler2D shaftViewDepth;   // full size

WaterPath shaftPathOf(ivec2 at) {
    float viewDepth = texelFetch(shaftViewDepth, at, 0).x;
    vec2 pixel = vec2(at) + 0.5;
#ifdef PATHS
    return waterPathOf(pixel, viewDepth);
#else
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

#endif
