#include "io/gltf_document.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include <shoal/io/file.h>
#include <shoal/io/model.h>

#include "io/data_uri.h"

namespace shoal::io {

namespace {

// GL enums of accessor components.
constexpr unsigned kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125,
                   kFloat = 5126;
constexpr std::uint32_t kChunkJson = 0x4E4F534A, kChunkBinary = 0x004E4942;
// A file may decode to this much more than its own size (shared accessors, compressed images), and to kBudgetFloor at
// least.
constexpr std::size_t kBudgetFactor = 512, kBudgetFloor = std::size_t(64) << 20;

std::size_t componentSize(unsigned type) {
    switch (type) {
        case kByte:
        case kUnsignedByte:
            return 1;
        case kShort:
        case kUnsignedShort:
            return 2;
        case kUnsignedInt:
        case kFloat:
            return 4;
        default:
            return 0;
    }
}

int componentCountOf(std::string_view type) {
    if (type == "SCALAR") return 1;
    if (type == "VEC2") return 2;
    if (type == "VEC3") return 3;
    if (type == "VEC4" || type == "MAT2") return 4;
    if (type == "MAT3") return 9;
    if (type == "MAT4") return 16;
    return 0;
}

bool matches(std::string_view type, std::string_view allowed) {
    for (std::size_t begin = 0; begin <= allowed.size();) {
        const std::size_t end = std::min(allowed.find('|', begin), allowed.size());
        if (allowed.substr(begin, end - begin) == type) return true;
        begin = end + 1;
    }
    return false;
}

std::uint32_t littleEndian32(const std::byte* p) {
    return std::uint32_t(p[0]) | std::uint32_t(p[1]) << 8 | std::uint32_t(p[2]) << 16 | std::uint32_t(p[3]) << 24;
}

template <class T>
T load(const std::byte* p) {
    T value;
    std::memcpy(&value, p, sizeof(T));
    return value;
}

// Elements of T to floats; `scale` divides normalised integers, which stop at -1 (glTF 2.0 §3.11).
template <class T>
void convert(const GltfAccessor& a, float scale, float* out) {
    for (std::size_t i = 0; i < a.count; ++i)
        for (int c = 0; c < a.componentCount; ++c) {
            const float value = float(load<T>(a.data + i * a.stride + std::size_t(c) * sizeof(T)));
            *out++ = a.normalized ? std::max(value * scale, -1.0f) : value;
        }
}

template <class T>
void convertWhole(const GltfAccessor& a, std::uint32_t* out) {
    for (std::size_t i = 0; i < a.count; ++i)
        for (int c = 0; c < a.componentCount; ++c)
            *out++ = std::uint32_t(load<T>(a.data + i * a.stride + std::size_t(c) * sizeof(T)));
}

std::string printable(std::string_view text) {
    std::string out;
    for (const char c : text) out += c >= 0x20 && c < 0x7F ? c : '?';
    return out;
}

}  // namespace

GltfDocument::GltfDocument(std::span<const std::byte> bytes, std::filesystem::path baseDir, std::string name,
                           LogSink log)
    : name_(std::move(name)), baseDir_(std::move(baseDir)), log_(std::move(log)), fileSize_(bytes.size()) {
    budget_ = std::min(kModelByteLimit, kBudgetFloor + fileSize_ * kBudgetFactor);
    openContainer(bytes);
    const JsonValue asset = root().require("asset");
    const std::string& version = asset.text("version");
    if (!version.starts_with("2."))
        asset.fail(fmt::format("glTF version \"{}\", expected 2.0", printable(version).substr(0, 20)));
    accessors_ = list("accessors");
    views_ = list("bufferViews");
    loadBuffers();
}

void GltfDocument::log(LogLevel level, std::string_view message) const {
    if (log_) log_(level, fmt::format("{}: {}", name_, message));
}

void GltfDocument::charge(const JsonValue& where, std::size_t bytes) {
    if (bytes > budget_ - charged_)
        where.fail(fmt::format("the file decodes to more than {} MiB, too much for its size", budget_ >> 20));
    charged_ += bytes;
}

// ---- container --------------------------------------------------------------------------------------------------

void GltfDocument::openContainer(std::span<const std::byte> bytes) {
    const auto text = [](std::span<const std::byte> part) {
        return std::string_view(reinterpret_cast<const char*>(part.data()), part.size());
    };
    if (bytes.empty()) throw GltfError{"empty file"};
    if (!text(bytes).starts_with("glTF")) {
        const std::size_t first = text(bytes).find_first_not_of("\xEF\xBB\xBF \t\r\n");
        if (first == std::string_view::npos || text(bytes)[first] != '{')
            throw GltfError{fmt::format("starts with \"{}\", expected \"glTF\" (binary) or \"{{\" (JSON)",
                                        printable(text(bytes).substr(0, 4)))};
        tree_ = std::make_unique<JsonTree>(text(bytes));
        return;
    }
    if (bytes.size() < 20) throw GltfError{fmt::format("truncated: {} bytes, too short for a .glb", bytes.size())};
    const std::uint32_t version = littleEndian32(bytes.data() + 4), length = littleEndian32(bytes.data() + 8);
    if (version != 2) throw GltfError{fmt::format("binary glTF version {}, expected 2", version)};
    if (length > bytes.size())
        throw GltfError{fmt::format("truncated: its header says {} bytes, the file has {}", length, bytes.size())};
    std::size_t at = 12;
    for (int chunk = 0; at + 8 <= length; ++chunk) {
        const std::size_t size = littleEndian32(bytes.data() + at);
        const std::uint32_t type = littleEndian32(bytes.data() + at + 4);
        if (size > length - at - 8)
            throw GltfError{fmt::format("chunk {} has {} bytes, but only {} are left", chunk, size, length - at - 8)};
        const auto part = bytes.subspan(at + 8, size);
        if (chunk == 0 && type != kChunkJson)
            throw GltfError{fmt::format("chunk 0 has type 0x{:08X}, expected JSON", type)};
        if (chunk == 0) tree_ = std::make_unique<JsonTree>(text(part));
        if (type == kChunkBinary && !binaryChunk_) binaryChunk_ = part;
        at += 8 + (size + 3) / 4 * 4;
    }
    if (!tree_) throw GltfError{"no JSON chunk"};
}

void GltfDocument::loadBuffers() {
    const JsonValue buffers = list("buffers");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const JsonValue buffer = buffers[i];
        buffer.require("byteLength");
        const std::size_t wanted = buffer.whole("byteLength", 0);
        if (wanted == 0) buffer.fail("byteLength 0, expected at least 1");
        std::span<const std::byte> bytes;
        storage_.emplace_back();
        if (buffer.find("uri")) {
            bytes = resource(buffer, storage_.back());
        } else if (i == 0 && binaryChunk_) {
            bytes = *binaryChunk_;
        } else if (list("extensionsUsed")) {
            buffer.fail("no uri: filled by an extension that is not supported");
        } else {
            buffer.fail("no uri, and the file has no binary chunk");
        }
        if (bytes.size() < wanted)
            buffer.fail(fmt::format("byteLength {}, but only {} are there", wanted, bytes.size()));
        buffers_.push_back(bytes.first(wanted));
    }
}

std::span<const std::byte> GltfDocument::resource(const JsonValue& item, std::vector<std::byte>& storage) const {
    if (item.find("bufferView")) return bufferView(std::size_t(item.index("bufferView", views_.size())));
    const std::string& uri = item.text("uri");
    if (uri.empty()) item.fail("neither \"uri\" nor \"bufferView\"");
    if (isDataUri(uri)) {
        std::string problem;
        if (!decodeDataUri(uri, storage, problem)) item.fail("uri: " + problem);
        return storage;
    }
    if (uri.find("://") != std::string::npos)
        item.fail(fmt::format("uri \"{}\", expected a file beside the model", printable(uri).substr(0, 100)));
    if (baseDir_.empty())
        item.fail(fmt::format("uri \"{}\": there is no folder to look in", printable(uri).substr(0, 100)));
    const std::string decoded = percentDecoded(uri);
    if (decoded.find('\0') != std::string::npos) item.fail("uri: a file name with a zero byte");
    Result<std::vector<std::byte>> file = readFile(baseDir_ / std::filesystem::path(decoded));
    if (!file) item.fail(file.error().message);
    storage = *std::move(file);
    return storage;
}

// ---- views and accessors ----------------------------------------------------------------------------------------

std::span<const std::byte> GltfDocument::bufferView(std::size_t index) const {
    const JsonValue view = views_[index];
    const std::span<const std::byte> buffer = buffers_[std::size_t(view.requireIndex("buffer", buffers_.size()))];
    view.require("byteLength");
    const std::size_t offset = view.whole("byteOffset", 0), length = view.whole("byteLength", 0);
    if (length == 0) view.fail("byteLength 0, expected at least 1");
    if (offset > buffer.size() || length > buffer.size() - offset)
        view.fail(fmt::format("bytes {} to {}, but its buffer has {}", offset, offset + length, buffer.size()));
    return buffer.subspan(offset, length);
}

void GltfDocument::placeInView(GltfAccessor& accessor, const JsonValue& item) const {
    const std::size_t elementSize = componentSize(accessor.componentType) * std::size_t(accessor.componentCount);
    const auto index = std::size_t(item.index("bufferView", views_.size()));
    const std::span<const std::byte> view = bufferView(index);
    const std::size_t offset = item.whole("byteOffset", 0), stride = views_[index].whole("byteStride", 0);
    accessor.stride = stride ? stride : elementSize;
    if (accessor.stride < elementSize || accessor.stride > (1u << 16))
        views_[index].fail(fmt::format("byteStride {}, expected at least the element's {} bytes", stride, elementSize));
    const bool fits = offset <= view.size() && elementSize <= view.size() - offset &&
                      accessor.count - 1 <= (view.size() - offset - elementSize) / accessor.stride;
    if (!fits)
        item.fail(fmt::format("{} elements of {} bytes from byte {}, but bufferView {} has {} bytes", accessor.count,
                              accessor.stride, offset, index, view.size()));
    accessor.data = view.data() + offset;
}

GltfAccessor GltfDocument::accessor(const JsonValue& where, std::string_view type) const {
    GltfAccessor out;
    const int index = where.asIndex(accessors_.size(), "accessor");
    out.json = accessors_[std::size_t(index)];
    const std::string& found = out.json.text("type");
    out.componentCount = componentCountOf(found);
    if (out.componentCount == 0)
        out.json.fail(fmt::format("type \"{}\", expected SCALAR, VEC2, ...", printable(found).substr(0, 20)));
    if (!matches(found, type)) where.fail(fmt::format("accessor {} is {}, expected {}", index, found, type));
    out.componentType = unsigned(std::min<std::size_t>(out.json.whole("componentType", 0), 0xFFFF));
    if (componentSize(out.componentType) == 0)
        out.json.fail(fmt::format("componentType {}, expected 5120 to 5126", out.componentType));
    out.json.require("count");
    out.count = out.json.whole("count", 0);
    if (out.count == 0 || out.count > kModelByteLimit)
        out.json.fail(fmt::format("count {}, expected 1 to {}", out.count, kModelByteLimit));
    out.normalized = out.json.boolean("normalized", false) && out.componentType != kFloat;
    out.sparse = out.json.object("sparse");
    if (out.json.find("bufferView")) placeInView(out, out.json);
    return out;
}

GltfAccessor GltfDocument::sparsePart(const GltfAccessor& accessor, std::string_view key, unsigned componentType,
                                      int componentCount) const {
    GltfAccessor part;
    part.json = accessor.sparse.require(key);
    accessor.sparse.require("count");
    part.count = accessor.sparse.whole("count", 0);
    if (part.count == 0 || part.count > accessor.count)
        accessor.sparse.fail(fmt::format("count {}, expected 1 to {}", part.count, accessor.count));
    part.componentType = componentType;
    part.componentCount = componentCount;
    part.normalized = accessor.normalized;
    part.json.require("bufferView");
    placeInView(part, part.json);
    return part;
}

void GltfDocument::applySparse(const GltfAccessor& accessor, float* out) const {
    const auto type =
        unsigned(std::min<std::size_t>(accessor.sparse.object("indices").whole("componentType", 0), 0xFFFF));
    if (type != kUnsignedByte && type != kUnsignedShort && type != kUnsignedInt)
        accessor.sparse.fail(fmt::format("indices.componentType {}, expected 5121, 5123 or 5125", type));
    GltfAccessor indices = sparsePart(accessor, "indices", type, 1);
    GltfAccessor values = sparsePart(accessor, "values", accessor.componentType, accessor.componentCount);
    std::vector<std::uint32_t> at(indices.count);
    if (type == kUnsignedByte)
        convertWhole<std::uint8_t>(indices, at.data());
    else if (type == kUnsignedShort)
        convertWhole<std::uint16_t>(indices, at.data());
    else
        convertWhole<std::uint32_t>(indices, at.data());
    const auto width = std::size_t(accessor.componentCount);
    std::vector<float> replaced(values.count * width);
    readFloats(values, replaced.data());
    for (std::size_t i = 0; i < at.size(); ++i) {
        if (at[i] >= accessor.count)
            accessor.sparse.fail(fmt::format("index {}, but the accessor has {} elements", at[i], accessor.count));
        std::copy_n(replaced.data() + i * width, width, out + at[i] * width);
    }
}

void GltfDocument::readFloats(const GltfAccessor& a, float* out) const {
    const std::size_t total = a.count * std::size_t(a.componentCount);
    if (!a.data) {
        std::fill_n(out, total, 0.0f);
    } else if (a.componentType == kFloat && a.stride == std::size_t(a.componentCount) * 4) {
        std::memcpy(out, a.data, total * 4);
    } else {
        switch (a.componentType) {
            case kByte:
                convert<std::int8_t>(a, 1 / 127.0f, out);
                break;
            case kUnsignedByte:
                convert<std::uint8_t>(a, 1 / 255.0f, out);
                break;
            case kShort:
                convert<std::int16_t>(a, 1 / 32767.0f, out);
                break;
            case kUnsignedShort:
                convert<std::uint16_t>(a, 1 / 65535.0f, out);
                break;
            case kUnsignedInt:
                convert<std::uint32_t>(a, 1 / 4294967295.0f, out);
                break;
            default:
                convert<float>(a, 1, out);
                break;
        }
    }
    if (a.sparse) applySparse(a, out);
}

std::vector<float> GltfDocument::floats(const GltfAccessor& a) {
    const std::size_t total = a.count * std::size_t(a.componentCount);
    charge(a.json, total * sizeof(float));
    std::vector<float> out(total);
    readFloats(a, out.data());
    return out;
}

std::vector<std::uint32_t> GltfDocument::wholes(const JsonValue& where, const GltfAccessor& a) {
    const bool whole =
        a.componentType == kUnsignedByte || a.componentType == kUnsignedShort || a.componentType == kUnsignedInt;
    if (!whole || a.normalized)
        where.fail(fmt::format("componentType {}{}, expected 5121, 5123 or 5125 (unsigned integers)", a.componentType,
                               a.normalized ? " normalized" : ""));
    const std::size_t total = a.count * std::size_t(a.componentCount);
    charge(a.json, total * 4);
    std::vector<std::uint32_t> out(total);
    if (a.sparse) {  // through floats: exact, as what is sparse here has less than 2^24 vertices
        std::vector<float> values(total);
        readFloats(a, values.data());
        for (std::size_t i = 0; i < total; ++i) {
            if (values[i] > 16777216.0f) where.fail(fmt::format("sparse value {}, too large", values[i]));
            out[i] = std::uint32_t(values[i]);
        }
    } else if (a.data && a.componentType == kUnsignedByte) {
        convertWhole<std::uint8_t>(a, out.data());
    } else if (a.data && a.componentType == kUnsignedShort) {
        convertWhole<std::uint16_t>(a, out.data());
    } else if (a.data) {
        convertWhole<std::uint32_t>(a, out.data());
    }
    return out;
}

}  // namespace shoal::io
