#version 450 core
// What is behind everything: the environment (sharp or blurred) with the sun's disc, or a plain colour. Drawn with fullscreen.vert and
// depth test EQUAL. Variant: COLOR.
#include "frame/brdf.lib.glsl"
#include "frame/lighting.io.glsl"

layout(location = 0) out vec4 outRadiance;

const float kTurn = 6.28318530718;

#ifndef COLOR
vec3 sharpRadiance(vec3 d) {
    vec2 latLong = vec2(0.5 + atan(d.x, -d.z) / kTurn + lightBlock.environment.w, acos(clamp(d.y, -1.0, 1.0)) / (0.5 * kTurn));
    return textureLod(sharpEnvironment, latLong, lightBlock.backgroundLevel.y).rgb;
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
    vec3 d = normalize(lightBlock.backgroundRay.xyz + lightBlock.backgroundRayX.xyz * p.x + lightBlock.backgroundRayY.xyz * p.y);
    vec3 radiance = lightBlock.backgroundLevel.x < 0.0 ? sharpRadiance(d) : blurredRadiance(d, lightBlock.backgroundLevel.x);
    float disc = smoothstep(lightBlock.sunEdge.y, lightBlock.sunEdge.x, dot(d, lightBlock.toSun.xyz));
    outRadiance = vec4(min(radiance * lightBlock.environment.x + lightBlock.sunDisc.rgb * disc, vec3(65000.0)), 1.0);
#endif
}
