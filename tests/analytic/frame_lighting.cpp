// Light on one surface, where the answer is a formula.
#include <gtest/gtest.h>

#include "support/gl_device.h"
#include "support/lit_patch.h"

namespace shoal::frame {
namespace {

using test::Patch;

// Radiance is stored as half floats (relative step 2^-11), base colour and roughness as 8 bits, normals as 16.
constexpr float kStored = 1e-3f;

class FrameLighting : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        patch_ = std::make_unique<test::LitPatch>(device(), 16, 16);
    }
    void TearDown() override {
        patch_.reset();
        GlTest::TearDown();
    }
    std::unique_ptr<test::LitPatch> patch_;
};

light::Sun sunAt(float zenithAngle) {  // from the normal +z
    light::Sun sun;
    sun.toSun = {std::sin(zenithAngle), 0, std::cos(zenithAngle)};
    sun.irradiance = {8, 6, 4};
    sun.castsShadow = false;
    return sun;
}

TEST_F(FrameLighting, LambertPlaneUnderTheSun) {
    const Vec3 albedo = test::storedBaseColor({0.5f, 0.25f, 0.8f});
    patch_->put({.baseColor = albedo, .viewDepth = 3});
    for (const float angle : {0.0f, 0.4f, 1.0f, 1.4f}) {
        const light::Sun sun = sunAt(angle);
        const Vec4 got = patch_->shaded({&sun, {}});
        const Vec3 expected = albedo * sun.irradiance * (std::cos(angle) / kPi);
        EXPECT_NEAR(got.x, expected.x, expected.x * kStored) << angle;
        EXPECT_NEAR(got.y, expected.y, expected.y * kStored) << angle;
        EXPECT_NEAR(got.z, expected.z, expected.z * kStored) << angle;
        EXPECT_EQ(got.w, 1);
    }
    const light::Sun below = sunAt(1.7f);
    EXPECT_EQ(patch_->shaded({&below, {}}).x, 0);
}

TEST_F(FrameLighting, NoLightNoRadiance) {
    patch_->put({.viewDepth = 3});
    EXPECT_EQ(patch_->shaded({}), (Vec4{0, 0, 0, 1}));
}

// A surface that absorbs nothing, in light of radiance 1 from everywhere, cannot be told from it. The split sum is a
// fit: its error (brdf.lib.glsl) cancels for white surfaces by construction; what is left is the prefiltered map's and
// 8-bit storage.
TEST_F(FrameLighting, WhiteFurnace) {
    patch_->setConstantEnvironment(1);
    for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f})
        for (const float tilt : {0.0f, 0.7f, 1.3f, 1.5f})
            for (const float metallic : {0.0f, 1.0f}) {
                patch_->put({.normal = {std::sin(tilt), 0, std::cos(tilt)},
                             .roughness = roughness,
                             .metallic = metallic,
                             .f0 = 0.04f,
                             .viewDepth = 3});
                const Vec4 got = patch_->shaded({});
                EXPECT_NEAR(got.x, 1, 3e-3f)
                    << "roughness " << roughness << " tilt " << tilt << " metallic " << metallic;
            }
}

// A dark dielectric reflects its specular albedo alone: near f0 seen straight, much more at grazing angles.
TEST_F(FrameLighting, DielectricReflectsLittleStraightAndMuchGrazing) {
    patch_->setConstantEnvironment(1);
    patch_->put({.baseColor = {0, 0, 0}, .roughness = 0, .f0 = 0.04f, .viewDepth = 3});
    EXPECT_NEAR(patch_->shaded({}).x, 0.04f, 0.015f);
    patch_->put({.normal = {std::sin(1.45f), 0, std::cos(1.45f)},
                 .baseColor = {0, 0, 0},
                 .roughness = 0,
                 .f0 = 0.04f,
                 .viewDepth = 3});
    const float schlick = 0.04f + 0.96f * std::pow(1 - std::cos(1.45f), 5.0f);
    EXPECT_NEAR(patch_->shaded({}).x, schlick, 0.05f);
}

TEST_F(FrameLighting, EnvironmentOfOneHarmonicLightsAsInTheClosedForm) {
    // Radiance 1 + y: irradiance is pi (1 + 2/3 n.y) [Ramamoorthi & Hanrahan 2001].
    light::Environment environment;
    environment.radiance = Image(128, 64, 3);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            for (int k = 0; k < 3; ++k) environment.radiance.at(x, y)[k] = 1 + std::cos(kPi * (float(y) + 0.5f) / 64);
    ASSERT_TRUE(patch_->lighting.setEnvironment(environment));
    const float albedo = test::storedBaseColor({0.5f, 0.5f, 0.5f}).x;
    for (const float y : {-0.8f, -0.3f, 0.0f, 0.5f, 0.9f}) {
        patch_->put({.normal = {0, y, std::sqrt(1 - y * y)}, .baseColor = {albedo, albedo, albedo}, .viewDepth = 3});
        EXPECT_NEAR(patch_->shaded({}).x, albedo * (1 + 2 * y / 3), 2e-3f) << y;
    }
}

TEST_F(FrameLighting, PointLightFallsWithTheSquareOfDistance) {
    const float albedo = test::storedBaseColor({0.6f, 0.6f, 0.6f}).x;
    patch_->put({.baseColor = {albedo, albedo, albedo}, .viewDepth = 3});
    // The middle pixel of 16 x 16 (x = y = 8, from the top) is half a pixel right of and below the axis, a pixel being
    // 2 / 16 m.
    const Vec3 point{0.0625f, -0.0625f, -3};
    for (const float distance : {0.5f, 1.0f, 2.0f, 2.9f}) {
        light::PunctualLight light;
        light.position = point + Vec3{0, 0, distance};
        light.intensity = {10, 10, 10};
        const Vec4 got = patch_->shaded({nullptr, {&light, 1}});
        const float expected = albedo / kPi * 10 / (distance * distance);
        EXPECT_NEAR(got.x, expected, expected * kStored) << distance;
    }
}

TEST_F(FrameLighting, SpotsAndRangesFollowTheLightModule) {
    const float albedo = test::storedBaseColor({0.6f, 0.6f, 0.6f}).x;
    patch_->put({.baseColor = {albedo, albedo, albedo}, .viewDepth = 3});
    const Vec3 point{0.0625f, -0.0625f, -3};
    light::PunctualLight light;
    light.kind = light::PunctualLight::Kind::spot;
    light.position = point + Vec3{0, 0, 2};
    light.intensity = {10, 10, 10};
    light.innerCone = 0.2f, light.outerCone = 0.5f;
    light.range = 5;
    float last = 1e9f;
    for (const float off : {0.0f, 0.1f, 0.3f, 0.4f, 0.6f}) {  // angle between the axis and the point
        light.direction = {std::sin(off), 0, -std::cos(off)};
        const float expected = albedo / kPi * light::irradianceAt(light, point).x;
        const float got = patch_->shaded({nullptr, {&light, 1}}).x;
        EXPECT_NEAR(got, expected, expected * kStored + 1e-6f) << off;
        EXPECT_LE(got, last);
        last = got;
    }
    EXPECT_EQ(last, 0);
    light.direction = {0, 0, -1};
    light.range = 1.9f;
    EXPECT_EQ(patch_->shaded({nullptr, {&light, 1}}).x, 0);
}

TEST_F(FrameLighting, GivenIrradianceTakesTheSunsPlaceWhereItCovers) {
    const float albedo = test::storedBaseColor({0.6f, 0.6f, 0.6f}).x;
    patch_->put({.baseColor = {albedo, albedo, albedo}, .viewDepth = 3});
    gl::Texture given =
        gl::Texture::create(device(), {.format = GL_RGBA16F, .width = 16, .height = 16, .label = "given"});
    const light::Sun sun = sunAt(0.5f);
    const float covered[4] = {3, 3, 3, 1}, open[4] = {3, 3, 3, 0};
    given.clear(GL_RGBA, GL_FLOAT, covered);
    const float expected = albedo / kPi * 3;
    EXPECT_NEAR(patch_->shaded({&sun, {}}, {given, {}}).x, expected, expected * kStored);
    given.clear(GL_RGBA, GL_FLOAT, open);
    const float both = expected + albedo / kPi * 8 * std::cos(0.5f);
    EXPECT_NEAR(patch_->shaded({&sun, {}}, {given, {}}).x, both, both * kStored);
    const float alone = patch_->shaded({}, {given, {}}).x;
    EXPECT_NEAR(alone, expected, expected * kStored);
}

TEST_F(FrameLighting, GivenEnvironmentIsAddedAndTakesItsPlaceWhereItCovers) {
    const float albedo = test::storedBaseColor({0.6f, 0.6f, 0.6f}).x;
    patch_->put({.baseColor = {albedo, albedo, albedo}, .viewDepth = 3});
    patch_->setConstantEnvironment(2);
    gl::Texture given =
        gl::Texture::create(device(), {.format = GL_RGBA16F, .width = 16, .height = 16, .label = "given"});
    const float around = patch_->shaded({}).x;  // of radiance 2
    for (const float share : {0.0f, 0.5f, 1.0f}) {
        const float texel[4] = {1, 1, 1, share};
        given.clear(GL_RGBA, GL_FLOAT, texel);
        const float expected = around * (1 - share) + around / 2;
        EXPECT_NEAR(patch_->shaded({}, {{}, given}).x, expected, expected * kStored) << share;
    }
}

TEST_F(FrameLighting, AMediumDimsLampsInIt) {
    const float albedo = test::storedBaseColor({0.6f, 0.6f, 0.6f}).x;
    const float depth = 3;
    patch_->put({.baseColor = {albedo, albedo, albedo}, .viewDepth = depth});
    light::PunctualLight lamp;
    lamp.position = {0, 0, -1};
    Lights lights{nullptr, {&lamp, 1}};
    const float dry = patch_->shaded(lights).x;
    lights.medium = {.level = 100, .beamAttenuation = {0.4f, 0.4f, 0.4f}};
    EXPECT_NEAR(patch_->shaded(lights).x, dry * std::exp(-0.4f * (depth - 1)), dry * kStored * 2);
}

TEST_F(FrameLighting, PrelitAndUnlitSurfacesKeepTheirRadiance) {
    patch_->setConstantEnvironment(1);
    const light::Sun sun = sunAt(0.2f);
    for (const std::uint32_t flags : {kFlagPrelit, kFlagUnlit}) {
        patch_->put({.emission = {0.5f, 0.25f, 2}, .flags = flags, .viewDepth = 3});
        EXPECT_EQ(patch_->shaded({&sun, {}}), (Vec4{0.5f, 0.25f, 2, 1}));
    }
    patch_->put({.baseColor = {0, 0, 0}, .emission = {0.5f, 0.25f, 2}, .viewDepth = 3});
    EXPECT_EQ(patch_->shaded({}), (Vec4{0.5f, 0.25f, 2, 1})) << "emission is added to black";
}

TEST_F(FrameLighting, TermsAreWhatTheyAreCalled) {
    patch_->setConstantEnvironment(1);
    patch_->lighting.setTermsWanted(true);
    const float albedo = test::storedBaseColor({0.6f, 0.6f, 0.6f}).x;
    patch_->put({.baseColor = {albedo, albedo, albedo}, .emission = {1, 1, 1}, .viewDepth = 3});
    const light::Sun sun = sunAt(0.5f);
    const float sunPart = albedo / kPi * 8 * std::cos(0.5f);
    EXPECT_NEAR(patch_->shaded({&sun, {}}).x, 1 + albedo + sunPart, 5e-3f);
    const Image direct = *readImage(device(), patch_->lighting.direct(), 3);
    EXPECT_NEAR(direct.at(8, 8)[0], sunPart, sunPart * kStored);
    EXPECT_EQ(readImage(device(), patch_->lighting.shadow(), 1)->at(8, 8)[0], 1);
}

TEST_F(FrameLighting, BackgroundsCoverOrDoNot) {
    patch_->put({});
    patch_->params.backgroundColor = {0.25f, 0.5f, 1};
    EXPECT_EQ(patch_->shaded({}), (Vec4{0.25f, 0.5f, 1, 1}));
    patch_->params.background = "transparent";
    EXPECT_EQ(patch_->shaded({}), (Vec4{0, 0, 0, 0}));
}

// ---- the environment behind everything ----

class FrameBackground : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        patch_ = std::make_unique<test::LitPatch>(device(), 64, 48, false);
        patch_->params.background = "environment";
        patch_->put({});
    }
    void TearDown() override {
        patch_.reset();
        GlTest::TearDown();
    }
    Vec3 directionOf(int x, int y) const {  // of pixel (x, y) from the top
        const light::View& view = patch_->context.view;
        const Vec3 ndc{2 * (float(x) + 0.5f) / float(view.width) - 1, 1 - 2 * (float(y) + 0.5f) / float(view.height),
                       1};
        return normalize(transformDirection(view.worldFromView, transformPoint(view.viewFromClip, ndc)));
    }
    std::unique_ptr<test::LitPatch> patch_;
};

TEST_F(FrameBackground, ShowsWhatLiesInTheDirectionOfEachPixel) {
    light::Environment environment;
    environment.radiance = Image(64, 32, 3);  // smooth, without symmetry
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x) {
            const float u = (float(x) + 0.5f) / 64 * 2 * kPi, v = (float(y) + 0.5f) / 32 * kPi;
            float* p = environment.radiance.at(x, y);
            p[0] = 2 + std::sin(u), p[1] = 2 + std::cos(u), p[2] = 2 + std::cos(v);
        }
    for (const float rotation : {0.0f, 1.1f, -2.5f})
        for (const Vec3 target :
             {Vec3{0, 0, -1}, Vec3{1, 0.3f, 0.2f}, Vec3{-0.5f, -0.7f, 0.8f}, Vec3{0.05f, 1, 0.02f}}) {
            environment.rotation = rotation;
            ASSERT_TRUE(patch_->lighting.setEnvironment(environment));
            patch_->context.view = light::makeView(light::cameraLookingAt({0, 0, 0}, target, radians(60)), 64, 48);
            patch_->shaded({});
            const Image got = *readImage(device(), patch_->targets.radiance(), 3);
            for (const auto& [x, y] : {std::pair{0, 0}, {63, 0}, {32, 24}, {5, 40}, {60, 47}}) {
                const Vec3 expected = light::lookUp(environment, directionOf(x, y));
                EXPECT_NEAR(got.at(x, y)[0], expected.x, 0.01f) << rotation << " pixel " << x << " " << y;
                EXPECT_NEAR(got.at(x, y)[1], expected.y, 0.01f);
                EXPECT_NEAR(got.at(x, y)[2], expected.z, 0.01f);
            }
        }
}

TEST_F(FrameBackground, BlurredAndSharpAgreeOnASmoothSky) {
    light::Environment environment;
    environment.radiance = Image(128, 64, 3);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x)
            for (int k = 0; k < 3; ++k)
                environment.radiance.at(x, y)[k] = 1 + 0.5f * std::cos(kPi * (float(y) + 0.5f) / 64);
    ASSERT_TRUE(patch_->lighting.setEnvironment(environment));
    const Vec4 sharp = patch_->shaded({});
    patch_->params.backgroundBlur = 0.4f;
    const Vec4 blurred = patch_->shaded({});
    EXPECT_NEAR(blurred.x, sharp.x, 0.03f);
}

TEST_F(FrameBackground, TheSunsDiscIsWhereTheSunIs) {
    patch_->setConstantEnvironment(0.5f);
    light::Sun sun;
    sun.toSun = directionOf(20, 10);
    sun.discHalfAngle = radians(2.5f);  // some 4 pixels
    sun.irradiance = {9, 9, 9};
    patch_->shaded({&sun, {}});
    const Image got = *readImage(device(), patch_->targets.radiance(), 3);
    const float disc = 9 / (2 * kPi * (1 - std::cos(sun.discHalfAngle)));
    EXPECT_NEAR(got.at(20, 10)[0], 0.5f + disc / (1 + disc / 40000), 1.0f);
    EXPECT_NEAR(got.at(40, 30)[0], 0.5f, kStored);
    EXPECT_NEAR(got.at(20, 16)[0], 0.5f, kStored) << "6 pixels off is beyond the disc";
    // The disc's light adds up to the sun's irradiance: pixels near the picture's middle see (40 degrees / 48)^2 sr or
    // a bit less.
    double sum = 0;
    for (std::size_t i = 0; i < got.pixels.size(); i += 3) sum += double(got.pixels[i]) - 0.5;
    const double pixel = std::pow(2 * std::tan(radians(20)) / 48, 2);
    EXPECT_NEAR(sum * pixel, 9, 1.5);
    patch_->params.sunDisc = false;
    patch_->shaded({&sun, {}});
    EXPECT_NEAR(patch_->at(20, 10).x, 0.5f, kStored);
}

TEST_F(FrameBackground, OrthographicEyesSeeASky) {
    light::Environment environment;
    environment.radiance = Image(64, 32, 3);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 64; ++x)
            for (int k = 0; k < 3; ++k) environment.radiance.at(x, y)[k] = y < 16 ? 2.0f : 1.0f;
    ASSERT_TRUE(patch_->lighting.setEnvironment(environment));
    patch_->context.view = test::straightView(64, 48, true);
    patch_->shaded({});
    EXPECT_NEAR(patch_->at(32, 2).x, 2, 0.01f);
    EXPECT_NEAR(patch_->at(32, 45).x, 1, 0.01f);
}

}  // namespace
}  // namespace shoal::frame
