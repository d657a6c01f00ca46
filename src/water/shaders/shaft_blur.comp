#version 450 core
// The mean over three pixels in a row (AXIS 0) or column (1), the middle one twice. Neighbours count in pairs, as much as
// the one of them whose path is less alike: so nothing moves, at edges either.
#include "frame/bindings.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D marched;
layout(binding = 0, rgba32f) uniform writeonly image2D blurredImage;

#ifndef AXIS
#define AXIS 0
#endif
const float kTolerance = 0.25;   // of a path's length

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(blurredImage);
    if (any(greaterThanEqual(at, size))) return;
    ivec2 along = ivec2(1 - AXIS, AXIS);
    vec4 own = texelFetch(marched, at, 0);
    vec4 before = texelFetch(marched, max(at - along, ivec2(0)), 0);
    vec4 after = texelFetch(marched, min(at + along, size - 1), 0);
    bool inside = all(greaterThanEqual(at - along, ivec2(0))) && all(lessThan(at + along, size));
    float away = max(abs(before.a - own.a), abs(after.a - own.a)) / (kTolerance * own.a + 1e-3);
    float weight = inside ? max(1.0 - away * away, 0.0) : 0.0;
    vec3 mean = (2.0 * own.rgb + weight * (before.rgb + after.rgb)) / (2.0 + 2.0 * weight);
    imageStore(blurredImage, at, vec4(mean, own.a));
}
