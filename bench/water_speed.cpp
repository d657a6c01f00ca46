// The rows of water that are times: Shoal's method beside the paper's, in the same process and scene.
#include <cmath>
#include <cstdio>

#include "bench/method_pair.h"

namespace shoal::bench {

namespace {

// The floor of water_speed.toml, an instance of its own.
constexpr float kFloorId = 1;

// Over the pixels of the floor, weighed by the area that they see (the cube of their distance along the view axis):
// the mean of each picture, and how far the two go together.
struct Likeness {
    double meanA = 0, meanB = 0, correlation = 0;
};

// Means of 8 x 8 pixels: the paper's points are as wide.
constexpr int kBlock = 8;

Likeness likenessOf(const Image& a, const Image& b, const Image& depth, const Image& id) {
    double weights = 0, sumA = 0, sumB = 0, squareA = 0, squareB = 0, product = 0;
    for (int y = 0; y + kBlock <= a.height; y += kBlock)
        for (int x = 0; x + kBlock <= a.width; x += kBlock) {
            double blockA = 0, blockB = 0, weight = 0;
            for (int i = 0; i < kBlock * kBlock; ++i) {
                const int px = x + i % kBlock, py = y + i / kBlock;
                if (*id.at(px, py) != kFloorId) continue;
                const double w = std::pow(double(*depth.at(px, py)), 3);
                blockA += w * double(*a.at(px, py)), blockB += w * double(*b.at(px, py)), weight += w;
            }
            if (weight == 0) continue;
            weights += weight, sumA += blockA, sumB += blockB;
            squareA += blockA * blockA / weight, squareB += blockB * blockB / weight,
                product += blockA * blockB / weight;
        }
    Likeness like;
    SHOAL_ASSERT_MSG(a.width == b.width && a.height == b.height, "the two methods drew pictures of different size");
    like.meanA = sumA / weights, like.meanB = sumB / weights;
    const double varianceA = squareA / weights - like.meanA * like.meanA,
                 varianceB = squareB / weights - like.meanB * like.meanB;
    like.correlation =
        (product / weights - like.meanA * like.meanB) / std::sqrt(std::max(varianceA * varianceB, 1e-30));
    return like;
}

// Whether both methods light the same scene: the paper's one gain is fitted to the mean irradiance of the floor; with
// it the means agree, and where one is bright so is the other. An error where they do not: a ratio of times would be
// void.
Result<std::string> sameWork(MethodPair& pair, int photons, int godrayPhotons) {
    SHOAL_TRY_ASSIGN(const Image depth, pair.draw(Method::shoal, "depth"));
    SHOAL_TRY_ASSIGN(const Image id, pair.draw(Method::shoal, "objectId"));
    SHOAL_TRY_ASSIGN(const Image ours, pair.draw(Method::shoal, "caustics"));
    SHOAL_TRY_ASSIGN(const Image ungained, pair.draw(Method::paper, "caustics"));
    const Likeness before = likenessOf(ours, ungained, depth, id);
    if (!(before.meanA > 0) || !(before.meanB > 0)) return internalError("one of the methods lights no floor");
    char gain[60];
    std::snprintf(gain, sizeof gain, "water.paper.gain=%.6g", before.meanA / before.meanB);
    Overrides gained = paperOverrides(photons, godrayPhotons);
    gained.push_back(gain);
    SHOAL_TRY(pair.loadOne(Method::paper, "water_speed", gained));
    SHOAL_TRY_ASSIGN(const Image theirs, pair.draw(Method::paper, "caustics"));
    const Likeness like = likenessOf(ours, theirs, depth, id);
    if (!(std::abs(like.meanB / like.meanA - 1) <= 0.03) || !(like.correlation >= 0.3))
        return internalError("the two methods do not light the same floor");
    char text[200];
    std::snprintf(text, sizeof text,
                  "the floor's mean irradiance %.3f and %.3f W/m2 with the paper's %s fitted, correlation %.2f",
                  like.meanA, like.meanB, gain + 12, like.correlation);
    return std::string(text);
}

// Photons that were followed in the last frame: of those asked for, the ones that start in the water.
double photonsOf(const pipeline::Pipeline& pipeline) {
    for (const auto& [name, count] : pipeline.stats().counts)
        if (std::string(name) == "photons") return double(count);
    return 0;
}

struct Work {
    const char* id;
    int width, height, photons, godrayPhotons;
};

Result<std::vector<Row>> speedup(const Settings& settings, const Work& work) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    SHOAL_TRY(pair.load("water_speed", shoalOverrides(work.photons, work.godrayPhotons),
                        paperOverrides(work.photons, work.godrayPhotons)));
    pair.setSize(work.width, work.height);
    SHOAL_TRY_ASSIGN(const std::string check, sameWork(pair, work.photons, work.godrayPhotons));
    SHOAL_TRY_ASSIGN(const MethodPair::Both both, pair.inTurns(settings.repetitions));
    note("  %s shoal, ms (%s): %s; light depth apart %.1f, mirrored views %.1f", work.id,
         gl::FrameTimer::method(pair.device()), passText(both.shoal).c_str(), both.shoal.lightDepth,
         both.shoal.mirrored);
    note("  %s paper, ms: %s; light depth apart %.1f, mirrored views %.1f", work.id, passText(both.paper).c_str(),
         both.paper.lightDepth, both.paper.mirrored);
    note("  %s check: %s", work.id, check.c_str());
    char text[520];
    std::snprintf(
        text, sizeof text,
        "paper %.1f ms (caustics %.1f, god rays %.1f, to pixels %.1f) over shoal %.1f ms (%.1f, %.1f, %.1f); "
        "medians of %d in turns, %d + %d photons asked for (ours follows the %.0f that start in the water), %dx%d, "
        "water_speed.toml; %s",
        both.paper.work(), both.paper.caustics, both.paper.godrays, both.paper.toPixels, both.shoal.work(),
        both.shoal.caustics, both.shoal.godrays, both.shoal.toPixels, settings.repetitions, work.photons,
        work.godrayPhotons, photonsOf(pair.pipeline(Method::shoal)), work.width, work.height, check.c_str());
    return std::vector<Row>{rowOf(work.id, both.paper.work() / both.shoal.work(), "x", text)};
}

Result<std::vector<Row>> speedup160k(const Settings& settings) {
    return speedup(settings, {"water.speedup_160k", 800, 800, 160000, 40000});
}
Result<std::vector<Row>> speedup1m(const Settings& settings) {
    return speedup(settings, {"water.speedup_1m", 1440, 850, 1000000, 360000});
}

double passMs(const MethodTimes& times, std::initializer_list<const char*> names) {
    double sum = 0;
    for (const char* name : names)
        if (const auto found = times.passes.find(name); found != times.passes.end()) sum += found->second;
    return sum;
}

// Photons a second with what puts their light down: ours into maps, the paper's onto the screen; no filters.
Result<std::vector<Row>> rate(const Settings& settings) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    constexpr int kPhotons = 1000000, kGodrayPhotons = 40000;
    SHOAL_TRY(
        pair.load("water_speed", shoalOverrides(kPhotons, kGodrayPhotons), paperOverrides(kPhotons, kGodrayPhotons)));
    SHOAL_TRY_ASSIGN(const MethodPair::Both both, pair.inTurns(settings.repetitions));
    const double ours = passMs(both.shoal, {"caustic photons", "caustic maps"}),
                 theirs = passMs(both.paper, {"paper water mask", "paper caustics"});
    const double followed = photonsOf(pair.pipeline(Method::shoal));
    if (!(followed > 0)) return internalError("no photons were followed");
    char text[240];
    std::snprintf(text, sizeof text,
                  "ours %.2f M/s (%.0f that start in the water, %.1f ms), the paper's %.2f M/s (%.1f ms), 1 M photons "
                  "asked for, 800x800, medians of %d in turns; water_speed.toml",
                  followed / ours / 1000, followed, ours, kPhotons / theirs / 1000, theirs, settings.repetitions);
    return std::vector<Row>{rowOf("water.photons_rate_ratio", (followed / ours) / (kPhotons / theirs), "x", text)};
}

// Ours against ours: the two of a pair need not be two methods.
Result<std::vector<Row>> costGrowth(const Settings& settings) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    SHOAL_TRY(pair.load("water_speed", shoalOverrides(160000, 40000), shoalOverrides(1000000, 250000)));
    SHOAL_TRY_ASSIGN(const MethodPair::Both both, pair.inTurns(settings.repetitions));
    const auto lightSpace = [](const MethodTimes& t) {
        return passMs(t, {"caustic photons", "caustic maps", "shaft photons", "shaft slices"});
    };
    const double few = lightSpace(both.shoal), many = lightSpace(both.paper);
    char text[200];
    std::snprintf(text, sizeof text,
                  "160 k + 40 k photons %.1f ms, 1 M + 250 k %.1f ms (6.25 times as many), maps and slices included, "
                  "medians of %d in turns; water_speed.toml",
                  few, many, settings.repetitions);
    return std::vector<Row>{rowOf("water.cost_growth", many / few, "x", text)};
}

Result<std::vector<Row>> resolutionGrowth(const Settings& settings) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    SHOAL_TRY(pair.load("water_speed", shoalOverrides(160000, 40000), shoalOverrides(160000, 40000)));
    pair.setSize(Method::shoal, 1920, 1080);
    pair.setSize(Method::paper, 3840, 2160);
    SHOAL_TRY_ASSIGN(const MethodPair::Both both, pair.inTurns(settings.repetitions));
    const auto lightSpace = [](const MethodTimes& t) {
        return passMs(t, {"caustic photons", "caustic maps", "shaft photons", "shaft slices"});
    };
    const double small = lightSpace(both.shoal), large = lightSpace(both.paper);
    note("  water.resolution_growth 1080p, ms: %s", passText(both.shoal).c_str());
    note("  water.resolution_growth 4K, ms: %s", passText(both.paper).c_str());
    char text[300];
    std::snprintf(
        text, sizeof text,
        "light-space passes, 1080p %.1f ms, 4K %.1f ms; apart: march %.1f to %.1f ms, bringing to pixels %.1f "
        "to %.1f ms; medians of %d in turns; water_speed.toml",
        small, large, passMs(both.shoal, {"shaft march", "shaft blur"}),
        passMs(both.paper, {"shaft march", "shaft blur"}), both.shoal.toPixels, both.paper.toPixels,
        settings.repetitions);
    return std::vector<Row>{rowOf("water.resolution_growth", large / small, "x", text)};
}

}  // namespace

std::vector<Benchmark> waterSpeedBenchmarks() {
    std::vector<Benchmark> rows = {
        {"water.speedup_160k", "the paper's method's time over ours, 160 k + 40 k photons", speedup160k},
        {"water.speedup_1m", "the paper's method's time over ours, 1 M + 360 k photons", speedup1m},
        {"water.photons_rate_ratio", "photons a second over the paper's, with what puts their light down", rate},
        {"water.cost_growth", "time of 6.25 times as many photons over the time of so many", costGrowth},
        {"water.resolution_growth", "time of the passes in light space at 4K over theirs at 1080p", resolutionGrowth},
    };
    for (Benchmark& row : waterErrorBenchmarks()) rows.push_back(std::move(row));
    for (Benchmark& row : waterPaperBenchmarks()) rows.push_back(std::move(row));
    return rows;
}

}  // namespace shoal::bench
