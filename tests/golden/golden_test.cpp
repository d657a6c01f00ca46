// Every golden is one test. See support/golden.h for the variables that update and measure.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "golden/entries.h"
#include "golden/models.h"
#include "support/golden.h"
#include "support/run_program.h"
#include "support/test_folder.h"

namespace shoal::test {

void PrintTo(const Entry& entry, std::ostream* out) { *out << entry.name; }

namespace {

GoldenSetup setup() {
    GoldenSetup s;
    s.tool = SHOAL_TOOL;
    s.sources = std::filesystem::path(SHOAL_SOURCE_DIR) / "tests" / "golden";
    s.work = std::filesystem::path(SHOAL_BUILD_DIR) / "golden_work";
    s.report = std::filesystem::path(SHOAL_BUILD_DIR) / "golden_report";
    s.makeFile = [](const std::filesystem::path& folder, const std::string& name) {
        const auto names = modelNames();
        if (std::find(names.begin(), names.end(), name) == names.end()) return false;
        writeModel(folder, name);
        return true;
    };
    return s;
}

class Golden : public testing::TestWithParam<Entry> {};

TEST_P(Golden, IsTheReference) {
    if (std::getenv("SHOAL_MEASURE_GOLDENS")) {
        std::printf("%s\n", measureGolden(GetParam(), setup()).c_str());
        return;
    }
    const std::string findings = runGolden(GetParam(), setup());
    if (!findings.empty()) ADD_FAILURE() << findings << "pictures: " << (setup().report / "index.html").string();
}

INSTANTIATE_TEST_SUITE_P(All, Golden, testing::ValuesIn(entries()),
                         [](const testing::TestParamInfo<Entry>& info) { return info.param.name; });

// A known answer instead of a picture that was once found good: what temporal antialiasing makes of the eighth frame of
// a film must be nearer to the supersampled frame than no antialiasing at all, on a still view and on a turning one.
class Temporal : public testing::TestWithParam<const char*> {};

TEST_P(Temporal, IsNearerToTheSupersampledFilmThanNothing) {
    const TestFolder folder;
    const std::string scene = (setup().sources / "scenes" / "cameras.toml").string();
    const auto draw = [&](const std::string& antialiasing) {
        const std::string name = (folder / (antialiasing + ".exr")).string();
        const ProgramRun run = runTool({"render", scene, "-o", name, "--quiet", "--frames", "0:8", "--samples", "32",
                                        "--antialiasing", antialiasing, "--set", GetParam()});
        EXPECT_EQ(run.exitCode, 0) << run.describe();
        return (folder / (antialiasing + "_0007.exr")).string();
    };
    const std::string answer = draw("supersample");
    const auto distance = [&](const std::string& picture) {
        const ProgramRun run = runTool({"compare", picture, answer});
        EXPECT_EQ(run.exitCode, 0) << run.describe();
        return std::strtod(run.out.c_str() + 5, nullptr);  // "rmse 0.0071"
    };
    const double temporal = distance(draw("temporal")), none = distance(draw("none"));
    EXPECT_GT(none, 0) << "the scene has edges";
    EXPECT_LT(temporal, none);
}

INSTANTIATE_TEST_SUITE_P(Views, Temporal,
                         testing::Values("camera.fovDeg=40",
                                         "camera={ orbit = { radius = 7, degPerSecond = 40 }, fovDeg = 40 }"),
                         [](const testing::TestParamInfo<const char*>& info) {
                             return info.index == 0 ? "Still" : "Turning";
                         });

TEST(GoldenTable, HasEachNameOnceAndNoReferenceWithoutEntry) {
    std::vector<std::string> names;
    for (const Entry& entry : entries()) names.push_back(entry.name + entry.extension);
    std::sort(names.begin(), names.end());
    EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
    std::uintmax_t bytes = 0;
    for (const auto& file : std::filesystem::directory_iterator(setup().sources / "reference")) {
        EXPECT_TRUE(std::binary_search(names.begin(), names.end(), file.path().filename().string())) << file.path();
        bytes += file.file_size();
    }
    EXPECT_LE(bytes, 6u << 20) << "all references together";
}

}  // namespace
}  // namespace shoal::test
