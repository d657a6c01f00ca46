// PNG: read by libpng, written by our own encoder on zlib, which deflates strips of rows in parallel.
//
// The strips are raw deflate streams that end on a byte (Z_SYNC_FLUSH), so they can be joined [RFC 1950, 1951; pigz].
// Each row takes the cheaper of the filters Sub and Up by the smallest sum of absolute differences [PNG
// specification 12.8].

#include "io/image_codecs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <png.h>
#include <zlib.h>

#include <fmt/format.h>

#include <shoal/core/parallel.h>

namespace shoal::io {
namespace {

// ---- reading ----

constexpr std::uint64_t kDeflateLargestRatio = 1032;  // bytes out a byte in, of any deflate stream
constexpr png_alloc_size_t kChunkLimit = 8u << 20;    // bytes of one text or profile chunk, inflated
constexpr png_uint_32 kChunkCountLimit = 1000;

// libpng reports by longjmp: functions that call it below hold nothing with a destructor.
struct PngReader {
    png_structp png = nullptr;
    png_infop info = nullptr;
    Bytes bytes;
    std::size_t at = 0;
    std::array<char, 160> message{};

    explicit PngReader(Bytes bytes) : bytes(bytes) {}
    ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
};

[[noreturn]] void onError(png_structp png, png_const_charp message) {
    auto& reader = *static_cast<PngReader*>(png_get_error_ptr(png));
    std::snprintf(reader.message.data(), reader.message.size(), "%s", message);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

void onRead(png_structp png, png_bytep to, std::size_t size) {
    auto& reader = *static_cast<PngReader*>(png_get_io_ptr(png));
    if (size > reader.bytes.size() - reader.at) png_error(png, "the file is cut short");
    std::memcpy(to, reader.bytes.data() + reader.at, size);
    reader.at += size;
}

bool readHeader(PngReader& reader) {
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, onError, onWarning);
    if (!reader.png) return false;
    reader.info = png_create_info_struct(reader.png);
    if (!reader.info) return false;
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_set_read_fn(reader.png, &reader, onRead);
    png_set_user_limits(reader.png, 0x7fffffff, 0x7fffffff);  // ours are checked below, in our words
    png_set_chunk_malloc_max(reader.png, kChunkLimit);
    png_set_chunk_cache_max(reader.png, kChunkCountLimit);
    png_read_info(reader.png, reader.info);
    return true;
}

enum class PngLayout {
    rgba8,    // always RGBA, 8 bit
    natural,  // 1, 3 or 4 channels, 8 or 16 bit as in the file
};

// Asks libpng for the layout; channel count and depth are then what png_get_channels and png_get_bit_depth say.
bool setLayout(PngReader& reader, PngLayout layout) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    const bool hasAlpha = (png_get_color_type(reader.png, reader.info) & PNG_COLOR_MASK_ALPHA) ||
                          png_get_valid(reader.png, reader.info, PNG_INFO_tRNS);
    png_set_expand(reader.png);
    if (layout == PngLayout::rgba8) {
        png_set_scale_16(reader.png);
        png_set_gray_to_rgb(reader.png);
        png_set_filler(reader.png, 0xff, PNG_FILLER_AFTER);
        png_set_add_alpha(reader.png, 0xff, PNG_FILLER_AFTER);
    } else {
        if (hasAlpha) png_set_gray_to_rgb(reader.png);
        if constexpr (std::endian::native == std::endian::little) png_set_swap(reader.png);
    }
    png_set_interlace_handling(reader.png);
    png_read_update_info(reader.png, reader.info);
    return true;
}

bool readRows(PngReader& reader, png_bytepp rows) {
    if (setjmp(png_jmpbuf(reader.png))) return false;
    png_read_image(reader.png, rows);
    png_read_end(reader.png, nullptr);
    return true;
}

Error pngError(const PngReader& reader, const std::string& name) {
    return badInput(fmt::format("{}: not a PNG that can be read: {}", name, reader.message.data()));
}

Result<void> openPng(PngReader& reader, const std::string& name) {
    if (!readHeader(reader)) return pngError(reader, name);
    const std::int64_t width = png_get_image_width(reader.png, reader.info);
    const std::int64_t height = png_get_image_height(reader.png, reader.info);
    SHOAL_TRY(checkImageSize(width, height, name));
    // A small file cannot hold a large picture: refused before memory is taken for it.
    const std::uint64_t bits = std::uint64_t(width) * std::uint64_t(height) *
                               png_get_channels(reader.png, reader.info) * png_get_bit_depth(reader.png, reader.info);
    if (bits / 8 > reader.bytes.size() * kDeflateLargestRatio)
        return badInput(fmt::format("{}: the file is cut short: {} bytes for {} x {} pixels", name, reader.bytes.size(),
                                    width, height));
    return {};
}

// Reads all rows, `rowBytes` apart, to `pixels`.
Result<void> readPixels(PngReader& reader, std::uint8_t* pixels, std::size_t rowBytes, const std::string& name) {
    SHOAL_ASSERT_EQ(png_get_rowbytes(reader.png, reader.info), rowBytes);
    std::vector<png_bytep> rows(png_get_image_height(reader.png, reader.info));
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = pixels + y * rowBytes;
    if (!readRows(reader, rows.data())) return pngError(reader, name);
    return {};
}

// ---- writing ----

constexpr std::size_t kStripBytes = 256 * 1024;  // filtered bytes a strip, at least one row
constexpr int kDeflateLevel = 1;                 // 6 is 5 times slower for files 10 % smaller (1280x720 panorama)

enum PngFilter : std::uint8_t { kFilterSub = 1, kFilterUp = 2 };

// The bytes of one row as PNG stores them: without alpha unless asked for.
void packRow(const ByteImage& image, int y, bool withAlpha, std::uint8_t* to) {
    const std::uint8_t* from = image.pixels.data() + std::size_t(y) * std::size_t(image.width) * 4;
    if (withAlpha) {
        std::memcpy(to, from, std::size_t(image.width) * 4);
        return;
    }
    for (int x = 0; x < image.width; ++x) {
        to[x * 3 + 0] = from[x * 4 + 0];
        to[x * 3 + 1] = from[x * 4 + 1];
        to[x * 3 + 2] = from[x * 4 + 2];
    }
}

// Rows are worked on in blocks of a fixed size, which compilers turn into vector code. A row has a block of zeros
// before it, the pixel left of the first, and zeros behind it up to a whole block.
constexpr std::size_t kBlock = 16;

std::size_t wholeBlocks(std::size_t size) { return (size + kBlock - 1) / kBlock * kBlock; }

unsigned blockCost(const std::uint8_t* row, const std::uint8_t* predicted) {
    unsigned cost = 0;
    for (std::size_t i = 0; i < kBlock; ++i) {
        const std::uint8_t difference = std::uint8_t(row[i] - predicted[i]);
        cost += std::min(difference, std::uint8_t(-difference));
    }
    return cost;
}

// Writes the filter byte and the filtered row to `to`, and up to a block behind it.
void filterRow(const std::uint8_t* row, const std::uint8_t* above, std::size_t size, std::size_t pixelBytes,
               std::uint8_t* to) {
    unsigned subCost = 0, upCost = 0;
    for (std::size_t i = 0; i < size; i += kBlock) {
        subCost += blockCost(row + i, row + i - pixelBytes);
        upCost += blockCost(row + i, above + i);
    }
    const bool up = upCost <= subCost;
    *to++ = up ? kFilterUp : kFilterSub;
    const std::uint8_t* predicted = up ? above : row - pixelBytes;
    for (std::size_t block = 0; block < size; block += kBlock)
        for (std::size_t i = 0; i < kBlock; ++i) to[block + i] = std::uint8_t(row[block + i] - predicted[block + i]);
}

struct Strip {
    std::vector<std::uint8_t> deflated;
    std::size_t filteredSize = 0;
    uLong adler = 0;
};

void deflateStrip(Bytef* filtered, std::size_t size, bool last, Strip& strip) {
    strip.filteredSize = size;
    strip.adler = adler32_z(adler32_z(0, nullptr, 0), filtered, size);
    z_stream stream = {};
    constexpr int kRawWindowBits = -15, kMemoryLevel = 9;
    SHOAL_ASSERT_EQ(deflateInit2(&stream, kDeflateLevel, Z_DEFLATED, kRawWindowBits, kMemoryLevel, Z_DEFAULT_STRATEGY),
                    Z_OK);
    constexpr std::size_t kFlushBytes = 16;  // the marker of Z_SYNC_FLUSH, generously
    strip.deflated.resize(deflateBound(&stream, uLong(size)) + kFlushBytes);
    stream.next_in = filtered;
    stream.avail_in = uInt(size);
    stream.next_out = strip.deflated.data();
    stream.avail_out = uInt(strip.deflated.size());
    const int code = deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
    SHOAL_ASSERT_EQ(code, last ? Z_STREAM_END : Z_OK);
    strip.deflated.resize(stream.total_out);
    deflateEnd(&stream);
}

std::vector<Strip> encodeStrips(const ByteImage& image, bool withAlpha) {
    const std::size_t pixelBytes = withAlpha ? 4 : 3;
    const std::size_t rowBytes = std::size_t(image.width) * pixelBytes;
    const std::size_t rowsPerStrip = std::max<std::size_t>(1, kStripBytes / (rowBytes + 1));
    const std::size_t height = std::size_t(image.height);
    std::vector<Strip> strips((height + rowsPerStrip - 1) / rowsPerStrip);
    parallelFor(strips.size(), 1, [&](std::size_t s) {
        const std::size_t first = s * rowsPerStrip, end = std::min(height, first + rowsPerStrip);
        const std::size_t size = (rowBytes + 1) * (end - first);
        std::vector<std::uint8_t> filtered(size + kBlock);
        std::vector<std::uint8_t> row(kBlock + wholeBlocks(rowBytes)), above(row.size());
        if (first > 0) packRow(image, int(first) - 1, withAlpha, above.data() + kBlock);
        for (std::size_t y = first; y < end; ++y) {
            packRow(image, int(y), withAlpha, row.data() + kBlock);
            filterRow(row.data() + kBlock, above.data() + kBlock, rowBytes, pixelBytes,
                      filtered.data() + (y - first) * (rowBytes + 1));
            std::swap(row, above);
        }
        deflateStrip(filtered.data(), size, s + 1 == strips.size(), strips[s]);
    });
    return strips;
}

class ByteWriter {
public:
    void u8(std::uint8_t value) { bytes.push_back(std::byte(value)); }
    void u32(std::uint32_t value) {
        for (int shift = 24; shift >= 0; shift -= 8) u8(std::uint8_t(value >> shift));
    }
    void append(const void* data, std::size_t size) {
        const auto* from = static_cast<const std::byte*>(data);
        bytes.insert(bytes.end(), from, from + size);
    }
    // A chunk's length goes before it and its checksum, of type and data, behind it.
    void beginChunk(const char* type, std::size_t size) {
        u32(std::uint32_t(size));
        start_ = bytes.size();
        append(type, 4);
    }
    void endChunk() {
        const auto* from = reinterpret_cast<const Bytef*>(bytes.data() + start_);
        u32(std::uint32_t(crc32_z(crc32_z(0, nullptr, 0), from, bytes.size() - start_)));
    }
    std::vector<std::byte> bytes;

private:
    std::size_t start_ = 0;
};

}  // namespace

Result<ImageInfo> pngInfo(Bytes bytes, const std::string& name) {
    PngReader reader(bytes);
    SHOAL_TRY(openPng(reader, name));
    ImageInfo info{ImageFormat::png,
                   int(png_get_image_width(reader.png, reader.info)),
                   int(png_get_image_height(reader.png, reader.info)),
                   int(png_get_channels(reader.png, reader.info)),
                   {}};
    const int type = png_get_color_type(reader.png, reader.info);
    info.details = fmt::format("{} bit{}{}", png_get_bit_depth(reader.png, reader.info),
                               type == PNG_COLOR_TYPE_PALETTE ? ", palette" : "",
                               png_get_interlace_type(reader.png, reader.info) ? ", interlaced" : "");
    if (type == PNG_COLOR_TYPE_PALETTE) info.channelCount = 3;
    if (png_get_valid(reader.png, reader.info, PNG_INFO_tRNS)) info.channelCount = 4;
    return info;
}

Result<ByteImage> decodePng(Bytes bytes, const std::string& name) {
    PngReader reader(bytes);
    SHOAL_TRY(openPng(reader, name));
    if (!setLayout(reader, PngLayout::rgba8)) return pngError(reader, name);
    ByteImage image(int(png_get_image_width(reader.png, reader.info)),
                    int(png_get_image_height(reader.png, reader.info)));
    SHOAL_TRY(readPixels(reader, image.pixels.data(), std::size_t(image.width) * 4, name));
    return image;
}

Result<Image> decodePngLinear(Bytes bytes, const std::string& name) {
    PngReader reader(bytes);
    SHOAL_TRY(openPng(reader, name));
    if (!setLayout(reader, PngLayout::natural)) return pngError(reader, name);
    const int channels = png_get_channels(reader.png, reader.info);
    const bool wide = png_get_bit_depth(reader.png, reader.info) == 16;
    const std::size_t width = png_get_image_width(reader.png, reader.info);
    const std::size_t height = png_get_image_height(reader.png, reader.info);

    std::vector<std::uint16_t> stored((width * height * std::size_t(channels) * (wide ? 2 : 1) + 1) / 2);
    auto* const storedBytes = reinterpret_cast<std::uint8_t*>(stored.data());
    SHOAL_TRY(readPixels(reader, storedBytes, width * std::size_t(channels) * (wide ? 2 : 1), name));

    std::vector<float> linear(wide ? 65536 : 256);
    const float largest = float(linear.size() - 1);
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = linearFromSrgb(float(i) / largest);
    Image image(int(width), int(height), channels);
    image.channelNames = channels == 1   ? std::vector<std::string>{"Y"}
                         : channels == 3 ? std::vector<std::string>{"R", "G", "B"}
                                         : std::vector<std::string>{"R", "G", "B", "A"};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const std::size_t value = wide ? stored[i] : storedBytes[i];
        image.pixels[i] = channels == 4 && i % 4 == 3 ? float(value) / largest : linear[value];
    }
    return image;
}

std::vector<std::byte> encodePng(const ByteImage& image, bool withAlpha) {
    const std::vector<Strip> strips = encodeStrips(image, withAlpha);
    constexpr std::size_t kZlibHeader = 2, kZlibTrailer = 4;
    std::size_t size = kZlibHeader + kZlibTrailer;
    uLong adler = adler32_z(0, nullptr, 0);
    for (const Strip& strip : strips) {
        size += strip.deflated.size();
        adler = adler32_combine(adler, strip.adler, z_off_t(strip.filteredSize));
    }

    ByteWriter png;
    constexpr std::size_t kOtherChunks = 128;
    png.bytes.reserve(size + kOtherChunks);
    png.append("\x89PNG\r\n\x1a\n", 8);
    png.beginChunk("IHDR", 13);
    png.u32(std::uint32_t(image.width));
    png.u32(std::uint32_t(image.height));
    png.u8(8);  // bits
    png.u8(withAlpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB);
    for (int i = 0; i < 3; ++i) png.u8(0);  // deflate, adaptive filters, not interlaced
    png.endChunk();
    png.beginChunk("sRGB", 1);
    png.u8(PNG_sRGB_INTENT_PERCEPTUAL);
    png.endChunk();
    png.beginChunk("IDAT", size);
    png.u8(0x78), png.u8(0x01);  // 32 KiB window, fastest
    for (const Strip& strip : strips) png.append(strip.deflated.data(), strip.deflated.size());
    png.u32(std::uint32_t(adler));
    png.endChunk();
    png.beginChunk("IEND", 0);
    png.endChunk();
    return std::move(png.bytes);
}

}  // namespace shoal::io
