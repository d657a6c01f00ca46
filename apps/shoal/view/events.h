// What a person does, in the order it was done. The window's callbacks and a script put events into the same queue, so
// that a test drives exactly what a hand does.
#pragma once

#include <string>
#include <vector>

struct GLFWwindow;

namespace shoal::viewer {

struct Event {
    enum class Kind { move, button, scroll, key, character, drop, close, focus } kind = Kind::move;
    double x = 0, y = 0;                  // move: framebuffer pixels from the top left; scroll: steps
    int code = 0;                         // key: GLFW_KEY_...; button: GLFW_MOUSE_BUTTON_...; character: code point
    bool pressed = false;                 // key, button; focus: gained
    int mods = 0;                         // GLFW_MOD_...
    std::vector<std::string> files = {};  // drop
};

// Fills `queue` from the window until the window goes. The queue must live as long.
void listen(GLFWwindow* window, std::vector<Event>& queue);

// Hands one event to Dear ImGui.
void feedImGui(const Event& event);

}  // namespace shoal::viewer
