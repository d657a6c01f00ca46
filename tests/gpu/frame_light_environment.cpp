// The prefiltered environment against the integral it stands for.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include <shoal/core/parallel.h>
#include <shoal/core/random.h>

#include "frame/environment_map.h"
#include "frame/glsl_compat.h"
#include "support/gl_device.h"
#include "support/lit_patch.h"

namespace shoal::frame::glsl {
#include "frame/brdf.lib.glsl"
}  // namespace shoal::frame::glsl

namespace shoal::frame {
namespace {

light::Environment constantMap(float radiance) {
    light::Environment environment;
    environment.radiance = Image(64, 32, 3);
    for (float& x : environment.radiance.pixels) x = radiance;
    return environment;
}

// Dim all around with one bright patch some 20 degrees wide.
light::Environment patchMap() {
    light::Environment environment = constantMap(0.2f);
    environment.radiance = Image(256, 128, 3);
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 256; ++x) {
            const bool bright = std::abs(x - 170) < 8 && std::abs(y - 50) < 8;
            for (int k = 0; k < 3; ++k) environment.radiance.at(x, y)[k] = bright ? 20.0f : 0.2f;
        }
    return environment;
}

// The split sum's first factor by brute force: L averaged with D(h) cos(h) cos(light), many random half vectors.
double lobeMean(const light::Environment& environment, Vec3 n, double roughness) {
    const double alpha = roughness * roughness;
    const Vec3 t = normalize(cross(std::abs(n.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n)), b = cross(n, t);
    double sum = 0, weights = 0;
    for (std::uint32_t i = 0; i < 60000; ++i) {
        const double u = double(randomFloat(11, i)), phi = 2 * kPiD * double(randomFloat(12, i));
        const double c = std::sqrt((1 - u) / (1 + (alpha * alpha - 1) * u)), s = std::sqrt(std::max(1 - c * c, 0.0));
        const double z = 2 * c * c - 1;
        if (z <= 0) continue;
        const Vec3 d = t * float(2 * c * s * std::cos(phi)) + b * float(2 * c * s * std::sin(phi)) + n * float(z);
        sum += double(light::lookUp(environment, d).x) * z;
        weights += z;
    }
    return sum / weights;
}

TEST(FramePrefilter, ConstantStaysConstant) {
    for (const PrefilteredLevel& level : prefilterEnvironment(constantMap(0.7f)))
        for (const Vec3& radiance : level.radiance) ASSERT_NEAR(radiance.x, 0.7f, 1e-4f) << level.size;
}

TEST(FramePrefilter, LevelsAreTheLobesIntegral) {
    const light::Environment environment = patchMap();
    const std::vector<PrefilteredLevel> levels = prefilterEnvironment(environment);
    ASSERT_GE(levels.size(), 4u);
    for (std::size_t l = 1; l < levels.size(); ++l) {
        const int size = levels[l].size;
        const double roughness = double(glsl::roughnessOfLevel(float(l), float(levels.size())));
        double error = 0, sum = 0;
        int count = 0;
        for (int y = 0; y < size; y += std::max(size / 8, 1))
            for (int x = 0; x < size; x += std::max(size / 8, 1)) {
                const glsl::vec3 d =
                    glsl::directionFromSquare({float(x) / float(size - 1), float(y) / float(size - 1)});
                const double expected = lobeMean(environment, {d.x, d.y, d.z}, roughness);
                error += std::abs(double(levels[l].radiance[std::size_t(y * size + x)].x) - expected);
                sum += expected;
                ++count;
            }
        EXPECT_LT(error / sum, 0.12) << "level " << l << ", mean radiance " << sum / count;
    }
}

TEST(FramePrefilter, BorderTexelsMeetTheirFold) {
    const std::vector<PrefilteredLevel> levels = prefilterEnvironment(patchMap());
    for (const PrefilteredLevel& level : levels)
        for (int i = 0; i < level.size; ++i) {
            const int j = level.size - 1 - i, last = level.size - 1;
            const auto at = [&](int x, int y) { return level.radiance[std::size_t(y * level.size + x)].x; };
            EXPECT_NEAR(at(0, i), at(0, j), 2e-2f * at(0, i));
            EXPECT_NEAR(at(i, last), at(j, last), 2e-2f * at(i, last));
        }
}

TEST(FramePrefilter, SameBitsForAnyThreadCount) {
    const light::Environment environment = patchMap();
    const std::vector<PrefilteredLevel> many = prefilterEnvironment(environment);
    const ThreadLimit one(1);
    const std::vector<PrefilteredLevel> single = prefilterEnvironment(environment);
    for (std::size_t l = 0; l < many.size(); ++l) EXPECT_EQ(many[l].radiance, single[l].radiance);
}

class FrameEnvironment : public test::GlTest {};

TEST_F(FrameEnvironment, MirrorsShowWhatTheyFace) {
    auto patch = std::make_unique<test::LitPatch>(device(), 16, 16);
    light::Environment environment;
    environment.radiance = Image(512, 256, 3);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 512; ++x) {
            const float u = (float(x) + 0.5f) / 512 * 2 * kPi, v = (float(y) + 0.5f) / 256 * kPi;
            float* p = environment.radiance.at(x, y);
            p[0] = 2 + std::sin(u), p[1] = 2 + std::cos(u), p[2] = 2 + std::cos(v);
        }
    for (const float rotation : {0.0f, 0.9f})
        for (const Vec3 normal : {Vec3{0, 0, 1}, normalize(Vec3{0.5f, 0.2f, 1}), normalize(Vec3{-0.3f, -0.6f, 1}),
                                  normalize(Vec3{0.1f, 0.7f, 1})}) {
            environment.rotation = rotation;
            ASSERT_TRUE(patch->lighting.setEnvironment(environment));
            patch->put({.normal = normal, .roughness = 0, .metallic = 1, .viewDepth = 3});
            const Vec3 toEye{0, 0, 1};  // orthographic
            const Vec3 expected = light::lookUp(environment, normal * (2 * dot(normal, toEye)) - toEye);
            const Vec4 got = patch->shaded({});
            EXPECT_NEAR(got.x, expected.x, 0.04f) << rotation << " " << normal.x << " " << normal.y;
            EXPECT_NEAR(got.y, expected.y, 0.04f);
            EXPECT_NEAR(got.z, expected.z, 0.04f);
        }
    patch.reset();
}

TEST_F(FrameEnvironment, RefusesWhatIsNoMap) {
    auto lighting = Lighting::create(device());
    ASSERT_TRUE(lighting) << lighting.error().message;
    EXPECT_FALSE(lighting->setEnvironment({}));
    light::Environment grey;
    grey.radiance = Image(4, 2, 1);
    const auto refused = lighting->setEnvironment(grey);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("3"), std::string::npos);
}

TEST_F(FrameEnvironment, OneBadTexelSpoilsNothing) {
    auto patch = std::make_unique<test::LitPatch>(device(), 16, 16);
    patch->put({.roughness = 1, .metallic = 1, .viewDepth = 3});
    light::Environment environment = constantMap(1);
    environment.radiance.at(5, 20)[0] = std::nanf("");
    environment.radiance.at(9, 3)[0] = -1e30f;
    ASSERT_TRUE(patch->lighting.setEnvironment(environment));
    EXPECT_NEAR(patch->shaded({}).x, 1, 0.02f);
    environment.radiance.at(9, 3)[0] = std::numeric_limits<float>::infinity();
    ASSERT_TRUE(patch->lighting.setEnvironment(environment));
    EXPECT_TRUE(std::isfinite(patch->shaded({}).x));
}

TEST_F(FrameEnvironment, HalvesKeepLargeAndTinyRadiance) {
    auto patch = std::make_unique<test::LitPatch>(device(), 16, 16, false);
    patch->params.background = "environment";
    patch->put({});
    for (const float radiance : {1e-6f, 3e-5f, 0.1f, 1.0f, 1000.0f, 60000.0f}) {
        patch->setConstantEnvironment(radiance);
        EXPECT_NEAR(patch->shaded({}).x, radiance, radiance * 1e-3f + 6e-8f);
    }
    patch->setConstantEnvironment(1e9f);  // beyond half floats: as bright as they go
    EXPECT_GT(patch->shaded({}).x, 60000);
    patch.reset();
}

}  // namespace
}  // namespace shoal::frame
