// The window, on an X server of its own (Xvfb) that is started and ended here.
#include <epoxy/gl.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <shoal/gl/objects.h>
#include <shoal/gl/window.h>

#include "support/gl_device.h"
#include "support/virtual_screen.h"

namespace shoal::gl {
namespace {

using test::VirtualScreen;

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
    SHOAL_NEEDS_SCREEN(screen)
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
    SHOAL_NEEDS_SCREEN(screen)
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
