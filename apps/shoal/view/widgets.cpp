#include "view/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "view/style.h"

namespace shoal::viewer {

namespace {

constexpr double kUnbounded = 1e30;

bool containsIgnoringCase(const std::string& text, const std::string& part) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
    };
    return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

void showHelp(const FieldInfo& info) {
    if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    ImGui::TextUnformatted(info.sentence.c_str());
    std::string range;
    if (info.lowest > -kUnbounded && info.highest < kUnbounded) {
        char words[96];
        std::snprintf(words, sizeof words, "%g .. %g", info.lowest, info.highest);
        range = words;
    }
    if (!info.unit.empty()) range += (range.empty() ? "in " : " ") + info.unit;
    if (!range.empty()) ImGui::TextDisabled("%s", range.c_str());
    ImGui::TextDisabled("%s, default %s", info.key.c_str(),
                        info.defaultValue.empty() ? "none" : info.defaultValue.c_str());
    if (info.kind == FieldInfo::Kind::number || info.kind == FieldInfo::Kind::integer)
        ImGui::TextDisabled("double-click to type, right-click to reset");
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

// Steps and format that suit a value: three figures.
std::string formatFor(double value, double span) {
    const double size = span < kUnbounded ? span : std::abs(value);
    if (size < 1e-9) return "%.1f";
    if (std::abs(value) >= 1e6 || (value != 0 && std::abs(value) < 1e-3 * size)) return "%.3g";
    return size >= 1000 ? "%.0f" : size >= 100 ? "%.1f" : size >= 5 ? "%.2f" : size >= 0.05 ? "%.3f" : "%.5f";
}

// A range that a slider can be dragged through; others are dragged without ends.
bool isSliderRange(double lowest, double highest) {
    return lowest > -kUnbounded && highest < kUnbounded && highest - lowest <= 400;
}

bool editNumbers(FieldInfo& info) {
    float values[4] = {};
    for (int i = 0; i < info.components; ++i) values[i] = float(info.numbers[std::size_t(i)]);
    const float low = float(std::max(info.lowest, -1e30)), high = float(std::min(info.highest, 1e30));
    const bool slider = isSliderRange(info.lowest, info.highest);
    double most = 0;
    for (const double number : info.numbers) most = std::max(most, std::abs(number));
    std::string format = formatFor(most, slider && info.components == 1 ? info.highest - info.lowest : kUnbounded);
    if (info.components == 1 && !info.unit.empty()) format += " " + info.unit;
    bool changed = false;
    if (info.components == 1 && slider) {
        changed = ImGui::SliderFloat("##value", values, low, high, format.c_str(), ImGuiSliderFlags_NoRoundToFormat);
        // A double click types, as everywhere; ImGui's own way (Ctrl and a click) stays.
        if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) ImGui::SetKeyboardFocusHere(-1);
    } else {
        const float size = std::max({std::abs(values[0]), std::abs(values[1]), std::abs(values[2]), 0.05f});
        changed = ImGui::DragScalarN("##value", ImGuiDataType_Float, values, info.components, 0.005f * size,
                                     low > -1e29f ? &low : nullptr, high < 1e29f ? &high : nullptr, format.c_str(),
                                     ImGuiSliderFlags_NoRoundToFormat);
    }
    if (!changed) return false;
    for (int i = 0; i < info.components; ++i)
        info.numbers[std::size_t(i)] = double(std::clamp(values[i], float(info.lowest), float(info.highest)));
    return true;
}

bool editInteger(FieldInfo& info) {
    std::int64_t value = std::int64_t(info.numbers[0]);
    const std::int64_t low = std::int64_t(std::max(info.lowest, -2147483648.0)),
                       high = std::int64_t(std::min(info.highest, 4294967295.0));
    const bool changed = high - low <= 64
                             ? ImGui::SliderScalar("##value", ImGuiDataType_S64, &value, &low, &high, "%lld")
                             : ImGui::DragScalar("##value", ImGuiDataType_S64, &value, 0.5f, &low, &high, "%lld");
    info.numbers[0] = double(std::clamp(value, low, high));
    return changed;
}

bool editText(FieldInfo& info) {
    if (info.choices.empty()) return ImGui::InputText("##value", &info.text, ImGuiInputTextFlags_EnterReturnsTrue);
    bool changed = false;
    if (!ImGui::BeginCombo("##value", info.text.c_str())) return false;
    for (const std::string& choice : info.choices) {
        if (ImGui::Selectable(choice.c_str(), choice == info.text)) {
            info.text = choice;
            changed = true;
        }
    }
    ImGui::EndCombo();
    return changed;
}

// Click with the right button: what the value can go back to.
void drawResetMenu(const FieldInfo& info, const FieldActions& actions) {
    if (!ImGui::BeginPopupContextItem("reset")) return;
    const std::string toDefault = "Default: " + (info.defaultValue.empty() ? "none" : info.defaultValue);
    if (ImGui::MenuItem(toDefault.c_str(), nullptr, false, info.value != info.defaultValue))
        actions.set(info.key, info.defaultValue);
    if (ImGui::MenuItem("As in the file", nullptr, false, actions.isChanged(info.key))) actions.reset(info.key);
    ImGui::Separator();
    if (ImGui::MenuItem("Copy key=value")) ImGui::SetClipboardText((info.key + "=" + info.value).c_str());
    ImGui::EndPopup();
}

}  // namespace

void notePlace(WidgetPlaces& places, const std::string& name) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    places[name] = {low.x, low.y, high.x - low.x, high.y - low.y};
}

void drawField(const FieldInfo& shown, const FieldActions& actions) {
    FieldInfo info = shown;
    ImGui::PushID(info.key.c_str());
    const bool changedByHand = actions.isChanged(info.key);
    const float resetWidth = ImGui::GetFrameHeight();
    const float width = ImGui::GetContentRegionAvail().x;
    const float labelWidth = std::max(0.40f * width, ImGui::GetFontSize() * 7);
    ImGui::AlignTextToFramePadding();
    if (changedByHand) ImGui::PushStyleColor(ImGuiCol_Text, accentColor());
    ImGui::TextUnformatted(info.name.c_str());
    if (changedByHand) ImGui::PopStyleColor();
    showHelp(info);
    ImGui::SameLine(labelWidth);
    ImGui::SetNextItemWidth(std::max(40.0f, width - labelWidth - resetWidth - ImGui::GetStyle().ItemSpacing.x));
    bool changed = false;
    switch (info.kind) {
        case FieldInfo::Kind::boolean: {
            bool value = info.numbers[0] != 0;
            changed = ImGui::Checkbox("##value", &value);
            info.numbers[0] = double(value);
            break;
        }
        case FieldInfo::Kind::integer:
            changed = editInteger(info);
            break;
        case FieldInfo::Kind::number:
            changed = editNumbers(info);
            break;
        case FieldInfo::Kind::text:
            changed = editText(info);
            break;
    }
    if (actions.places) notePlace(*actions.places, info.key);
    drawResetMenu(info, actions);
    showHelp(info);
    if (changed) actions.set(info.key, valueText(info));
    if (ImGui::IsItemDeactivated()) actions.gestureEnded();
    if (info.value != info.defaultValue || changedByHand) {
        ImGui::SameLine(width - resetWidth + ImGui::GetStyle().ItemSpacing.x * 0.5f);
        if (ImGui::Button("\xe2\x86\xba##reset", {resetWidth, 0})) {  // an arrow round
            changedByHand ? actions.reset(info.key) : actions.set(info.key, info.defaultValue);
            actions.gestureEnded();
        }
        if (actions.places) notePlace(*actions.places, "reset:" + info.key);
        if (ImGui::IsItemHovered())
            ImGui::SetTooltip("%s",
                              changedByHand ? "back to what the file says" : ("default: " + info.defaultValue).c_str());
    }
    ImGui::PopID();
}

void drawGroup(const FieldGroup& group, const FieldActions& actions, const std::string& filter) {
    std::vector<const FieldInfo*> shown;
    for (const FieldInfo& info : group.fields)
        if (filter.empty() || containsIgnoringCase(info.key, filter) || containsIgnoringCase(info.sentence, filter) ||
            containsIgnoringCase(group.title, filter))
            shown.push_back(&info);
    if (shown.empty()) return;
    if (!filter.empty()) ImGui::SetNextItemOpen(true);
    const bool open = ImGui::CollapsingHeader((group.title + "###" + group.table).c_str(),
                                              group.closed ? 0 : ImGuiTreeNodeFlags_DefaultOpen);
    if (actions.places) notePlace(*actions.places, "group:" + group.table);
    if (!open) return;
    ImGui::PushID(group.table.c_str());
    for (const FieldInfo* info : shown) drawField(*info, actions);
    ImGui::PopID();
}

}  // namespace shoal::viewer
