// The window, on an X server of its own (Xvfb) that is started and ended here.
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <shoal/gl/objects.h>
#include <shoal/gl/window.h>

#include "support/gl_device.h"

namespace shoal::gl {
namespace {

// Xvfb picks a free display and writes its number into a pipe when it is ready.
class VirtualScreen {
public:
    VirtualScreen() {
        int ends[2];
        if (pipe(ends) != 0) return;
        pid_ = fork();
        if (pid_ == 0) {
            close(ends[0]);
            const std::string fd = std::to_string(ends[1]);
            execlp("Xvfb", "Xvfb", "-displayfd", fd.c_str(), "-screen", "0", "640x480x24", "-nolisten", "tcp", nullptr);
            _exit(127);
        }
        close(ends[1]);
        char c = 0;
        while (read(ends[0], &c, 1) == 1 && c != '\n') number_ += c;
        close(ends[0]);
        if (!number_.empty()) setenv("DISPLAY", (":" + number_).c_str(), 1);
    }
    ~VirtualScreen() {
        if (pid_ <= 0) return;
        kill(pid_, SIGTERM);
        waitpid(pid_, nullptr, 0);
    }
    bool ok() const { return !number_.empty(); }

private:
    pid_t pid_ = -1;
    std::string number_;
};

TEST(GlWindow, WithoutADisplayIsNoDevice) {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    const auto window = Window::open(64, 64, "test");
    ASSERT_FALSE(window);
    EXPECT_EQ(window.error().kind, ErrorKind::noDevice);
    EXPECT_NE(window.error().message.find("no window"), std::string::npos) << window.error().message;
    EXPECT_EQ(window.error().message.find('\n'), std::string::npos);
}

TEST(GlWindow, DrawsAndShares) {
    const VirtualScreen screen;
    if (!screen.ok()) GTEST_SKIP() << "Xvfb is not installed";
    test::Messages messages;
    for (bool visible : {false, true}) {
        auto window = Window::open(200, 100, "test", visible,
                                   {.device = "auto", .log = messages.sink(), .debug = true, .shaderDir = ""});
        ASSERT_TRUE(window) << window.error().message;
        Device& device = (*window)->device();
        EXPECT_EQ(device.info().name, "window");
        EXPECT_EQ((*window)->width(), 200);
        EXPECT_EQ((*window)->height(), 100);
        EXPECT_FALSE((*window)->shouldClose());
        setKnownState();
        glClearColor(0, 1, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
        std::uint8_t pixel[4] = {};
        glReadBuffer(GL_BACK);
        if (visible) {  // hidden windows own no pixels
            glReadPixels(100, 50, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
            EXPECT_EQ(int(pixel[1]), 255);
            EXPECT_EQ(int(pixel[0]), 0);
        }
        (*window)->swap();
        (*window)->poll();
        EXPECT_EQ(device.debugErrorCount(), 0) << messages.all();
    }
}

TEST(GlWindow, TakesTurnsWithADeviceWithoutAScreen) {
    const VirtualScreen screen;
    if (!screen.ok()) GTEST_SKIP() << "Xvfb is not installed";
    auto window = Window::open(64, 64, "test", false);
    ASSERT_TRUE(window) << window.error().message;
    auto other = Device::create({.device = "auto", .log = {}, .shaderDir = ""});
    ASSERT_TRUE(other) << other.error().message;
    for (std::uint32_t i = 0; i < 3; ++i) {
        for (Device* device : {&(*window)->device(), other->get()}) {
            ASSERT_TRUE(device->makeCurrent());
            Buffer buffer = Buffer::create(*device, 4, "turn");
            buffer.clear(i);
            std::uint32_t got = ~0u;
            buffer.read(0, std::as_writable_bytes(std::span(&got, 1)));
            EXPECT_EQ(got, i);
        }
    }
    // Deleting from under the other's context: the right name goes, and what was current stays so.
    ASSERT_TRUE((*other)->makeCurrent());
    Buffer mine = Buffer::create(**other, 4, "mine");
    ASSERT_TRUE((*window)->device().makeCurrent());
    const Buffer kept = Buffer::create((*window)->device(), 4, "kept");
    mine = Buffer();
    EXPECT_TRUE(glIsBuffer(kept.name()));
    ASSERT_TRUE((*window)->device().makeCurrent());
    EXPECT_EQ((*other)->liveObjectCount(), 0);
}

}  // namespace
}  // namespace shoal::gl
