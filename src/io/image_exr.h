// What the OpenEXR reader and writer share. No OpenEXR header here.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shoal::io {

// "albedo.R": layer "albedo", channel "R"; a name without a dot belongs to the main picture.
struct ExrChannelName {
    std::string layer, channel;
};
ExrChannelName splitExrChannel(std::string_view full);

// Where a channel stands among those of its layer: R G B A, then X Y Z, then the rest by name.
bool exrChannelBefore(std::string_view a, std::string_view b);

// A set of channels that is a colour or a brightness: R, G, B, A in any number, or Y with or without A.
bool isExrColor(const std::vector<std::string>& channels);

// Looks at the sizes in the headers before OpenEXR takes memory by them: "" or what is wrong.
std::string checkExrHeaders(std::span<const std::byte> bytes);

}  // namespace shoal::io
