// A first look at an EXR's headers, before OpenEXR takes memory by the numbers in them: its table of chunks is as large
// as a header says, up to 16 GiB. Only sizes are checked here; everything else is OpenEXR's to find.
//
// Layout: magic, version and flags, then a header for each part: attributes (name\0 type\0 size value) up to an empty
// name. A multi-part file ends its headers with an empty one. [OpenEXR file layout, openexr.com]

#include "io/image_exr.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include <shoal/io/image.h>

namespace shoal::io {
namespace {

constexpr std::uint32_t kMultiPartFlag = 0x1000;
constexpr std::size_t kNameLimit = 255;
constexpr std::uint64_t kOffsetBytes = 8;  // of a chunk in the table
constexpr int kPartLimit = 64;
const std::string kCutShort = "the file is cut short in its header";

struct Cursor {
    std::span<const std::byte> rest;

    bool text(std::string_view& to) {
        const void* end = std::memchr(rest.data(), 0, std::min(rest.size(), kNameLimit + 1));
        if (!end) return false;
        const std::size_t size = std::size_t(static_cast<const std::byte*>(end) - rest.data());
        to = {reinterpret_cast<const char*>(rest.data()), size};
        rest = rest.subspan(size + 1);
        return true;
    }
    bool number(std::int32_t& to) {
        if (rest.size() < sizeof to) return false;
        std::memcpy(&to, rest.data(), sizeof to);
        rest = rest.subspan(sizeof to);
        return true;
    }
};

struct PartSizes {
    std::int64_t width = 1, height = 1;  // of the data window
    std::int64_t tileWidth = 0, tileHeight = 0;
};

// "" or what is wrong with a window of `value`.
std::string readWindow(Cursor value, const char* name, PartSizes& sizes) {
    std::int32_t edges[4];
    for (std::int32_t& edge : edges)
        if (!value.number(edge)) return kCutShort;
    const std::int64_t width = std::int64_t(edges[2]) - edges[0] + 1, height = std::int64_t(edges[3]) - edges[1] + 1;
    if (width < 1 || height < 1 || width > kImageSideLimit || height > kImageSideLimit)
        return fmt::format("{}: {} x {} pixels, the limit is {} x {}", name, width, height, kImageSideLimit,
                           kImageSideLimit);
    if (std::string_view(name) == "dataWindow") sizes.width = width, sizes.height = height;
    return {};
}

// "" or what is wrong with the attribute.
std::string readAttribute(std::string_view name, std::span<const std::byte> bytes, std::size_t fileSize,
                          PartSizes& sizes) {
    Cursor value{bytes};
    if (name == "dataWindow") return readWindow(value, "dataWindow", sizes);
    if (name == "displayWindow") return readWindow(value, "displayWindow", sizes);
    if (name == "tiles") {
        std::int32_t width = 0, height = 0;
        if (!value.number(width) || !value.number(height)) return kCutShort;
        if (width < 1 || height < 1 || width > kImageSideLimit || height > kImageSideLimit)
            return fmt::format("tiles of {} x {} pixels", width, height);
        sizes.tileWidth = width, sizes.tileHeight = height;
    } else if (name == "chunkCount") {
        std::int32_t count = 0;
        if (!value.number(count)) return kCutShort;
        if (count < 0 || std::uint64_t(count) * kOffsetBytes > fileSize)
            return fmt::format("{} chunks in {} bytes", count, fileSize);
    }
    return {};
}

// One header; `empty` where it has no attribute.
std::string readHeader(Cursor& cursor, std::size_t fileSize, bool& empty) {
    PartSizes sizes;
    empty = true;
    for (;;) {
        std::string_view name, type;
        std::int32_t size = 0;
        if (!cursor.text(name)) return kCutShort;
        if (name.empty()) break;
        empty = false;
        if (!cursor.text(type) || !cursor.number(size)) return kCutShort;
        if (size < 0 || std::size_t(size) > cursor.rest.size()) return kCutShort;
        std::string wrong = readAttribute(name, cursor.rest.first(std::size_t(size)), fileSize, sizes);
        if (!wrong.empty()) return wrong;
        cursor.rest = cursor.rest.subspan(std::size_t(size));
    }
    if (sizes.tileWidth > 0) {
        const std::uint64_t across = std::uint64_t((sizes.width + sizes.tileWidth - 1) / sizes.tileWidth);
        const std::uint64_t down = std::uint64_t((sizes.height + sizes.tileHeight - 1) / sizes.tileHeight);
        if (across * down * kOffsetBytes > fileSize)
            return fmt::format("{} x {} tiles in {} bytes", across, down, fileSize);
    }
    return {};
}

}  // namespace

std::string checkExrHeaders(std::span<const std::byte> bytes) {
    Cursor cursor{bytes};
    std::int32_t magic = 0, flags = 0;
    if (!cursor.number(magic) || !cursor.number(flags)) return kCutShort;
    const bool multiPart = std::uint32_t(flags) & kMultiPartFlag;
    for (int part = 0;; ++part) {
        bool empty = false;
        std::string wrong = readHeader(cursor, bytes.size(), empty);
        if (!wrong.empty()) return wrong;
        if (!multiPart || empty) return {};
        if (part == kPartLimit) return fmt::format("more than {} parts", kPartLimit);
    }
}

}  // namespace shoal::io
