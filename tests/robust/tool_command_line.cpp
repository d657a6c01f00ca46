// The tool's command line: unknown words, help, the examples it prints, exit codes, and the same files every time.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "support/tool_contract.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SHOAL_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SHOAL_SANITIZED 1
#endif
#endif

namespace shoal::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kVerbs = {"render",    "view", "info",  "compare",
                                         "reference", "demo", "bench", "completion"};

const std::string kScene =
    "[camera]\nposition = [3, 2, 5]\ntarget = [0, 0.5, 0]\n[render]\nwidth = 64\nheight = 36\nsamples = 2\nfps = 10\n"
    "[[shape]]\nkind = \"sphere\"\n[[shape]]\nkind = \"plane\"\n";

TEST(ToolCommandLine, WithoutWordsItIsUsage) {
    const ProgramRun run = runTool({});
    EXPECT_EQ(run.exitCode, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("render"), std::string::npos);
}

TEST(ToolCommandLine, UnknownVerbNamesTheNearest) {
    expectRefusal(runTool({"rendr", "x.toml"}), 2, {"rendr", "did you mean \"render\""});
    expectRefusal(runTool({"inof"}), 2, {"inof", "did you mean \"info\""});
    expectRefusal(runTool({"--vresion"}), 2, {"--vresion", "did you mean \"--version\""});
}

TEST(ToolCommandLine, UnknownOptionOfEveryVerbNamesTheNearest) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> wrong = {
        {"--antialising", {"render", "a.toml", "-o", "a.png", "--antialising", "none"}},
        {"--devces", {"info", "--devces"}},
        {"--max-rms", {"compare", "a.png", "b.png", "--max-rms=1"}},
        {"--flm", {"demo", "--flm"}},
        {"--jsn", {"bench", "--jsn", "x"}}};
    for (const auto& [option, words] : wrong) expectRefusal(runTool(words), 2, {option, "did you mean \"--"});
}

TEST(ToolCommandLine, MissingWordsAreUsage) {
    expectRefusal(runTool({"render"}), 2, {});
    expectRefusal(runTool({"info"}), 2, {"file"});
    expectRefusal(runTool({"compare", "a.png"}), 2, {"b"});
    expectRefusal(runTool({"render", "a.toml", "-o"}), 2, {"-o"});
}

TEST(ToolCommandLine, HelpAndVersionAreNoError) {
    const ProgramRun version = runTool({"--version"});
    EXPECT_EQ(version.exitCode, 0) << version.describe();
    EXPECT_TRUE(std::regex_search(version.out, std::regex("^shoal [0-9]+\\.[0-9]+"))) << version.out;
    for (const std::string& verb : kVerbs) {
        const ProgramRun help = runTool({verb, "--help"});
        EXPECT_EQ(help.exitCode, 0) << help.describe();
        EXPECT_EQ(help.err, "");
        EXPECT_NE(help.out.find("shoal " + verb), std::string::npos) << help.out;
    }
}

// ---- examples ----

// The lines after "Example:" or "Examples:" of a help text, without "shoal ".
std::vector<std::vector<std::string>> examplesOf(const std::string& help) {
    std::vector<std::vector<std::string>> examples;
    std::istringstream lines(help.substr(std::min(help.find("\nExample"), help.size())));
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::vector<std::string> example;
        for (std::string word; words >> word;) example.push_back(word);
        if (example.empty() || example[0] != "shoal") continue;
        example.erase(example.begin());
        examples.push_back(example);
    }
    return examples;
}

class ToolExamples : public testing::TestWithParam<std::string> {};

// From a folder where scenes/ is the shipped one and a.png, b.png are two pictures.
TEST_P(ToolExamples, WorkAsPrinted) {
#if SHOAL_SANITIZED
    GTEST_SKIP() << "too slow under sanitizers";
#endif
    const fs::path scenes = fs::path(SHOAL_SOURCE_DIR) / "scenes";
    const TestFolder folder;
    fs::create_directory_symlink(scenes, folder / "scenes");
    writeText(folder / "scene.toml", kScene);
    const RunOptions options{.folder = folder.path(), .environment = {}, .limitS = 110};
    for (const char* name : {"a.png", "b.png"}) {
        const ProgramRun made = runTool({"render", "scene.toml", "-o", name, "--quiet"}, options);
        ASSERT_EQ(made.exitCode, 0) << made.describe();
    }
    std::vector<std::string> help = {"--help"};
    if (!GetParam().empty()) help.insert(help.begin(), GetParam());
    const auto examples = examplesOf(runTool(help).out);
    EXPECT_FALSE(examples.empty()) << "the help has no example";
    for (const std::vector<std::string>& example : examples) {
        const ProgramRun run = runTool(example, options);
        EXPECT_EQ(run.exitCode, 0) << run.describe();
        EXPECT_EQ(run.err.find("shoal: "), std::string::npos) << run.describe();
        std::printf("%6.2f s  %s\n", run.seconds, run.command.c_str());
    }
}

INSTANTIATE_TEST_SUITE_P(All, ToolExamples,
                         testing::Values("", "render", "info", "compare", "reference", "demo", "bench", "completion"),
                         [](const testing::TestParamInfo<std::string>& info) {
                             return info.param.empty() ? "shoal" : info.param;
                         });

// ---- compare's exit codes ----

TEST(ToolCompare, LimitsDecideTheExitCode) {
    const TestFolder folder;
    writeText(folder / "scene.toml", kScene);
    const RunOptions options{.folder = folder.path(), .environment = {}};
    const std::vector<std::string> words = {"render", "scene.toml", "--quiet", "--aov", "depth", "-o"};
    const auto draw = [&](const std::string& file, const std::string& set) {
        std::vector<std::string> all = words;
        all.insert(all.end(), {file, "--set", set});
        const ProgramRun run = runTool(all, options);
        ASSERT_EQ(run.exitCode, 0) << run.describe();
    };
    draw("a.exr", "post.bloom=0");
    draw("b.exr", "shape[0].radius=0.6");
    draw("small.exr", "render.width=32");
    const auto compare = [&](std::vector<std::string> more) {
        more.insert(more.begin(), "compare");
        return runTool(more, options);
    };
    EXPECT_EQ(compare({"a.exr", "a.exr", "--max-rmse", "0", "--max-error", "0", "--min-ssim", "1"}).exitCode, 0);
    EXPECT_EQ(compare({"a.exr", "b.exr"}).exitCode, 0) << "without a limit nothing fails";
    for (const char* limit : {"--max-rmse=0.0001", "--max-error=0.0001", "--min-psnr=90", "--min-ssim=0.9999"})
        EXPECT_EQ(compare({"a.exr", "b.exr", limit}).exitCode, 1) << limit;
    EXPECT_EQ(compare({"a.exr", "b.exr", "--layer", "depth", "--max-rmse", "0.0001"}).exitCode, 1);
    EXPECT_EQ(compare({"a.exr", "a.exr", "--layer", "depth", "--max-rmse", "0"}).exitCode, 0);
    expectRefusal(compare({"a.exr", "b.exr", "--layer", "dept"}), 2, {"dept", "did you mean \"depth\""});
    expectRefusal(compare({"a.exr", "small.exr", "--max-rmse", "1"}), 3, {"a.exr", "small.exr"});
    expectRefusal(compare({"a.exr", "absent.exr"}), 3, {"absent.exr"});
    const ProgramRun difference = compare({"a.exr", "b.exr", "-o", "d.png"});
    EXPECT_EQ(difference.exitCode, 0) << difference.describe();
    EXPECT_GT(fs::file_size(folder / "d.png"), 100u);
}

TEST(ToolInfo, BadFilesAreRefused) {
    const TestFolder folder;
    writeText(folder / "words.png", "These are words.\n");
    writeText(folder / "poses.csv", "a,b\n1\n");
    const RunOptions options{.folder = folder.path(), .environment = {}};
    for (const char* file : {"absent.glb", "words.png", "poses.csv", "absent.toml", "absent.shoal", "absent"})
        expectRefusal(runTool({"info", file}, options), 3, {file});
}

TEST(ToolDevice, WithoutThatDeviceIsExitCode4) {
    const ProgramRun devices = runTool({"info", "--devices"});
    ASSERT_EQ(devices.exitCode, 0) << devices.describe();
    const bool hasGpu = devices.out.find("hardware") != std::string::npos;
    const TestFolder folder;
    writeText(folder / "scene.toml", kScene);
    const ProgramRun run =
        runTool({"render", "scene.toml", "-o", "a.png", "--quiet", "--device", hasGpu ? "gpu99" : "gpu"},
                {.folder = folder.path(), .environment = {}});
    if (!hasGpu) expectRefusal(run, 4, {"gpu"});
    EXPECT_FALSE(fs::exists(folder / "a.png"));
}

// ---- the same command twice ----

class ToolTwice : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(ToolTwice, GivesTheSameFiles) {
    const TestFolder folder;
    std::string content[2];
    for (const int threads : {1, 2}) {
        const fs::path place = folder / std::to_string(threads);
        fs::create_directory(place);
        writeText(place / "scene.toml", kScene);
        std::vector<std::string> words = {"render", "scene.toml", "--quiet", "--threads", std::to_string(threads)};
        words.insert(words.end(), GetParam().begin(), GetParam().end());
        const ProgramRun run = runTool(words, {.folder = place, .environment = {}});
        ASSERT_EQ(run.exitCode, 0) << run.describe();
        EXPECT_EQ(run.out + run.err, "") << "--quiet";
        std::size_t files = 0;
        for (const auto& [file, bytes] : contentOf(place)) {
            content[threads - 1] += fs::path(file).filename().string() + "\n" + bytes;
            ++files;
        }
        EXPECT_GT(files, 1u);
    }
    EXPECT_EQ(content[0].size(), content[1].size());
    EXPECT_TRUE(content[0] == content[1]) << "the files differ";
}

const std::vector<std::vector<std::string>> kTwice = {
    {"-o", "a.png"},
    {"-o", "a.jpg"},
    {"-o", "a.exr", "--aov", "all"},
    {"-o", "f.png", "--frames", "3:6"},
    {"-o", "f.exr", "--frames", "0:2", "--antialiasing", "temporal", "--poses", "poses.csv"},
    {"-o", "a.mp4", "--frames", "0:4"},
};
std::string nameOfTwice(const testing::TestParamInfo<std::vector<std::string>>& info) {
    constexpr const char* kNames[] = {"Png", "Jpeg", "ExrWithAovs", "NumberedPng", "NumberedExrTemporal", "Film"};
    return kNames[info.index];
}
INSTANTIATE_TEST_SUITE_P(All, ToolTwice, testing::ValuesIn(kTwice), nameOfTwice);

}  // namespace
}  // namespace shoal::test
