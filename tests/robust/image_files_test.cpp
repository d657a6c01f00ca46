// Damaged picture, asset and pose files: every reader returns, with a value or with one line. 2,000 of each, the same
// on every run.
#include <cmath>
#include <functional>

#include <gtest/gtest.h>
#include <zlib.h>

#include <shoal/io/asset.h>
#include <shoal/io/file.h>
#include <shoal/io/image.h>
#include <shoal/io/poses.h>

#include "support/mutate.h"
#include "support/picture_samples.h"
#include "support/test_folder.h"

namespace shoal::io {
namespace {

constexpr std::uint32_t kCount = 2000;

using Reader = std::function<std::string(std::span<const std::byte>)>;  // the error, or ""

// `read` returns for every damaged copy; some are refused, and every error is one line that names the file.
void expectSurvives(std::span<const std::byte> original, std::size_t protectedBytes, const Reader& read,
                    std::uint32_t count = kCount, const std::function<void(std::vector<std::byte>&)>& repair = {}) {
    ASSERT_EQ(read(original), "");
    std::uint32_t refused = 0;
    for (std::uint32_t seed = 0; seed < count; ++seed) {
        std::vector<std::byte> damaged = test::mutate(original, seed, protectedBytes);
        if (repair) repair(damaged);
        const std::string error = read(damaged);
        if (error.empty()) continue;
        ++refused;
        ASSERT_EQ(error.find("sample"), 0u) << error;
        ASSERT_EQ(error.find('\n'), std::string::npos) << error;
    }
    EXPECT_GT(refused, count / 20);
}

std::string readPicture(std::span<const std::byte> bytes) {
    const auto image = readImage(bytes, "sample");
    if (!image) return image.error().message;
    EXPECT_EQ(image->pixels.size(),
              std::size_t(image->width) * std::size_t(image->height) * std::size_t(image->channelCount));
    return "";
}

std::string readTexture(std::span<const std::byte> bytes) {
    const auto image = decodeImage(bytes, "sample");
    return image ? "" : image.error().message;
}

// Makes all checksums right again, so that damage reaches what lies behind them.
void repairPng(std::vector<std::byte>& png) {
    for (std::size_t at = 8; at + 12 <= png.size();) {
        std::size_t size = 0;
        for (std::size_t i = 0; i < 4; ++i) size = size << 8 | std::to_integer<std::size_t>(png[at + i]);
        if (size > png.size() - at - 12) return;
        const auto* from = reinterpret_cast<const Bytef*>(png.data() + at + 4);
        const auto crc = std::uint32_t(crc32_z(0, from, size + 4));
        for (std::size_t i = 0; i < 4; ++i) png[at + 8 + size + i] = std::byte(crc >> (24 - 8 * i) & 0xff);
        at += size + 12;
    }
}

std::vector<std::uint8_t> someRows(std::size_t size) {
    std::vector<std::uint8_t> rows(size);
    for (std::size_t i = 0; i < size; ++i) rows[i] = std::uint8_t(i * i / 7);
    return rows;
}

TEST(RobustImage, Png) {
    const auto rgb = test::makePng({.width = 24, .height = 16}, someRows(24 * 16 * 3));
    const auto palette = test::makePng({.width = 24,
                                        .height = 16,
                                        .bits = 4,
                                        .colorType = PNG_COLOR_TYPE_PALETTE,
                                        .interlaced = true,
                                        .palette = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}},
                                        .paletteAlpha = {10, 20}},
                                       std::vector<std::uint8_t>(12 * 16, 0x21));
    const auto wide = test::makePng({.width = 24, .height = 16, .bits = 16, .colorType = PNG_COLOR_TYPE_GRAY_ALPHA},
                                    someRows(24 * 16 * 4));
    for (const auto& png : {rgb, palette, wide}) {
        expectSurvives(png, 8, readTexture);
        expectSurvives(png, 8, readTexture, kCount, repairPng);
        expectSurvives(png, 8, readPicture, kCount / 2, repairPng);
    }
}

TEST(RobustImage, Jpeg) {
    const test::TestFolder folder;
    ByteImage image(48, 40);
    image.pixels = someRows(image.pixels.size());
    for (const int quality : {50, 95}) {  // 4:2:0 and 4:4:4
        ASSERT_TRUE(writeJpeg(folder / "a.jpg", image, quality));
        expectSurvives(*readFile(folder / "a.jpg"), 3, readTexture);
    }
}

TEST(RobustImage, Hdr) {
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 4 +X 40\n";
    std::vector<std::byte> bytes;
    for (const char c : header) bytes.push_back(std::byte(c));
    for (int y = 0; y < 4; ++y) {
        for (const int value : {2, 2, 0, 40}) bytes.push_back(std::byte(value));
        for (int component = 0; component < 4; ++component) {
            bytes.push_back(std::byte(128 + 30));
            bytes.push_back(std::byte(120 + component));
            bytes.push_back(std::byte(10));
            for (int i = 0; i < 10; ++i) bytes.push_back(std::byte(100 + i * y));
        }
    }
    expectSurvives(bytes, 10, readPicture);
}

TEST(RobustImage, ExrOfEveryCompression) {
    for (int compression = Imf::NO_COMPRESSION; compression < Imf::NUM_COMPRESSION_METHODS; ++compression)
        expectSurvives(test::makeExr({.compression = Imf::Compression(compression)}), 4, readPicture, kCount / 5);
}

TEST(RobustImage, ExrOfTilesAndParts) {
    expectSurvives(test::makeExr({.compression = Imf::PIZ_COMPRESSION, .tiled = true}), 4, readPicture, kCount / 2);
    expectSurvives(test::makeExr({.tiled = true, .mipmapped = true}), 4, readPicture, kCount / 2);
    expectSurvives(test::makeTwoPartExr(), 4, readPicture, kCount / 2);
}

TEST(RobustImage, Asset) {
    const test::TestFolder folder;
    Asset asset;
    asset.kind = "sample";
    asset.parameters = {{"a", "1"}, {"b", "2"}};
    asset.arrays = {{"x", {"f32", {4, 4}, std::vector<std::byte>(64, std::byte(3))}},
                    {"y", {"u8", {9}, std::vector<std::byte>(9)}}};
    ASSERT_TRUE(writeAsset(folder / "a.bake", asset));
    const auto read = [](std::span<const std::byte> bytes) {
        const auto back = readAsset(bytes, "sample");
        return back ? std::string() : back.error().message;
    };
    expectSurvives(*readFile(folder / "a.bake"), 0, read);
    expectSurvives(*readFile(folder / "a.bake"), 24, read);
}

TEST(RobustImage, Poses) {
    std::string text = "time,x,y,z,tx,ty,tz\n";
    for (int i = 0; i < 30; ++i) text += std::to_string(i) + ",1.5,2,-3e2," + std::to_string(i * i) + ",7,0.25\n";
    expectSurvives(std::as_bytes(std::span(text)), 0, [](std::span<const std::byte> bytes) {
        const auto poses = parsePoses({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "sample");
        if (!poses) return poses.error().message;
        for (const CameraPose& pose : *poses) EXPECT_TRUE(std::isfinite(pose.worldFromCamera.w));
        return std::string();
    });
}

TEST(RobustImage, RandomBytesBehindEveryMagic) {
    for (const std::string_view magic :
         {std::string_view("\x89PNG\r\n\x1a\n"), std::string_view("\xff\xd8\xff"), std::string_view("#?RADIANCE\n"),
          std::string_view("\x76\x2f\x31\x01\x02\0\0\0", 8)}) {
        for (std::uint32_t seed = 0; seed < 500; ++seed) {
            std::mt19937 random(seed);
            std::vector<std::byte> bytes;
            for (const char c : magic) bytes.push_back(std::byte(c));
            for (std::size_t i = random() % 400; i > 0; --i) bytes.push_back(std::byte(random() & 0xff));
            EXPECT_NE(readPicture(bytes), "");
        }
    }
}

}  // namespace
}  // namespace shoal::io
