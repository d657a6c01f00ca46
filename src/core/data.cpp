#include <shoal/core/data.h>
#include <shoal/core/hash.h>
#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace shoal {

namespace {

std::uint64_t hashNumber(std::uint64_t value, std::uint64_t hash) {
    std::array<std::byte, 8> bytes;  // little-endian on every machine
    for (std::size_t i = 0; i < 8; ++i) bytes[i] = std::byte(value >> (8 * i) & 0xff);
    return fnv1a(bytes, hash);
}

// Lengths go in too, so that ("ab", "c") and ("a", "bc") differ.
std::uint64_t hashText(std::string_view text, std::uint64_t hash) {
    return fnv1a(std::as_bytes(std::span(text)), hashNumber(text.size(), hash));
}

}  // namespace

const Particles::Attribute* Particles::find(const std::string& name) const {
    const auto found =
        std::find_if(attributes.begin(), attributes.end(), [&](const Attribute& a) { return a.name == name; });
    return found == attributes.end() ? nullptr : &*found;
}

std::uint64_t Asset::contentHash() const {
    std::uint64_t hash = hashNumber(formatVersion, hashText(kind, kFnvStart));
    hash = hashNumber(parameters.size(), hash);
    for (const auto& [name, value] : parameters) hash = hashText(value, hashText(name, hash));
    hash = hashNumber(arrays.size(), hash);
    for (const auto& [name, array] : arrays) {
        hash = hashText(array.type, hashText(name, hash));
        hash = hashNumber(array.shape.size(), hash);
        for (const std::size_t size : array.shape) hash = hashNumber(size, hash);
        hash = fnv1a(array.bytes, hashNumber(array.bytes.size(), hash));
    }
    return hash;
}

}  // namespace shoal
