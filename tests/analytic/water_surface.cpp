// The water surface as it is seen against the laws of Snell, Fresnel and Beer.
#include <gtest/gtest.h>

#include <cmath>

#include "frame/glsl_compat.h"
#include "support/frame_scene.h"
#include "support/gl_device.h"
#include "support/water_surface_measure.h"

namespace shoal::frame::glsl {
#include "water/optics.lib.glsl"
#include "water/surface.lib.glsl"
}  // namespace shoal::frame::glsl

namespace shoal::water {
namespace {

namespace glsl = frame::glsl;
using WaterSurface = test::GlTest;

constexpr double kIndex = 1.333;

// An unlit sheet of one radiance, level, 400 m wide.
Model levelSheet(float y, Vec3 radiance) {
    Material material;
    material.unlit = true;
    material.baseColor = {radiance.x, radiance.y, radiance.z, 1};
    material.doubleSided = true;
    return test::modelOf({test::quad({-200, y, 200}, {400, 0, 0}, {0, 0, -400})}, {material});
}

void add(test::WaterStage& stage, const Model& model) {
    const auto id = stage.geometry->addModel(model);
    ASSERT_TRUE(id) << id.error().message;
    frame::InstanceDesc desc;
    desc.model = *id;
    ASSERT_TRUE(stage.geometry->addInstance(desc));
}

void setAbsorption(test::WaterStage& stage, Vec3 perMetre) {
    OpticsParams params;
    params.absorption = perMetre;
    params.scattering = {0, 0, 0};
    params.diffuseAttenuation = {10, 10, 10};
    stage.body.optics = resolveOptics(params).value();
}

// Looks down on the water so that the middle of the picture falls on it at `incidence` radians.
light::View viewAt(double incidence, int size = 65, float fov = radians(2), float distance = 5) {
    const Vec3 eye{0, distance * float(std::cos(incidence)), distance * float(std::sin(incidence))};
    return light::makeView(light::cameraLookingAt(eye, {0, 0, 0}, fov), size, size);
}

TEST(WaterSurfaceFunctions, LevelWaterReflectsWhatDoesNotPass) {
    for (const float c : {0.02f, 0.2f, 0.5f, 0.9f, 1.0f})
        EXPECT_FLOAT_EQ(glsl::roughReflectance(c, float(kIndex), 0),
                        1 - float(fresnelTransmittance(double(c), kIndex)));
    // Rough water reflects less where it is seen at grazing angles.
    EXPECT_LT(glsl::roughReflectance(0.05f, float(kIndex), 0.02f),
              0.6f * glsl::roughReflectance(0.05f, float(kIndex), 0));
}

TEST(WaterSurfaceFunctions, SlopesProjectToOne) {
    for (const double variance : {1e-3, 1e-2, 5e-2}) {
        double sum = 0;
        const int n = 200000;
        for (int i = 0; i < n; ++i) {
            const double c = (i + 0.5) / n;
            sum += 2 * kPiD * double(glsl::slopeDensity(float(c), float(variance))) * c / n;
        }
        EXPECT_NEAR(sum, 1, 2e-3) << variance;
    }
}

TEST(WaterSurfaceFunctions, SeenCosineIsThatOfTheFacets) {
    // c (1 + Lambda) by quadrature over slopes along the way to the eye [Smith 1967].
    for (const double variance : {1e-3, 1e-2, 4e-2})
        for (const double c : {0.02, 0.1, 0.3, 0.8}) {
            const double s = std::sqrt(1 - c * c), sigma = std::sqrt(variance);
            double sum = 0;
            const int n = 20000;
            for (int i = 0; i < n; ++i) {
                const double slope = (2 * (i + 0.5) / n - 1) * 8 * sigma;
                const double p = std::exp(-slope * slope / (2 * variance)) / (sigma * std::sqrt(2 * kPiD));
                sum += std::max(c + s * slope, 0.0) * p * 16 * sigma / n;
            }
            EXPECT_NEAR(double(glsl::seenCosine(float(c), float(variance))) / sum, 1, 0.3) << variance << " " << c;
        }
}

// Note 4.6. The full size is measured by the benchmark: here f is a quarter, and so is what is allowed.
TEST_F(WaterSurface, SnellsWindow) {
    const auto window = test::measureSnellWindow(device(), 480, 270);
    ASSERT_TRUE(window) << window.error().message;
    RecordProperty("radius_px", std::to_string(window->radiusPx));
    RecordProperty("zenith_factor", std::to_string(window->zenithFactor));
    EXPECT_NEAR(window->radiusPx, window->exactRadiusPx, 0.25);
    EXPECT_NEAR(window->zenithFactor, 1.740688, 0.003 * 1.740688);
    EXPECT_LT(window->darkOutside, 1e-3);
}

TEST_F(WaterSurface, ReflectanceOfLevelWater) {
    auto stage = test::WaterStage::create(device(), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    setAbsorption(**stage, {1, 1, 1});  // nothing comes back from below
    for (const double degrees : {0.0, 20.0, 45.0, 60.0, 70.0, 80.0, 85.0}) {
        const double incidence = degrees * kPiD / 180;
        const auto picture = (*stage)->draw(viewAt(incidence));
        ASSERT_TRUE(picture) << picture.error().message;
        const double expected = 1 - fresnelTransmittance(std::cos(incidence), kIndex);
        EXPECT_NEAR(double(picture->radiance.at(32, 32)[0]) / expected, 1, 0.01) << degrees;
    }
}

TEST_F(WaterSurface, AbsorptionAlongTheBentPath) {
    auto stage = test::WaterStage::create(device(), 0);  // a black sky: no reflection
    ASSERT_TRUE(stage) << stage.error().message;
    // The G-buffer keeps 6 and 5 bits of such radiance: a little more than 1.25 is cut to that.
    add(**stage, levelSheet(-3, {1.254f, 1.254f, 1.254f}));
    const Vec3 absorption{0.4f, 0.1f, 0.02f};
    setAbsorption(**stage, absorption);
    for (const double degrees : {0.0, 30.0, 60.0, 75.0}) {
        const double incidence = degrees * kPiD / 180;
        const auto picture = (*stage)->draw(viewAt(incidence, 65, radians(60)), true);
        ASSERT_TRUE(picture) << picture.error().message;
        const double cosRefracted = std::sqrt(1 - std::pow(std::sin(incidence) / kIndex, 2));
        const double lengthM = 3 / cosRefracted;
        const double passing = fresnelTransmittance(std::cos(incidence), kIndex) / (kIndex * kIndex);
        EXPECT_NEAR(double(picture->path.at(32, 32)[2]) / lengthM, 1, 2e-3) << degrees;
        EXPECT_NEAR(double(picture->waterDepth.at(32, 32)[0]), 3, 1e-3) << degrees;
        const double perMetre[3] = {double(absorption.x), double(absorption.y), double(absorption.z)};
        for (int k = 0; k < 3; ++k) {
            const double expected = passing * std::exp(-perMetre[k] * lengthM);
            EXPECT_NEAR(double(picture->radiance.at(32, 32)[k]) / (1.25 * expected), 1, 5e-3)
                << degrees << " channel " << k;
            EXPECT_NEAR(double(picture->transmittance.at(32, 32)[k]) / expected, 1, 5e-3)
                << degrees << " channel " << k;
        }
    }
}

// Unit direction through the middle of a pixel, row 0 on top.
Vec3 pixelRay(const light::View& view, int x, int y) {
    const Vec3 clip{2 * (float(x) + 0.5f) / float(view.width) - 1, 1 - 2 * (float(y) + 0.5f) / float(view.height), 1};
    return normalize(transformDirection(view.worldFromView, transformPoint(view.viewFromClip, clip)));
}

// A unit direction downwards, behind level water.
Vec3 bentRay(Vec3 d) {
    return {d.x / float(kIndex), -std::sqrt(1 - (1 - d.y * d.y) / float(kIndex * kIndex)), d.z / float(kIndex)};
}

// Where the floor is seen through level water, pixel by pixel.
TEST_F(WaterSurface, FloorAppearsWhereSnellPutsIt) {
    auto stage = test::WaterStage::create(device(), 0);
    ASSERT_TRUE(stage) << stage.error().message;
    (*stage)->params.reflections = false;  // the picture alone is searched
    add(**stage, levelSheet(-2, {1, 1, 1}));
    const int width = 320, height = 180;
    const Vec3 eye{1, 2, 3};
    const light::View view =
        light::makeView(light::cameraLookingAt(eye, {1.5f, -1.5f, -3}, radians(50)), width, height);
    const auto picture = (*stage)->draw(view);
    ASSERT_TRUE(picture) << picture.error().message;
    int compared = 0, outside = 0;
    double worst = 0;
    for (int y = 0; y < height; y += 3)
        for (int x = 0; x < width; x += 3) {
            const Vec3 d = pixelRay(view, x, y);
            if (d.y > -0.05f) continue;
            const Vec3 bent = bentRay(d), hit = eye + d * (-eye.y / d.y) + bent * (-2 / bent.y);
            const Vec3 seen = transformPoint(view.clipFromWorld(), hit);
            const double px = 0.5 * (double(seen.x) + 1) * width, py = 0.5 * (1 - double(seen.y)) * height;
            if (px < 1 || px > width - 1 || py < 1 || py > height - 1) {
                ++outside;
                continue;
            }
            const float* path = picture->path.at(x, y);
            const double gotX = x + 0.5 + double(path[0]) * width, gotY = y + 0.5 - double(path[1]) * height;
            worst = std::max(worst, std::hypot(gotX - px, gotY - py));
            ++compared;
        }
    EXPECT_GT(compared, 2000);
    EXPECT_GT(outside, 20);  // mirrored at the border
    EXPECT_LT(worst, 1.0);
    RecordProperty("worst_px", std::to_string(worst));
}

// The same through the view along bent rays: it has the patch under the picture's lower border too.
TEST_F(WaterSurface, FloorBeyondThePictureIsSeen) {
    auto stage = test::WaterStage::create(device(), 0);
    ASSERT_TRUE(stage) << stage.error().message;
    add(**stage, levelSheet(-2, {1, 1, 1}));
    Material dark;
    dark.unlit = true;
    dark.baseColor = {0.25f, 0.25f, 0.25f, 1};
    const Vec2 lo{0, -2.5f}, hi{2, 1.1f};  // of the patch: x and z
    add(**stage, test::modelOf({test::quad({lo.x, -1.999f, hi.y}, {hi.x - lo.x, 0, 0}, {0, 0, lo.y - hi.y})}, {dark}));
    const int width = 320, height = 180;
    const Vec3 eye{1, 2, 3};
    const light::View view =
        light::makeView(light::cameraLookingAt(eye, {1.5f, -1.5f, -3}, radians(50)), width, height);
    const auto picture = (*stage)->draw(view);
    ASSERT_TRUE(picture) << picture.error().message;
    int on = 0, off = 0, beyond = 0;
    for (int y = 0; y < height; y += 3)
        for (int x = 0; x < width; x += 3) {
            const Vec3 d = pixelRay(view, x, y);
            if (d.y > -0.1f) continue;
            const Vec3 bent = bentRay(d), hit = eye + d * (-eye.y / d.y) + bent * (-2 / bent.y);
            const float inwards = std::min({hit.x - lo.x, hi.x - hit.x, hit.z - lo.y, hi.y - hit.z});
            if (std::abs(inwards) < 0.02f * length(hit - eye)) continue;  // its rim
            const bool inside = inwards > 0;
            const double expected =
                fresnelTransmittance(double(-d.y), kIndex) / (kIndex * kIndex) * (inside ? 0.25 : 1.0);
            EXPECT_NEAR(double(picture->radiance.at(x, y)[0]) / expected, 1, 0.02) << x << " " << y;
            EXPECT_EQ(picture->path.at(x, y)[3], -2) << x << " " << y;
            EXPECT_NEAR(double(picture->path.at(x, y)[2]) * double(-bent.y), 2, 0.006) << x << " " << y;
            (inside ? on : off) += 1;
            const Vec3 seen = transformPoint(view.clipFromWorld(), hit);
            beyond += inside && seen.y < -1 ? 1 : 0;
        }
    EXPECT_GT(on, 300);
    EXPECT_GT(off, 2000);
    EXPECT_GT(beyond, 10);
}

// A lamp-like patch above level water is mirrored where the law of reflection puts it, as bright as Fresnel says.
TEST_F(WaterSurface, MirrorsWhatStandsAboveTheWater) {
    auto stage = test::WaterStage::create(device(), 0);
    ASSERT_TRUE(stage) << stage.error().message;
    setAbsorption(**stage, {1, 1, 1});
    Material bright;
    bright.unlit = true;
    bright.baseColor = {1, 0.5f, 0.25f, 1};
    add(**stage, test::modelOf({test::quad({-0.5f, 1, -6}, {1, 0, 0}, {0, 1, 0})}, {bright}));
    const int width = 240, height = 160;
    const Vec3 eye{0.4f, 1.5f, 2};
    const light::View view = light::makeView(light::cameraLookingAt(eye, {0, -0.5f, -6}, radians(50)), width, height);
    const auto picture = (*stage)->draw(view);
    ASSERT_TRUE(picture) << picture.error().message;
    // The middle of the sheet, mirrored: below the level.
    const Vec3 seen = transformPoint(view.clipFromWorld(), {0, -1.5f, -6});
    const double px = 0.5 * (double(seen.x) + 1) * width, py = 0.5 * (1 - double(seen.y)) * height;
    double sumX = 0, sumY = 0, sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            if (picture->surfaceDepth.at(x, y)[0] <= 0) continue;
            const double v = double(picture->radiance.at(x, y)[0]);
            sum += v, sumX += v * (x + 0.5), sumY += v * (y + 0.5);
        }
    ASSERT_GT(sum, 0);
    EXPECT_NEAR(sumX / sum, px, 1.5);
    EXPECT_NEAR(sumY / sum, py, 1.5);
    const Vec3 to = normalize(Vec3{0, -1.5f, -6} - eye);
    const double expected = 1 - fresnelTransmittance(double(-to.y), kIndex);
    const float* middle = picture->radiance.at(int(px), int(py));
    EXPECT_NEAR(double(middle[0]) / expected, 1, 0.02);
    EXPECT_NEAR(double(middle[2]) / expected, 0.25, 0.01);
}

// Under water, outside the window, the floor is mirrored in full; inside it what stands above appears where Snell says.
TEST_F(WaterSurface, TotalReflectionAndTheViewUpwards) {
    auto stage = test::WaterStage::create(device(), 0);
    ASSERT_TRUE(stage) << stage.error().message;
    add(**stage, levelSheet(-4, {0.5f, 0.5f, 0.5f}));
    add(**stage, levelSheet(30, {2, 2, 2}));
    const light::View view = light::makeView(light::cameraLookingAt({0, -2, 0}, {0, 0, -2.2f}, radians(90)), 160, 120);
    const auto picture = (*stage)->draw(view);
    ASSERT_TRUE(picture) << picture.error().message;
    for (int y = 0; y < 120; y += 7)
        for (int x = 0; x < 160; x += 7) {
            const Vec3 clip{2 * (float(x) + 0.5f) / 160 - 1, 1 - 2 * (float(y) + 0.5f) / 120, 1};
            const Vec3 d = normalize(transformDirection(view.worldFromView, transformPoint(view.viewFromClip, clip)));
            if (d.y < 0.1f) continue;
            const double sine = std::sqrt(1 - double(d.y * d.y)) * kIndex;
            if (std::abs(sine - 1) < 0.02 || (sine < 1 && sine > 0.9)) continue;  // 62 degrees: end of the view upwards
            const double passes = sine < 1 ? fresnelTransmittance(std::sqrt(1 - sine * sine), kIndex) : 0;
            const double expected = passes * kIndex * kIndex * 2 + (1 - passes) * 0.5;
            // The floor ends at 200 m.
            if (sine > 1 && 6 * std::sqrt(1 - double(d.y * d.y)) / double(d.y) > 150) continue;
            EXPECT_NEAR(double(picture->radiance.at(x, y)[0]) / expected, 1, 0.01) << x << " " << y << " " << sine;
        }
}

}  // namespace
}  // namespace shoal::water
