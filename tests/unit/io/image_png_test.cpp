#include <random>

#include <gtest/gtest.h>

#include <shoal/core/parallel.h>
#include <shoal/io/file.h>
#include <shoal/io/image.h>

#include "support/picture_samples.h"
#include "support/test_folder.h"

namespace shoal::io {
namespace {

using test::makePng;
using test::PngSample;
using test::TestFolder;

ByteImage noise(int width, int height, unsigned range) {
    ByteImage image(width, height);
    std::mt19937 random(7);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = std::uint8_t(i / 64 + random() % range);
    return image;
}

ByteImage opaque(ByteImage image) {
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
    return image;
}

TEST(ImagePng, KeepsEveryByte) {
    const TestFolder folder;
    struct Size {
        int width, height;
    };
    // The last two are deflated in several strips, one of them with a row longer than a strip.
    for (const auto [width, height] : {Size{1, 1}, Size{3, 2}, Size{1, 300}, Size{640, 480}, Size{16384, 7}}) {
        for (const unsigned range : {1u, 5u, 256u}) {
            const ByteImage image = noise(width, height, range);
            ASSERT_TRUE(writePng(folder / "a.png", image, true));
            ASSERT_TRUE(writePng(folder / "o.png", image));
            const auto withAlpha = readByteImage(folder / "a.png"), without = readByteImage(folder / "o.png");
            ASSERT_TRUE(withAlpha) << withAlpha.error().message;
            ASSERT_TRUE(without) << without.error().message;
            EXPECT_EQ(withAlpha->width, width);
            EXPECT_EQ(withAlpha->height, height);
            EXPECT_EQ(withAlpha->pixels, image.pixels);
            EXPECT_EQ(without->pixels, opaque(image).pixels);
        }
    }
    const auto info = readImageInfo(folder / "a.png");
    ASSERT_TRUE(info);
    EXPECT_EQ(info->format, ImageFormat::png);
    EXPECT_EQ(info->channelCount, 4);
    EXPECT_EQ(info->details, "8 bit");
}

TEST(ImagePng, IsTheSameForAnyNumberOfThreads) {
    const TestFolder folder;
    const ByteImage image = noise(900, 700, 40);
    {
        const ThreadLimit one(1);
        ASSERT_TRUE(writePng(folder / "one.png", image));
    }
    const ThreadLimit four(4);
    ASSERT_TRUE(writePng(folder / "four.png", image));
    EXPECT_EQ(*readFile(folder / "one.png"), *readFile(folder / "four.png"));
}

TEST(ImagePng, DecodesToLinear) {
    const std::vector<std::byte> png = makePng({.width = 2}, {0, 128, 255, 10, 20, 30});
    const auto image = readImage(png, "p");
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->channelCount, 3);
    EXPECT_EQ(image->channelNames, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(image->pixels[0], 0);
    EXPECT_FLOAT_EQ(image->pixels[1], linearFromSrgb(128.0f / 255.0f));
    EXPECT_EQ(image->pixels[2], 1);
    EXPECT_NEAR(image->pixels[1], 0.2158605f, 1e-6f);  // IEC 61966-2-1
}

TEST(ImagePng, KeepsSixteenBits) {
    const PngSample sample{.width = 3, .bits = 16, .colorType = PNG_COLOR_TYPE_GRAY};
    const auto image = readImage(makePng(sample, {0x30, 0x39, 0x30, 0x3a, 0xff, 0xff}), "p");  // 12345, 12346, 65535
    ASSERT_TRUE(image);
    ASSERT_EQ(image->channelCount, 1);
    EXPECT_NEAR(image->pixels[0], std::pow((12345.0 / 65535 + 0.055) / 1.055, 2.4), 2e-7);
    EXPECT_NEAR(image->pixels[1], std::pow((12346.0 / 65535 + 0.055) / 1.055, 2.4), 2e-7);
    EXPECT_GT(image->pixels[1], image->pixels[0]);
    EXPECT_EQ(image->pixels[2], 1);
}

TEST(ImagePng, ReadsEveryColorType) {
    const std::vector<std::uint8_t> black = {0, 0, 0, 255};
    const PngSample oneBit{.width = 8, .bits = 1, .colorType = PNG_COLOR_TYPE_GRAY};
    const auto bits = decodeImage(makePng(oneBit, {0b01000000}), "p");
    ASSERT_TRUE(bits);
    EXPECT_EQ(std::vector<std::uint8_t>(bits->pixels.begin(), bits->pixels.begin() + 8),
              (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 255, 255, 255}));

    const PngSample greyAlpha{.width = 1, .colorType = PNG_COLOR_TYPE_GRAY_ALPHA};
    EXPECT_EQ(decodeImage(makePng(greyAlpha, {40, 100}), "p")->pixels, (std::vector<std::uint8_t>{40, 40, 40, 100}));
    const auto linear = readImage(makePng(greyAlpha, {40, 100}), "p");
    ASSERT_TRUE(linear);
    EXPECT_EQ(linear->channelCount, 4);
    EXPECT_FLOAT_EQ(linear->pixels[3], 100.0f / 255.0f);  // alpha is not sRGB

    const PngSample palette{
        .width = 2, .colorType = PNG_COLOR_TYPE_PALETTE, .palette = {{9, 8, 7}, {1, 2, 3}}, .paletteAlpha = {50}};
    EXPECT_EQ(decodeImage(makePng(palette, {0, 1}), "p")->pixels,
              (std::vector<std::uint8_t>{9, 8, 7, 50, 1, 2, 3, 255}));

    const PngSample wide{.width = 1, .bits = 16, .colorType = PNG_COLOR_TYPE_RGB_ALPHA};
    EXPECT_EQ(decodeImage(makePng(wide, {255, 255, 0, 0, 128, 128, 64, 64}), "p")->pixels,
              (std::vector<std::uint8_t>{255, 0, 128, 64}));
}

TEST(ImagePng, ReadsInterlacedFiles) {
    std::vector<std::uint8_t> rows;
    for (int i = 0; i < 13 * 9 * 3; ++i) rows.push_back(std::uint8_t(i * 5));
    PngSample sample{.width = 13, .height = 9};
    const auto plain = decodeImage(makePng(sample, rows), "p");
    sample.interlaced = true;
    const auto interlaced = decodeImage(makePng(sample, rows), "p");
    ASSERT_TRUE(plain && interlaced);
    EXPECT_EQ(plain->pixels, interlaced->pixels);
    EXPECT_EQ(plain->pixels[4], rows[3]);
}

TEST(ImagePng, FindsDamage) {
    const std::vector<std::byte> png = makePng({.width = 2}, {0, 128, 255, 10, 20, 30});
    for (std::size_t size = 0; size < png.size(); ++size)
        EXPECT_FALSE(decodeImage(std::span(png).first(size), "p")) << size;
    for (std::size_t i = 16; i < png.size() - 4; ++i) {  // every chunk has a checksum
        std::vector<std::byte> damaged = png;
        damaged[i] ^= std::byte(0x20);  // in a chunk's name it is the bit that makes it optional or not
        const auto image = decodeImage(damaged, "p");
        if (image) {
            EXPECT_EQ(image->pixels, decodeImage(png, "p")->pixels) << i;
        }
    }
}

TEST(ImagePng, RefusesHugeHeadersBeforeTakingMemory) {
    // 16384 x 16384 with no data behind: 1 GiB of pixels from 60 bytes.
    std::vector<std::byte> png = makePng({.width = 1}, {0, 0, 0});
    const auto setSize = [&](std::uint32_t width, std::uint32_t height) {
        for (std::size_t i = 0; i < 4; ++i) {
            png[16 + i] = std::byte(width >> (24 - 8 * i) & 0xff);
            png[20 + i] = std::byte(height >> (24 - 8 * i) & 0xff);
        }
        std::uint32_t crc = 0xffffffff;
        for (std::size_t i = 12; i < 29; ++i) {
            crc ^= std::to_integer<std::uint32_t>(png[i]);
            for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
        }
        for (std::size_t i = 0; i < 4; ++i) png[29 + i] = std::byte(~crc >> (24 - 8 * i) & 0xff);
    };
    setSize(16384, 16384);
    EXPECT_NE(decodeImage(png, "p").error().message.find("cut short"), std::string::npos);
    setSize(16385, 1);
    EXPECT_NE(decodeImage(png, "p").error().message.find("the limit is 16384"), std::string::npos);
    setSize(0x7fffffff, 0x7fffffff);
    EXPECT_NE(decodeImage(png, "p").error().message.find("the limit is 16384"), std::string::npos);
    setSize(0, 1);
    EXPECT_FALSE(decodeImage(png, "p"));
}

TEST(ImagePng, LeavesTheOldFileWhenItCannotWrite) {
    const TestFolder folder;
    const ByteImage image = noise(4, 4, 9);
    ASSERT_TRUE(writePng(folder / "a.png", image));
    const auto before = readFile(folder / "a.png");
    EXPECT_FALSE(writePng(folder / "a.png", ByteImage()));  // zero size
    EXPECT_FALSE(writePng(folder / "a.png/b.png", image));
    EXPECT_EQ(*readFile(folder / "a.png"), *before);
    EXPECT_FALSE(writeByteImage(folder / "a.tiff", image));
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(Image, IsKnownByContentAndByName) {
    EXPECT_EQ(imageFormatOf(std::filesystem::path("a.PNG")), ImageFormat::png);
    EXPECT_EQ(imageFormatOf(std::filesystem::path("a.b.jpeg")), ImageFormat::jpeg);
    EXPECT_EQ(imageFormatOf(std::filesystem::path("a.exr")), ImageFormat::exr);
    EXPECT_EQ(imageFormatOf(std::filesystem::path("a.txt")), std::nullopt);
    const TestFolder folder;
    ASSERT_TRUE(writeFileAtomically(folder / "a.png", "this is no image"));
    EXPECT_NE(readImage(folder / "a.png").error().message.find("not an image"), std::string::npos);
    EXPECT_NE(readByteImage(folder / "a.png").error().message.find("expected PNG or JPEG"), std::string::npos);
    ASSERT_TRUE(writeByteImage(folder / "j.jpg", noise(8, 8, 3)));
    std::filesystem::rename(folder / "j.jpg", folder / "j.png");  // a wrong extension does no harm
    EXPECT_EQ(readImageInfo(folder / "j.png")->format, ImageFormat::jpeg);
    EXPECT_TRUE(readByteImage(folder / "j.png"));
}

TEST(Image, QuantizesToNearest) {
    Image image(4, 1, 3);
    image.pixels = {0,    1,    0.5f,    -1, 2, std::nanf(""), 0.5f / 255 - 1e-5f, 0.5f / 255 + 1e-5f, 254.4f / 255,
                    0.1f, 0.2f, INFINITY};
    EXPECT_EQ(quantize(image).pixels,
              (std::vector<std::uint8_t>{0, 255, 128, 255, 0, 255, 0, 255, 0, 1, 254, 255, 26, 51, 255, 255}));
    Image grey(1, 1, 1);
    grey.pixels = {1};
    EXPECT_EQ(quantize(grey).pixels, (std::vector<std::uint8_t>{255, 255, 255, 255}));
}

}  // namespace
}  // namespace shoal::io
