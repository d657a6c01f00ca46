#version 450 core
// What is behind everything: the environment (sharp or blurred) with the sun's disc, or a plain colour. Drawn with
// fullscreen.vert and depth test EQUAL. Variants: COLOR; SMOOTH for a map whose texels are larger than pixels.
#include "frame/brdf.lib.glsl"
#include "frame/lighting.io.glsl"

layout(location = 0) out vec4 outRadiance;

const float kTurn = 6.28318530718;

#ifndef COLOR
vec3 sharpRadiance(vec3 d) {
    vec2 latLong = vec2(0.5 + atan(d.x, -d.z) / kTurn + lightBlock.environment.w,
                        acos(clamp(d.y, -1.0, 1.0)) / (0.5 * kTurn));
#ifdef SMOOTH
    // Cubic B-spline by 4 bilinear fetches [Sigg & Hadwiger 2005]: bilinear alone draws stairs along bright edges.
    vec2 size = vec2(textureSize(sharpEnvironment, 0));
    vec2 at = latLong * size - 0.5, corner = floor(at), f = at - corner, g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0, w1 = 2.0 / 3.0 - 0.5 * f * f * (2.0 - f), w3 = f * f * f / 6.0, w2 = 1.0 - w0 - w1 - w3;
    vec2 low = (corner - 0.5 + w1 / (w0 + w1)) / size, high = (corner + 1.5 + w3 / (w2 + w3)) / size;
    vec2 share = w0 + w1;   // of the low side
    vec3 lowLow = textureLod(sharpEnvironment, low, 0.0).rgb;
    vec3 highLow = textureLod(sharpEnvironment, vec2(high.x, low.y), 0.0).rgb;
    vec3 lowHigh = textureLod(sharpEnvironment, vec2(low.x, high.y), 0.0).rgb;
    vec3 highHigh = textureLod(sharpEnvironment, high, 0.0).rgb;
    return mix(mix(highHigh, lowHigh, share.x), mix(highLow, lowLow, share.x), share.y);
#else
    return textureLod(sharpEnvironment, latLong, lightBlock.backgroundLevel.y).rgb;
#endif
}

vec3 blurredRadiance(vec3 d, float level) {
    vec2 square = squareFromDirection(d);
    float low = min(floor(level), lightBlock.environment.y - 2.0);
    float size = lightBlock.environment.z * exp2(-low);
    vec2 centre = vec2(0.5) - square;
    vec3 fine = textureLod(prefilteredEnvironment, square + centre / size, low).rgb;
    vec3 coarse = textureLod(prefilteredEnvironment, square + centre * 2.0 / size, low + 1.0).rgb;
    return mix(fine, coarse, level - low);
}
#endif

void main() {
#ifdef COLOR
    float coverage = lightBlock.background.w == float(SHOAL_BACKGROUND_TRANSPARENT) ? 0.0 : 1.0;
    outRadiance = vec4(lightBlock.background.rgb * coverage, coverage);
#else
    vec2 p = gl_FragCoord.xy;
    vec3 ray = lightBlock.backgroundRay.xyz + lightBlock.backgroundRayX.xyz * p.x + lightBlock.backgroundRayY.xyz * p.y;
    vec3 d = normalize(ray);
    float level = lightBlock.backgroundLevel.x;
    vec3 radiance = level < 0.0 ? sharpRadiance(d) : blurredRadiance(d, level);
    float disc = smoothstep(lightBlock.sunEdge.y, lightBlock.sunEdge.x, dot(d, lightBlock.toSun.xyz));
    outRadiance = vec4(min(radiance * lightBlock.environment.x + lightBlock.sunDisc.rgb * disc, vec3(65000.0)), 1.0);
#endif
}
