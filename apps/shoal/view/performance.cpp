// What a frame costs: time of each pass over the last frames, memory, device.
#include <algorithm>
#include <cstdio>
#include <map>

#include <imgui.h>

#include "view/layout.h"

namespace shoal::viewer {

namespace {

ImU32 colorOf(std::size_t index) {
    const float hue = float(index % 11) * 0.0909f + 0.55f;
    float r = 0, g = 0, b = 0;
    ImGui::ColorConvertHSVtoRGB(hue - float(int(hue)), 0.55f, index % 2 ? 0.65f : 0.85f, r, g, b);
    return ImGui::GetColorU32({r, g, b, 1});
}

// Stacked bars, newest at the right; a line at 33 ms.
void drawPlot(const std::deque<FrameCost>& costs, const std::vector<std::string>& names) {
    const ImVec2 low = ImGui::GetCursorScreenPos();
    const ImVec2 size{ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 6};
    ImGui::Dummy(size);
    ImDrawList* list = ImGui::GetWindowDrawList();
    list->AddRectFilled(low, {low.x + size.x, low.y + size.y}, ImGui::GetColorU32(ImGuiCol_FrameBg));
    double most = 40;
    for (const FrameCost& cost : costs) most = std::max(most, cost.totalMs);
    most = std::min(most, 200.0);  // full pictures of a CPU would press all else to the ground
    list->PushClipRect(low, {low.x + size.x, low.y + size.y}, true);
    const float perMs = size.y / float(most * 1.05), barWidth = size.x / 120;
    float x = low.x + size.x - barWidth * float(costs.size());
    for (const FrameCost& cost : costs) {
        float y = low.y + size.y;
        for (const gl::PassTime& pass : cost.passes) {
            const auto index = std::size_t(std::find(names.begin(), names.end(), pass.name) - names.begin());
            const float height = float(pass.timeMs) * perMs;
            list->AddRectFilled({x, y - height}, {x + std::max(1.0f, barWidth - 0.5f), y}, colorOf(index));
            y -= height;
        }
        if (cost.passes.empty())
            list->AddRectFilled({x, y - float(cost.totalMs) * perMs}, {x + std::max(1.0f, barWidth - 0.5f), y},
                                ImGui::GetColorU32(ImGuiCol_PlotHistogram));
        x += barWidth;
    }
    const float line = low.y + size.y - 33.3f * perMs;
    list->AddLine({low.x, line}, {low.x + size.x, line}, ImGui::GetColorU32(ImGuiCol_TextDisabled));
    list->AddText({low.x + 4, line - ImGui::GetFontSize() - 1}, ImGui::GetColorU32(ImGuiCol_TextDisabled), "33 ms");
    list->PopClipRect();
}

}  // namespace

void drawPerformance(Viewer& v) {
    v.showPerformance = ImGui::CollapsingHeader("Performance");
    notePlace(v.places, "group:performance");
    if (!v.showPerformance) return;
    std::vector<std::string> names;
    for (const FrameCost& cost : v.costs)
        for (const gl::PassTime& pass : cost.passes)
            if (std::find(names.begin(), names.end(), pass.name) == names.end()) names.push_back(pass.name);
    drawPlot(v.costs, names);
    if (!v.costs.empty() && ImGui::BeginTable("passes", 2, ImGuiTableFlags_SizingStretchProp)) {
        for (const gl::PassTime& pass : v.costs.back().passes) {
            const auto index = std::size_t(std::find(names.begin(), names.end(), pass.name) - names.begin());
            ImGui::TableNextColumn();
            const ImVec2 at = ImGui::GetCursorScreenPos();
            const float em = ImGui::GetFontSize();
            ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + 0.2f * em}, {at.x + 0.6f * em, at.y + 0.8f * em},
                                                      colorOf(index));
            ImGui::SetCursorPosX(ImGui::GetCursorPosX() + em);
            ImGui::TextUnformatted(pass.name.c_str());
            ImGui::TableNextColumn();
            ImGui::Text("%.2f ms", pass.timeMs);
        }
        ImGui::TableNextColumn();
        ImGui::TextUnformatted("last picture, all");
        ImGui::TableNextColumn();
        ImGui::Text("%.2f ms", v.costs.back().totalMs);
        ImGui::EndTable();
    }
    const gl::Device& device = v.window.device();
    ImGui::TextDisabled("%s", gl::FrameTimer::method(device));
    const frame::Stats stats = v.picture.pipeline().stats();
    ImGui::Text("%.0f MiB in buffers and textures", double(stats.bytes) / (1024 * 1024));
    for (const auto& [name, count] : stats.counts) ImGui::Text("%lld %s", static_cast<long long>(count), name.c_str());
    ImGui::TextWrapped("%s", device.info().renderer.c_str());
}

}  // namespace shoal::viewer
