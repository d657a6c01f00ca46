#include "view/events.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

namespace shoal::viewer {

namespace {

std::vector<Event>& queueOf(GLFWwindow* window) {
    return *static_cast<std::vector<Event>*>(glfwGetWindowUserPointer(window));
}

// Cursor positions come in screen units; a framebuffer pixel may be smaller.
void onMove(GLFWwindow* window, double x, double y) {
    int width = 1, height = 1, pixelWidth = 1, pixelHeight = 1;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &pixelWidth, &pixelHeight);
    Event event;
    event.x = x * pixelWidth / (width > 0 ? width : 1);
    event.y = y * pixelHeight / (height > 0 ? height : 1);
    queueOf(window).push_back(event);
}

void push(GLFWwindow* window, Event::Kind kind, int code, bool pressed, int mods) {
    Event event;
    event.kind = kind;
    event.code = code;
    event.pressed = pressed;
    event.mods = mods;
    queueOf(window).push_back(event);
}

}  // namespace

void listen(GLFWwindow* window, std::vector<Event>& queue) {
    glfwSetWindowUserPointer(window, &queue);
    glfwSetCursorPosCallback(window, onMove);
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
        push(w, Event::Kind::button, button, action == GLFW_PRESS, mods);
    });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
        Event event;
        event.kind = Event::Kind::scroll;
        event.x = x, event.y = y;
        queueOf(w).push_back(event);
    });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int mods) {
        if (key != GLFW_KEY_UNKNOWN && action != GLFW_REPEAT)
            push(w, Event::Kind::key, key, action == GLFW_PRESS, mods);
    });
    glfwSetCharCallback(window,
                        [](GLFWwindow* w, unsigned code) { push(w, Event::Kind::character, int(code), true, 0); });
    glfwSetWindowFocusCallback(
        window, [](GLFWwindow* w, int focused) { push(w, Event::Kind::focus, 0, focused == GLFW_TRUE, 0); });
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** files) {
        Event event;
        event.kind = Event::Kind::drop;
        event.files.assign(files, files + count);
        queueOf(w).push_back(event);
    });
    glfwSetWindowCloseCallback(window, [](GLFWwindow* w) { push(w, Event::Kind::close, 0, true, 0); });
}

void feedImGui(const Event& event) {
    ImGuiIO& io = ImGui::GetIO();
    switch (event.kind) {
        case Event::Kind::move:
            io.MousePos = {float(event.x), float(event.y)};
            break;
        case Event::Kind::button:
            if (event.code >= 0 && event.code < 5) io.MouseDown[event.code] = event.pressed;
            break;
        case Event::Kind::scroll:
            io.MouseWheelH += float(event.x);
            io.MouseWheel += float(event.y);
            break;
        case Event::Kind::key:
            if (event.code >= 0 && event.code < int(sizeof io.KeysDown)) io.KeysDown[event.code] = event.pressed;
            io.KeyCtrl = io.KeysDown[GLFW_KEY_LEFT_CONTROL] || io.KeysDown[GLFW_KEY_RIGHT_CONTROL];
            io.KeyShift = io.KeysDown[GLFW_KEY_LEFT_SHIFT] || io.KeysDown[GLFW_KEY_RIGHT_SHIFT];
            io.KeyAlt = io.KeysDown[GLFW_KEY_LEFT_ALT] || io.KeysDown[GLFW_KEY_RIGHT_ALT];
            break;
        case Event::Kind::character:
            io.AddInputCharacter(unsigned(event.code));
            break;
        case Event::Kind::focus:
            // Keys that were down while the window lost the keyboard are never seen going up.
            if (!event.pressed) {
                for (bool& down : io.KeysDown) down = false;
                for (bool& down : io.MouseDown) down = false;
                io.KeyCtrl = io.KeyShift = io.KeyAlt = false;
            }
            break;
        case Event::Kind::drop:
        case Event::Kind::close:
            break;
    }
}

}  // namespace shoal::viewer
