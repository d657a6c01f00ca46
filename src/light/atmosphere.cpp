// Rayleigh, Mie and ozone atmosphere of a planet.
//   [Bruneton & Neyret 2008] Precomputed Atmospheric Scattering, EGSR; constants and the mapping of the transmittance
//   table from the 2017 re-implementation. [Hillaire 2020] A Scalable and Production Ready Sky and Atmosphere Rendering
//   Technique, EGSR: multiple scattering.
// Departs: aerosols are scaled so that turbidity means what it does in photometry (Bruneton's own are turbidity 1.05);
// the multiple scattering table covers only the sun heights one picture needs, and its directions are Gauss points
// either side of the horizon.
#include "light/atmosphere.h"

#include <cmath>

#include <shoal/core/parallel.h>

namespace shoal::light {
namespace {

constexpr Vec3 kRayleigh{5.802e-3f, 13.558e-3f, 33.1e-3f};  // 1/km at sea level
// 1/km where ozone is densest. Red is not 0.65e-3, which 680 nm itself has, but what makes the spectrum drawn through
// the three (sky_color.cpp) absorb as the band around 600 nm does, between the wavelengths; without it twilight is
// purple, not blue.
constexpr Vec3 kOzone{3.0e-3f, 1.881e-3f, 0.085e-3f};
constexpr double kRayleighHeight = 8, kMieHeight = 1.2;    // km
constexpr double kOzoneCenter = 25, kOzoneHalfWidth = 15;  // km
constexpr float kMieAlbedo = 0.9f;                         // scattering over extinction
constexpr float kAngstrom = 1.0f;                          // aerosol extinction goes with wavelength^-1
constexpr double kSunHalfAngle = 0.004654;                 // radians

constexpr int kDensityCount = 4096;
constexpr int kSunMuCount = 256, kAltitudeCount = 64;  // transmittance table
constexpr int kDepthSteps = 24;
constexpr int kScatterMuCount = 32, kScatterAltitudeCount = 24;  // multiple scattering table
constexpr int kScatterSteps = 12, kScatterAzimuthCount = 4;

const double kHorizonKm =
    std::sqrt(kTopKm * kTopKm - kGroundKm * kGroundKm);  // from the ground along the horizon to space

Vec3 expNegative(Vec3 depth) { return {std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)}; }

double distanceToTop(double r, double mu) {
    return std::max(0.0, -r * mu + std::sqrt(std::max(0.0, r * r * (mu * mu - 1) + kTopKm * kTopKm)));
}

// Distance to the ground, negative where the ray passes it.
double distanceToGround(double r, double mu) {
    const double discriminant = r * r * (mu * mu - 1) + kGroundKm * kGroundKm;
    return mu < 0 && discriminant >= 0 ? std::max(0.0, -r * mu - std::sqrt(discriminant)) : -1;
}

struct TableSpot {
    int i;
    float t;
};
inline TableSpot spotIn(double unit, int count) {
    const double x = std::clamp(unit, 0.0, 1.0) * (count - 1);
    const int i = std::min(int(x), count - 2);
    return {i, float(x - i)};
}

inline Vec3 bilinear(const std::vector<Vec3>& table, int rowLength, TableSpot row, TableSpot column) {
    const Vec3* p = table.data() + std::size_t(row.i) * std::size_t(rowLength) + column.i;
    const Vec3 top = lerp(p[0], p[1], column.t), bottom = lerp(p[rowLength], p[rowLength + 1], column.t);
    return lerp(top, bottom, row.t);
}

// Table row of a radius: even in the distance to the horizon, which makes rows dense near the ground.
double radiusOfUnit(double unit) { return std::sqrt(kGroundKm * kGroundKm + unit * unit * kHorizonKm * kHorizonKm); }
double unitOfRadius(double r) { return std::sqrt(std::max(0.0, r * r - kGroundKm * kGroundKm)) / kHorizonKm; }

}  // namespace

Level levelOf(double r) {
    Level level;
    level.r = r;
    // The horizon is where sin(zenith angle) = ground / r; the disc sinks through it over twice its half angle.
    const double sinHorizon = std::min(1.0, kGroundKm / r);
    level.muHorizon = -std::sqrt(1 - sinHorizon * sinHorizon);
    level.penumbra = 2 * kSunHalfAngle * sinHorizon;
    level.unit = unitOfRadius(r);
    level.shortest = kTopKm - r;
    level.longest = std::max(level.shortest + 1e-9, (level.unit + 1) * kHorizonKm);
    return level;
}

Atmosphere::Atmosphere(double turbidity) {
    const double aerosol = (turbidity - 1) * double(kRayleigh.y) * kRayleighHeight / kMieHeight;  // 1/km at 550 nm
    mieExtinction_ = Vec3{std::pow(550.0f / 680, kAngstrom), 1, std::pow(550.0f / 440, kAngstrom)} * float(aerosol);
    mieScattering_ = mieExtinction_ * kMieAlbedo;
    densities_.resize(kDensityCount);
    for (int i = 0; i < kDensityCount; ++i) {
        const double altitude = (kTopKm - kGroundKm) * i / (kDensityCount - 1);
        densities_[std::size_t(i)] = {float(std::exp(-altitude / kRayleighHeight)),
                                      float(std::exp(-altitude / kMieHeight)),
                                      float(std::max(0.0, 1 - std::abs(altitude - kOzoneCenter) / kOzoneHalfWidth))};
    }
    fillTransmittance();
}

AirSample Atmosphere::sample(double altitudeKm) const {
    const TableSpot spot = spotIn(altitudeKm / (kTopKm - kGroundKm), kDensityCount);
    const Vec3 density = lerp(densities_[std::size_t(spot.i)], densities_[std::size_t(spot.i) + 1], spot.t);
    const Vec3 rayleigh = kRayleigh * density.x;
    return {rayleigh, mieScattering_ * density.y, rayleigh + mieExtinction_ * density.y + kOzone * density.z};
}

// Densities integrated along a straight line between two distances from its point closest to the planet's centre.
Vec3 Atmosphere::densityIntegral(double closest, double from, double to) const {
    double sum[3]{};
    for (int i = 0; i < kDepthSteps; ++i) {
        const double u = (i + 0.5) / kDepthSteps;  // cubic spacing: steps are short where the air is dense
        const double s = from + (to - from) * u * u * u;
        const double altitude = std::sqrt(closest * closest + s * s) - kGroundKm;
        const TableSpot spot = spotIn(altitude / (kTopKm - kGroundKm), kDensityCount);
        const Vec3 density = lerp(densities_[std::size_t(spot.i)], densities_[std::size_t(spot.i) + 1], spot.t);
        const double weight = 3 * u * u * (to - from) / kDepthSteps;
        sum[0] += weight * double(density.x), sum[1] += weight * double(density.y),
            sum[2] += weight * double(density.z);
    }
    return {float(sum[0]), float(sum[1]), float(sum[2])};
}

Vec3 Atmosphere::opticalDepth(double r, double mu) const {
    const double closest = r * std::sqrt(std::max(0.0, 1 - mu * mu));
    const double end = std::sqrt(std::max(0.0, kTopKm * kTopKm - closest * closest));
    // A ray that goes down first is two rays up from its lowest point.
    const Vec3 density = mu >= 0 ? densityIntegral(closest, std::min(r * mu, end), end)
                                 : densityIntegral(closest, 0, -r * mu) + densityIntegral(closest, 0, end);
    return kRayleigh * density.x + mieExtinction_ * density.y + kOzone * density.z;
}

void Atmosphere::fillTransmittance() {
    transmittance_.resize(std::size_t(kSunMuCount) * kAltitudeCount);
    parallelFor(kAltitudeCount, 1, [&](std::size_t row) {
        const double unit = double(row) / (kAltitudeCount - 1), rho = unit * kHorizonKm, r = radiusOfUnit(unit);
        const double shortest = kTopKm - r, longest = rho + kHorizonKm;
        for (std::size_t i = 0; i < kSunMuCount; ++i) {
            const double d = shortest + (longest - shortest) * double(i) / (kSunMuCount - 1);
            const double mu = d > 0 ? (kHorizonKm * kHorizonKm - rho * rho - d * d) / (2 * r * d) : 1;
            transmittance_[row * kSunMuCount + i] = expNegative(opticalDepth(r, std::clamp(mu, -1.0, 1.0)));
        }
    });
}

Vec3 Atmosphere::sunlight(const Level& level, double mu) const {
    const double visible = (mu - level.muHorizon) / level.penumbra + 0.5;
    if (visible <= 0) return {};
    const double unitMu = (distanceToTop(level.r, mu) - level.shortest) / (level.longest - level.shortest);
    const Vec3 t =
        bilinear(transmittance_, kSunMuCount, spotIn(level.unit, kAltitudeCount), spotIn(unitMu, kSunMuCount));
    if (visible >= 1) return t;
    return t * float(visible * visible * (3 - 2 * visible));
}

Ray traceAir(const Atmosphere& air, double r, double mu) {
    Ray ray;
    const double ground = distanceToGround(r, mu);
    ray.hitsGround = ground >= 0;
    const double length = ray.hitsGround ? ground : distanceToTop(r, mu);
    ray.stepCount = ray.hitsGround ? kGroundRaySteps : kRaySteps;
    Vec3 reached{1, 1, 1};
    for (int i = 0; i < ray.stepCount; ++i) {
        const double from = double(i) / ray.stepCount, to = double(i + 1) / ray.stepCount;
        RayStep& step = ray.steps[std::size_t(i)];
        const double stepLength = length * (to * to - from * from);
        step.distance = length * (to * to + from * from) / 2;
        step.level = levelOf(std::sqrt(r * r + step.distance * step.distance + 2 * r * step.distance * mu));
        const AirSample here = air.sample(step.level.r - kGroundKm);
        const Vec3 kept = expNegative(here.extinction * float(stepLength));
        const auto share = [&](float fraction, float extinction) {  // integral of exp(-extinction s) over the step
            return extinction > 1e-9f ? (1 - fraction) / extinction : float(stepLength);
        };
        const Vec3 weight = reached * Vec3{share(kept.x, here.extinction.x), share(kept.y, here.extinction.y),
                                           share(kept.z, here.extinction.z)};
        step.rayleigh = here.rayleigh * weight;
        step.mie = here.mie * weight;
        reached = reached * kept;
    }
    ray.transmittance = reached;
    return ray;
}

MultipleScattering::MultipleScattering(const Atmosphere& air, double sunMu, Vec3 groundAlbedo) {
    // Straight down the longest ray the local zenith turns by as much as this.
    const double turn = std::acos(kGroundKm / kTopKm) + 0.01, zenithAngle = std::acos(std::clamp(sunMu, -1.0, 1.0));
    highestMu_ = std::cos(std::max(0.0, zenithAngle - turn));
    lowestMu_ = std::cos(std::min(kPiD, zenithAngle + turn));
    table_.resize(std::size_t(kScatterMuCount) * kScatterAltitudeCount);
    parallelFor(table_.size(), kScatterMuCount, [&](std::size_t i) {
        const double unitMu = double(i % kScatterMuCount) / (kScatterMuCount - 1);
        const double unitR = double(i / kScatterMuCount) / (kScatterAltitudeCount - 1);
        table_[i] = solve(air, radiusOfUnit(unitR), lowestMu_ + (highestMu_ - lowestMu_) * unitMu, groundAlbedo);
    });
}

Vec3 MultipleScattering::at(const Level& level, double sunMu) const {
    return bilinear(table_, kScatterMuCount, spotIn(level.unit, kScatterAltitudeCount),
                    spotIn((sunMu - lowestMu_) / (highestMu_ - lowestMu_), kScatterMuCount));
}

namespace {

// Light of the second order that comes along one direction, and the part of evenly spread light that scatters into it
// once more.
struct Orders {
    Vec3 second, transfer;
};

Orders gather(const Atmosphere& air, double r, double mu, double sunMu, Vec3 groundAlbedo) {
    const double ground = distanceToGround(r, mu), length = ground >= 0 ? ground : distanceToTop(r, mu);
    const double sine = std::sqrt(std::max(0.0, 1 - mu * mu)) * std::sqrt(std::max(0.0, 1 - sunMu * sunMu));
    double cosines[kScatterAzimuthCount];  // between the direction and the sun
    for (int k = 0; k < kScatterAzimuthCount; ++k)
        cosines[k] = mu * sunMu + sine * std::cos(kPiD * (k + 0.5) / kScatterAzimuthCount);
    Orders sum;
    Vec3 reached{1, 1, 1};
    for (int i = 0; i < kScatterSteps; ++i) {
        const double from = double(i) / kScatterSteps, to = double(i + 1) / kScatterSteps;
        const double stepLength = length * (to * to - from * from), distance = length * (to * to + from * from) / 2;
        const Level level = levelOf(std::sqrt(r * r + distance * distance + 2 * r * distance * mu));
        const AirSample here = air.sample(level.r - kGroundKm);
        const Vec3 kept = expNegative(here.extinction * float(stepLength)), lost = Vec3{1, 1, 1} - kept;
        const Vec3 safe = max(here.extinction, {1e-9f, 1e-9f, 1e-9f});
        const Vec3 scattered = reached * (here.rayleigh + here.mie) * lost * Vec3{1 / safe.x, 1 / safe.y, 1 / safe.z};
        Vec3 sun;
        for (const double cosine : cosines) sun += air.sunlight(level, (r * sunMu + distance * cosine) / level.r);
        sum.second += scattered * sun * (1 / (4 * kPi * kScatterAzimuthCount));
        sum.transfer += scattered;
        reached = reached * kept;
    }
    if (ground < 0) return sum;
    const Level level = levelOf(kGroundKm);
    for (const double cosine : cosines) {
        const double muThere = (r * sunMu + ground * cosine) / kGroundKm;
        sum.second += reached * groundAlbedo * air.sunlight(level, muThere) *
                      float(std::max(0.0, muThere) / (kPiD * kScatterAzimuthCount));
    }
    return sum;
}

// Gauss-Legendre points and weights on [-1, 1].
constexpr double kGaussPoints[4] = {-0.8611363115940526, -0.3399810435848563, 0.3399810435848563, 0.8611363115940526};
constexpr double kGaussWeights[4] = {0.3478548451374538, 0.6521451548625461, 0.6521451548625461, 0.3478548451374538};

}  // namespace

Vec3 MultipleScattering::solve(const Atmosphere& air, double r, double sunMu, Vec3 groundAlbedo) const {
    const double sinHorizon = std::min(1.0, kGroundKm / r), muHorizon = -std::sqrt(1 - sinHorizon * sinHorizon);
    const double ends[3] = {-1, muHorizon, 1};
    Orders mean;
    for (int half = 0; half < 2; ++half)
        for (int i = 0; i < 4; ++i) {
            const double radius = (ends[half + 1] - ends[half]) / 2, middle = (ends[half + 1] + ends[half]) / 2;
            const Orders along = gather(air, r, middle + radius * kGaussPoints[i], sunMu, groundAlbedo);
            const float weight =
                float(kGaussWeights[i] * radius / 2);  // the sphere's mean: half the integral over the cosine
            mean.second += along.second * weight;
            mean.transfer += along.transfer * weight;
        }
    const Vec3 t = min(mean.transfer, {0.99f, 0.99f, 0.99f});
    return mean.second * Vec3{1 / (1 - t.x), 1 / (1 - t.y), 1 / (1 - t.z)};  // all orders: a geometric series
}

}  // namespace shoal::light
