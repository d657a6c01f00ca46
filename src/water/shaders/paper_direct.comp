#version 450 core
// Brings caustics to full size (section 3, step 7): irradiance on what is under water, nothing above it.
#include "water/paper.shared.h"

layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D caustics;
layout(binding = 1) uniform sampler2D viewDepth;
layout(binding = 0, rgba16f) uniform writeonly image2D directImage;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(directImage);
    if (any(greaterThanEqual(pixel, size))) return;
    vec2 at = vec2(pixel) + 0.5;
    float depth = texelFetch(viewDepth, pixel, 0).x;
    vec3 place = paper.origin[0].xyz + at.x * paper.origin[1].xyz + at.y * paper.origin[2].xyz;
    place += depth * (paper.pixelRay[0].xyz + at.x * paper.pixelRay[1].xyz + at.y * paper.pixelRay[2].xyz);
    bool inArea = all(greaterThanEqual(place.xz, paper.area.xy)) && all(lessThanEqual(place.xz, paper.area.zw));
    bool under = depth > 0.0 && place.y < paper.water.x && inArea;
    vec4 light = vec4(textureLod(caustics, at / vec2(size), 0.0).rgb, 1.0);
    imageStore(directImage, pixel, under ? light : vec4(0.0));
}
