#version 450 core
// Radiance to display values: bloom, exposure, tone curve, look, and noise of half a step of 8 bits against banding.
// Variants: ACCUMULATED (display_source.io.glsl), BLOOM, LOOK, CURVE_AGX, CURVE_PLAIN, else no curve and no noise.
#include "frame/display_source.io.glsl"
#include "frame/exposure.io.glsl"
#include "frame/tonemap.lib.glsl"

#ifdef BLOOM
layout(binding = SHOAL_UNIT_PASS + 2) uniform sampler2D bloomTexture;   // half resolution, linear filter
#endif
// x: factor, y: 1 multiplies the measured exposure in, z: bloom
layout(location = 0) uniform vec4 exposure;
layout(location = 1) uniform vec4 look;       // x: saturation, y: contrast

layout(location = 0) out vec4 outDisplay;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 source = displaySource(at);
#ifdef BLOOM
    vec2 uv = gl_FragCoord.xy / (2.0 * vec2(textureSize(bloomTexture, 0)));
    source.rgb = mix(source.rgb, textureLod(bloomTexture, uv, 0.0).rgb, exposure.z);
#endif
    float factor = exposure.x * (exposure.y > 0.0 ? exposureState.adapted : 1.0);
    vec3 radiance = source.rgb * (source.a > 0.0 ? factor / source.a : 0.0);
#if defined(CURVE_AGX)
    vec3 display = displayByAgx(radiance);
#elif defined(CURVE_PLAIN)
    vec3 display = displayByPlain(radiance);
#else
    vec3 display = displayByNone(radiance);
#endif
#ifdef LOOK
    display = applyLook(display, look.x, look.y);
#endif
#if defined(CURVE_AGX) || defined(CURVE_PLAIN)
    display += (interleavedNoise(gl_FragCoord.xy) - 0.5) / 255.0;
#endif
    outDisplay = vec4(clamp(display, 0.0, 1.0), source.a);
}
