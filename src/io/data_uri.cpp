#include "io/data_uri.h"

#include <array>
#include <cctype>
#include <cstdint>

#include <fmt/format.h>

namespace shoal::io {

namespace {

constexpr std::uint8_t kNoDigit = 0xFF;

constexpr std::array<std::uint8_t, 256> base64Table() {
    std::array<std::uint8_t, 256> table{};
    for (auto& entry : table) entry = kNoDigit;
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kDigits.size(); ++i) table[std::uint8_t(kDigits[i])] = std::uint8_t(i);
    table[std::uint8_t('-')] = 62;  // the URL alphabet
    table[std::uint8_t('_')] = 63;
    return table;
}
constexpr std::array<std::uint8_t, 256> kBase64 = base64Table();

bool decodeBase64(std::string_view text, std::vector<std::byte>& out, std::string& problem) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    if (text.size() % 4 == 1) {
        problem = fmt::format("base64 of {} digits, which is no whole number of bytes", text.size());
        return false;
    }
    out.resize(text.size() / 4 * 3 + (text.size() % 4 ? text.size() % 4 - 1 : 0));
    std::size_t written = 0;
    for (std::size_t i = 0; i < text.size(); i += 4) {
        std::uint32_t word = 0;
        const std::size_t digits = std::min<std::size_t>(4, text.size() - i);
        for (std::size_t d = 0; d < 4; ++d) {
            const std::uint8_t value = d < digits ? kBase64[std::uint8_t(text[i + d])] : 0;
            if (value == kNoDigit) {
                problem = fmt::format("character {} of the base64 text is no base64 digit", i + d);
                return false;
            }
            word = word << 6 | value;
        }
        for (std::size_t b = 0; b + 1 < digits; ++b) out[written++] = std::byte(word >> (16 - 8 * b));
    }
    return true;
}

int hexDigit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

bool isDataUri(std::string_view uri) { return uri.starts_with("data:") || uri.starts_with("DATA:"); }

bool decodeDataUri(std::string_view uri, std::vector<std::byte>& out, std::string& problem) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        problem = "data URI without a comma";
        return false;
    }
    if (uri.substr(0, comma).ends_with(";base64")) return decodeBase64(uri.substr(comma + 1), out, problem);
    const std::string plain = percentDecoded(uri.substr(comma + 1));
    const auto* first = reinterpret_cast<const std::byte*>(plain.data());
    out.assign(first, first + plain.size());
    return true;
}

std::string percentDecoded(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool escape =
            text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 && hexDigit(text[i + 2]) >= 0;
        if (!escape) {
            out += text[i];
            continue;
        }
        out += char(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
        i += 2;
    }
    return out;
}

}  // namespace shoal::io
