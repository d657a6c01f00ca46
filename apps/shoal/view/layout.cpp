#include "view/layout.h"

#include <algorithm>
#include <cstdio>

#include <imgui.h>

namespace shoal::viewer {

namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

void drawFileMenu(Viewer& v) {
    if (ImGui::MenuItem("Open ...", "Ctrl+O")) v.dialog = Dialog::open;
    if (ImGui::BeginMenu("Recent", !v.settings.recent.empty())) {
        const std::vector<std::string> recent = v.settings.recent;  // opening reorders it
        for (const std::string& file : recent)
            if (ImGui::MenuItem(file.c_str())) v.openFiles({file});
        ImGui::EndMenu();
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Save scene ...", "Ctrl+S")) v.dialog = Dialog::save;
    if (ImGui::MenuItem("Screenshot ...", "Ctrl+P")) v.dialog = Dialog::screenshot;
    if (ImGui::MenuItem("Copy as command", "Ctrl+C")) ImGui::SetClipboardText(v.command().c_str());
    ImGui::Separator();
    if (ImGui::MenuItem("Quit", "Ctrl+Q")) v.quit = true;
}

void drawViewMenu(Viewer& v) {
    struct Entry {
        const char* name;
        const char* key;
        int code;
    };
    for (const Entry& e : {Entry{"Frame everything", "F", 'F'}, Entry{"The scene's camera", "Home", '0'},
                           Entry{"From the front", "1", '1'}, Entry{"From the right", "3", '3'},
                           Entry{"From above", "7", '7'}, Entry{"Perspective / orthographic", "5", '5'}})
        if (ImGui::MenuItem(e.name, e.key)) v.press(e.code, 0);
    ImGui::Separator();
    if (ImGui::MenuItem("Fly instead of orbit", "C", v.flyMode)) v.press('C', 0);
    if (ImGui::MenuItem("Panels", "P", v.showPanels)) v.showPanels = !v.showPanels;
    if (ImGui::MenuItem("Compare two sets", "V", v.comparison.has_value())) v.press('V', 0);
    if (ImGui::MenuItem("Light theme", "T", v.settings.theme == Theme::light)) v.press('T', 0);
}

void drawBufferMenu(Viewer& v) {
    if (ImGui::MenuItem("Picture", nullptr, !v.inspector.active())) v.inspector.choose("");
    ImGui::Separator();
    for (const pipeline::AovInfo& info : pipeline::aovs()) {
        if (ImGui::MenuItem(info.name, info.unit, v.inspector.chosen() == info.name)) v.inspector.choose(info.name);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", info.sentence);
    }
}

float drawMenu(Viewer& v) {
    if (!ImGui::BeginMainMenuBar()) return 0;
    const auto menu = [&](const char* name, auto draw) {
        const bool open = ImGui::BeginMenu(name);
        notePlace(v.places, std::string("menu:") + name);
        if (!open) return;
        draw(v);
        ImGui::EndMenu();
    };
    menu("File", drawFileMenu);
    menu("View", drawViewMenu);
    menu("Buffers", drawBufferMenu);
    if (ImGui::MenuItem("Help", "F1")) v.press(290, 0);  // GLFW_KEY_F1
    const std::string status = v.statusLine();
    const float width = ImGui::CalcTextSize(status.c_str()).x + 2 * ImGui::GetStyle().WindowPadding.x;
    ImGui::SameLine(std::max(ImGui::GetCursorPosX() + 20, ImGui::GetWindowWidth() - width));
    ImGui::TextDisabled("%s", status.c_str());
    const float height = ImGui::GetWindowHeight();
    ImGui::EndMainMenuBar();
    return height;
}

void drawTimeBar(Viewer& v, const ImVec2& place, const ImVec2& size) {
    ImGui::SetNextWindowPos(place);
    ImGui::SetNextWindowSize(size);
    ImGui::Begin("time", nullptr, kFixed | ImGuiWindowFlags_NoScrollbar);
    Timeline& t = v.timeline;
    const scene::RenderSpec& render = v.document.scene().render;
    const float em = ImGui::GetFontSize();
    if (ImGui::Button(t.playing ? "Pause" : "Play", {4.2f * em, 0})) t.playing = !t.playing;
    notePlace(v.places, "play");
    ImGui::SameLine();
    if (ImGui::ArrowButton("back", ImGuiDir_Left)) v.press(',', 0);
    ImGui::SameLine(0, 2);
    if (ImGui::ArrowButton("on", ImGuiDir_Right)) v.press('.', 0);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("one frame of 1/%g s", double(render.fps));
    ImGui::SameLine();
    ImGui::SetNextItemWidth(std::max(4 * em, ImGui::GetContentRegionAvail().x - 15 * em));
    char format[40];
    std::snprintf(format, sizeof format, "%%.2f s of %.6g s", double(render.duration));
    if (ImGui::SliderFloat("##time", &t.time, 0, std::max(render.duration, 0.01f), format)) t.playing = false;
    notePlace(v.places, "time");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(6 * em);
    ImGui::DragFloat("##speed", &t.speed, 0.01f, -10, 10, "speed %.2f");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("scene seconds a second; double-click to type");
    ImGui::SameLine();
    ImGui::Checkbox("loop", &t.loop);
    ImGui::End();
}

}  // namespace

void drawLayout(Viewer& v) {
    v.places.clear();
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float menuHeight = drawMenu(v);
    const float barHeight = ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y;
    const float panelWidth = v.showPanels ? std::min(ImGui::GetFontSize() * 25, 0.5f * window.x) : 0;
    v.viewport = {0, int(menuHeight), std::max(1, int(window.x - panelWidth)),
                  std::max(1, int(window.y - menuHeight - barHeight))};
    drawTimeBar(v, {0, window.y - barHeight}, {window.x - panelWidth, barHeight});
    if (v.showPanels) {
        ImGui::SetNextWindowPos({window.x - panelWidth, menuHeight});
        ImGui::SetNextWindowSize({panelWidth, window.y - menuHeight});
        ImGui::Begin("panels", nullptr, kFixed);
        drawSidePanel(v);
        ImGui::End();
    }
    drawOverlays(v);
    if (v.showHelp) drawHelp(v);
    drawDialogs(v);
}

}  // namespace shoal::viewer
