// A parsed scene file as plain data: values, tables and arrays with the lines they stand on. Only tree.cpp sees the
// TOML library.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <shoal/scene/scene.h>

namespace shoal::scene {

struct TreeMember;

struct Tree {
    enum class Kind { value, table, array } kind = Kind::table;
    FieldValue value;                 // Kind::value; arrays of numbers are values too
    std::vector<TreeMember> members;  // Kind::table, in file order
    std::vector<Tree> elements;       // Kind::array
    Place place;

    Tree* find(std::string_view key);
    const Tree* find(std::string_view key) const;
    std::vector<std::string> keys() const;
};

struct TreeMember {
    std::string name;
    Tree tree;
};

// Files longer than this are not scenes.
inline constexpr std::size_t kSceneTextLimit = std::size_t(16) << 20;

Result<Tree> parseTree(std::string_view text, const std::filesystem::path& file);

// Sets "a.b[2].c" to the override's value, making tables on the way.
Result<void> applyOverride(Tree& root, const Override& change);
// All in order. An eye that is put somewhere is a camera of its own: camera.position takes out every other kind that is
// not set as well, sun.toSun the sun's angles.
Result<void> applyOverrides(Tree& root, std::span<const Override> changes);

// "a table", "a number", "a text", ... for error messages.
const char* describeKind(const Tree& tree);

}  // namespace shoal::scene
