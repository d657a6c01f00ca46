#include "scene/bind.h"

#include <algorithm>
#include <cmath>

namespace shoal::scene {

std::string Place::describe() const { return line > 0 ? file + ":" + std::to_string(line) : "--set"; }

Error errorAt(const Place& place, const std::string& path, const std::string& message) {
    // setField's messages begin with the field's name: "fovDeg: found ..."; a path in front makes it "camera.fovDeg:
    // found ...".
    const bool unknown = message.rfind("unknown ", 0) == 0;
    const bool field = !unknown && message.rfind("found ", 0) != 0 && message.rfind("expected ", 0) != 0;
    const std::string prefix = path.empty() ? "" : path + (field ? "." : ": ");
    return {place.line > 0 ? ErrorKind::badInput : ErrorKind::usage, place.describe() + ": " + prefix + message};
}

Result<void> requireTable(const Tree& tree, const std::string& path) {
    if (tree.kind == Tree::Kind::table) return {};
    return errorAt(tree.place, path, std::string("found ") + describeKind(tree) + ", expected a table");
}

Result<void> requireArray(const Tree& tree, const std::string& path) {
    // An empty array counts: it has no kind of its own.
    if (tree.kind == Tree::Kind::array) return {};
    return errorAt(tree.place, path, std::string("found ") + describeKind(tree) + ", expected an array of tables");
}

Result<std::string> textOf(const Tree& tree, const std::string& path) {
    if (tree.kind == Tree::Kind::value && tree.value.kind == FieldValue::Kind::text) return tree.value.text;
    return errorAt(tree.place, path, std::string("found ") + describeKind(tree) + ", expected a text");
}

Result<Vec3> vec3Of(const Tree& tree, const std::string& path) {
    if (tree.kind == Tree::Kind::value && tree.value.kind == FieldValue::Kind::numbers &&
        tree.value.numbers.size() == 3 &&
        std::all_of(tree.value.numbers.begin(), tree.value.numbers.end(), [](double x) { return std::abs(x) <= 1e6; }))
        return Vec3{float(tree.value.numbers[0]), float(tree.value.numbers[1]), float(tree.value.numbers[2])};
    return errorAt(tree.place, path,
                   std::string("found ") + describeKind(tree) + ", expected three numbers within 1e6");
}

Result<void> refuseUnknown(const Tree& table, const std::string& path, const std::vector<std::string>& known) {
    for (const auto& [name, member] : table.members)
        if (std::find(known.begin(), known.end(), name) == known.end())
            return errorAt(member.place, path, unknownWord("key", name, known));
    return {};
}

}  // namespace shoal::scene
