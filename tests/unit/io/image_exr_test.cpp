#include <cmath>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <shoal/core/compare.h>
#include <shoal/core/random.h>
#include <shoal/io/file.h>
#include <shoal/io/image.h>

#include "support/picture_samples.h"
#include "support/test_folder.h"

namespace shoal::io {
namespace {

using test::ExrSample;
using test::makeExr;
using test::sampleValue;
using test::TestFolder;

Image randomImage(int width, int height, int channels, std::uint32_t seed) {
    Image image(width, height, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = std::exp(20 * randomFloat(seed, std::uint32_t(i)) - 10);  // 5e-5 .. 2e4
    return image;
}

const Image* find(const std::vector<Layer>& layers, const std::string& name) {
    for (const Layer& layer : layers)
        if (layer.name == name) return &layer.image;
    return nullptr;
}

TEST(ImageExr, KeepsLayersAndTheirNames) {
    const TestFolder folder;
    std::vector<Layer> layers = {{"", randomImage(37, 21, 4, 1)},       {"albedo", randomImage(37, 21, 3, 2)},
                                 {"depth", randomImage(37, 21, 1, 3)},  {"motion", randomImage(37, 21, 2, 4)},
                                 {"normal", randomImage(37, 21, 3, 5)}, {"objectId", randomImage(37, 21, 1, 6)},
                                 {"shadow", randomImage(37, 21, 1, 7)}};
    for (float& id : layers[5].image.pixels) id = std::floor(id) + 16'000'000.0f;
    layers[2].image.pixels[5] = INFINITY;  // depth of the sky
    for (const ExrCompression compression : {ExrCompression::none, ExrCompression::rle, ExrCompression::zip,
                                             ExrCompression::zipScanline, ExrCompression::piz}) {
        ASSERT_TRUE(writeExr(folder / "l.exr", layers, {.halfColor = true, .compression = compression}));
        const auto back = readLayers(folder / "l.exr");
        ASSERT_TRUE(back) << back.error().message;
        ASSERT_EQ(back->size(), layers.size());
        for (std::size_t i = 0; i < layers.size(); ++i) {
            const Image &ours = layers[i].image, &theirs = (*back)[i].image;
            ASSERT_EQ((*back)[i].name, layers[i].name);
            ASSERT_EQ(theirs.channelCount, ours.channelCount);
            const bool half = layers[i].name.empty() || layers[i].name == "albedo" || layers[i].name == "shadow";
            for (std::size_t p = 0; p < ours.pixels.size(); ++p) {
                if (half) {
                    ASSERT_NEAR(theirs.pixels[p], ours.pixels[p], ours.pixels[p] * 0.0005f + 3e-8f);  // 11 bits
                } else {
                    ASSERT_EQ(theirs.pixels[p], ours.pixels[p]);
                }
            }
        }
        EXPECT_EQ((*back)[2].image.channelNames, std::vector<std::string>{"Z"});
        EXPECT_EQ((*back)[3].image.channelNames, (std::vector<std::string>{"X", "Y"}));
        EXPECT_EQ((*back)[4].image.channelNames, (std::vector<std::string>{"X", "Y", "Z"}));
        EXPECT_EQ((*back)[5].image.channelNames, std::vector<std::string>{"X"});
    }
}

// The names as OpenEXR itself gives them: what other programs see.
TEST(ImageExr, NamesChannelsAsOtherProgramsExpect) {
    const TestFolder folder;
    const std::vector<Layer> layers = {{"", Image(4, 4, 3)}, {"depth", Image(4, 4, 1)}, {"objectId", Image(4, 4, 1)}};
    ASSERT_TRUE(writeExr(folder / "l.exr", layers));
    const std::string path = (folder / "l.exr").string();
    Imf::MultiPartInputFile file(path.c_str());
    std::vector<std::string> names;
    std::vector<Imf::PixelType> types;
    const auto& channels = file.header(0).channels();
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        names.emplace_back(c.name());
        types.push_back(c.channel().type);
    }
    EXPECT_EQ(names, (std::vector<std::string>{"B", "G", "R", "depth.Z", "objectId.X"}));
    EXPECT_EQ(types, (std::vector<Imf::PixelType>{Imf::HALF, Imf::HALF, Imf::HALF, Imf::FLOAT, Imf::FLOAT}));
    std::set<std::string> layerNames;
    channels.layers(layerNames);
    EXPECT_EQ(layerNames, (std::set<std::string>{"depth", "objectId"}));
}

TEST(ImageExr, KeepsFloatsExactlyWhenAskedAndSaturatesHalfs) {
    const TestFolder folder;
    Image image = randomImage(50, 30, 3, 9);
    image.pixels[0] = 1e9f;
    image.pixels[1] = -1e9f;
    ASSERT_TRUE(writeExr(folder / "f.exr", image, {.halfColor = false}));
    EXPECT_EQ(readImage(folder / "f.exr")->pixels, image.pixels);
    ASSERT_TRUE(writeExr(folder / "h.exr", image));
    EXPECT_EQ(readImage(folder / "h.exr")->pixels[0], 65504);
    EXPECT_EQ(readImage(folder / "h.exr")->pixels[1], -65504);
    EXPECT_EQ(readImageInfo(folder / "h.exr")->details, "half, ZIP, 1 layer");
}

TEST(ImageExr, RefusesLayersThatDoNotFit) {
    const TestFolder folder;
    const std::vector<Layer> sizes = {{"", Image(4, 4, 3)}, {"depth", Image(4, 5, 1)}};
    EXPECT_NE(writeExr(folder / "l.exr", sizes).error().message.find("4 x 5"), std::string::npos);
    const std::vector<Layer> twice = {{"depth", Image(4, 4, 1)}, {"depth", Image(4, 4, 1)}};
    EXPECT_NE(writeExr(folder / "l.exr", twice).error().message.find("depth.Z"), std::string::npos);
    EXPECT_FALSE(writeExr(folder / "l.exr", Image()));
    EXPECT_EQ(folder.entryCount(), 0u);
}

void expectSample(const Image& image, int width, int height, float tolerance) {
    ASSERT_EQ(image.width, width);
    ASSERT_EQ(image.height, height);
    ASSERT_EQ(image.channelNames, (std::vector<std::string>{"R", "G", "B"}));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(image.at(x, y)[c], sampleValue(x, y, c), tolerance) << x << " " << y;
}

TEST(ImageExr, ReadsEveryCompressionInLinesAndTiles) {
    for (int compression = Imf::NO_COMPRESSION; compression < Imf::NUM_COMPRESSION_METHODS; ++compression) {
        for (const bool tiled : {false, true}) {
            const ExrSample sample{.compression = Imf::Compression(compression), .tiled = tiled};
            const auto image = readImage(makeExr(sample), "e");
            ASSERT_TRUE(image) << image.error().message;
            const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
            expectSample(*image, 24, 16, dwa ? 0.02f : compression == Imf::PXR24_COMPRESSION ? 1e-4f : 0);
        }
    }
}

TEST(ImageExr, ReadsTheLargestOfSeveralLevels) {
    // A mipmap's smaller levels are read from the same buffer by the sample's writer; only the full one counts.
    const auto image = readImage(makeExr({.tiled = true, .mipmapped = true}), "e");
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->width, 24);
    EXPECT_NEAR(image->at(23, 15)[2], sampleValue(23, 15, 2), 1e-6f);
}

TEST(ImageExr, ShowsWhatTheDisplayWindowShows) {
    // The data reach over the display's left and top, and end before its right and bottom.
    ExrSample sample;
    sample.display = {{10, 20}, {33, 35}};
    sample.data = {{5, 18}, {30, 30}};
    const auto image = readImage(makeExr(sample), "e");
    ASSERT_TRUE(image) << image.error().message;
    ASSERT_EQ(image->width, 24);
    ASSERT_EQ(image->height, 16);
    EXPECT_FLOAT_EQ(image->at(0, 0)[1], sampleValue(10, 20, 1));
    EXPECT_FLOAT_EQ(image->at(20, 10)[2], sampleValue(30, 30, 2));
    EXPECT_EQ(image->at(21, 10)[0], 0);
    EXPECT_EQ(image->at(20, 11)[0], 0);
    sample.data = {{-50, -50}, {-40, -40}};  // nothing of it is seen
    const auto outside = readImage(makeExr(sample), "e");
    ASSERT_TRUE(outside);
    for (const float value : outside->pixels) ASSERT_EQ(value, 0);
}

TEST(ImageExr, TakesPartsForLayers) {
    const auto layers = readLayers(test::makeTwoPartExr(), "e");
    ASSERT_TRUE(layers) << layers.error().message;
    ASSERT_EQ(layers->size(), 2u);
    ASSERT_NE(find(*layers, ""), nullptr);
    expectSample(*find(*layers, ""), 24, 16, 0);
    const Image* depth = find(*layers, "depth");
    ASSERT_NE(depth, nullptr);
    EXPECT_FLOAT_EQ(depth->at(3, 4)[0], sampleValue(3, 4, 7));
}

TEST(ImageExr, FindsThePictureAmongLayers) {
    const TestFolder folder;
    Image red(2, 2, 3), blue(2, 2, 3);
    red.pixels[0] = 1, blue.pixels[2] = 1;
    const std::vector<Layer> blender = {
        {"ViewLayer.AO", blue}, {"ViewLayer.Combined", red}, {"ViewLayer.Depth", Image(2, 2, 1)}};
    ASSERT_TRUE(writeExr(folder / "b.exr", blender));
    EXPECT_EQ(readImage(folder / "b.exr")->pixels[0], 1);
    const std::vector<Layer> unnamed = {{"depth", Image(2, 2, 1)}, {"light", red}};
    ASSERT_TRUE(writeExr(folder / "c.exr", unnamed));
    EXPECT_EQ(readImage(folder / "c.exr")->channelCount, 3);
    Image greyAlpha(1, 1, 2);
    greyAlpha.pixels = {0.5f, 0.25f};
    greyAlpha.channelNames = {"Y", "A"};
    ASSERT_TRUE(writeExr(folder / "g.exr", greyAlpha));
    EXPECT_EQ(readImage(folder / "g.exr")->pixels, (std::vector<float>{0.5f, 0.5f, 0.5f, 0.25f}));
}

TEST(ImageExr, FindsMissingEnds) {
    const std::vector<std::byte> exr = makeExr({});
    for (std::size_t size = 4; size < exr.size(); size += 13)
        EXPECT_FALSE(readImage(std::span(exr).first(size), "e")) << size << " of " << exr.size();
}

TEST(ImageExr, RefusesHugeHeadersBeforeTakingMemory) {
    const auto withSize = [](int width, int height) {
        Imf::Header header(width, height);
        for (int c = 0; c < 200; ++c) header.channels().insert("l." + std::to_string(c), Imf::Channel(Imf::FLOAT));
        test::MemoryOutput out;
        { const Imf::OutputFile file(out, header); }  // no pixels: its table of offsets is there, and empty
        return out.bytes;
    };
    const auto large = readImage(withSize(16384, 64), "e");  // 800 MiB
    ASSERT_FALSE(large);
    EXPECT_NE(large.error().message.find("asks for"), std::string::npos) << large.error().message;
    EXPECT_NE(readImage(withSize(20000, 1), "e").error().message.find("the limit is 16384"), std::string::npos);
    // The table of chunks, which OpenEXR makes as large as the header says, here 16 GiB.
    std::vector<std::byte> parts = test::makeTwoPartExr();
    const std::string_view text(reinterpret_cast<const char*>(parts.data()), parts.size());
    const std::size_t countAt = text.find("chunkCount") + std::string_view("chunkCount\0int\0....", 19).size();
    const std::int32_t count = 0x7fffffff;
    std::memcpy(parts.data() + countAt, &count, sizeof count);
    EXPECT_NE(readImage(parts, "e").error().message.find("2147483647 chunks"), std::string::npos)
        << readImage(parts, "e").error().message;
}

TEST(ImageExr, ReadsEveryEnvironment) {
    const std::filesystem::path folder = std::filesystem::path(SHOAL_DATA_DIR) / "environments";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data at " << folder;
    int fileCount = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        ++fileCount;
        const auto image = readImage(entry.path());
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_EQ(image->width, 1024) << entry.path();
        EXPECT_EQ(image->height, 512) << entry.path();
        ASSERT_GE(image->channelCount, 3) << entry.path();
        double sum = 0;
        float least = 0;
        std::size_t negativeCount = 0;
        for (const float value : image->pixels) {
            ASSERT_TRUE(std::isfinite(value)) << entry.path();
            if (value < 0) least = std::min(least, value), ++negativeCount;
            sum += value;
        }
        // The EXRs went through DWAB once, which rings: a few dark values are stored below zero, in the ZIP copies
        // too. They are read as they are; lights clamp.
        const bool dwab = entry.path().extension() == ".exr";
        EXPECT_GE(least, dwab ? -0.01f : 0.0f) << entry.path();
        EXPECT_LE(negativeCount, dwab ? image->pixels.size() / 100 : 0) << entry.path();
        EXPECT_GT(sum / double(image->pixels.size()), 0.001) << entry.path();
    }
    EXPECT_EQ(fileCount, 10);
}

// The same picture once as DWAB, once as half floats in ZIP.
TEST(ImageExr, ReadsDwabAsItWasMeant) {
    const std::filesystem::path folder = std::filesystem::path(SHOAL_DATA_DIR) / "environments";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no data at " << folder;
    const auto dwab = readImage(folder / "blender_courtyard.exr"),
               zip = readImage(folder / "courtyard_1k_half_zip.exr");
    ASSERT_TRUE(dwab && zip);
    ASSERT_EQ(dwab->pixels.size(), zip->pixels.size());
    double worst = 0;
    for (std::size_t i = 0; i < zip->pixels.size(); ++i)
        worst = std::max(worst,
                         std::abs(double(dwab->pixels[i]) - double(zip->pixels[i])) / (double(zip->pixels[i]) + 1e-3));
    EXPECT_LT(worst, 0.001);  // re-encoding rounded to 11 bits: half a step is 2^-11 of the value
}

}  // namespace
}  // namespace shoal::io
