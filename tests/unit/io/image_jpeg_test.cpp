#include <cmath>

#include <gtest/gtest.h>

#include <shoal/io/file.h>
#include <shoal/io/image.h>

#include "support/test_folder.h"

namespace shoal::io {
namespace {

using test::TestFolder;

ByteImage gradient(int width, int height, bool grey) {
    ByteImage image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::uint8_t* pixel = image.pixels.data() + (y * width + x) * 4;
            pixel[0] = std::uint8_t(255 * x / width);
            pixel[1] = grey ? pixel[0] : std::uint8_t(255 * y / height);
            pixel[2] = grey ? pixel[0] : std::uint8_t(128 + 60 * std::sin(0.05 * (x + y)));
            pixel[3] = 255;
        }
    }
    return image;
}

double rmse(const ByteImage& a, const ByteImage& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(double(a.pixels[i]) - double(b.pixels[i]), 2);
    return std::sqrt(sum / double(a.pixels.size()));
}

TEST(ImageJpeg, ComesBackCloseAndCloserWithQuality) {
    const TestFolder folder;
    const ByteImage image = gradient(203, 117, false);  // neither is a multiple of 8
    double last = 0;
    std::uintmax_t lastSize = 0;
    for (const int quality : {100, 90, 50, 5}) {
        ASSERT_TRUE(writeJpeg(folder / "a.jpg", image, quality));
        const auto back = readByteImage(folder / "a.jpg");
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(back->width, 203);
        ASSERT_EQ(back->height, 117);
        const double error = rmse(image, *back);
        EXPECT_LT(error, quality >= 90 ? 1.0 : quality == 50 ? 4.0 : 20.0) << quality;
        EXPECT_GT(error, last);
        const std::uintmax_t size = std::filesystem::file_size(folder / "a.jpg");
        if (lastSize > 0) {
            EXPECT_LT(size, lastSize);
        }
        last = error;
        lastSize = size;
    }
}

TEST(ImageJpeg, DecodesToLinear) {
    const TestFolder folder;
    ByteImage image(16, 16);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 128;
    ASSERT_TRUE(writeJpeg(folder / "a.jpg", image, 100));
    const auto linear = readImage(folder / "a.jpg");
    ASSERT_TRUE(linear);
    EXPECT_EQ(linear->channelCount, 3);
    EXPECT_NEAR(linear->pixels[0], linearFromSrgb(128.0f / 255.0f), 0.01f);
    const auto info = readImageInfo(folder / "a.jpg");
    ASSERT_TRUE(info);
    EXPECT_EQ(info->details, "8 bit, 4:4:4");
}

TEST(ImageJpeg, FindsMissingEnds) {
    const TestFolder folder;
    ASSERT_TRUE(writeJpeg(folder / "a.jpg", gradient(64, 64, false), 80));
    const auto bytes = readFile(folder / "a.jpg");
    for (std::size_t size = 3; size < bytes->size() - 2; size += 7)  // the end mark alone may be missing
        EXPECT_FALSE(decodeImage(std::span(*bytes).first(size), "j")) << size;
}

TEST(ImageJpeg, RefusesHugeHeadersBeforeTakingMemory) {
    const TestFolder folder;
    ASSERT_TRUE(writeJpeg(folder / "a.jpg", gradient(8, 8, false), 80));
    auto bytes = readFile(folder / "a.jpg");
    std::size_t frame = 0;  // behind the mark FF C0: length, precision, height, width
    while (bytes->at(frame) != std::byte(0xff) || bytes->at(frame + 1) != std::byte(0xc0)) ++frame;
    for (const std::size_t i : {5, 7})
        bytes->at(frame + i) = std::byte(0x40), bytes->at(frame + i + 1) = std::byte(0);  // 16384
    EXPECT_NE(decodeImage(*bytes, "j").error().message.find("cut short"), std::string::npos);
    bytes->at(frame + 5) = std::byte(0xff);
    EXPECT_NE(decodeImage(*bytes, "j").error().message.find("the limit is 16384"), std::string::npos);
}

}  // namespace
}  // namespace shoal::io
