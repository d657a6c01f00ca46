// Fixture of the tests that draw whole frames: a pipeline on the tests' device.
#pragma once

#include <memory>
#include <string>

#include <shoal/pipeline/pipeline.h>

#include "support/gl_device.h"

namespace shoal::test {

class PipelineTest : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        auto made = pipeline::Pipeline::create(device());
        ASSERT_TRUE(made) << made.error().message;
        pipeline_ = *std::move(made);
    }
    void TearDown() override {
        pipeline_.reset();  // GlTest then looks for objects that were left
        GlTest::TearDown();
    }
    // Makes a scene file's text the pipeline's scene.
    void setScene(const std::string& text) {
        const auto scene = scene::parseScene(text, "test.toml");
        ASSERT_TRUE(scene) << scene.error().message;
        auto content = scene::loadContent(*scene);
        ASSERT_TRUE(content) << content.error().message;
        ASSERT_TRUE(pipeline_->setScene(*scene, *std::move(content)));
    }
    std::unique_ptr<pipeline::Pipeline> pipeline_;
};

}  // namespace shoal::test
