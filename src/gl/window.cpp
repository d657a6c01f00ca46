#include <shoal/gl/window.h>

#define GLFW_INCLUDE_NONE
#include <fmt/format.h>
#include <GLFW/glfw3.h>

#include "gl/device_state.h"

namespace shoal::gl {
namespace {

int windowCount = 0;  // GLFW is started by the first window and stopped by the last; one thread, as GLFW demands

std::string glfwProblem() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "GLFW gives no reason";
}

void releaseGlfw() {
    if (--windowCount == 0) glfwTerminate();
}

class WindowContext final : public Context {
public:
    explicit WindowContext(GLFWwindow* window) : window_(window) {}
    ~WindowContext() override { forgetCurrent(*this); }
    Result<void> makeCurrent() override {
        glfwMakeContextCurrent(window_);
        if (glfwGetCurrentContext() != window_)
            return internalError("the window's context cannot be made current: " + glfwProblem());
        return {};
    }
    void release() override {
        if (isCurrent()) glfwMakeContextCurrent(nullptr);
    }
    bool isCurrent() const override { return glfwGetCurrentContext() == window_; }

private:
    GLFWwindow* window_;
};

}  // namespace

struct Window::State {
    GLFWwindow* window = nullptr;
    std::unique_ptr<Device> device;

    ~State() {
        device.reset();
        if (window) glfwDestroyWindow(window);
        releaseGlfw();
    }
};

Window::Window(std::unique_ptr<State> state) : state_(std::move(state)) {}
Window::~Window() = default;

Result<std::unique_ptr<Window>> Window::open(int width, int height, const std::string& title, bool visible,
                                             const DeviceOptions& options) {
    SHOAL_ASSERT(width > 0 && height > 0);
    if (std::string problem = missingGlLibrary(false); !problem.empty()) return noDevice(problem);
    if (windowCount == 0 && !glfwInit())
        return noDevice(
            fmt::format("no window: {} (a window needs a display; rendering to files does not)", glfwProblem()));
    ++windowCount;
    auto state = std::make_unique<State>();
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_VISIBLE, visible ? GLFW_TRUE : GLFW_FALSE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);  // Shoal draws into its own targets
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
    state->window = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (!state->window) return noDevice(fmt::format("no window with an OpenGL 4.5 core context: {}", glfwProblem()));
    auto context = std::make_unique<WindowContext>(state->window);
    SHOAL_TRY(switchTo(*context));
    SHOAL_TRY_ASSIGN(auto deviceState, adoptCurrentContext(options, "window", std::move(context)));
    glfwSwapInterval(1);
    state->device = Device::adopt(std::move(deviceState));
    return std::unique_ptr<Window>(new Window(std::move(state)));
}

Device& Window::device() { return *state_->device; }
GLFWwindow* Window::handle() { return state_->window; }
bool Window::shouldClose() const { return glfwWindowShouldClose(state_->window) != 0; }
void Window::poll() { glfwPollEvents(); }
void Window::swap() { glfwSwapBuffers(state_->window); }

int Window::width() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(state_->window, &width, &height);
    return width;
}

int Window::height() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(state_->window, &width, &height);
    return height;
}

}  // namespace shoal::gl
