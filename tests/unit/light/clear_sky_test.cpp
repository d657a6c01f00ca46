#include <gtest/gtest.h>
#include <shoal/core/parallel.h>
#include <shoal/light/environment.h>

#include "light/atmosphere.h"
#include "light/sky_color.h"

namespace shoal::light {
namespace {

Vec3 sunAt(float elevationDeg) {
    const float a = radians(elevationDeg);
    return {0.6f * std::cos(a), std::sin(a), -0.8f * std::cos(a)};
}
Vec3 skyAt(const ClearSky& sky, float elevationDeg, float awayFromSunDeg) {
    const Vec3 toSun = sky.sun.toSun;
    const float a = radians(elevationDeg), azimuth = std::atan2(toSun.x, -toSun.z) + radians(awayFromSunDeg);
    return lookUp(sky.environment, {std::sin(azimuth) * std::cos(a), std::sin(a), -std::cos(azimuth) * std::cos(a)});
}

TEST(ClearSky, IsFiniteAndPositiveForAnySun) {
    for (const float elevation : {90.0f, 89.9f, 45.0f, 0.2f, 0.0f, -0.2f, -6.0f, -45.0f, -90.0f})
        for (const float turbidity : {1.0f, 2.0f, 10.0f}) {
            const ClearSky sky = makeClearSky(sunAt(elevation), turbidity, {0.3f, 0.3f, 0.3f}, 32);
            for (const float v : sky.environment.radiance.pixels)
                ASSERT_TRUE(std::isfinite(v) && v > 0) << "sun at " << elevation << " turbidity " << turbidity;
            const Vec3 e = sky.sun.irradiance;
            EXPECT_TRUE(std::isfinite(e.x + e.y + e.z) && std::min({e.x, e.y, e.z}) >= 0);
            EXPECT_EQ(elevation > 0, e.x > 0);
        }
}

TEST(ClearSky, SunIsWhitishAtNoonAndOrangeWhenLow) {
    const Vec3 noon = makeClearSky(sunAt(60), 2, {0.3f, 0.3f, 0.3f}, 16).sun.irradiance;
    EXPECT_GT(noon.z / noon.x, 0.7f);
    EXPECT_GT(noon.y, 6.0f);
    EXPECT_LT(noon.x, 10.0f);
    const Vec3 low = makeClearSky(sunAt(5), 2, {0.3f, 0.3f, 0.3f}, 16).sun.irradiance;
    EXPECT_LT(low.y / low.x, 0.7f);
    EXPECT_LT(low.z / low.y, 0.4f);
}

TEST(ClearSky, ZenithIsBlueHorizonPalerAndTheSunHasAGlow) {
    const ClearSky sky = makeClearSky(sunAt(45), 2, {0.3f, 0.3f, 0.3f});
    const Vec3 zenith = skyAt(sky, 89, 180), horizon = skyAt(sky, 2, 180);
    EXPECT_GT(zenith.z / zenith.x, 1.8f);
    EXPECT_GT(horizon.y, zenith.y);
    EXPECT_LT(horizon.z / horizon.x, 0.8f * zenith.z / zenith.x);
    EXPECT_GT(skyAt(sky, 45, 5).y, 3 * skyAt(sky, 45, 60).y);
}

// Clear days: the sky gives level ground between a tenth and a half of what a high sun gives.
TEST(ClearSky, SkyLightIsThePartOfSunlightItIsOnClearDays) {
    const ClearSky sky = makeClearSky(sunAt(60), 2, {0.2f, 0.2f, 0.2f});
    const float fromSky = luminance(evaluateIrradiance(projectSh(sky.environment), {0, 1, 0}));
    const float fromSun = luminance(sky.sun.irradiance) * std::sin(radians(60));
    EXPECT_GT(fromSky / fromSun, 0.1f);
    EXPECT_LT(fromSky / fromSun, 0.5f);
}

TEST(ClearSky, GroundSendsBackItsAlbedo) {
    const ClearSky sky = makeClearSky(sunAt(50), 2, {0.4f, 0.4f, 0.4f});
    const Vec3 fromSky = evaluateIrradiance(projectSh(sky.environment), {0, 1, 0});
    const Vec3 expected = (fromSky + sky.sun.irradiance * std::sin(radians(50))) * (0.4f / kPi);
    const Vec3 down = lookUp(sky.environment, {0, -1, 0});
    EXPECT_NEAR(down.y / expected.y, 1, 0.05);  // SH of order 2 is good to a few percent
    const Vec3 dark = lookUp(makeClearSky(sunAt(50), 2, {0, 0, 0}).environment, {0, -1, 0});
    EXPECT_LT(dark.y, 0.05f * down.y);
}

TEST(ClearSky, DuskFallsOffSmoothlyToADimNight) {
    float last = 1e9f;
    for (float elevation = 10; elevation >= -20; elevation -= 1) {
        const ClearSky sky = makeClearSky(sunAt(elevation), 2, {0.3f, 0.3f, 0.3f}, 32);
        const float light = luminance(evaluateIrradiance(projectSh(sky.environment), {0, 1, 0}));
        EXPECT_LE(light, last * 1.0001f);
        EXPECT_GT(light, last < 1e8f ? last * 0.1f : 0.0f) << "a step at " << elevation;
        last = light;
    }
    EXPECT_GT(last, 1e-5f);
    EXPECT_LT(last, 1e-3f);
}

// Away from the sun, the horizon and (at dusk) the edge of the planet's shadow, second differences are small: no bands.
TEST(ClearSky, HasNoBands) {
    for (const float elevation : {60.0f, 5.0f, -3.0f}) {
        const ClearSky sky = makeClearSky(sunAt(elevation), 2, {0.3f, 0.3f, 0.3f});
        for (float up = elevation > 0 ? 8 : 16; up < 80; up += 1.5f) {
            const float a = luminance(skyAt(sky, up - 1.5f, 120)), b = luminance(skyAt(sky, up, 120)),
                        c = luminance(skyAt(sky, up + 1.5f, 120));
            EXPECT_LT(std::abs(a - 2 * b + c), 0.02f * b) << "sun " << elevation << " at " << up;
        }
    }
}

TEST(ClearSky, IsSymmetricAboutTheSunAndTheSameOnAnyThreadCount) {
    const ClearSky sky = makeClearSky(sunAt(30), 3, {0.3f, 0.2f, 0.1f}, 64);
    for (const float away : {10.0f, 70.0f, 150.0f})
        EXPECT_NEAR(skyAt(sky, 30, away).y, skyAt(sky, 30, -away).y, 0.01f * skyAt(sky, 30, away).y);
    const ThreadLimit one(1);
    EXPECT_EQ(sky.environment.radiance.pixels,
              makeClearSky(sunAt(30), 3, {0.3f, 0.2f, 0.1f}, 64).environment.radiance.pixels);
}

TEST(ClearSky, ScalesWithTheSun) {
    const ClearSky ten = makeClearSky(sunAt(30), 2, {0.3f, 0.3f, 0.3f}, 16, 10);
    const ClearSky one = makeClearSky(sunAt(30), 2, {0.3f, 0.3f, 0.3f}, 16, 1);
    EXPECT_FLOAT_EQ(ten.sun.irradiance.y, 10 * one.sun.irradiance.y);
    EXPECT_FLOAT_EQ(skyAt(ten, 40, 90).y, 10 * skyAt(one, 40, 90).y);
}

// Closed form: exponential air over the zenith has the depth coefficient times scale height.
TEST(Atmosphere, ZenithDepthIsCoefficientTimesScaleHeight) {
    const double ozone = 15;  // km: area of the ozone layer's triangle
    const Vec3 pure = Atmosphere(1).opticalDepth(kGroundKm, 1);
    EXPECT_NEAR(pure.z, 33.1e-3 * 8 + 0.085e-3 * ozone, 0.005 * 33.1e-3 * 8);
    const Vec3 hazy = Atmosphere(3).opticalDepth(kGroundKm, 1);
    EXPECT_NEAR(hazy.y - pure.y, 2 * 13.558e-3 * 8, 0.01 * 2 * 13.558e-3 * 8);  // what turbidity means
}

// Grazing rays against Simpson's rule with many steps, along which the table's cubic spacing could fail.
TEST(Atmosphere, HorizonDepthMatchesABruteForceSum) {
    const Atmosphere air(2);
    for (const double mu : {0.0, 0.05, 0.3, -0.02}) {
        const double r = kGroundKm + 2;
        const double end = -r * mu + std::sqrt(r * r * (mu * mu - 1) + kTopKm * kTopKm);
        const int count = 200000;
        double sum = 0;
        for (int i = 0; i < count; ++i) {
            const double t = end * (i + 0.5) / count;
            sum += double(air.sample(std::sqrt(r * r + t * t + 2 * r * mu * t) - kGroundKm).extinction.y) * end / count;
        }
        EXPECT_NEAR(air.opticalDepth(r, mu).y / sum, 1, 0.01) << "mu " << mu;
    }
}

TEST(Atmosphere, SunlightMatchesItsDepthAndEndsInTheShadow) {
    const Atmosphere air(2);
    for (const double mu : {1.0, 0.5, 0.1, 0.03})
        for (const double altitude : {0.2, 3.0, 20.0}) {
            const Vec3 depth = air.opticalDepth(kGroundKm + altitude, mu),
                       light = air.sunlight(levelOf(kGroundKm + altitude), mu);
            EXPECT_NEAR(light.y, std::exp(-depth.y), 0.01) << mu << " " << altitude;
        }
    EXPECT_EQ(air.sunlight(levelOf(kGroundKm), -0.01).x, 0);
    EXPECT_GT(air.sunlight(levelOf(kGroundKm + 40), -0.05).x, 0);  // high up the sun has not set yet
}

TEST(SkyColor, FlatSpectrumIsWhiteAndBlueIsBlue) {
    const Vec3 white = colorOfThreeWavelengths({2, 2, 2});
    EXPECT_NEAR(white.x, 2, 1e-4);
    EXPECT_NEAR(white.y, 2, 1e-4);
    EXPECT_NEAR(white.z, 2, 1e-4);
    const Vec3 blue = colorOfThreeWavelengths({std::pow(550 / 680.0f, 4.0f), 1, std::pow(550 / 440.0f, 4.0f)});
    EXPECT_LT(blue.x, blue.y);
    EXPECT_LT(blue.y, blue.z);
    EXPECT_EQ(colorOfThreeWavelengths({0, 0, 0}).x, colorOfThreeWavelengths({0, 0, 0}).x);  // no NaN
}

}  // namespace
}  // namespace shoal::light
