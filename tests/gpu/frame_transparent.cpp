// Blended surfaces over each other in the right order, hidden by what is opaque; glass lets through what lies behind.
#include <gtest/gtest.h>

#include <shoal/frame/geometry.h>
#include <shoal/frame/lighting.h>
#include <shoal/frame/shadows.h>
#include <shoal/frame/targets.h>

#include "support/frame_scene.h"
#include "support/gl_device.h"

namespace shoal::frame {
namespace {

using test::modelOf;
using test::quad;

constexpr int kWidth = 64, kHeight = 64;

class FrameTransparent : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        gl::setKnownState();
        geometry_.emplace(Geometry::create(device()).value());
        targets_.emplace(Targets::create(device(), kWidth, kHeight).value());
        lighting_.emplace(Lighting::create(device()).value());
        shadows_.emplace(Shadows::create(device(), {.sunResolution = 64, .spotResolution = 64}).value());
    }
    void TearDown() override {
        geometry_.reset(), targets_.reset(), lighting_.reset(), shadows_.reset();
        GlTest::TearDown();
    }

    static Material unlit(Vec4 color, AlphaMode mode) {
        Material m;
        m.baseColor = color;
        m.unlit = true;
        m.alphaMode = mode;
        return m;
    }
    void addWall(float z, const Material& material) {
        InstanceDesc desc;
        desc.model = geometry_->addModel(modelOf({quad({-10, -10, z}, {20, 0, 0}, {0, 20, 0})}, {material})).value();
        ASSERT_TRUE(geometry_->addInstance(desc));
    }
    // Draws everything as the pipeline does; the background is black. Returns the radiance in the middle.
    Vec4 draw() {
        const Context context = test::contextOf(
            device(), makeView(light::cameraLookingAt({0, 0, 5}, {0, 0, 0}, radians(60)), kWidth, kHeight));
        LightingParams params;
        params.background = "color";
        params.backgroundColor = {0, 0, 0};
        params.environmentIntensity = 0;
        params.ambientOcclusion = false;
        geometry_->update(context);
        shadows_->prepare(context, {}, nullptr, {}, geometry_->bounds());
        targets_->beginSurfaces();
        geometry_->drawSurfaces(context, targets_->gbuffer());
        targets_->finishSurfaces(context);
        lighting_->prepare(context, params, {}, *targets_);
        lighting_->shade(context, params, *shadows_, {}, *targets_);
        if (geometry_->hasTransparent()) {
            targets_->copyOpaque();
            targets_->forward().bind();
            lighting_->bind();
            shadows_->bind();
            geometry_->drawTransparent(context, targets_->opaqueCopy(), targets_->gbuffer().viewDepth);
        }
        const auto radiance = test::readFloats(targets_->radiance(), GL_RGBA, 4);
        const float* p = radiance.data() + 4 * (kHeight / 2 * kWidth + kWidth / 2);
        return {p[0], p[1], p[2], p[3]};
    }

    std::optional<Geometry> geometry_;
    std::optional<Targets> targets_;
    std::optional<Lighting> lighting_;
    std::optional<Shadows> shadows_;
};

constexpr float kStep = 2e-3f;  // two roundings to 11 bits

TEST_F(FrameTransparent, SheetsBlendBackToFrontWhateverTheirOrder) {
    addWall(2, unlit({0, 1, 0, 0.5f}, AlphaMode::blend));  // nearer, added first
    addWall(1, unlit({1, 0, 0, 0.75f}, AlphaMode::blend));
    addWall(0, unlit({0, 0, 1, 1}, AlphaMode::opaque));
    EXPECT_TRUE(geometry_->hasTransparent());
    const Vec4 c = draw();
    EXPECT_NEAR(c.x, 0.5f * 0.75f, kStep);
    EXPECT_NEAR(c.y, 0.5f, kStep);
    EXPECT_NEAR(c.z, 0.5f * 0.25f, kStep);
}

TEST_F(FrameTransparent, OpaqueSurfacesHideWhatIsBehindThem) {
    addWall(1, unlit({1, 0, 0, 0.5f}, AlphaMode::blend));
    addWall(2, unlit({0, 0, 1, 1}, AlphaMode::opaque));
    const Vec4 c = draw();
    EXPECT_NEAR(c.x, 0, kStep);
    EXPECT_NEAR(c.z, 1, kStep);
}

TEST_F(FrameTransparent, GlassTintsWhatLiesBehindAndAddsNothingInTheDark) {
    addWall(0, unlit({1, 1, 1, 1}, AlphaMode::opaque));
    Material glass;
    glass.baseColor = {0.5f, 1, 0.25f, 1};
    glass.metallic = 0, glass.roughness = 0;
    glass.transmission = 1;
    addWall(2, glass);
    const Vec4 c = draw();
    // Head on, 4 % are reflected at the surface: the rest passes, tinted.
    EXPECT_NEAR(c.x, 0.5f * 0.96f, 0.02f);
    EXPECT_NEAR(c.y, 0.96f, 0.02f);
    EXPECT_NEAR(c.z, 0.25f * 0.96f, 0.02f);
}

TEST_F(FrameTransparent, BothSidesOfADoubleSidedSheetAreSeenOnce) {
    Material m = unlit({1, 0, 0, 0.5f}, AlphaMode::blend);
    m.doubleSided = true;
    addWall(1, m);
    EXPECT_NEAR(draw().x, 0.5f, kStep);
}

}  // namespace
}  // namespace shoal::frame
