// What the progress bar and the log write.
#include <fcntl.h>
#include <shoal/core/log.h>
#include <shoal/core/progress.h>
#include <unistd.h>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include <gtest/gtest.h>

namespace shoal {
namespace {

TEST(ProgressFormat, BarPercentRateAndRemaining) {
    EXPECT_EQ(ProgressBar::format("rendering", "frames", 126, 300, 40.6, 10),
              "rendering  [####......]  42% 126/300 frames  3.1/s  57 s left");
}

TEST(ProgressFormat, NoRateBeforeTheFirstOne) {
    EXPECT_EQ(ProgressBar::format("rendering", "frames", 0, 300, 5, 4), "rendering  [....]   0% 0/300 frames");
    EXPECT_EQ(ProgressBar::format("rendering", "frames", 3, 300, 0, 4), "rendering  [....]   1% 3/300 frames");
}

TEST(ProgressFormat, DoneTellsTheTimeItTook) {
    EXPECT_EQ(ProgressBar::format("baking", "", 8, 8, 2, 4), "baking  [####]  100% 8/8  4.0/s  in 2 s");
    EXPECT_EQ(ProgressBar::format("baking", "", 9, 8, 3, 4), "baking  [####]  100% 9/8  3.0/s  in 3 s");
}

TEST(ProgressFormat, TheBarIsFullOnlyWhenAllIsDone) {
    EXPECT_EQ(ProgressBar::format("t", "", 999, 1000, 0, 4), "t  [###.]  99% 999/1000");
}

TEST(ProgressFormat, UnknownTotalAndNoBar) {
    EXPECT_EQ(ProgressBar::format("reading", "rows", 5000, 0, 2, 10), "reading  5000 rows  2.5k/s");
    EXPECT_EQ(ProgressBar::format("reading", "rows", 1, 4, 10, 0), "reading  25% 1/4 rows  0.1/s  30 s left");
}

TEST(ProgressFormat, LongTimesAndHugeRates) {
    EXPECT_EQ(ProgressBar::format("t", "", 1, 201, 1, 0), "t   0% 1/201  1.0/s  3 min 20 s left");
    EXPECT_EQ(ProgressBar::format("t", "", 1, 7501, 1, 0), "t   0% 1/7501  1.0/s  2 h 05 min left");
    EXPECT_EQ(ProgressBar::format("t", "", 3000000, 0, 1, 0), "t  3000000  3.0M/s");
    const std::string slow = ProgressBar::format("t", "", 1, ~std::uint64_t(0), 1e9, 0);
    EXPECT_NE(slow.find(" left"), std::string::npos);
}

std::string readAll(std::FILE* file) {
    std::rewind(file);
    std::string text;
    for (int c; (c = std::fgetc(file)) != EOF;) text += char(c);
    return text;
}

TEST(ProgressBar, AFileGetsOneLineAtTheEndOfShortWork) {
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    {
        ProgressBar bar("rendering", "frames", file);
        for (std::uint64_t i = 1; i <= 1000; ++i) bar.update(i, 1000);
        EXPECT_EQ(readAll(file), "");  // less than two seconds
        bar.finish();
        bar.finish();
    }
    const std::string text = readAll(file);
    std::fclose(file);
    EXPECT_EQ(text.substr(0, 36), "rendering  100% 1000/1000 frames  " + text.substr(34, 2));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
    EXPECT_EQ(text.back(), '\n');
    EXPECT_EQ(text.find('\r'), std::string::npos);
}

TEST(ProgressBar, LongWorkEndsWithOneLineOfAllDone) {
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    {
        ProgressBar bar("rendering", "frames", file);
        std::this_thread::sleep_for(std::chrono::milliseconds(2050));  // lines come every two seconds
        bar.update(19, 20);
        std::this_thread::sleep_for(std::chrono::milliseconds(2050));
        bar.update(20, 20);
    }
    const std::string text = readAll(file);
    std::fclose(file);
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
    EXPECT_NE(text.find("95% 19/20"), std::string::npos) << text;
    EXPECT_NE(text.find("100% 20/20"), std::string::npos) << text;
}

TEST(ProgressBar, WorkThatNeverBeganWritesNothing) {
    std::FILE* file = std::tmpfile();
    ASSERT_NE(file, nullptr);
    { ProgressBar bar("rendering", "frames", file); }
    EXPECT_EQ(readAll(file), "");
    std::fclose(file);
}

// What arrives up to and with `last`.
std::string readUntil(int descriptor, char last) {
    std::string text;
    for (char c = 0; c != last && read(descriptor, &c, 1) == 1;) text += c;
    return text;
}

TEST(ProgressBar, ATerminalGetsABarAndANewlineAtTheEnd) {
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    if (master < 0 || grantpt(master) != 0 || unlockpt(master) != 0) GTEST_SKIP() << "no pseudo terminal here";
    std::FILE* terminal = std::fopen(ptsname(master), "w");
    ASSERT_NE(terminal, nullptr);
    {
        ProgressBar bar("rendering", "frames", terminal);
        bar.update(0, 4);
        EXPECT_EQ(readUntil(master, '%').substr(0, 12), "\rrendering  ");  // the first one is drawn at once
        bar.update(3, 4);
        bar.finish();
    }
    const std::string text = readUntil(master, '\n');
    EXPECT_NE(text.find("[######"), std::string::npos);
    EXPECT_NE(text.find("75% 3/4 frames"), std::string::npos);
    EXPECT_NE(text.find("\x1b[K"), std::string::npos);
    std::fclose(terminal);
    close(master);
}

TEST(Log, WritesLinesOfTheLevelAndAbove) {
    testing::internal::CaptureStderr();
    const LogSink sink = stderrSink();
    sink(LogLevel::info, "not this");
    sink(LogLevel::warning, "a texture is missing");
    sink(LogLevel::error, std::string_view("cut off here", 7));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "shoal: warning: a texture is missing\nshoal: error: cut off\n");
}

TEST(Log, NullSinkAndDebugLevel) {
    testing::internal::CaptureStderr();
    nullSink()(LogLevel::error, "nothing");
    stderrSink(LogLevel::debug)(LogLevel::debug, "seen");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "shoal: debug: seen\n");
}

}  // namespace
}  // namespace shoal
