// What the makers of surfaces share: a function of (u, v) to colour, normal map and roughness.
#pragma once

#include <array>
#include <vector>

#include <shoal/core/parallel.h>

#include "scene/shapes/noise.h"
#include "scene/shapes/surfaces.h"

namespace shoal::scene::shapes {

struct Texel {
    Vec3 albedo;       // linear
    float height = 0;  // metres
    float roughness = 1;
};

inline std::uint8_t byteOf(float unit) { return std::uint8_t(std::clamp(unit, 0.0f, 1.0f) * 255 + 0.5f); }

inline std::uint8_t srgbByte(float linear) {
    static const std::array<std::uint8_t, 4096> table = [] {
        std::array<std::uint8_t, 4096> t{};
        for (std::size_t i = 0; i < t.size(); ++i) t[i] = byteOf(srgbFromLinear((float(i) + 0.5f) / 4096));
        return t;
    }();
    return table[std::size_t(std::clamp(linear, 0.0f, 1.0f) * 4095)];
}

// texelAt(u, v), u right and v down in [0, 1).
template <class TexelAt>
Surface makeSurface(int size, float metres, const TexelAt& texelAt) {
    const std::size_t side = std::size_t(size);
    std::vector<float> heights(side * side);
    Surface out{ByteImage(size, size), ByteImage(size, size), ByteImage(size, size), metres};
    parallelFor(side, 16, [&](std::size_t y) {
        for (std::size_t x = 0; x < side; ++x) {
            const Texel t = texelAt((float(x) + 0.5f) / float(size), (float(y) + 0.5f) / float(size));
            heights[y * side + x] = t.height;
            std::uint8_t* color = &out.color.pixels[4 * (y * side + x)];
            color[0] = srgbByte(t.albedo.x), color[1] = srgbByte(t.albedo.y), color[2] = srgbByte(t.albedo.z),
            color[3] = 255;
            std::uint8_t* roughness = &out.roughness.pixels[4 * (y * side + x)];
            roughness[0] = 255, roughness[1] = byteOf(t.roughness), roughness[2] = 0, roughness[3] = 255;
        }
    });
    const float perMetre = float(size) / metres / 2;
    parallelFor(side, 16, [&](std::size_t y) {
        const std::size_t above = (y + side - 1) % side, below = (y + 1) % side;
        for (std::size_t x = 0; x < side; ++x) {
            const std::size_t left = (x + side - 1) % side, right = (x + 1) % side;
            const Vec3 n = normalize(Vec3{(heights[y * side + left] - heights[y * side + right]) * perMetre,
                                          (heights[below * side + x] - heights[above * side + x]) * perMetre, 1});
            std::uint8_t* normal = &out.normal.pixels[4 * (y * side + x)];
            normal[0] = byteOf(n.x * 0.5f + 0.5f), normal[1] = byteOf(n.y * 0.5f + 0.5f);
            normal[2] = byteOf(n.z * 0.5f + 0.5f), normal[3] = 255;
        }
    });
    return out;
}

}  // namespace shoal::scene::shapes
