// Pictures in and out: PNG, JPEG, Radiance HDR and OpenEXR. Readers go by a file's content, writers by its extension.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/core/result.h>

namespace shoal::io {

enum class ImageFormat { png, jpeg, hdr, exr };

// Limits every reader checks before it allocates.
inline constexpr int kImageSideLimit = 16384;                              // pixels
inline constexpr std::uint64_t kImagePixelLimit = std::uint64_t(1) << 28;  // width * height
inline constexpr int kImageChannelLimit = 256;                             // of an EXR, all layers together

// By extension, case ignored: .png, .jpg, .jpeg, .hdr, .pic, .exr; nothing for any other.
std::optional<ImageFormat> imageFormatOf(const std::filesystem::path& path);
// By the first bytes; nothing where they are none of the four.
std::optional<ImageFormat> imageFormatOf(std::span<const std::byte> bytes);

// ---- reading ----

// Linear float pixels. PNG and JPEG: 1 (grey), 3 or 4 channels, sRGB decoded (8 and 16 bit; alpha is linear as stored;
// grey with alpha becomes 4 channels). HDR: 3 channels, radiance (EXPOSURE divided out). EXR: the main picture (see
// readLayers), radiance; Y alone is 1 channel, else R, G, B and A where there is one. channelNames are set ("R", "G",
// "B", "A" or "Y").
Result<Image> readImage(const std::filesystem::path& path);
Result<Image> readImage(std::span<const std::byte> bytes, const std::string& name);

// Every layer of an EXR, the main picture first with the name "", then by name: channel "depth.Z" is channel "Z" of
// layer "depth"; parts of a multi-part file are layers too. Channels of a layer are in the order R G B A, X Y Z, else
// by name. Other formats: one layer. Pixels outside the data window are 0, what lies outside the display window is
// dropped.
Result<std::vector<Layer>> readLayers(const std::filesystem::path& path);
Result<std::vector<Layer>> readLayers(std::span<const std::byte> bytes, const std::string& name);

// PNG or JPEG as stored (still sRGB encoded), to RGBA; 16-bit PNG loses its low byte. `name` stands in error messages.
Result<ByteImage> decodeImage(std::span<const std::byte> bytes, const std::string& name);
Result<ByteImage> readByteImage(const std::filesystem::path& path);

// What a file says of itself, from its header alone.
struct ImageInfo {
    ImageFormat format = ImageFormat::png;
    int width = 0, height = 0, channelCount = 0;
    std::string details;  // "8 bit", "half, DWAB", ... one line for `shoal info`
};
Result<ImageInfo> readImageInfo(const std::filesystem::path& path);

// ---- writing, all atomic (file.h) ----

// 8-bit RGB, or RGBA with straight alpha. sRGB-encoded values, marked so in the file.
Result<void> writePng(const std::filesystem::path& path, const ByteImage& image, bool withAlpha = false);
// quality 1..100; alpha is dropped.
Result<void> writeJpeg(const std::filesystem::path& path, const ByteImage& image, int quality = 92);
// Writes .png or .jpg by the extension of `path`; an error for any other.
Result<void> writeByteImage(const std::filesystem::path& path, const ByteImage& image, bool withAlpha = false);

enum class ExrCompression { none, rle, zip, zipScanline, piz };
struct ExrOptions {
    bool halfColor = true;  // main picture and layers of R, G, B, (A) as half floats
    ExrCompression compression = ExrCompression::zip;
};
// Layers of equal size to one EXR with the channel names that Blender and Nuke show as layers: "depth.Z", "albedo.R";
// the main picture ("") has plain R, G, B, A. A layer's channelNames are used where given. Else one channel is Z for
// "depth", X for a name ending in "Id" (as Blender's IndexOB.X; it wants one letter) and Y otherwise; two are X, Y;
// three are X, Y, Z for "normal", "position" and "motion" and R, G, B otherwise; four are R, G, B, A. Colour (R, G, B,
// A or Y) is half where options say so, saturating at +-65504; all else is float32, ids too: exact for whole numbers to
// 2^24, and more readers take it than take UINT.
Result<void> writeExr(const std::filesystem::path& path, std::span<const Layer> layers, const ExrOptions& options = {});
Result<void> writeExr(const std::filesystem::path& path, const Image& image, const ExrOptions& options = {});

// Display-encoded 0..1 (1, 3 or 4 channels) to 8 bits, rounded to nearest; NaN is 0; alpha 255 where there is none.
ByteImage quantize(const Image& displayReferred);

// ---- numbered frames ----

// The file of frame `frame` (>= 0). In the file's name, not its folder, one run of '#' is the number zero-padded to
// that width, so is printf's %d or %04d ("%%" is a percent sign); without either, "out/f.exr" becomes "out/f_0007.exr".
// Errors: two placeholders, any other use of '%', a negative frame.
Result<std::filesystem::path> framePath(const std::filesystem::path& pattern, int frame);
// Whether the file's name asks for a number by '#' or '%'.
bool hasFramePlaceholder(const std::filesystem::path& pattern);

}  // namespace shoal::io
