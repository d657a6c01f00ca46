// Small pictures in every kind a reader may meet, made with OpenEXR and libpng themselves, not with our writers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <png.h>

namespace shoal::test {

class MemoryOutput final : public Imf::OStream {
public:
    MemoryOutput() : OStream("sample") {}
    void write(const char from[], int count) override {
        if (at_ + std::size_t(count) > bytes.size()) bytes.resize(at_ + std::size_t(count));
        std::memcpy(bytes.data() + at_, from, std::size_t(count));
        at_ += std::size_t(count);
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t at) override { at_ = std::size_t(at); }
    std::vector<std::byte> bytes;

private:
    std::size_t at_ = 0;
};

// A smooth colour, the same for every sample: channel c at (x, y) of a picture of any size.
inline float sampleValue(int x, int y, int c) { return 0.25f + 0.01f * float(x) + 0.02f * float(y) + 0.3f * float(c); }

// R, G, B at every pixel of the data window, `values` wide and high.
inline std::vector<float> sampleRgb(const Imath::Box2i& window) {
    std::vector<float> values;
    for (int y = window.min.y; y <= window.max.y; ++y)
        for (int x = window.min.x; x <= window.max.x; ++x)
            for (int c = 0; c < 3; ++c) values.push_back(sampleValue(x, y, c));
    return values;
}

inline Imf::FrameBuffer rgbBuffer(std::vector<float>& values, const Imath::Box2i& window,
                                  const std::string& prefix = "") {
    Imf::FrameBuffer buffer;
    const char* names[] = {"R", "G", "B"};
    const std::size_t width = std::size_t(window.max.x - window.min.x + 1);
    for (std::size_t c = 0; c < 3; ++c)
        buffer.insert(prefix + names[c], Imf::Slice::Make(Imf::FLOAT, values.data() + c, window, 12, 12 * width));
    return buffer;
}

struct ExrSample {
    Imf::Compression compression = Imf::ZIP_COMPRESSION;
    bool tiled = false, mipmapped = false;
    Imath::Box2i display = {{0, 0}, {23, 15}}, data = {{0, 0}, {23, 15}};
};

// R, G, B as float32.
inline std::vector<std::byte> makeExr(const ExrSample& sample) {
    Imf::Header header(sample.display, sample.data, 1, {0, 0}, 1, Imf::INCREASING_Y, sample.compression);
    for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    std::vector<float> values = sampleRgb(sample.data);
    MemoryOutput out;
    if (sample.tiled) {
        header.setTileDescription(Imf::TileDescription(8, 8, sample.mipmapped ? Imf::MIPMAP_LEVELS : Imf::ONE_LEVEL));
        Imf::TiledOutputFile file(out, header);
        file.setFrameBuffer(rgbBuffer(values, sample.data));
        for (int level = 0; level < file.numLevels(); ++level)
            file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
    } else {
        Imf::OutputFile file(out, header);
        file.setFrameBuffer(rgbBuffer(values, sample.data));
        file.writePixels(sample.data.max.y - sample.data.min.y + 1);
    }
    return out.bytes;
}

// Two parts: "rgba" with R, G, B and "depth" with Z (sampleValue of channel 7), as Nuke writes them.
inline std::vector<std::byte> makeTwoPartExr() {
    const Imath::Box2i window{{0, 0}, {23, 15}};
    Imf::Header headers[2] = {Imf::Header(24, 16), Imf::Header(24, 16)};
    headers[0].setName("rgba");
    headers[1].setName("depth");
    for (Imf::Header& header : headers) header.setType(Imf::SCANLINEIMAGE);
    for (const char* name : {"R", "G", "B"}) headers[0].channels().insert(name, Imf::Channel(Imf::FLOAT));
    headers[1].channels().insert("Z", Imf::Channel(Imf::FLOAT));
    std::vector<float> rgb = sampleRgb(window), depth;
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x) depth.push_back(sampleValue(x, y, 7));
    MemoryOutput out;
    {
        Imf::MultiPartOutputFile file(out, headers, 2);
        Imf::OutputPart first(file, 0), second(file, 1);
        first.setFrameBuffer(rgbBuffer(rgb, window));
        first.writePixels(16);
        Imf::FrameBuffer buffer;
        buffer.insert("Z", Imf::Slice::Make(Imf::FLOAT, depth.data(), window));
        second.setFrameBuffer(buffer);
        second.writePixels(16);
    }
    return out.bytes;
}

struct PngSample {
    int width = 1, height = 1, bits = 8, colorType = PNG_COLOR_TYPE_RGB;
    bool interlaced = false;
    std::vector<png_color> palette = {};
    std::vector<png_byte> paletteAlpha = {};
};

// `rows`: packed bytes as PNG stores them (16 bit: high byte first), all rows one after another.
inline std::vector<std::byte> makePng(const PngSample& sample, std::vector<std::uint8_t> rows) {
    std::vector<std::byte> bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &bytes,
        [](png_structp p, png_bytep from, std::size_t size) {
            auto& to = *static_cast<std::vector<std::byte>*>(png_get_io_ptr(p));
            to.insert(to.end(), reinterpret_cast<std::byte*>(from), reinterpret_cast<std::byte*>(from) + size);
        },
        nullptr);
    png_set_IHDR(png, info, png_uint_32(sample.width), png_uint_32(sample.height), sample.bits, sample.colorType,
                 sample.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (!sample.palette.empty()) png_set_PLTE(png, info, sample.palette.data(), int(sample.palette.size()));
    if (!sample.paletteAlpha.empty())
        png_set_tRNS(png, info, sample.paletteAlpha.data(), int(sample.paletteAlpha.size()), nullptr);
    std::vector<png_bytep> pointers;
    const std::size_t rowBytes = rows.size() / std::size_t(sample.height);
    for (int y = 0; y < sample.height; ++y) pointers.push_back(rows.data() + std::size_t(y) * rowBytes);
    png_set_rows(png, info, pointers.data());
    png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

}  // namespace shoal::test
