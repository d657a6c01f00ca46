// What lies over the picture: errors, notes, the first hint, the divider, values under the cursor, the keys.
#include <algorithm>

#include <imgui.h>

#include "view/layout.h"
#include "view/style.h"

namespace shoal::viewer {

namespace {

constexpr ImGuiWindowFlags kOverlay = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                      ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                      ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoMove;

// A strip of text; `stays` ones take the mouse, so that they can be closed.
bool strip(const char* id, const std::string& text, float x, float y, float pivotY, float width, bool stays) {
    ImGui::SetNextWindowPos({x, y}, ImGuiCond_Always, {0, pivotY});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {width, 1e6f});
    ImGui::SetNextWindowBgAlpha(0.88f);
    bool close = false;
    ImGui::Begin(id, nullptr, kOverlay | (stays ? 0 : ImGuiWindowFlags_NoInputs));
    if (stays) {
        close = ImGui::SmallButton("x");
        ImGui::SameLine();
    }
    ImGui::PushTextWrapPos(width - 20);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::End();
    return close;
}

void drawDivider(Viewer& v) {
    const Area& a = v.viewport;
    const float x = float(a.x) + v.comparison->divider * float(a.width);
    const float top = float(a.y), bottom = float(a.y + a.height), middle = 0.5f * (top + bottom), s = v.uiScale;
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    list->AddLine({x, top}, {x, bottom}, IM_COL32(0, 0, 0, 160), 4 * s);
    list->AddLine({x, top}, {x, bottom}, IM_COL32(255, 255, 255, 230), 2 * s);
    list->AddCircleFilled({x, middle}, 9 * s, IM_COL32(255, 255, 255, 240));
    list->AddTriangleFilled({x - 6 * s, middle}, {x - 2 * s, middle - 4 * s}, {x - 2 * s, middle + 4 * s},
                            IM_COL32(40, 40, 40, 255));
    list->AddTriangleFilled({x + 6 * s, middle}, {x + 2 * s, middle - 4 * s}, {x + 2 * s, middle + 4 * s},
                            IM_COL32(40, 40, 40, 255));
    const auto label = [&](const char* text, float at) {
        list->AddRectFilled({at - 4 * s, top + 6 * s},
                            {at + ImGui::CalcTextSize(text).x + 4 * s, top + 10 * s + ImGui::GetFontSize()},
                            IM_COL32(0, 0, 0, 140), 3 * s);
        list->AddText({at, top + 8 * s}, IM_COL32(255, 255, 255, 255), text);
    };
    label("left", x - 14 * s - ImGui::CalcTextSize("left").x);
    label("right", x + 14 * s);
}

void drawReadings(Viewer& v) {
    const Area& a = v.viewport;
    if (!v.inspector.active() || !a.contains(v.cursorX, v.cursorY) || ImGui::GetIO().WantCaptureMouse) return;
    const float x = float(v.cursorX - a.x) / float(a.width), y = float(v.cursorY - a.y) / float(a.height);
    const auto readings = v.inspector.at(x, y, v.picture.content());
    if (readings.empty()) return;
    ImGui::SetNextWindowBgAlpha(0.9f);
    ImGui::Begin("readings", nullptr, kOverlay | ImGuiWindowFlags_NoInputs);
    // Beside the cursor where that is free, never over the panels: the size is the last frame's.
    const float gap = ImGui::GetFontSize();
    const ImVec2 size = ImGui::GetWindowSize();
    const auto beside = [gap](float cursor, float extent, float low, float high) {
        const float after = cursor + gap, before = cursor - gap - extent;
        return std::max(low, after + extent <= high ? after : std::max(before, low));
    };
    ImGui::SetWindowPos({beside(float(v.cursorX), size.x, float(a.x), float(a.x + a.width)),
                         beside(float(v.cursorY), size.y, float(a.y), float(a.y + a.height))});
    ImGui::TextDisabled("pixel %d, %d", int(v.cursorX) - a.x, int(v.cursorY) - a.y);
    if (ImGui::BeginTable("values", 3, ImGuiTableFlags_SizingFixedFit)) {
        const MonoScope mono;
        for (const Inspector::Reading& reading : readings) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(reading.name.c_str());
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(reading.value.c_str());
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", reading.unit.c_str());
        }
        ImGui::EndTable();
    }
    ImGui::End();
}

}  // namespace

void drawOverlays(Viewer& v) {
    const Area& a = v.viewport;
    const float margin = 10 * v.uiScale, width = float(a.width) - 2 * margin;
    if (v.comparison) drawDivider(v);
    if (!v.error_.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, warningColor());
        if (strip("error", v.error_, float(a.x) + margin, float(a.y) + margin, 0, width, true)) v.error_.clear();
        ImGui::PopStyleColor();
    }
    const float bottom = float(a.y + a.height) - margin;
    if (v.noteSeconds_ > 0)
        strip("note", v.note_, float(a.x) + margin, bottom, 1, width, false);
    else if (v.inspector.active())
        strip("buffer", v.inspector.chosen() + ": " + v.inspector.rangeText(), float(a.x) + margin, bottom, 1, width,
              false);
    else if (!v.settings.hintRead && v.picture.hasScene())
        strip("hint",
              "Drag to look around, right drag to move, wheel to go nearer, F to see everything, F1 for all keys",
              float(a.x) + margin, bottom, 1, width, false);
    drawReadings(v);
}

void drawHelp(Viewer& v) {
    struct Row {
        const char *keys, *what;
    };
    static constexpr Row kRows[] = {
        {"drag", "circle the pivot (fly: look about)"},
        {"right or middle drag, Shift drag", "move sideways"},
        {"wheel, Ctrl drag", "nearer, farther (fly: speed)"},
        {"W A S D  Q E", "fly ahead, left, back, right, down, up; Shift: faster"},
        {"C", "fly instead of orbit, and back"},
        {"F", "everything in the picture"},
        {"Home, 0", "the scene's own camera"},
        {"1  3  7", "from the front, the right, above; Ctrl: the other side (number pad too)"},
        {"5", "perspective or orthographic"},
        {"Space", "play or stop;  , and . go one frame"},
        {"V", "compare two sets of parameters"},
        {"P", "panels off and on"},
        {"T", "light or dark"},
        {"Ctrl+O", "open; files can be dropped into the window too"},
        {"Ctrl+S", "save the scene as it is now"},
        {"Ctrl+P, F12", "screenshot"},
        {"Ctrl+C", "copy the shoal render command of this view"},
        {"Ctrl+Z, Ctrl+Shift+Z", "undo, redo"},
        {"Tab, arrows, Enter", "walk through the panels; Esc goes back to the picture"},
        {"double-click a value", "type it;  right click: reset"},
        {"Ctrl+Q", "quit"},
    };
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({0.5f * window.x, 0.5f * window.y}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::Begin("Keys and mouse", &v.showHelp,
                 ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const Row& row : kRows) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(row.keys);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", row.what);
        }
        ImGui::EndTable();
    }
    ImGui::Separator();
    ImGui::TextDisabled("F1 or Esc closes this");
    ImGui::End();
}

}  // namespace shoal::viewer
