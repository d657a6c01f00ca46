// God rays against single scattering in closed form (level water) and by quadrature over the exact field of one
// sinusoid; and what must not change them, cut them, or be left of them.
#include <gtest/gtest.h>

#include "support/gl_device.h"
#include "support/water_shaft_measure.h"

namespace shoal::test {
namespace {

class WaterShafts : public GlTest {};

double meanOf(const Image& picture) {
    double sum = 0;
    for (const float x : picture.pixels) sum += double(x);
    return sum / double(picture.pixels.size());
}

TEST_F(WaterShafts, LevelWaterMatchesTheClosedForm) {
    // The table of the closed form itself: zenith sun, eye 2 m deep.
    using water::analytic::flatShaft;
    EXPECT_NEAR(flatShaft({}, 0, {2, 0, 1, 0, 0, 10}), .00155893, 5e-9);
    EXPECT_NEAR(flatShaft({}, 0, {2, 0, std::sqrt(.75), .5, 0, 4}), .00276248, 5e-9);
    EXPECT_NEAR(flatShaft({}, 0, {2, 0, std::sqrt(.75), -.5, 0, 10}), .00066805, 5e-9);
    // Half floats round by .0005 at most; measured .0010 at .5 of the picture's size.
    EXPECT_LT(flatShaftError(device()), 0.003);
}

TEST_F(WaterShafts, WavesMatchTheQuadrature) {
    for (const double zenith : {0.0, 30 * kPiD / 180}) {
        const WavyShaftError error = wavyShaftError(device(), 0.25f, 40000, zenith);
        EXPECT_GT(error.contrast, 0.1) << "there are shafts to be seen";
        EXPECT_LT(error.rmse, 0.04) << zenith;  // measured .015, .027
        EXPECT_LT(error.edgeRmse, 1.2 * error.rmse) << zenith;
        EXPECT_LT(std::abs(error.mean), 0.005) << zenith;
    }
}

TEST_F(WaterShafts, MorePhotonsAndPixelsComeNearer) {
    const WavyShaftError few = wavyShaftError(device(), 0.25f, 10000), many = wavyShaftError(device(), 0.5f, 640000);
    EXPECT_LT(many.rmse, 0.7 * few.rmse);
}

TEST_F(WaterShafts, TheMeanDoesNotDependOnNumbers) { EXPECT_LT(shaftInvariance(device()), 0.005); }

TEST_F(WaterShafts, SameInputSameBitsOtherSampleOtherPattern) {
    ShaftScene scene(device(), 96, 64, patchP6());
    scene.setDistances([](Vec3) { return 8.0; });
    const Image first = scene.picture(), again = scene.picture();
    EXPECT_EQ(first.pixels, again.pixels);
    scene.context.sampleIndex = 1;
    const Image other = scene.picture();
    EXPECT_NE(first.pixels, other.pixels);
    EXPECT_NEAR(meanOf(other) / meanOf(first), 1, 0.01);
}

// A plate 2 m wide, 1 m below level water under a zenith sun: its shadow is the column below it.
TEST_F(WaterShafts, ThingsCutShafts) {
    ShaftScene scene(device(), 96, 64, levelWater());
    scene.bounds = {{-20, -10, -20}, {20, 0, 20}};
    scene.look({-6, -4, 0}, {0, -4, 0}, 30);
    scene.setDistances([](Vec3 d) { return 12 / double(d.x); });
    const Image open = scene.picture();
    scene.add(box({-1, -1.1f, -1}, {1, -1, 1}));
    const Image cut = scene.picture();
    const auto expected = [&](int x, int y) {
        const Vec3 d = scene.rayOf(x, y);
        const auto part = [&](double from, double to) {  // of the ray, metres along x
            water::analytic::ShaftRay ray{4, 0, double(d.x), double(d.y), double(d.z), to / double(d.x)};
            const double all = water::analytic::flatShaft({}, 0, ray);
            ray.length = from / double(d.x);
            return all - water::analytic::flatShaft({}, 0, ray);
        };
        return 1 - part(5, 7) / part(0, 12);
    };
    const auto ratio = [&](int x, int y) { return double(cut.at(x, y)[1]) / double(open.at(x, y)[1]); };
    for (const int y : {24, 32, 40, 52}) {
        EXPECT_NEAR(ratio(48, y), expected(48, y), 0.03) << y;
        EXPECT_NEAR(ratio(4, y), 1, 0.01) << y << " beside it";
    }
    EXPECT_LT(expected(48, 32), 0.88) << "the shadow is to be seen";
}

TEST_F(WaterShafts, ClearWaterScattersNothing) {
    ShaftScene scene(device(), 64, 48, patchP6());
    scene.setDistances([](Vec3) { return 8.0; });
    scene.optics = shaftOptics(0.1, 0);
    const Image picture = scene.picture();
    EXPECT_EQ(picture.pixels, std::vector<float>(picture.pixels.size(), 0.0f));
    scene.optics = shaftOptics();
    scene.params.enabled = false;
    const Image off = scene.picture();
    EXPECT_EQ(off.pixels, picture.pixels);
}

// Light without direction: level water of the sky alone, over an endless level path: b / c of the fluence over 4 pi.
TEST_F(WaterShafts, DistanceTurnsToTheWatersColour) {
    ShaftScene scene(device(), 32, 24, levelWater());
    scene.sunShines = false;
    scene.lights.skyIrradiance = {1, 1, 1};
    water::OpticsParams p;
    p.medium = "jerlov-IB";
    scene.optics = water::resolveOptics(p).value();
    scene.look({0, -2, 0}, {1, -2, 0}, 2);
    scene.setDistances([](Vec3) { return 0.0; });
    const Image picture = scene.picture();
    const Vec3 b = scene.optics.beamScattering(), c = scene.optics.beamAttenuation(),
               kd = scene.optics.diffuseAttenuation;
    const float* found = picture.at(16, 12);
    const auto expected = [](float scattering, float attenuation, float diffuse) {
        return scattering / attenuation * 0.934f * std::exp(-2 * diffuse) / 0.8f / (4 * kPi);
    };
    EXPECT_NEAR(found[0] / expected(b.x, c.x, kd.x), 1, 0.01);
    EXPECT_NEAR(found[1] / expected(b.y, c.y, kd.y), 1, 0.01);
    EXPECT_NEAR(found[2] / expected(b.z, c.z, kd.z), 1, 0.01);
    EXPECT_GT(found[2], 2 * found[0]) << "blue";
}

// A lamp in the water against a fine sum over each ray; a spot lights its cone alone.
TEST_F(WaterShafts, LampsInTheWaterScatter) {
    ShaftScene scene(device(), 96, 64, levelWater());
    scene.sunShines = false;
    scene.look({0, -5, 0}, {1, -5, 0}, 50);
    scene.setDistances([](Vec3) { return 12.0; });
    light::PunctualLight lamp;
    lamp.position = {5, -4.5f, 0.6f}, lamp.intensity = {10, 10, 10}, lamp.range = 0;
    lamp.direction = normalize(Vec3{0, -1, -1}), lamp.innerCone = 0.3f, lamp.outerCone = 0.4f;
    for (const bool spot : {false, true}) {
        lamp.kind = spot ? light::PunctualLight::Kind::spot : light::PunctualLight::Kind::point;
        scene.lamps = {lamp};
        const Image picture = scene.picture();
        double squares = 0, brightest = 0;
        for (int y = 0; y < picture.height; y += 3)
            for (int x = 0; x < picture.width; x += 3) {
                const Vec3 d = scene.rayOf(x, y);
                constexpr int kSteps = 2000;
                double sum = 0;
                for (int i = 0; i < kSteps; ++i) {
                    const float t = (float(i) + 0.5f) * 12 / kSteps;
                    const Vec3 p = scene.context.view.eye + d * t, away = p - lamp.position;
                    const double cosTheta = -double(dot(normalize(away), d));
                    sum += double(light::irradianceAt(lamp, p).x) * std::exp(-0.13 * double(length(away) + t)) *
                           water::analytic::henyeyGreenstein(0.924, cosTheta);
                }
                const double expected = 0.08 * sum * 12 / kSteps;
                brightest = std::max(brightest, expected);
                squares += (double(picture.at(x, y)[1]) - expected) * (double(picture.at(x, y)[1]) - expected);
            }
        const double rmse = std::sqrt(squares / (32 * 22));
        EXPECT_GT(brightest, 0.003);
        EXPECT_LT(rmse, 0.05 * brightest) << (spot ? "spot" : "point");
    }
}

// A lamp high above level water: straight below, its light falls as from its apparent place, index times as high.
TEST_F(WaterShafts, LampsAboveTheWaterScatter) {
    ShaftScene scene(device(), 48, 32, levelWater());
    scene.sunShines = false;
    scene.look({0, -3, 0}, {1, -3, 0}, 30);
    scene.setDistances([](Vec3) { return 10.0; });
    light::PunctualLight lamp;
    lamp.position = {5, 20, 0}, lamp.intensity = {400, 400, 400};
    scene.lamps = {lamp};
    scene.params.photons = 160000;
    const Image picture = scene.picture();
    const double index = 1.333, height = 20 * index;
    for (const int y : {4, 16, 28})
        for (const int x : {8, 24, 40}) {
            const Vec3 d = scene.rayOf(x, y);
            constexpr int kSteps = 2000;
            double sum = 0;
            for (int i = 0; i < kSteps; ++i) {
                const double t = (i + 0.5) * 10 / kSteps, depth = 3 - double(d.y) * t;
                const double aside = std::hypot(double(d.x) * t - 5, double(d.z) * t);
                const Vec3 way = normalize(scene.context.view.eye + d * float(t) - Vec3{5, float(height), 0});
                const double distance = std::hypot(height + depth, aside);
                const double level = 400 * 0.979627 * index * index / (distance * distance);
                sum += level * std::exp(-0.13 * (depth / -double(way.y) + t)) *
                       water::analytic::henyeyGreenstein(0.924, -double(dot(way, d)));
            }
            const double expected = 0.08 * sum * 10 / kSteps;
            EXPECT_NEAR(double(picture.at(x, y)[1]) / expected, 1, 0.03) << x << " " << y;
        }
}

}  // namespace
}  // namespace shoal::test
