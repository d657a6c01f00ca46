// The rows of water that are times of Shoal's own method alone: whole frames of the shipped scenes, and what a GPU
// takes.
#include <cstdio>

#include "bench/frame_row.h"
#include "bench/method_pair.h"
#include "verbs.h"

namespace shoal::bench {

namespace {

// Along the scene's own camera path, spread over all of it: above the water, through it, below.
Result<std::vector<Row>> shippedScene(const Settings& settings, const char* id, const std::string& scene) {
    SHOAL_TRY_ASSIGN(const std::string folder, app::scenesFolder());
    const std::string what = scene + ".toml along its camera path";
    return frameRow(settings, id, folder + "/" + scene + ".toml", what.c_str(),
                    [&settings](const pipeline::Pipeline& pipeline, int i) -> std::optional<light::Camera> {
                        const float duration = pipeline.scene().render.duration;
                        const float at = duration * std::min(1.0f, float(i) / float(3 + 4 * settings.repetitions));
                        return scene::cameraAt(pipeline.scene(), pipeline.content(), at, 16.0f / 9.0f);
                    });
}

struct GpuWork {
    const char* id;
    int width, height, photons, godrayPhotons;
};

bool skippedWithoutGpu(gl::Device& device, const char* id) {
    if (device.software()) note("  %s: skipped, needs a GPU", id);
    return device.software();
}

// Photons, intersection, deposits, shafts, upsampling of one frame.
Result<std::vector<Row>> gpuFrame(const Settings& settings, const GpuWork& work) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    if (skippedWithoutGpu(pair.device(), work.id)) return std::vector<Row>{};
    const Overrides overrides = shoalOverrides(work.photons, work.godrayPhotons);
    SHOAL_TRY(pair.load("water_speed", overrides, overrides));
    pair.setSize(work.width, work.height);
    SHOAL_TRY_ASSIGN(const MethodPair::Both both, pair.inTurns(settings.repetitions));
    char text[200];
    std::snprintf(text, sizeof text, "%d + %d photons, %dx%d, medians of %d; light depth apart %.2f ms; ", work.photons,
                  work.godrayPhotons, work.width, work.height, settings.repetitions, both.shoal.lightDepth);
    return std::vector<Row>{rowOf(work.id, both.shoal.work(), "ms", text + passText(both.shoal))};
}

// Photons a second through the photon pass: traced, their light put down.
Result<std::vector<Row>> gpuPhotons(const Settings& settings, const char* id) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    if (skippedWithoutGpu(pair.device(), id)) return std::vector<Row>{};
    constexpr int kPhotons = 4000000;
    const Overrides overrides = shoalOverrides(kPhotons, 40000);
    SHOAL_TRY(pair.load("water_speed", overrides, overrides));
    SHOAL_TRY_ASSIGN(const MethodPair::Both both, pair.inTurns(settings.repetitions));
    const auto pass = both.shoal.passes.find("caustic photons");
    if (pass == both.shoal.passes.end() || !(pass->second > 0)) return internalError("no time of the photon pass");
    char text[120];
    std::snprintf(text, sizeof text, "%d photons in %.3f ms, medians of %d; water_speed.toml", kPhotons, pass->second,
                  settings.repetitions);
    return std::vector<Row>{rowOf(id, kPhotons / (pass->second / 1000), "1/s", text)};
}

}  // namespace

std::vector<Benchmark> waterFrameBenchmarks() {
    std::vector<Benchmark> rows;
    struct Shipped {
        const char *id, *scene;
    };
    for (const Shipped& s :
         {Shipped{"water.tank_720p_ms", "tank"}, Shipped{"water.port_720p_ms", "port"},
          Shipped{"water.flooded_hall_720p_ms", "flooded_hall"}, Shipped{"water.reef_720p_ms", "reef"}})
        rows.push_back({s.id, "median frame of the shipped scene along its camera path, 1280x720, and each pass",
                        [s](const Settings& settings) { return shippedScene(settings, s.id, s.scene); }});
    static constexpr GpuWork kWorks[] = {{"water.gpu_160k_1080p_ms", 1920, 1080, 160000, 40000},
                                         {"water.gpu_160k_4k_ms", 3840, 2160, 160000, 40000},
                                         {"water.gpu_1m_1080p_ms", 1920, 1080, 1000000, 360000},
                                         {"water.gpu_1m_4k_ms", 3840, 2160, 1000000, 360000}};
    for (const GpuWork& work : kWorks)
        rows.push_back({work.id, "on a GPU: photons, intersection, deposits, shafts, upsampling of one frame",
                        [&work](const Settings& settings) { return gpuFrame(settings, work); }});
    rows.push_back({"water.gpu_photons_per_s", "on a GPU: photons a second through the photon pass",
                    [](const Settings& settings) { return gpuPhotons(settings, "water.gpu_photons_per_s"); }});
    return rows;
}

}  // namespace shoal::bench
