// Element counts in PLY and OFF headers and the triangle count of a binary STL against the file's size.
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <fmt/format.h>

#include "io/assimp_parts.h"

namespace shoal::io {

namespace {

// "OFF", then the counts of vertices, faces and edges; '#' starts a comment.
std::string offFault(std::string_view content) {
    std::size_t at = content.find_first_of(" \t\r\n");
    for (const char* what : {"vertices", "faces"}) {
        while (at < content.size() && (content[at] <= ' ' || content[at] == '#'))
            at = content[at] == '#' ? content.find('\n', at) : at + 1;
        if (at >= content.size()) return "OFF header without counts";
        std::uint64_t count = 0;
        const auto parsed = std::from_chars(content.data() + at, content.data() + content.size(), count);
        if (parsed.ec != std::errc() || count > content.size())
            return fmt::format("OFF count of {} is no number below the file's {} bytes", what, content.size());
        at = std::size_t(parsed.ptr - content.data());
    }
    return {};
}

}  // namespace

std::string headerFault(const std::string& extension, std::span<const std::byte> bytes) {
    const std::string_view content(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (extension == ".ply") {
        if (!content.starts_with("ply")) return "not a PLY file: expected \"ply\" at its start";
        const std::size_t end = content.find("end_header");
        if (end == std::string_view::npos) return "PLY header without end_header";
        for (std::size_t at = content.find("\nelement "); at < end; at = content.find("\nelement ", at + 1)) {
            const std::size_t number = content.find(' ', at + 9);
            double count = -1;
            if (number < end) {
                std::size_t stop = number + 1;
                while (stop < end && content[stop] >= '0' && content[stop] <= '9') ++stop;
                std::uint64_t value = 0;
                const auto parsed = std::from_chars(content.data() + number + 1, content.data() + stop, value);
                if (parsed.ec == std::errc() && stop > number + 1) count = double(value);
            }
            if (count < 0 || count > double(bytes.size() - end))
                return fmt::format("PLY element count {:.0f}, but only {} bytes follow the header", count,
                                   bytes.size() - end);
        }
    }
    if (extension == ".off") return offFault(content);
    if (extension == ".stl" && !content.starts_with("solid")) {
        std::uint32_t count = 0;
        if (bytes.size() < 84) return fmt::format("truncated: {} bytes, too short for a binary STL", bytes.size());
        std::memcpy(&count, bytes.data() + 80, 4);
        if (std::uint64_t(count) * 50 + 84 > bytes.size())
            return fmt::format("truncated: {} triangles need {} bytes, the file has {}", count,
                               std::uint64_t(count) * 50 + 84, bytes.size());
    }
    return {};
}

}  // namespace shoal::io
