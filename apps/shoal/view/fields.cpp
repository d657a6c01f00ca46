#include "view/fields.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <shoal/frame/lighting.h>
#include <shoal/frame/post.h>
#include <shoal/frame/shadows.h>
#include <shoal/pipeline/water.h>
#include <shoal/scene/shapes.h>

namespace shoal::viewer {

namespace {

std::string shortest(double value) { return shoal::detail::showField(float(value)); }

// The fields of structs that share one table of a technique; values out of range stay at their defaults.
template <class... Params>
void addTable(std::vector<FieldGroup>& groups, const scene::Scene& scene, const char* title, const char* name,
              bool always = false) {
    const scene::RawTable* table = scene.table(name);
    if (!table && !always) return;
    FieldGroup group{title, name, {}, false};
    const auto addOne = [&](auto params) {
        if (table)
            for (const scene::RawEntry& entry : table->entries) (void)setField(params, entry.key, entry.value);
        addFields(group.fields, name, params);
    };
    (addOne(Params{}), ...);
    groups.push_back(std::move(group));
}

void addWater(std::vector<FieldGroup>& groups, const scene::Scene& scene) {
    if (!scene.table("water")) return;
    addTable<water::BodyParams, water::OpticsParams>(groups, scene, "Water", "water");
    addTable<water::WaveParams>(groups, scene, "Water: waves", "water.waves", true);
    addTable<water::PhotonParams, water::LightViewParams, water::LightViewSetup>(groups, scene, "Water: caustics",
                                                                                 "water.caustics", true);
    addTable<water::ShaftParams>(groups, scene, "Water: shafts", "water.shafts", true);
    addTable<water::SurfaceParams>(groups, scene, "Water: surface", "water.surface", true);
    addTable<water::PaperParams>(groups, scene, "Water: the paper's method", "water.paper");
}

// A shape's settings are known by their defaults in words.
void addShapeSettings(FieldGroup& group, const scene::ShapeEntry& shape) {
    for (const FieldRow& row : scene::describeShape(shape.kind)) {
        auto value = parseFieldValue(row.value);
        for (const scene::RawEntry& entry : shape.settings)
            if (entry.key == row.name) value = entry.value;
        if (!value) continue;
        FieldInfo info;
        info.key = group.table + "." + row.name;
        info.name = row.name, info.unit = row.unit, info.sentence = row.sentence;
        if (value->kind == FieldValue::Kind::text)
            info.kind = FieldInfo::Kind::text, info.text = value->text;
        else if (value->kind == FieldValue::Kind::boolean)
            info.kind = FieldInfo::Kind::boolean, info.numbers = {double(value->boolean)};
        else
            info.numbers = value->numbers;
        info.components = int(info.numbers.size());
        info.value = valueText(info);
        info.defaultValue = row.value;
        group.fields.push_back(std::move(info));
    }
}

// toSun as a person thinks of it; Viewer::setValue turns them back into toSun.
void addSunAngles(FieldGroup& group, Vec3 toSun) {
    const Vec3 d = normalize(toSun);
    const auto angle = [&](const char* name, double value, double low, double high, const char* sentence) {
        FieldInfo info;
        info.key = std::string("sun.") + name, info.name = name, info.unit = "deg", info.sentence = sentence;
        info.lowest = low, info.highest = high;
        info.numbers = {value};
        info.value = info.defaultValue = valueText(info);
        return info;
    };
    const double elevation = std::asin(std::clamp(double(d.y), -1.0, 1.0)) * 180 / kPiD;
    const double azimuth = std::atan2(double(d.x), double(d.z)) * 180 / kPiD;
    group.fields.insert(group.fields.begin(),
                        {angle("elevationDeg", elevation, -90, 90, "height above the horizon"),
                         angle("azimuthDeg", azimuth, -180, 180, "from +z towards +x, seen from above")});
}

std::string named(const char* what, std::size_t index, const std::string& name) {
    return std::string(what) + " " + std::to_string(index + 1) + (name.empty() ? "" : ": " + name);
}

}  // namespace

std::string valueText(const FieldInfo& info) {
    switch (info.kind) {
        case FieldInfo::Kind::boolean:
            return info.numbers.at(0) != 0 ? "true" : "false";
        case FieldInfo::Kind::integer: {
            char text[40];
            std::snprintf(text, sizeof text, "%.0f", info.numbers.at(0));
            return text;
        }
        case FieldInfo::Kind::text:
            return info.text;
        case FieldInfo::Kind::number:
            break;
    }
    if (info.numbers.size() == 1) return shortest(info.numbers[0]);
    std::string text;
    for (const double number : info.numbers) text += (text.empty() ? "[" : ", ") + shortest(number);
    return text + "]";
}

std::vector<FieldGroup> groupsOf(const scene::Scene& scene) {
    std::vector<FieldGroup> groups;
    const auto add = [&](const std::string& title, const std::string& table, const auto& params, bool closed = false) {
        FieldGroup group{title, table, {}, closed};
        addFields(group.fields, table, params);
        groups.push_back(std::move(group));
    };
    if (!scene.sunOff) {
        add("Sun", "sun", scene.sun);
        addSunAngles(groups.back(), scene.sun.toSun);
    }
    add("Environment", "environment", scene.environment);
    addTable<frame::LightingParams>(groups, scene, "Lighting", "lighting", true);
    addTable<frame::ShadowParams>(groups, scene, "Shadows", "shadows", true);
    addTable<frame::PostParams>(groups, scene, "Exposure and tone", "post", true);
    addWater(groups, scene);
    for (std::size_t i = 0; i < scene.lights.size(); ++i)
        add(named("Lamp", i, scene.lights[i].kind), "light[" + std::to_string(i) + "]", scene.lights[i], true);
    for (std::size_t i = 0; i < scene.models.size(); ++i) {
        const scene::ModelEntry& entry = scene.models[i];
        const std::string name = std::filesystem::path(entry.model.file).filename().string();
        add(named("Model", i, entry.placement.name.empty() ? name : entry.placement.name), entry.key, entry.model,
            true);
        addFields(groups.back().fields, entry.key, entry.placement);
        addFields(groups.back().fields, entry.key + ".copies", entry.copies);
    }
    for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
        const scene::ShapeEntry& entry = scene.shapes[i];
        add(named("Shape", i, entry.placement.name.empty() ? entry.kind : entry.placement.name), entry.key,
            entry.placement, true);
        addShapeSettings(groups.back(), entry);
    }
    add("Render", "render", scene.render, true);
    return groups;
}

}  // namespace shoal::viewer
