// A window with a GL 4.5 core context (GLFW), for the viewer and the samples. Needs a display.
#pragma once

#include <memory>
#include <string>

#include <shoal/gl/device.h>

struct GLFWwindow;

namespace shoal::gl {

class Window {
public:
    static Result<std::unique_ptr<Window>> open(int width, int height, const std::string& title, bool visible = true,
                                                const DeviceOptions& options = {});
    ~Window();
    Device& device();
    GLFWwindow* handle();
    bool shouldClose() const;
    void poll();
    void swap();
    // Framebuffer size in pixels (not in screen units).
    int width() const;
    int height() const;

    struct State;

private:
    explicit Window(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::gl
