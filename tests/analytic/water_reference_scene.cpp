// The reference's pictures of irradiance and shafts against closed forms, and what stands in the light's way.
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <shoal/core/parallel.h>
#include <shoal/water/reference.h>

#include "support/known_waves.h"
#include "water/reference/eye_rays.h"

namespace shoal::water {
namespace {

using test::levelWater;
using test::sinusoidS1;
using test::toSunAt;

constexpr double kDegree = kPiD / 180;

// A rectangle of two triangles: corner, and two sides.
void addRectangle(ReferenceScene& scene, Vec3 corner, Vec3 u, Vec3 v) {
    for (const Vec3 p : {corner, corner + u, corner + u + v, corner, corner + u + v, corner + v})
        scene.triangles.push_back(p);
}

ReferenceScene floorAt(float depth, float halfSide = 50) {
    ReferenceScene scene;
    addRectangle(scene, {-halfSide, -depth, -halfSide}, {2 * halfSide, 0, 0}, {0, 0, 2 * halfSide});
    return scene;
}

// An orthographic picture of what lies below: `heightM` metres from top to bottom, right is +x, down is +z.
light::View viewFromAbove(int width, int height, float heightM) {
    light::Camera camera = light::cameraLookingAt({0, 20, 0}, {0, 0, 0}, 1, {0, 0, -1});
    camera.projection = light::Camera::Projection::orthographic;
    camera.heightM = heightM;
    return light::makeView(camera, width, height);
}

struct Water {
    WaveField waves;
    Body body;
    light::Sun sun;
    BodyLights lights;

    explicit Water(WaveField field, double zenith = 0, double attenuation = 0) : waves(std::move(field)) {
        body.waves = &waves;
        body.optics.absorption = Vec3{1, 2, 3} * float(attenuation);
        body.optics.scattering = {};
        body.optics.index = float(kWaterIndex);
        sun.toSun = toSunAt(zenith);
        sun.irradiance = {1, 2, 3};
        sun.discHalfAngle = 0;
        lights.sun = &sun;
    }
};

Image caustics(const ReferenceScene& scene, const Water& water, const light::View& view, std::int64_t rays) {
    ReferenceOptions options;
    options.rays = rays;
    auto image = referenceCaustics(scene, water.body, water.lights, view, options);
    EXPECT_TRUE(image) << (image ? "" : image.error().message);
    return image ? *std::move(image) : Image(view.width, view.height, 3);
}

double meanOf(const Image& image, int channel = 0) {
    double sum = 0;
    for (std::size_t i = std::size_t(channel); i < image.pixels.size(); i += 3) sum += image.pixels[i];
    return sum / (double(image.width) * image.height);
}

TEST(WaterReferenceScene, LevelWaterOnAFloor) {
    for (const double degrees : {0.0, 30.0, 60.0})
        for (const double attenuation : {0.0, 0.13}) {
            const Water water(levelWater(), degrees * kDegree, attenuation);
            const Image image = caustics(floorAt(4), water, viewFromAbove(8, 8, 4), 1'000'000);
            for (int channel = 0; channel < 3; ++channel) {
                const double expected =
                    (channel + 1) *
                    analytic::flatIrradiance(kWaterIndex, (channel + 1) * attenuation, degrees * kDegree, 4);
                EXPECT_NEAR(meanOf(image, channel), expected, 1e-3 * expected) << degrees;
            }
            const double red = analytic::flatIrradiance(kWaterIndex, attenuation, degrees * kDegree, 4);
            for (std::size_t i = 0; i < image.pixels.size(); i += 3)
                EXPECT_NEAR(image.pixels[i], red, 0.01 * red) << degrees;
        }
}

// The picture of an orthographic eye is the map: column by column the exact means.
TEST(WaterReferenceScene, SinusoidOnAFloor) {
    for (const double zenith : {0.0, 30 * kDegree, 60 * kDegree}) {
        const Water water(sinusoidS1(), zenith, .13);
        const Image image = caustics(floorAt(2), water, viewFromAbove(64, 8, .25f), 4'000'000);
        const analytic::Sinusoid s{.attenuation = .13, .zenithAngle = zenith};
        const std::vector<double> expected = analytic::sinusoidBins(s, 2, -1, 1, 64);
        for (int x = 0; x < image.width; ++x) {
            double column = 0;
            for (int y = 0; y < image.height; ++y) column += image.at(x, y)[0] / image.height;
            EXPECT_NEAR(column, expected[std::size_t(x)], .01 * expected[std::size_t(x)]) << zenith << " " << x;
        }
    }
}

// A perspective eye in the water that looks at a slanted wall: irradiance is E on a plane facing the beam times the
// cosine.
TEST(WaterReferenceScene, SlantedWallSeenFromTheWater) {
    const Water water(levelWater(), 30 * kDegree);
    ReferenceScene scene;  // its normal (-1, 1, 0) / sqrt 2 towards the light
    addRectangle(scene, {-1, -6, -30}, {4, 4, 0}, {0, 0, 60});
    const light::View view = light::makeView(light::cameraLookingAt({-3, -2.5f, 1}, {1, -4, 0}, radians(20)), 16, 12);
    const Image image = caustics(scene, water, view, 2'000'000);
    const double sine = std::sin(30 * kDegree) / kWaterIndex, cosine = std::sqrt(1 - sine * sine);
    const double beam = analytic::flatIrradiance(kWaterIndex, 0, 30 * kDegree, 1) / cosine;
    const double expected = beam * (cosine + sine) / std::sqrt(2);
    EXPECT_NEAR(meanOf(image), expected, 2e-3 * expected);
    // From behind the wall the lit side is not seen.
    const light::View behind = light::makeView(light::cameraLookingAt({3, -6, 0}, {1, -4, 0}, radians(20)), 8, 8);
    for (const float irradiance : caustics(scene, water, behind, 100'000).pixels) EXPECT_EQ(irradiance, 0);
}

// A plate in the air and one in the water cut the light; their shadows lie where Snell says.
TEST(WaterReferenceScene, PlatesCutTheLight) {
    const double zenith = 40 * kDegree, drift = std::tan(std::asin(std::sin(zenith) / kWaterIndex));
    const Water water(levelWater(), zenith);
    const double lit = analytic::flatIrradiance(kWaterIndex, 0, zenith, 3);
    for (const bool above : {true, false}) {
        ReferenceScene scene = floorAt(3);
        const float height = above ? 1 : -1;
        addRectangle(scene, {-40, height, -40}, {40, 0, 0}, {0, 0, 80});  // its edge at x = 0
        const double edge = above ? std::tan(zenith) + 3 * drift : 2 * drift;
        // Seen from under the plate.
        const light::View view =
            light::makeView(light::cameraLookingAt({float(edge), -1.2f, 3}, {float(edge), -3, 0}, radians(30)), 64, 8);
        const Image image = caustics(scene, water, view, 2'000'000);
        for (int x = 0; x < image.width; ++x) {
            if (std::abs(x - 31.5) < 2) continue;
            double column = 0;
            for (int y = 0; y < image.height; ++y) column += image.at(x, y)[0] / image.height;
            if (x < 32)
                EXPECT_EQ(column, 0) << above << " " << x;
            else
                EXPECT_NEAR(column, lit, .02 * lit) << above << " " << x;
        }
    }
}

// A lamp above level water: straight below it, E = I T / (H + D / n)^2 (its apparent place), and what falls on a wide
// floor is what entered.
TEST(WaterReferenceScene, LampAboveTheWater) {
    Water water(levelWater());
    light::PunctualLight lamp;
    lamp.position = {0, 1.5f, 0};
    lamp.intensity = {30, 30, 30};
    water.lights.sun = nullptr;
    water.lights.punctual = std::span(&lamp, 1);
    const Image below = caustics(floorAt(2), water, viewFromAbove(4, 4, .1f), 400'000);
    const double expected = 30 * .979627 / std::pow(1.5 + 2 / kWaterIndex, 2);
    EXPECT_NEAR(meanOf(below), expected, 3e-3 * expected);

    const Image wide = caustics(floorAt(2), water, viewFromAbove(64, 64, 16), 2'000'000);
    double entered = 0;  // of all that lands within the picture, by quadrature over the lamp's angle
    constexpr int kRings = 4000, kTurns = 64;
    for (int ring = 0; ring < kRings; ++ring) {
        const double angle = (ring + .5) / kRings * kPiD / 2, cosine = std::cos(angle);
        const double landing = 1.5 * std::tan(angle) + 2 * std::tan(std::asin(std::sin(angle) / kWaterIndex));
        const double power = 30 * fresnelTransmittance(cosine, kWaterIndex) * std::sin(angle) * (kPiD / 2 / kRings);
        for (int turn = 0; turn < kTurns; ++turn) {
            const double azimuth = 2 * kPiD * (turn + .5) / kTurns;
            if (std::max(std::abs(std::cos(azimuth)), std::abs(std::sin(azimuth))) * landing < 8)
                entered += power * 2 * kPiD / kTurns;
        }
    }
    EXPECT_NEAR(meanOf(wide) * 16 * 16, entered, 3e-3 * entered);

    lamp.position.y = -1;  // in the water: no caustics of it
    for (const float irradiance : caustics(floorAt(2), water, viewFromAbove(4, 4, 1), 1000).pixels)
        EXPECT_EQ(irradiance, 0);
}

TEST(WaterReferenceScene, NoSceneNoLightNoRays) {
    const Water water(sinusoidS1());
    for (const float v : caustics({}, water, viewFromAbove(4, 4, 1), 1000).pixels) EXPECT_EQ(v, 0);
    for (const float v : caustics(floorAt(2), water, viewFromAbove(4, 4, 1), 0).pixels) EXPECT_EQ(v, 0);
    Water dark(sinusoidS1());
    dark.lights.sun = nullptr;
    for (const float v : caustics(floorAt(2), dark, viewFromAbove(4, 4, 1), 1000).pixels) EXPECT_EQ(v, 0);
}

TEST(WaterReferenceScene, SameForAnyThreadCount) {
    const Water water(test::patchP6(), .4, .1);
    const auto draw = [&](int threads) {
        const ThreadLimit limit(threads);
        return caustics(floorAt(3), water, viewFromAbove(32, 32, 2), 200'000);
    };
    EXPECT_EQ(draw(1).pixels, draw(0).pixels);
}

TEST(WaterReferenceScene, StopsWhenAsked) {
    const Water water(levelWater());
    ReferenceOptions options;
    options.rays = 10'000'000;
    options.progress = [](std::uint64_t, std::uint64_t) { return false; };
    const auto image = referenceCaustics(floorAt(3), water.body, water.lights, viewFromAbove(8, 8, 2), options);
    ASSERT_FALSE(image);
    EXPECT_EQ(image.error().kind, ErrorKind::cancelled);
}

// Scattering of the note's check values, the same in all channels.
void makeMurky(Water& water) {
    const analytic::ShaftMedium medium;
    water.body.optics.scattering = Vec3{1, 1, 1} * float(medium.scattering);
    water.body.optics.absorption = Vec3{1, 1, 1} * float(medium.attenuation - medium.scattering);
    water.body.optics.anisotropy = float(medium.anisotropy);
    water.sun.irradiance = {1, 2, 3};
}

Image inscatter(const ReferenceScene& scene, const Water& water, const light::View& view, std::int64_t rays,
                int steps = 512) {
    ReferenceOptions options;
    options.rays = rays;
    options.steps = steps;
    auto image = referenceInscatter(scene, water.body, water.lights, view, options);
    EXPECT_TRUE(image) << (image ? "" : image.error().message);
    return image ? *std::move(image) : Image(view.width, view.height, 3);
}

// The view ray of a pixel's middle, down to a floor at `depth` (or up to the level).
analytic::ShaftRay rayOf(const light::View& view, int x, int y, double floorDepth) {
    const EyeRays::Ray ray = EyeRays(view).through(x + .5, y + .5);
    analytic::ShaftRay shaft{-view.eye.y, view.eye.x, ray.direction.x, ray.direction.y, ray.direction.z, 0};
    shaft.length =
        ray.direction.y < 0 ? (floorDepth - shaft.eyeDepth) / -ray.direction.y : shaft.eyeDepth / ray.direction.y;
    return shaft;
}

TEST(WaterReferenceScene, ShaftsInLevelWater) {
    for (const double zenith : {0.0, 30 * kDegree}) {
        Water water(levelWater(), zenith);
        makeMurky(water);
        for (const float vy : {-.8f, -.5f, .5f, .9f}) {
            const Vec3 eye{.3f, -2, 0}, direction{std::sqrt(1 - vy * vy) * .6f, vy, std::sqrt(1 - vy * vy) * .8f};
            const light::View view = light::makeView(light::cameraLookingAt(eye, eye + direction, radians(2)), 4, 4);
            const Image image = inscatter(floorAt(6), water, view, 20'000);
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x) {
                    const double expected = analytic::flatShaft({}, zenith, rayOf(view, x, y, 6));
                    for (int channel = 0; channel < 3; ++channel)
                        EXPECT_NEAR(image.at(x, y)[channel], (channel + 1) * expected, 2e-3 * (channel + 1) * expected)
                            << zenith << " " << vy;
                }
        }
    }
}

// The three rays of the note, whose ends are level and 4 and 10 m long: a wall stands there.
TEST(WaterReferenceScene, ShaftsOfTheNote) {
    Water water(levelWater());
    makeMurky(water);
    struct Row {
        float vy, length;
        double expected;
    };
    for (const Row& row : {Row{0, 10, .00155893}, Row{.5f, 4, .00276248}, Row{-.5f, 10, .00066805}}) {
        const Vec3 eye{0, -2, 0}, direction{std::sqrt(1 - row.vy * row.vy), row.vy, 0};
        const Vec3 end = eye + direction * row.length;
        ReferenceScene scene;  // a small plate across the ray
        const Vec3 across{-direction.y, direction.x, 0};
        if (row.vy <= 0)  // the other one ends at the surface
            addRectangle(scene, end - across * .02f - Vec3{0, 0, .2f}, across * .04f, {0, 0, .4f});
        const light::View view = light::makeView(light::cameraLookingAt(eye, end, radians(.1f)), 1, 1);
        EXPECT_NEAR(inscatter(scene, water, view, 20'000).at(0, 0)[0], row.expected, 2e-3 * row.expected) << row.vy;
    }
}

// Before the first focus pixel by pixel; past it, where a ray through a fold is unbounded, in the mean.
TEST(WaterReferenceScene, ShaftsUnderASinusoid) {
    for (const auto& [zenith, depth] : {std::pair{0.0, 6.0}, {30 * kDegree, 4.5}, {0.0, 12.0}}) {
        Water water(sinusoidS1(), zenith);
        makeMurky(water);
        const light::View view =
            light::makeView(light::cameraLookingAt({.2f, -2, 0}, {1.2f, -2.5f, .3f}, radians(40)), 9, 6);
        const Image image = inscatter(floorAt(float(depth)), water, view, 4'000'000, 1024);
        const analytic::Sinusoid s{.zenithAngle = zenith};
        double worst = 0, sum = 0, expectedSum = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const analytic::ShaftRay ray = rayOf(view, x, y, depth);
                if (std::abs(ray.vy) < .1) continue;  // cut off at a transmittance of 1e-4
                const double expected = analytic::sinusoidShaft({}, s, ray, 600, depth > 8 ? .04 : 0);
                worst = std::max(worst, std::abs(image.at(x, y)[0] / expected - 1));
                sum += image.at(x, y)[0], expectedSum += expected;
            }
        if (depth < 8) {
            EXPECT_LT(worst, 5e-3) << zenith;
        }
        EXPECT_NEAR(sum, expectedSum, 5e-3 * expectedSum) << zenith << " " << depth;
    }
}

// A wide plate above the water leaves the water below it dark; one with its edge over the ray halves it.
TEST(WaterReferenceScene, PlatesCutShafts) {
    Water water(levelWater());
    makeMurky(water);
    const light::View view = light::makeView(light::cameraLookingAt({0, -2, 0}, {4, -2, 0}, radians(.2f)), 1, 1);
    for (const bool above : {true, false}) {
        const float height = above ? 1 : -1;
        ReferenceScene scene;
        addRectangle(scene, {8, -4, -2}, {0, 4, 0}, {0, 0, 4});  // the end of the path
        const double whole = inscatter(scene, water, view, 40'000).at(0, 0)[0];
        const double first = analytic::flatShaft({}, 0, {2, 0, 1, 0, 0, 4});
        ReferenceScene half = scene, dark = scene;
        addRectangle(half, {4, height, -3}, {10, 0, 0}, {0, 0, 6});
        addRectangle(dark, {-9, height, -9}, {20, 0, 0}, {0, 0, 18});
        EXPECT_NEAR(inscatter(half, water, view, 40'000).at(0, 0)[0], first, .01 * first) << above;
        EXPECT_LT(inscatter(dark, water, view, 40'000).at(0, 0)[0], 1e-9 * whole) << above;
    }
}

// Under the sun's disc, light and direction are spread over it: the mean over 16 directions of level water.
TEST(WaterReferenceScene, ShaftsUnderTheSunsDisc) {
    Water water(levelWater());
    makeMurky(water);
    water.sun.discHalfAngle = .05f;
    const light::View view = light::makeView(light::cameraLookingAt({0, -2, 0}, {1, -2.5f, 0}, radians(1)), 2, 2);
    const Image image = inscatter(floorAt(5), water, view, 400'000, 1024);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 2; ++x) {
            const double expected = analytic::flatShaft({}, 0, rayOf(view, x, y, 5));
            EXPECT_NEAR(image.at(x, y)[0], expected, .01 * expected);
        }
}

// A torch in the water, seen across: L = integral of b p I exp(-c (r + t)) / r^2.
TEST(WaterReferenceScene, TorchInTheWater) {
    Water water(levelWater());
    makeMurky(water);
    light::PunctualLight torch;
    torch.position = {3, -4, 0};
    torch.intensity = {5, 5, 5};
    water.lights.sun = nullptr;
    water.lights.punctual = std::span(&torch, 1);
    const light::View view = light::makeView(light::cameraLookingAt({0, -3, 0}, {1, -3, 0}, radians(.1f)), 1, 1);
    ReferenceScene scene;
    addRectangle(scene, {8, -4, -2}, {0, 4, 0}, {0, 0, 4});
    double expected = 0;
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double t = (i + .5) * 8 / kSteps, r = std::hypot(3 - t, 1.0), cosine = (3 - t) / r;
        expected +=
            .08 * analytic::henyeyGreenstein(.924, cosine) * 5 / (r * r) * std::exp(-.13 * (r + t)) * 8 / kSteps;
    }
    EXPECT_NEAR(inscatter(scene, water, view, 1000).at(0, 0)[0], expected, 2e-3 * expected);
}

TEST(WaterReferenceScene, ShaftsAreTheSameForAnyThreadCount) {
    Water water(test::patchP6(), .4);
    makeMurky(water);
    const light::View view = light::makeView(light::cameraLookingAt({0, -2, 0}, {1, -2.5f, 0}, radians(30)), 24, 16);
    const auto draw = [&](int threads) {
        const ThreadLimit limit(threads);
        return inscatter(floorAt(4), water, view, 100'000, 64);
    };
    EXPECT_EQ(draw(1).pixels, draw(0).pixels);
}

}  // namespace
}  // namespace shoal::water
