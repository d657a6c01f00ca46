#version 450 core
// Ambient occlusion at half resolution: how much of the cosine-weighted hemisphere is open, from horizons in the view
// depth.
// Sources: [Jimenez et al. 2016] Practical Realtime Strategies for Accurate Indirect Occlusion (GTAO); the distance
// falloff towards the surface's own horizon follows XeGTAO (Intel, 2021). The noise depends on the pixel and the sample
// alone.
// Writes (open fraction, view depth).
#include "frame/bindings.shared.h"
#include "frame/gbuffer.lib.glsl"

layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D normalTexture;
layout(binding = SHOAL_UNIT_PASS + 4) uniform sampler2D viewDepthTexture;
layout(location = 0) uniform vec4 pixelToView;    // view xy at depth 1 (orthographic: at any depth) = pixel * xy + zw
// x: radius m, y: pixels a metre at depth 1, z: 1 orthographic, w: noise turn in [0, 1)
layout(location = 1) uniform vec4 shape;
// x, y: weight of a sample at distance d is d * x + y; z, w: width, height
layout(location = 2) uniform vec4 falloff;
layout(location = 3) uniform mat4 viewFromWorld;

layout(location = 0) out vec2 outOpen;

const int kSlices = 2;
const int kSteps = 3;
const float kHalfPi = 1.57079632679;
// Farther than this part of the picture's height samples miss the structure between them.
const float kLargestRadius = 0.35;

// [Lagarde 2014] within 0.0003 rad of acos for x in [-1, 1].
float fastAcos(float x) {
    float a = abs(x);
    float r = ((-0.0187293 * a + 0.0742610) * a - 0.2121144) * a + 1.5707288;
    r *= sqrt(max(1.0 - a, 0.0));
    return x >= 0.0 ? r : 2.0 * kHalfPi - r;
}

vec3 viewPosition(vec2 pixel, float depth) {
    return vec3((pixel * pixelToView.xy + pixelToView.zw) * mix(depth, 1.0, shape.z), -depth);
}

// The cosine of the horizon on one side of the slice, raised by a sample at `pixel`. Samples less than some 2 degrees
// above the surface's plane do not count: rounded to whole pixels they lie beside the slice, and the facets of round
// things are no creases.
float raised(float horizon, float least, vec2 pixel, vec3 position, vec3 toEye, vec3 normal) {
    ivec2 at = clamp(ivec2(pixel), ivec2(0), ivec2(falloff.zw) - 1);
    float depth = texelFetch(viewDepthTexture, at, 0).x;
    vec3 delta = viewPosition(vec2(at) + 0.5, depth) - position;
    float away2 = dot(delta, delta);
    float scale = inversesqrt(max(away2, 1e-12));
    float weight = clamp(away2 * scale * falloff.x + falloff.y, 0.0, 1.0);
    weight *= clamp(dot(delta, normal) * scale * 25.0 - 0.25, 0.0, 1.0);
    weight = depth > 0.0 ? weight : 0.0;
    return max(horizon, mix(least, dot(delta, toEye) * scale, weight));
}

void main() {
    ivec2 half_ = ivec2(gl_FragCoord.xy);
    ivec2 at = min(half_ * 2, ivec2(falloff.zw) - 1);
    vec2 pixel = vec2(at) + 0.5;
    float depth = texelFetch(viewDepthTexture, at, 0).x;
    vec3 position = viewPosition(pixel, depth);
    vec3 toEye = shape.z > 0.0 ? vec3(0.0, 0.0, 1.0) : -normalize(position);
    vec3 normal = mat3(viewFromWorld) * decodeNormal(texelFetch(normalTexture, at, 0).xy);

    // Noise of a 4 x 4 tile, which the blur covers [Jimenez et al. 2016].
    float turn = fract(float((((half_.x + half_.y) & 3) << 2) + (half_.x & 3)) * (1.0 / 16.0) + shape.w);
    float shift = fract(float((half_.y - half_.x) & 3) * 0.25 + shape.w * 2.0);

    float radiusPx = min(shape.x * shape.y / mix(max(depth, 1e-6), 1.0, shape.z), kLargestRadius * falloff.w);
    // An orthonormal frame about toEye, whose z is positive [Duff et al. 2017].
    float a = 1.0 / (1.0 + toEye.z), b = -toEye.x * toEye.y * a;
    vec3 right = vec3(1.0 - toEye.x * toEye.x * a, b, -toEye.x), up = vec3(b, 1.0 - toEye.y * toEye.y * a, -toEye.y);
    float open = 0.0, all = 0.0;
    vec2 axis = vec2(cos(turn * kHalfPi), sin(turn * kHalfPi));
    for (int slice = 0; slice < kSlices; ++slice) {
        // The slice is the plane of toEye and `tangent`, even around toEye; on the screen it runs `along`.
        vec3 tangent = right * axis.x + up * axis.y;
        axis = vec2(-axis.y, axis.x);   // the second slice stands across the first
        vec3 across = cross(tangent, toEye);
        vec2 along = normalize(tangent.xy * toEye.z - toEye.xy * tangent.z);
        vec3 projected = normal - across * dot(normal, across);
        float projectedLength = max(length(projected), 1e-5);
        float cosNormal = clamp(dot(projected, toEye) / projectedLength, -1.0, 1.0);
        float side = dot(projected, tangent) >= 0.0 ? 1.0 : -1.0;
        float n = side * fastAcos(cosNormal);
        float sinNormal = side * sqrt(max(1.0 - cosNormal * cosNormal, 0.0));

        // The plane's own horizons: cos(n + pi/2) towards +along, cos(n - pi/2) the other way.
        float leastAhead = -sinNormal, leastBehind = sinNormal;
        float ahead = leastAhead, behind = leastBehind;
        for (int i = 0; i < kSteps; ++i) {
            float t = (float(i) + shift) / float(kSteps);
            vec2 offset = along * max(t * (0.4 + 0.6 * t) * radiusPx, float(i) + 1.5);   // denser near
            ahead = raised(ahead, leastAhead, pixel + offset, position, toEye, normal);
            behind = raised(behind, leastBehind, pixel - offset, position, toEye, normal);
        }
        behind = clamp(behind, -1.0, 1.0), ahead = clamp(ahead, -1.0, 1.0);
        float h0 = -fastAcos(behind), h1 = fastAcos(ahead);
        // cos(2 h0 - n) + cos(2 h1 - n) from the cosines that are there already.
        float bent = 2.0 * (behind * behind + ahead * ahead - 1.0) * cosNormal +
                     2.0 * (ahead * sqrt(1.0 - ahead * ahead) - behind * sqrt(1.0 - behind * behind)) * sinNormal;
        // [Jimenez et al. 2016] eq. 7: the arc between the horizons, weighted with the cosine to the normal.
        float arc = 2.0 * cosNormal + 2.0 * (h0 + h1) * sinNormal - bent;
        open += 0.25 * arc * projectedLength;
        all += (cosNormal + n * sinNormal) * projectedLength;   // the same with nothing in the way
    }
    // A few slices of an open plane sum to 1 only together with those of the pixels around: what counts is how much of
    // them is left.
    outOpen = vec2(depth > 0.0 ? open / max(all, 1e-4) : 1.0, depth);
}
