#version 450 core
// Blurs sums of photons by the disc of their light, some texels wide at most: rows into an image, then its columns
// (variant ALONG_Z) into the maps. A texel of what lies `travel` under the surface gets the mean over a disc (an
// ellipse under a low sun) whose size grows with travel. Its profile along an axis is taken as 1 - u^2, of the disc's
// variance.
#include "water/light_space.io.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(location = 0) uniform ivec2 place;   // texels a side; slot
#ifdef ALONG_Z
layout(binding = 0) uniform sampler2DArray rows;       // two layers
layout(binding = 0, rg32f) uniform writeonly image2DArray maps;
#else
layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer Deposits { uint deposits[]; };
layout(location = 1) uniform float perUnit;  // irradiance of a unit
layout(binding = 0, r32f) uniform writeonly image2DArray rows;
#endif

const float kLeast = 0.25, kMost = 8.0;   // half a profile's width, sums: within one; a stretched disc is cut off

// Of the profile, what lies below `at` half widths.
float profileBelow(float at) {
    float u = clamp(at, -1.0, 1.0);
    return u * (0.75 - 0.25 * u * u);
}

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    int side = place.x, slot = place.y;
    if (any(greaterThanEqual(id.xy, place.xx))) return;
#ifdef ALONG_Z
    int along = id.y;
#else
    int along = id.x;
#endif
    vec4 disc = lightSpace.slots[slot].disc, mean = lightSpace.slots[slot].mean;
    float height = litHeight(id.xy, slot, id.z);
    float travel = height < kNothingLit ? max(mean.w * (height - lightSpace.slots[slot].reach.z), 0.0) : 0.0;
    float radius = lightSpace.slots[slot].irradiance.w * travel * lightSpace.slots[slot].place.w;
    // The ellipse's semi-axes, seen along this axis.
#ifdef ALONG_Z
    vec2 share = disc.yx;
#else
    vec2 share = disc.xy;
#endif
    share *= vec2(disc.z, 1.0) * radius;
    float reach = clamp(sqrt(1.25 * dot(share, share)), kLeast, kMost);

    float centre = float(along) + 0.5, inverse = 1.0 / reach;
    int first = int(floor(centre - reach)), last = int(ceil(centre + reach)) - 1;
    float below = -0.5, sum = 0.0;
    for (int k = first; k <= last; ++k) {
        float upTo = profileBelow((float(k) + 1.0 - centre) * inverse);
        int at = clamp(k, 0, side - 1);
#ifdef ALONG_Z
        sum += (upTo - below) * texelFetch(rows, ivec3(id.x, at, id.z), 0).x;
#else
        sum += (upTo - below) * float(deposits[(id.z * side + id.y) * side + at]);
#endif
        below = upTo;
    }
#ifdef ALONG_Z
    imageStore(maps, ivec3(id.xy, 2 * slot + id.z),
               vec4(sum, height < kNothingLit ? height : mean.w * 1e9, 0.0, 0.0));
#else
    imageStore(rows, id, vec4(sum * perUnit));
#endif
}
