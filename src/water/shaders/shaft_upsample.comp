#version 450 core
// Light scattered to the eye at full size: level water's beam in closed form times the marched ratio of the nearest
// pixels whose paths are about as long, and veiling light.
#include "water/shaft_sun.io.glsl"
#include "water/shaft_path.io.glsl"
#include "water/shaft.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D ratios;
layout(binding = 0, rgba16f) uniform writeonly image2D inscatterImage;

const float kTolerance = 0.1;    // of a path's length
const float kLeastWeight = 1e-4; // so that the nearest pixels count where no path is alike

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(inscatterImage);
    if (any(greaterThanEqual(at, size))) return;
    WaterPath path = shaftPathOf(at);
    float depth = waterBlock.shape.x - path.start.y;

    // Blurring moved everything half a small pixel on; a small pixel stands at the full pixel that was marched.
    vec2 place = (vec2(at) + 0.5 - shaftBlock.small.x) / shaftBlock.march.y - 1.0;
    vec2 corner = floor(place), f = place - corner;
    ivec2 last = textureSize(ratios, 0) - 1;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1);
        vec4 value = texelFetch(ratios, clamp(ivec2(corner) + side, ivec2(0), last), 0);
        vec2 share = mix(1.0 - f, f, vec2(side));
        float away = (value.a - path.lengthM) / (kTolerance * path.lengthM + 1e-3);
        float weight = (share.x * share.y + 1e-3) * (exp2(-away * away) + kLeastWeight) * (value.a > 0.0 ? 1.0 : 1e-6);
        sum += vec4(value.rgb, 1.0) * weight;
    }
    vec3 light = levelWaterBeam(depth, path.direction, path.lengthM) * (sum.rgb / sum.a);
    light += veilingLight(depth, path.direction, path.lengthM);
    imageStore(inscatterImage, at, vec4(light, 1.0));
}
