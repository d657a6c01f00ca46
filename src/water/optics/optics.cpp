// Fresnel's equations; delta-Eddington [Joseph, Wiscombe & Weinman 1976]; Kd from absorption and scattering [Kirk
// 1984].
#include <cmath>
#include <cstdio>

#include <shoal/water/optics.h>

#include "water/optics/phase.h"

namespace shoal::water {
namespace {

constexpr float kSharpest = 0.99f;   // Henyey-Greenstein's g stays within
constexpr double kLeastPeak = 1e-7;  // sin^2 of half the angle: the function grows without end towards 0
constexpr const char* kChannels[3] = {"red", "green", "blue"};

float& channel(Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }
float channel(const Vec3& v, int i) { return i == 0 ? v.x : i == 1 ? v.y : v.z; }

std::string number(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", double(value));
    return text;
}

// Kirk's Kd averaged over the euphotic zone, for light of mean cosine mu below the surface.
double kirk(double a, double b, double mu) {
    const double g = std::max(0.473 * mu - 0.218, 0.0);
    return std::sqrt(a * a + g * a * b) / mu;
}

// The medium's coefficient where the parameter is -1.
Result<Vec3> chosen(const char* field, Vec3 given, Vec3 medium) {
    for (int i = 0; i < 3; ++i) {
        const float v = channel(given, i);
        if (v < 0 && v != -1)
            return badInput(std::string(field) + " is " + number(v) + " in " + kChannels[i] +
                            ", expected 0 or more, or -1 for the medium's");
        if (v < 0) channel(given, i) = channel(medium, i);
    }
    return given;
}

Result<void> choosePhase(const OpticsParams& params, Optics& optics) {
    if (params.phase == "henyey-greenstein") {
        const float g = params.anisotropy;
        const float f = params.forwardFraction >= 0 ? params.forwardFraction : (g > 0 ? g * g : 0.0f);
        optics.forwardFraction = f;
        optics.anisotropy = (g - f) / (1 - f);
        if (optics.anisotropy < -kSharpest)
            return badInput("water.forwardFraction is " + number(f) + ", expected at most " +
                            number((g + kSharpest) / (1 + kSharpest)) + " for an anisotropy of " + number(g));
        return {};
    }
    optics.phase = Optics::Phase::fournierForand;
    const FournierForand function = fournierForandOf(double(params.backscatter));
    optics.ffIndex = float(function.index), optics.ffSlope = float(function.slope);
    const PhaseMoments all = momentsOf(function, 0);
    const double g = all.meanCosine, wanted = params.forwardFraction >= 0 ? double(params.forwardFraction) : g * g;
    const double peak = std::max(peakThatLeaves(function, 1 - wanted), kLeastPeak);
    const PhaseMoments rest = momentsOf(function, peak);
    optics.forwardFraction = float(1 - rest.total / all.total);
    optics.ffPeak = float(peak), optics.ffScale = float(1 / rest.total), optics.anisotropy = float(rest.meanCosine);
    return {};
}

}  // namespace

double fresnelTransmittance(double cosIncidence, double index) {
    const double sine2 = (1 - cosIncidence * cosIncidence) / (index * index);
    if (sine2 >= 1) return 0;
    const double cosRefracted = std::sqrt(1 - sine2);
    const double s = (cosIncidence - index * cosRefracted) / (cosIncidence + index * cosRefracted);
    const double p = (index * cosIncidence - cosRefracted) / (index * cosIncidence + cosRefracted);
    return 1 - 0.5 * (s * s + p * p);
}

Result<Optics> resolveOptics(const OpticsParams& params) {
    if (Result<void> ok = validate(params); !ok) return badInput("water." + ok.error().message);
    const NamedMedium* medium = nullptr;
    for (const NamedMedium& m : namedMedia())
        if (params.medium == m.name) medium = &m;
    if (!medium) return badInput("water.medium \"" + params.medium + "\" is unknown");
    if (params.forwardFraction < 0 && params.forwardFraction != -1)
        return badInput("water.forwardFraction is " + number(params.forwardFraction) +
                        ", expected 0 or more, or -1 for the anisotropy squared");

    Optics optics;
    const Result<Vec3> a = chosen("water.absorption", params.absorption, medium->absorption);
    if (!a) return a.error();
    const Result<Vec3> b = chosen("water.scattering", params.scattering, medium->scattering);
    if (!b) return b.error();
    const Result<Vec3> kd = chosen("water.diffuseAttenuation", params.diffuseAttenuation, medium->diffuseAttenuation);
    if (!kd) return kd.error();
    optics.absorption = *a, optics.scattering = *b, optics.diffuseAttenuation = *kd;
    for (int i = 0; i < 3; ++i) {
        const bool own = channel(params.absorption, i) >= 0 || channel(params.scattering, i) >= 0;
        const bool given = channel(params.diffuseAttenuation, i) >= 0;
        const float absorption = channel(*a, i);
        if (own && !given)
            channel(optics.diffuseAttenuation, i) = float(kirk(double(absorption), double(channel(*b, i)), 1));
        if (absorption > channel(optics.diffuseAttenuation, i) * (1 + 1e-5f))
            return badInput(std::string("water.diffuseAttenuation is ") +
                            number(channel(optics.diffuseAttenuation, i)) + " in " + kChannels[i] +
                            ", expected at least the absorption " + number(absorption));
    }
    optics.index = params.index;
    if (Result<void> ok = choosePhase(params, optics); !ok) return ok.error();
    return optics;
}

Vec3 diffuseAttenuationAt(const Optics& optics, double cosBelow) {
    const double mu = std::clamp(cosBelow, 1e-3, 1.0);
    Vec3 kd = optics.diffuseAttenuation;
    for (int i = 0; i < 3; ++i) {
        const double a = double(channel(optics.absorption, i)), b = double(channel(optics.scattering, i));
        const double above = kirk(a, b, 1);
        if (above > 0) channel(kd, i) *= float(kirk(a, b, mu) / above);
    }
    return kd;
}

Vec4 phaseVector(const Optics& optics) {
    if (optics.phase == Optics::Phase::henyeyGreenstein) return {0, optics.anisotropy, 0, 1};
    return {optics.ffPeak, optics.ffIndex, optics.ffSlope, optics.ffScale};
}

float phaseFunction(const Optics& optics, float cosTheta) {
    const double c = std::clamp(double(cosTheta), -1.0, 1.0);
    if (optics.phase == Optics::Phase::henyeyGreenstein) {
        const double g = double(optics.anisotropy), d = 1 + g * g - 2 * g * c;
        return float((1 - g * g) / (4 * kPiD * d * std::sqrt(d)));
    }
    const double sine2 = std::clamp(0.5 - 0.5 * c, double(optics.ffPeak), 1.0);
    return float(double(optics.ffScale) * FournierForand{double(optics.ffIndex), double(optics.ffSlope)}.at(sine2));
}

}  // namespace shoal::water
