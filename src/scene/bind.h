// From trees to structs: every key of a table goes to a described field or to one of the names its caller takes care
// of.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/tree.h"

namespace shoal::scene {

// "street.toml:12: camera.fovDeg: " or "--set: camera.fovDeg: " in front of `message`; overrides are usage errors.
Error errorAt(const Place& place, const std::string& path, const std::string& message);

Result<void> requireTable(const Tree& tree, const std::string& path);
Result<void> requireArray(const Tree& tree, const std::string& path);
Result<std::string> textOf(const Tree& tree, const std::string& path);
Result<Vec3> vec3Of(const Tree& tree, const std::string& path);

// Sets the fields of `params` from a table's members; names in `elsewhere` are left to the caller. `known` collects
// every name there is, for the error of an unknown one: bind several structs from one table with bindFields, then close
// with refuseUnknown.
template <class Params>
Result<void> bindFields(const Tree& table, const std::string& path, Params& params, std::vector<std::string>& known) {
    std::vector<std::string> own;
    visit(params, [&](auto&, const Field& field) { own.push_back(field.name); });
    for (const std::string& name : own) {
        const Tree* member = table.find(name);
        if (!member) continue;
        const std::string full = path + "." + name;
        if (member->kind != Tree::Kind::value)
            return errorAt(member->place, full, std::string("found ") + describeKind(*member) + ", expected a value");
        if (auto set = setField(params, name, member->value); !set)
            return errorAt(member->place, path, set.error().message);
    }
    known.insert(known.end(), own.begin(), own.end());
    return {};
}

// An error for the first member that is none of `known`.
Result<void> refuseUnknown(const Tree& table, const std::string& path, const std::vector<std::string>& known);

// bindFields and refuseUnknown for a table of one struct.
template <class Params>
Result<void> bindAll(const Tree& table, const std::string& path, Params& params,
                     std::vector<std::string> elsewhere = {}) {
    SHOAL_TRY(requireTable(table, path));
    SHOAL_TRY(bindFields(table, path, params, elsewhere));
    return refuseUnknown(table, path, elsewhere);
}

}  // namespace shoal::scene
