#include "bench/frame_row.h"

#include <algorithm>
#include <cstdio>
#include <map>

namespace shoal::bench {

namespace {

constexpr int kWidth = 1280, kHeight = 720;
constexpr float kFps = 30;

struct PassSums {
    std::vector<std::string> names;  // in the order of the frame
    std::map<std::string, std::vector<double>> times;
    void add(const std::vector<gl::PassTime>& passes) {
        for (const gl::PassTime& pass : passes) {
            if (!times.contains(pass.name)) names.push_back(pass.name);
            times[pass.name].push_back(pass.timeMs);
        }
    }
    std::string describe() const {
        std::string text;
        for (const std::string& name : names) {
            char one[80];
            std::snprintf(one, sizeof one, "%s%s %.1f", text.empty() ? "" : ", ", name.c_str(),
                          spreadOf(times.at(name)).median);
            text += one;
        }
        return text;
    }
};

}  // namespace

Result<Stage> makeStage(const std::string& device) {
    Stage stage;
    gl::DeviceOptions options;
    options.device = device;
    options.log = stderrSink();
    SHOAL_TRY_ASSIGN(stage.device, gl::Device::create(options));
    SHOAL_TRY_ASSIGN(stage.pipeline, pipeline::Pipeline::create(*stage.device));
    return stage;
}

Result<std::vector<Row>> frameRow(const Settings& settings, const char* id, const std::string& file, const char* what,
                                  const EyeAt& eyeAt) {
    SHOAL_TRY_ASSIGN(const Stage stage, makeStage(settings.device));
    SHOAL_TRY(stage.pipeline->open(file));
    pipeline::FrameRequest request;
    request.width = kWidth, request.height = kHeight;
    request.antialiasing = "temporal";
    const auto drawFrame = [&](int i) -> Result<void> {
        request.camera = eyeAt(*stage.pipeline, i);
        request.frameIndex = std::uint32_t(i);
        request.time = float(i) / kFps;
        SHOAL_TRY(stage.pipeline->render(request));
        // Reading one pixel's worth waits for the frame on any driver.
        SHOAL_TRY(stage.pipeline->readDisplay());
        return {};
    };
    constexpr int kWarmUp = 3;
    std::vector<double> times;
    Result<void> drawn;
    const int frameCount = std::max(settings.repetitions * 3, 9);
    for (int i = 0; i < kWarmUp + frameCount && drawn; ++i) {
        const double seconds = timed([&] { drawn = drawFrame(i); });
        if (i >= kWarmUp) times.push_back(seconds * 1000);
    }
    SHOAL_TRY(drawn);
    const Spread spread = spreadOf(times);
    stage.pipeline->setTiming(true);
    PassSums sums;
    for (int i = 0; i < settings.repetitions; ++i) {
        SHOAL_TRY(drawFrame(kWarmUp + frameCount + i));
        sums.add(stage.pipeline->stats().passes);
    }
    note("  %s passes, ms (%s): %s", id, gl::FrameTimer::method(*stage.device), sums.describe().c_str());
    return std::vector<Row>{
        rowOf(id, spread.median, "ms",
              spread.describe("ms") + "; " + what + ", 1280x720, temporal, wall clock with read back")};
}

}  // namespace shoal::bench
