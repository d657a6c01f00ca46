#version 450 core
// Temporal antialiasing: the history, fetched from where the surface was, confined to what is likely here, blended with
// this frame.
// Sources: [Karis 2014] High Quality Temporal Supersampling; [Salvi 2016] An Excursion in Temporal Supersampling
// (variance clipping);
// [Jimenez 2016] Filmic SMAA (Catmull-Rom in 5 fetches).
// Departs: the history also carries the variance of the pixel's own luminance over time, which widens the clipping box.
// A detail that only some jitters hit is so kept on a still view, where the box of a frame that misses it would wipe it
// out and flicker.
// Blending happens on c w(c), w = displayWeight: what a supersampled picture shows is the limit.
#include "frame/bindings.shared.h"
#include "frame/exposure.io.glsl"

layout(binding = SHOAL_UNIT_PASS + 0) uniform sampler2D radianceTexture;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D viewDepthTexture;
layout(binding = SHOAL_UNIT_PASS + 2) uniform sampler2D motionTexture;
layout(binding = SHOAL_UNIT_PASS + 3) uniform sampler2D historyTexture;          // linear filter
layout(binding = SHOAL_UNIT_PASS + 4) uniform sampler2D historyMomentsTexture;   // linear filter
layout(location = 0) uniform vec4 frame;          // x: 1 drops the history, yz: 1 / size, w: unused
// Previous clip xyw of what lies at infinity in pixel p: behind + p.x behindX + p.y behindY.
layout(location = 1) uniform vec4 behind;
layout(location = 2) uniform vec4 behindX;
layout(location = 3) uniform vec4 behindY;

layout(location = 0) out vec4 outRadiance;
layout(location = 1) out vec2 outMoments;         // x: frames in the history / 256, y: mean squared weighted luminance

const float kLongestHistory = 64.0;   // frames, on a still view
const float kMovingHistory = 12.0;    // frames, where the history is resampled
const float kSpatialWidth = 1.25;     // half width of the box in standard deviations of the neighbourhood
const float kTemporalWidth = 2.0;     // and of the pixel over time

vec3 weighted(vec3 c) { return c * (exposureState.antialiasing / (1.0 + luminanceOf(c) * exposureState.antialiasing)); }
vec3 unweighted(vec3 t) { return t / (exposureState.antialiasing * max(1.0 - luminanceOf(t), 1e-4)); }

// Luminance first, so that its variance is the box's first axis.
vec3 toYcc(vec3 c) { return vec3(luminanceOf(c), 0.5 * (c.r - c.b), -0.25 * c.r + 0.5 * c.g - 0.25 * c.b); }
vec3 fromYcc(vec3 y) { return vec3(y.x) + vec3(0.8596, -0.1404, -1.1404) * y.y + vec3(-1.4304, 0.5696, -1.4304) * y.z; }

// Where this pixel's surface was, in pixels back. The nearest of the pixels around decides, so that edges move with
// what is in front.
vec2 motionAt(ivec2 at, ivec2 last) {
    ivec2 nearest = at;
    float depth = texelFetch(viewDepthTexture, at, 0).x;
    for (int i = 0; i < 4; ++i) {
        ivec2 other = clamp(at + ivec2((i & 1) * 2 - 1, (i & 2) - 1), ivec2(0), last);
        float otherDepth = texelFetch(viewDepthTexture, other, 0).x;
        if (otherDepth > 0.0 && (depth == 0.0 || otherDepth < depth)) {
            depth = otherDepth;
            nearest = other;
        }
    }
    if (depth > 0.0) return texelFetch(motionTexture, nearest, 0).xy;
    vec2 pixel = vec2(at) + 0.5;
    vec3 clip = behind.xyz + behindX.xyz * pixel.x + behindY.xyz * pixel.y;
    return clip.z > 0.0 ? pixel - (clip.xy / clip.z * 0.5 + 0.5) / frame.yz : vec2(0.0);
}

// Catmull-Rom of 4 x 4 texels by 5 bilinear fetches: the corners, which weigh 0.4 % at most, are left out.
vec4 historyAt(vec2 pixel) {
    vec2 centre = floor(pixel - 0.5) + 0.5;
    vec2 f = pixel - centre;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f));
    vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f);
    vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f));
    vec2 w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w12 = w1 + w2;
    vec2 before = (centre - 1.0) * frame.yz, middle = (centre + w2 / w12) * frame.yz, after = (centre + 2.0) * frame.yz;
    vec4 sum = textureLod(historyTexture, middle, 0.0) * (w12.x * w12.y) +
               textureLod(historyTexture, vec2(middle.x, before.y), 0.0) * (w12.x * w0.y) +
               textureLod(historyTexture, vec2(before.x, middle.y), 0.0) * (w0.x * w12.y) +
               textureLod(historyTexture, vec2(after.x, middle.y), 0.0) * (w3.x * w12.y) +
               textureLod(historyTexture, vec2(middle.x, after.y), 0.0) * (w12.x * w3.y);
    float weights = w12.x * (w12.y + w0.y + w3.y) + (w0.x + w3.x) * w12.y;
    return max(sum / weights, vec4(0.0));
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(radianceTexture, 0) - 1;
    vec4 now = texelFetch(radianceTexture, at, 0);
    vec3 current = toYcc(weighted(now.rgb));
    if (frame.x > 0.0) {
        outRadiance = now;
        outMoments = vec2(1.0 / 256.0, current.x * current.x);
        return;
    }

    vec3 mean = current, square = current * current;
    for (int i = 0; i < 8; ++i) {
        int k = i < 4 ? i : i + 1;
        ivec2 other = clamp(at + ivec2(k % 3 - 1, k / 3 - 1), ivec2(0), last);
        vec3 c = toYcc(weighted(texelFetch(radianceTexture, other, 0).rgb));
        mean += c;
        square += c * c;
    }
    mean /= 9.0;
    vec3 deviation = sqrt(max(square / 9.0 - mean * mean, vec3(0.0)));

    vec2 motion = motionAt(at, last);
    vec2 from = gl_FragCoord.xy - motion;
    vec2 fromUv = from * frame.yz;
    bool seen = all(greaterThanEqual(fromUv, vec2(0.0))) && all(lessThanEqual(fromUv, vec2(1.0)));
    // A thousandth of a pixel is the rounding of 16-bit motion: such a pixel stands still and is fetched as it is.
    bool still = dot(motion, motion) < 1e-6;
    vec4 before = still ? texelFetch(historyTexture, at, 0) : historyAt(from);
    vec2 moments =
        still ? texelFetch(historyMomentsTexture, at, 0).xy : textureLod(historyMomentsTexture, fromUv, 0.0).xy;
    vec3 past = toYcc(weighted(before.rgb));
    float age = seen ? moments.x * 256.0 : 0.0;

    float wander = still ? sqrt(max(moments.y - past.x * past.x, 0.0)) : 0.0;
    vec3 box = deviation * kSpatialWidth + vec3(wander * kTemporalWidth) + vec3(1e-4);
    vec3 off = past - mean;
    vec3 excess = abs(off) / box;
    float outside = max(excess.x, max(excess.y, excess.z));
    if (outside > 1.0) {
        past = mean + off / outside;
        age = min(age, max(kMovingHistory / outside, 2.0));   // what had to be clipped is worth fewer frames
    }

    age = min(age + 1.0, still ? kLongestHistory : kMovingHistory);
    float share = 1.0 / age;
    vec3 blended = mix(past, current, share);
    outRadiance = vec4(unweighted(max(fromYcc(blended), vec3(0.0))), mix(seen ? before.a : now.a, now.a, share));
    outMoments = vec2(age / 256.0, mix(moments.y, current.x * current.x, share));
}
