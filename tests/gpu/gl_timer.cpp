// Frame timers: names, order, sums, and times that follow the work.
#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

#include <shoal/gl/objects.h>
#include <shoal/gl/timer.h>

#include "gl/device_state.h"
#include "support/gl_device.h"

namespace shoal::gl {
namespace {

class GlTimer : public test::GlTest {
protected:
    // Frames until the first results are in; on a GPU they come some frames later.
    template <class Body>
    void frames(FrameTimer& timer, Body body) {
        for (int i = 0; i < 16; ++i) {
            timer.beginFrame();
            body();
            timer.endFrame();
            glFinish();
        }
    }
};

TEST_F(GlTimer, NamesPassesInOrderAndSumsTheSameName) {
    FrameTimer timer(device());
    timer.setEnabled(true);
    Texture t = Texture::create(device(), {.format = GL_RGBA32F, .width = 512, .height = 512, .label = "work"});
    const float value[4] = {1, 2, 3, 4};
    frames(timer, [&] {
        {
            const PassScope scope(&timer, "first");
            t.clear(GL_RGBA, GL_FLOAT, value);
        }
        { const PassScope scope(&timer, "second"); }
        {
            const PassScope scope(&timer, "first");
            t.clear(GL_RGBA, GL_FLOAT, value);
        }
    });
    ASSERT_EQ(timer.passes().size(), 2u);
    EXPECT_EQ(timer.passes()[0].name, "first");
    EXPECT_EQ(timer.passes()[1].name, "second");
    EXPECT_GT(timer.passes()[0].timeMs, timer.passes()[1].timeMs);
    EXPECT_GE(timer.frameMs(), timer.passes()[0].timeMs + timer.passes()[1].timeMs);
    EXPECT_GE(timer.passes()[1].timeMs, 0.0);
}

TEST_F(GlTimer, OnSoftwareItIsTheWallClock) {
    if (!device().software()) GTEST_SKIP() << "a GPU's clock does not see the processor sleep";
    EXPECT_STREQ(FrameTimer::method(device()), "wall clock around glFinish");
    FrameTimer timer(device());
    timer.setEnabled(true);
    frames(timer, [&] {
        const PassScope outer(&timer, "outer");
        const PassScope inner(&timer, "inner");
        std::this_thread::sleep_for(std::chrono::milliseconds(3));
    });
    ASSERT_EQ(timer.passes().size(), 2u);
    EXPECT_GE(timer.passes()[1].timeMs, 3.0);
    EXPECT_GE(timer.passes()[0].timeMs, timer.passes()[1].timeMs) << "a pass contains those inside it";
}

TEST_F(GlTimer, OffMeasuresNothingAndScopesNeedNoTimer) {
    FrameTimer timer(device());
    frames(timer, [&] { const PassScope scope(&timer, "pass"); });
    EXPECT_TRUE(timer.passes().empty());
    EXPECT_EQ(timer.frameMs(), 0.0);
    const PassScope scope(nullptr, "plain debug group");
}

TEST_F(GlTimer, QueriesThatArriveLateCostFramesNotWaiting) {
    device().state().info.software = false;  // take the path of a GPU; every driver answers timestamp queries
    EXPECT_STREQ(FrameTimer::method(device()), "GL timer queries");
    FrameTimer timer(device());
    timer.setEnabled(true);
    for (int i = 0; i < 100; ++i) {  // nobody waits between frames: the ring may run full
        timer.beginFrame();
        {
            const PassScope outer(&timer, "outer");
            const PassScope inner(&timer, "inner");
        }
        timer.endFrame();
    }
    glFinish();
    timer.beginFrame();
    timer.endFrame();
    ASSERT_LE(timer.passes().size(), 2u);
    frames(timer, [&] {
        const PassScope outer(&timer, "outer");
        const PassScope inner(&timer, "inner");
    });
    ASSERT_EQ(timer.passes().size(), 2u);
    EXPECT_EQ(timer.passes()[0].name, "outer");
    EXPECT_GE(timer.passes()[0].timeMs, timer.passes()[1].timeMs);
    EXPECT_GE(timer.frameMs(), timer.passes()[0].timeMs);
    EXPECT_LE(device().liveObjectCount(), 4 * 6) << "four frames of three spans: queries are reused";
}

}  // namespace
}  // namespace shoal::gl
