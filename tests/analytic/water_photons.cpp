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

}  // namespace
}  // namespace shoal::test
