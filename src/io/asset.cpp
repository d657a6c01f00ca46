#include <shoal/io/asset.h>

#include <bit>
#include <cstring>

#include <fmt/format.h>

#include <shoal/core/hash.h>
#include <shoal/io/file.h>

namespace shoal::io {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as they lie in memory");

constexpr std::string_view kMagic = "SHOALAST";
constexpr std::uint32_t tag(const char (&text)[5]) {
    return std::uint32_t(text[0]) | std::uint32_t(text[1]) << 8 | std::uint32_t(text[2]) << 16 |
           std::uint32_t(text[3]) << 24;
}
constexpr std::uint32_t kHeadTag = tag("HEAD"), kParameterTag = tag("PARM"), kArrayTag = tag("ARRY");
constexpr std::uint32_t kDimensionLimit = 8;

class Writer {
public:
    template <class T>
    void number(T value) {
        append(&value, sizeof value);
    }
    void text(std::string_view value) {
        number(std::uint32_t(value.size()));
        append(value.data(), value.size());
    }
    void append(const void* data, std::size_t size) {
        const auto* from = static_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), from, from + size);
    }
    void beginChunk(std::uint32_t chunkTag) {
        number(chunkTag);
        number(std::uint64_t(0));
        start_ = bytes.size();
    }
    void endChunk() {
        const std::uint64_t size = bytes.size() - start_;
        std::memcpy(bytes.data() + start_ - sizeof size, &size, sizeof size);
        number(fnv1a(std::span(bytes).subspan(start_)));
    }
    std::vector<std::byte> bytes;

private:
    std::size_t start_ = 0;
};

// Takes values from the front of the bytes; false, and nothing taken, where they do not suffice.
class Reader {
public:
    explicit Reader(std::span<const std::byte> rest) : rest_(rest) {}
    template <class T>
    bool number(T& value) {
        std::span<const std::byte> bytes;
        if (!take(sizeof value, bytes)) return false;
        std::memcpy(&value, bytes.data(), sizeof value);
        return true;
    }
    bool text(std::string& value) {
        std::uint32_t size = 0;
        std::span<const std::byte> bytes;
        if (!number(size) || !take(size, bytes)) return false;
        value.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
        return true;
    }
    bool take(std::uint64_t size, std::span<const std::byte>& bytes) {
        if (size > rest_.size()) return false;
        bytes = rest_.first(std::size_t(size));
        rest_ = rest_.subspan(std::size_t(size));
        return true;
    }
    std::size_t left() const { return rest_.size(); }

private:
    std::span<const std::byte> rest_;
};

std::vector<std::byte> encode(const Asset& asset) {
    Writer out;
    std::size_t size = 4096;
    for (const auto& [name, array] : asset.arrays) size += array.bytes.size() + 256;
    out.bytes.reserve(size);
    out.append(kMagic.data(), kMagic.size());
    out.number(kAssetFileVersion);
    out.number(std::uint32_t(1 + asset.parameters.size() + asset.arrays.size()));
    out.number(asset.contentHash());
    out.beginChunk(kHeadTag);
    out.text(asset.kind);
    out.number(asset.formatVersion);
    out.endChunk();
    for (const auto& [key, value] : asset.parameters) {
        out.beginChunk(kParameterTag);
        out.text(key);
        out.text(value);
        out.endChunk();
    }
    for (const auto& [name, array] : asset.arrays) {
        out.beginChunk(kArrayTag);
        out.text(name);
        out.text(array.type);
        out.number(std::uint32_t(array.shape.size()));
        for (const std::size_t extent : array.shape) out.number(std::uint64_t(extent));
        out.number(std::uint64_t(array.bytes.size()));
        out.append(array.bytes.data(), array.bytes.size());
        out.endChunk();
    }
    return std::move(out.bytes);
}

// Empty, or what is wrong with the array.
std::string checkShape(const std::string& name, const Asset::Array& array) {
    if (array.shape.size() > kDimensionLimit)
        return fmt::format("array \"{}\" has {} dimensions, the limit is {}", name, array.shape.size(),
                           kDimensionLimit);
    const std::size_t elementSize = assetElementSize(array.type);
    if (elementSize == 0) return {};
    std::uint64_t expected = elementSize;
    for (const std::size_t extent : array.shape)
        if (__builtin_mul_overflow(expected, std::uint64_t(extent), &expected))
            return fmt::format("array \"{}\" has a shape beyond any size", name);
    if (expected != array.bytes.size())
        return fmt::format("array \"{}\" has {} bytes, expected {} by its shape", name, array.bytes.size(), expected);
    return {};
}

// Empty, or what is wrong with the chunk.
std::string readArray(Reader& chunk, Asset& asset) {
    std::string name;
    Asset::Array array;
    std::uint32_t dimensions = 0;
    std::uint64_t size = 0;
    if (!chunk.text(name) || !chunk.text(array.type) || !chunk.number(dimensions)) return "an array is cut short";
    if (dimensions > kDimensionLimit) return fmt::format("array \"{}\" has {} dimensions", name, dimensions);
    for (std::uint32_t i = 0; i < dimensions; ++i) {
        std::uint64_t extent = 0;
        if (!chunk.number(extent)) return "an array is cut short";
        array.shape.push_back(std::size_t(extent));
    }
    std::span<const std::byte> bytes;
    if (!chunk.number(size) || !chunk.take(size, bytes)) return fmt::format("array \"{}\" is cut short", name);
    array.bytes.assign(bytes.begin(), bytes.end());
    if (std::string wrong = checkShape(name, array); !wrong.empty()) return wrong;
    if (!asset.arrays.emplace(name, std::move(array)).second) return fmt::format("two arrays are called \"{}\"", name);
    return {};
}

std::string readChunk(std::uint32_t chunkTag, std::span<const std::byte> payload, Asset& asset) {
    Reader chunk(payload);
    std::string wrong;
    if (chunkTag == kHeadTag) {
        if (!chunk.text(asset.kind) || !chunk.number(asset.formatVersion)) wrong = "the head is cut short";
    } else if (chunkTag == kParameterTag) {
        std::string key, value;
        if (!chunk.text(key) || !chunk.text(value)) return "a parameter is cut short";
        if (!asset.parameters.emplace(key, value).second) return fmt::format("two parameters are called \"{}\"", key);
    } else if (chunkTag == kArrayTag) {
        wrong = readArray(chunk, asset);
    } else {
        wrong = fmt::format("a chunk of the unknown kind {:08x}", chunkTag);
    }
    if (wrong.empty() && chunk.left() != 0) wrong = "a chunk is longer than what is in it";
    return wrong;
}

}  // namespace

std::size_t assetElementSize(std::string_view type) {
    if (type == "u8" || type == "i8") return 1;
    if (type == "u16" || type == "i16" || type == "f16") return 2;
    if (type == "u32" || type == "i32" || type == "f32") return 4;
    if (type == "u64" || type == "i64" || type == "f64") return 8;
    return 0;
}

Result<void> writeAsset(const std::filesystem::path& path, const Asset& asset) {
    for (const auto& [name, array] : asset.arrays) {
        const std::string wrong = checkShape(name, array);
        SHOAL_ASSERT_MSG(wrong.empty(), wrong);
    }
    return writeFileAtomically(path, encode(asset));
}

Result<Asset> readAsset(std::span<const std::byte> bytes, const std::string& name) {
    const auto damaged = [&](const std::string& why) { return badInput(fmt::format("{}: {}", name, why)); };
    Reader file(bytes);
    std::span<const std::byte> magic;
    std::uint32_t version = 0, chunkCount = 0;
    std::uint64_t contentHash = 0;
    if (!file.take(kMagic.size(), magic) || std::memcmp(magic.data(), kMagic.data(), kMagic.size()) != 0)
        return damaged("not an asset file");
    if (!file.number(version) || !file.number(chunkCount) || !file.number(contentHash))
        return damaged("the file is cut short");
    if (version != kAssetFileVersion)
        return damaged(fmt::format("version {} of the asset file, expected {}", version, kAssetFileVersion));
    Asset asset;
    for (std::uint32_t i = 0; i < chunkCount; ++i) {
        std::uint32_t chunkTag = 0;
        std::uint64_t size = 0, hash = 0;
        std::span<const std::byte> payload;
        if (!file.number(chunkTag) || !file.number(size) || !file.take(size, payload) || !file.number(hash))
            return damaged(fmt::format("the file is cut short in chunk {} of {}", i + 1, chunkCount));
        if (fnv1a(payload) != hash) return damaged(fmt::format("chunk {} of {} is damaged", i + 1, chunkCount));
        const std::string wrong = readChunk(chunkTag, payload, asset);
        if (!wrong.empty()) return damaged(fmt::format("chunk {} of {}: {}", i + 1, chunkCount, wrong));
    }
    if (file.left() != 0) return damaged(fmt::format("{} bytes follow the last chunk", file.left()));
    if (asset.contentHash() != contentHash) return damaged("the content does not match its hash: the file is damaged");
    return asset;
}

Result<Asset> readAsset(const std::filesystem::path& path) {
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, readFile(path));
    return readAsset(bytes, path.string());
}

}  // namespace shoal::io
