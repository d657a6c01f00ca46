#include "io/image_exr.h"

#include <algorithm>
#include <tuple>

namespace shoal::io {

ExrChannelName splitExrChannel(std::string_view full) {
    const std::size_t dot = full.rfind('.');
    if (dot == std::string_view::npos) return {"", std::string(full)};
    return {std::string(full.substr(0, dot)), std::string(full.substr(dot + 1))};
}

bool exrChannelBefore(std::string_view a, std::string_view b) {
    constexpr std::string_view kOrder = "RGBXYZA";
    const auto key = [&](std::string_view name) {
        const std::size_t at = name.size() == 1 ? kOrder.find(name[0]) : std::string_view::npos;
        return std::tuple(std::min(at, kOrder.size()), name);
    };
    return key(a) < key(b);
}

bool isExrColor(const std::vector<std::string>& channels) {
    const auto all = [&](std::string_view allowed) {
        return std::all_of(channels.begin(), channels.end(), [&](const std::string& channel) {
            return channel.size() == 1 && allowed.find(channel[0]) != std::string_view::npos;
        });
    };
    const bool hasY = std::find(channels.begin(), channels.end(), "Y") != channels.end();
    return hasY ? all("YA") : all("RGBA");
}

}  // namespace shoal::io
