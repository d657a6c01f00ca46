// The samples, run as a newcomer would run them.
#include <gtest/gtest.h>

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
