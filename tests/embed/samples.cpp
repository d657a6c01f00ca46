// The samples, run as a newcomer would run them.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <shoal/io/image.h>

#include "support/run_program.h"
#include "support/test_folder.h"
#include "support/virtual_screen.h"

namespace shoal::test {
namespace {

class Samples : public testing::Test {
protected:
    void SetUp() override {
        std::ofstream(folder / "scene.toml")
            << "[[shape]]\nkind = \"plane\"\nwidth = 4\ndepth = 4\n[[shape]]\nkind = \"sphere\"\n";
    }
    static std::string sample(const std::string& name) {
        return std::string(SHOAL_BUILD_DIR) + "/samples/sample_" + name;
    }
    TestFolder folder;
};

TEST_F(Samples, GlfwLoopDrawsFiveFramesUnderXvfb) {
    const VirtualScreen screen;
    SHOAL_NEEDS_SCREEN(screen)
    const std::string scene = (folder / "scene.toml").string();
    const ProgramRun run = runProgram({sample("glfw_loop"), scene, "5"});
    EXPECT_EQ(run.exitCode, 0) << run.describe();
    EXPECT_EQ(run.err, "") << run.describe();
    const ProgramRun bad = runProgram({sample("glfw_loop"), (folder / "absent.toml").string(), "5"});
    EXPECT_EQ(bad.exitCode, 1) << bad.describe();
    EXPECT_EQ(lineCount(bad.err), 1u) << bad.describe();
    EXPECT_NE(bad.err.find("absent.toml"), std::string::npos) << bad.describe();
}

TEST_F(Samples, GlfwLoopWithoutAScreenSaysSo) {
    const ProgramRun run = runProgram({sample("glfw_loop"), (folder / "scene.toml").string(), "1"},
                                      {.folder = {}, .environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}});
    EXPECT_EQ(run.exitCode, 1) << run.describe();
    EXPECT_NE(run.err.find("no window"), std::string::npos) << run.describe();
}

// A host's own picture of a lit floor: bright nets of light on it, and not one colour.
void expectLightInWater(const std::filesystem::path& file) {
    const auto picture = io::readByteImage(file);
    ASSERT_TRUE(picture) << picture.error().message;
    ASSERT_EQ(picture->width, 960);
    double sum = 0, squares = 0, top = 0;
    constexpr int kRows = 80;  // of the floor, at the bottom
    for (int y = 540 - kRows; y < 540; ++y) {
        for (int x = 0; x < 960; ++x) {
            const double green = picture->pixels[(std::size_t(y) * 960 + std::size_t(x)) * 4 + 1];
            sum += green, squares += green * green;
            top += picture->pixels[(std::size_t(y - 460) * 960 + std::size_t(x)) * 4 + 1];
        }
    }
    const double count = 960.0 * kRows, mean = sum / count;
    EXPECT_GT(mean, 90) << "the sunlit floor";
    EXPECT_GT(std::sqrt(squares / count - mean * mean), 12) << "caustics on it";
    EXPECT_LT(top / count, mean) << "water above";
    EXPECT_GT(top / count, 10) << "scatters light";
}

TEST_F(Samples, WaterInAGlLoopLightsTheHostsFloor) {
    const VirtualScreen screen;
    SHOAL_NEEDS_SCREEN(screen)
    const std::string file = (folder / "loop.png").string();
    const ProgramRun run = runProgram({sample("water_in_gl_loop"), "2", file});
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    EXPECT_EQ(run.err, "") << run.describe();
    expectLightInWater(file);
}

TEST_F(Samples, WaterInOpenSceneGraphLightsItsFloor) {
    if (!std::filesystem::exists(sample("water_in_openscenegraph")))
        GTEST_SKIP() << "built without libopenscenegraph-dev";
    const VirtualScreen screen;
    SHOAL_NEEDS_SCREEN(screen)
    const std::string file = (folder / "osg.png").string();
    const ProgramRun run = runProgram({sample("water_in_openscenegraph"), "2", file});
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    expectLightInWater(file);
}

TEST_F(Samples, HeadlessPngIsAPicture) {
    const std::string file = (folder / "out.png").string();
    const ProgramRun run = runProgram({sample("headless_png"), (folder / "scene.toml").string(), file},
                                      {.folder = {}, .environment = {{"DISPLAY", ""}, {"WAYLAND_DISPLAY", ""}}});
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    const auto picture = io::readByteImage(file);
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(picture->width, 1280);
    EXPECT_EQ(picture->height, 720);
    // The ball in the middle, the sky in a corner: not one colour.
    const auto at = [&](int x, int y) { return &picture->pixels[(std::size_t(y) * 1280 + std::size_t(x)) * 4]; };
    EXPECT_NE(std::vector<std::uint8_t>(at(640, 360), at(640, 360) + 3),
              std::vector<std::uint8_t>(at(5, 5), at(5, 5) + 3));
    const ProgramRun bad = runProgram({sample("headless_png"), "absent.glb", file});
    EXPECT_EQ(bad.exitCode, 1) << bad.describe();
    EXPECT_EQ(lineCount(bad.err), 1u) << bad.describe();
}

}  // namespace
}  // namespace shoal::test
