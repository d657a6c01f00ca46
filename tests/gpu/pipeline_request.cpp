// What a host may ask of a pipeline: requests out of range are refused with the field and its range.
#include <gtest/gtest.h>

#include <shoal/pipeline/pipeline.h>

#include "support/gl_device.h"

namespace shoal::pipeline {
namespace {

class PipelineRequest : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        auto made = Pipeline::create(device());
        ASSERT_TRUE(made) << made.error().message;
        pipeline_ = *std::move(made);
        const auto scene = scene::parseScene("[[shape]]\nkind = \"box\"\n", "box.toml");
        ASSERT_TRUE(scene) << scene.error().message;
        auto content = scene::loadContent(*scene);
        ASSERT_TRUE(content) << content.error().message;
        ASSERT_TRUE(pipeline_->setScene(*scene, *std::move(content)));
    }
    void TearDown() override {
        pipeline_.reset();  // GlTest then looks for objects that were left
        GlTest::TearDown();
    }
    void expectRefused(const FrameRequest& request, const std::string& mention) {
        const auto drawn = pipeline_->render(request);
        ASSERT_FALSE(drawn) << mention;
        EXPECT_EQ(drawn.error().kind, ErrorKind::badInput);
        EXPECT_NE(drawn.error().message.find(mention), std::string::npos) << drawn.error().message;
    }
    std::unique_ptr<Pipeline> pipeline_;
};

TEST_F(PipelineRequest, OutOfRangeIsRefused) {
    const FrameRequest good{.width = 32, .height = 18, .samples = 1};
    EXPECT_TRUE(pipeline_->render(good));
    FrameRequest bad = good;
    bad.width = 0;
    expectRefused(bad, "width: found 0");
    bad = good;
    bad.height = 100000;
    expectRefused(bad, "height: found 100000");
    bad = good;
    bad.samples = 0;
    expectRefused(bad, "samples: found 0");
    bad = good;
    bad.antialiasing = "temporl";
    expectRefused(bad, "did you mean \"temporal\"");
    EXPECT_TRUE(pipeline_->render(good)) << "a refused request changes nothing";
}

}  // namespace
}  // namespace shoal::pipeline
