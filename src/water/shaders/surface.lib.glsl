// Light at a rough water surface; compiled by C++ too (scalars and vectors by value only). Include optics.lib.glsl
// before it.
// Sources:
//   [Walter et al. 2007] Microfacet Models for Refraction through Rough Surfaces (reflection, transmission, shadowing).
//   [Cox & Munk 1954] the sea's slopes are spread as a bell curve.
//   [Bruneton et al. 2010] Real-time Realistic Ocean Lighting (mean Fresnel reflectance of rough water).
#ifndef SHOAL_WATER_SURFACE_LIB_GLSL
#define SHOAL_WATER_SURFACE_LIB_GLSL

// C++ defines it as `inline`.
#ifndef SHOAL_FUNCTION
#define SHOAL_FUNCTION
#endif

// Fraction that water of `index` reflects of light from the air whose slopes vary by `variance` an axis about the
// normal; cosIncidence in [0, 1]. Exact for variance 0.
SHOAL_FUNCTION float roughReflectance(float cosIncidence, float index, float variance) {
    float r0 = (index - 1.0f) / (index + 1.0f);
    r0 = r0 * r0;
    float flat_ = 1.0f - fresnelTransmittance(cosIncidence, index);
    float lobe = clamp((flat_ - r0) / (1.0f - r0), 1e-6f, 1.0f);
    float spread = sqrt(variance);
    float rough = pow(lobe, exp(-2.69f * spread)) / (1.0f + 22.7f * spread * sqrt(spread));
    return mix(flat_, r0 + (1.0f - r0) * rough, min(variance * 1e6f, 1.0f));
}

// Cosine that stands for the slopes' share of what is seen at cosine c, seen at grazing angles: c (1 + Lambda) of
// [Walter et al. 2007], within 6 %.
SHOAL_FUNCTION float seenCosine(float c, float variance) { return sqrt(c * c + variance * 0.15915494f); }

// The microfacets' distribution D of [Walter et al. 2007] for slopes spread as a bell of `variance` an axis; cosH: of
// the facet's normal with the mean one.
SHOAL_FUNCTION float slopeDensity(float cosH, float variance) {
    float cos2 = max(cosH * cosH, 1e-4f);
    float slope2 = (1.0f - cos2) / cos2;
    return exp(-slope2 / (2.0f * variance)) / (6.28318531f * variance * cos2 * cos2);
}

#endif
