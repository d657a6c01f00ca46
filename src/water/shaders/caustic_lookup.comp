#version 450 core
// Light on each pixel's surface that came through the water's surface or was thrown up by it, from the caustic maps;
// and the smooth light of sky and scattered sun under water. Variants: NO_NORMALS, normals are taken from the depth;
// NO_WATERLINE, all surfaces are deeper than any wave; NO_LAMPS, the sun alone.
// llvmpipe runs every branch and every loop at least once: hence few loops, which most pixels leave after one turn.
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

// Where light of the slot comes from at p: that way along 1 m of height.
vec3 towardsLight(vec3 p, int slot) {
    vec4 mean = lightSpace.slots[slot].mean;
#ifndef NO_LAMPS
    vec4 source = lightSpace.slots[slot].source;
    vec3 way = source.xyz - p;
    if (source.w > 0.5) return way / max(abs(way.y), 1e-3);
#endif
    return vec3(-mean.x, -mean.w, -mean.y);
}

// The map's value for a surface at light-space place s: bilinear over what is seen of one height. group: any slot of
// the map's group; slope: of the surface in light space; pixelM: metres a pixel.
float mapValue(vec2 s, float height, float slope, float pixelM, int group, int slot, vec4 place) {
    int size = int(lightSpace.counts.y);
    vec4 rows = lightSpace.slots[group].rows, heights = lightSpace.slots[group].height;
    float side = lightSpace.slots[group].mean.w;
    float tolerance = kGapM + 1.5 * place.z * slope;
    // A pixel that covers many texels looks at a coarser mip. Squares begin at whole texels of all mips.
    int mip = int(min(log2(max(1.2 * pixelM * place.w, 1.0)), causticBlock.maps.x - 1.0));
    vec2 at = s * (place.w * exp2(-float(mip))) - 0.5, low = floor(at), f = at - low;
    ivec2 corner = ivec2(low) - (ivec2(floor(place.xy * place.w + 0.5)) >> mip);
    float sum = 0.0;
    int behind = 0;   // bits of taps where the surface lies behind the first layer
    // Four taps of the first layer, four more of the second where they are needed.
    for (int i = 0; i < 4 || (i < 8 && behind != 0); ++i) {
        ivec2 bit = ivec2(i & 1, (i >> 1) & 1);
        int layer = 2 * slot + (i >> 2);
        vec2 w = mix(1.0 - f, f, vec2(bit));
        ivec2 coarse = clamp(corner + bit, ivec2(0), ivec2((size >> mip) - 1));
        ivec2 texel = (coarse << mip) + ((1 << mip) >> 1);
        float depth = texelFetch(litDepth, ivec3(texel.x, int(rows.x) * texel.y + int(rows.y), layer), 0).x;
        bool hidden = depth > 0.0 && side * (height - heightOfDepth(depth, heights)) > tolerance;
        bool counts = i < 4 || (behind & (1 << (i & 3))) != 0;
        if (i < 4 && hidden) behind |= 1 << i;
        float value = texelFetch(causticMaps, ivec3(coarse, layer), mip).x;
        sum += counts && !hidden ? w.x * w.y * value : 0.0;
    }
    return sum;
}

// 0 outside of a slot's square, 1 inside; a finer slot fades towards the rim.
float insideSlot(vec2 s, vec4 place, bool fades) {
    vec2 t = (s - place.xy) * place.w, rim = min(t, lightSpace.counts.y - t);
    float inwards = min(rim.x, rim.y);
    return fades ? clamp((inwards - 1.0) / kRimTexels, 0.0, 1.0) : step(0.0, inwards);
}

bool isUnderWater(vec3 p) {
    vec4 area = waterBlock.area;
    bool inArea = all(greaterThanEqual(p.xz, area.xy)) && all(lessThanEqual(p.xz, area.zw));
    float surface = 0.0;
#ifndef NO_WATERLINE
    if (abs(p.y - waterBlock.shape.x) <= waterBlock.shape.w) surface = waveSlopeAt(p.xz).x;
#endif
    return inArea && p.y - waterBlock.shape.x < surface;
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

    // The sun's beam through level water: what all channels lose, and what each loses beyond that.
    float depth = max(waterBlock.shape.x - p.y, 0.0), metres = -depth / waterBlock.sunRefracted.y;
    vec3 excess = waterBlock.beamAttenuation.rgb - waterBlock.beamAttenuation.w;
    vec3 tint = exp(-excess * metres);
    vec3 beam = tint * exp(-waterBlock.beamAttenuation.w * metres);
    vec3 onLevel = waterBlock.sunIrradiance.rgb * (waterBlock.toSun.w * waterBlock.toSun.y * waterBlock.sunRefracted.w);

    vec3 direct = vec3(0.0);
    float sunLeft = causticBlock.maps.y == 0.0 ? 1.0 : 0.0;   // share of the sun that no map covers
    int count = int(lightSpace.counts.x);
    for (int group = 0; group < count;) {
        int end = int(lightSpace.slots[group].rows.z);
        bool reflected = lightSpace.slots[group].flags.y > 0.5;
        vec3 toLight = towardsLight(p, group);
        float facing = dot(normal, toLight), tilt = length(normal.xz) / max(facing, 0.05);
        vec2 s = lightSpaceOf(p, group);
        float left = there && reflected != under ? 1.0 : 0.0, value = 0.0;
        if (facing <= 0.0) left = 0.0;
        // The finest slot there, and the next one where that fades.
        int from = group;
        for (int k = 0; k < 2; ++k) {
            int slot = -1;
            float share = 0.0;
            vec4 place = lightSpace.slots[group].place;
            for (int i = group; i < end; ++i) {
                float inside = min(insideSlot(s, lightSpace.slots[i].place, i + 1 < end), left);
                if (slot < 0 && i >= from && inside > 0.0) slot = i, share = inside, place = lightSpace.slots[i].place;
            }
            if (slot < 0) break;
            value += share * mapValue(s, p.y, tilt, pixelM, group, slot, place);
            left -= share;
            from = slot + 1;
            if (left <= 0.0) break;
        }
        vec3 through = reflected ? vec3(1.0) : tint;
#ifndef NO_LAMPS
        vec4 source = lightSpace.slots[group].source;
        if (source.w > 0.5) {
            float scale = lampScale(p.y, waterBlock.shape.x, source.y);
            value *= scale * scale;
            if (!reflected) through = exp(-excess * (depth * length(toLight)));
        }
#endif
        direct += lightSpace.slots[group].irradiance.rgb * through * (value * max(facing, 0.0));
        if (lightSpace.slots[group].flags.x < 0.0 && !reflected) sunLeft = left;
        group = end;
    }
    float sunFacing = max(dot(normal, waterBlock.sunRefracted.xyz) / waterBlock.sunRefracted.y, 0.0);
    if (under) direct += onLevel * beam * (sunLeft * sunFacing);
    imageStore(directImage, pixel, vec4(direct, under ? 1.0 : 0.0));

    // Smooth light from above: the sky's, and the sun's that left the sharp beam.
    if (!ambientWanted) return;
    vec3 sky = waterBlock.skyIrradiance.rgb * kSkyTransmittance * exp(-waterBlock.diffuseAttenuation.rgb * depth);
    vec3 scattered = onLevel * max(exp(-waterBlock.sunDiffuseAttenuation.rgb * depth) - beam, vec3(0.0));
    vec3 ambient = (sky + scattered) * (0.318309886 * mix(kFromBelow, 1.0, 0.5 + 0.5 * normal.y));
    imageStore(ambientImage, pixel, under ? vec4(ambient, 1.0) : vec4(0.0));
}
