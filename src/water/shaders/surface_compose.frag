#version 450 core
// The picture with water: at the surface what it mirrors and what it lets through; on the way what is lost and what is
// scattered in. Drawn with fullscreen.vert.
// L(air) = R L(mirrored) + T / n2 L(bent); L(water) = n2 T L(air, bent) + R L(mirrored); both
// sides of the surface see the air along one ray, which is looked up in the sky and in the picture of what stands above
// the water. Seen radiance is dimmed as the sharp beam is, by a + b (1 - f): light scattered nearly forward stays in
// it.
#include "frame/lighting.io.glsl"
#include "frame/view.shared.h"
#include "water/paths.io.glsl"
#include "water/surface.lib.glsl"
#include "water/surface.shared.h"
#ifdef FOAM
#include "water/surface_foam.glsl"
#endif

layout(binding = SHOAL_UNIT_OPAQUE_COPY) uniform sampler2D radianceTexture;
layout(binding = SHOAL_UNIT_OPAQUE_DEPTH) uniform sampler2D opaqueDepth;
layout(binding = SHOAL_UNIT_PASS + 0) uniform sampler2D bentRadiance;   // what is under the water along bent rays
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D bentDepth;
layout(binding = SHOAL_UNIT_PASS + 2) uniform sampler2D inscatterTexture;
layout(binding = SHOAL_UNIT_PASS + 3) uniform sampler2D spreadTexture;
layout(binding = SHOAL_UNIT_PASS + 4) uniform sampler2D airRadiance;    // what stands above the water
layout(binding = SHOAL_UNIT_PASS + 5) uniform sampler2D airDepth;
layout(binding = SHOAL_UNIT_PASS + 6) uniform sampler2D waterRadiance;  // what is under it, mirrored
layout(binding = SHOAL_UNIT_PASS + 7) uniform sampler2D waterDepth;

layout(location = 0) out vec4 outRadiance;

const float kTurn = 6.28318530718;
const float kBrightest = 40000.0;     // of half floats' 65504
const float kFirstLook = 20.0;        // metres along a mirrored ray
const float kFirstLookUnder = 2.0;    // and along one in the water
const int kLooks = 5;
const float kBorder = 0.08;           // of the picture's size
const float kEndless = 1e6;
const float kNearer = 0.4;
const float kBefore = 0.03;           // of a start's depth, by which a thing may lie before it and still be met
const float kLeastDown = 0.02;        // of a unit ray mirrored into the water
const float kLeastAhead = 0.25;       // of a length: what lies beside or behind a view's eye is taken for so far ahead
const float kLookTolerance = 0.5;     // of the length: how far off its ray a thing may be to be taken for it

// Sharp to wide: spread is the standard deviation of direction, radians.
vec3 skyRadiance(vec3 d, float spread) {
    vec2 latLong = vec2(0.5 + atan(d.x, -d.z) / kTurn + lightBlock.environment.w,
                        acos(clamp(d.y, -1.0, 1.0)) / (0.5 * kTurn));
    float texels = spread * float(textureSize(sharpEnvironment, 0).x) * (2.5 / kTurn);
    float level = max(log2(max(texels, 1e-6)), max(lightBlock.backgroundLevel.y, 0.0));
    return textureLod(sharpEnvironment, latLong, level).rgb * lightBlock.environment.x;
}

// What a picture from a mirrored eye shows along a ray: radiance, and in a how much of the ray meets something.
struct Mirrored {
    vec4 radiance;
    float lengthM;
};

// rgb: between the texels of a view about `place` (pixels) that show anything, a: their share.
vec4 texelsAbout(int which, sampler2D radiances, sampler2D depths, vec2 place) {
    ivec2 last = ivec2(surfaceBlock.mirrorSize[which].xy) - 1;
    vec2 corner = floor(place - 0.5), f = place - 0.5 - corner;
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        ivec2 texel = clamp(ivec2(corner) + ivec2(i & 1, i >> 1), ivec2(0), last);
        float share = ((i & 1) != 0 ? f.x : 1.0 - f.x) * (i > 1 ? f.y : 1.0 - f.y);
        sum += vec4(texelFetch(radiances, texel, 0).rgb, 1.0) * (texelFetch(depths, texel, 0).x > 0.0 ? share : 0.0);
    }
    return sum;
}

// border: of the view's size, over which it goes on beyond its border as there; then there is nothing (the sky alone).
// tolerance: of the length, how far off its ray a thing may be to be taken for it.
// nothing: of the length looked at, where to look next if nothing is seen.
Mirrored lookUp(int which, sampler2D radiances, sampler2D depths, vec3 start, vec3 direction, float first,
                float border, float tolerance, float nothing, bool ask) {
    Mirrored m = Mirrored(vec4(0.0), kFarthestWater);
    mat4 clipFromWorld = surfaceBlock.clipFromWorld[which];
    vec2 pixels = surfaceBlock.mirrorSize[which].xy;
    vec4 clip0 = clipFromWorld * vec4(start, 1.0), clip1 = clipFromWorld * vec4(direction, 0.0);
    float depth0 = dot(surfaceBlock.depthRow[which], vec4(start, 1.0));
    float depth1 = dot(surfaceBlock.depthRow[which], vec4(direction, 0.0));
    float t = first, met = t, best = t, bestMiss = 1e30;   // best: where what fits best is met
    vec2 bestAt = vec2(0.0);
    // Where the ray is as deep as what is seen there; level water has it at the first look. What is as near as the
    // start stands where the surface ends, what is nearer is not on the ray.
    int looks = ask && surfaceBlock.mirrorSize[which].z > 0.0 ? kLooks : 0;
    for (int i = 0; i < looks; ++i) {
        t = min(met, kFarthestWater);
        vec4 clip = clip0 + clip1 * t;
        vec2 at = clip.xy / max(clip.w, kLeastAhead * t) * 0.5 + 0.5;
        vec2 place = clamp(at * pixels, vec2(0.5), pixels - 0.5);
        float seen = texelFetch(depths, ivec2(place), 0).x, behind = seen - depth0;
        bool onRay = seen > 0.0 && behind > -kBefore * (depth0 + 1.0);
        met = onRay ? clamp(behind / max(depth1, kLeastAhead), 0.0, kFarthestWater) : nothing * t;
        float miss = onRay ? abs(met - t) / (t + 1.0) : 1e20;
        best = miss < bestMiss ? met : best;
        bestAt = miss < bestMiss ? at : bestAt;
        bestMiss = min(miss, bestMiss);
        if (miss < 1e-3) break;
    }
    if (looks > 0 && bestMiss < tolerance) {
        vec2 beyond = max(abs(bestAt - 0.5) - 0.5, vec2(0.0));
        float known = clamp(1.0 - max(beyond.x, beyond.y) / border, 0.0, 1.0);
        vec2 place = clamp(bestAt * pixels, vec2(0.5), pixels - 0.5);
        m.radiance = texelsAbout(which, radiances, depths, place) * known;
        m.lengthM = best;
    }
    return m;
}

// What the view along bent rays shows `lengthM` from the start.
vec3 alongBentRay(vec3 start, vec3 direction, float lengthM) {
    vec4 clip = surfaceBlock.clipFromWorld[2] * vec4(start + direction * lengthM, 1.0);
    vec2 pixels = surfaceBlock.mirrorSize[2].xy;
    vec2 place = clamp((clip.xy / max(clip.w, 1e-4) * 0.5 + 0.5) * pixels, vec2(0.5), pixels - 0.5);
    return texelsAbout(2, bentRadiance, bentDepth, place).rgb;
}

// Smooth light that a stretch of water scatters to its end [closed form; water of one brightness, that of the depth
// where the stretch begins]: for paths that no shafts were marched along. lost: what dims the stretch.
vec3 veil(vec3 start, vec3 lost) {
    float deep = max(waterBlock.shape.x - start.y, 0.0);
    vec3 sun = waterBlock.sunIrradiance.rgb * (-waterBlock.sunRefracted.y * waterBlock.sunRefracted.w);
    vec3 down = 0.934 * waterBlock.skyIrradiance.rgb * exp(-waterBlock.diffuseAttenuation.rgb * deep) +
                sun * exp(-waterBlock.sunDiffuseAttenuation.rgb * deep);
    vec3 scattered = waterBlock.beamScattering.rgb / max(waterBlock.beamAttenuation.rgb, vec3(1e-9));
    return down * scattered * (1.0 - lost) * (0.5 / kTurn);
}

vec3 dimming(float lengthM) { return exp(-waterBlock.beamAttenuation.rgb * lengthM); }

// The same for a mirrored stretch: as much as the picture's own water has in that direction, with its shadows and
// shafts.
vec3 mirroredVeil(vec3 start, vec3 direction, vec3 lost) {
    vec4 clip = clipFromWorld * vec4(direction, 0.0);
    vec2 at = clamp(clip.xy / max(clip.w, kLeastAhead) * 0.5 + 0.5, vec2(0.0), vec2(1.0));
    vec2 pixels = vec2(textureSize(opaqueDepth, 0));
    ivec2 there = ivec2(clamp(at * pixels, vec2(0.5), pixels - 0.5));
    vec3 lostThere = dimming(texelFetch(waterPathTexture, there, 0).z);
    vec3 full = veil(start, lost);
    vec3 like = texelFetch(inscatterTexture, there, 0).rgb * (1.0 - lost) / max(1.0 - lostThere, vec3(1e-3));
    bool known = surfaceBlock.grid.w > 0.0 && texelFetch(waterSurfaceDepth, there, 0).x <= 0.0;
    return known ? min(like, 2.0 * full) : full;
}

// Radiance along a ray in the air, without the sun: what stands there, else the sky.
vec4 airAlong(vec3 start, vec3 direction, float spread, bool ask) {
    Mirrored m = lookUp(0, airRadiance, airDepth, start, direction, kFirstLook, kBorder, kLookTolerance,
                        kEndless, ask);
    vec3 up = normalize(vec3(direction.x, max(abs(direction.y), 1e-3), direction.z));
    return vec4(skyRadiance(up, spread) * (1.0 - m.radiance.a) + m.radiance.rgb, 1.0 - m.radiance.a);
}

// What happens at the surface. normal: on the ray's side.
struct Interface {
    float reflectance;
    vec3 air;        // where the ray goes in the air: mirrored, or bent out of the water
    vec3 mirrored;
    float spread;    // of `air`, radians
};

Interface interfaceAt(vec3 direction, vec3 normal, float variance, bool enters) {
    Interface s;
    float index = waterBlock.shape.y, cosSeen = clamp(-dot(direction, normal), 1e-3, 1.0);
    // From afar the sides of waves that face the eye are seen more than the others.
    float lean = enters ? variance / max(cosSeen, sqrt(variance) + 1e-6) : 0.0;
    s.mirrored = reflect(direction, normalize(normal - vec3(direction.x, 0.0, direction.z) * lean));
    s.spread = (enters ? 2.0 : index) * sqrt(variance);
    // What a steep wave mirrors along the surface meets it again.
    s.mirrored.y = enters ? s.mirrored.y : -max(abs(s.mirrored.y), kLeastDown);
    if (enters) {
        s.reflectance = roughReflectance(cosSeen, index, variance);
        s.air = s.mirrored;
    } else {
        // Waves too small to see smooth the window's rim: mean of three slopes.
        float tilt = 1.2247 * sqrt(variance), sine = sqrt(1.0 - cosSeen * cosSeen), passes = 0.0;
        for (int i = -1; i <= 1; ++i) {
            float c = clamp((cosSeen + float(i) * tilt * sine) / sqrt(1.0 + tilt * tilt * float(i * i)), 0.0, 1.0);
            float sine2 = (1.0 - c * c) * index * index;
            passes += sine2 < 1.0 ? fresnelTransmittance(sqrt(1.0 - sine2), index) : 0.0;
        }
        s.reflectance = 1.0 - passes / 3.0;
        vec3 bent = refractedDirection(direction, normal, 1.0 / index);
        s.air = dot(bent, bent) > 0.5 ? bent : normalize(vec3(direction.x, 1e-3, direction.z));
    }
    return s;
}

// Radiance of the sun, mirrored or bent, per irradiance on a plane facing it: its disc and the slopes are one lobe
// [Walter et al. 2007, eq. 20 and 21].
float sunLobe(vec3 direction, vec3 normal, float variance, bool enters) {
    vec3 toSun = lightBlock.toSun.xyz;
    float index = waterBlock.shape.y, cosSeen = clamp(-dot(direction, normal), 1e-3, 1.0);
    float widened = variance + 0.25 * lightBlock.sunIrradiance.w * lightBlock.sunIrradiance.w;
    float seen = seenCosine(cosSeen, variance), lobe;
    if (enters) {
        vec3 facet = normalize(toSun - direction);
        float cosFacet = dot(facet, normal), cosIn = clamp(dot(facet, toSun), 0.0, 1.0);
        lobe = (1.0 - fresnelTransmittance(cosIn, index)) * slopeDensity(cosFacet, widened) / (4.0 * seen);
        lobe = cosFacet > 0.0 && dot(toSun, normal) > 0.0 ? lobe : 0.0;
    } else {
        vec3 facet = normalize(index * direction - toSun);   // upwards
        float cosFacet = -dot(facet, normal);
        float cosIn = max(dot(facet, toSun), 0.0), cosOut = max(dot(facet, direction), 0.0);
        float together = index * cosOut - cosIn;
        lobe = cosIn * cosOut * index * index * fresnelTransmittance(cosIn, index) * slopeDensity(cosFacet, widened) /
               (seen * max(together * together, 1e-6));
        lobe = cosFacet > 0.0 ? lobe : 0.0;
    }
    return lightBlock.toSun.w > 0.0 ? lobe : 0.0;
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float surface = texelFetch(waterSurfaceDepth, at, 0).x;
    vec4 traced = texelFetch(waterPathTexture, at, 0);
    PixelRay ray = rayOfPixel(gl_FragCoord.xy);
    vec3 direction = normalize(ray.step), start = ray.origin + ray.step * abs(surface);

    float index2 = waterBlock.shape.y * waterBlock.shape.y;
    bool meets = surface != 0.0, enters = surface > 0.0;
    vec3 normal = decodeNormal(texelFetch(waterSurfaceNormal, at, 0).xy) * (enters ? 1.0 : -1.0);
    float variance = 0.5 * texelFetch(spreadTexture, at, 0).x + surfaceBlock.look.x;
    Interface s = interfaceAt(direction, normal, variance, enters);
    vec4 fromAir = airAlong(start, s.air, s.spread, meets);
    vec3 sun = lightBlock.sunIrradiance.rgb * (sunLobe(direction, normal, variance, enters) * fromAir.a);
    sun = min(sun, vec3(kBrightest));

    // The stretch of water.
    vec3 lost = dimming(traced.z);
    vec2 uv = gl_FragCoord.xy / vec2(textureSize(opaqueDepth, 0));
    vec4 opaque = textureLod(radianceTexture, uv + traced.xy, 0.0);
    vec3 inscatter = texelFetch(inscatterTexture, at, 0).rgb;
    if (surfaceBlock.grid.w == 0.0) inscatter = veil(enters ? start : ray.origin, lost);
    vec3 fromWater = opaque.rgb * lost + inscatter, radiance;
    if (enters) {
        vec3 bent = refractedDirection(direction, normal, waterBlock.shape.y);
        if (traced.w < -1.5) fromWater = alongBentRay(start, bent, traced.z) * lost + inscatter;
        radiance = s.reflectance * fromAir.rgb + sun + (1.0 - s.reflectance) / index2 * fromWater;
#ifdef FOAM
        radiance = withFoam(radiance, start, normal, -bent.y * traced.z, traced.z);
#endif
    } else if (meets) {
        // A wall may end at the surface, and be looked over from afar: nearer and nearer.
        // What the view does not show looks like what it shows nearest to it: a wall goes on, water too.
        Mirrored under = lookUp(1, waterRadiance, waterDepth, start, s.mirrored, kFirstLookUnder, kEndless,
                                kEndless, kNearer, true);
        vec3 lostUnder = dimming(under.lengthM);
        vec3 mirrored = under.radiance.rgb * lostUnder + mirroredVeil(start, s.mirrored, lostUnder);
        radiance = ((1.0 - s.reflectance) * index2 * fromAir.rgb + sun + s.reflectance * mirrored) * lost + inscatter;
    } else {
        radiance = traced.z > 0.0 ? fromWater : opaque.rgb;
    }
    outRadiance = vec4(min(radiance, vec3(65000.0)), meets || traced.z > 0.0 ? 1.0 : opaque.a);
}
