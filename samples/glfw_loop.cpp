// Shoal in a plain GLFW loop: the host owns the window and the context, Shoal draws a scene and the host puts it on the
// screen.
//   sample_glfw_loop SCENE_OR_MODEL [FRAMES]
// Drag turns the camera round what is looked at, the wheel goes nearer. With FRAMES it stops by itself after so many.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <GLFW/glfw3.h>

#include <shoal/gl/device.h>
#include <shoal/pipeline/pipeline.h>

namespace {

// A camera that circles a point, steered with the mouse.
struct Orbit {
    shoal::Vec3 center;
    float distance = 5, azimuth = 0.6f, elevation = 0.3f;
    double lastX = 0, lastY = 0;

    shoal::light::Camera camera() const {
        const shoal::Vec3 toEye{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                std::cos(elevation) * std::cos(azimuth)};
        return shoal::light::cameraLookingAt(center + toEye * distance, center, shoal::radians(45));
    }
};

void onWheel(GLFWwindow* window, double, double steps) {
    auto& orbit = *static_cast<Orbit*>(glfwGetWindowUserPointer(window));
    orbit.distance *= std::pow(0.9f, float(steps));
}

void onMove(GLFWwindow* window, double x, double y) {
    auto& orbit = *static_cast<Orbit*>(glfwGetWindowUserPointer(window));
    if (glfwGetMouseButton(window, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS) {
        orbit.azimuth -= float(x - orbit.lastX) * 0.01f;
        orbit.elevation = std::fmin(1.5f, std::fmax(-0.2f, orbit.elevation + float(y - orbit.lastY) * 0.01f));
    }
    orbit.lastX = x, orbit.lastY = y;
}

GLFWwindow* openWindow() {
    if (!glfwInit()) return nullptr;
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow* window = glfwCreateWindow(960, 540, "Shoal in a GLFW loop", nullptr, nullptr);
    if (window) glfwMakeContextCurrent(window);
    return window;
}

int fail(const shoal::Error& error) {
    std::fprintf(stderr, "sample_glfw_loop: %s\n", error.message.c_str());
    return 1;
}

int run(GLFWwindow* window, const char* scene, int frameCount) {
    shoal::gl::DeviceOptions options;
    options.log = shoal::stderrSink();
    auto device = shoal::gl::Device::fromCurrentContext(options);
    if (!device) return fail(device.error());
    auto pipeline = shoal::pipeline::Pipeline::create(**device);
    if (!pipeline) return fail(pipeline.error());
    if (auto opened = (*pipeline)->open(scene); !opened) return fail(opened.error());

    Orbit orbit;
    const shoal::Bounds bounds = (*pipeline)->content().focus;
    if (!bounds.empty()) orbit.center = bounds.center(), orbit.distance = 2.4f * bounds.radius();
    glfwSetWindowUserPointer(window, &orbit);
    glfwSetScrollCallback(window, onWheel);
    glfwSetCursorPosCallback(window, onMove);

    shoal::pipeline::FrameRequest request;
    request.antialiasing = "temporal";
    const double start = glfwGetTime();
    for (int frame = 0; !glfwWindowShouldClose(window) && (frameCount == 0 || frame < frameCount); ++frame) {
        glfwPollEvents();
        glfwGetFramebufferSize(window, &request.width, &request.height);
        if (request.width == 0 || request.height == 0) continue;  // minimised
        request.frameIndex = std::uint32_t(frame);
        const float now = float(glfwGetTime() - start);
        request.timeStep = now - request.time;
        request.time = now;
        request.camera = orbit.camera();
        if (auto drawn = (*pipeline)->render(request); !drawn) return fail(drawn.error());
        (*pipeline)->blit(0, request.width, request.height);
        glfwSwapBuffers(window);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr, "usage: sample_glfw_loop SCENE_OR_MODEL [FRAMES]\n");
        return 2;
    }
    GLFWwindow* window = openWindow();
    if (!window) {
        std::fprintf(stderr, "sample_glfw_loop: no window with OpenGL 4.5 could be opened\n");
        return 1;
    }
    const int exit = run(window, argv[1], argc > 2 ? std::atoi(argv[2]) : 0);
    glfwTerminate();
    return exit;
}
