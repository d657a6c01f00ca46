// `shoal view` on an X server of its own, driven by synthetic input through the queue that a hand's input takes.
#include <gtest/gtest.h>

#include <cstdlib>
#include <regex>
#include <sstream>

#include <shoal/core/compare.h>
#include <shoal/io/image.h>

#include "support/tool_contract.h"
#include "support/virtual_screen.h"

#ifdef SHOAL_TOOL
namespace shoal {
namespace {

using test::ProgramRun;

// Small and of procedural shapes alone: a frame takes some milliseconds.
constexpr const char* kScene = R"([render]
width = 320
height = 180
samples = 2

[camera]
orbit = { center = [0, 1, 0], radius = 7, elevationDeg = 20 }  # goes when the eye is moved by hand

[post]
exposureMode = "fixed"
exposureEv = 0.0   # a comment that stays

[[shape]]
kind = "plane"
width = 20
depth = 20

[[shape]]
kind = "box"
position = [0, 0.5, 0]
)";

class ViewWindow : public testing::Test {
protected:
    void SetUp() override { test::writeText(folder / "scene.toml", kScene); }

    ProgramRun view(const std::string& script, std::vector<std::string> more = {}) {
        test::writeText(folder / "script.txt", script);
        std::vector<std::string> words = {"view", "scene.toml", "--script", "script.txt", "--size", "640x400"};
        words.insert(words.end(), more.begin(), more.end());
        return test::runTool(words, options());
    }
    // GLX drivers leak a little when they are unloaded; GL names are counted by the tests themselves.
    test::RunOptions options() const {
        return {.folder = folder.path(),
                .environment = {{"XDG_STATE_HOME", (folder / "state").string()}, {"ASAN_OPTIONS", "detect_leaks=0"}},
                .limitS = 110};
    }
    // "objects=143" of the line that `print LABEL` wrote.
    static long valueOf(const ProgramRun& run, const std::string& label, const std::string& name) {
        std::smatch found;
        const std::regex wanted("(?:^|\n)" + label + ": [^\n]*\\b" + name + "=(-?\\d+)");
        if (!std::regex_search(run.out, found, wanted)) return -1;
        return std::stol(found[1]);
    }
    static std::string errorOf(const ProgramRun& run, const std::string& label) {
        std::smatch found;
        const std::regex wanted("(?:^|\n)" + label + ": [^\n]*error=\"([^\n]*)\" status");
        return std::regex_search(run.out, found, wanted) ? found[1].str() : "no line " + label;
    }
    void expectSamePicture(const std::string& a, const std::string& b) {
        const ProgramRun compared = test::runTool({"compare", a, b, "--max-rmse", "0.0005"}, options());
        EXPECT_EQ(compared.exitCode, 0) << compared.describe();
    }
    void expectOtherPicture(const std::string& a, const std::string& b) {
        const ProgramRun compared = test::runTool({"compare", a, b, "--max-rmse", "0.0005"}, options());
        EXPECT_EQ(compared.exitCode, 1) << compared.describe();
    }

    test::VirtualScreen screen;
    test::TestFolder folder;
};

TEST_F(ViewWindow, WhatIsSavedDrawsWhatWasSeen) {
    SHOAL_NEEDS_SCREEN(screen)
    const ProgramRun run = view(R"(wait full
screenshot before.png
drag left 150 200 190 215 6
scroll 1
click filter
type exposureEv
key Enter
wait 2
slide post.exposureEv 0.5 0.56
wait full
screenshot after.png
command
save saved.toml
print end
quit
)");
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    EXPECT_EQ(errorOf(run, "end"), "");
    expectOtherPicture("before.png", "after.png");
    const ProgramRun drawn = test::runTool({"render", "saved.toml", "-o", "drawn.png"}, options());
    ASSERT_EQ(drawn.exitCode, 0) << drawn.describe();
    expectSamePicture("after.png", "drawn.png");

    const std::string saved = test::readText(folder / "saved.toml");
    EXPECT_NE(saved.find("# a comment that stays"), std::string::npos) << saved;
    EXPECT_EQ(saved.find("orbit"), std::string::npos) << saved;
    EXPECT_EQ(saved.find("exposureEv = 0.0 "), std::string::npos) << "the slider changed nothing:\n" << saved;

    // The command that was copied draws it too.
    std::smatch found;
    const std::string out = run.out;
    ASSERT_TRUE(std::regex_search(out, found, std::regex("command: (shoal render [^\n]*) -o [^\n]*"))) << out;
    std::string command = found[1].str();
    command.replace(0, 5, SHOAL_TOOL);
    const ProgramRun copied = test::runProgram({"/bin/sh", "-c", command + " -o copied.png"}, options());
    ASSERT_EQ(copied.exitCode, 0) << copied.describe();
    expectSamePicture("after.png", "copied.png");
}

TEST_F(ViewWindow, ABareModelIsSavedToo) {
    SHOAL_NEEDS_SCREEN(screen)
    test::writeText(folder / "sub/model.obj", "");
    std::filesystem::create_directories(folder / "sub");
    test::writeText(folder / "sub/model.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0.3\nf 1 2 3\n");
    test::writeText(folder / "script.txt",
                    "wait full\nscreenshot a.png\nsave saved.toml\nwait full\nscreenshot b.png\nquit\n");
    const ProgramRun run =
        test::runTool({"view", "sub/model.obj", "--script", "script.txt", "--size", "640x400"}, options());
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    const ProgramRun drawn = test::runTool({"render", "saved.toml", "-o", "drawn.png"}, options());
    ASSERT_EQ(drawn.exitCode, 0) << drawn.describe();
    expectSamePicture("a.png", "drawn.png");
    expectSamePicture("b.png", "drawn.png");
    const ProgramRun bare =
        test::runTool({"render", "sub/model.obj", "-o", "bare.png", "--size", "239x344"}, options());
    EXPECT_EQ(bare.exitCode, 0) << bare.describe();
}

TEST_F(ViewWindow, ABrokenFileLeavesThePictureAndIsToldWithItsLine) {
    SHOAL_NEEDS_SCREEN(screen)
    test::writeText(folder / "broken.toml", "[camera]\nfovDeg = 40\n[post]\nexposureEw = 2\n");
    std::string changed = kScene;
    changed.replace(changed.find("exposureEv = 0.0"), 16, "exposureEv = 1.5");
    test::writeText(folder / "changed.toml", changed);
    const ProgramRun run = view(R"(wait full
print start
screenshot good.png
copy broken.toml scene.toml
wait 20
wait full
print broken
screenshot stays.png
copy changed.toml scene.toml
wait 20
wait full
print mended
screenshot mended.png
quit
)");
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    const std::string error = errorOf(run, "broken");
    EXPECT_NE(error.find("scene.toml:4"), std::string::npos) << error;
    EXPECT_NE(error.find("exposureEv"), std::string::npos) << error;
    expectSamePicture("good.png", "stays.png");
    EXPECT_EQ(errorOf(run, "mended"), "");
    expectOtherPicture("good.png", "mended.png");
    EXPECT_EQ(valueOf(run, "start", "objects"), valueOf(run, "mended", "objects")) << run.out;
}

TEST_F(ViewWindow, TwoHundredSizesLeakNothing) {
    SHOAL_NEEDS_SCREEN(screen)
    std::string script = "wait full\nprint start\n";
    for (int i = 0; i < 200; ++i)
        script +=
            "resize " + std::to_string(300 + 37 * i % 500) + " " + std::to_string(200 + 53 * i % 400) + "\nwait 1\n";
    script += "resize 640 400\nwait 12\nwait full\nprint end\nscreenshot end.png\nquit\n";
    const ProgramRun run = view(script);
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    EXPECT_GT(valueOf(run, "start", "objects"), 0) << run.out;
    EXPECT_EQ(valueOf(run, "start", "objects"), valueOf(run, "end", "objects")) << run.out;
    EXPECT_EQ(valueOf(run, "start", "bytes"), valueOf(run, "end", "bytes")) << run.out;
}

TEST_F(ViewWindow, ADroppedFileThatIsNoSceneChangesNothing) {
    SHOAL_NEEDS_SCREEN(screen)
    test::writeText(folder / "notes.txt", "milk, bread\n");
    test::writeText(folder / "half.glb", std::string("glTF\2\0\0\0", 8) + "and then nothing");
    test::writeText(folder / "empty.hdr", "#?RADIANCE\n");
    test::writeText(folder / "other.toml", "[[shape]]\nkind = \"box\"\n");
    const ProgramRun run = view(R"(wait full
print start
screenshot good.png
drop notes.txt
wait 3
print notes
drop half.glb
wait 3
wait full
print half
drop empty.hdr
wait 3
print empty
drop nowhere.toml
wait 3
print nowhere
screenshot stays.png
print end
drop other.toml
wait 5
wait full
print other
screenshot other.png
quit
)");
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    EXPECT_NE(errorOf(run, "notes").find("notes.txt"), std::string::npos) << run.out;
    EXPECT_NE(errorOf(run, "half").find("half.glb"), std::string::npos) << run.out;
    EXPECT_NE(errorOf(run, "empty").find("empty.hdr"), std::string::npos) << run.out;
    EXPECT_NE(errorOf(run, "nowhere").find("nowhere.toml"), std::string::npos) << run.out;
    expectSamePicture("good.png", "stays.png");
    EXPECT_EQ(valueOf(run, "start", "objects"), valueOf(run, "end", "objects")) << run.out;
    EXPECT_EQ(errorOf(run, "other"), "");
    expectOtherPicture("good.png", "other.png");
}

TEST_F(ViewWindow, ComparisonAndBuffersGiveBackWhatTheyTake) {
    SHOAL_NEEDS_SCREEN(screen)
    const ProgramRun run = view(R"(wait full
print start
key V
wait full
print two
set post.exposureEv 2
wait full
window split.png
key V
wait full
print one
buffer depth
key T
wait full
move 100 200
wait 2
window depth.png
screenshot all.exr
quit
)");
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    EXPECT_GT(valueOf(run, "two", "objects"), valueOf(run, "start", "objects")) << run.out;
    EXPECT_EQ(valueOf(run, "start", "objects"), valueOf(run, "one", "objects")) << run.out;
    const auto layers = io::readLayers(folder / "all.exr");
    ASSERT_TRUE(layers) << layers.error().message;
    EXPECT_GE(layers->size(), 9u);
    // Right of the divider is two stops brighter.
    const auto split = io::readByteImage(folder / "split.png");
    ASSERT_TRUE(split) << split.error().message;
    const int width = int(valueOf(run, "start", "picture")), y = 240;
    const auto brightness = [&](int x) {
        const std::uint8_t* p =
            split->pixels.data() + (std::size_t(y) * std::size_t(split->width) + std::size_t(x)) * 4;
        return int(p[0]) + p[1] + p[2];
    };
    ASSERT_GT(width, 100);
    EXPECT_GT(brightness(3 * width / 4), brightness(width / 4) + 30);
}

TEST_F(ViewWindow, KeysReachThePictureAfterThePanels) {
    SHOAL_NEEDS_SCREEN(screen)
    // Typing into the search line is no command; Esc gives the keys back.
    const ProgramRun run = view(R"(wait full
screenshot a.png
click filter
key F
type f
wait 3
screenshot b.png
key Escape
wait 2
key 7
wait full
screenshot c.png
key F1
wait 2
window help.png
key Escape
wait 2
hold W 10
wait full
screenshot d.png
quit
)");
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    expectSamePicture("a.png", "b.png");
    expectOtherPicture("b.png", "c.png");
    expectOtherPicture("c.png", "d.png");
}

TEST_F(ViewWindow, ExamplesOfTheHelpWork) {
    SHOAL_NEEDS_SCREEN(screen)
    std::filesystem::create_directory_symlink(std::filesystem::path(SHOAL_SOURCE_DIR) / "scenes", folder / "scenes");
    test::writeText(folder / "script.txt", "wait loaded\nwait 2\nprint end\nquit\n");
    const ProgramRun help = test::runTool({"view", "--help"});
    std::istringstream lines(help.out.substr(help.out.find("Examples:")));
    int count = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream stream(line);
        std::vector<std::string> words;
        for (std::string word; stream >> word;) words.push_back(word);
        if (words.size() < 3 || words[0] != "shoal") continue;
        words.erase(words.begin());
        words.insert(words.end(), {"--script", "script.txt"});
        const ProgramRun run = test::runTool(words, options());
        EXPECT_EQ(run.exitCode, 0) << run.describe();
        EXPECT_EQ(errorOf(run, "end"), "");
        ++count;
    }
    EXPECT_EQ(count, 2) << help.out;
}

TEST_F(ViewWindow, RefusalsAreOneLine) {
    test::expectRefusal(test::runTool({"view", "nowhere.toml"}, options()), 3, {"nowhere.toml"});
    test::writeText(folder / "bad.toml", "[camera]\nfovDg = 4\n");
    test::expectRefusal(test::runTool({"view", "bad.toml"}, options()), 3, {"bad.toml:2", "fovDeg"});
    test::expectRefusal(test::runTool({"view", "scene.toml", "--size", "0x9"}, options()), 2, {"--size"});
    test::expectRefusal(test::runTool({"view", "scene.toml", "--set", "camera.fovDg=4"}, options()), 2, {"fovDeg"});
    test::expectRefusal(test::runTool({"view", "scene.toml", "--script", "none.txt"}, options()), 3, {"none.txt"});
    test::RunOptions without = options();
    without.environment.push_back({"DISPLAY", ""});
    without.environment.push_back({"WAYLAND_DISPLAY", ""});
    test::expectRefusal(test::runTool({"view", "scene.toml"}, without), 4, {"display"});
}

}  // namespace
}  // namespace shoal
#endif
