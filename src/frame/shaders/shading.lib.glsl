// Radiance of a surface: sun, local lights and environment. Include shadow.io.glsl (sunVisibility, spotVisibility)
// before it.
// Sources: brdf.lib.glsl; [Karis 2013] for the disc of the sun as a wider lobe.
// NO_SUN and NO_LOCAL_LIGHTS leave those out at compile time: llvmpipe runs both sides of an `if` (at 1280x720 on 2
// cores the sun's shadow is 90 ms and a loop over no local lights 13 ms of time for nothing).
#ifndef SHOAL_FRAME_SHADING_LIB_GLSL
#define SHOAL_FRAME_SHADING_LIB_GLSL

#include "frame/brdf.lib.glsl"
#include "frame/lighting.io.glsl"

struct Surface {
    vec3 position;     // world
    vec3 normal;       // world, unit
    vec3 baseColor;    // linear
    float metallic;
    float roughness;   // perceptual
    float f0;          // of the dielectric part
    float occlusion;   // of the material, 1 open
};

// What shading derives from a surface once for all lights.
struct Lobes {
    vec3 normal;
    vec3 toEye;
    float nDotV;
    float alpha;
    float roughness;
    vec3 diffuse;      // albedo of what is not reflected specularly
    vec3 f0;
    float f90;
    vec3 gain;         // of multiple scattering
    vec3 specular;     // albedo of the specular lobe
};

// Direct light by source; the whole radiance is sun + local + environment.
struct ShadingTerms {
    vec3 sun;
    vec3 local;
    vec3 environment;
    float sunVisible;
};

Lobes lobesOf(Surface s, vec3 toEye) {
    Lobes l;
    // A normal map can turn the normal away from the eye; it is bent back as far as needed.
    float facing = dot(s.normal, toEye);
    l.normal = facing < 1e-3 ? normalize(s.normal + toEye * (1e-3 - facing)) : s.normal;
    l.toEye = toEye;
    l.nDotV = clamp(dot(l.normal, toEye), 1e-3, 1.0);
    l.roughness = max(s.roughness, kLeastRoughness);
    l.alpha = l.roughness * l.roughness;
    l.f0 = mix(vec3(s.f0), s.baseColor, s.metallic);
    l.f90 = grazingReflectance(l.f0);
    vec2 split = splitSum(l.nDotV, l.roughness);
    l.gain = multipleScattering(l.f0, split);
    l.specular = (l.f0 * split.x + l.f90 * split.y) * l.gain;
    l.diffuse = s.baseColor * (1.0 - s.metallic) * (1.0 - l.specular);
    return l;
}

// Radiance per irradiance on the surface's own plane (BRDF) for light from toLight; widening: added to alpha for
// sources with a size.
vec3 reflectance(Lobes l, vec3 toLight, float nDotL, float widening) {
    vec3 h = normalize(toLight + l.toEye);
    float nDotH = clamp(dot(l.normal, h), 0.0, 1.0);
    float vDotH = clamp(dot(l.toEye, h), 0.0, 1.0);
    float alpha = min(l.alpha + widening, 1.0);
    vec3 specular = fresnelSchlick(l.f0, l.f90, vDotH) * l.gain *
                    (distributionGgx(nDotH, alpha) * visibilitySmith(l.nDotV, nDotL, alpha));
    return l.diffuse * kInversePi + specular;
}

vec3 environmentIrradianceOverPi(vec3 n) {
    vec3 e = lightBlock.irradiance[0].rgb + lightBlock.irradiance[1].rgb * n.y + lightBlock.irradiance[2].rgb * n.z +
             lightBlock.irradiance[3].rgb * n.x + lightBlock.irradiance[4].rgb * (n.x * n.y) +
             lightBlock.irradiance[5].rgb * (n.y * n.z) + lightBlock.irradiance[6].rgb * (n.z * n.z) +
             lightBlock.irradiance[7].rgb * (n.x * n.z) + lightBlock.irradiance[8].rgb * (n.x * n.x - n.y * n.y);
    return max(e, vec3(0.0));
}

// Prefiltered radiance around a direction. Neighbouring levels are blended here, not by the sampler: each level's
// border texels lie exactly on the fold, so that coordinates differ from level to level.
vec3 prefilteredRadiance(vec3 direction, float level) {
    vec2 square = squareFromDirection(direction);
    float low = min(floor(level), lightBlock.environment.y - 2.0);
    float size = lightBlock.environment.z * exp2(-low);
    vec2 coarse = square + (vec2(0.5) - square) * (2.0 / size);
    vec2 fine = square + (vec2(0.5) - square) * (1.0 / size);
    vec3 a = textureLod(prefilteredEnvironment, fine, low).rgb;
    vec3 b = textureLod(prefilteredEnvironment, coarse, low + 1.0).rgb;
    return mix(a, b, level - low);
}

// Radiance by the environment; ambientOcclusion: screen space times material, 1 open.
// own: LightOverrides::environmentIrradiance.
vec3 environmentTerm(Lobes l, vec3 baseColor, float ambientOcclusion, vec4 own) {
    vec3 irradiance = environmentIrradianceOverPi(l.normal) * (1.0 - own.a) + own.rgb;
    vec3 diffuse = l.diffuse * irradiance * interreflection(ambientOcclusion, baseColor);
    // The lobe leans from the mirror direction to the normal as it widens [Lagarde & de Rousiers 2014, listing 23].
    vec3 mirrored = reflect(-l.toEye, l.normal);
    float lean = (1.0 - l.alpha) * (sqrt(1.0 - l.alpha) + l.alpha);
    vec3 direction = mix(l.normal, mirrored, lean);
    float level = levelOfRoughness(l.roughness, lightBlock.environment.y);
    vec3 around = prefilteredRadiance(direction, level) * (lightBlock.environment.x * (1.0 - own.a)) + own.rgb;
    float open = specularOcclusion(l.nDotV, ambientOcclusion, l.roughness);
    return diffuse + around * l.specular * open;
}

// replaced: share of the lamps above the medium's level that a technique takes the place of.
vec3 localLightTerm(Lobes l, vec3 position, vec3 shadowNormal, float replaced) {
    vec3 sum = vec3(0.0);
    float depth = lightBlock.medium.w - position.y;
    int count = int(lightBlock.lightCount.x);
    for (int i = 0; i < count; ++i) {
        LocalLight light = localLights[i];
        vec3 toLight = light.position.xyz - position;
        float away = max(length(toLight), 1e-6);
        toLight /= away;
        float nDotL = dot(l.normal, toLight);
        float cosAxis = -dot(light.direction.xyz, toLight);
        float reach = rangeWindow(away, light.position.w) * spotCone(cosAxis, light.cone.x, light.cone.y);
        if (nDotL <= 0.0 || reach <= 0.0) continue;
        float lampDepth = lightBlock.medium.w - light.position.y;
        reach *= lampDepth < 0.0 ? 1.0 - replaced : 1.0;
        // Metres of the way in the medium.
        float wet = away * (max(depth, 0.0) + max(lampDepth, 0.0)) /
                    max(abs(depth) + abs(lampDepth), 1e-6);
        float nearest = max(away, light.direction.w);
        float visible = light.intensity.w < 0.0 ? 1.0 : spotVisibility(int(light.intensity.w), position, shadowNormal);
        vec3 irradiance = light.intensity.rgb * exp(-lightBlock.medium.rgb * wet) *
                          (reach * visible * nDotL / (nearest * nearest));
        sum += irradiance * reflectance(l, toLight, nDotL, 0.5 * light.direction.w / nearest);
    }
    return sum;
}

// sunOwn, environmentOwn: of LightOverrides.
ShadingTerms shadeTerms(Surface s, vec3 toEye, float viewDepth, vec2 pixel, float ambientOcclusion, vec4 sunOwn,
                        vec4 environmentOwn) {
    Lobes l = lobesOf(s, toEye);
    ShadingTerms t;
    t.sun = sunOwn.rgb * (l.diffuse + l.specular) * kInversePi;
    t.sunVisible = 1.0;
#ifndef NO_SUN
    if (lightBlock.toSun.w > 0.0) {
        float nDotL = clamp(dot(l.normal, lightBlock.toSun.xyz), 0.0, 1.0);
        bool shadowed = lightBlock.sunDisc.w > 0.0;
        t.sunVisible = shadowed ? sunVisibility(s.position, s.normal, viewDepth, pixel) : 1.0;
        if (nDotL <= 0.0) t.sunVisible = 0.0;
        vec3 irradiance = lightBlock.sunIrradiance.rgb * (nDotL * t.sunVisible * (1.0 - sunOwn.a));
        t.sun += irradiance * reflectance(l, lightBlock.toSun.xyz, max(nDotL, 0.05), lightBlock.sunIrradiance.w);
    }
#endif
#ifdef NO_LOCAL_LIGHTS
    t.local = vec3(0.0);
#else
    t.local = localLightTerm(l, s.position, s.normal, sunOwn.a);
#endif
    t.environment = environmentTerm(l, s.baseColor, ambientOcclusion * s.occlusion, environmentOwn);
    return t;
}

// Radiance to the eye, W/(m2 sr). toEye unit; viewDepth m; pixel: gl_FragCoord.xy; ambientOcclusion in screen space, 1
// open.
vec3 shadeSurface(Surface s, vec3 toEye, float viewDepth, vec2 pixel, float ambientOcclusion) {
    ShadingTerms t = shadeTerms(s, toEye, viewDepth, pixel, ambientOcclusion, vec4(0.0), vec4(0.0));
    return t.sun + t.local + t.environment;
}

// World position of a pixel at a view depth, and the unit direction to the eye from there.
vec3 positionOfPixel(vec2 pixel, float viewDepth) {
    vec3 origin = lightBlock.origin.xyz + lightBlock.originX.xyz * pixel.x + lightBlock.originY.xyz * pixel.y;
    vec3 ray = lightBlock.ray.xyz + lightBlock.rayX.xyz * pixel.x + lightBlock.rayY.xyz * pixel.y;
    return origin + ray * viewDepth;
}
vec3 toEyeOfPixel(vec2 pixel) {
    return -normalize(lightBlock.ray.xyz + lightBlock.rayX.xyz * pixel.x + lightBlock.rayY.xyz * pixel.y);
}

#endif
