// docs/scene_file.md is what the tool prints, and its example is a scene.
#include <gtest/gtest.h>

#include "support/tool_contract.h"

namespace shoal::test {
namespace {

// The text between two markers, without them.
std::string between(const std::string& text, const std::string& begin, const std::string& end) {
    const std::size_t from = text.find(begin);
    if (from == std::string::npos) return "";
    const std::size_t to = text.find(end, from + begin.size());
    return to == std::string::npos ? "" : text.substr(from + begin.size(), to - from - begin.size());
}

std::string page() { return readText(std::filesystem::path(SHOAL_SOURCE_DIR) / "docs" / "scene_file.md"); }

TEST(ToolDocs, SceneFileTablesAreWhatTheToolPrints) {
    const ProgramRun keys = runTool({"info", "--keys"});
    ASSERT_EQ(keys.exitCode, 0) << keys.describe();
    EXPECT_GT(keys.out.size(), 5000u);
    EXPECT_TRUE(between(page(), "<!-- begin: shoal info --keys -->\n\n", "<!-- end -->") == keys.out)
        << "docs/scene_file.md is not up to date: run scripts/update_docs";
}

TEST(ToolDocs, SceneFileExampleDraws) {
    const TestFolder folder;
    const std::string example = between(page(), "```toml\n", "```");
    ASSERT_GT(example.size(), 200u);
    writeText(folder / "ball.toml", example);
    const ProgramRun run = runTool({"render", "ball.toml", "-o", "ball.png", "--size", "160x90", "--set",
                                    "camera.fovDeg=60", "--set", "shape[1].roughness=0.5"},
                                   {.folder = folder.path(), .environment = {}});
    EXPECT_EQ(run.exitCode, 0) << run.describe();
    EXPECT_EQ(run.err, "") << run.describe();
}

}  // namespace
}  // namespace shoal::test
