// What level water scatters to the eye along a straight path, in closed form: the sun's beam, and the smooth light that
// comes from all of the water above (veiling light). FOURNIER_FORAND: the phase function is theirs.
// Sources: note on underwater light in docs/references.md: [Mobley 1994] for diffuse attenuation and mean cosines.
#ifndef SHOAL_WATER_SHAFT_SUN_IO_GLSL
#define SHOAL_WATER_SHAFT_SUN_IO_GLSL

#include "water/optics.lib.glsl"
#include "water/water.shared.h"

const float kInverse4Pi = 0.0795774715;
const float kMeanCosine = 0.8;      // of smooth light: its fluence is irradiance on a level plane over this
const float kSkyThrough = 0.934;    // of an even sky's light, into water

// Integral of exp(-k t) from 0 to s.
float decayOver(float k, float s) {
    float x = k * s;
    return abs(x) < 1e-3 ? s * (1.0 - 0.5 * x) : (1.0 - exp(-x)) / k;
}
vec3 decayOver(vec3 k, float s) { return vec3(decayOver(k.x, s), decayOver(k.y, s), decayOver(k.z, s)); }

// Integral of exp(-a - k t) from 0 to s; a + k s is hardly negative (light grows no brighter than it came in), k may be
// so large below 0 that exp(-k s) is infinite.
vec3 dimmedOver(vec3 k, float s, vec3 a) {
    vec3 x = k * s, from = exp(-a);
    return mix((from - exp(-a - x)) / k, from * (s * (1.0 - 0.5 * x)), lessThan(abs(x), vec3(1e-3)));
}

// What paths are compared by: metres, less and less of them the farther away they are and the dimmer.
float seenLength(float lengthM) { return lengthM / (1.0 + waterBlock.beamAttenuation.w * lengthM); }

// decayOver but for 3 %, without powers: what light is kept over at reduced size and multiplied by at full size, so that
// what they differ by cancels.
vec3 likeDecayOver(vec3 k, float s) {
    vec3 x = k * s, near = clamp(x, vec3(-3.0), vec3(3.0));
    return s / (1.0 + 0.5 * (near + max(x - 3.0, vec3(0.0)) * 2.0) + near * near * (1.0 / 12.0));
}

// 1/sr.
float shaftPhase(float cosTheta) {
#ifdef FOURNIER_FORAND
    return waterPhase(cosTheta, waterBlock.phase);
#else
    return phaseHenyeyGreenstein(cosTheta, waterBlock.phase.y);
#endif
}

// How fast the beam's scattered light falls along a path away from the eye, from the y of its unit direction: dimmed on
// its way down to the path and back along it, 1/m.
vec3 beamDecay(float directionY) {
    return waterBlock.beamAttenuation.rgb * (1.0 + directionY / waterBlock.sunRefracted.y);
}

// W/(m3 sr) that the sun's beam scatters along a path at its start; depth: of that below the level.
vec3 levelWaterBeam(float depth, vec3 direction) {
    float cosMean = -waterBlock.sunRefracted.y;
    vec3 beam = waterBlock.sunIrradiance.rgb * (waterBlock.toSun.y * waterBlock.sunRefracted.w / cosMean);
    vec3 arriving = beam * exp(-waterBlock.beamAttenuation.rgb * (depth / cosMean));
    return waterBlock.beamScattering.rgb * arriving * shaftPhase(-dot(waterBlock.sunRefracted.xyz, direction));
}

// W/(m2 sr) of light without direction: the sky's, and what the beam has lost but the water still carries down; open:
// the share of the beam that got into the water thereabouts.
vec3 veilingLight(float depth, vec3 direction, float lengthM, float open) {
    if (lengthM <= 0.0) return vec3(0.0);
    vec3 beam = waterBlock.beamAttenuation.rgb, kd = waterBlock.diffuseAttenuation.rgb;
    vec3 kdSun = waterBlock.sunDiffuseAttenuation.rgb;
    vec3 sky = waterBlock.skyIrradiance.rgb * kSkyThrough *
               dimmedOver(beam - kd * direction.y, lengthM, kd * depth);
    float cosMean = -waterBlock.sunRefracted.y;
    vec3 level = waterBlock.sunIrradiance.rgb * (waterBlock.toSun.y * waterBlock.sunRefracted.w);
    vec3 all = dimmedOver(beam - kdSun * direction.y, lengthM, kdSun * depth);
    vec3 sharp = dimmedOver(beamDecay(direction.y), lengthM, beam * (depth / cosMean));
    // Where diffuse attenuation is the stronger one there is no such light at any depth.
    vec3 smoothed = mix(max(all - sharp, vec3(0.0)), vec3(0.0), greaterThanEqual(kdSun, beam / cosMean));
    return waterBlock.beamScattering.rgb * (sky + level * (smoothed * open)) * (kInverse4Pi / kMeanCosine);
}

#endif
