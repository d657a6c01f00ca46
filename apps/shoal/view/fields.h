// Every parameter of a scene as data: what a panel is drawn from. Comes from the visit() beside each parameter struct,
// so a technique's panel needs no line here but its name in fieldsOf's list.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include <shoal/core/params.h>
#include <shoal/scene/scene.h>

namespace shoal::viewer {

struct FieldInfo {
    enum class Kind { boolean, integer, number, text } kind = Kind::number;
    int components = 1;  // of Kind::number
    std::string key;     // "post.exposureEv"
    std::string name, unit, sentence;
    double lowest = -1e30, highest = 1e30;
    std::vector<std::string> choices;
    std::vector<double> numbers;      // boolean: 0 or 1
    std::string text;                 // Kind::text
    std::string value, defaultValue;  // as --set takes them
};

struct FieldGroup {
    std::string title;  // "Post", "Light 1"
    std::string table;  // "post", "light[0]"
    std::vector<FieldInfo> fields;
    bool closed = false;  // shown folded at first
};

// "true", "[1, 2, 3]", "text"
std::string valueText(const FieldInfo& info);

namespace detail {
inline void take(FieldInfo& info, bool value) { info.kind = FieldInfo::Kind::boolean, info.numbers = {double(value)}; }
inline void take(FieldInfo& info, int value) { info.kind = FieldInfo::Kind::integer, info.numbers = {double(value)}; }
inline void take(FieldInfo& info, std::uint32_t value) {
    info.kind = FieldInfo::Kind::integer, info.numbers = {double(value)};
}
inline void take(FieldInfo& info, float value) { info.numbers = {double(value)}; }
inline void take(FieldInfo& info, Vec2 v) { info.numbers = {double(v.x), double(v.y)}; }
inline void take(FieldInfo& info, Vec3 v) { info.numbers = {double(v.x), double(v.y), double(v.z)}; }
inline void take(FieldInfo& info, Vec4 v) { info.numbers = {double(v.x), double(v.y), double(v.z), double(v.w)}; }
inline void take(FieldInfo& info, const std::string& value) { info.kind = FieldInfo::Kind::text, info.text = value; }
}  // namespace detail

// Appends one FieldInfo a field of `params`.
template <class Params>
void addFields(std::vector<FieldInfo>& to, const std::string& table, const Params& params) {
    const std::size_t first = to.size();
    visit(params, [&](const auto& value, const Field& field) {
        FieldInfo info;
        info.key = table + "." + field.name;
        info.name = field.name, info.unit = field.unit, info.sentence = field.sentence;
        info.lowest = field.lowest, info.highest = field.highest;
        info.choices = field.choices;
        detail::take(info, value);
        info.components = int(info.numbers.size());
        info.value = valueText(info);
        to.push_back(std::move(info));
    });
    std::size_t i = first;
    const Params defaults;
    visit(defaults, [&](const auto& value, const Field&) {
        FieldInfo info;
        detail::take(info, value);
        to[i++].defaultValue = valueText(info);
    });
}

// All groups of a scene but the camera, which a person moves.
std::vector<FieldGroup> groupsOf(const scene::Scene& scene);

}  // namespace shoal::viewer
