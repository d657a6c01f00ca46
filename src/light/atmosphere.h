// The air between the ground and space, and sunlight in it: tables that a picture of the sky is integrated from.
// Lengths are kilometres in here. `r` is the distance from the planet's centre, `mu` the cosine of an angle from the
// local zenith.
#pragma once

#include <array>
#include <vector>

#include <shoal/core/math.h>

namespace shoal::light {

inline constexpr double kGroundKm = 6360;  // planet radius [Bruneton & Neyret 2008]
inline constexpr double kTopKm = 6460;     // where the air ends

// 1/km, per channel (680, 550, 440 nm).
struct AirSample {
    Vec3 rayleigh, mie;  // scattering
    Vec3 extinction;     // both, and what aerosols and ozone absorb
};

// What look-ups at one radius share; made once where many follow.
struct Level {
    double r = 0;
    double muHorizon = 0, penumbra = 0;  // cosine to the horizon; width of the disc there
    double shortest = 0, longest = 0;    // distances to space, up and along the horizon
    double unit = 0;                     // where r lies in a table, 0 at the ground, 1 at the top
};
Level levelOf(double r);

class Atmosphere {
public:
    // turbidity >= 1: optical depth of air with aerosols over that of air alone, from zenith at 550 nm.
    explicit Atmosphere(double turbidity);

    AirSample sample(double altitudeKm) const;
    // Fraction of the sun's irradiance that reaches a point; 0 in the planet's shadow, with a penumbra as wide as the
    // disc.
    Vec3 sunlight(const Level& level, double mu) const;
    // Extinction integrated along a ray to space, without the planet.
    Vec3 opticalDepth(double r, double mu) const;

private:
    Vec3 densityIntegral(double closest, double from, double to) const;
    void fillTransmittance();

    Vec3 mieScattering_, mieExtinction_;  // 1/km at sea level
    std::vector<Vec3> densities_;         // over altitude: air, aerosol, ozone, 1 at their densest
    std::vector<Vec3> transmittance_;
};

// Light scattered twice and more, per unit of the sun's irradiance and of scattering coefficient, as if it came evenly
// from all around [Hillaire 2020, section 5.5]. Covers all altitudes and the sun heights that occur along rays from one
// observer.
class MultipleScattering {
public:
    // sunMu: of the observer. groundAlbedo: light that comes back from the ground.
    MultipleScattering(const Atmosphere& air, double sunMu, Vec3 groundAlbedo);
    Vec3 at(const Level& level, double sunMu) const;  // 1/sr

private:
    Vec3 solve(const Atmosphere& air, double r, double sunMu, Vec3 groundAlbedo) const;

    double lowestMu_ = 0, highestMu_ = 0;
    std::vector<Vec3> table_;
};

// A ray is cut so that step i of n ends at length * ((i + 1) / n)^2: the dense air close by gets short steps.
inline constexpr int kRaySteps = 40, kGroundRaySteps = 14;

// One ray through the air, ready for any sun: for every step its middle, and light scattered there that reaches the
// eye.
struct RayStep {
    double distance = 0;  // km
    Level level;
    Vec3 rayleigh, mie;  // integral over the step of scattering coefficient times transmittance to the eye
};
struct Ray {
    std::array<RayStep, kRaySteps> steps;
    int stepCount = kRaySteps;  // fewer for a ray that ends on the ground
    Vec3 transmittance;         // over the whole ray
    bool hitsGround = false;
};
Ray traceAir(const Atmosphere& air, double r, double mu);

}  // namespace shoal::light
