// One decoder a format, behind the checks that all share. Used by image.cpp alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/core/result.h>
#include <shoal/io/image.h>

namespace shoal::io {

using Bytes = std::span<const std::byte>;

// Sizes within the limits of image.h.
Result<void> checkImageSize(std::int64_t width, std::int64_t height, const std::string& name);

Result<ImageInfo> pngInfo(Bytes bytes, const std::string& name);
Result<ByteImage> decodePng(Bytes bytes, const std::string& name);
Result<Image> decodePngLinear(Bytes bytes, const std::string& name);
// Deflated in strips on all cores; the same bytes for any number of them.
std::vector<std::byte> encodePng(const ByteImage& image, bool withAlpha);

Result<ImageInfo> jpegInfo(Bytes bytes, const std::string& name);
Result<ByteImage> decodeJpeg(Bytes bytes, const std::string& name);
Result<Image> decodeJpegLinear(Bytes bytes, const std::string& name);
Result<std::vector<std::byte>> encodeJpeg(const ByteImage& image, int quality);

Result<ImageInfo> hdrInfo(Bytes bytes, const std::string& name);
Result<Image> decodeHdr(Bytes bytes, const std::string& name);

Result<ImageInfo> exrInfo(Bytes bytes, const std::string& name);
Result<std::vector<Layer>> decodeExr(Bytes bytes, const std::string& name);
Result<std::vector<std::byte>> encodeExr(std::span<const Layer> layers, const ExrOptions& options);

}  // namespace shoal::io
