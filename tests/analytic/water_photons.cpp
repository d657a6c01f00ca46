// Caustics on the GPU against closed forms and the double-precision tracer. Limits are the project's targets.
#include <gtest/gtest.h>

#include "support/gl_device.h"
#include "support/water_measure.h"

namespace shoal::test {
namespace {

class WaterPhotons : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (!HasFatalFailure()) gl::setKnownState();
    }
};

TEST_F(WaterPhotons, FlatWaterIsEvenAtAllAngles) {
    FloorRig rig(device());
    for (const double zenith : {0.0, 30.0, 60.0})
        for (const double c : {0.0, 0.13}) EXPECT_LT(flatError(rig, zenith, c), 0.005) << zenith << " deg, c " << c;
}

TEST_F(WaterPhotons, SinusoidAgreesWithTheClosedForm) {
    FloorRig rig(device());
    const std::vector<double> at = {0, 0.25, 0.5, 0.75, 1, -0.25, -0.5};
    for (const double depth : {1.0, 2.0, 4.0, 6.0}) {
        EXPECT_LT(sinusoidError(rig, depth, 160000, at), 0.01) << depth << " m";
        EXPECT_LT(sinusoidError(rig, depth, 1000000, at), 0.005) << depth << " m";
    }
    EXPECT_LT(sinusoidError(rig, 4, 160000, at, 0, 0.13), 0.01);
    for (const double zenith : {30.0, 60.0})
        EXPECT_LT(sinusoidError(rig, 2, 160000, std::vector<double>{0, 0.5, 1, 1.5}, zenith), 0.01) << zenith << " deg";
}

// Murky water: as exact where 1e-4 of the light is left as where all of it is, picture included.
TEST_F(WaterPhotons, LittleLightIsExactToo) {
    constexpr double kLeft = 1e-4, kDepth = 4;
    FloorRig rig(device());
    const auto seen = [&](const water::WaveField& waves, double zenithDeg, double attenuation) {
        FloorSetup setup;
        setup.waves = &waves, setup.depth = float(kDepth), setup.center = {0, 0};
        setup.zenithDeg = float(zenithDeg), setup.attenuation = float(attenuation);
        rig.prepare(setup);
        rig.trace();
        rig.lookUp();
        return rig.irradiance();
    };
    const water::WaveField level = levelWater(), sinusoid = sinusoidS1();
    for (const double zenithDeg : {0.0, 60.0}) {
        const double zenith = zenithDeg * kPiD / 180;
        const double metres = kDepth / std::sqrt(1 - std::pow(std::sin(zenith) / water::kWaterIndex, 2));
        const double c = -std::log(kLeft) / metres;
        const double exact = water::analytic::flatIrradiance(water::kWaterIndex, c, zenith, kDepth);
        const std::vector<float> flat = seen(level, zenithDeg, c);
        const int n = rig.resolution();
        double worst = 0;
        for (int j = 8; j < n - 8; ++j)
            for (int i = 8; i < n - 8; ++i)
                worst = std::max(worst, std::abs(double(flat[std::size_t(j * n + i)]) / exact - 1));
        EXPECT_LT(worst, 0.01) << zenithDeg << " deg";
    }
    const double c = -std::log(kLeft) / kDepth;
    const std::vector<float> wavy = seen(sinusoid, 0, c);
    for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        const double exact = water::analytic::sinusoidIrradiance({.attenuation = c, .zenithAngle = 0}, kDepth, x);
        // Pixels are 1/128 m; the mean of two about x.
        const std::size_t i = std::size_t(std::lround((x + 2) * 128)), row = 300 * 512;
        const double value = 0.5 * (double(wavy[row + i - 1]) + double(wavy[row + i]));
        EXPECT_NEAR(value / exact, 1, 0.01) << x;
    }
}

TEST_F(WaterPhotons, FocusAndFoldsAreWhereTheyShouldBe) {
    FloorRig rig(device());
    EXPECT_NEAR(focusDepthRatio(rig), 1, 0.01);
    EXPECT_LT(foldError(rig), 0.5);
}

TEST_F(WaterPhotons, SixWavesAgreeWithRays) {
    FloorRig rig(device());
    const water::WaveField waves = patchP6();
    FloorSetup setup;
    setup.waves = &waves;
    const auto error = [&](int photons, double disc, const std::vector<float>& reference) {
        setup.photons = photons, setup.discHalfAngle = float(disc);
        rig.prepare(setup);
        rig.trace();
        return compareMaps(patchWindow(rig), reference);
    };
    constexpr double kSun = 0.004653;
    const PatchReference reference = patchReference(2, kSun, 4096);
    const MapError few = error(160000, 0, reference.sharp), many = error(1000000, 0, reference.sharp);
    EXPECT_LT(few.rmse, 0.04);
    EXPECT_LT(many.rmse, 0.02);
    EXPECT_LT(many.rmse, few.rmse);
    EXPECT_NEAR(few.mean / few.referenceMean, 1, 0.002);
    EXPECT_LT(error(160000, kSun, reference.blurred).rmse, 0.05);
    EXPECT_LT(error(1000000, kSun, reference.blurred).rmse, 0.03);
    // The control: a sharp map is far from the blurred one.
    EXPECT_GT(error(160000, 0, reference.blurred).rmse, 0.2);
}

TEST_F(WaterPhotons, EnergyDoesNotDependOnSettings) {
    const water::WaveField waves = patchP6();
    FloorSetup setup;
    setup.waves = &waves;
    const auto mean = [&](FloorRig& rig) {
        rig.prepare(setup);
        rig.trace();
        const std::vector<float> map = rig.map();
        double sum = 0;
        for (const float value : map) sum += double(value);
        return sum / double(map.size());
    };
    constexpr double kExact = 0.979622;  // of P6, zenith light, no attenuation
    FloorRig rig(device());
    for (const int photons : {40000, 160000, 1000000, 4000000}) {
        setup.photons = photons;
        EXPECT_NEAR(mean(rig) / kExact, 1, 0.002) << photons << " photons";
    }
    setup.photons = 160000;
    for (const int resolution : {256, 1024, 2048}) {
        FloorRig other(device(), resolution);
        EXPECT_NEAR(mean(other) / kExact, 1, 0.002) << resolution << " texels";
    }
    // A lattice of other cells, and the sun's disc.
    setup.photons = 163216;
    EXPECT_NEAR(mean(rig) / kExact, 1, 0.002);
    setup.discHalfAngle = 0.004653f;
    EXPECT_NEAR(mean(rig) / kExact, 1, 0.002);
    setup.depth = 6;
    EXPECT_NEAR(mean(rig) / kExact, 1, 0.003);
}

// Footprints of dozens of texels and of hundreds: all of their light arrives, and without cracks between them.
TEST_F(WaterPhotons, FewPhotonsLeaveNoCracks) {
    const water::WaveField level = levelWater(), waves = patchP6();
    FloorSetup setup;
    setup.waves = &level;
    for (const int resolution : {512, 2048})
        for (const int photons : {1000, 10000}) {
            FloorRig rig(device(), resolution);
            setup.photons = photons;
            rig.prepare(setup);
            rig.trace();
            const double exact = water::analytic::flatIrradiance(water::kWaterIndex, 0, 0, double(setup.depth));
            double worst = 0;
            for (const float value : rig.map()) worst = std::max(worst, std::abs(double(value) / exact - 1));
            EXPECT_LT(worst, 0.01) << resolution << " texels, " << photons << " photons";
        }
    // Deep down curvature has spread them over a hundred times their cell.
    FloorRig rig(device());
    setup.waves = &waves, setup.depth = 60, setup.sideM = 60, setup.photons = 10000;
    rig.prepare(setup);
    rig.trace();
    const std::vector<float> map = rig.map();
    double sum = 0;
    const std::size_t n = 512, rim = 64;
    for (std::size_t j = rim; j < n - rim; ++j)
        for (std::size_t i = rim; i < n - rim; ++i) sum += double(map[j * n + i]);
    EXPECT_NEAR(sum / double((n - 2 * rim) * (n - 2 * rim)) / 0.979622, 1, 0.01);
}

TEST_F(WaterPhotons, RunsAreBitIdentical) {
    const water::WaveField waves = patchP6();
    FloorSetup setup;
    setup.waves = &waves, setup.discHalfAngle = 0.004653f;
    FloorRig rig(device());
    rig.prepare(setup);
    rig.trace();
    const std::vector<float> first = rig.map();
    for (int run = 0; run < 10; ++run) {
        rig.trace();
        EXPECT_EQ(rig.map(), first) << "run " << run;
    }
}

// Still water under a moving eye: what a place of the floor gets is the same to the last bit.
TEST_F(WaterPhotons, LightStandsStillWhenTheEyeMoves) {
    const water::WaveField waves = patchP6();
    FloorSetup setup;
    setup.waves = &waves, setup.discHalfAngle = 0.004653f;
    FloorRig rig(device());
    rig.prepare(setup);
    rig.trace();
    const std::vector<float> before = rig.map();
    const water::LightSlot old = rig.slot();
    for (const Vec2 step : {Vec2{0.37f, 0.11f}, Vec2{-0.903f, 0.5f}, Vec2{0.013f, -1.3f}}) {
        setup.center = {2 + step.x, 2 + step.y};
        rig.prepare(setup);
        rig.trace();
        const std::vector<float> after = rig.map();
        const water::LightSlot& slot = rig.slot();
        ASSERT_EQ(slot.texel, old.texel);
        const int di = int(std::lround((slot.origin.x - old.origin.x) / slot.texel));
        const int dj = int(std::lround((slot.origin.y - old.origin.y) / slot.texel));
        const int n = rig.resolution();
        int different = 0, compared = 0;
        // What the rim's light blurs over belongs to both maps only further in.
        for (int j = 8; j < n - 8; ++j)
            for (int i = 8; i < n - 8; ++i) {
                const int a = i - di, b = j - dj;
                if (a < 8 || b < 8 || a >= n - 8 || b >= n - 8) continue;
                ++compared;
                different += before[std::size_t(j) * std::size_t(n) + std::size_t(i)] !=
                             after[std::size_t(b) * std::size_t(n) + std::size_t(a)];
            }
        EXPECT_GT(compared, n * n / 4);
        EXPECT_EQ(different, 0) << "of " << compared;
    }
}

// Through the lookup: the picture of the floor is the map.
TEST_F(WaterPhotons, LookupGivesTheMap) {
    const water::WaveField waves = patchP6();
    FloorSetup setup;
    setup.waves = &waves, setup.attenuation = 0.1f;
    FloorRig rig(device());
    rig.prepare(setup);
    rig.trace();
    rig.lookUp();
    EXPECT_LT(compareMaps(rig.irradiance(), rig.map()).rmse, 0.001);
}

// A lamp over level water: rings of its light, intensity 1 W/sr, land on rings of the floor.
TEST_F(WaterPhotons, LampOverLevelWater) {
    const water::WaveField waves = levelWater();
    FloorSetup setup;
    setup.waves = &waves, setup.center = {0, 0};
    const double height = 3, depth = double(setup.depth), index = water::kWaterIndex;
    setup.lamps = {{.position = {0, float(height), 0}, .intensity = {1, 1, 1}}};
    FloorRig rig(device());
    rig.prepare(setup);
    ASSERT_EQ(rig.views().slots().size(), 1u);
    rig.trace();
    rig.lookUp();
    const std::vector<float> seen = rig.irradiance();
    const auto landing = [&](double incidence) {
        return height * std::tan(incidence) + depth * std::tan(std::asin(std::sin(incidence) / index));
    };
    for (const double incidence : {0.05, 0.15, 0.25, 0.35}) {
        const double step = 1e-5, at = landing(incidence);
        const double slope = (landing(incidence + step) - landing(incidence - step)) / (2 * step);
        const double exact =
            water::fresnelTransmittance(std::cos(incidence), index) * std::sin(incidence) / (at * slope);
        const int i = int((at + 2) * 128), j = 256;
        const double x = (i + 0.5) / 128 - 2, z = 0.5 / 128;
        const float value = seen[std::size_t(j) * 512 + std::size_t(i)];
        EXPECT_NEAR(double(value) / exact, 1, 0.01 + 2 * std::abs(std::hypot(x, z) / at - 1)) << "X " << at;
    }
}

// What the surface throws up at a ceiling and what goes on into the water are all of the light.
TEST_F(WaterPhotons, ReflectedAndRefractedLightIsAllOfIt) {
    constexpr double kTarget = 0.01;
    for (const double zenith : {0.0, 30.0, 60.0}) {
        const water::WaveField waves = patchP6();
        FloorSetup setup;
        setup.waves = &waves, setup.ceiling = 1, setup.zenithDeg = float(zenith), setup.photons = 640000;
        FloorRig rig(device());
        rig.prepare(setup);
        ASSERT_EQ(rig.views().slots().size(), 2u);
        ASSERT_TRUE(rig.slot(1).reflected);
        rig.trace();
        const auto mean = [&](int slot) {
            // Of the middle of the square, whole periods of the waves where it is large enough.
            const std::vector<float> map = rig.map(slot);
            const int n = rig.resolution();
            const int texels = std::min(n, int(std::lround(4 / rig.slot(slot).texel)));
            const int first = (n - texels) / 2;
            double sum = 0;
            for (int j = first; j < first + texels; ++j)
                for (int i = first; i < first + texels; ++i)
                    sum += double(map[std::size_t(j) * std::size_t(n) + std::size_t(i)]);
            return sum / (double(texels) * texels);
        };
        EXPECT_NEAR((mean(0) + mean(1)) / std::cos(zenith * kPiD / 180), 1, kTarget) << zenith << " deg";
        // The eye sees the ceiling: it gets what the second map holds, the floor's light is not added.
        rig.lookUp();
        const std::vector<float> seen = rig.irradiance();
        double sum = 0;
        for (const float value : seen) sum += double(value);
        EXPECT_NEAR(sum / double(seen.size()) / mean(1), 1, 0.03) << zenith << " deg";
    }
}

// Light where it has no business to be defined: nothing breaks.
TEST_F(WaterPhotons, OddLightsGiveFiniteLight) {
    const water::WaveField waves = patchP6();
    FloorRig rig(device());
    for (const float zenith : {80.0f, 89.0f, 89.9f, 90.0f, 120.0f, 180.0f}) {
        FloorSetup setup;
        setup.waves = &waves, setup.zenithDeg = zenith, setup.photons = 20000;
        rig.prepare(setup);
        rig.trace();
        rig.lookUp();
        for (const float value : rig.irradiance()) ASSERT_TRUE(std::isfinite(value) && value >= 0) << zenith;
    }
    for (const float height : {-1.0f, 0.0f, 1e-4f, 0.06f, 0.5f, 1000.0f}) {
        FloorSetup setup;
        setup.waves = &waves, setup.photons = 20000;
        setup.lamps = {{.position = {2, height, 2}, .intensity = {1, 1, 1}},
                       {.kind = light::PunctualLight::Kind::spot, .position = {1, height, 2}, .range = 3}};
        rig.prepare(setup);
        rig.trace();
        rig.lookUp();
        for (const float value : rig.irradiance()) ASSERT_TRUE(std::isfinite(value) && value >= 0) << height;
    }
}

}  // namespace
}  // namespace shoal::test
