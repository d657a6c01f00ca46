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

constexpr float kPatch = 0.05f;                      // metres
constexpr int kFewestPixels = 16;                    // of a patch that counts
constexpr std::int64_t kReferenceRays = 64'000'000;  // of each half

// Sums over the pixels that show a patch.
struct Patch {
    double ours = 0, exact[2] = {};
    int pixels = 0;
};

// World point that a pixel shows.
Vec3 pointAt(const light::View& view, int x, int y, float depth) {
    const Vec3 onNear = transformPoint(view.viewFromClip, {2 * (float(x) + 0.5f) / float(view.width) - 1,
                                                           1 - 2 * (float(y) + 0.5f) / float(view.height), 1});
    return transformPoint(view.worldFromView, onNear * (-depth / onNear.z));
}

// The reference knows triangles only: irradiance on a plane of smoothed or mapped normals is another quantity.
void showFacets(Primitive& p) {
    Primitive flat;
    flat.material = p.material, flat.bounds = p.bounds;
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
        const Vec3 a = p.positions[p.indices[i]], b = p.positions[p.indices[i + 1]], c = p.positions[p.indices[i + 2]];
        const Vec3 across = cross(b - a, c - a);
        if (!(length(across) > 0)) continue;
        for (const Vec3 corner : {a, b, c}) {
            flat.indices.push_back(std::uint32_t(flat.positions.size()));
            flat.positions.push_back(corner);
            flat.normals.push_back(normalize(across));
        }
    }
    p = std::move(flat);
}
void showFacets(scene::Content& content) {
    for (Model& model : content.models) {
        for (Material& material : model.materials)
            material.baseColorTexture = material.metallicRoughnessTexture = material.normalTexture =
                material.occlusionTexture = material.emissionTexture = {};
        for (ModelMesh& mesh : model.meshes)
            for (Primitive& primitive : mesh.primitives) showFacets(primitive);
    }
}

Result<Image> traced(WaterStage& stage, std::uint32_t seed) {
    const scene::Scene& scene = stage.pipeline().scene();
    const scene::Content& content = stage.pipeline().content();
    SHOAL_TRY_ASSIGN(const water::WaveField waves, wavesOf(scene));
    SHOAL_TRY_ASSIGN(const std::optional<pipeline::WaterSpec> spec, pipeline::readWater(scene));
    if (!spec) return internalError("water_ruin has no water");
    water::Body body;
    body.params = spec->setup.body;
    SHOAL_TRY_ASSIGN(body.optics, water::resolveOptics(spec->setup.optics));
    body.waves = &waves;
    water::BodyLights lights;
    if (content.sun) lights.sun = &*content.sun;
    lights.punctual = content.lights;
    water::ReferenceOptions options;
    options.rays = kReferenceRays;
    options.seed = seed;
    return water::referenceCaustics(pipeline::referenceScene(content, scene.render.time), body, lights,
                                    stage.pipeline().view(), options);
}

// Errors over patches, relative to the mean. Two independent halves of the reference tell its own noise, and our error
// free of it: the mean product of our differences from each, in which the noise of one has no part of the other.
struct SceneError {
    double against = 0, noise = 0, ours = 0, mean = 0;
    int count = 0;
};
SceneError errorOf(const std::map<std::tuple<int, int, int>, Patch>& patches) {
    double against = 0, noise = 0, ours = 0, sum = 0, oursSum = 0;
    SceneError e;
    for (const auto& [place, patch] : patches) {
        if (patch.pixels < kFewestPixels) continue;
        const double own = patch.ours / patch.pixels, a = patch.exact[0] / patch.pixels,
                     b = patch.exact[1] / patch.pixels, exact = 0.5 * (a + b);
        against += (own - exact) * (own - exact), noise += 0.25 * (a - b) * (a - b), ours += (own - a) * (own - b);
        sum += exact, oursSum += own, ++e.count;
    }
    const double mean = sum / e.count;
    const auto relative = [&](double squares) { return std::sqrt(std::max(squares, 0.0) / e.count) / mean; };
    e.against = relative(against), e.noise = relative(noise), e.ours = relative(ours), e.mean = oursSum / sum;
    return e;
}

Result<std::vector<Row>> ruin(const Settings& settings) {
    const std::string model = dataFile(settings, "water.scene_rmse", "scenes/sunken_ruin.glb");
    if (model.empty()) return std::vector<Row>{};
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY(stage.load("water_ruin", {"model[0].file=" + std::filesystem::absolute(model).string()},
                         [](scene::Content& content) { showFacets(content); }));
    SHOAL_TRY_ASSIGN(const Image ours, stage.draw("caustics"));
    SHOAL_TRY_ASSIGN(const Image depth, stage.draw("depth"));
    Image exact[2];
    for (std::uint32_t half = 0; half < 2; ++half) {
        SHOAL_TRY_ASSIGN(exact[half], traced(stage, half + 1));
    }
    std::map<std::tuple<int, int, int>, Patch> patches;
    for (int y = 0; y < ours.height; ++y) {
        for (int x = 0; x < ours.width; ++x) {
            const float z = *depth.at(x, y);
            if (z <= 0) continue;
            const Vec3 p = pointAt(stage.pipeline().view(), x, y, z) * (1 / kPatch);
            Patch& patch = patches[{int(std::floor(p.x)), int(std::floor(p.y)), int(std::floor(p.z))}];
            patch.ours += double(ours.at(x, y)[1]), ++patch.pixels;
            for (int half = 0; half < 2; ++half) patch.exact[half] += double(exact[half].at(x, y)[1]);
        }
    }
    const SceneError e = errorOf(patches);
    char method[300];
    std::snprintf(method, sizeof method,
                  "%d patches of 5 cm of at least %d pixels, green, sunken_ruin.glb's facets under an ocean, 640 k "
                  "photons; %.1f %% against 2 x 64 M traced rays, whose own noise is %.1f %%; mean %.4f of theirs; "
                  "water_ruin.toml",
                  e.count, kFewestPixels, 100 * e.against, 100 * e.noise, e.mean);
    return std::vector<Row>{rowOf("water.scene_rmse", 100 * e.ours, "%", method)};
}

}  // namespace

std::vector<Benchmark> waterSceneBenchmarks() {
    return {{"water.scene_rmse", "irradiance on a ruin under an ocean against traced rays", ruin}};
}

}  // namespace shoal::bench
