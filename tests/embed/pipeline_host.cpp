// The whole pipeline in somebody else's program: a hostile context, two devices, nothing leaked, nothing allocated
// later.
#include <gtest/gtest.h>

#include "embed/gl_state_snapshot.h"
#include "embed/hostile_host.h"

#include <fstream>

#include <shoal/gl/objects.h>
#include <shoal/pipeline/pipeline.h>

#include "support/gl_device.h"
#include "support/test_folder.h"

namespace shoal::pipeline {
namespace {

// Sun and spot with shadows, ambient occlusion, glass, textures, bloom: every pass there is.
constexpr const char* kScene = R"(
[camera]
orbit = { center = [0, 0.6, 0], radius = 5, degPerSecond = 60 }
[sun]
elevationDeg = 40
[[light]]
kind = "spot"
position = [2, 3, 1]
[post]
bloom = 0.1
exposureMode = "automatic"
[[shape]]
kind = "plane"
surface = "tiles"
[[shape]]
kind = "sphere"
transmission = 1
roughness = 0
[[shape]]
kind = "box"
position = [1.2, 0, 0]
emission = [2, 1, 0]
)";

class PipelineHost : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        std::ofstream(folder.path() / "scene.toml") << kScene;
    }
    std::unique_ptr<Pipeline> open(gl::Device& on) {
        auto pipeline = Pipeline::create(on);
        EXPECT_TRUE(pipeline) << pipeline.error().message;
        const auto opened = (*pipeline)->open(folder.path() / "scene.toml");
        EXPECT_TRUE(opened) << opened.error().message;
        return *std::move(pipeline);
    }
    static FrameRequest request(int frame, const char* antialiasing = "temporal") {
        FrameRequest r;
        r.width = 128;
        r.height = 72;
        r.frameIndex = std::uint32_t(frame);
        r.time = float(frame) / 30;
        r.antialiasing = antialiasing;
        r.samples = 2;
        return r;
    }
    // Three frames of a film and a still, their display values and radiance.
    static std::vector<float> draw(Pipeline& pipeline, const std::function<void()>& before = {}) {
        std::vector<float> values;
        for (int i = 0; i < 4; ++i) {
            if (before) before();
            const auto drawn = pipeline.render(i < 3 ? request(i) : request(0, "supersample"));
            EXPECT_TRUE(drawn) << drawn.error().message;
            const auto radiance = pipeline.readRadiance();
            const auto display = pipeline.readDisplay();
            EXPECT_TRUE(radiance && display);
            values.insert(values.end(), radiance->pixels.begin(), radiance->pixels.end());
            for (const std::uint8_t v : display->pixels) values.push_back(float(v));
        }
        return values;
    }

    test::TestFolder folder;
};

TEST_F(PipelineHost, HostileStateDoesNotChangeThePicture) {
    const auto pipeline = open(device());
    const std::vector<float> clean = draw(*pipeline);
    const auto [lowest, highest] = std::minmax_element(clean.begin(), clean.end());
    EXPECT_GT(*highest, *lowest) << "something is drawn";
    const test::HostileHost host;
    EXPECT_TRUE(draw(*pipeline, [&] { host.mess(); }) == clean) << "the host's state shows in a frame";
    host.mess();
    const auto other = open(device());  // made and loaded in the hostile context
    EXPECT_TRUE(draw(*other, [&] { host.mess(); }) == clean) << "the host's state shows in what is loaded";
    gl::setKnownState();
}

TEST_F(PipelineHost, GuardGivesTheHostItsStateBack) {
    const auto pipeline = open(device());
    const test::HostileHost host;
    host.mess();
    const auto before = test::takeSnapshot();
    {
        const gl::StateGuard guard;
        draw(*pipeline);
        EXPECT_NE(test::difference(before, test::takeSnapshot()), "") << "negative control: drawing changes the state";
    }
    EXPECT_EQ(test::difference(before, test::takeSnapshot()), "");
    gl::setKnownState();
}

TEST_F(PipelineHost, TwoDevicesGiveTheSamePicture) {
    auto second = gl::Device::create();
    ASSERT_TRUE(second) << second.error().message;
    ASSERT_TRUE(device().makeCurrent());
    const auto first = open(device());
    ASSERT_TRUE((*second)->makeCurrent());
    const auto other = open(**second);
    // In turns, frame by frame.
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(device().makeCurrent());
        ASSERT_TRUE(first->render(request(i)));
        const auto a = first->readRadiance();
        ASSERT_TRUE((*second)->makeCurrent());
        ASSERT_TRUE(other->render(request(i)));
        const auto b = other->readRadiance();
        ASSERT_TRUE(a && b);
        EXPECT_TRUE(a->pixels == b->pixels) << "frame " << i;
    }
    ASSERT_TRUE(device().makeCurrent());
}

TEST_F(PipelineHost, TwoPipelinesOnOneDeviceDoNotDisturbEachOther) {
    const auto first = open(device());
    const std::vector<float> alone = draw(*first);
    const auto second = open(device());
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(first->render(request(i)));
    const auto expected = first->readRadiance();
    for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(first->render(request(i)));
        ASSERT_TRUE(second->render(request(i + 5)));
    }
    const auto between = first->readRadiance();
    ASSERT_TRUE(expected && between);
    EXPECT_TRUE(expected->pixels == between->pixels);
    EXPECT_TRUE(draw(*second) == alone);
}

TEST_F(PipelineHost, NothingIsAllocatedAfterTheFirstFrame) {
    for (const char* antialiasing : {"none", "supersample", "temporal"}) {
        const auto pipeline = open(device());
        ASSERT_TRUE(pipeline->render(request(0, antialiasing)));
        const std::int64_t bytes = device().liveBytes(), objects = device().liveObjectCount();
        EXPECT_GT(bytes, 0);
        for (int i = 1; i < 10; ++i) {
            ASSERT_TRUE(pipeline->render(request(i, antialiasing)));
            EXPECT_EQ(device().liveBytes(), bytes) << antialiasing << ", frame " << i;
            EXPECT_EQ(device().liveObjectCount(), objects) << antialiasing << ", frame " << i;
        }
    }
}

TEST_F(PipelineHost, ResizeAndOtherScenesGiveBackWhatTheyTook) {
    const auto pipeline = open(device());
    ASSERT_TRUE(pipeline->render(request(0)));
    const std::int64_t bytes = device().liveBytes();
    FrameRequest large = request(0);
    large.width = 256;
    ASSERT_TRUE(pipeline->render(large));
    EXPECT_GT(device().liveBytes(), bytes);
    ASSERT_TRUE(pipeline->render(request(0)));
    EXPECT_EQ(device().liveBytes(), bytes) << "back to the smaller size";
    ASSERT_TRUE(pipeline->open(folder.path() / "scene.toml"));
    ASSERT_TRUE(pipeline->render(request(0)));
    EXPECT_EQ(device().liveBytes(), bytes) << "the scene opened again";
}

TEST_F(PipelineHost, AFailedOpenLeavesTheSceneBefore) {
    const auto pipeline = open(device());
    const std::vector<float> before = draw(*pipeline);
    const std::int64_t bytes = device().liveBytes();
    EXPECT_FALSE(pipeline->open(folder.path() / "absent.toml"));
    std::ofstream(folder.path() / "bad.toml") << kScene << "radus = 3\n";
    EXPECT_FALSE(pipeline->open(folder.path() / "bad.toml"));
    EXPECT_EQ(device().liveBytes(), bytes);
    EXPECT_TRUE(draw(*pipeline) == before);
}

// Blitting to the host's framebuffer leaves no name behind either: GlTest checks names and bytes at the end of every
// test; this one counts by GL itself.
TEST_F(PipelineHost, NoGlNameOutlivesThePipeline) {
    const auto count = [] {
        int names = 0;
        for (GLuint i = 1; i < 5000; ++i)
            names += glIsTexture(i) + glIsBuffer(i) + glIsFramebuffer(i) + glIsVertexArray(i) + glIsSampler(i) +
                     glIsQuery(i);
        return names;
    };
    open(device());  // programs stay in the device's cache; all else goes
    const int before = count();
    {
        const auto pipeline = open(device());
        draw(*pipeline);
        gl::Texture target = gl::Texture::create(device(), {.width = 64, .height = 64, .label = "host"});
        GLuint framebuffer = 0;
        glCreateFramebuffers(1, &framebuffer);
        glNamedFramebufferTexture(framebuffer, GL_COLOR_ATTACHMENT0, target.name(), 0);
        pipeline->blit(framebuffer, 64, 64);
        glDeleteFramebuffers(1, &framebuffer);
        EXPECT_GT(count(), before) << "negative control: a pipeline has names";
    }
    EXPECT_EQ(count(), before);
}

}  // namespace
}  // namespace shoal::pipeline
