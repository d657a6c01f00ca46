#version 450 core
// The mean over four pixels in a row (AXIS 0) or column (1), of those alone whose paths are about as long. Both in turn
// take in each of the 16 patterns of the march once. The result lies half a pixel further along the axis.
#include "frame/bindings.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D marched;
layout(binding = 0, rgba16f) uniform writeonly image2D blurredImage;

#ifndef AXIS
#define AXIS 0
#endif
const float kTolerance = 0.15;   // of a path's length

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(blurredImage);
    if (any(greaterThanEqual(at, size))) return;
    ivec2 along = ivec2(1 - AXIS, AXIS);
    float own = texelFetch(marched, at, 0).a;
    vec4 sum = vec4(0.0);
    for (int i = -1; i <= 2; ++i) {
        ivec2 there = at + along * i;
        vec4 value = texelFetch(marched, clamp(there, ivec2(0), size - 1), 0);
        float away = (value.a - own) / (kTolerance * own + 1e-3);
        float weight = value.a > 0.0 ? exp2(-away * away) : 0.0;
        sum += vec4(value.rgb, 1.0) * weight;
    }
    vec3 mean = sum.a > 0.0 ? sum.rgb / sum.a : vec3(1.0);
    imageStore(blurredImage, at, vec4(mean, own));
}
