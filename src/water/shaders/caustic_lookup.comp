#version 450 core
// Light on each pixel's surface that came through the water's surface or was thrown up by it, from the caustic maps;
// and the smooth light of sky and scattered sun under water. Variant NO_NORMALS: normals are taken from the depth.
// Sources: [Mobley 1994] Light and Water, for downwelling irradiance falling as exp(-Kd D).
#include "water/caustic.shared.h"
#include "frame/gbuffer.lib.glsl"
#include "water/light_space.io.glsl"
#include "water/water.shared.h"
#include "water/waves.io.glsl"

layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D viewDepthTexture;
#ifndef NO_NORMALS
layout(binding = 1) uniform sampler2D normalTexture;
#endif
layout(binding = SHOAL_UNIT_CAUSTIC_MAPS) uniform sampler2DArray causticMaps;
layout(binding = 0, rgba16f) uniform writeonly image2D directImage;
layout(binding = 1, rgba16f) uniform writeonly image2D ambientImage;
layout(location = 0) uniform bool ambientWanted;

const float kSkyTransmittance = 0.934;   // of light from all of the sky through level water
const float kFromBelow = 0.05;           // of downwelling light comes back from below
const float kRimTexels = 8.0;            // over which a slot's map turns into the next one
const float kGapM = 0.03;                // a surface and its own depth map differ by no more, apart from its slope

vec3 positionAt(vec2 pixel, float depth) {
    vec3 origin = causticBlock.origin.xyz + causticBlock.originX.xyz * pixel.x + causticBlock.originY.xyz * pixel.y;
    vec3 ray = causticBlock.ray.xyz + causticBlock.rayX.xyz * pixel.x + causticBlock.rayY.xyz * pixel.y;
    return origin + ray * depth;
}

vec3 normalAt(ivec2 pixel, vec3 position, float depth) {
#ifndef NO_NORMALS
    return decodeNormal(texelFetch(normalTexture, pixel, 0).xy);
#else
    // On each axis the neighbour of the nearer depth: the same surface.
    ivec2 limit = ivec2(causticBlock.size.xy) - 1;
    vec3 along[2];
    for (int axis = 0; axis < 2; ++axis) {
        ivec2 step = axis == 0 ? ivec2(1, 0) : ivec2(0, 1);
        ivec2 after = min(pixel + step, limit), before = max(pixel - step, ivec2(0));
        float a = texelFetch(viewDepthTexture, after, 0).x, b = texelFetch(viewDepthTexture, before, 0).x;
        bool useAfter = after != pixel && a > 0.0 && (before == pixel || b <= 0.0 || abs(a - depth) < abs(b - depth));
        vec3 other = useAfter ? positionAt(vec2(after) + 0.5, a) - position : position - positionAt(vec2(before) + 0.5, b);
        along[axis] = other;
    }
    vec3 n = cross(along[0], along[1]);
    vec3 toEye = -(causticBlock.ray.xyz + causticBlock.rayX.xyz * float(pixel.x) + causticBlock.rayY.xyz * float(pixel.y));
    n *= dot(n, toEye) < 0.0 ? -1.0 : 1.0;
    return dot(n, n) > 0.0 ? normalize(n) : vec3(0.0, 1.0, 0.0);
#endif
}

// Where light of the slot comes from at p, over the height of that way: the way along 1 m of travel, negative.
vec3 towardsLight(vec3 p, int slot) {
    vec4 source = lightSpace.slots[slot].source, mean = lightSpace.slots[slot].mean;
    if (source.w < 0.5) return vec3(-mean.x, -mean.w, -mean.y);
    vec3 way = source.xyz - p;
    return way / max(abs(way.y), 1e-3);
}

// The map's value for a surface at light-space place s: bilinear over what is seen of one height. slope: of the surface
// in light space. need: false skips it.
float mapValue(vec2 s, float height, float slope, float level, int slot, bool need) {
    int size = int(lightSpace.counts.y);
    vec4 rows = lightSpace.slots[slot].rows, heights = lightSpace.slots[slot].height, place = lightSpace.slots[slot].place;
    float side = lightSpace.slots[slot].mean.w;
    float tolerance = kGapM + 1.5 * place.z * slope;
    // A pixel that covers many texels looks at a coarser mip. Squares begin at whole texels of all mips.
    int mip = int(clamp(level, 0.0, causticBlock.maps.x - 1.0));
    vec2 at = s * (place.w * exp2(-float(mip))) - 0.5, low = floor(at), f = at - low;
    ivec2 corner = ivec2(low) - (ivec2(floor(place.xy * place.w + 0.5)) >> mip);
    float sum = 0.0;
    int taps = need ? 4 : 0;
    for (int i = 0; i < taps; ++i) {
        ivec2 bit = ivec2(i & 1, i >> 1);
        vec2 w = mix(1.0 - f, f, vec2(bit));
        ivec2 coarse = clamp(corner + bit, ivec2(0), ivec2((size >> mip) - 1));
        ivec2 texel = (coarse << mip) + ((1 << mip) >> 1);
        ivec3 row = ivec3(texel.x, int(rows.x) * texel.y + int(rows.y), 2 * slot);
        float first = texelFetch(litDepth, row, 0).x;
        float behind = side * (height - heightOfDepth(first, heights));
        int layer = 0;
        if (first > 0.0 && behind > tolerance) {
            float second = texelFetch(litDepth, row + ivec3(0, 0, 1), 0).x;
            layer = second > 0.0 && side * (height - heightOfDepth(second, heights)) > tolerance ? -1 : 1;
        }
        if (layer >= 0) sum += w.x * w.y * texelFetch(causticMaps, ivec3(coarse, 2 * slot + layer), mip).x;
    }
    return sum;
}

// 0 outside of a slot's square, 1 inside; a finer slot fades towards the rim.
float insideSlot(vec2 s, int slot, bool fades) {
    vec2 t = lightTexelOf(s, slot), rim = min(t, lightSpace.counts.y - t);
    float inwards = min(rim.x, rim.y);
    return fades ? clamp((inwards - 1.0) / kRimTexels, 0.0, 1.0) : step(0.0, inwards);
}

// Light of level water, for what lies outside of all maps.
vec3 levelWaterSun(vec3 p, vec3 normal) {
    float depth = max(waterBlock.shape.x - p.y, 0.0), cosine = -waterBlock.sunRefracted.y;
    float onLevel = waterBlock.toSun.y * waterBlock.sunRefracted.w;
    float facing = max(-dot(normal, waterBlock.sunRefracted.xyz), 0.0) / cosine;
    return waterBlock.sunIrradiance.rgb * (onLevel * facing) * exp(-waterBlock.beamAttenuation.rgb * (depth / cosine));
}

bool isUnderWater(vec3 p) {
    vec4 area = waterBlock.area;
    float above = p.y - waterBlock.shape.x, bound = waterBlock.shape.w;
    bool inArea = all(greaterThanEqual(p.xz, area.xy)) && all(lessThanEqual(p.xz, area.zw));
    float surface = 0.0;
    bool between = abs(above) <= bound && bound > 0.0;
    int steps = between ? 1 : 0;   // a loop, for llvmpipe leaves those early
    for (int i = 0; i < steps; ++i) surface = waveSlopeAt(p.xz).x;
    return inArea && above < surface;
}

// Smooth light from above under water, W/m2 on a level plane: the sky's, and the sun's that left the sharp beam.
vec3 smoothLight(float depth) {
    vec3 sky = waterBlock.skyIrradiance.rgb * kSkyTransmittance * exp(-waterBlock.diffuseAttenuation.rgb * depth);
    vec3 sun = waterBlock.sunIrradiance.rgb * (waterBlock.toSun.w * waterBlock.toSun.y * waterBlock.sunRefracted.w);
    vec3 all = exp(-waterBlock.sunDiffuseAttenuation.rgb * depth);
    vec3 beam = exp(waterBlock.beamAttenuation.rgb * (depth / waterBlock.sunRefracted.y));
    return sky + sun * max(all - beam, vec3(0.0));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, ivec2(causticBlock.size.xy)))) return;
    float viewDepth = texelFetch(viewDepthTexture, pixel, 0).x;
    bool there = viewDepth > 0.0;
    vec3 p = positionAt(vec2(pixel) + 0.5, max(viewDepth, 1e-3));
    vec3 normal = normalAt(pixel, p, viewDepth);
    bool under = there && isUnderWater(p);
    float pixelM = causticBlock.size.z * viewDepth + causticBlock.size.w;

    // Without a map of its own the sun lights the floor through level water.
    vec3 direct = under && causticBlock.maps.y == 0.0 ? levelWaterSun(p, normal) : vec3(0.0);
    int count = int(lightSpace.counts.x);
    float group = -1.0, left = 0.0;
    for (int slot = 0; slot < count; ++slot) {
        bool reflected = lightSpace.slots[slot].flags.y > 0.5;
        if (lightSpace.slots[slot].rows.z != group) {
            group = lightSpace.slots[slot].rows.z;
            left = there && reflected != under ? 1.0 : 0.0;
        }
        vec3 toLight = towardsLight(p, slot);
        float facing = dot(normal, toLight);
        vec2 s = lightSpaceOf(p, slot);
        bool last = slot + 1 == count || lightSpace.slots[min(slot + 1, count - 1)].rows.z != group;
        float share = facing > 0.0 ? min(left, insideSlot(s, slot, !last)) : 0.0;
        left -= share;
        float tilt = length(normal.xz) / max(facing, 0.05);
        float mip = log2(max(pixelM * lightSpace.slots[slot].place.w, 1.0) * 1.2);
        float value = mapValue(s, p.y, tilt, mip, slot, share > 0.0);
        float scale = 1.0;
        if (lightSpace.slots[slot].source.w > 0.5)
            scale = lampScale(p.y, lightSpace.slots[slot].reach.z, lightSpace.slots[slot].source.y);
        float metres = abs(p.y - waterBlock.shape.x) * length(toLight);
        vec3 dimming = waterBlock.beamAttenuation.rgb - waterBlock.beamAttenuation.w;
        vec3 through = reflected ? vec3(1.0) : exp(-dimming * metres);
        direct += lightSpace.slots[slot].irradiance.rgb * through * (value * share * facing * scale * scale);
        if (last && lightSpace.slots[slot].flags.x < 0.0 && !reflected && left > 0.0)
            direct += left * levelWaterSun(p, normal);
    }
    imageStore(directImage, pixel, vec4(direct, under ? 1.0 : 0.0));
    if (!ambientWanted) return;
    float upwards = 0.5 + 0.5 * normal.y;
    vec3 ambient = smoothLight(max(waterBlock.shape.x - p.y, 0.0)) * (0.318309886 * mix(kFromBelow, 1.0, upwards));
    imageStore(ambientImage, pixel, under ? vec4(ambient, 1.0) : vec4(0.0));
}
