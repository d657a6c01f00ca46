// A clear sky as a lat-long map: single scattering marched along every ray, all further orders from a table
// (atmosphere.cpp).
//   [Bruneton & Neyret 2008], [Hillaire 2020] as there; [Bruneton 2017] A Qualitative and Quantitative Evaluation of 8
//   Clear Sky Models: phase functions and constants.
// Everything is integrated at 680, 550 and 440 nm and becomes Rec. 709 at the end (sky_color.cpp).
// The picture is symmetric about the sun's azimuth: rows are integrated over half a turn and both halves read from
// that.
#include <shoal/light/environment.h>

#include <algorithm>
#include <array>
#include <vector>

#include <shoal/core/assert.h>
#include <shoal/core/parallel.h>

#include "light/atmosphere.h"
#include "light/sky_color.h"

namespace shoal::light {
namespace {

constexpr double kEyeKm = kGroundKm + 0.2;  // from a hill: the air before the ground makes the horizon soft
constexpr float kMieG = 0.8f;               // mean cosine of aerosol scattering
constexpr float kNightSky =
    2e-6f;  // 1/sr, of the sun above the air: airglow and stars, so that night is dim, not black
constexpr Vec3 kNightColor{0.6f, 0.8f, 1.25f};

float rayleighPhase(float cosine) { return 3 / (16 * kPi) * (1 + cosine * cosine); }

// [Cornette & Shanks 1992]
float miePhase(float cosine) {
    constexpr float g = kMieG, k = 3 / (8 * kPi) * (1 - g * g) / (2 + g * g);
    const float base = std::max(1 + g * g - 2 * g * cosine, 1e-4f);
    return k * (1 + cosine * cosine) / (base * std::sqrt(base));
}

struct SkyModel {
    Atmosphere air;
    double sunMu, sunSine;
    MultipleScattering multiple;
    SkyModel(Vec3 toSun, float turbidity, Vec3 groundAlbedo)
        : air(double(turbidity)), sunMu(std::clamp(double(toSun.y), -1.0, 1.0)), sunSine(std::sqrt(1 - sunMu * sunMu)),
          multiple(air, sunMu, groundAlbedo) {}
};

// Light scattered towards the eye along a ray with zenith cosine mu, cosAzimuth from the sun, per unit of the sun's
// irradiance.
Vec3 inscatter(const SkyModel& sky, const Ray& ray, double mu, double cosAzimuth) {
    const double cosine = mu * sky.sunMu + std::sqrt(std::max(0.0, 1 - mu * mu)) * sky.sunSine * cosAzimuth;
    const float rayleigh = rayleighPhase(float(cosine)), mie = miePhase(float(cosine));
    Vec3 sum;
    for (int i = 0; i < ray.stepCount; ++i) {
        const RayStep& step = ray.steps[std::size_t(i)];
        const double sunMu = (kEyeKm * sky.sunMu + step.distance * cosine) / step.level.r;
        sum += sky.air.sunlight(step.level, sunMu) * (step.rayleigh * rayleigh + step.mie * mie);
        sum += sky.multiple.at(step.level, sunMu) * (step.rayleigh + step.mie);
    }
    return sum;
}

double muOfRow(int y, int height) { return std::cos((y + 0.5) / height * kPiD); }

// Rows over half a turn of azimuth, from the sun's side to the other; three wavelengths, per unit of the sun's
// irradiance above the air.
struct HalfSky {
    int azimuthCount;
    std::vector<Vec3> radiance;
    // Columns are dense near the sun, where its glow is.
    double azimuthOf(double column) const { return kPiD * column * column / ((azimuthCount - 1) * (azimuthCount - 1)); }
    Vec3 at(int row, double azimuth) const {  // azimuth from the sun, 0 to pi
        const double x = std::sqrt(std::clamp(azimuth / kPiD, 0.0, 1.0)) * (azimuthCount - 1);
        const int i = std::min(int(x), azimuthCount - 2);
        const Vec3* p = radiance.data() + std::size_t(row) * std::size_t(azimuthCount) + i;
        return lerp(p[0], p[1], float(x - i));
    }
};

// ground: what the ground sends up.
void fillRow(const SkyModel& sky, HalfSky& half, int row, int height, Vec3 ground) {
    const double mu = muOfRow(row, height);
    const Ray ray = traceAir(sky.air, kEyeKm, mu);
    for (int i = 0; i < half.azimuthCount; ++i) {
        Vec3 light = inscatter(sky, ray, mu, std::cos(half.azimuthOf(i)));
        if (ray.hitsGround) light += ray.transmittance * ground;
        half.radiance[std::size_t(row) * std::size_t(half.azimuthCount) + std::size_t(i)] = light;
    }
}

// Irradiance of the rows above the horizon on level ground.
Vec3 skyIrradiance(const HalfSky& half, int height) {
    double sum[3]{};
    for (int row = 0; row < height / 2; ++row) {
        const double c0 = std::cos(kPiD * row / height), c1 = std::cos(kPiD * (row + 1) / height);
        const double weight = (c0 * c0 - c1 * c1) / 2;  // of cosine and solid angle, per radian of azimuth
        for (int i = 0; i < half.azimuthCount; ++i) {
            const Vec3 l = half.radiance[std::size_t(row) * std::size_t(half.azimuthCount) + std::size_t(i)];
            const double to = half.azimuthOf(std::min(i + 0.5, half.azimuthCount - 1.0));
            const double w = weight * 2 * (to - half.azimuthOf(std::max(i - 0.5, 0.0)));
            sum[0] += w * double(l.x), sum[1] += w * double(l.y), sum[2] += w * double(l.z);
        }
    }
    return {float(sum[0]), float(sum[1]), float(sum[2])};
}

// The whole turn, in colour.
Environment mapOf(HalfSky& half, Vec3 toSun, int height, float sunAboveAir) {
    Environment environment;
    environment.radiance = Image(2 * height, height, 3);
    const double sunAzimuth = std::atan2(double(toSun.x), -double(toSun.z));
    parallelFor(std::size_t(height), 8, [&](std::size_t row) {
        for (int i = 0; i < half.azimuthCount; ++i) {
            Vec3& light = half.radiance[row * std::size_t(half.azimuthCount) + std::size_t(i)];
            light = (colorOfThreeWavelengths(light) + kNightColor * kNightSky) * sunAboveAir;
        }
        for (int x = 0; x < 2 * height; ++x) {
            const double azimuth = ((x + 0.5) / (2 * height) - 0.5) * 2 * kPiD;
            const Vec3 light = half.at(int(row), std::abs(std::remainder(azimuth - sunAzimuth, 2 * kPiD)));
            float* texel = environment.radiance.at(x, int(row));
            texel[0] = light.x, texel[1] = light.y, texel[2] = light.z;
        }
    });
    return environment;
}

}  // namespace

ClearSky makeClearSky(Vec3 toSun, float turbidity, Vec3 groundAlbedo, int height, float sunAboveAir) {
    SHOAL_ASSERT_GE(height, 2);
    toSun = normalize(toSun);
    const SkyModel sky(toSun, std::clamp(turbidity, 1.0f, 10.0f), groundAlbedo);
    const int azimuthCount = height / 2 + 1;
    HalfSky half{azimuthCount, std::vector<Vec3>(std::size_t(height) * std::size_t(azimuthCount))};
    const std::size_t above = std::size_t(height) / 2;
    parallelFor(above, 1, [&](std::size_t row) { fillRow(sky, half, int(row), height, {}); });

    Vec3 sunlight;
    if (toSun.y > 0) sunlight = sky.air.sunlight(levelOf(kEyeKm), sky.sunMu);
    const Vec3 ground = groundAlbedo * (sunlight * std::max(0.0f, toSun.y) + skyIrradiance(half, height)) / kPi;
    parallelFor(std::size_t(height) - above, 4,
                [&](std::size_t row) { fillRow(sky, half, int(above + row), height, ground); });

    ClearSky out;
    out.sun.toSun = toSun;
    if (toSun.y > 0)
        out.sun.irradiance = colorOfThreeWavelengths(sunlight) * sunAboveAir;
    else
        out.sun.irradiance = {0, 0, 0};
    out.environment = mapOf(half, toSun, height, sunAboveAir);
    return out;
}

}  // namespace shoal::light
