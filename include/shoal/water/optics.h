// What water does to light: bending, Fresnel, absorption, scattering, named waters. Per channel R, G, B.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/core/params.h>
#include <shoal/core/result.h>

namespace shoal::water {

inline constexpr double kWaterIndex = 1.333;  // of refraction, at 589 nm and 20 C (IAPWS R9-97: 1.3330)

// Fraction of unpolarised light that passes a smooth surface from index 1 to `index` (below 1: total reflection
// possible, then 0). cosIncidence in [0, 1].
double fresnelTransmittance(double cosIncidence, double index);

// The [water] table's optical part.
struct OpticsParams {
    std::string medium = "jerlov-IB";
    Vec3 absorption{-1, -1, -1}, scattering{-1, -1, -1};  // 1/m; below 0: the medium's
    Vec3 diffuseAttenuation{-1, -1, -1};                  // Kd, 1/m; below 0: the medium's, or from a and b
    std::string phase = "henyey-greenstein";
    float anisotropy = 0.924f;
    float backscatter = 0.0183f;  // fournier-forand: chooses (n, mu)
    // Share of scattered light that stays in the beam; -1: the mean cosine squared (anisotropy^2). For fournier-forand
    // at least what is scattered by less than 0.04 degrees.
    float forwardFraction = -1;
    float index = float(kWaterIndex);
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, OpticsParams>
void visit(P& p, V&& v) {
    v(p.medium, Field{"medium",
                      "",
                      -1e30,
                      1e30,
                      "named water; clear has neither absorption nor scattering",
                      {"clear", "pure", "jerlov-I", "jerlov-IA", "jerlov-IB", "jerlov-II", "jerlov-III", "jerlov-1C",
                       "jerlov-3C", "jerlov-5C", "jerlov-7C", "jerlov-9C"}});
    v(p.absorption, Field{"absorption", "1/m", -1, 1000, "per channel, in place of the medium's; -1: the medium's"});
    v(p.scattering, Field{"scattering", "1/m", -1, 1000, "per channel, in place of the medium's; -1: the medium's"});
    v(p.diffuseAttenuation, Field{"diffuseAttenuation", "1/m", -1, 1000,
                                  "Kd of downwelling light; -1: the medium's, from a and b where those are given"});
    v(p.phase, Field{"phase", "", -1e30, 1e30, "how light scatters", {"henyey-greenstein", "fournier-forand"}});
    v(p.anisotropy, Field{"anisotropy", "", -0.99, 0.99, "mean cosine of scattering (Henyey-Greenstein g)"});
    v(p.backscatter, Field{"backscatter", "", 0.0001, 0.2, "fournier-forand: fraction scattered backwards"});
    v(p.forwardFraction, Field{"forwardFraction", "", -1, 0.999,
                               "share of scattered light that stays in the beam; -1: mean cosine squared"});
    v(p.index, Field{"index", "", 1.0001, 3, "index of refraction"});
}

// Resolved coefficients. The sharp beam (caustics, shafts) is dimmed by beamAttenuation() = a + b (1 - f), and scatters
// beamScattering() = b (1 - f) with the phase function that is left when the forward part f is taken out
// (delta-Eddington: g' = (g - f) / (1 - f)).
struct Optics {
    Vec3 absorption, scattering, diffuseAttenuation;  // 1/m
    float forwardFraction = 0;                        // f
    float index = float(kWaterIndex);
    enum class Phase { henyeyGreenstein, fournierForand } phase = Phase::henyeyGreenstein;
    float anisotropy = 0;                  // g' of the scattering that is not in the beam
    float ffIndex = 1.1f, ffSlope = 3.5f;  // Fournier-Forand n and mu
    float ffScale = 1;                     // makes the function integrate to 1
    float ffPeak = 1e-7f;  // Fournier-Forand without its beam: held below this sin^2 of half the angle [Potter 1970]
    Vec3 beamAttenuation() const { return absorption + scattering * (1 - forwardFraction); }
    Vec3 beamScattering() const { return scattering * (1 - forwardFraction); }
};
// Errors name the field: negative coefficients other than -1, absorption above Kd.
Result<Optics> resolveOptics(const OpticsParams& params);

// 1/sr, integrates to 1 over the sphere; cosTheta between the directions before and after (1: straight on). The same
// function as optics.lib.glsl's waterPhase.
float phaseFunction(const Optics& optics, float cosTheta);
// What waterPhase of optics.lib.glsl takes: (0, g', 0, 1) or (ffPeak, ffIndex, ffSlope, ffScale).
Vec4 phaseVector(const Optics& optics);

// Kd of light whose directions just below the surface have the mean cosine `cosBelow` in (0, 1] to the vertical:
// optics.diffuseAttenuation is that of light from straight above. Grows as 1 / cosBelow for b = 0, where the light
// that is left is the beam itself, and less where light is scattered [Kirk 1984].
Vec3 diffuseAttenuationAt(const Optics& optics, double cosBelow);

// A row of the table that resolveOptics reads.
struct NamedMedium {
    const char* name;
    Vec3 absorption, scattering, diffuseAttenuation;
    const char* source;  // and what was corrected
};
const std::vector<NamedMedium>& namedMedia();

}  // namespace shoal::water
