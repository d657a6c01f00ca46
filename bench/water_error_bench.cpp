// The rows of water that weigh errors: how fast they fall, at equal time against the paper, the same bits, and the
// web's formulas.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>

#include <shoal/core/hash.h>
#include <shoal/io/image.h>
#include <shoal/pipeline/water.h>
#include <shoal/water/reference.h>

#include <epoxy/gl.h>

#include "bench/method_pair.h"
#include "bench/peers/web_caustics.h"

namespace shoal::bench {

namespace {

constexpr int kSide = 512;  // pixels of water_patch.toml, 4 m

// P6 and its exact irradiance 2 m down, a pixel a bin.
struct Patch {
    water::WaveField waves;
    Image exact;
};
Result<Patch> patchOf(MethodPair& pair) {
    SHOAL_TRY_ASSIGN(water::WaveField waves, wavesOf(pair.pipeline(Method::shoal).scene()));
    Image exact = exactPatch(waves, 0);
    return Patch{std::move(waves), std::move(exact)};
}

Result<std::vector<Row>> errorFalloff(const Settings& settings) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    SHOAL_TRY(pair.load("water_patch", shoalOverrides(160000, 40000), shoalOverrides(1000000, 40000)));
    SHOAL_TRY_ASSIGN(const Patch patch, patchOf(pair));
    SHOAL_TRY_ASSIGN(const Image few, pair.draw(Method::shoal, "caustics"));
    SHOAL_TRY_ASSIGN(const Image many, pair.draw(Method::paper, "caustics"));
    const PictureError a = errorOf(few, patch.exact), b = errorOf(many, patch.exact);
    char text[160];
    std::snprintf(text, sizeof text, "P6, D = 2, 512 x 512: RMSE %.2f %% with 160 k photons, %.2f %% with 1 M",
                  100 * a.rmse, 100 * b.rmse);
    return std::vector<Row>{rowOf("water.error_falloff", a.rmse / b.rmse, "x", text)};
}

// The paper's settings that are tried: grid, points, filter. Its best within our time counts.
struct PaperTry {
    int grid;
    float smallest, largest;
    bool filter;
};

Overrides overridesOf(const PaperTry& t) {
    char points[2][60];
    std::snprintf(points[0], sizeof points[0], "water.paper.smallestPointPx=%g", double(t.smallest));
    std::snprintf(points[1], sizeof points[1], "water.paper.largestPointPx=%g", double(t.largest));
    Overrides overrides = paperOverrides(4 * t.grid * t.grid, 400);
    const char* const filter = t.filter ? "water.paper.filter=true" : "water.paper.filter=false";
    for (const char* one : {"water.paper.causticScale=1", "water.paper.attenuation=0", filter,
                            static_cast<const char*>(points[0]), static_cast<const char*>(points[1])})
        overrides.push_back(one);
    return overrides;
}

double causticMs(const MethodTimes& times) {
    double sum = times.caustics;
    for (const char* name : {"caustic lookup", "paper compose"})
        if (const auto found = times.passes.find(name); found != times.passes.end()) sum += found->second;
    return sum;
}

Result<std::vector<Row>> equalTime(const Settings& settings) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    double best = 0, bestMs = 0, ours = 0, oursRmse = 0;
    PaperTry bestTry{};
    Image exact;
    for (const int grid : {50, 100, 200, 300, 500}) {
        for (const auto& [smallest, largest, filter] :
             {std::tuple{5.0f, 20.0f, true}, {5.0f, 20.0f, false}, {2.0f, 10.0f, true}, {2.0f, 10.0f, false}}) {
            const PaperTry trial{grid, smallest, largest, filter};
            SHOAL_TRY(pair.load("water_patch", shoalOverrides(160000, 40000), overridesOf(trial)));
            if (exact.pixels.empty()) {
                SHOAL_TRY_ASSIGN(Patch patch, patchOf(pair));
                exact = std::move(patch.exact);
                SHOAL_TRY_ASSIGN(const Image own, pair.draw(Method::shoal, "caustics"));
                oursRmse = errorOf(own, exact).rmse;
            }
            SHOAL_TRY_ASSIGN(const Image theirs, pair.draw(Method::paper, "caustics"));
            const double rmse = errorOf(theirs, exact, true).rmse;
            SHOAL_TRY_ASSIGN(const MethodPair::Both both, pair.inTurns(std::max(settings.repetitions / 2, 3)));
            const double paperMs = causticMs(both.paper);
            ours = causticMs(both.shoal);
            note(
                "  water.equal_time_rmse_ratio paper %d^2 x 4, points %g..%g px, filter %s: %.1f ms (ours %.1f), RMSE "
                "%.1f %%",
                grid, double(smallest), double(largest), filter ? "on" : "off", paperMs, ours, 100 * rmse);
            if (paperMs > ours && best > 0) continue;  // slower than ours; the first counts in any case
            if (best == 0 || rmse < best) best = rmse, bestMs = paperMs, bestTry = trial;
        }
    }
    char text[300];
    std::snprintf(text, sizeof text,
                  "P6, D = 2: ours 160 k photons %.1f ms, RMSE %.2f %%; the paper's best in that time %d^2 x 4, points "
                  "%g..%g px, filter %s: %.1f ms, RMSE %.1f %% with its gain fitted; caustics to pixels, no god rays",
                  ours, 100 * oursRmse, bestTry.grid, double(bestTry.smallest), double(bestTry.largest),
                  bestTry.filter ? "on" : "off", bestMs, 100 * best);
    return std::vector<Row>{rowOf("water.equal_time_rmse_ratio", best / oursRmse, "x", text)};
}

// New processes, half of them with one thread everywhere: every bit of the picture and of all AOVs must agree.
Result<std::vector<Row>> bitIdentical(const Settings& settings) {
    SHOAL_TRY_ASSIGN(const std::string folder, checksFolder());
    std::set<std::uint64_t> hashes;
    constexpr int kRuns = 10;
    for (int i = 0; i < kRuns; ++i) {
        const std::string picture = settings.scratchDir + "/water_bits.exr";
        const std::string threads = i % 2 ? "2" : "1";
        const Ran ran =
            runProgram({settings.tool, "render", folder + "/water_speed.toml", "-o", picture, "--size", "400x400",
                        "--quiet", "--device", settings.device, "--aov", "all", "--threads", threads},
                       {{"LP_NUM_THREADS", threads}});
        if (ran.exitCode != 0) return internalError("shoal render failed");
        SHOAL_TRY_ASSIGN(const std::vector<Layer> layers, io::readLayers(picture));
        std::uint64_t hash = kFnvStart;
        for (const Layer& layer : layers) hash = fnv1a(std::as_bytes(std::span(layer.image.pixels)), hash);
        hashes.insert(hash);
    }
    std::string method =
        std::to_string(kRuns) + " processes with 1 and 2 threads in turn, water_speed.toml, radiance " +
        "and all AOVs: " + std::to_string(hashes.size()) + " different picture" + (hashes.size() == 1 ? "" : "s");
    return std::vector<Row>{rowOf("water.bit_identical", hashes.size() == 1 ? 1 : 0, "", std::move(method))};
}

// Mean and errors of a formula with mesh to spare round the patch, its time without.
Result<Row> webRow(MethodPair& pair, const Patch& patch, const WebFormula& formula, const char* id,
                   const Settings& settings) {
    SHOAL_TRY_ASSIGN(water::GpuWaves waves, water::GpuWaves::create(pair.device()));
    SHOAL_TRY(waves.update(patch.waves));
    WebPatch square;
    square.index = float(water::kWaterIndex);
    SHOAL_TRY_ASSIGN(const WebCaustics timed, WebCaustics::create(pair.device(), formula, square));
    std::vector<double> times;
    for (int i = -1; i < settings.repetitions; ++i) {
        const double seconds = bench::timed([&] {
            timed.render(waves);
            glFinish();
        });
        if (i >= 0) times.push_back(1000 * seconds);
    }
    square.marginM = 0.5f;
    SHOAL_TRY_ASSIGN(const WebCaustics whole, WebCaustics::create(pair.device(), formula, square));
    whole.render(waves);
    // Theirs begins at 0, the check scene's picture at -2 of the same period.
    const std::vector<double> bins = whole.bins(kSide);
    Image moved(kSide, kSide, 1);
    for (int z = 0; z < kSide; ++z)
        for (int x = 0; x < kSide; ++x)
            *moved.at((x + kSide / 2) % kSide, (z + kSide / 2) % kSide) = float(bins[std::size_t(z * kSide + x)]);
    const PictureError error = errorOf(moved, patch.exact, true);
    char text[240];
    std::snprintf(text, sizeof text,
                  "mean irradiance over the light's where 0.980 is right; %d^2 mesh, %d^2 map; with the mean matched "
                  "RMSE %.0f %%, mean error %.0f %%; %s",
                  formula.meshSide, formula.mapSide, 100 * error.rmse, 100 * error.mae,
                  spreadOf(times).describe("ms").c_str());
    return rowOf(id, error.mean, "", text);
}

Result<std::vector<Row>> webFormulas(const Settings& settings) {
    if (!settings.peers) {
        note("  water.web_formulas: skipped, needs --peers");
        return std::vector<Row>{};
    }
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    SHOAL_TRY(pair.load("water_patch", shoalOverrides(160000, 40000), shoalOverrides(160000, 40000)));
    SHOAL_TRY_ASSIGN(const Patch patch, patchOf(pair));
    SHOAL_TRY_ASSIGN(const Row webgl, webRow(pair, patch, kWebglWater, "water.web_formulas_webgl_water", settings));
    SHOAL_TRY_ASSIGN(const Row threejs,
                     webRow(pair, patch, kThreejsCaustics, "water.web_formulas_threejs_caustics", settings));
    return std::vector<Row>{webgl, threejs};
}

}  // namespace

std::vector<Benchmark> waterErrorBenchmarks() {
    return {
        {"water.error_falloff", "error with 160 k photons over the error with 1 M", errorFalloff},
        {"water.equal_time_rmse_ratio", "the paper's error over ours where it may take as long", equalTime},
        {"water.bit_identical", "1 where ten runs give the same bits", bitIdentical},
        {"water.web_formulas", "with --peers: mean irradiance by the formulas that web pages copy", webFormulas},
    };
}

}  // namespace shoal::bench
