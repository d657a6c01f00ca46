#include <shoal/io/movie.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>

#include <shoal/io/file.h>

#include "support/test_folder.h"

namespace shoal::io {
namespace {

using test::TestFolder;

// What a shell command writes.
std::string outputOf(const std::string& command) {
    std::string text;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    if (!pipe) return text;
    std::array<char, 4096> buffer;
    for (std::size_t n; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) text.append(buffer.data(), n);
    ::pclose(pipe);
    return text;
}

bool hasFfmpeg() { return !outputOf("command -v ffmpeg && command -v ffprobe").empty(); }

#define SKIP_WITHOUT_FFMPEG() \
    if (!hasFfmpeg()) GTEST_SKIP() << "no ffmpeg here"

ByteImage frameAt(int width, int height, int frame) {
    ByteImage image(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            std::uint8_t* pixel = image.pixels.data() + (y * width + x) * 4;
            pixel[0] = std::uint8_t(x + 8 * frame);
            pixel[1] = std::uint8_t(y);
            pixel[2] = (x + 4 * frame) / 16 % 2 ? 200 : 30;
            pixel[3] = 255;
        }
    }
    return image;
}

Result<void> makeMovie(const std::filesystem::path& path, int frameCount, const MovieOptions& options = {}) {
    SHOAL_TRY_ASSIGN(Movie movie, Movie::open(path, 160, 90, 25, options));
    for (int frame = 0; frame < frameCount; ++frame) SHOAL_TRY(movie.add(frameAt(160, 90, frame)));
    return movie.finish();
}

TEST(Movie, IsWhatItWasAskedToBe) {
    SKIP_WITHOUT_FFMPEG();
    const TestFolder folder;
    const auto made = makeMovie(folder / "m.mp4", 10);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(folder.entryCount(), 1u);
    const std::string probe = outputOf(
        "ffprobe -v error -count_frames -of default=nk=1:nw=1 -show_entries stream=codec_name,"
        "width,height,pix_fmt,color_range,color_space,color_transfer,color_primaries,"
        "r_frame_rate,nb_read_frames '" +
        (folder / "m.mp4").string() + "'");
    for (const char* word :
         {"h264\n", "160\n", "90\n", "yuv420p\n", "tv\n", "bt709\nbt709\nbt709\n", "25/1\n", "\n10\n"})
        EXPECT_NE(probe.find(word), std::string::npos) << word << " in " << probe;
}

TEST(Movie, IsTheSameTwice) {
    SKIP_WITHOUT_FFMPEG();
    const TestFolder folder;
    ASSERT_TRUE(makeMovie(folder / "a.mp4", 10));
    ASSERT_TRUE(makeMovie(folder / "b.mp4", 10));
    EXPECT_EQ(*readFile(folder / "a.mp4"), *readFile(folder / "b.mp4"));
    ASSERT_TRUE(makeMovie(folder / "c.mp4", 10, {.crf = 30}));
    EXPECT_LT(std::filesystem::file_size(folder / "c.mp4"), std::filesystem::file_size(folder / "a.mp4"));
}

// A flat colour comes back through the BT.709 matrix and limited range.
TEST(Movie, KeepsColors) {
    SKIP_WITHOUT_FFMPEG();
    const TestFolder folder;
    const std::array<std::uint8_t, 3> color = {200, 60, 30};
    ByteImage image(64, 64);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = i % 4 == 3 ? 255 : color[i % 4];
    auto movie = Movie::open(folder / "m.mp4", 64, 64, 10, {.crf = 1});
    ASSERT_TRUE(movie);
    ASSERT_TRUE(movie->add(image));
    ASSERT_TRUE(movie->finish());
    const std::string yuv =
        outputOf("ffmpeg -v error -i '" + (folder / "m.mp4").string() + "' -f rawvideo -pix_fmt yuv420p -");
    ASSERT_EQ(yuv.size(), 64u * 64u * 3 / 2);
    const double r = color[0] / 255.0, g = color[1] / 255.0, b = color[2] / 255.0;
    const double luma = 0.2126 * r + 0.7152 * g + 0.0722 * b;  // ITU-R BT.709 3.2, 3.4
    EXPECT_NEAR(std::uint8_t(yuv[64 * 32 + 32]), 16 + 219 * luma, 2);
    EXPECT_NEAR(std::uint8_t(yuv[64 * 64 + 500]), 128 + 224 * (b - luma) / 1.8556, 2);
    EXPECT_NEAR(std::uint8_t(yuv[64 * 64 + 32 * 32 + 500]), 128 + 224 * (r - luma) / 1.5748, 2);
}

TEST(Movie, GoesByTheExtensionInAnyCase) {
    for (const char* name : {"a.mp4", "b/a.MP4", "a.m4v", "a.Mov"}) EXPECT_TRUE(isMovieFile(name)) << name;
    for (const char* name : {"a.png", "mp4", "a.mp4.exr", ""}) EXPECT_FALSE(isMovieFile(name)) << name;
}

TEST(Movie, SaysWhatIsWrong) {
    const TestFolder folder;
    const auto errorOf = [&](const std::filesystem::path& path, int width, int height, double fps,
                             const MovieOptions& options = {}) {
        const auto movie = Movie::open(path, width, height, fps, options);
        return movie ? std::string() : movie.error().message;
    };
    EXPECT_NE(errorOf(folder / "m.mp4", 641, 361, 30).find("640 x 360"), std::string::npos);
    EXPECT_NE(errorOf(folder / "m.mp4", 0, 0, 30).find("0 x 0"), std::string::npos);
    EXPECT_NE(errorOf(folder / "m.mp4", 64, 64, 0).find("0 frames a second"), std::string::npos);
    EXPECT_NE(errorOf(folder / "m.mp4", 64, 64, std::nan("")).find("frames a second"), std::string::npos);
    EXPECT_NE(errorOf(folder / "m.gif", 64, 64, 30).find("\".gif\""), std::string::npos);
    EXPECT_NE(errorOf(folder / "m.mp4", 64, 64, 30, {.program = "no-such-ffmpeg"}).find("no-such-ffmpeg"),
              std::string::npos);
    std::ofstream(folder / "file") << "x";
    EXPECT_NE(errorOf(folder / "file/m.mp4", 64, 64, 30).find("is not a folder"), std::string::npos);
    EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(Movie, TellsWhatFfmpegSaid) {
    SKIP_WITHOUT_FFMPEG();
    const TestFolder folder;
    const auto made = makeMovie(folder / "m.mp4", 100, {.preset = "no-such-preset"});
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("ffmpeg exited with 1: "), std::string::npos) << made.error().message;
    EXPECT_EQ(made.error().message.find('\n'), std::string::npos);
    EXPECT_EQ(folder.entryCount(), 0u);
    // A program that ends at once: writing to it must not stop us with SIGPIPE.
    const auto ended = makeMovie(folder / "m.mp4", 1000, {.program = "false"});
    ASSERT_FALSE(ended);
    EXPECT_NE(ended.error().message.find("false exited with 1"), std::string::npos) << ended.error().message;
}

TEST(Movie, KeepsTheOldOneWhenGivenUp) {
    SKIP_WITHOUT_FFMPEG();
    const TestFolder folder;
    ASSERT_TRUE(makeMovie(folder / "m.mp4", 3));
    const auto before = readFile(folder / "m.mp4");
    {
        auto movie = Movie::open(folder / "m.mp4", 160, 90, 25);
        ASSERT_TRUE(movie);
        ASSERT_TRUE(movie->add(frameAt(160, 90, 0)));
        EXPECT_FALSE(movie->add(frameAt(90, 160, 0)));  // another size
    }
    auto none = Movie::open(folder / "m.mp4", 160, 90, 25);
    ASSERT_TRUE(none);
    EXPECT_NE(none->finish().error().message.find("without a frame"), std::string::npos);
    EXPECT_EQ(*readFile(folder / "m.mp4"), *before);
    EXPECT_EQ(folder.entryCount(), 1u);
}

}  // namespace
}  // namespace shoal::io
