// Ambient occlusion of shapes whose openness is known.
#include <gtest/gtest.h>

#include "support/frame_scene.h"
#include "support/gl_device.h"
#include "support/lit_patch.h"

#include <shoal/frame/geometry.h>

namespace shoal::frame {
namespace {

class FrameOcclusion : public test::GlTest {
protected:
    void draw(const Model& model, Vec3 eye, Vec3 target, float radius, std::uint32_t sampleIndex = 0) {
        if (!patch_) patch_ = std::make_unique<test::LitPatch>(device(), 256, 192, false);
        auto geometry = Geometry::create(device());
        ASSERT_TRUE(geometry) << geometry.error().message;
        const auto id = geometry->addModel(model);
        ASSERT_TRUE(id) << id.error().message;
        InstanceDesc desc;
        desc.model = *id;
        ASSERT_TRUE(geometry->addInstance(desc));
        Context& context = patch_->context;
        context.view = context.previousView =
            light::makeView(light::cameraLookingAt(eye, target, radians(45)), 256, 192);
        context.sampleIndex = sampleIndex;
        ++context.frameIndex;
        geometry->update(context);
        patch_->targets.beginSurfaces();
        geometry->drawSurfaces(context, patch_->targets.gbuffer());
        patch_->targets.finishSurfaces(context);
        patch_->params.ambientOcclusion = true;
        patch_->params.occlusionRadius = radius;
        patch_->lighting.prepare(context, patch_->params, {}, patch_->targets);
        open_ = *readImage(device(), patch_->lighting.occlusion(), 1);
    }
    // Openness where the world point is seen, mean of the 5 x 5 pixels around.
    float openAt(Vec3 point) const {
        const light::View& view = patch_->context.view;
        const Vec3 ndc = transformPoint(view.clipFromWorld(), point);
        const int x = int((ndc.x * 0.5f + 0.5f) * 256), y = int((0.5f - ndc.y * 0.5f) * 192);
        float sum = 0;
        for (int j = -2; j <= 2; ++j)
            for (int i = -2; i <= 2; ++i) sum += open_.at(std::clamp(x + i, 0, 255), std::clamp(y + j, 0, 191))[0];
        return sum / 25;
    }
    void TearDown() override {
        patch_.reset();
        GlTest::TearDown();
    }
    std::unique_ptr<test::LitPatch> patch_;
    Image open_;
};

TEST_F(FrameOcclusion, PlanesAreOpen) {
    const Model plane = test::modelOf({test::quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100})});
    for (const Vec3 eye : {Vec3{0, 5, 0.1f}, Vec3{0, 2, 4}, Vec3{0, 0.5f, 4}}) {
        draw(plane, eye, {0, 0, 0}, 1);
        float least = 1;
        for (const float open : open_.pixels) least = std::min(least, open);
        EXPECT_GT(least, 0.99f) << eye.y;
    }
}

// A floor and a wall that meet at a right angle. At height 0 a floor point at distance d from a wall of height h sees
// the cosine-weighted fraction 1/2 (1 + d / sqrt(d2 + h2)) of its hemisphere; only walls nearer than the radius count,
// with a falloff.
TEST_F(FrameOcclusion, CornersCloseAsFormFactorsSay) {
    const Model corner = test::modelOf(
        {test::quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -50}), test::quad({-50, 0, 0}, {100, 0, 0}, {0, 50, 0})});
    draw(corner, {0, 1.2f, 2.2f}, {0, 0.1f, 0}, 1.0f);
    // An endless wall leaves 0.525. The falloff from 0.4 of the radius on brings it to 0.61 (8 slices of 12 steps); 2
    // of 3 give 0.635.
    EXPECT_GT(openAt({0, 0, 0.05f}), 0.525f);
    EXPECT_LT(openAt({0, 0, 0.05f}), 0.68f);
    EXPECT_GT(openAt({0, 0, 0.4f}), openAt({0, 0, 0.1f}) + 0.1f);
    EXPECT_GT(openAt({0, 0, 1.1f}), 0.99f) << "beyond the radius nothing occludes";
    EXPECT_GT(openAt({0, 1.2f, 0}), 0.97f) << "nor on the wall";
}

// A pillar far in front of a wall does not darken it: no halo around what is nearer by more than the radius.
TEST_F(FrameOcclusion, SilhouettesHaveNoHalo) {
    const Model model = test::modelOf(
        {test::quad({-50, -50, 0}, {100, 0, 0}, {0, 100, 0}), test::box({-0.2f, -50, 4}, {0.2f, 50, 4.4f})});
    draw(model, {0, 0, 8}, {0, 0, 0}, 0.5f);
    int dark = 0;
    for (int y = 20; y < 172; ++y)
        for (int x = 20; x < 236; ++x) dark += open_.at(x, y)[0] < 0.97f;
    EXPECT_EQ(dark, 0);
}

TEST_F(FrameOcclusion, StrengthScalesAndOffIsOpen) {
    const Model corner = test::modelOf(
        {test::quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -50}), test::quad({-50, 0, 0}, {100, 0, 0}, {0, 50, 0})});
    draw(corner, {0, 1.2f, 2.2f}, {0, 0.1f, 0}, 1.0f);
    const float full = openAt({0, 0, 0.2f});
    patch_->params.occlusionStrength = 0.5f;
    draw(corner, {0, 1.2f, 2.2f}, {0, 0.1f, 0}, 1.0f);
    EXPECT_NEAR(1 - openAt({0, 0, 0.2f}), 0.5f * (1 - full), 0.01f);
    patch_->params.occlusionStrength = 0;
    draw(corner, {0, 1.2f, 2.2f}, {0, 0.1f, 0}, 1.0f);
    EXPECT_EQ(openAt({0, 0, 0.2f}), 1);
    patch_->params.ambientOcclusion = false;
    patch_->lighting.setTermsWanted(true);
    patch_->lighting.prepare(patch_->context, patch_->params, {}, patch_->targets);
    EXPECT_EQ(readImage(device(), patch_->lighting.occlusion(), 1)->width, 256)
        << "an open layer where it is off but asked for";
}

TEST_F(FrameOcclusion, SameInputSameBitsOtherSampleOtherNoise) {
    const Model model = test::modelOf(
        {test::quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}), test::box({-0.5f, 0, -0.5f}, {0.5f, 1, 0.5f})});
    draw(model, {2, 2, 3}, {0, 0.3f, 0}, 1);
    const std::vector<float> first = open_.pixels;
    draw(model, {2, 2, 3}, {0, 0.3f, 0}, 1);
    EXPECT_EQ(open_.pixels, first);
    draw(model, {2, 2, 3}, {0, 0.3f, 0}, 1, 3);
    EXPECT_NE(open_.pixels, first);
    double difference = 0;
    for (std::size_t i = 0; i < first.size(); ++i) difference += std::abs(double(first[i]) - double(open_.pixels[i]));
    EXPECT_LT(difference / double(first.size()), 0.01);
}

}  // namespace
}  // namespace shoal::frame
