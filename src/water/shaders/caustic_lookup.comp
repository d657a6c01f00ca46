#version 450 core
// Light on each pixel's surface that came through the water's surface or was thrown up by it, from the caustic maps;
// and the smooth light of sky and scattered sun under water. Variants: NO_NORMALS, normals are taken from the depth;
// NO_LAMPS, the sun alone; FEW_SLOTS, two maps of it at most, besides that of what the surface throws up;
// TILES, only tiles listed before: with surfaces behind others, and with WATERLINE those near it; without it all
// pixels as if no wave were high and nothing lay behind anything: tiles where that does not hold are listed.
// llvmpipe runs every branch and every loop at least once: hence two passes, and straight lines in the first.
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
#ifdef TILES
// Lists of tiles (caustic_tiles.comp): near the waterline from the start, behind something from the end.
layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer Tiles { uint tileGroups[8]; uint tiles[]; };
// Slots whose second layer holds light.
layout(std430, binding = SHOAL_STORAGE_WATER + 2) readonly buffer Layers { uint secondUsed[SHOAL_MAX_LIGHT_SLOTS]; };
#else
// Two words a tile: not 0 where it has surfaces near the waterline, behind others.
layout(std430, binding = SHOAL_STORAGE_WATER + 1) writeonly buffer TileFlags { uint tileFlags[]; };
#endif

const float kSkyTransmittance = 0.934;   // of light from all of the sky through level water
const float kFloorAlbedo = 0.3;           // of the floor, as upwelling light takes it
const float kBackscattered = 0.0183;      // of scattered light goes backwards [Petzold 1972]
#ifdef FEW_SLOTS
const int kMostCascades = 2;              // slots of one group
#else
const int kMostCascades = 4;
#endif
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
        along[axis] = useAfter ? positionAt(vec2(after) + 0.5, a) - position
                               : position - positionAt(vec2(before) + 0.5, b);
    }
    vec3 n = cross(along[0], along[1]);
    vec2 at = vec2(pixel);
    vec3 ray = causticBlock.ray.xyz + causticBlock.rayX.xyz * at.x + causticBlock.rayY.xyz * at.y;
    n *= dot(n, ray) > 0.0 ? -1.0 : 1.0;
    return dot(n, n) > 0.0 ? normalize(n) : vec3(0.0, 1.0, 0.0);
#endif
}

#ifndef NO_LAMPS
// Where light of the slot comes from at p: that way along 1 m of height.
vec3 towardsLight(vec3 p, int slot) {
    vec4 mean = lightSpace.slots[slot].mean, source = lightSpace.slots[slot].source;
    vec3 way = source.xyz - p;
    if (source.w > 0.5) return way / max(abs(way.y), 1e-3);
    return vec3(-mean.x, -mean.w, -mean.y);
}
#endif

// A surface as the maps are asked about it.
struct Receiver {
    vec2 s;        // place in light space
    float height;  // world y
    float slope;   // of the surface in light space
    float pixelM;  // metres a pixel
    float side;    // -1 light comes down, 1 up
};

// The map's value at t (texels of the slot): bilinear over what is seen of one height. perM: texels a metre; behind:
// set where the second layer would have to be looked at.
float mapValue(Receiver r, vec2 t, float perM, int slot, inout bool behind) {
    float size = lightSpace.counts.y;
    float tolerance = kGapM * perM + 1.5 * r.slope;   // texels
    // A pixel that covers many texels looks at a coarser mip. Squares begin at whole texels of all mips.
    float covered = 1.2 * r.pixelM * perM;
    bool coarse = causticBlock.maps.x > 1.0 && covered >= 2.0, coarsest = causticBlock.maps.x > 2.0 && covered >= 4.0;
    float scale = coarsest ? 0.25 : coarse ? 0.5 : 1.0;
    vec2 at = t * scale - 0.5, low = floor(at), f = at - low;
    // Mips lie above the map itself (one level for the sampler: a level of each pixel's own costs llvmpipe dear).
    vec2 shelf = vec2(max(size - 2.0 * size * scale, 0.0), coarse ? size : 0.0), last = vec2(size * scale - 1.0);
    vec2 low0 = clamp(low, vec2(0.0), last), high0 = clamp(low + 1.0, vec2(0.0), last);
    ivec2 a = ivec2(shelf + low0), b = ivec2(shelf + high0);
    vec2 g = 1.0 - f;
    vec4 w = vec4(g.x * g.y, f.x * g.y, g.x * f.y, f.x * f.y);
    int layer = 2 * slot;
    // Irradiance, and the height of what has it.
    vec2 first = texelFetch(causticMaps, ivec3(a, layer), 0).xy;
    vec2 second = texelFetch(causticMaps, ivec3(b.x, a.y, layer), 0).xy;
    vec2 third = texelFetch(causticMaps, ivec3(a.x, b.y, layer), 0).xy;
    vec2 fourth = texelFetch(causticMaps, ivec3(b, layer), 0).xy;
    vec4 value = vec4(first.x, second.x, third.x, fourth.x), lit = vec4(first.y, second.y, third.y, fourth.y);
    bvec4 hidden = greaterThan((r.side * perM) * (vec4(r.height) - lit), vec4(tolerance));
    vec4 seen = mix(w, vec4(0.0), hidden);
    float sum = dot(seen, value);
    // What the first layer hides may lie in the second.
#ifndef TILES
    behind = behind || seen != w;
#else
    w -= seen;
    vec4 rows = lightSpace.slots[slot].rows, heights = lightSpace.slots[slot].height;
    int mip = coarsest ? 2 : coarse ? 1 : 0;
    ivec2 ta = (ivec2(low0) << mip) + ((1 << mip) >> 1), tb = (ivec2(high0) << mip) + ((1 << mip) >> 1);
    ta.y = int(rows.x) * ta.y + int(rows.y), tb.y = int(rows.x) * tb.y + int(rows.y);
    for (int i = 0; i < 4 && (w.x > 0.0 || w.y > 0.0 || w.z > 0.0 || w.w > 0.0); ++i) {
        ivec2 at2 = ivec2((i & 1) == 0 ? ta.x : tb.x, i < 2 ? ta.y : tb.y);
        ivec2 map2 = ivec2((i & 1) == 0 ? a.x : b.x, i < 2 ? a.y : b.y);
        float depth = texelFetch(litDepth, ivec3(at2, layer + 1), 0).x;
        bool farther = depth > 0.0 && r.side * perM * (r.height - heightOfDepth(depth, heights)) > tolerance;
        float value2 = texelFetch(causticMaps, ivec3(map2, layer + 1), 0).x;
        sum += farther || secondUsed[slot] == 0u ? 0.0 : w[i] * value2;
        if (i == 3) w = vec4(0.0);
    }
#endif
    return sum;
}

// The square of slot first + i. Of the sun alone a pixel asks for its slots, from 0 on, or for `thrownUp`, a single
// one.
vec4 placeOf(int first, int i, vec4 thrownUp) {
#ifdef NO_LAMPS
    return first == 0 ? lightSpace.slots[i].place : thrownUp;
#else
    return lightSpace.slots[min(first + i, SHOAL_MAX_LIGHT_SLOTS - 1)].place;
#endif
}

// The value of the finest of slots first to end there, and of the next one where that fades. left: the share of the
// light that none of them has.
float slotsValue(Receiver r, int first, int end, vec4 thrownUp, inout float left, inout bool behind) {
    // (A count that the compiler does not know: it would unroll the loop, and llvmpipe run both turns for all.)
    int from = first, blends = int(causticBlock.maps.z);
    float value = 0.0, middle = 0.5 * lightSpace.counts.y;
    for (int k = 0; k < blends; ++k) {
        int slot = -1;
        float share = 0.0, perM = 0.0;
        vec2 t = vec2(0.0);
        for (int i = 0; i < kMostCascades; ++i) {
            int other = first + i;
            vec4 place = placeOf(first, i, thrownUp);
            vec2 texels = (r.s - place.xy) * place.w, off = abs(texels - middle);
            float inwards = middle - max(off.x, off.y);
            // A finer slot fades towards the rim.
            float part = other + 1 < end ? clamp((inwards - 1.0) / kRimTexels, 0.0, 1.0) : step(0.0, inwards);
            part = min(part, left);
            bool taken = slot < 0 && other >= from && other < end && part > 0.0;
            slot = taken ? other : slot;
            share = taken ? part : share;
            perM = taken ? place.w : perM;
            t = taken ? texels : t;
        }
        if (slot < 0) break;
        value += share * mapValue(r, t, perM, slot, behind);
        left -= share;
        from = slot + 1;
        if (left <= 0.0) break;
    }
    return value;
}

const float kBorderM = 0.01;

bool isUnderWater(vec3 p) {
    vec4 area = waterBlock.area;
    // A basin's walls stand exactly on the border of its area: they count.
    bool inArea = all(greaterThanEqual(p.xz, area.xy - kBorderM)) && all(lessThanEqual(p.xz, area.zw + kBorderM));
    float surface = 0.0;
#ifdef WATERLINE
    if (abs(p.y - waterBlock.shape.x) <= waterBlock.shape.w) surface = waveHeightAt(p.xz);
#endif
    return inArea && p.y - waterBlock.shape.x < surface;
}

void main() {
#ifdef TILES
#ifdef WATERLINE
    uint tile = tiles[gl_WorkGroupID.x];
#else
    uint tile = tiles[tiles.length() - 1 - int(gl_WorkGroupID.x)];
#endif
    ivec2 corner = ivec2(tile & 0xffffu, tile >> 16);
#else
    ivec2 corner = ivec2(gl_WorkGroupID.xy);
#endif
    ivec2 pixel = corner * ivec2(gl_WorkGroupSize.xy) + ivec2(gl_LocalInvocationID.xy);
    bool inside = all(lessThan(pixel, ivec2(causticBlock.size.xy)));
    float viewDepth = inside ? texelFetch(viewDepthTexture, pixel, 0).x : 0.0;
    bool there = viewDepth > 0.0;
    vec3 p = positionAt(vec2(pixel) + 0.5, max(viewDepth, 1e-3));
    vec3 normal = normalAt(pixel, p, viewDepth);
    bool under = there && isUnderWater(p);
    float pixelM = causticBlock.size.z * viewDepth + causticBlock.size.w;
    bool behind = false;

    // What is left of the sun's beam through level water: maps hold light over that.
    float depth = max(waterBlock.shape.x - p.y, 0.0);
    vec3 beam = exp(waterBlock.beamAttenuation.rgb * (depth / waterBlock.sunRefracted.y));
    vec3 onLevel = waterBlock.sunIrradiance.rgb * (waterBlock.toSun.w * waterBlock.toSun.y * waterBlock.sunRefracted.w);

    vec3 direct = vec3(0.0);
    float sunLeft = causticBlock.maps.y == 0.0 ? 1.0 : 0.0;   // share of the sun that no map covers
#ifdef NO_LAMPS
    // Of the sun's light what is under water gets that which comes down, the rest what the surface throws up: the last
    // slot's.
    int sunSlots = causticBlock.maps.y == 0.0 ? 0 : int(lightSpace.slots[0].rows.z);
    vec4 thrownUp = lightSpace.slots[0].place;
    for (int i = 1; i <= kMostCascades; ++i) thrownUp = i == sunSlots ? lightSpace.slots[i].place : thrownUp;
    int first = under ? 0 : sunSlots, end = under ? sunSlots : int(lightSpace.counts.x);
    float side = under ? -1.0 : 1.0;
    // (What a low sun's light is thrown up by is taken to go straight up: slot_fit.cpp.)
    vec2 fromLevel = under ? waterBlock.sunRefracted.xz / waterBlock.sunRefracted.y
                           : waterBlock.toSun.xz / max(waterBlock.toSun.y, 1e-3);
    if (!under && waterBlock.toSun.y < 0.05) fromLevel = vec2(0.0);
    float facing = dot(normal, vec3(fromLevel.x, -side, fromLevel.y)), tilt = length(normal.xz) / max(facing, 0.05);
    float left = there && facing > 0.0 ? 1.0 : 0.0;
    vec2 s = p.xz + fromLevel * (side * (p.y - waterBlock.shape.x));
    float value = slotsValue(Receiver(s, p.y, tilt, pixelM, side), first, end, thrownUp, left, behind);
    direct = lightSpace.slots[0].irradiance.rgb * (under ? beam : vec3(1.0)) * (value * max(facing, 0.0));
    if (sunSlots > 0) sunLeft = left;
#else
    // Slots of light that comes down stand before those of light thrown up: under water the first ones count, above it
    // the others.
    int count = int(lightSpace.counts.x), firstUp = 0;
    for (int i = 0; i < count; ++i) firstUp += lightSpace.slots[i].flags.y > 0.5 ? 0 : 1;
    bool reflected = !under;
    int last = !there ? 0 : under ? firstUp : count;
    for (int group = under ? 0 : firstUp, end = 0; group < last; group = end) {
        end = int(lightSpace.slots[group].rows.z);
        vec3 toLight = towardsLight(p, group);
        float facing = dot(normal, toLight), tilt = length(normal.xz) / max(facing, 0.05);
        float left = facing > 0.0 ? 1.0 : 0.0;
        Receiver r = Receiver(lightSpaceOf(p, group), p.y, tilt, pixelM, lightSpace.slots[group].mean.w);
        float value = slotsValue(r, group, end, vec4(0.0), left, behind);
        vec3 through = reflected ? vec3(1.0) : beam;
        vec4 source = lightSpace.slots[group].source;
        if (source.w > 0.5) {
            float scale = lampScale(p.y, waterBlock.shape.x, source.y);
            value *= scale * scale;
            if (!reflected) through = exp(-waterBlock.beamAttenuation.rgb * levelPath(p, group));
        }
        direct += lightSpace.slots[group].irradiance.rgb * through * (value * max(facing, 0.0));
        if (lightSpace.slots[group].flags.x < 0.0 && !reflected) sunLeft = left;
    }
#endif
    float sunFacing = max(dot(normal, waterBlock.sunRefracted.xyz) / waterBlock.sunRefracted.y, 0.0);
    if (under) direct += onLevel * beam * (sunLeft * sunFacing);
#ifndef TILES
    int tile = 2 * (corner.y * int(gl_NumWorkGroups.x) + corner.x);
    if (there && abs(p.y - waterBlock.shape.x) <= waterBlock.shape.w) tileFlags[tile] = 1u;
    if (behind) tileFlags[tile + 1] = 1u;
#endif
    if (!inside) return;
    imageStore(directImage, pixel, vec4(direct, under ? 1.0 : 0.0));

    // Smooth light from above: the sky's, and the sun's that left the sharp beam. From below what of all of it the
    // water sends back (deep water 0.33 b_b / a [Gordon et al. 1975]), and the floor, there and back.
    if (!ambientWanted) return;
    vec3 sky = waterBlock.skyIrradiance.rgb * kSkyTransmittance * exp(-waterBlock.diffuseAttenuation.rgb * depth);
    vec3 scattered = onLevel * max(exp(-waterBlock.sunDiffuseAttenuation.rgb * depth) - beam, vec3(0.0));
    vec3 absorbed = max(waterBlock.beamAttenuation.rgb - waterBlock.beamScattering.rgb, vec3(1e-4));
    vec3 deep = min(0.33 * kBackscattered * waterBlock.scattering.rgb / absorbed, vec3(kFloorAlbedo));
    float toFloor = lightSpace.counts.x > 0.0 ? max(p.y - lightSpace.slots[0].reach.y, 0.0) : 1e3;
    vec3 back = mix(deep, vec3(kFloorAlbedo), exp(-2.0 * waterBlock.diffuseAttenuation.rgb * toFloor));
    vec3 upwelling = back * (sky + scattered + onLevel * beam);
    vec3 ambient = mix(upwelling, sky + scattered, 0.5 + 0.5 * normal.y) * 0.318309886;
    imageStore(ambientImage, pixel, under ? vec4(ambient, 1.0) : vec4(0.0));
}
