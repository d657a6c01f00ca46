#version 450 core
// Temporal antialiasing: the history, fetched from where the surface was, confined to what is likely here, blended with
// this frame.
// Sources: [Karis 2014] High Quality Temporal Supersampling; [Salvi 2016] An Excursion in Temporal Supersampling
// (variance clipping); [Jimenez 2016] Filmic SMAA (Catmull-Rom without its corners).
// Departs: the history also carries the variance of the surface's own luminance over time, which widens the clipping
// box. A detail that only some jitters hit is so kept, where the box of a frame that misses it would wipe it out and
// flicker.
// Blending happens on c w(c), w = displayWeight: what a supersampled picture shows is the limit.
#include "frame/bindings.shared.h"
#include "frame/exposure.io.glsl"

layout(binding = SHOAL_UNIT_PASS + 0) uniform sampler2D radianceTexture;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D viewDepthTexture;
layout(binding = SHOAL_UNIT_PASS + 2) uniform sampler2D motionTexture;
layout(binding = SHOAL_UNIT_PASS + 3) uniform sampler2D historyTexture;
layout(binding = SHOAL_UNIT_PASS + 4) uniform sampler2D historyMomentsTexture;
layout(location = 0) uniform vec4 frame;          // x: 1 drops the history, yz: 1 / size, w: unused
// Previous clip xyw of what lies at infinity in pixel p: behind + p.x behindX + p.y behindY.
layout(location = 1) uniform vec4 behind;
layout(location = 2) uniform vec4 behindX;
layout(location = 3) uniform vec4 behindY;

layout(location = 0) out vec4 outRadiance;
// x: frames in the history, y: variance of the weighted luminance over time, z: closeness of what
// decided the motion, w: 0
layout(location = 1) out vec4 outMoments;

const float kLongestHistory = 64.0;   // frames, on a still view
const float kMovingHistory = 8.0;    // frames, where the history is resampled
const float kSpatialWidth = 1.25;     // half width of the box in standard deviations of the neighbourhood
const float kSameDepth = 1.02;       // largest ratio of distances on one surface from a frame to the next
const float kSharpness = 0.5;        // of the cubic that fetches the history: 0.5 is Catmull-Rom
const float kStillWidth = 2.0;        // and of the pixel over time, on a still view
const float kMovingWidth = 1.0;       // and where it is known only by its motion

vec3 weighted(vec3 c) { return c * (exposureState.antialiasing / (1.0 + luminanceOf(c) * exposureState.antialiasing)); }
vec3 unweighted(vec3 t) { return t / (exposureState.antialiasing * max(1.0 - luminanceOf(t), 1e-4)); }

// Luminance first, so that its variance is the box's first axis.
vec3 toYcc(vec3 c) { return vec3(luminanceOf(c), 0.5 * (c.r - c.b), -0.25 * c.r + 0.5 * c.g - 0.25 * c.b); }
vec3 fromYcc(vec3 y) { return vec3(y.x) + vec3(0.8596, -0.1404, -1.1404) * y.y + vec3(-1.4304, 0.5696, -1.4304) * y.z; }

// Values of the other pixels of the 2 x 2 quad: each pixel fetches a quarter of what the quad needs.
vec3 besideX(vec3 v, float side) { return v + dFdxFine(v) * side; }
vec3 besideY(vec3 v, float side) { return v + dFdyFine(v) * side; }
float besideX(float v, float side) { return v + dFdxFine(v) * side; }
float besideY(float v, float side) { return v + dFdyFine(v) * side; }

// Reciprocal of the view depth, 0 where nothing was drawn.
float closeness(ivec2 at) {
    float depth = texelFetch(viewDepthTexture, at, 0).x;
    return depth > 0.0 ? 1.0 / depth : 0.0;
}

// Where this pixel's surface was, in pixels back (xy), and its closeness (z). side: towards the quad's other pixels;
// outward: the pixel beyond the own corner. What is clearly in front of the pixel in the quad or there decides, so that
// edges move as one; on one and the same slope it must not, for the error would lie on the same side in every frame and
// add up.
vec3 motionAt(ivec2 at, ivec2 outward, vec2 side) {
    const float kInFront = 1.1;   // times as close
    float own = closeness(at), beyond = closeness(outward);
    float besides = besideX(own, side.x);
    float above = besideY(own, side.y), across = besideY(besides, side.y);
    float most = own * kInFront;
    ivec2 nearest = beyond > most ? outward : at;
    most = max(most, beyond);
    nearest = besides > most ? ivec2(at.x + int(side.x), at.y) : nearest;
    most = max(most, besides);
    nearest = above > most ? ivec2(at.x, at.y + int(side.y)) : nearest;
    most = max(most, above);
    nearest = across > most ? at + ivec2(side) : nearest;
    most = max(most, across);
    if (most > 0.0) return vec3(texelFetch(motionTexture, nearest, 0).xy, nearest == at ? own : most);
    vec2 pixel = vec2(at) + 0.5;
    vec3 clip = behind.xyz + behindX.xyz * pixel.x + behindY.xyz * pixel.y;
    return vec3(clip.z > 0.0 ? pixel - (clip.xy / clip.z * 0.5 + 0.5) / frame.yz : vec2(0.0), 0.0);
}

vec3 colorAt(int x, int y) { return toYcc(weighted(texelFetch(radianceTexture, ivec2(x, y), 0).rgb)); }

// Catmull-Rom along x and linear along y, plus the same with the axes exchanged, less bilinear: 12 texels. Dropping the
// corners of the product of two cubics would move the picture by some 0.006 pixels, on the same side in every frame of
// a steady motion. A still pixel ends after the first round, which has its own row.
vec4 historyAt(vec2 pixel, bool still, ivec2 last) {
    vec2 centre = floor(pixel - 0.5);
    vec2 f = pixel - 0.5 - centre, g = 1.0 - f;
    vec2 w0 = -kSharpness * f * g * g, w3 = -kSharpness * g * f * f;
    vec2 w1 = 1.0 + f * f * ((2.0 - kSharpness) * f - (3.0 - kSharpness));
    vec2 w2 = 1.0 - w0 - w1 - w3;
    ivec4 x = clamp(ivec4(centre.x) + ivec4(-1, 0, 1, 2), ivec4(0), ivec4(last.x));
    vec4 sum = vec4(0.0);
    int rounds = still ? 1 : 2;
    for (int i = 0; i < rounds; ++i) {   // an outer row, and the inner row beside it
        ivec2 y = clamp(ivec2(centre.y) + ivec2(3 * i - 1, i), ivec2(0), ivec2(last.y));
        float linear = i == 0 ? g.y : f.y, cubic = i == 0 ? w1.y : w2.y;
        vec2 outer = vec2(g.x, f.x) * (i == 0 ? w0.y : w3.y);
        vec2 inner = vec2(w1.x, w2.x) * linear + vec2(g.x, f.x) * (cubic - linear);
        sum += texelFetch(historyTexture, ivec2(x.y, y.x), 0) * outer.x +
               texelFetch(historyTexture, ivec2(x.z, y.x), 0) * outer.y +
               texelFetch(historyTexture, ivec2(x.x, y.y), 0) * (w0.x * linear) +
               texelFetch(historyTexture, ivec2(x.y, y.y), 0) * inner.x +
               texelFetch(historyTexture, ivec2(x.z, y.y), 0) * inner.y +
               texelFetch(historyTexture, ivec2(x.w, y.y), 0) * (w3.x * linear);
    }
    return max(sum, vec4(0.0));
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(radianceTexture, 0) - 1;
    vec4 now = texelFetch(radianceTexture, at, 0);
    vec3 current = toYcc(weighted(now.rgb));

    // Mean and deviation of 3 x 3 pixels: own and outward ones, and from the quad what lies towards its other pixels.
    vec2 side = vec2(1 - 2 * (at & 1));
    ivec2 outward = clamp(at - ivec2(side), ivec2(0), last);
    vec3 beside = colorAt(outward.x, at.y), above = colorAt(at.x, outward.y), corner = colorAt(outward.x, outward.y);
    vec3 current2 = current * current, beside2 = beside * beside, above2 = above * above;
    vec3 mean = current + beside + above + corner + besideX(current + above, side.x) +
                besideY(current + beside + besideX(current, side.x), side.y);
    vec3 square = current2 + beside2 + above2 + corner * corner + besideX(current2 + above2, side.x) +
                  besideY(current2 + beside2 + besideX(current2, side.x), side.y);
    mean /= 9.0;
    vec3 deviation = sqrt(max(square / 9.0 - mean * mean, vec3(0.0)));

    vec3 surface = motionAt(at, outward, side);
    vec2 motion = surface.xy;
    // A thousandth of a pixel is the rounding of 16-bit motion: such a pixel stands still and is fetched as it is.
    bool still = dot(motion, motion) < 1e-6;
    vec2 from = still ? gl_FragCoord.xy : gl_FragCoord.xy - motion;
    bool seen = frame.x == 0.0 && all(greaterThanEqual(from, vec2(0.0))) && all(lessThanEqual(from, vec2(last + 1)));
    vec4 before = historyAt(from, still, last);
    vec3 moments = texelFetch(historyMomentsTexture, clamp(ivec2(from), ivec2(0), last), 0).xyz;
    vec3 past = toYcc(weighted(before.rgb));
    // Where another surface was, its variance says nothing about this one: it would let the old picture through.
    bool known = still || (moments.z <= surface.z * kSameDepth && surface.z <= moments.z * kSameDepth);
    float age = seen ? (known ? moments.x : min(moments.x, 1.0)) : 0.0;
    float variance = seen && known ? moments.y : 0.0;

    vec3 box = deviation * kSpatialWidth + vec3(sqrt(variance) * (still ? kStillWidth : kMovingWidth)) + vec3(1e-4);
    vec3 off = past - mean;
    vec3 excess = abs(off) / box;
    float outside = max(excess.x, max(excess.y, excess.z));
    if (outside > 1.0) {
        past = mean + off / outside;
        age = min(age, max(kMovingHistory / outside, 2.0));   // what had to be clipped is worth fewer frames
    }

    age = seen ? min(age + 1.0, still ? kLongestHistory : kMovingHistory) : 1.0;
    float share = 1.0 / age;
    vec3 blended = mix(past, current, share);
    vec3 radiance = age > 1.0 ? unweighted(max(fromYcc(blended), vec3(0.0))) : now.rgb;
    outRadiance = vec4(radiance, seen ? mix(before.a, now.a, share) : now.a);
    float change = current.x - past.x;
    outMoments = vec4(age, seen ? mix(variance, change * change, share) : 0.0, surface.z, 0.0);
}
