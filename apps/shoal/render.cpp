// shoal render
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <future>

#include <shoal/core/parallel.h>
#include <shoal/core/progress.h>
#include <shoal/gl/device.h>
#include <shoal/io/movie.h>
#include <shoal/pipeline/pipeline.h>

#include "verbs.h"

namespace shoal::app {

namespace {

// Set by ^C: the frame under way is finished, then what is half written is removed.
std::atomic<bool> stopAsked = false;

void askToStop(int) {
    stopAsked = true;
    std::signal(SIGINT, SIG_DFL);  // a second ^C stops at once
}

// With digits enough to read the same number back.
std::string words(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value);
    return text;
}

// The command line as overrides of the scene, so that one place checks every value.
Result<std::vector<scene::Override>> overridesOf(const RenderOptions& o) {
    SHOAL_TRY_ASSIGN(std::vector<scene::Override> overrides, parseOverrides(o.sets));
    if (!o.size.empty()) {
        SHOAL_TRY_ASSIGN(const IVec2 size, parseSize(o.size));
        overrides.push_back({"render.width", std::to_string(size.x)});
        overrides.push_back({"render.height", std::to_string(size.y)});
    }
    if (o.fps) overrides.push_back({"render.fps", words(*o.fps)});
    if (o.time) overrides.push_back({"render.time", words(*o.time)});
    if (o.samples) overrides.push_back({"render.samples", std::to_string(*o.samples)});
    if (o.seed) overrides.push_back({"render.seed", std::to_string(*o.seed)});
    if (!o.antialiasing.empty()) overrides.push_back({"render.antialiasing", o.antialiasing});
    if (o.transparent) overrides.push_back({"lighting.background", "transparent"});
    if (!o.up.empty()) overrides.push_back({"model[0].up", o.up});
    if (o.scale) {
        if (!(*o.scale > 0)) return usageError("--scale: found " + words(*o.scale) + ", expected metres above 0");
        overrides.push_back({"model[0].unit", words(*o.scale)});
    }
    return overrides;
}

Result<void> run(const RenderOptions& o) {
    const auto start = std::chrono::steady_clock::now();
    const ThreadLimit threads(o.threads);
    SHOAL_TRY_ASSIGN(const std::vector<scene::Override> overrides, overridesOf(o));
    pipeline::OutputOptions output;
    SHOAL_TRY_ASSIGN(output.aovs, pipeline::parseAovList(o.aovs));
    if (!o.frames.empty()) {
        SHOAL_TRY_ASSIGN(const auto frames, parseFrames(o.frames));
        output.firstFrame = frames.first;
        output.endFrame = frames.second;
        output.isStill = false;
    }
    // A scene that cannot be read is told before a device is asked for.
    SHOAL_TRY_ASSIGN(const scene::Scene scene, scene::openScene(o.scene, overrides));
    const LogSink log = o.quiet ? nullSink() : stderrSink(o.debug ? LogLevel::debug : LogLevel::warning);
    // Files are read while the driver starts.
    std::future<Result<scene::Content>> reading =
        std::async(std::launch::async, [&] { return scene::loadContent(scene, log); });
    gl::DeviceOptions deviceOptions;
    deviceOptions.device = o.device;
    deviceOptions.log = log;
    deviceOptions.debug = o.debug;
    auto opened = openDevice(deviceOptions);
    auto created =
        opened ? pipeline::Pipeline::create(**opened) : Result<std::unique_ptr<pipeline::Pipeline>>(opened.error());
    // What is wrong with the scene's files is told first, whatever the device says.
    SHOAL_TRY_ASSIGN(scene::Content content, reading.get());
    SHOAL_TRY_ASSIGN(const auto device, std::move(opened));
    SHOAL_TRY_ASSIGN(const auto pipeline, std::move(created));
    SHOAL_TRY(pipeline->setScene(scene, std::move(content)));

    output.fps = scene.render.fps;
    output.transparent = o.transparent;
    output.jpegQuality = o.quality;
    output.posesFile = o.posesFile;
    if (output.isStill && io::isMovieFile(o.output)) {
        output.isStill = false;
        output.endFrame = std::max(1, int(std::lround(scene.render.duration * scene.render.fps)));
    }
    // [render] time is a still's; a film shows the whole of a path.
    output.startTime = output.isStill ? scene.render.time : float(o.time.value_or(0));
    std::optional<ProgressBar> bar;
    if (!output.isStill) {
        std::signal(SIGINT, askToStop);
        if (!o.quiet) bar.emplace("rendering", "frames", stderr);
        output.progress = [&](std::uint64_t done, std::uint64_t total) {
            if (bar) bar->update(done, total);
            return !stopAsked;
        };
    }
    SHOAL_TRY_ASSIGN(const auto written,
                     pipeline::renderToFile(*pipeline, pipeline::requestFor(scene.render), o.output, output));
    if (bar) bar->finish();
    if (o.quiet) return {};
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const int frames = output.isStill ? 1 : output.endFrame - output.firstFrame;
    std::printf("%s%s: %d x %d, %d frame%s in %.2f s on %s\n", written.front().c_str(),
                written.size() > 1 ? " ..." : "", scene.render.width, scene.render.height, frames,
                frames == 1 ? "" : "s", seconds, device->info().renderer.c_str());
    return {};
}

}  // namespace

int render(const RenderOptions& options) {
    const Result<void> done = run(options);
    return done ? kDone : report(done.error());
}

}  // namespace shoal::app
