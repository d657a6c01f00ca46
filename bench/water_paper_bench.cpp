// The four configurations of [Papadopoulos & Papaioannou 2010] section 4.2, as the paper times them: whole frames.
#include <cstdio>

#include <shoal/water/paper.h>

#include "bench/method_pair.h"

namespace shoal::bench {

namespace {

std::string override(const char* key, double value) {
    char text[80];
    std::snprintf(text, sizeof text, "water.paper.%s=%.9g", key, value);
    return text;
}

int photonsOf(int side) { return 4 * side * side; }

Overrides overridesOf(const water::PaperParams& p) {
    Overrides overrides = paperOverrides(photonsOf(p.causticGrid), photonsOf(p.godrayGrid));
    for (const std::string& one :
         {override("causticScale", p.causticScale), override("godrayScale", p.godrayScale),
          override("smallestPointPx", p.smallestPointPx), override("largestPointPx", p.largestPointPx),
          override("lineWidthPx", p.lineWidthPx)})
        overrides.push_back(one);
    return overrides;
}

Result<std::vector<Row>> configuration(const Settings& settings, const water::PaperConfig& config, const char* id) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    const int photons = photonsOf(config.params.causticGrid), godrayPhotons = photonsOf(config.params.godrayGrid);
    SHOAL_TRY(pair.load("water_speed", shoalOverrides(photons, godrayPhotons), overridesOf(config.params)));
    pair.setSize(config.width, config.height);
    std::vector<double> paper, ours;
    constexpr int kWarmUp = 2;
    for (int i = 0; i < kWarmUp + settings.repetitions; ++i) {
        SHOAL_TRY_ASSIGN(const double paperMs, pair.wholeFrame(Method::paper, i));
        SHOAL_TRY_ASSIGN(const double oursMs, pair.wholeFrame(Method::shoal, i));
        if (i < kWarmUp) continue;
        paper.push_back(paperMs);
        ours.push_back(oursMs);
    }
    SHOAL_TRY_ASSIGN(const MethodPair::Both passes, pair.inTurns(settings.repetitions));
    note("  %s passes, ms (%s): light depth %.1f, %s", id, gl::FrameTimer::method(pair.device()),
         passes.paper.lightDepth, passText(passes.paper).c_str());
    const Spread spread = spreadOf(paper), own = spreadOf(ours);
    Row row{.id = id, .value = spread.median, .unit = "ms", .peer = {}, .renderer = {}, .method = {}};
    char text[400];
    std::snprintf(text, sizeof text,
                  "; the paper's method, whole frame with read back, %dx%d, %d + %d photons, %.2f fps (the paper, on a "
                  "GTX 260: %s; %s); Shoal's method in the same frame %.1f ms; water_speed.toml",
                  config.width, config.height, photons, godrayPhotons, 1000 / spread.median, config.framesPerSecond,
                  config.note, own.median);
    row.method = spread.describe("ms") + text;
    return std::vector<Row>{row};
}

}  // namespace

std::vector<Benchmark> waterPaperBenchmarks() {
    static const char* const kIds[] = {"water.paper_a", "water.paper_b", "water.paper_c", "water.paper_d"};
    std::vector<Benchmark> rows;
    for (std::size_t i = 0; i < std::size(kIds); ++i) {
        const water::PaperConfig& config = water::paperConfigs()[i];
        const char* const id = kIds[i];
        rows.push_back({id, "frame of the paper's method in a configuration of its section 4.2",
                        [&config, id](const Settings& settings) { return configuration(settings, config, id); }});
    }
    return rows;
}

}  // namespace shoal::bench
