// Mips by a 2 x 2 box in linear light, colours weighted by alpha. For masked materials every level's alpha is scaled so
// that as many texels pass the cutoff as in the image [Castano 2010, "Computing alpha mipmaps"]: leaves do not thin out
// with distance.
#include "frame/gpu_texture.h"

#include <epoxy/gl.h>

#include <array>
#include <cmath>

#include <shoal/core/parallel.h>

namespace shoal::frame {
namespace {

constexpr int kLinearSteps = 4096;  // of the table from linear light back to sRGB bytes
constexpr std::size_t kRowsPerTask = 16;

struct SrgbTables {
    std::array<float, 256> linear;
    std::array<std::uint8_t, kLinearSteps + 1> byte;
    SrgbTables() {
        for (int i = 0; i < 256; ++i) {
            const double s = i / 255.0;
            linear[std::size_t(i)] = float(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
        }
        // Indexed by the square root of the light, which spreads the dark steps.
        for (int i = 0; i <= kLinearSteps; ++i) {
            const double root = double(i) / kLinearSteps, light = root * root;
            const double s = light <= 0.0031308 ? light * 12.92 : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
            byte[std::size_t(i)] = std::uint8_t(std::lround(255 * s));
        }
    }
    std::uint8_t encode(float light) const {
        return byte[std::size_t(std::sqrt(std::min(std::max(light, 0.0f), 1.0f)) * kLinearSteps + 0.5f)];
    }
};

const SrgbTables& srgb() {
    static const SrgbTables tables;
    return tables;
}

void averageColor(const std::uint8_t* const (&from)[4], std::uint8_t* to) {
    const SrgbTables& tables = srgb();
    int alphaSum = 0;
    for (const std::uint8_t* p : from) alphaSum += p[3];
    float sum[3] = {};
    for (const std::uint8_t* p : from) {
        const float weight = alphaSum > 0 ? float(p[3]) / float(alphaSum) : 0.25f;
        for (int c = 0; c < 3; ++c) sum[c] += weight * tables.linear[p[c]];
    }
    for (int c = 0; c < 3; ++c) to[c] = tables.encode(sum[c]);
    to[3] = std::uint8_t((alphaSum + 2) / 4);
}

void averageNumbers(const std::uint8_t* const (&from)[4], std::uint8_t* to) {
    for (int c = 0; c < 4; ++c) to[c] = std::uint8_t((from[0][c] + from[1][c] + from[2][c] + from[3][c] + 2) / 4);
}

ByteImage halved(const ByteImage& image, bool color) {
    ByteImage half(std::max(image.width / 2, 1), std::max(image.height / 2, 1));
    auto texel = [&](int x, int y) {
        x = std::min(x, image.width - 1), y = std::min(y, image.height - 1);
        return image.pixels.data() + (std::size_t(y) * std::size_t(image.width) + std::size_t(x)) * 4;
    };
    parallelFor(std::size_t(half.height), kRowsPerTask, [&](std::size_t row) {
        const int y = int(row);
        std::uint8_t* to = half.pixels.data() + row * std::size_t(half.width) * 4;
        for (int x = 0; x < half.width; ++x, to += 4) {
            const std::uint8_t* const from[4] = {texel(2 * x, 2 * y), texel(2 * x + 1, 2 * y), texel(2 * x, 2 * y + 1),
                                                 texel(2 * x + 1, 2 * y + 1)};
            color ? averageColor(from, to) : averageNumbers(from, to);
        }
    });
    return half;
}

// Share of texels with alpha of at least each value: [a] for a in 0..255.
std::array<double, 256> coverage(const ByteImage& image) {
    std::array<double, 256> share{};
    for (std::size_t i = 3; i < image.pixels.size(); i += 4)
        share[image.pixels[i]] += 4.0 / double(image.pixels.size());
    for (int a = 254; a >= 0; --a) share[std::size_t(a)] += share[std::size_t(a) + 1];
    return share;
}

void keepCoverage(ByteImage& image, double wanted, float cutoff) {
    const std::array<double, 256> share = coverage(image);
    int threshold = 255;  // the alpha that `wanted` of the texels reach
    while (threshold > 1 && share[std::size_t(threshold)] < wanted) --threshold;
    const float scale = std::ceil(cutoff * 255) / float(threshold);
    for (std::size_t i = 3; i < image.pixels.size(); i += 4)
        image.pixels[i] = std::uint8_t(std::min(std::lround(float(image.pixels[i]) * scale), 255l));
}

}  // namespace

std::vector<ByteImage> makeMips(const ByteImage& image, const TextureMeaning& meaning) {
    std::vector<ByteImage> mips;
    const ByteImage* from = &image;
    int levels = 0;
    for (int side = std::max(image.width, image.height); side > 1; side /= 2) ++levels;
    mips.reserve(std::size_t(levels));
    for (int i = 0; i < levels; ++i) {
        mips.push_back(halved(*from, meaning.color));
        from = &mips.back();
    }
    if (meaning.coverageCutoff > 0) {
        const int least = std::min(int(std::ceil(meaning.coverageCutoff * 255)), 255);
        const double wanted = coverage(image)[std::size_t(least)];
        if (wanted > 0)
            for (ByteImage& mip : mips) keepCoverage(mip, wanted, meaning.coverageCutoff);
    }
    return mips;
}

TextureStore::TextureStore(gl::Device& device) : device_(&device) {
    addPlain({255, 255, 255, 255}, "white");
    addPlain({128, 128, 255, 255}, "flat normal");
}

int TextureStore::addPlain(const std::uint8_t (&rgba)[4], const char* label) {
    gl::TextureDesc desc;
    desc.format = GL_RGBA8;
    desc.label = label;
    textures_.push_back(gl::Texture::create(*device_, desc));
    textures_.back().upload(0, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    return int(textures_.size()) - 1;
}

Result<int> TextureStore::add(const ByteImage& image, const TextureMeaning& meaning, const std::string& name) {
    const int largest = device_->capabilities().maxTextureSize;
    if (image.width < 1 || image.height < 1 || image.width > largest || image.height > largest)
        return badInput(name + ": texture is " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                        " pixels, expected 1 to " + std::to_string(largest) + " a side");
    const std::vector<ByteImage> mips = makeMips(image, meaning);
    gl::TextureDesc desc;
    desc.format = meaning.color ? GL_SRGB8_ALPHA8 : GL_RGBA8;
    desc.width = image.width;
    desc.height = image.height;
    desc.levels = int(mips.size()) + 1;
    desc.label = name;
    gl::Texture texture = gl::Texture::create(*device_, desc);
    texture.upload(0, 0, GL_RGBA, GL_UNSIGNED_BYTE, image.pixels.data());
    for (std::size_t i = 0; i < mips.size(); ++i)
        texture.upload(int(i) + 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, mips[i].pixels.data());
    textures_.push_back(std::move(texture));
    return int(textures_.size()) - 1;
}

int TextureStore::sampler(const TextureUse& use) {
    const std::uint32_t key = std::uint32_t(use.wrapU) | std::uint32_t(use.wrapV) << 2 | (use.nearest ? 16u : 0u);
    if (const auto found = samplerIndex_.find(key); found != samplerIndex_.end()) return found->second;
    auto wrap = [](Wrap w) -> gl::Enum {
        return w == Wrap::repeat ? GL_REPEAT : w == Wrap::mirror ? GL_MIRRORED_REPEAT : GL_CLAMP_TO_EDGE;
    };
    // Anisotropic filtering costs a software renderer several times the texture's price.
    const gl::Capabilities& can = device_->capabilities();
    const float anisotropy = device_->software() || !can.anisotropicFiltering ? 1 : std::min(can.maxAnisotropy, 8.0f);
    samplers_.push_back(gl::Sampler::create(*device_, use.nearest ? GL_NEAREST_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_LINEAR,
                                            use.nearest ? GL_NEAREST : GL_LINEAR, wrap(use.wrapU), wrap(use.wrapV),
                                            anisotropy));
    const int index = int(samplers_.size()) - 1;
    samplerIndex_[key] = index;
    return index;
}

void TextureStore::bind(int unit, int texture, int sampler) const {
    gl::bindTexture(unit, textures_[std::size_t(texture)].view());
    samplers_[std::size_t(sampler)].bind(unit);
}

void TextureStore::clear() { textures_.resize(2); }

}  // namespace shoal::frame
