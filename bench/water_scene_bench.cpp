// The row of water that weighs a whole scene: a ruin under an ocean against the double-precision reference.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <tuple>

#include <shoal/pipeline/water.h>

#include "bench/water_stage.h"

namespace shoal::bench {

namespace {

constexpr float kPatch = 0.05f;   // metres
constexpr int kFewestPixels = 4;  // of a patch that counts
constexpr std::int64_t kReferenceRays = 64'000'000;

struct Patch {
    double ours = 0, exact = 0;
    int pixels = 0;
};

// World point that a pixel shows.
Vec3 pointAt(const light::View& view, int x, int y, float depth) {
    const Vec3 onNear = transformPoint(view.viewFromClip, {2 * (float(x) + 0.5f) / float(view.width) - 1,
                                                           1 - 2 * (float(y) + 0.5f) / float(view.height), 1});
    return transformPoint(view.worldFromView, onNear * (-depth / onNear.z));
}

Result<Image> traced(WaterStage& stage) {
    const scene::Scene& scene = stage.pipeline().scene();
    const scene::Content& content = stage.pipeline().content();
    SHOAL_TRY_ASSIGN(auto spec, pipeline::readWater(scene));
    SHOAL_TRY_ASSIGN(water::WaveField waves, water::WaveField::create(spec->setup.waves, spec->setup.components));
    waves.setTime(double(scene.render.time));
    water::Body body;
    body.params = spec->setup.body;
    SHOAL_TRY_ASSIGN(body.optics, water::resolveOptics(spec->setup.optics));
    body.waves = &waves;
    water::BodyLights lights;
    if (content.sun) lights.sun = &*content.sun;
    lights.punctual = content.lights;
    water::ReferenceOptions options;
    options.rays = kReferenceRays;
    return water::referenceCaustics(pipeline::referenceScene(content, scene.render.time), body, lights,
                                    stage.pipeline().view(), options);
}

Result<std::vector<Row>> ruin(const Settings& settings) {
    const std::string model = dataFile(settings, "water.scene_rmse", "scenes/sunken_ruin.glb");
    if (model.empty()) return std::vector<Row>{};
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY(stage.load("water_ruin", {"model[0].file=" + std::filesystem::absolute(model).string()}));
    SHOAL_TRY_ASSIGN(const Image ours, stage.draw("caustics"));
    SHOAL_TRY_ASSIGN(const Image depth, stage.draw("depth"));
    SHOAL_TRY_ASSIGN(const Image exact, traced(stage));
    std::map<std::tuple<int, int, int>, Patch> patches;
    for (int y = 0; y < ours.height; ++y) {
        for (int x = 0; x < ours.width; ++x) {
            const float z = *depth.at(x, y);
            if (z <= 0) continue;
            const Vec3 p = pointAt(stage.pipeline().view(), x, y, z) * (1 / kPatch);
            Patch& patch = patches[{int(std::floor(p.x)), int(std::floor(p.y)), int(std::floor(p.z))}];
            patch.ours += double(ours.at(x, y)[1]), patch.exact += double(exact.at(x, y)[1]), ++patch.pixels;
        }
    }
    double squares = 0, mean = 0;
    int count = 0;
    for (const auto& [place, patch] : patches) {
        if (patch.pixels < kFewestPixels) continue;
        const double d = (patch.ours - patch.exact) / patch.pixels;
        squares += d * d, mean += patch.exact / patch.pixels, ++count;
    }
    char method[200];
    std::snprintf(method, sizeof method,
                  "%d patches of 5 cm, green, sunken_ruin.glb under an ocean, 640 k photons, against 64 M traced rays; "
                  "water_ruin.toml",
                  count);
    Row row{.id = "water.scene_rmse",
            .value = 100 * std::sqrt(squares / count) / (mean / count),
            .unit = "%",
            .peer = {},
            .renderer = {},
            .method = method};
    return std::vector<Row>{row};
}

}  // namespace

std::vector<Benchmark> waterSceneBenchmarks() {
    return {{"water.scene_rmse", "irradiance on a ruin under an ocean against traced rays", ruin}};
}

}  // namespace shoal::bench
