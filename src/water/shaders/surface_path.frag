#version 450 core
// Each pixel's way through the water (WaterPaths::path). A ray that enters through the surface is bent, and followed to
// where it meets opaque surfaces: in the view along bent rays, which hides nothing that such rays meet, else (no such
// view, or beyond its borders) on the screen. Drawn with fullscreen.vert.
// Variant CROSSING: surface_side.glsl.
#include "frame/view.shared.h"
#include "water/paths.io.glsl"
#include "water/surface_side.glsl"

layout(binding = SHOAL_UNIT_PASS + 0) uniform sampler2D opaqueDepth;   // R32F view depth
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D bentDepth;     // the same of the view along bent rays

layout(location = 0) out vec4 outPath;

const int kSearchSteps = 10;
const int kBentSteps = 6;
const float kBeyondBent = 0.02;     // of the view's size, over which it goes on as at its border
const float kFirstGuess = 100.0;    // metres at most that the search begins at
const float kBlindGuess = 2.0;      // and where nothing lies so near behind the pixel
const float kLeastDepth = 0.02;     // metres that things may stand above the surface's point and count as wet
const float kLargestBend = 0.02;    // of the inverse depth, over which neighbouring texels are not one plane
const float kSoftBorder = 0.03;     // of the picture's size
const float kLargestStep = 0.2;     // of the same
const float kCloseEnough = 1e-3;    // of the path's length
const float kHitTolerance = 0.02;   // of the path's length: how far off the opaque surface a bent ray may end

// View depth of opaque surfaces between texels (x): its inverse is even over a plane on the screen; where the four
// texels lie on no plane (y: 0), that of the nearest.
vec2 depthAt(sampler2D depths, vec2 pixel, vec2 pixels) {
    vec2 corner = floor(pixel - 0.5), f = pixel - 0.5 - corner;
    vec4 z = textureGather(depths, (corner + 1.0) / pixels, 0);   // (0, 1), (1, 1), (1, 0), (0, 0)
    vec4 inverse = mix(vec4(1.0 / kFarthestWater), 1.0 / z, greaterThan(z, vec4(0.0)));
    vec2 row = mix(inverse.wx, inverse.zy, f.x);
    float nearest = f.y < 0.5 ? (f.x < 0.5 ? inverse.w : inverse.z) : (f.x < 0.5 ? inverse.x : inverse.y);
    float bend = abs(inverse.x + inverse.z - inverse.y - inverse.w);
    vec2 least = min(inverse.xy, inverse.zw), most = max(inverse.xy, inverse.zw);
    bool plane = bend < kLargestBend * nearest &&
                 max(most.x, most.y) - min(least.x, least.y) < kLargestStep * nearest;
    return vec2(1.0 / (plane ? mix(row.x, row.y, f.y) : nearest), plane ? 1.0 : 0.0);
}

// Mirrored at the picture's borders: what lies beyond them is not known, and looks like what lies before.
vec2 insidePicture(vec2 pixel) {
    vec2 last = max(size.xy - 1.0, vec2(1.0));
    vec2 turned = mod(abs(pixel - 0.5), 2.0 * last);
    return min(turned, 2.0 * last - turned) + 0.5;
}

// Metres along a bent ray to the height of a point.
float toHeightOf(vec3 point, vec3 start, vec3 direction) {
    return clamp((start.y - point.y) / max(-direction.y, 0.1), 0.0, kFarthestWater);
}

// What a bent ray meets: pixel (xy), metres from the start (z) and -1 in w where that is a guess. straight: where the
// unbent ray would end.
// Searched on g(t) = depth of the opaque surface less depth of the ray: outwards until g < 0, then between by secants
// and halves in turn.
vec4 followBent(vec3 start, vec3 direction, vec2 ownPixel, vec3 straight, bool ask) {
    vec4 clip0 = clipFromWorld * vec4(start, 1.0), clip1 = clipFromWorld * vec4(direction, 0.0);
    float depth0 = -(viewFromWorld * vec4(start, 1.0)).z, depth1 = -(viewFromWorld * vec4(direction, 0.0)).z;
    float straightM = min(distance(straight, start), kFarthestWater);
    // First where the opaque surface would be if it was level.
    float t = clamp(toHeightOf(straight, start, direction), 0.1 * straightM, 2.0 * straightM);
    t = straight.y < start.y && t < kFirstGuess ? t : kBlindGuess;
    float low = 0.0, gLow = straightM, high = -1.0, gHigh = 0.0, bestMiss = 1e30;
    // Behind a crest that hides things in the air: as if deep.
    vec4 best = vec4(0.0);
    vec3 lowEnd = vec3(ownPixel, straight.y > start.y + kLeastDepth ? kFirstGuess : straightM);
    int rounds = ask ? kSearchSteps : 0;
    for (int i = 0; i < rounds; ++i) {
        vec4 clip = clip0 + clip1 * t;
        vec2 pixel = (clip.xy / max(clip.w, 1e-4) * 0.5 + 0.5) * size.xy;
        vec2 inside = clamp(pixel, vec2(0.5), size.xy - 0.5);
        vec2 opaque = depthAt(opaqueDepth, inside, size.xy);
        PixelRay ray = rayOfPixel(inside);
        vec3 hit = ray.origin + ray.step * opaque.x;
        if (inside != pixel) {
            // Nothing is known there: as if what is seen at the border went on level.
            t = toHeightOf(hit, start, direction);
            clip = clip0 + clip1 * t;
            best = vec4((clip.xy / max(clip.w, 1e-4) * 0.5 + 0.5) * size.xy, t, -1.0);
            bestMiss = 0.0;
            break;
        }
        float miss = distance(hit, start + direction * t), g = opaque.x - (depth0 + depth1 * t);
        // What is nearer than the surface or above it is not in the water.
        bool wet = dot(hit - start, direction) > 0.0 && hit.y < start.y + kLeastDepth;
        bool better = wet && opaque.y > 0.0 && miss < bestMiss;   // at an edge the picture mixes near and far
        best = better ? vec4(pixel, distance(hit, start), 0.0) : best;
        bestMiss = better ? miss : bestMiss;
        if (miss < kCloseEnough * t) break;
        bool before = g > 0.0;
        lowEnd = before && wet ? vec3(pixel, toHeightOf(hit, start, direction)) : lowEnd;
        low = before ? t : low, gLow = before ? g : gLow;
        high = before ? high : t, gHigh = before ? gHigh : g;
        float secant = low + (high - low) * gLow / max(gLow - gHigh, 1e-6);
        float outwards = max(distance(hit, start), 1.05 * t);
        t = high < 0.0 ? outwards : (i & 1) == 0 ? secant : 0.5 * (low + high);
        t = clamp(t, 0.0, kFarthestWater);
    }
    // What the ray meets is hidden behind something nearer: what is seen beside that stands for it.
    return bestMiss <= kHitTolerance * best.z + 0.01 ? best : vec4(lowEnd, -1.0);
}

// Metres along a bent ray to what it meets in the view along bent rays (x); y: 1 where that view shows it. first: where
// the search begins. From there its eye sees nearly along the ray: few steps.
vec2 followInBentView(vec3 start, vec3 direction, float first, bool ask) {
    vec4 depthRow = surfaceBlock.depthRow[2];
    vec4 clip0 = surfaceBlock.clipFromWorld[2] * vec4(start, 1.0);
    vec4 clip1 = surfaceBlock.clipFromWorld[2] * vec4(direction, 0.0);
    float depth0 = dot(depthRow, vec4(start, 1.0)), depth1 = dot(depthRow, vec4(direction, 0.0));
    vec2 pixels = surfaceBlock.mirrorSize[2].xy;
    float t = first, low = 0.0, gLow = max(first * depth1, 1e-3), high = -1.0, gHigh = 0.0;
    float best = first, bestMiss = 1e30, shown = 0.0;
    int rounds = ask ? kBentSteps : 0;
    for (int i = 0; i < rounds; ++i) {
        vec4 clip = clip0 + clip1 * t;
        float depth = max(depth0 + depth1 * t, 1e-3);
        vec2 pixel = (clip.xy / max(clip.w, 1e-4) * 0.5 + 0.5) * pixels;
        vec2 inside = clamp(pixel, vec2(0.5), pixels - 0.5);
        shown = all(lessThan(abs(pixel - inside), kBeyondBent * pixels)) ? 1.0 : 0.0;
        vec3 point = start + direction * t;
        float seen = depthAt(bentDepth, inside, pixels).x, g = seen - depth;
        vec3 hit = surfaceBlock.bentEye.xyz + (point - surfaceBlock.bentEye.xyz) * (seen / depth);
        float miss = distance(hit, point);
        best = miss < bestMiss ? t : best;
        bestMiss = min(miss, bestMiss);
        if (miss < kCloseEnough * t) break;
        low = g > 0.0 ? t : low, gLow = g > 0.0 ? g : gLow;
        high = g > 0.0 ? high : t, gHigh = g > 0.0 ? gHigh : g;
        // Exact for a level floor; then between by secants and halves in turn.
        float level = toHeightOf(hit, start, direction), secant = low + (high - low) * gLow / max(gLow - gHigh, 1e-6);
        float outwards = max(distance(hit, start), 1.05 * t);
        bool within = level > low && (high < 0.0 || level < high);
        t = i == 0 && within ? level : high < 0.0 ? outwards : (i & 1) == 0 ? secant : 0.5 * (low + high);
        t = clamp(t, 0.0, kFarthestWater);
    }
    // Behind what hides it: as far as what is seen beside it.
    return vec2(best, shown);
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float surface = texelFetch(waterSurfaceDepth, at, 0).x, opaque = texelFetch(opaqueDepth, at, 0).x;
    PixelRay ray = rayOfPixel(gl_FragCoord.xy);
    float stepM = length(ray.step);
    vec3 direction = ray.step / stepM;
    float opaqueM = opaque > 0.0 ? opaque * stepM : kFarthestWater;
    bool drawn = waterBlock.shape.z > 0.0;

    // In through the surface.
    vec3 start = ray.origin + ray.step * surface;
    vec3 normal = decodeNormal(texelFetch(waterSurfaceNormal, at, 0).xy);
    vec3 bent = refractedDirection(direction, normal, waterBlock.shape.y);
    bool enters = surface > 0.0;
    vec3 straight = ray.origin + direction * opaqueM;
    float first = clamp(toHeightOf(straight, start, bent), kLeastDepth, distance(straight, start) + kBlindGuess);
    vec2 metBent = followInBentView(start, bent, first, enters && surfaceBlock.mirrorSize[2].z > 0.0);
    vec4 met = followBent(start, bent, gl_FragCoord.xy, straight, enters && metBent.y == 0.0);
    vec2 offset = (insidePicture(met.xy) - gl_FragCoord.xy) * size.zw;
    vec2 border = 0.5 - abs(met.xy * size.zw - 0.5);
    float guessed = min(met.w, -clamp(1.0 - min(border.x, border.y) / kSoftBorder, 0.0, 1.0));

    // Not bent: from the eye, or in through a side of the area.
    vec3 nearPoint = ray.origin + ray.step * depthRange.x;
    bool aroundArea = !inArea(nearPoint.xz);
    bool fromEye = drawn && !aroundArea && (surface < 0.0 || underWater(nearPoint));
    vec2 span = waterSpan(ray.origin, direction, fromEye || surface < 0.0 ? 1e9 : waterBlock.shape.x);
    float begin = fromEye ? 0.0 : span.x;
    float end = min(min(opaqueM, span.y), surface < 0.0 ? -surface * stepM : 1e30);
    bool wet = fromEye || !drawn || aroundArea;
    float straightWaterM = wet ? clamp(end - begin, 0.0, kFarthestWater) : 0.0;

    vec4 entered = metBent.y > 0.0 ? vec4(0.0, 0.0, metBent.x, -2.0) : vec4(offset, met.z, guessed);
    outPath = enters ? entered : vec4(0.0, 0.0, straightWaterM, fromEye ? 1.0 : 0.0);
}
