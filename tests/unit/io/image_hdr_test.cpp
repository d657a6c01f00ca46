#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#include <stb/stb_image.h>

#include <shoal/io/file.h>
#include <shoal/io/image.h>

namespace shoal::io {
namespace {

std::vector<std::byte> hdr(std::string header, const std::vector<int>& data) {
    std::vector<std::byte> bytes;
    for (const char c : header) bytes.push_back(std::byte(c));
    for (const int value : data) bytes.push_back(std::byte(value));
    return bytes;
}

const std::string kStart = "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\n";

TEST(ImageHdr, ReadsFlatPixels) {
    const auto image = readImage(hdr(kStart + "\n-Y 1 +X 2\n", {128, 64, 32, 129, 255, 0, 0, 128}), "h");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->pixels, (std::vector<float>{1, 0.5f, 0.25f, 255.0f / 256, 0, 0}));
}

TEST(ImageHdr, ReadsBothRunLengths) {
    // New: eight pixels, red in a run, green in a run and a stretch, blue and the exponent in runs.
    const auto fresh =
        readImage(hdr(kStart + "\n-Y 1 +X 8\n", {2, 2, 0, 8, 136, 128, 134, 64, 2, 1, 2, 136, 0, 136, 129}), "h");
    ASSERT_TRUE(fresh) << fresh.error().message;
    EXPECT_EQ(fresh->at(7, 0)[0], 1);
    EXPECT_EQ(fresh->at(5, 0)[1], 0.5f);
    EXPECT_EQ(fresh->at(6, 0)[1], 1.0f / 128);
    EXPECT_EQ(fresh->at(7, 0)[1], 2.0f / 128);
    // Old: one pixel, then three more of it.
    const auto old = readImage(hdr(kStart + "\n-Y 1 +X 5\n", {128, 64, 32, 129, 1, 1, 1, 3, 10, 10, 10, 129}), "h");
    ASSERT_TRUE(old) << old.error().message;
    EXPECT_EQ(old->at(3, 0)[1], 0.5f);
    EXPECT_EQ(old->at(4, 0)[0], 10.0f / 128);
}

TEST(ImageHdr, HonoursExposureAndOrientation) {
    const auto exposed = readImage(hdr(kStart + "EXPOSURE=2\nEXPOSURE= 4.0\n\n-Y 1 +X 1\n", {128, 64, 32, 129}), "h");
    ASSERT_TRUE(exposed) << exposed.error().message;
    EXPECT_EQ(exposed->pixels[0], 0.125f);
    const auto turned = readImage(hdr(kStart + "\n+Y 2 -X 1\n", {128, 0, 0, 129, 0, 128, 0, 129}), "h");
    ASSERT_TRUE(turned);
    EXPECT_EQ(turned->pixels, (std::vector<float>{0, 1, 0, 1, 0, 0}));  // the first line of the file is the lowest
}

TEST(ImageHdr, SaysWhatIsWrong) {
    const std::string size = "\n-Y 1 +X 8\n";
    EXPECT_FALSE(readImage(hdr(kStart, {}), "h"));
    EXPECT_FALSE(readImage(hdr(kStart + size, {2, 2, 0, 9, 136, 1, 136, 1, 136, 1, 136, 1}), "h"));  // another width
    EXPECT_FALSE(readImage(hdr(kStart + size, {2, 2, 0, 8, 137, 1, 136, 1, 136, 1, 136, 1}), "h"));  // a run too long
    EXPECT_FALSE(readImage(hdr(kStart + size, {2, 2, 0, 8, 0, 1, 136, 1, 136, 1, 136, 1}), "h"));    // a run of none
    EXPECT_FALSE(readImage(hdr(kStart + size, {2, 2, 0, 8, 136, 1, 136, 1}), "h"));                  // cut short
    EXPECT_FALSE(readImage(hdr(kStart + size, {1, 1, 1, 8}), "h"));                                  // repeats nothing
    EXPECT_FALSE(readImage(hdr(kStart + "EXPOSURE=0\n" + size, {}), "h"));
    EXPECT_FALSE(readImage(hdr(kStart + "\n-Y 16384 +X 16384\n", {1, 2, 3, 4}), "h"));
    EXPECT_FALSE(readImage(hdr(kStart + "\n-Y -5 +X 8\n", {1, 2, 3, 4}), "h"));
    EXPECT_FALSE(readImage(hdr("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n" + size, {}), "h"));
}

// Another reader gets the same numbers from real files.
TEST(ImageHdr, AgreesWithStb) {
    const std::filesystem::path folder = std::filesystem::path(SHOAL_DATA_DIR) / "environments";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data at " << folder;
    int fileCount = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".hdr") continue;
        ++fileCount;
        const auto ours = readImage(entry.path());
        ASSERT_TRUE(ours) << ours.error().message;
        int width = 0, height = 0, channels = 0;
        float* theirs = stbi_loadf(entry.path().c_str(), &width, &height, &channels, 3);
        ASSERT_NE(theirs, nullptr);
        ASSERT_EQ(width, ours->width);
        ASSERT_EQ(height, ours->height);
        for (std::size_t i = 0; i < ours->pixels.size(); ++i)
            ASSERT_EQ(ours->pixels[i], theirs[i]) << entry.path() << " " << i;
        stbi_image_free(theirs);
    }
    EXPECT_EQ(fileCount, 5);
}

}  // namespace
}  // namespace shoal::io
