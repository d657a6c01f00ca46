#include <shoal/io/image.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include <shoal/core/parallel.h>
#include <shoal/io/file.h>

#include "io/image_codecs.h"

namespace shoal::io {
namespace {

namespace fs = std::filesystem;

bool startsWith(Bytes bytes, std::string_view magic) {
    return bytes.size() >= magic.size() && std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

Error notAnImage(const std::string& name, std::string_view expected) {
    return badInput(fmt::format("{}: not an image that can be read, expected {}", name, expected));
}

// Grey with alpha is the one two-channel picture that becomes RGBA.
Image greyAlphaToRgba(const Image& image) {
    Image rgba(image.width, image.height, 4);
    rgba.channelNames = {"R", "G", "B", "A"};
    for (std::size_t i = 0; i < image.pixels.size() / 2; ++i) {
        for (std::size_t c = 0; c < 3; ++c) rgba.pixels[i * 4 + c] = image.pixels[i * 2];
        rgba.pixels[i * 4 + 3] = image.pixels[i * 2 + 1];
    }
    return rgba;
}

bool isColor(const Image& image) { return !image.channelNames.empty() && image.channelNames[0] == "R"; }

// The layer that people mean by "the picture": the unnamed one; else one called as renderers call it; else the first
// with colours; else the first.
std::size_t mainLayer(const std::vector<Layer>& layers) {
    for (const char* wanted : {"", "rgba", "beauty", "combined"}) {
        for (std::size_t i = 0; i < layers.size(); ++i) {
            const std::string& full = layers[i].name;
            std::string last = full.substr(full.rfind('.') + 1);  // "ViewLayer.Combined" of Blender
            std::transform(last.begin(), last.end(), last.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
            if (last == wanted) return i;
        }
    }
    const auto colored =
        std::find_if(layers.begin(), layers.end(), [](const Layer& layer) { return isColor(layer.image); });
    return colored == layers.end() ? 0 : std::size_t(colored - layers.begin());
}

}  // namespace

std::optional<ImageFormat> imageFormatOf(const fs::path& path) {
    const std::string extension = lowerExtension(path);
    if (extension == ".png") return ImageFormat::png;
    if (extension == ".jpg" || extension == ".jpeg") return ImageFormat::jpeg;
    if (extension == ".hdr" || extension == ".pic") return ImageFormat::hdr;
    if (extension == ".exr") return ImageFormat::exr;
    return std::nullopt;
}

std::optional<ImageFormat> imageFormatOf(Bytes bytes) {
    if (startsWith(bytes, "\x89PNG\r\n\x1a\n")) return ImageFormat::png;
    if (startsWith(bytes, "\xff\xd8\xff")) return ImageFormat::jpeg;
    if (startsWith(bytes, "#?RADIANCE") || startsWith(bytes, "#?RGBE")) return ImageFormat::hdr;
    if (startsWith(bytes, "\x76\x2f\x31\x01")) return ImageFormat::exr;
    return std::nullopt;
}

Result<void> checkImageSize(std::int64_t width, std::int64_t height, const std::string& name) {
    if (width < 1 || height < 1)
        return badInput(fmt::format("{}: an image of {} x {} pixels, expected at least 1 x 1", name, width, height));
    if (width > kImageSideLimit || height > kImageSideLimit ||
        std::uint64_t(width) * std::uint64_t(height) > kImagePixelLimit)
        return badInput(fmt::format("{}: an image of {} x {} pixels, the limit is {} x {}", name, width, height,
                                    kImageSideLimit, kImageSideLimit));
    return {};
}

Result<std::vector<Layer>> readLayers(Bytes bytes, const std::string& name) {
    const std::optional<ImageFormat> format = imageFormatOf(bytes);
    if (!format) return notAnImage(name, "PNG, JPEG, HDR or EXR");
    if (*format == ImageFormat::exr) return decodeExr(bytes, name);
    std::vector<Layer> layers(1);
    if (*format == ImageFormat::png) {
        SHOAL_TRY_ASSIGN(layers[0].image, decodePngLinear(bytes, name));
    } else if (*format == ImageFormat::jpeg) {
        SHOAL_TRY_ASSIGN(layers[0].image, decodeJpegLinear(bytes, name));
    } else {
        SHOAL_TRY_ASSIGN(layers[0].image, decodeHdr(bytes, name));
    }
    return layers;
}

Result<std::vector<Layer>> readLayers(const fs::path& path) {
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, readFile(path));
    return readLayers(bytes, path.string());
}

Result<Image> readImage(Bytes bytes, const std::string& name) {
    SHOAL_TRY_ASSIGN(std::vector<Layer> layers, readLayers(bytes, name));
    Image image = std::move(layers[mainLayer(layers)].image);
    if (image.channelNames == std::vector<std::string>{"Y", "A"}) return greyAlphaToRgba(image);
    return image;
}

Result<Image> readImage(const fs::path& path) {
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, readFile(path));
    return readImage(bytes, path.string());
}

Result<ByteImage> decodeImage(Bytes bytes, const std::string& name) {
    const std::optional<ImageFormat> format = imageFormatOf(bytes);
    if (format == ImageFormat::png) return decodePng(bytes, name);
    if (format == ImageFormat::jpeg) return decodeJpeg(bytes, name);
    return notAnImage(name, "PNG or JPEG");
}

Result<ByteImage> readByteImage(const fs::path& path) {
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, readFile(path));
    return decodeImage(bytes, path.string());
}

Result<ImageInfo> readImageInfo(const fs::path& path) {
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, readFile(path));
    const std::string name = path.string();
    const std::optional<ImageFormat> format = imageFormatOf(bytes);
    if (!format) return notAnImage(name, "PNG, JPEG, HDR or EXR");
    switch (*format) {
        case ImageFormat::png:
            return pngInfo(bytes, name);
        case ImageFormat::jpeg:
            return jpegInfo(bytes, name);
        case ImageFormat::hdr:
            return hdrInfo(bytes, name);
        case ImageFormat::exr:
            return exrInfo(bytes, name);
    }
    return notAnImage(name, "PNG, JPEG, HDR or EXR");
}

Result<void> writePng(const fs::path& path, const ByteImage& image, bool withAlpha) {
    SHOAL_TRY(checkImageSize(image.width, image.height, path.string()));
    SHOAL_ASSERT_EQ(image.pixels.size(), std::size_t(image.width) * std::size_t(image.height) * 4);
    return writeFileAtomically(path, encodePng(image, withAlpha));
}

Result<void> writeJpeg(const fs::path& path, const ByteImage& image, int quality) {
    SHOAL_TRY(checkImageSize(image.width, image.height, path.string()));
    SHOAL_ASSERT_EQ(image.pixels.size(), std::size_t(image.width) * std::size_t(image.height) * 4);
    SHOAL_ASSERT_GE(quality, 1);
    SHOAL_ASSERT_LE(quality, 100);
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, encodeJpeg(image, quality));
    return writeFileAtomically(path, bytes);
}

Result<void> writeByteImage(const fs::path& path, const ByteImage& image, bool withAlpha) {
    const std::optional<ImageFormat> format = imageFormatOf(path);
    if (format == ImageFormat::png) return writePng(path, image, withAlpha);
    if (format == ImageFormat::jpeg) return writeJpeg(path, image);
    return badInput(fmt::format("{}: found the extension \"{}\", expected .png, .jpg or .jpeg", path.string(),
                                path.extension().string()));
}

Result<void> writeExr(const fs::path& path, std::span<const Layer> layers, const ExrOptions& options) {
    SHOAL_ASSERT_MSG(!layers.empty(), "writeExr() without a layer");
    SHOAL_TRY(checkImageSize(layers[0].image.width, layers[0].image.height, path.string()));
    auto bytes = encodeExr(layers, options);
    if (!bytes) return badInput(fmt::format("{}: {}", path.string(), bytes.error().message));
    return writeFileAtomically(path, *bytes);
}

Result<void> writeExr(const fs::path& path, const Image& image, const ExrOptions& options) {
    const Layer layer{"", image};
    return writeExr(path, std::span(&layer, 1), options);
}

ByteImage quantize(const Image& image) {
    const int channels = image.channelCount;
    SHOAL_ASSERT_MSG(channels == 1 || channels == 3 || channels == 4, fmt::format("quantize: {} channels", channels));
    ByteImage bytes(image.width, image.height);
    constexpr std::size_t kGrain = 1 << 16;  // pixels
    parallelFor(std::size_t(image.width) * std::size_t(image.height), kGrain, [&](std::size_t i) {
        const float* from = image.pixels.data() + i * std::size_t(channels);
        std::uint8_t* to = bytes.pixels.data() + i * 4;
        for (int c = 0; c < 4; ++c) {
            if (c == 3 && channels < 4) {
                to[c] = 255;
                continue;
            }
            const float value = from[channels == 1 ? 0 : c];
            to[c] = value > 0 ? std::uint8_t(std::min(value, 1.0f) * 255.0f + 0.5f) : 0;  // NaN compares false
        }
    });
    return bytes;
}

}  // namespace shoal::io
