// Procedural shapes: models made from a few parameters, enough for good-looking scenes without any file.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <shoal/core/model.h>
#include <shoal/core/params.h>
#include <shoal/core/result.h>

namespace shoal::scene {

// One key of a [[shape]] table.
struct ShapeSetting {
    std::string key;
    FieldValue value;
};

// The kinds makeShape knows: "plane", "box", "tank", "pier", ...
const std::vector<std::string>& shapeNames();

// Makes a shape. Same kind and settings, same bits. Errors begin with the setting's name: "width: found -1, expected
// ...".
Result<Model> makeShape(std::string_view kind, std::span<const ShapeSetting> settings);

// The parameters of a kind with their defaults, for documentation; empty for an unknown kind.
std::vector<FieldRow> describeShape(std::string_view kind);

}  // namespace shoal::scene
