// JSON as a flat tree that knows the path of every value, for error messages such as
// "accessors[3]: bufferView 7, but there are only 5". Lexing is nlohmann::json's SAX parser, seen by gltf_json.cpp
// alone; nothing here recurses, so nesting cannot overflow the stack.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::io {

// Thrown inside the glTF reader, never past readGltf, which puts the file's name before the message.
struct GltfError {
    std::string message;
};

class JsonValue;

class JsonTree {
public:
    enum class Kind : std::uint8_t { null, boolean, number, string, array, object };

    // Throws GltfError with line and column.
    explicit JsonTree(std::string_view text);
    JsonValue root() const;

private:
    friend class JsonValue;
    friend class JsonBuilder;
    struct Item {
        Kind kind = Kind::null;
        std::uint32_t parent = 0;
        std::uint32_t place = 0;             // object member: index into keys_; array element: index in the array
        std::uint32_t first = 0, count = 0;  // array, object: range in children_; string: index into strings_
        double number = 0;                   // also 0 or 1 for boolean
    };
    std::vector<Item> items_;  // item 0 is the root
    std::vector<std::uint32_t> children_;
    std::deque<std::string> keys_;  // each key once
    std::vector<std::string> strings_;
};

// A value of a tree, or nothing (a member that is not there). Cheap to copy; valid as long as the tree.
// The reading functions throw GltfError when a value has another type or range than asked for.
class JsonValue {
public:
    JsonValue() = default;
    explicit operator bool() const { return tree_ != nullptr; }

    // Throws "path: message".
    [[noreturn]] void fail(std::string_view message) const;
    std::string path() const;

    // A member of this object; nothing where it is missing or this is nothing.
    JsonValue find(std::string_view key) const;
    JsonValue object(std::string_view key) const;   // the same; must be an object
    JsonValue array(std::string_view key) const;    // the same; must be an array
    JsonValue require(std::string_view key) const;  // must be there
    std::size_t size() const;                       // elements or members; 0 for nothing
    JsonValue operator[](std::size_t i) const;      // element i, or the value of member i
    std::string_view key(std::size_t i) const;      // name of member i

    // Members by name, `fallback` where missing.
    bool boolean(std::string_view key, bool fallback) const;
    float real(std::string_view key, float fallback) const;               // finite as a float
    std::size_t whole(std::string_view key, std::size_t fallback) const;  // 0 .. 2^53
    // 0 .. count - 1, or -1 where missing.
    int index(std::string_view key, std::size_t count) const;
    int requireIndex(std::string_view key, std::size_t count) const;
    const std::string& text(std::string_view key) const;  // "" where missing
    template <std::size_t N>
    std::array<float, N> reals(std::string_view key, const std::array<float, N>& fallback) const {
        std::array<float, N> out = fallback;
        readReals(key, out.data(), N);
        return out;
    }

    // This value itself.
    float asReal() const;
    int asIndex(std::size_t count, std::string_view ofWhat) const;
    const std::string& asText() const;

private:
    friend class JsonTree;
    JsonValue(const JsonTree* tree, std::uint32_t item) : tree_(tree), item_(item) {}
    const JsonTree::Item& item() const { return tree_->items_[item_]; }
    void readReals(std::string_view key, float* out, std::size_t count) const;
    std::size_t asWhole() const;
    const JsonTree* tree_ = nullptr;
    std::uint32_t item_ = 0;
};

}  // namespace shoal::io
