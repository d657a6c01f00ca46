// The panel at the right: camera, buffers, comparison, performance, then one group a capability from its parameters.
#include <cstdio>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "view/fields.h"
#include "view/layout.h"

namespace shoal::viewer {

namespace {

std::string filterText;  // of the search line

FieldActions actionsFor(Viewer& v) {
    FieldActions actions;
    actions.set = [&v](const std::string& key, const std::string& value) { v.setValue(key, value); };
    actions.reset = [&v](const std::string& key) { v.resetValue(key); };
    actions.isChanged = [&v](const std::string& key) { return v.shownDocument().isChanged(key); };
    actions.gestureEnded = [&v] { v.shownDocument().endGesture(); };
    actions.places = &v.places;
    return actions;
}

bool radio(Viewer& v, const char* label, bool active) {
    const bool pressed = ImGui::RadioButton(label, active);
    notePlace(v.places, std::string("radio:") + label);
    return pressed;
}

void drawCamera(Viewer& v, const FieldActions& actions) {
    FieldGroup group{"Camera", "camera", {}, false};
    addFields(group.fields, "camera", v.cameraSpec());
    if (filterText.empty()) {
        if (!ImGui::CollapsingHeader("Camera", ImGuiTreeNodeFlags_DefaultOpen)) return;
        if (radio(v, "orbit", !v.flyMode)) v.flyMode = false;
        ImGui::SameLine();
        if (radio(v, "fly", v.flyMode)) v.flyMode = true;
        ImGui::SameLine();
        if (ImGui::Button("frame (F)")) v.press('F', 0);
        ImGui::SameLine();
        if (ImGui::Button("scene's (Home)")) v.goToSceneCamera();
        if (!v.camera.isFree()) ImGui::TextDisabled("the scene's own; drag the picture to take over");
        for (const FieldInfo& info : group.fields) drawField(info, actions);
    } else {
        drawGroup(group, actions, filterText);
    }
}

void drawBuffers(Viewer& v) {
    if (!ImGui::CollapsingHeader("Buffers")) return;
    if (radio(v, "picture", !v.inspector.active())) v.inspector.choose("");
    int column = 1;
    for (const pipeline::AovInfo& info : pipeline::aovs()) {
        if (column++ % 3 != 0) ImGui::SameLine(float((column - 1) % 3) * ImGui::GetContentRegionAvail().x / 3);
        if (radio(v, info.name, v.inspector.chosen() == info.name)) v.inspector.choose(info.name);
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s%s%s", info.sentence, *info.unit ? ", " : "", info.unit);
    }
    if (v.inspector.active()) ImGui::TextDisabled("%s", v.inspector.rangeText().c_str());
}

void drawComparison(Viewer& v) {
    if (!ImGui::CollapsingHeader("Comparison")) return;
    if (!v.comparison) {
        ImGui::TextWrapped("Two sets of parameters side by side, with a divider to drag.");
        if (ImGui::Button("Compare (V)")) v.startComparison();
        notePlace(v.places, "compare");
        return;
    }
    Comparison& c = *v.comparison;
    ImGui::TextUnformatted("The panels change");
    ImGui::SameLine();
    if (radio(v, "left", !c.editOther)) c.editOther = false;
    ImGui::SameLine();
    if (radio(v, "right", c.editOther)) c.editOther = true;
    ImGui::SetNextItemWidth(-1);
    ImGui::SliderFloat("##divider", &c.divider, 0, 1, "divider %.2f");
    if (ImGui::Button("Keep left")) {
        v.stopComparison();
    } else {
        ImGui::SameLine();
        if (ImGui::Button("Keep right")) {
            v.document.setOverrides(c.other.overrides());
            v.picture.load(v.document.scene());
            v.stopComparison();
        }
    }
}

}  // namespace

void drawSidePanel(Viewer& v) {
    const FieldActions actions = actionsFor(v);
    Document& document = v.shownDocument();
    ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - ImGui::GetFontSize() * 9);
    ImGui::InputTextWithHint("##filter", "find a parameter", &filterText);
    notePlace(v.places, "filter");
    ImGui::SameLine();
    if (ImGui::Button("undo")) v.undo();
    ImGui::SameLine();
    if (ImGui::Button("redo")) v.redo();
    if (v.comparison) ImGui::TextDisabled("parameters of the %s side", v.comparison->editOther ? "right" : "left");
    if (filterText.empty()) {
        drawPerformance(v);
        drawBuffers(v);
        drawComparison(v);
    }
    drawCamera(v, actions);
    for (const FieldGroup& group : groupsOf(document.scene())) drawGroup(group, actions, filterText);
}

}  // namespace shoal::viewer
