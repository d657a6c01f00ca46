// Brings an environment to the GPU as half floats.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include <shoal/core/parallel.h>

#include "frame/environment_map.h"

namespace shoal::frame {
namespace {

constexpr float kLargestHalf = 65504;
constexpr int kLargestWidth = 4096;  // of the sharp map, texels: 64 MiB; wider maps are halved

bool isRadiance(float x) { return x >= 0 && x <= std::numeric_limits<float>::max(); }

// The map with what cannot be radiance replaced: NaN and negative values by 0, infinity by the brightest half float.
// Nothing where the map is fine.
std::optional<light::Environment> repaired(const light::Environment& environment) {
    const std::vector<float>& pixels = environment.radiance.pixels;
    const auto badIn = [&](std::size_t begin, std::size_t end) {
        std::size_t bad = 0;
        for (std::size_t i = begin; i < end; ++i) bad += !isRadiance(pixels[i]);
        return bad;
    };
    if (parallelReduce(pixels.size(), 65536, std::size_t(0), badIn, std::plus<>()) == 0) return std::nullopt;
    light::Environment copy = environment;
    for (float& x : copy.radiance.pixels)
        if (!isRadiance(x)) x = x > 0 ? kLargestHalf : 0.0f;
    return copy;
}

// Nearest half float of x in [0, 65504]; rounds to even. Written for the compiler to vectorise.
std::uint16_t halfFromFloat(float x) {
    // Below 2^-14 halves are multiples of 2^-24: adding 0.5 leaves exactly those bits in the mantissa.
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
    const std::uint32_t tiny = std::bit_cast<std::uint32_t>(x + 0.5f) - std::bit_cast<std::uint32_t>(0.5f);
    const std::uint32_t normal = (bits - (112u << 23) + 0xFFFu + ((bits >> 13) & 1u)) >> 13;
    return std::uint16_t(x < 6.103515625e-5f ? tiny : normal);
}

using HalfRows = std::vector<std::uint16_t>;  // 4 a texel, a = 1

std::uint16_t* putTexel(std::uint16_t* to, const float* rgb) {
    for (int k = 0; k < 3; ++k) {
        const float x = rgb[k];
        *to++ = halfFromFloat(x > 0 ? std::min(x, kLargestHalf) : 0.0f);  // NaN becomes 0
    }
    *to++ = 0x3C00;
    return to;
}

HalfRows halves(const float* pixels, int width, int height, int channelCount) {
    HalfRows out(std::size_t(width) * std::size_t(height) * 4);
    parallelFor(std::size_t(height), 16, [&](std::size_t y) {
        std::uint16_t* to = out.data() + y * std::size_t(width) * 4;
        const float* from = pixels + y * std::size_t(width) * std::size_t(channelCount);
        for (int x = 0; x < width; ++x, from += channelCount) to = putTexel(to, from);
    });
    return out;
}

Image halvedImage(const Image& fine) {
    const int width = std::max(fine.width / 2, 1), height = std::max(fine.height / 2, 1);
    Image out(width, height, 3);
    parallelFor(std::size_t(height), 16, [&](std::size_t row) {
        const int y = int(row);
        for (int x = 0; x < width; ++x) {
            const int x1 = std::min(2 * x + 1, fine.width - 1), y1 = std::min(2 * y + 1, fine.height - 1);
            for (int k = 0; k < 3; ++k)
                out.at(x, y)[k] = 0.25f * (fine.at(2 * x, 2 * y)[k] + fine.at(x1, 2 * y)[k] + fine.at(2 * x, y1)[k] +
                                           fine.at(x1, y1)[k]);
        }
    });
    return out;
}

gl::Texture makeTexture(gl::Device& device, int width, int height, int levels, gl::Enum minFilter, const char* label) {
    gl::TextureDesc desc;
    desc.format = GL_RGBA16F;
    desc.width = width, desc.height = height, desc.levels = levels;
    desc.minFilter = minFilter, desc.magFilter = GL_LINEAR;
    desc.label = label;
    return gl::Texture::create(device, desc);
}

gl::Texture uploadSharp(gl::Device& device, const Image& radiance) {
    const int levels = std::bit_width(unsigned(std::max(radiance.width, radiance.height)));
    gl::Texture texture =
        makeTexture(device, radiance.width, radiance.height, levels, GL_LINEAR_MIPMAP_NEAREST, "environment");
    if (!texture) return texture;
    glTextureParameteri(texture.name(), GL_TEXTURE_WRAP_S, GL_REPEAT);
    Image coarser;
    for (int level = 0; level < levels; ++level) {
        const Image& image = level == 0 ? radiance : coarser;
        const HalfRows rows = halves(image.pixels.data(), image.width, image.height, image.channelCount);
        texture.upload(level, 0, GL_RGBA, GL_HALF_FLOAT, rows.data());
        if (level + 1 < levels) coarser = halvedImage(image);
    }
    return texture;
}

}  // namespace

Result<EnvironmentMap> uploadEnvironment(gl::Device& device, const light::Environment& asGiven) {
    const std::optional<light::Environment> sound = repaired(asGiven);
    const light::Environment& environment = sound ? *sound : asGiven;
    const Image& given = environment.radiance;
    if (given.empty() || given.channelCount < 3)
        return badInput(fmt::format("environment is {}x{} with {} channels, expected a lat-long map with 3",
                                    given.width, given.height, given.channelCount));
    const int largest = std::min(kLargestWidth, device.capabilities().maxTextureSize);
    Image smaller;
    while (std::max(smaller.empty() ? given.width : smaller.width, smaller.empty() ? given.height : smaller.height) >
           largest)
        smaller = halvedImage(smaller.empty() ? given : smaller);

    EnvironmentMap map;
    map.sharp = uploadSharp(device, smaller.empty() ? given : smaller);
    const std::vector<PrefilteredLevel> levels = prefilterEnvironment(environment);
    map.prefiltered = makeTexture(device, levels[0].size, levels[0].size, int(levels.size()), GL_LINEAR_MIPMAP_NEAREST,
                                  "prefiltered environment");
    if (!map.sharp || !map.prefiltered) return internalError("no memory for the environment's textures");
    for (std::size_t l = 0; l < levels.size(); ++l) {
        const HalfRows rows = halves(&levels[l].radiance[0].x, levels[l].size, levels[l].size, 3);
        map.prefiltered.upload(int(l), 0, GL_RGBA, GL_HALF_FLOAT, rows.data());
    }
    map.shape = {
        light::projectSh(environment), environment.rotation, int(levels.size()), levels[0].size, map.sharp.width(),
        map.sharp.view().levels};
    return map;
}

}  // namespace shoal::frame
