#include <shoal/io/image.h>

#include <algorithm>
#include <cctype>
#include <string>

#include <fmt/format.h>

namespace shoal::io {
namespace {

constexpr int kWidthLimit = 12;   // digits of a frame number
constexpr int kDefaultWidth = 4;  // out/f_0007.exr

// A pattern taken apart: text with one number in it.
struct Pattern {
    std::string before, after;
    int width = -1;  // digits, zero-padded; 0 for %d, -1 where there is no placeholder
};

Error badPattern(const std::string& whole, const std::string& why) {
    return badInput(fmt::format("{}: {}, expected one run of # or one %d or %04d", whole, why));
}

// Reads the conversion that starts behind the '%' at name[i - 1]; leaves i behind it.
Result<int> parseConversion(const std::string& name, std::size_t& i, const std::string& whole) {
    const std::size_t start = i;
    int width = 0;
    const bool padded = i < name.size() && name[i] == '0';
    while (i < name.size() && std::isdigit(static_cast<unsigned char>(name[i]))) {
        width = width * 10 + (name[i++] - '0');
        if (width > kWidthLimit)
            return badPattern(whole, fmt::format("a frame number of more than {} digits", kWidthLimit));
    }
    if (i >= name.size() || name[i] != 'd' || (width > 0 && !padded))
        return badPattern(
            whole, fmt::format("found \"%{}\"", name.substr(start, i < name.size() ? i - start + 1 : i - start)));
    ++i;
    return width;
}

Result<Pattern> parsePattern(const std::string& name, const std::string& whole) {
    Pattern pattern;
    std::string* text = &pattern.before;
    for (std::size_t i = 0; i < name.size();) {
        const char c = name[i];
        int width = 0;
        if (c == '%' && i + 1 < name.size() && name[i + 1] == '%') {
            *text += '%';
            i += 2;
            continue;
        }
        if (c == '%') {
            SHOAL_TRY_ASSIGN(width, parseConversion(name, ++i, whole));
        } else if (c == '#') {
            while (i < name.size() && name[i] == '#') ++i, ++width;
            if (width > kWidthLimit) return badPattern(whole, fmt::format("more than {} #", kWidthLimit));
        } else {
            *text += c;
            ++i;
            continue;
        }
        if (pattern.width >= 0) return badPattern(whole, "two places for the frame number");
        pattern.width = width;
        text = &pattern.after;
    }
    return pattern;
}

}  // namespace

bool hasFramePlaceholder(const std::filesystem::path& pattern) {
    return pattern.filename().string().find_first_of("#%") != std::string::npos;
}

Result<std::filesystem::path> framePath(const std::filesystem::path& pattern, int frame) {
    const std::string whole = pattern.string();
    if (pattern.filename().empty()) return badInput(fmt::format("{}: names a folder, expected a file", whole));
    if (frame < 0) return badInput(fmt::format("{}: frame {}, expected 0 or more", whole, frame));
    SHOAL_TRY_ASSIGN(const Pattern parsed, parsePattern(pattern.filename().string(), whole));
    if (parsed.width >= 0)
        return pattern.parent_path() /
               fmt::format("{}{:0{}}{}", parsed.before, frame, std::max(parsed.width, 1), parsed.after);
    const std::filesystem::path plain = parsed.before;
    return pattern.parent_path() /
           fmt::format("{}_{:0{}}{}", plain.stem().string(), frame, kDefaultWidth, plain.extension().string());
}

}  // namespace shoal::io
