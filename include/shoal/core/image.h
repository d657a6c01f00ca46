// Pixel data. Row 0 is the top row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <shoal/core/math.h>

namespace shoal {

// Linear float pixels: radiance, depth, normals, any AOV. Interleaved: channelCount floats a pixel.
struct Image {
    int width = 0, height = 0, channelCount = 0;
    std::vector<float> pixels;              // width * height * channelCount, row 0 on top
    std::vector<std::string> channelNames;  // empty, or one a channel: "R", "G", "B", "A", "Z"

    Image() = default;
    Image(int width, int height, int channelCount)
        : width(width), height(height), channelCount(channelCount),
          pixels(std::size_t(width) * std::size_t(height) * std::size_t(channelCount)) {}
    bool empty() const { return pixels.empty(); }
    float* at(int x, int y) {
        return pixels.data() + (std::size_t(y) * std::size_t(width) + std::size_t(x)) * std::size_t(channelCount);
    }
    const float* at(int x, int y) const { return const_cast<Image*>(this)->at(x, y); }
};

// 8-bit pixels, 4 channels a pixel (RGBA, straight alpha): what a texture or a PNG holds.
struct ByteImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels;  // width * height * 4, row 0 on top

    ByteImage() = default;
    ByteImage(int width, int height)
        : width(width), height(height), pixels(std::size_t(width) * std::size_t(height) * 4) {}
    bool empty() const { return pixels.empty(); }
};

// Named layers of one picture, all of one size: what a multi-layer EXR holds.
struct Layer {
    std::string name;  // "" for the main picture, else "depth", "normal", ... : channels become "depth.Z"
    Image image;
};

}  // namespace shoal
