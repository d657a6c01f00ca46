// shoal demo: the shipped scenes, drawn.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>

#include <shoal/core/progress.h>
#include <shoal/gl/device.h>
#include <shoal/pipeline/pipeline.h>

#include "verbs.h"

namespace shoal::app {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

Result<std::vector<std::filesystem::path>> shippedScenes() {
    SHOAL_TRY_ASSIGN(const std::string folder, scenesFolder());
    std::vector<std::filesystem::path> scenes;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error))
        if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
    if (scenes.empty()) return badInput(folder + ": found no scene, expected *.toml");
    std::sort(scenes.begin(), scenes.end());
    return scenes;
}

// Draws one scene to DIR/name.png (and .mp4) and prints its row.
Result<void> drawScene(pipeline::Pipeline& pipeline, const std::filesystem::path& file, const DemoOptions& o,
                       std::span<const scene::Override> overrides) {
    const auto start = Clock::now();
    SHOAL_TRY(pipeline.open(file, overrides));
    const double loadSeconds = secondsSince(start);
    const scene::RenderSpec& spec = pipeline.scene().render;
    pipeline::FrameRequest request = pipeline::requestFor(spec);
    const std::string output = (std::filesystem::path(o.folder) / file.stem()).string();
    const auto drawStart = Clock::now();
    SHOAL_TRY(pipeline::renderToFile(pipeline, request, output + ".png", {}));
    const double drawSeconds = secondsSince(drawStart);
    // One frame as a film would draw it: one sample, temporal antialiasing, warm.
    request.antialiasing = "temporal";
    SHOAL_TRY(pipeline.render(request));
    pipeline.setTiming(true);
    request.frameIndex = 1;
    SHOAL_TRY(pipeline.render(request));
    SHOAL_TRY(pipeline.readDisplay());
    double frameMs = 0;
    for (const gl::PassTime& pass : pipeline.stats().passes) frameMs += pass.timeMs;
    pipeline.setTiming(false);
    long long triangles = 0;
    for (const auto& [name, value] : pipeline.stats().counts)
        if (name == "drawn triangles") triangles = value;
    std::printf("%-28s %5d x %-5d %9lld %9.0f %10.0f %11.1f\n", (output + ".png").c_str(), spec.width, spec.height,
                triangles, loadSeconds * 1000, drawSeconds * 1000, frameMs);
    std::fflush(stdout);
    if (!o.film) return {};
    ProgressBar bar("filming " + file.stem().string(), "frames", stderr);
    pipeline::OutputOptions film;
    film.isStill = false;
    film.fps = spec.fps;
    film.endFrame = std::max(1, int(spec.duration * spec.fps));
    film.progress = [&](std::uint64_t done, std::uint64_t total) { return bar.update(done, total), true; };
    SHOAL_TRY(pipeline::renderToFile(pipeline, request, output + ".mp4", film));
    bar.finish();
    return {};
}

Result<void> run(const DemoOptions& o) {
    std::vector<scene::Override> overrides;
    if (!o.size.empty()) {
        SHOAL_TRY_ASSIGN(const IVec2 size, parseSize(o.size));
        overrides.push_back({"render.width", std::to_string(size.x)});
        overrides.push_back({"render.height", std::to_string(size.y)});
    }
    SHOAL_TRY_ASSIGN(const auto scenes, shippedScenes());
    gl::DeviceOptions deviceOptions;
    deviceOptions.device = o.device;
    deviceOptions.log = stderrSink();
    SHOAL_TRY_ASSIGN(const auto device, openDevice(deviceOptions));
    SHOAL_TRY_ASSIGN(const auto pipeline, pipeline::Pipeline::create(*device));
    std::printf("drawn on %s (%s)\n", device->info().renderer.c_str(),
                device->info().software ? "software, CPU" : "GPU");
    std::printf("%-28s %13s %9s %9s %10s %11s\n", "picture", "size", "triangles", "load ms", "picture ms", "frame ms");
    for (const auto& file : scenes) SHOAL_TRY(drawScene(*pipeline, file, o, overrides));
    std::printf("picture ms: antialiased still with PNG; frame ms: one frame of a film, %s\n",
                gl::FrameTimer::method(*device));
    return {};
}

}  // namespace

int demo(const DemoOptions& options) {
    const Result<void> done = run(options);
    return done ? kDone : report(done.error());
}

}  // namespace shoal::app
