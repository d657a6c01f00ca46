// The rows of the frame: time to a picture, time per frame, start-up, memory, same bits.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <set>

#include <shoal/core/hash.h>
#include <shoal/gl/device.h>
#include <shoal/io/file.h>
#include <shoal/io/image.h>
#include <shoal/pipeline/pipeline.h>

#include "bench/frame_row.h"
#include "bench/harness.h"
#include "bench/peers/f3d.h"

namespace shoal::bench {

namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr const char* kTown = "scenes/town_street.glb";
constexpr const char* kStartupVariable = "SHOAL_BENCH_STARTUP";  // set for the processes that time their own start

// Start-up is measured in processes of its own (measureStartupIfAsked): this one has its libraries and caches warm.
Result<std::vector<Row>> startup(const Settings& settings) {
    std::vector<double> times;
    for (int i = -1; i < settings.repetitions; ++i) {  // the first warms the caches
        const Ran ran = runProgram({settings.tool, "bench", "frame.startup_ms", "--device", settings.device},
                                   {{kStartupVariable, "1"}});
        const std::size_t at = ran.output.find("startup_ms=");
        if (ran.exitCode != 0 || at == std::string::npos) return internalError("the start-up process failed");
        if (i >= 0) times.push_back(std::atof(ran.output.c_str() + at + 11));
    }
    const Spread spread = spreadOf(times);
    Row row{.id = "frame.startup_ms", .value = spread.median, .unit = "ms", .peer = {}, .renderer = {}, .method = {}};
    row.method = spread.describe("ms") + "; device and all programs, new process, shader cache warm";
    return std::vector<Row>{row};
}

// An orbit round what the file holds.
std::optional<light::Camera> orbit(const pipeline::Pipeline& pipeline, int i) {
    const Bounds bounds = pipeline.content().focus;
    const float angle = 0.6f + 0.01f * float(i);
    const Vec3 toEye{std::cos(0.35f) * std::sin(angle), std::sin(0.35f), std::cos(0.35f) * std::cos(angle)};
    return light::cameraLookingAt(bounds.center() + toEye * (0.9f * bounds.radius()), bounds.center(), radians(50));
}

Result<std::vector<Row>> sceneRow(const Settings& settings, const char* id, const char* relative) {
    const std::string file = dataFile(settings, id, relative);
    if (file.empty()) return std::vector<Row>{};
    return frameRow(settings, id, file, relative, orbit);
}

// 100 characters in motion, ten each of the pack's nine (one twice).
Result<std::vector<Row>> skinned(const Settings& settings) {
    const char* const kNames[] = {"Casual2_Female", "Casual2_Male", "Casual_Female", "Casual_Male", "OldClassy_Female",
                                  "Suit_Female",    "Suit_Male",    "Worker_Female", "Worker_Male", "Casual_Male"};
    std::string text = "[[shape]]\nkind = \"plane\"\nwidth = 60\ndepth = 60\n";
    for (int i = 0; i < 10; ++i) {
        const std::string file =
            dataFile(settings, "frame.skinned_100_ms", std::string("characters/uacp/") + kNames[i] + ".gltf");
        if (file.empty()) return std::vector<Row>{};
        text += "[[model]]\nfile = \"" + std::filesystem::absolute(file).string() +
                "\"\nclip = \"Walk\"\nscale = 0.55\nposition = [0, 0, " + std::to_string(1.5 * (i - 4.5)) +
                "]\ncopies = { countX = 10, spacingX = 1.5 }\n";
    }
    const std::string scene = settings.scratchDir + "/skinned.toml";
    SHOAL_TRY(io::writeFileAtomically(scene, std::string_view(text)));
    return frameRow(settings, "frame.skinned_100_ms", scene, "100 walking characters of characters/uacp on a plane",
                    orbit);
}

Result<std::vector<Row>> memory(const Settings& settings) {
    const std::string file = dataFile(settings, "frame.memory_mib", kTown);
    if (file.empty()) return std::vector<Row>{};
    SHOAL_TRY_ASSIGN(const Stage stage, makeStage(settings.device));
    SHOAL_TRY(stage.pipeline->open(file));
    SHOAL_TRY(stage.pipeline->render({}));
    const double held = double(stage.device->liveBytes()) / (1024 * 1024);
    const Ran ran = runProgram({settings.tool, "render", file, "-o", settings.scratchDir + "/memory.png", "--quiet",
                                "--device", settings.device});
    if (ran.exitCode != 0) return internalError("shoal render failed");
    Row row{.id = "frame.memory_mib", .value = held, .unit = "MiB", .peer = {}, .renderer = {}, .method = {}};
    char text[160];
    std::snprintf(text, sizeof text,
                  "GL buffers and textures with town_street at 1280x720; whole process's largest resident set %.0f MiB",
                  ran.peakMib);
    row.method = text;
    return std::vector<Row>{row};
}

// Ten new processes, five with one thread everywhere and five with two: every radiance bit must agree.
Result<std::vector<Row>> bitIdentical(const Settings& settings) {
    const std::string file = dataFile(settings, "frame.bit_identical", "characters/uacp/Casual_Male.gltf");
    if (file.empty()) return std::vector<Row>{};
    std::set<std::uint64_t> hashes;
    constexpr int kRuns = 10;
    for (int i = 0; i < kRuns; ++i) {
        const std::string picture = settings.scratchDir + "/bits.exr";
        const std::string threads = i % 2 ? "2" : "1";
        const Ran ran = runProgram({settings.tool, "render", file, "-o", picture, "--size", "640x360", "--time", "0.4",
                                    "--quiet", "--device", settings.device, "--aov", "all", "--threads", threads},
                                   {{"LP_NUM_THREADS", threads}});
        if (ran.exitCode != 0) return internalError("shoal render failed");
        SHOAL_TRY_ASSIGN(const std::vector<Layer> layers, io::readLayers(picture));
        std::uint64_t hash = kFnvStart;
        for (const Layer& layer : layers) hash = fnv1a(std::as_bytes(std::span(layer.image.pixels)), hash);
        hashes.insert(hash);
    }
    Row row{.id = "frame.bit_identical",
            .value = hashes.size() == 1 ? 1.0 : 0.0,
            .unit = "",
            .peer = {},
            .renderer = {},
            .method = {}};
    row.method = std::to_string(kRuns) +
                 " processes with 1 and 2 threads in turn, radiance and all AOVs: " + std::to_string(hashes.size()) +
                 " different picture" + (hashes.size() == 1 ? "" : "s");
    return std::vector<Row>{row};
}

// The whole process from start to PNG, ours and f3d's in turn; the first run of each, with caches cold, is printed
// beside.
Result<std::vector<Row>> firstPicture(const Settings& settings) {
    const std::string file = dataFile(settings, "frame.first_picture_s", kTown);
    if (file.empty()) return std::vector<Row>{};
    const std::string ours = settings.scratchDir + "/ours.png";
    const std::vector<std::string> command = {settings.tool, "render",   file,      "-o",       ours,
                                              "--size",      "1280x720", "--quiet", "--device", settings.device};
    std::unique_ptr<F3d> f3d;
    if (settings.peers) {
        auto started = F3d::start(settings, file, kWidth, kHeight);
        if (!started)
            note("  frame.first_picture_s: no peer: %s", started.error().message.c_str());
        else
            f3d = *std::move(started);
    }
    const std::string coldCache = settings.scratchDir + "/cold_cache";
    const Ran cold = runProgram(command, {{"MESA_SHADER_CACHE_DIR", coldCache + "_ours"}});
    if (cold.exitCode != 0) return internalError("shoal render failed");
    const double peerCold = f3d ? f3d->draw({{"MESA_SHADER_CACHE_DIR", coldCache + "_f3d"}}).seconds : 0;
    std::vector<double> times, peerTimes;
    for (int i = -1; i < settings.repetitions; ++i) {
        const Ran mine = runProgram(command);
        if (mine.exitCode != 0) return internalError("shoal render failed");
        if (i >= 0) times.push_back(mine.seconds);
        if (!f3d) continue;
        const Ran theirs = f3d->draw({});
        if (theirs.exitCode != 0) return internalError("f3d failed");
        if (i >= 0) peerTimes.push_back(theirs.seconds);
    }
    const Spread spread = spreadOf(times);
    Row row{
        .id = "frame.first_picture_s", .value = spread.median, .unit = "s", .peer = {}, .renderer = {}, .method = {}};
    char text[200];
    std::snprintf(text, sizeof text, "; process start to PNG, town_street 1280x720, warm; cold first run %.2f s",
                  cold.seconds);
    row.method = spread.describe("s") + text;
    if (f3d) {
        const Spread theirs = spreadOf(peerTimes);
        SHOAL_TRY_ASSIGN(const double overlap, f3d->coverageOverlap());
        row.baseline = theirs.median;
        row.ratio = theirs.median / spread.median;
        row.peer = "f3d";
        std::snprintf(text, sizeof text, "; f3d %s, cold %.2f s; same pixels covered: %.1f %%",
                      theirs.describe("s").c_str(), peerCold, 100 * overlap);
        row.method += text;
        if (overlap < 0.97)
            return internalError("f3d drew another picture: its coverage overlaps ours by " + std::to_string(overlap));
    }
    return std::vector<Row>{row};
}

}  // namespace

Result<void> measureStartupIfAsked(const std::string& device) {
    if (!std::getenv(kStartupVariable)) return {};
    Result<Stage> stage = badInput("not made");
    const double seconds = timed([&] { stage = makeStage(device); });
    if (!stage) return stage.error();
    std::printf("startup_ms=%.3f\n", seconds * 1000);
    std::fflush(stdout);
    ::_exit(0);
}

std::vector<Benchmark> frameBenchmarks() {
    return {
        {"frame.first_picture_s",
         "process start to PNG, caches warm, data/scenes/town_street.glb at 1280x720; peer f3d", firstPicture},
        {"frame.town_720p_ms", "median frame of an orbit round data/scenes/town_street.glb, 1280x720, and each pass",
         [](const Settings& s) { return sceneRow(s, "frame.town_720p_ms", kTown); }},
        {"frame.harbour_720p_ms", "the same for data/scenes/harbour.glb",
         [](const Settings& s) { return sceneRow(s, "frame.harbour_720p_ms", "scenes/harbour.glb"); }},
        {"frame.skinned_100_ms", "median frame with 100 animated characters of data/characters/uacp, 1280x720",
         skinned},
        {"frame.startup_ms", "device and all programs, warm", startup},
        {"frame.memory_mib", "what GL objects hold with town_street at 1280x720", memory},
        {"frame.bit_identical", "1 when 10 runs with 1 and 2 threads give the same bits", bitIdentical},
    };
}

}  // namespace shoal::bench
