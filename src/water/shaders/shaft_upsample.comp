#version 450 core
// Light scattered to the eye at full size: the mean source of the nearest small pixels, those before all whose paths are
// about as long, along the pixel's own path.
#include "water/shaft_sun.io.glsl"
#include "water/shaft_path.io.glsl"
#include "water/shaft.shared.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D sources;
layout(binding = 0, rgba16f) uniform writeonly image2D inscatterImage;

const float kTolerance = 0.2;    // of a path's length
const float kLeastWeight = 1e-4; // so that the nearest pixels count where no path is alike

void main() {
    // Two by two pixels lie between the same four small ones (or as good as).
    ivec2 block = 2 * ivec2(gl_GlobalInvocationID.xy), size = imageSize(inscatterImage);
    if (any(greaterThanEqual(block, size))) return;

    // A small pixel stands at the full pixel that was marched for it.
    float perFull = 1.0 / shaftBlock.march.y;
    vec2 shift = (0.5 - shaftBlock.small.x) * perFull - vec2(0.5);
    ivec2 last = textureSize(sources, 0) - 1;
    ivec2 low = clamp(ivec2(floor((vec2(block) + 0.5) * perFull + shift)), ivec2(0), max(last - 1, ivec2(0)));
    ivec2 high = min(low + 1, last);
    vec4 a = texelFetch(sources, low, 0), b = texelFetch(sources, ivec2(high.x, low.y), 0);
    vec4 c = texelFetch(sources, ivec2(low.x, high.y), 0), d = texelFetch(sources, high, 0);
    vec4 lengths = vec4(a.a, b.a, c.a, d.a);
    vec4 wet = mix(vec4(1e-6), vec4(1.0), greaterThan(lengths, vec4(0.0)));
    shift -= vec2(low);

    for (int n = 0; n < 4; ++n) {
        ivec2 at = block + ivec2(n & 1, n >> 1);
        if (any(greaterThanEqual(at, size))) continue;
        SeenPath path = seenPathOf(at);
        float seen = seenLength(path.lengthM);
        vec4 away = (lengths - seen) / (kTolerance * seen + 1e-3);
        vec4 alike = max(vec4(1.0) - away * away, vec4(kLeastWeight));
        // Beyond the outermost small pixels the line through them goes on, where they show one thing.
        vec2 f = vec2(at) * perFull + shift, inside = clamp(f, vec2(0.0), vec2(1.0));
        f = all(greaterThan(alike, vec4(0.5))) ? f : inside;
        vec2 g = 1.0 - f;
        vec4 weight = (vec4(g.x, f.x, g.x, f.x) * vec4(g.y, g.y, f.y, f.y) + 1e-3) * alike * wet;
        vec3 source = (a.rgb * weight.x + b.rgb * weight.y + c.rgb * weight.z + d.rgb * weight.w) /
                      (weight.x + weight.y + weight.z + weight.w);
        vec3 even = likeDecayOver(beamDecay(path.directionY), path.lengthM);
        imageStore(inscatterImage, at, vec4(max(source, vec3(0.0)) * even, 1.0));
    }
}
