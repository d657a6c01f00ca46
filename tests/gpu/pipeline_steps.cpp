// A picture in steps: samples over several calls, values changed without loading, drafts that leave no trace.
#include <gtest/gtest.h>

#include <shoal/pipeline/pipeline.h>

#include "support/gl_device.h"

namespace shoal::pipeline {
namespace {

constexpr const char* kText =
    "[environment]\nkind = \"color\"\n[sun]\nirradiance = [5, 5, 5]\n"
    "[[shape]]\nkind = \"box\"\nposition = [0, 0.6, 0]\n[[shape]]\nkind = \"plane\"\n"
    "[[light]]\nposition = [1, 2, 1]\n[camera]\nposition = [2, 2, 4]\n";

class PipelineSteps : public test::GlTest {
protected:
    void TearDown() override {
        pipelines_.clear();
        GlTest::TearDown();
    }
    static scene::Scene sceneWith(const std::vector<scene::Override>& changes) {
        const auto scene = scene::parseScene(kText, "steps.toml", changes);
        EXPECT_TRUE(scene) << scene.error().message;
        return *scene;
    }
    Pipeline& pipelineOf(const std::vector<scene::Override>& changes, bool drafts = false) {
        auto made = Pipeline::create(device());
        EXPECT_TRUE(made) << made.error().message;
        pipelines_.push_back(*std::move(made));
        pipelines_.back()->setDraftsWanted(drafts);
        const scene::Scene scene = sceneWith(changes);
        auto content = scene::loadContent(scene);
        EXPECT_TRUE(content) << content.error().message;
        EXPECT_TRUE(pipelines_.back()->setScene(scene, *std::move(content)));
        return *pipelines_.back();
    }
    static std::vector<float> radianceOf(Pipeline& pipeline, const FrameRequest& request) {
        EXPECT_TRUE(pipeline.render(request));
        const auto image = pipeline.readRadiance();
        EXPECT_TRUE(image) << image.error().message;
        return image->pixels;
    }
    std::vector<std::unique_ptr<Pipeline>> pipelines_;
    const FrameRequest request_{.width = 96, .height = 64, .samples = 5};
};

TEST_F(PipelineSteps, SamplesOverSeveralCallsGiveTheSameBits) {
    Pipeline& pipeline = pipelineOf({});
    const std::vector<float> whole = radianceOf(pipeline, request_);
    FrameRequest part = request_;
    for (int i = 0; i < 5; ++i) {
        part.sampleBegin = i, part.sampleEnd = i + 1;
        const std::vector<float> now = radianceOf(pipeline, part);
        EXPECT_EQ(now == whole, i == 4) << "after sample " << i;
    }
}

TEST_F(PipelineSteps, AnUpdatedSceneIsTheSceneLoadedAnew) {
    const std::vector<scene::Override> changes[] = {{{"post.exposureEv", "2"}},
                                                    {{"lighting.occlusionStrength", "2"}},
                                                    {{"shadows.softness", "9"}},
                                                    {{"sun.toSun", "[1, 0.5, 0]"}},
                                                    {{"environment.color", "[0, 3, 0]"}},
                                                    {{"environment.kind", "clearSky"}},
                                                    {{"light[0].intensity", "[90, 0, 0]"}}};
    Pipeline& updated = pipelineOf({});
    const auto displayOf = [&](Pipeline& pipeline) {
        EXPECT_TRUE(pipeline.render(request_));
        return pipeline.readDisplay()->pixels;
    };
    const std::vector<std::uint8_t> first = displayOf(updated);
    for (const auto& change : changes) {
        ASSERT_TRUE(updated.updateScene(sceneWith(change)));
        const std::vector<std::uint8_t> now = displayOf(updated);
        EXPECT_NE(now, first) << change[0].key;
        EXPECT_EQ(now, displayOf(pipelineOf(change))) << change[0].key;
    }
    ASSERT_TRUE(updated.updateScene(sceneWith({})));
    EXPECT_EQ(displayOf(updated), first);
}

TEST_F(PipelineSteps, AnUpdateThatFailsChangesNothing) {
    Pipeline& pipeline = pipelineOf({});
    const std::vector<float> before = radianceOf(pipeline, request_);
    scene::Scene wrong = sceneWith({{"environment.kind", "file"}, {"environment.file", "nowhere.hdr"}});
    EXPECT_FALSE(pipeline.updateScene(wrong));
    EXPECT_EQ(radianceOf(pipeline, request_), before);
}

TEST_F(PipelineSteps, DraftsLeaveNoTrace) {
    const std::vector<float> plain = radianceOf(pipelineOf({}), request_);
    Pipeline& pipeline = pipelineOf({}, true);
    FrameRequest draft = request_;
    draft.draft = true;
    draft.width = 24, draft.height = 16;
    (void)radianceOf(pipeline, draft);
    EXPECT_EQ(radianceOf(pipeline, request_), plain);
}

}  // namespace
}  // namespace shoal::pipeline
