// What the mouse and the keys do in the picture.
#include <algorithm>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "view/viewer.h"

namespace shoal::viewer {

namespace {

constexpr float kTurnPerHeight = kPi;  // radians that a drag over the whole picture's height turns

}  // namespace

void Viewer::handle(const Event& event) {
    const ImGuiIO& io = ImGui::GetIO();
    switch (event.kind) {
        case Event::Kind::move:
            cursorX = event.x, cursorY = event.y;
            if (drag_ != Drag::none) dragTo(event.x, event.y);
            break;
        case Event::Kind::button:
            if (!event.pressed) {
                drag_ = Drag::none;
                break;
            }
            if (io.WantCaptureMouse || !viewport.contains(cursorX, cursorY)) break;
            ImGui::SetWindowFocus(nullptr);  // keys go to the picture that was clicked into
            dragX_ = cursorX, dragY_ = cursorY;
            if (comparison && event.code == GLFW_MOUSE_BUTTON_LEFT &&
                std::abs(cursorX - viewport.x - double(comparison->divider) * viewport.width) < 8 * double(uiScale))
                drag_ = Drag::divider;
            else if (event.code == GLFW_MOUSE_BUTTON_MIDDLE || event.code == GLFW_MOUSE_BUTTON_RIGHT ||
                     (event.mods & GLFW_MOD_SHIFT))
                drag_ = Drag::pan;
            else if (event.mods & GLFW_MOD_CONTROL)
                drag_ = Drag::dolly;
            else
                drag_ = flyMode ? Drag::look : Drag::orbit;
            break;
        case Event::Kind::scroll:
            if (io.WantCaptureMouse || !viewport.contains(cursorX, cursorY)) break;
            if (flyMode) {
                flySpeed = std::clamp(flySpeed * float(std::pow(1.15, event.y)), 0.01f, 100.0f);
                char text[60];
                std::snprintf(text, sizeof text, "flying %.2g m/s", double(0.35f * flySpeed * sceneBounds().radius()));
                say(text);
                break;
            }
            useOwnCamera();
            camera.dolly(float(event.y));
            touch();
            break;
        case Event::Kind::key:
            if (!event.pressed)
                keysDown_.erase(event.code);
            else if (!io.WantTextInput && !(io.NavVisible && event.code == GLFW_KEY_SPACE))  // Space presses a button
                press(event.code, event.mods);
            break;
        case Event::Kind::focus:
            if (!event.pressed) keysDown_.clear(), drag_ = Drag::none;
            break;
        case Event::Kind::drop: {
            std::vector<std::filesystem::path> files(event.files.begin(), event.files.end());
            openFiles(files);
            break;
        }
        case Event::Kind::close:
            quit = true;
            break;
        case Event::Kind::character:
            break;
    }
}

void Viewer::dragTo(double x, double y) {
    const float dx = float(x - dragX_), dy = float(y - dragY_);
    dragX_ = x, dragY_ = y;
    if (dx == 0 && dy == 0) return;
    if (drag_ == Drag::divider) {
        comparison->divider = std::clamp(float((x - viewport.x) / std::max(viewport.width, 1)), 0.0f, 1.0f);
        return;
    }
    useOwnCamera();
    const float turn = kTurnPerHeight / float(std::max(viewport.height, 1));
    switch (drag_) {
        case Drag::orbit:
            camera.orbit(-dx * turn, dy * turn);
            break;
        case Drag::look:
            camera.look(-0.5f * dx * turn, -0.5f * dy * turn);
            break;
        case Drag::pan:
            camera.pan(dx, -dy, viewport.height);
            break;
        case Drag::dolly:
            camera.dolly(-0.05f * dy / uiScale);
            break;
        case Drag::divider:
        case Drag::none:
            break;
    }
    touch();
}

void Viewer::flyByKeys(float seconds) {
    if (keysDown_.empty() || !picture.hasScene()) return;
    const auto down = [&](int key) { return keysDown_.contains(key) ? 1.0f : 0.0f; };
    const Vec3 direction{down(GLFW_KEY_D) - down(GLFW_KEY_A), down(GLFW_KEY_E) - down(GLFW_KEY_Q),
                         down(GLFW_KEY_W) - down(GLFW_KEY_S)};
    if (direction == Vec3{}) return;
    const bool fast = keysDown_.contains(GLFW_KEY_LEFT_SHIFT) || keysDown_.contains(GLFW_KEY_RIGHT_SHIFT);
    // A third of the scene's size a second.
    const float speed = 0.35f * flySpeed * std::max(sceneBounds().radius(), 0.1f) * (fast ? 4.0f : 1.0f);
    useOwnCamera();
    camera.move(normalize(direction), speed * std::min(seconds, 0.1f));
    touch();
}

void Viewer::press(int key, int mods) {
    const bool control = mods & GLFW_MOD_CONTROL, shift = mods & GLFW_MOD_SHIFT;
    const auto lookFrom = [&](Side plain, Side opposite) {
        if (!picture.hasScene()) return;
        useOwnCamera();
        camera.lookFrom(control ? opposite : plain, sceneBounds(), aspect());
        touch();
    };
    const scene::RenderSpec& render = document.scene().render;
    if (control) {
        switch (key) {
            case GLFW_KEY_O:
                dialog = Dialog::open;
                return;
            case GLFW_KEY_S:
                dialog = Dialog::save;
                return;
            case GLFW_KEY_P:
                dialog = Dialog::screenshot;
                return;
            case GLFW_KEY_C:
                ImGui::SetClipboardText(command().c_str());
                say("copied the shoal render command of this view");
                return;
            case GLFW_KEY_Z:
                shift ? redo() : undo();
                return;
            case GLFW_KEY_Y:
                redo();
                return;
            case GLFW_KEY_Q:
                quit = true;
                return;
            default:
                break;
        }
    }
    switch (key) {
        case GLFW_KEY_F1:
            showHelp = !showHelp;
            if (!settings.hintRead) {
                settings.hintRead = true;
                if (recordSettings) writeSettings(settings);
            }
            break;
        case GLFW_KEY_ESCAPE:
            if (showHelp)
                showHelp = false;
            else if (dialog != Dialog::none)
                dialog = Dialog::none;
            else if (!error_.empty())
                error_.clear();
            ImGui::SetWindowFocus(nullptr);
            break;
        case GLFW_KEY_F:
            if (!picture.hasScene()) break;
            useOwnCamera();
            camera.frame(sceneBounds(), aspect());
            touch();
            break;
        case GLFW_KEY_HOME:
        case GLFW_KEY_KP_0:
        case GLFW_KEY_0:
            goToSceneCamera();
            break;
        case GLFW_KEY_KP_DECIMAL:
            press(GLFW_KEY_F, 0);
            break;
        case GLFW_KEY_KP_1:
        case GLFW_KEY_1:
            lookFrom(Side::front, Side::back);
            break;
        case GLFW_KEY_KP_3:
        case GLFW_KEY_3:
            lookFrom(Side::right, Side::left);
            break;
        case GLFW_KEY_KP_7:
        case GLFW_KEY_7:
            lookFrom(Side::top, Side::bottom);
            break;
        case GLFW_KEY_KP_5:
        case GLFW_KEY_5:
            useOwnCamera();
            camera.toggleOrthographic();
            touch();
            break;
        case GLFW_KEY_SPACE:
            timeline.playing = !timeline.playing;
            break;
        case GLFW_KEY_COMMA:
        case GLFW_KEY_PERIOD:
            timeline.playing = false;
            timeline.time += (key == GLFW_KEY_COMMA ? -1.0f : 1.0f) / render.fps;
            break;
        case GLFW_KEY_C:
            flyMode = !flyMode;
            say(flyMode ? "fly: drag looks about, W A S D Q E move, the wheel sets the speed"
                        : "orbit: drag circles the pivot");
            break;
        case GLFW_KEY_P:
            showPanels = !showPanels;
            break;
        case GLFW_KEY_V:
            comparison ? stopComparison() : startComparison();
            break;
        case GLFW_KEY_T:
            settings.theme = settings.theme == Theme::dark ? Theme::light : Theme::dark;
            styleChanged = true;
            if (recordSettings) writeSettings(settings);
            break;
        case GLFW_KEY_F12:
            dialog = Dialog::screenshot;
            break;
        default:
            if (!control) keysDown_.insert(key);
            break;
    }
}

}  // namespace shoal::viewer
