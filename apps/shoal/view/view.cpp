// shoal view: the window and its loop.
#include <chrono>
#include <cmath>
#include <cstdlib>

#include <epoxy/gl.h>

#define GLFW_INCLUDE_NONE
#include <backends/imgui_impl_opengl3.h>
#include <GLFW/glfw3.h>
#include <imgui.h>

#include "verbs.h"
#include "view/layout.h"
#include "view/script.h"

namespace shoal::app {

namespace {

using namespace shoal::viewer;

constexpr double kScriptedTurn = 1.0 / 30;  // seconds: a script's time does not depend on the machine's
constexpr int kTurnsAfterInput = 3;         // ImGui's windows settle

// Dear ImGui for the life of this object. Events reach it through feedImGui, so only its GL half is its own.
class Interface {
public:
    explicit Interface(GLFWwindow* window) {
        ImGui::CreateContext();
        ImGuiIO& io = ImGui::GetIO();
        io.IniFilename = nullptr;
        io.LogFilename = nullptr;
        io.MousePos = {-1e6f, -1e6f};  // nowhere, until it moves
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
        io.ClipboardUserData = window;
        io.SetClipboardTextFn = [](void* w, const char* text) {
            glfwSetClipboardString(static_cast<GLFWwindow*>(w), text);
        };
        io.GetClipboardTextFn = [](void* w) { return glfwGetClipboardString(static_cast<GLFWwindow*>(w)); };
        struct Named {
            ImGuiKey imgui;
            int glfw;
        };
        for (const Named& key : {Named{ImGuiKey_Tab, GLFW_KEY_TAB},
                                 {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
                                 {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
                                 {ImGuiKey_UpArrow, GLFW_KEY_UP},
                                 {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
                                 {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
                                 {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
                                 {ImGuiKey_Home, GLFW_KEY_HOME},
                                 {ImGuiKey_End, GLFW_KEY_END},
                                 {ImGuiKey_Delete, GLFW_KEY_DELETE},
                                 {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
                                 {ImGuiKey_Space, GLFW_KEY_SPACE},
                                 {ImGuiKey_Enter, GLFW_KEY_ENTER},
                                 {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
                                 {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
                                 {ImGuiKey_A, GLFW_KEY_A},
                                 {ImGuiKey_C, GLFW_KEY_C},
                                 {ImGuiKey_V, GLFW_KEY_V},
                                 {ImGuiKey_X, GLFW_KEY_X},
                                 {ImGuiKey_Y, GLFW_KEY_Y},
                                 {ImGuiKey_Z, GLFW_KEY_Z}})
            io.KeyMap[key.imgui] = key.glfw;
        ImGui_ImplOpenGL3_Init("#version 450");
    }
    ~Interface() {
        ImGui_ImplOpenGL3_Shutdown();
        ImGui::DestroyContext();
    }
    Interface(const Interface&) = delete;
    Interface& operator=(const Interface&) = delete;
};

float screenScale(GLFWwindow* window, float asked) {
    if (asked > 0) return asked;
    float x = 1, y = 1;
    glfwGetWindowContentScale(window, &x, &y);
    return std::clamp(std::round(4 * x) / 4, 1.0f, 4.0f);
}

// One turn's drawing: panels laid out first, for they say how large the picture is.
void drawTurn(Viewer& viewer, double seconds) {
    ImGuiIO& io = ImGui::GetIO();
    const int width = viewer.window.width(), height = viewer.window.height();
    io.DisplaySize = {float(width), float(height)};
    io.DeltaTime = float(std::max(seconds, 1e-4));
    if (std::exchange(viewer.styleChanged, false)) applyStyle(viewer.settings.theme, viewer.uiScale);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    drawLayout(viewer);
    viewer.update(seconds);
    viewer.draw();
    ImGui::Render();
    gl::setKnownState();
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, width, height);
    const ImVec4 back = ImGui::GetStyle().Colors[ImGuiCol_WindowBg];
    glClearColor(back.x, back.y, back.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    blitPictures(viewer);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Result<void> loop(Viewer& viewer, std::vector<Event>& events, std::optional<Script>& script) {
    auto before = std::chrono::steady_clock::now();
    int turnsLeft = kTurnsAfterInput;
    std::string title;
    while (!viewer.quit) {
        if (script || turnsLeft > 0 || viewer.wantsFrame())
            glfwPollEvents();
        else
            glfwWaitEventsTimeout(0.25);
        if (script) SHOAL_TRY(script->step(viewer, events));
        turnsLeft = events.empty() ? std::max(0, turnsLeft - 1) : kTurnsAfterInput;
        const std::vector<Event> now = std::exchange(events, {});
        for (const Event& event : now) feedImGui(event);
        for (const Event& event : now) viewer.handle(event);
        const auto time = std::chrono::steady_clock::now();
        const double seconds =
            script && !script->realTime() ? kScriptedTurn : std::chrono::duration<double>(time - before).count();
        before = time;
        if (viewer.window.width() < 1 || viewer.window.height() < 1) continue;  // minimised
        const auto start = std::chrono::steady_clock::now();
        drawTurn(viewer, seconds);
        if (script) SHOAL_TRY(script->drawn(viewer));
        viewer.window.swap();
        if (viewer.interacting())
            viewer.scale.addFrame(
                std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        if (viewer.document.title() != title) {
            title = viewer.document.title();
            glfwSetWindowTitle(viewer.window.handle(), title.c_str());
        }
    }
    return {};
}

Result<void> run(const ViewOptions& o) {
    SHOAL_TRY_ASSIGN(const std::vector<scene::Override> overrides, parseOverrides(o.sets));
    SHOAL_TRY_ASSIGN(const IVec2 size, parseSize(o.size));
    std::optional<Script> script;
    if (!o.script.empty()) {
        SHOAL_TRY_ASSIGN(script, Script::read(o.script));
    }
    std::vector<std::filesystem::path> files(o.files.begin(), o.files.end());
    if (files.empty()) {
        SHOAL_TRY_ASSIGN(const std::string folder, scenesFolder());
        files.push_back(std::filesystem::path(folder) / "plaza.toml");
    }
    // What is wrong with the file is told before there is a window.
    SHOAL_TRY_ASSIGN(Document document, Document::open(files, overrides));
    if (o.device == "cpu") ::setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    Viewer* shown = nullptr;
    gl::DeviceOptions deviceOptions;
    deviceOptions.debug = o.debug;
    const LogSink toStderr = stderrSink(o.debug ? LogLevel::debug : LogLevel::warning);
    deviceOptions.log = [&](LogLevel level, std::string_view message) {
        toStderr(level, message);
        if (shown && level == LogLevel::error) shown->fail(std::string(message));
    };
    SHOAL_TRY_ASSIGN(const auto window, gl::Window::open(size.x, size.y, document.title(), true, deviceOptions));
    std::vector<Event> events;
    listen(window->handle(), events);
    const Interface interface(window->handle());
    SHOAL_TRY_ASSIGN(Picture picture, Picture::create(window->device()));
    Viewer viewer(*window, std::move(document), std::move(picture));
    shown = &viewer;
    viewer.uiScale = screenScale(window->handle(), o.uiScale);
    loadFonts(viewer.uiScale);
    if (script) {
        viewer.recordSettings = false;  // a test leaves nothing behind
    } else {
        viewer.settings = readSettings();
        viewer.settings.addRecent(std::filesystem::absolute(files[0]).lexically_normal().string());
        writeSettings(viewer.settings);
    }
    if (script) glfwSwapInterval(0);
    const Result<void> done = loop(viewer, events, script);
    viewer.stopComparison();
    shown = nullptr;
    return done;
}

}  // namespace

int view(const ViewOptions& options) {
    const Result<void> done = run(options);
    return done ? kDone : report(done.error());
}

}  // namespace shoal::app
