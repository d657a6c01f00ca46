#version 450 core
// The light of the slices gathered along each path, at reduced size. What is kept is a mean source: radiance over what
// an even source of 1 would give on that path. It changes little where paths end at different distances, so that the
// full picture gets its edges from its own paths. Variants: PATHS, FOURNIER_FORAND, LAMPS (there are some),
// LAMP_SHADOWS (of some in the water).
#include "water/shaft_slices.io.glsl"
#include "water/shaft_sun.io.glsl"
#include "water/shaft_path.io.glsl"
#ifdef LAMPS
#include "water/shaft_lamps.io.glsl"
#endif

layout(local_size_x = 8, local_size_y = 8) in;
// rgb: mean source, W/(m3 sr); a: seen length of the path, 0: there is none
layout(binding = 0, rgba32f) uniform writeonly image2D sourceImage;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2DArray openCells;   // shaft_open.comp

const float kFarthest = 7.0;   // optical depths of the clearest channel that are marched: e^-7 is a thousandth
const int kStretches = 4;      // of equal steps, each stretch twice as long as the one before

// Points spread evenly over pixels' 4 x 4 blocks and steps: multiples of the plastic number's powers [Roberts 2018].
const vec3 kEven = vec3(0.8191725134, 0.6710436067, 0.5497004779);

// Place of a pixel among its 4 x 4 block: neighbours get far numbers.
float patternOf(ivec2 at) {
    ivec2 p = at & 3;
    ivec2 q = ivec2(p.x ^ p.y, p.y);
    return float(((q.x & 1) << 3) | ((q.y & 1) << 2) | (q.x & 2) | ((q.y & 2) >> 1));
}

// Along a path each slot's texels from its middle (xy) and how far inside the rim a place is (z) change evenly.
struct SlotLine {
    vec3 from, perM;
};

SlotLine slotLineOf(int j, vec2 s0, vec2 sPerM, float depth0, float depthPerM) {
    SlotLine line;
    vec4 rim = shaftBlock.rims[j];
    line.from = vec3(shaftTexelOf(s0, j) - 0.5 * shaftBlock.grid.x, rim.x - rim.y * depth0);
    line.perM = vec3(sPerM * shaftBlock.slots[j].z, -rim.y * depthPerM);
    return line;
}

// Share of the sun's beam that gets into the water above a place on the path, `t` metres along; 1 where no slot is.
float openAt(SlotLine lines[SHOAL_SUN_SHAFT_SLOTS], float t) {
    float side = shaftBlock.grid.x, open = 1.0;
    for (int j = SHOAL_SUN_SHAFT_SLOTS - 1; j >= 0; --j) {
        vec3 at = lines[j].from + lines[j].perM * t;
        // No cell that the rim cuts.
        float halfSide = 0.5 * side - side / float(SHOAL_SHAFT_OPEN_CELLS);
        bool inside = max(abs(at.x), abs(at.y)) < at.z && float(j) >= shaftBlock.small.y;
        vec2 place = clamp(at.xy, vec2(-halfSide), vec2(halfSide)) / side + 0.5;
        float found = textureLod(openCells, vec3(place, float(j)), 0.0).x;
        open = inside ? found : open;
    }
    return open;
}

void main() {
    ivec2 low = ivec2(gl_GlobalInvocationID.xy), size = imageSize(sourceImage);
    if (any(greaterThanEqual(low, size))) return;
    ivec2 last = textureSize(shaftViewDepth, 0) - 1;
    ivec2 at = min(ivec2((vec2(low) + 0.5) * shaftBlock.march.y), last);
    WaterPath path = shaftPathOf(at);
    SeenPath seen = seenPathOf(at);

    vec3 decay = beamDecay(path.direction.y);
    vec3 apart = mix(decay, vec3(2e-3), lessThan(abs(decay), vec3(2e-3)));   // weights are differences
    float least = min(apart.x, min(apart.y, apart.z));
    float reach = min(path.lengthM, least > 0.0 ? kFarthest / least : 1e30);

    // Along the path light space, depth and distance all change evenly.
    vec2 slide = waterBlock.sunRefracted.xz / -waterBlock.sunRefracted.y;
    float depth0 = waterBlock.shape.x - path.start.y;
    vec2 s0 = path.start.xz - slide * depth0, sPerM = path.direction.xz + slide * path.direction.y;

    int steps = path.lengthM > 0.0 && waterBlock.toSun.w > 0.0 ? int(shaftBlock.march.x) : 0;
    float pattern = patternOf(low);
    float stepM = reach / (float(steps) * float((1 << kStretches) - 1));
    float jitter = fract((pattern + 0.5) / 16.0 + shaftBlock.march.z), t = stepM * jitter;
    vec3 pass = exp(-apart * stepM), left = vec3(1.0), sum = vec3(0.0);
    SlotLine lines[SHOAL_SUN_SHAFT_SLOTS];
    for (int j = 0; j < SHOAL_SUN_SHAFT_SLOTS; ++j) lines[j] = slotLineOf(j, s0, sPerM, depth0, -path.direction.y);
    float slices = shaftBlock.grid.y, middle = 0.5 * shaftBlock.grid.x + 0.5, rim = shaftBlock.grid.x + 1.0;
    vec3 random = fract(0.5 + (pattern + shaftBlock.march.w) * kEven);
    float open = 0.0, weights = 0.0;
    for (int stretch = 0; stretch < kStretches; ++stretch) {
        vec3 taken = vec3(1.0) - pass;
        float before = left.y;
        open += openAt(lines, t + 0.5 * float(steps - 1) * stepM) * before, weights += before;
        for (int i = 0; i < steps; ++i) {
            // The finest slot that has all light of the place; where there is none, level water's.
            vec3 a = lines[0].from + lines[0].perM * t, b = lines[1].from + lines[1].perM * t;
            vec3 c = lines[2].from + lines[2].perM * t;
            bool inA = max(abs(a.x), abs(a.y)) < a.z, inB = max(abs(b.x), abs(b.y)) < b.z;
            bool inC = max(abs(c.x), abs(c.y)) < c.z;
            vec2 place = inA ? a.xy : inB ? b.xy : c.xy;
            float slot = inA ? 0.0 : inB ? slices : 2.0 * slices;
            // Texel and slice by chance, in proportion to what interpolation would give each: steps and neighbours
            // average it.
            float k = min(shaftSlice(depth0 - path.direction.y * t) + random.z, slices - 1.0);
            ivec2 texel = ivec2(clamp(place + middle + random.xy, vec2(0.0), vec2(rim)));
            float found = float(texelFetch(shaftSlices, ivec3(texel, int(slot) + int(k)), 0).x) * shaftBlock.units.y;
            sum += (left * taken) * (inA || inB || inC ? found : 1.0);
            left *= pass;
            t += stepM;
            random = fract(random + 16.0 * kEven);
        }
        t += stepM * jitter;   // the next stretch's jitter is twice this one's
        pass *= pass;
        stepM *= 2.0;
    }
    vec3 ratio = steps > 0 ? sum / (vec3(1.0) - left) : vec3(0.0);

    vec3 light = levelWaterBeam(depth0, path.direction) * min(ratio, vec3(1000.0)) * decayOver(decay, path.lengthM);
    light += veilingLight(depth0, path.direction, path.lengthM, weights > 0.0 ? open / weights : 1.0);
#ifdef LAMPS
    light += lampsInWater(path.start, path.direction, path.lengthM, jitter);
    light += lampsAbove(path.start, path.direction, path.lengthM, vec3(jitter, random.yz));
#endif
    vec3 even = likeDecayOver(beamDecay(seen.directionY), seen.lengthM);
    imageStore(sourceImage, low, vec4(light / max(even, vec3(1e-6)), seenLength(seen.lengthM)));
}
