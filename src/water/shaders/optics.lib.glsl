// Light at and in water; compiled by C++ too (scalars and vectors by value only).
// Sources: Fresnel's equations; Snell's law in vector form; [Henyey & Greenstein 1941]; [Fournier & Forand 1994] as
// given by [Fournier & Jonasz 1999]; its peak taken out as by [Potter 1970].
#ifndef SHOAL_WATER_OPTICS_LIB_GLSL
#define SHOAL_WATER_OPTICS_LIB_GLSL

#ifndef SHOAL_FUNCTION
#define SHOAL_FUNCTION
#endif

// Fraction of unpolarised light that passes from index 1 into `index`; cosIncidence in [0, 1].
SHOAL_FUNCTION float fresnelTransmittance(float cosIncidence, float index) {
    float sine2 = (1.0 - cosIncidence * cosIncidence) / (index * index);
    if (sine2 >= 1.0) return 0.0;
    float cosRefracted = sqrt(1.0 - sine2);
    float s = (cosIncidence - index * cosRefracted) / (cosIncidence + index * cosRefracted);
    float p = (index * cosIncidence - cosRefracted) / (index * cosIncidence + cosRefracted);
    return 1.0 - 0.5 * (s * s + p * p);
}

// Where light travels after the surface: direction unit, normal unit and against it. index: of the far side over the
// near one. Total reflection gives a vector of length 0.
SHOAL_FUNCTION vec3 refractedDirection(vec3 direction, vec3 normal, float index) {
    float cosIncidence = -dot(direction, normal);
    float cosRefracted2 = 1.0 - (1.0 - cosIncidence * cosIncidence) / (index * index);
    if (cosRefracted2 <= 0.0) return vec3(0.0);
    return direction / index + (cosIncidence / index - sqrt(cosRefracted2)) * normal;
}

// 1/sr, integrates to 1.
SHOAL_FUNCTION float phaseHenyeyGreenstein(float cosTheta, float g) {
    float d = 1.0 + g * g - 2.0 * g * cosTheta;
    return (1.0 - g * g) / (12.56637061 * d * sqrt(max(d, 1e-12)));
}

// 1/sr, before scaling. sine2: sin^2 of half the angle, above 0; index 1.0001 or more; 3 < slope < 5.
SHOAL_FUNCTION float phaseFournierForand(float sine2, float index, float slope) {
    float v = 0.5 * (3.0 - slope), steep = 4.0 / (3.0 * (index - 1.0) * (index - 1.0));
    float delta = steep * sine2, e = 1.0 - delta, power = pow(delta, v);
    // Both brackets over e^2; near e = 0 as binomial series, where they are small differences.
    float first = 0.0, second = 0.0;
    if (abs(e) < 0.15) {
        float a = 0.5 * v * (v - 1.0), b = 0.5 * (v + 1.0) * v;
        first = a, second = -b;
        a = a * (v - 2.0) / 3.0, b = b * (v - 1.0) / 3.0;
        first = first - a * e, second = second + b * e;
        a = a * (v - 3.0) / 4.0, b = b * (v - 2.0) / 4.0;
        first = first + a * e * e, second = second - b * e * e;
        a = a * (v - 4.0) / 5.0, b = b * (v - 3.0) / 5.0;
        first = first - a * e * e * e, second = second + b * e * e * e;
        a = a * (v - 5.0) / 6.0, b = b * (v - 4.0) / 6.0;
        first = first + a * e * e * e * e, second = second - b * e * e * e * e;
    } else {
        first = (v * e - (1.0 - power)) / (e * e);
        second = (delta * (1.0 - power) - v * e) / (e * e);
    }
    float backPower = pow(steep, v), cosTheta = 1.0 - 2.0 * sine2;
    float back = (1.0 - backPower) / (50.26548246 * (steep - 1.0) * backPower) * (3.0 * cosTheta * cosTheta - 1.0);
    return max((first + second / sine2) / (12.56637061 * power) + back, 0.0);
}

// 1/sr; integrates to 1 over the sphere. cosTheta: between the directions before and after (1: straight on). phase:
// Optics' phaseVector.
SHOAL_FUNCTION float waterPhase(float cosTheta, vec4 phase) {
    if (phase.x <= 0.0) return phaseHenyeyGreenstein(cosTheta, phase.y);
    float sine2 = clamp(0.5 - 0.5 * cosTheta, phase.x, 1.0);
    return phase.w * phaseFournierForand(sine2, phase.y, phase.z);
}

#endif
