// What surfaces do with light: metal-rough microfacet reflection and Lambert diffuse. Compiled by C++ too.
// Sources:
//   [Walter et al. 2007] Microfacet Models for Refraction through Rough Surfaces (GGX).
//   [Heitz 2014] Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs (height-correlated Smith).
//   [Karis 2013] Real Shading in Unreal Engine 4 (split sum).
//   [Lagarde & de Rousiers 2014] Moving Frostbite to Physically Based Rendering (f90 of small f0, specular occlusion).
//   [Fdez-Aguera 2019; Turquin 2019] multiple scattering as a gain on the single-scattering lobe.
//   [Jimenez et al. 2016] Practical Realtime Strategies for Accurate Indirect Occlusion (colour of interreflection).
//   KHR_lights_punctual (Khronos): range window and cone.
// Departs: the split sum is our own rational fit. Against quadrature of the height-correlated lobe on 39 roughnesses x
// 50 angles the fit of [Karis 2014] (made for another masking term) is off by up to 0.47, this one by 0.030 (f0 = 1)
// and 0.013 (f0 = 0).
#ifndef SHOAL_FRAME_BRDF_LIB_GLSL
#define SHOAL_FRAME_BRDF_LIB_GLSL

#ifndef SHOAL_FUNCTION
#define SHOAL_FUNCTION
#endif

const float kInversePi = 0.31830988618f;
// Below it highlights are smaller than a pixel on any screen and 16-bit radiance overflows.
const float kLeastRoughness = 0.045f;

SHOAL_FUNCTION float pow5(float x) {
    float x2 = x * x;
    return x2 * x2 * x;
}

// alpha = roughness squared. Normal distribution, 1/sr.
SHOAL_FUNCTION float distributionGgx(float nDotH, float alpha) {
    float a2 = alpha * alpha;
    float d = (nDotH * a2 - nDotH) * nDotH + 1.0f;
    return a2 * kInversePi / (d * d);
}

// Masking-shadowing over 4 nDotL nDotV.
SHOAL_FUNCTION float visibilitySmith(float nDotV, float nDotL, float alpha) {
    float a2 = alpha * alpha;
    float v = nDotL * sqrt((nDotV - nDotV * a2) * nDotV + a2);
    float l = nDotV * sqrt((nDotL - nDotL * a2) * nDotL + a2);
    return 0.5f / max(v + l, 1e-6f);
}

// Reflectance at grazing angles: 1, but for materials that reflect less than any real one (f0 < 0.02), down to none for
// f0 = 0.
SHOAL_FUNCTION float grazingReflectance(vec3 f0) { return clamp(max(f0.x, max(f0.y, f0.z)) * 50.0f, 0.0f, 1.0f); }

SHOAL_FUNCTION vec3 fresnelSchlick(vec3 f0, float f90, float vDotH) {
    float f = pow5(clamp(1.0f - vDotH, 0.0f, 1.0f));
    return f0 * (1.0f - f) + vec3(f90 * f);
}

// Split sum: the lobe's albedo is f0 * x + f90 * y. x + y is the albedo for f0 = 1.
SHOAL_FUNCTION vec2 splitSum(float nDotV, float roughness) {
    float m = nDotV;
    float r = roughness;
    float lost = r *
                 (0.3834f + r * (-3.592f + 4.9324f * r) +
                  m * (19.211f + r * (-12.7966f + 43.9748f * r) + m * (-53.6012f + 114.3172f * r))) /
                 (1.0f + r * (-15.5781f + 42.8849f * r) + m * (34.305f + 20.0598f * r + 76.484f * m));
    float s = sqrt(m);
    float q = 1.0f - m;
    float grazing = q * q *
                    (0.9577f + r * (1.131f - 1.4457f * r) +
                     s * (-0.3934f + r * (-5.5275f + 3.7556f * r) + s * (-0.3413f + 2.6918f * r))) /
                    (1.0f + r * (3.534f + 11.3957f * r) + s * (-1.4939f - 16.5367f * r + 5.9607f * s));
    float all = clamp(1.0f - lost, 0.05f, 1.0f);
    grazing = clamp(grazing, 0.0f, all);
    return vec2(all - grazing, grazing);
}

// What multiple scattering between microfacets adds, as a factor on the single-scattering lobe; split: splitSum().
SHOAL_FUNCTION vec3 multipleScattering(vec3 f0, vec2 split) {
    return vec3(1.0f) + f0 * (1.0f / (split.x + split.y) - 1.0f);
}

// The lobe's albedo, multiple scattering included: 1 for f0 = 1.
SHOAL_FUNCTION vec3 specularAlbedo(vec3 f0, float f90, vec2 split) {
    return (f0 * split.x + vec3(f90 * split.y)) * multipleScattering(f0, split);
}

// Reflected part of the environment that occluders of the diffuse hemisphere leave [Lagarde & de Rousiers 2014, listing
// 26].
SHOAL_FUNCTION float specularOcclusion(float nDotV, float occlusion, float roughness) {
    return clamp(pow(nDotV + occlusion, exp2(-16.0f * roughness - 1.0f)) - 1.0f + occlusion, 0.0f, 1.0f);
}

// Occlusion with the light that the occluders themselves send back, for a surface among its own colour [Jimenez et al.
// 2016].
SHOAL_FUNCTION vec3 interreflection(float occlusion, vec3 albedo) {
    vec3 a = albedo * 2.0404f - 0.3324f;
    vec3 b = albedo * -4.7951f + 0.6417f;
    vec3 c = albedo * 2.7552f + 0.6903f;
    float x = occlusion;
    return max(vec3(x), ((a * x + b) * x + c) * x);
}

// Range window of a local light: 1 near, 0 from `range` on; range 0 reaches everywhere.
SHOAL_FUNCTION float rangeWindow(float distanceToLight, float range) {
    float ratio = range > 0.0f ? distanceToLight / range : 0.0f;
    float ratio2 = ratio * ratio;
    return clamp(1.0f - ratio2 * ratio2, 0.0f, 1.0f);
}

// Cone of a spot: cosine of the angle to its axis, scaled and shifted so that the inner cone is 1 and the outer 0.
SHOAL_FUNCTION float spotCone(float cosAngle, float scale, float offset) {
    float fade = clamp(cosAngle * scale + offset, 0.0f, 1.0f);
    return fade * fade;
}

// Level of the prefiltered environment for a roughness, of `levelCount` levels, and its inverse (for whole levels).
SHOAL_FUNCTION float levelOfRoughness(float roughness, float levelCount) {
    return (levelCount - 1.0f) * roughness * (1.7f - 0.7f * roughness);
}
SHOAL_FUNCTION float roughnessOfLevel(float level, float levelCount) {
    float t = level / (levelCount - 1.0f);
    return (1.7f - sqrt(max(2.89f - 2.8f * t, 0.0f))) / 1.4f;
}

// Direction (y up) to the square [0, 1]^2 of the prefiltered environment, and back. The square's border is where the
// lower half folds.
SHOAL_FUNCTION vec2 squareFromDirection(vec3 d) {
    float scale = 1.0f / (abs(d.x) + abs(d.y) + abs(d.z));
    float x = d.x * scale;
    float z = d.z * scale;
    float foldedX = (1.0f - abs(z)) * (x >= 0.0f ? 1.0f : -1.0f);
    float foldedZ = (1.0f - abs(x)) * (z >= 0.0f ? 1.0f : -1.0f);
    bool lower = d.y < 0.0f;
    return vec2((lower ? foldedX : x) * 0.5f + 0.5f, (lower ? foldedZ : z) * 0.5f + 0.5f);
}
SHOAL_FUNCTION vec3 directionFromSquare(vec2 square) {
    float x = square.x * 2.0f - 1.0f;
    float z = square.y * 2.0f - 1.0f;
    float y = 1.0f - abs(x) - abs(z);
    float fold = max(-y, 0.0f);
    return normalize(vec3(x - (x >= 0.0f ? fold : -fold), y, z - (z >= 0.0f ? fold : -fold)));
}

#endif
