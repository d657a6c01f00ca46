// The verbs of the tool: what each is given, and its exit code. The command line is read in command_line.cpp alone.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <shoal/core/result.h>
#include <shoal/gl/device.h>
#include <shoal/scene/scene.h>

namespace shoal::app {

// Exit codes (docs/conventions.md).
inline constexpr int kDone = 0, kComparisonFailed = 1, kUsage = 2, kBadInput = 3, kNoDevice = 4;

// Prints "shoal: message" to stderr and gives the exit code of the error's kind.
int report(const Error& error);

struct RenderOptions {
    std::string scene, output;
    std::string size, frames, aovs, antialiasing, device = "auto", posesFile, up;
    std::optional<double> time, fps, scale;
    std::optional<int> samples;
    std::optional<unsigned> seed;
    std::vector<std::string> sets;
    bool transparent = false, quiet = false, debug = false;
    int quality = 92, threads = 0;
};
int render(const RenderOptions& options);

struct ViewOptions {
    std::vector<std::string> files, sets;
    std::string size = "1280x720", device = "auto", script;
    float uiScale = 0;  // 0: as the screen says
    bool debug = false;
};
int view(const ViewOptions& options);

struct InfoOptions {
    std::vector<std::string> files;
    bool devices = false, keys = false;
};
int info(const InfoOptions& options);
// Every key of a scene file as Markdown tables (`shoal info --keys`).
int printKeys();

struct CompareOptions {
    std::string a, b, layer, differenceFile;  // layer: "" the main picture
    std::optional<double> maxRmse, minPsnr, minSsim, maxError;
    double gain = 4;
};
int compare(const CompareOptions& options);

struct ReferenceVerbOptions {
    std::string scene, output;
    std::string size, aovs = "caustics,inscatter";
    std::optional<double> time;
    std::optional<unsigned> seed;
    std::vector<std::string> sets;
    long long rays = 64'000'000;
    int steps = 512, subPixels = 1, threads = 0;
    bool quiet = false;
};
int reference(const ReferenceVerbOptions& options);

struct DemoOptions {
    std::string folder = "shoal_demo", device = "auto", size;
    bool film = false;
};
int demo(const DemoOptions& options);

struct BenchOptions {
    std::vector<std::string> names;
    std::string jsonFile, device = "auto", dataDir;
    std::string config;  // one of the paper's configurations, "paper-a" to "paper-d"; "" for all rows
    bool peers = false, list = false;
    int repetitions = 7;
};
int bench(const BenchOptions& options);

// The device that --device names; an unknown name is a usage error with the nearest known one.
Result<std::unique_ptr<gl::Device>> openDevice(const gl::DeviceOptions& options);
// "1280x720" to a size.
Result<IVec2> parseSize(const std::string& words);
// "0:300" to first and end.
Result<std::pair<int, int>> parseFrames(const std::string& words);
Result<std::vector<scene::Override>> parseOverrides(const std::vector<std::string>& sets);
// Folder of the shipped scenes: SHOAL_SCENES, else share/shoal/scenes beside the binary's folder.
Result<std::string> scenesFolder();

}  // namespace shoal::app
