// Light at and in water; compiled by C++ too (scalars and vectors by value only).
// Sources: Fresnel's equations; Snell's law in vector form; [Henyey & Greenstein 1941]; [Fournier & Forand 1994].
#ifndef SHOAL_WATER_OPTICS_LIB_GLSL
#define SHOAL_WATER_OPTICS_LIB_GLSL

// Fraction of unpolarised light that passes from index 1 into `index`; cosIncidence in [0, 1].
float fresnelTransmittance(float cosIncidence, float index) {
    float sine2 = (1.0 - cosIncidence * cosIncidence) / (index * index);
    if (sine2 >= 1.0) return 0.0;
    float cosRefracted = sqrt(1.0 - sine2);
    float s = (cosIncidence - index * cosRefracted) / (cosIncidence + index * cosRefracted);
    float p = (index * cosIncidence - cosRefracted) / (index * cosIncidence + cosRefracted);
    return 1.0 - 0.5 * (s * s + p * p);
}

// Where light travels after the surface: direction unit, normal unit and against it. index: of the far side over the
// near one. Total reflection gives a vector of length 0.
vec3 refractedDirection(vec3 direction, vec3 normal, float index) {
    float cosIncidence = -dot(direction, normal);
    float cosRefracted2 = 1.0 - (1.0 - cosIncidence * cosIncidence) / (index * index);
    if (cosRefracted2 <= 0.0) return vec3(0.0);
    return direction / index + (cosIncidence / index - sqrt(cosRefracted2)) * normal;
}

#endif
