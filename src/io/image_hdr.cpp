// Radiance HDR (RGBE): scan lines as stored, in the old run lengths or the new ones by component.
// Follows G. Ward, "Real Pixels", Graphics Gems II, and the file format of Radiance's color.c. Mantissas are taken as
// m / 256, as nearly every reader does; Radiance itself adds half a step.

#include "io/image_codecs.h"

#include <algorithm>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include <fmt/format.h>

namespace shoal::io {
namespace {

// In the new encoding a run of up to 127 equal bytes takes two: no more than this many pixels a byte. The old one
// chains runs and has no such bound, but every real line of it is close to flat pixels.
constexpr std::uint64_t kPixelsPerByteLimit = 4096;
constexpr int kNewRleLeast = 8, kNewRleMost = 32767;  // widths the new run lengths are used for

struct HdrHeader {
    int width = 0, height = 0;
    bool bottomUp = false, rightToLeft = false;
    float exposure = 1;  // product of all EXPOSURE lines; stored = radiance * exposure
    std::size_t pixelsAt = 0;
};

Error badHdr(const std::string& name, const std::string& why) {
    return badInput(fmt::format("{}: not an HDR that can be read: {}", name, why));
}

// The next line without its end; nothing at the end of the file.
std::optional<std::string_view> nextLine(Bytes bytes, std::size_t& at) {
    const std::string_view rest(reinterpret_cast<const char*>(bytes.data()) + at, bytes.size() - at);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    at += end + 1;
    return rest.substr(0, end > 0 && rest[end - 1] == '\r' ? end - 1 : end);
}

// "-Y 512 +X 1024": lines from the top, pixels from the left.
bool parseResolution(std::string_view line, HdrHeader& header) {
    const auto number = [&line](int& to) {
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), to);
        if (error != std::errc()) return false;
        line.remove_prefix(std::size_t(end - line.data()));
        return true;
    };
    if (!line.starts_with("-Y ") && !line.starts_with("+Y ")) return false;
    header.bottomUp = line[0] == '+';
    line.remove_prefix(3);
    if (!number(header.height)) return false;
    if (!line.starts_with(" +X ") && !line.starts_with(" -X ")) return false;
    header.rightToLeft = line[1] == '-';
    line.remove_prefix(4);
    return number(header.width) && line.empty();
}

Result<HdrHeader> parseHeader(Bytes bytes, const std::string& name) {
    HdrHeader header;
    std::size_t at = 0;
    for (int lineNumber = 1;; ++lineNumber) {
        const std::optional<std::string_view> line = nextLine(bytes, at);
        if (!line) return badHdr(name, "the header has no end");
        if (line->empty()) break;
        if (line->starts_with("FORMAT=") && *line != "FORMAT=32-bit_rle_rgbe")
            return badHdr(name,
                          fmt::format("line {}: found \"{}\", expected FORMAT=32-bit_rle_rgbe", lineNumber, *line));
        if (line->starts_with("EXPOSURE=")) {
            std::string_view words = line->substr(9);
            while (words.starts_with(' ')) words.remove_prefix(1);
            float exposure = 0;
            const auto parsed = std::from_chars(words.data(), words.data() + words.size(), exposure);
            if (parsed.ec != std::errc() || !(exposure > 0) || !std::isfinite(exposure))
                return badHdr(name,
                              fmt::format("line {}: found \"{}\", expected a positive number", lineNumber, *line));
            header.exposure *= exposure;
        }
    }
    const std::optional<std::string_view> resolution = nextLine(bytes, at);
    if (!resolution || !parseResolution(*resolution, header))
        return badHdr(name, "expected a resolution such as \"-Y 512 +X 1024\" behind the header");
    SHOAL_TRY(checkImageSize(header.width, header.height, name));
    if (!(header.exposure > 1e-20f && header.exposure < 1e20f))
        return badHdr(name, fmt::format("EXPOSURE multiplies to {}", header.exposure));
    header.pixelsAt = at;
    if (std::uint64_t(header.width) * std::uint64_t(header.height) > (bytes.size() - at) * kPixelsPerByteLimit)
        return badHdr(name, "the file is cut short");
    return header;
}

// One scan line of RGBE quadruples from bytes[at ...]; false where the data end or a run leaves the line.
bool readNewLine(Bytes bytes, std::size_t& at, int width, std::uint8_t* line) {
    for (int component = 0; component < 4; ++component) {
        for (int x = 0; x < width;) {
            if (at >= bytes.size()) return false;
            int count = std::to_integer<int>(bytes[at++]);
            const bool run = count > 128;
            if (run) count -= 128;
            if (count == 0 || count > width - x) return false;
            const std::size_t needed = run ? 1 : std::size_t(count);
            if (needed > bytes.size() - at) return false;
            for (int i = 0; i < count; ++i)
                line[(x + i) * 4 + component] = std::to_integer<std::uint8_t>(bytes[at + (run ? 0 : std::size_t(i))]);
            at += needed;
            x += count;
        }
    }
    return true;
}

bool readOldLine(Bytes bytes, std::size_t& at, int width, std::uint8_t* line) {
    int shift = 0;
    for (int x = 0; x < width;) {
        if (bytes.size() - at < 4) return false;
        std::uint8_t pixel[4];
        std::memcpy(pixel, bytes.data() + at, 4);
        at += 4;
        if (pixel[0] == 1 && pixel[1] == 1 && pixel[2] == 1) {  // repeats the pixel before; runs in a row chain
            if (x == 0 || shift > 16) return false;
            const int count = int(pixel[3]) << shift;
            if (count > width - x) return false;
            for (int i = 0; i < count; ++i, ++x) std::memcpy(line + x * 4, line + (x - 1) * 4, 4);
            shift += 8;
        } else {
            std::memcpy(line + x++ * 4, pixel, 4);
            shift = 0;
        }
    }
    return true;
}

bool readLine(Bytes bytes, std::size_t& at, int width, std::uint8_t* line) {
    if (width >= kNewRleLeast && width <= kNewRleMost && bytes.size() - at >= 4) {
        const auto byte = [&](std::size_t i) { return std::to_integer<int>(bytes[at + i]); };
        if (byte(0) == 2 && byte(1) == 2 && byte(2) < 128) {
            if (byte(2) * 256 + byte(3) != width) return false;
            at += 4;
            return readNewLine(bytes, at, width, line);
        }
    }
    return readOldLine(bytes, at, width, line);
}

}  // namespace

Result<ImageInfo> hdrInfo(Bytes bytes, const std::string& name) {
    SHOAL_TRY_ASSIGN(const HdrHeader header, parseHeader(bytes, name));
    return ImageInfo{ImageFormat::hdr, header.width, header.height, 3, "RGBE"};
}

Result<Image> decodeHdr(Bytes bytes, const std::string& name) {
    SHOAL_TRY_ASSIGN(const HdrHeader header, parseHeader(bytes, name));
    Image image(header.width, header.height, 3);
    image.channelNames = {"R", "G", "B"};
    float scale[256];  // by the shared exponent; 0 is black
    scale[0] = 0;
    constexpr float kScaleLimit = FLT_MAX / 256;  // keeps every product finite
    for (int e = 1; e < 256; ++e) scale[e] = std::min(std::ldexp(1.0f, e - 128 - 8) / header.exposure, kScaleLimit);

    std::vector<std::uint8_t> line(std::size_t(header.width) * 4);
    std::size_t at = header.pixelsAt;
    for (int y = 0; y < header.height; ++y) {
        if (!readLine(bytes, at, header.width, line.data()))
            return badHdr(name, fmt::format("scan line {} of {} is damaged or cut short", y + 1, header.height));
        float* to = image.at(0, header.bottomUp ? header.height - 1 - y : y);
        for (int x = 0; x < header.width; ++x) {
            const std::uint8_t* rgbe = line.data() + x * 4;
            float* pixel = to + (header.rightToLeft ? header.width - 1 - x : x) * 3;
            for (int c = 0; c < 3; ++c) pixel[c] = float(rgbe[c]) * scale[rgbe[3]];
        }
    }
    return image;
}

}  // namespace shoal::io
