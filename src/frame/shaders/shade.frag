#version 450 core
// Shades the G-buffer's surfaces. Drawn with fullscreen.vert and depth test LESS.
// Variants: NO_SUN, NO_LOCAL_LIGHTS (shading.lib.glsl); SUN_OVERRIDE and ENVIRONMENT_OVERRIDE take what LightOverrides
// gives; TERMS writes what the AOVs "direct" and "shadow" show.
#include "frame/shadow.io.glsl"
#include "frame/shading.lib.glsl"
#include "frame/gbuffer.lib.glsl"

layout(binding = SHOAL_UNIT_PASS + 0) uniform sampler2D albedoTexture;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D normalTexture;
layout(binding = SHOAL_UNIT_PASS + 2) uniform sampler2D materialTexture;
layout(binding = SHOAL_UNIT_PASS + 3) uniform sampler2D emissionTexture;
layout(binding = SHOAL_UNIT_PASS + 4) uniform sampler2D viewDepthTexture;
#ifdef SUN_OVERRIDE
layout(binding = SHOAL_UNIT_SUN_IRRADIANCE) uniform sampler2D sunIrradianceTexture;
#endif
#ifdef ENVIRONMENT_OVERRIDE
layout(binding = SHOAL_UNIT_ENVIRONMENT_IRRADIANCE) uniform sampler2D environmentIrradianceTexture;
#endif

layout(location = 0) out vec4 outRadiance;
#ifdef TERMS
layout(location = 1) out vec4 outDirect;
layout(location = 2) out float outShadow;
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 albedo = texelFetch(albedoTexture, at, 0);
    vec4 material = texelFetch(materialTexture, at, 0);
    float viewDepth = texelFetch(viewDepthTexture, at, 0).x;

    Surface s;
    s.position = positionOfPixel(gl_FragCoord.xy, viewDepth);
    s.normal = decodeNormal(texelFetch(normalTexture, at, 0).xy);
    s.baseColor = decodeAlbedo(albedo.rgb);
    s.roughness = material.x;
    s.metallic = material.y;
    s.f0 = decodeF0(material.z);
    s.occlusion = albedo.a;
    vec4 sunOwn = vec4(0.0), environmentOwn = vec4(0.0);
#ifdef SUN_OVERRIDE
    sunOwn = texelFetch(sunIrradianceTexture, at, 0);
#endif
#ifdef ENVIRONMENT_OVERRIDE
    environmentOwn = texelFetch(environmentIrradianceTexture, at, 0);
#endif
    float open = lightBlock.occlusion.x > 0.0 ? texelFetch(occlusionTexture, at, 0).x : 1.0;
    ShadingTerms t = shadeTerms(s, toEyeOfPixel(gl_FragCoord.xy), viewDepth, gl_FragCoord.xy, open, sunOwn,
                                environmentOwn);

    // Prelit and unlit surfaces (kFlagPrelit, kFlagUnlit) arrive with their radiance.
    float lit = decodeFlags(material.w) == 0u ? 1.0 : 0.0;
    vec3 direct = (t.sun + t.local) * lit;
    vec3 radiance = texelFetch(emissionTexture, at, 0).rgb + direct + t.environment * lit;
    outRadiance = vec4(min(radiance, vec3(65000.0)), 1.0);
#ifdef TERMS
    outDirect = vec4(min(direct, vec3(65000.0)), 1.0);
    outShadow = t.sunVisible;
#endif
}
