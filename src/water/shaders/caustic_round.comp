#version 450 core
// Blurs sums of photons by the disc of their light, where that is about a texel wide and sums are finer than texels:
// every texel of what lies `travel` under the surface gets the mean over a disc (an ellipse under a low sun) whose size
// grows with travel. Its profile is (1 - u^2)^1.5, of the variance that the disc has and the texel itself: a disc's own
// hard edge would catch sums or miss them (P6: 2.0 % of error for it, 4.9 % for the hard one).
#include "water/light_space.io.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer Deposits { uint deposits[]; };
layout(location = 0) uniform ivec3 place;    // texels a side of the map; sums a side of its texel; slot
layout(location = 1) uniform float perUnit;  // irradiance of a unit
layout(binding = 0, rg32f) uniform writeonly image2DArray maps;

const float kMost = 8.0;   // sums: a stretched disc is cut off

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, place.xx))) return;
    int fine = place.y, slot = place.z, side = place.x * fine;
    vec4 disc = lightSpace.slots[slot].disc, mean = lightSpace.slots[slot].mean;
    float height = litHeight(id.xy, slot, id.z);
    float travel = height < kNothingLit ? max(mean.w * (height - lightSpace.slots[slot].reach.z), 0.0) : 0.0;
    float radius = lightSpace.slots[slot].irradiance.w * travel * lightSpace.slots[slot].place.w * float(fine);

    // Seven times the variance along x, z and both: the profile's bounds are the ellipse of that.
    float rounded = 1.75 * radius * radius, stretch = disc.z * disc.z - 1.0;
    float own = 7.0 / 12.0 * (float(fine * fine) - 1.0);
    vec2 along = rounded * (1.0 + stretch * disc.xy * disc.xy) + own;
    float both = rounded * stretch * disc.x * disc.y;
    vec3 form = vec3(along.y, along.x, -2.0 * both) / (along.x * along.y - both * both);

    vec2 centre = (vec2(id.xy) + 0.5) * float(fine), extent = min(sqrt(along), vec2(kMost));
    ivec2 first = ivec2(floor(centre - extent + 0.5)), last = ivec2(ceil(centre + extent - 0.5)) - 1;
    int layer = id.z * side * side;
    float sum = 0.0, weights = 0.0;
    for (int y = first.y; y <= last.y; ++y) {
        float dy = float(y) + 0.5 - centre.y, constant = 1.0 - form.y * dy * dy;
        int row = layer + clamp(y, 0, side - 1) * side;
        for (int x = first.x; x <= last.x; ++x) {
            float dx = float(x) + 0.5 - centre.x;
            float inside = max(constant - dx * (form.x * dx + form.z * dy), 0.0);
            float weight = inside * sqrt(inside);
            sum += weight * float(deposits[row + clamp(x, 0, side - 1)]);
            weights += weight;
        }
    }
    imageStore(maps, ivec3(id.xy, 2 * slot + id.z),
               vec4(perUnit * sum / max(weights, 1e-6), height < kNothingLit ? height : mean.w * 1e9, 0.0, 0.0));
}
