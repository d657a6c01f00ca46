// What a host may ask of a pipeline: requests out of range are refused with the field and its range.
#include <gtest/gtest.h>

#include <shoal/pipeline/pipeline.h>

#include "support/pipeline_test.h"

namespace shoal::pipeline {
namespace {

class PipelineRequest : public test::PipelineTest {
protected:
    void SetUp() override {
        PipelineTest::SetUp();
        setScene("[[shape]]\nkind = \"box\"\n");
    }
    void expectRefused(const FrameRequest& request, const std::string& mention) {
        const auto drawn = pipeline_->render(request);
        ASSERT_FALSE(drawn) << mention;
        EXPECT_EQ(drawn.error().kind, ErrorKind::badInput);
        EXPECT_NE(drawn.error().message.find(mention), std::string::npos) << drawn.error().message;
    }
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
