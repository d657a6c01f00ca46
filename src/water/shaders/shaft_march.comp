#version 450 core
// The light of the slices gathered along each path, at reduced size. What is kept is the ratio to level water's, channel
// by channel: that one is known in closed form for every pixel of the full picture, edges included.
#include "water/shaft_slices.io.glsl"
#include "water/shaft_sun.io.glsl"
#include "water/shaft_path.io.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
// rgb: the sun's light over level water's; a: metres of path, 0: none
layout(binding = 0, rgba16f) uniform writeonly image2D ratioImage;

const float kFarthest = 7.0;     // optical depths of the clearest channel that are marched: e^-7 is a thousandth
const float kGrowth = 5.0;       // how much longer the last step is than the first

// Points spread evenly over pixels' 4 x 4 blocks and steps: multiples of the plastic number's powers [Roberts 2018].
vec3 evenPoint(float n) { return fract(0.5 + n * vec3(0.8191725134, 0.6710436067, 0.5497004779)); }

// Place of a pixel among its 4 x 4 block: neighbours get far numbers.
float patternOf(ivec2 at) {
    ivec2 p = at & 3;
    ivec2 q = ivec2(p.x ^ p.y, p.y);
    return float(((q.x & 1) << 3) | ((q.y & 1) << 2) | (q.x & 2) | ((q.y & 2) >> 1));
}

void main() {
    ivec2 low = ivec2(gl_GlobalInvocationID.xy), size = imageSize(ratioImage);
    if (any(greaterThanEqual(low, size))) return;
    ivec2 last = textureSize(shaftViewDepth, 0) - 1;
    WaterPath path = shaftPathOf(min(ivec2((vec2(low) + 0.5) * shaftBlock.march.y), last));

    float level = waterBlock.shape.x;
    vec3 decay = beamDecay(path.direction);
    decay = mix(decay, vec3(2e-3), lessThan(abs(decay), vec3(2e-3)));   // weights are differences: keep them apart
    float least = min(decay.x, min(decay.y, decay.z));
    float reach = min(path.lengthM, least > 0.0 ? kFarthest / least : 1e30);

    vec2 slide = waterBlock.sunRefracted.xz / -waterBlock.sunRefracted.y;
    float startDepth = level - path.start.y;
    vec2 s0 = path.start.xz - slide * startDepth, sStep = path.direction.xz + slide * path.direction.y;

    int slots = int(shaftBlock.grid.w), side = int(shaftBlock.grid.x) + 2;
    int steps = path.lengthM > 0.0 ? int(shaftBlock.march.x) : 0;
    float pattern = patternOf(low);
    float along = fract((pattern + 0.5) / 16.0 + shaftBlock.march.z);
    float growth = pow(kGrowth, 1.0 / shaftBlock.march.x), offset = 1.0 / (kGrowth - 1.0);
    float begin = 0.0;
    vec3 left = vec3(1.0), sum = vec3(0.0);
    for (int i = 0; i < steps; ++i) {
        float end = (begin + offset) * growth - offset;
        vec3 leftBehind = exp(-decay * (end * reach));
        float t = mix(begin, end, along) * reach;
        float depth = startDepth - path.direction.y * t;
        vec2 s = s0 + sStep * t;
        vec3 random = evenPoint(float(i) * 16.0 + pattern + shaftBlock.march.w);

        // A texel of the slice above or below, chosen by chance in proportion to what interpolation would give it.
        int k = int(shaftSlice(depth) + random.z);
        k = min(k, int(shaftBlock.grid.y) - 1);
        float light = 1.0;
        bool found = false;
        for (int j = 0; j < slots && !found; ++j) {
            vec2 at = shaftTexelOf(s, j);
            vec4 rim = shaftBlock.rims[j];
            float inset = rim.y * depth;
            found = all(greaterThan(at, vec2(rim.x + inset))) && all(lessThan(at, vec2(rim.z - inset)));
            ivec2 texel = ivec2(clamp(at + random.xy + 0.5, vec2(0.0), vec2(float(side - 1))));
            float value = float(shaftSlices[shaftSliceStart(j, k) + texel.y * side + texel.x]) * shaftBlock.units.y;
            light = found ? value : light;
        }
        sum += (left - leftBehind) * light;
        left = leftBehind;
        begin = end;
    }
    vec3 whole = vec3(1.0) - left;
    vec3 ratio = steps > 0 ? sum / whole : vec3(1.0);
    imageStore(ratioImage, low, vec4(min(ratio, vec3(1000.0)), path.lengthM));
}
