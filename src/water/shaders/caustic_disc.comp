#version 450 core
// Blurs a slot's sharp map by a wide disc of its light: every texel of what lies `travel` under the surface gets the
// mean over a disc (an ellipse under a low sun) whose size grows with travel, taken from the mip level where it is
// about a texel wide.
#include "water/light_space.io.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform sampler2DArray sharpMap;   // two layers
layout(binding = 0, rg32f) uniform writeonly image2DArray maps;
layout(location = 0) uniform ivec3 place;   // texels a side; slot; levels

const float kFewTexels = 0.75;  // radius from which the next coarser level is taken when it doubles
const float kMostTexels = 6.0;  // radius at the coarsest level: a stretched disc is cut off there
const float kLeastTexels = 0.5; // so that every line of a texel meets it

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, place.xx))) return;
    int slot = place.y;
    vec4 disc = lightSpace.slots[slot].disc, mean = lightSpace.slots[slot].mean;
    float height = litHeight(id.xy, slot, id.z);
    float travel = height < kNothingLit ? max(mean.w * (height - lightSpace.slots[slot].reach.z), 0.0) : 0.0;
    float across = lightSpace.slots[slot].irradiance.w * travel * lightSpace.slots[slot].place.w;

    int level = clamp(int(floor(log2(max(across, 1e-3) / kFewTexels))), 0, place.z - 1);
    float shrink = exp2(-float(level));
    across = max(across * shrink, kLeastTexels);
    float along = min(across * disc.z, kMostTexels);
    // The ellipse is qx x^2 + 2 qxy x y + qy y^2 <= 1: in the row at y it runs from shift y - half to shift y + half,
    // half^2 = flat - steep y^2.
    vec2 q = 1.0 / vec2(along * along, across * across);
    float qx = dot(disc.xy * disc.xy, q), qy = dot(disc.yx * disc.yx, q), qxy = disc.x * disc.y * (q.x - q.y);
    float shift = -qxy / qx, widest = 1.0 / qx, steep = q.x * q.y / (qx * qx);

    vec2 centre = (vec2(id.xy) + 0.5) * shrink;
    vec2 extent = vec2(sqrt(qy), sqrt(qx)) / sqrt(q.x * q.y) + 0.5;
    ivec2 first = ivec2(floor(centre - extent + 0.5)), last = ivec2(floor(centre + extent - 0.5));
    int side = place.x >> level;
    ivec2 shelf = level > 0 ? ivec2(place.x - 2 * side, place.x) : ivec2(0);   // caustic_mips.comp
    float sum = 0.0, weights = 0.0;
    for (int y = first.y; y <= last.y; ++y) {
        vec2 dy = vec2(float(y) + 0.5 - centre.y) + vec2(-0.25, 0.25);
        vec2 halfRun = sqrt(max(vec2(widest) - steep * dy * dy, vec2(0.0)));
        // No light in lines that the ellipse does not reach.
        vec2 most = min(2.0 * halfRun, vec2(1.0)) * step(vec2(1e-6), halfRun);
        vec2 middle = shift * dy - (0.5 - centre.x);
        int row = clamp(y, 0, side - 1);
        for (int x = first.x; x <= last.x; ++x) {
            vec2 w = clamp(halfRun - abs(vec2(float(x)) - middle) + 0.5, vec2(0.0), most);
            float weight = w.x + w.y;
            sum += weight * texelFetch(sharpMap, ivec3(shelf + ivec2(clamp(x, 0, side - 1), row), id.z), 0).x;
            weights += weight;
        }
    }
    imageStore(maps, ivec3(id.xy, 2 * slot + id.z),
               vec4(sum / max(weights, 1e-6), height < kNothingLit ? height : mean.w * 1e9, 0.0, 0.0));
}
