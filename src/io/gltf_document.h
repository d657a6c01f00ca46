// The container half of glTF: .glb chunks, buffers (embedded, external), buffer views and accessors, all checked
// against each other before a byte is read. Source: glTF 2.0 §3.6 and §4.4.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <shoal/core/log.h>

#include "io/gltf_json.h"

namespace shoal::io {

// One accessor, checked: element i lies at data + i * stride inside its buffer view.
struct GltfAccessor {
    JsonValue json;
    const std::byte* data = nullptr;  // null: all zeros (before the sparse values)
    std::size_t stride = 0, count = 0;
    unsigned componentType = 0;  // GL enum
    int componentCount = 0;      // 1 for SCALAR, 3 for VEC3, 16 for MAT4
    bool normalized = false;
    JsonValue sparse;  // nothing when not sparse
};

class GltfDocument {
public:
    // Parses the container and loads the buffers; throws GltfError. `bytes` must outlive the document.
    GltfDocument(std::span<const std::byte> bytes, std::filesystem::path baseDir, std::string name, LogSink log);

    JsonValue root() const { return tree_->root(); }
    const std::string& name() const { return name_; }

    // Elements of the top-level array `key` ("accessors", "nodes", ...).
    JsonValue list(std::string_view key) const { return root().array(key); }

    void log(LogLevel level, std::string_view message) const;
    // Adds to what has been decoded so far; throws when a small file asks for absurdly much.
    void charge(const JsonValue& where, std::size_t bytes);

    std::span<const std::byte> bufferView(std::size_t index) const;
    // The bytes of {"uri"} or {"bufferView"}. `storage` keeps what had to be decoded or loaded.
    std::span<const std::byte> resource(const JsonValue& item, std::vector<std::byte>& storage) const;

    // The accessor that `where` (a number) refers to, with components as `type` says ("VEC3", "VEC3|VEC4").
    GltfAccessor accessor(const JsonValue& where, std::string_view type) const;
    // All elements as floats (normalised integers to -1..1 or 0..1), componentCount a time. Charges the memory.
    std::vector<float> floats(const GltfAccessor& accessor);
    // All elements as V, which is componentCount floats.
    template <class V>
    std::vector<V> vectors(const GltfAccessor& accessor);
    // All elements of an integer accessor; `where` is named when it is not one.
    std::vector<std::uint32_t> wholes(const JsonValue& where, const GltfAccessor& accessor);

private:
    void openContainer(std::span<const std::byte> bytes);
    void loadBuffers();
    void readFloats(const GltfAccessor& accessor, float* out) const;
    void applySparse(const GltfAccessor& accessor, float* out) const;
    GltfAccessor sparsePart(const GltfAccessor& accessor, std::string_view key, unsigned componentType,
                            int componentCount) const;
    void placeInView(GltfAccessor& accessor, const JsonValue& item) const;

    std::string name_;
    std::filesystem::path baseDir_;
    LogSink log_;
    std::size_t fileSize_ = 0, budget_ = 0, charged_ = 0;
    std::unique_ptr<JsonTree> tree_;
    std::optional<std::span<const std::byte>> binaryChunk_;
    std::vector<std::vector<std::byte>> storage_;
    std::vector<std::span<const std::byte>> buffers_;
    JsonValue accessors_, views_;
};

template <class V>
std::vector<V> GltfDocument::vectors(const GltfAccessor& accessor) {
    charge(accessor.json, accessor.count * sizeof(V));
    std::vector<V> out(accessor.count);
    readFloats(accessor, reinterpret_cast<float*>(out.data()));
    return out;
}

}  // namespace shoal::io
