// The rows of water that are times: Shoal's method beside the paper's, in the same process and scene.
#include <cmath>
#include <cstdio>

#include "bench/method_pair.h"

namespace shoal::bench {

namespace {

Row rowOf(const char* id, double value, const char* unit, std::string method) {
    return Row{.id = id, .value = value, .unit = unit, .peer = {}, .renderer = {}, .method = std::move(method)};
}

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
    SHOAL_TRY(pair.load("water_speed", photons, godrayPhotons, {}, {gain}));
    SHOAL_TRY_ASSIGN(const Image theirs, pair.draw(Method::paper, "caustics"));
    const Likeness like = likenessOf(ours, theirs, depth, id);
    if (std::abs(like.meanB / like.meanA - 1) > 0.03 || like.correlation < 0.3)
        return internalError("the two methods do not light the same floor");
    char text[200];
    std::snprintf(text, sizeof text,
                  "the floor's mean irradiance %.3f and %.3f W/m2 with the paper's %s fitted, correlation %.2f",
                  like.meanA, like.meanB, gain + 12, like.correlation);
    return std::string(text);
}

struct Work {
    const char* id;
    int width, height, photons, godrayPhotons;
};

Result<std::vector<Row>> speedup(const Settings& settings, const Work& work) {
    SHOAL_TRY_ASSIGN(MethodPair pair, MethodPair::create(settings));
    SHOAL_TRY(pair.load("water_speed", work.photons, work.godrayPhotons));
    pair.setSize(work.width, work.height);
    SHOAL_TRY_ASSIGN(const std::string check, sameWork(pair, work.photons, work.godrayPhotons));
    pair.setSize(work.width, work.height);
    SHOAL_TRY_ASSIGN(const MethodPair::Both both, pair.inTurns(settings.repetitions));
    note("  %s shoal, ms (%s): %s; light depth apart %.1f", work.id, gl::FrameTimer::method(pair.device()),
         passText(both.shoal).c_str(), both.shoal.lightDepth);
    note("  %s paper, ms: %s; light depth apart %.1f", work.id, passText(both.paper).c_str(), both.paper.lightDepth);
    note("  %s check: %s", work.id, check.c_str());
    char text[400];
    std::snprintf(text, sizeof text,
                  "paper %.1f ms (caustics %.1f, god rays %.1f, to pixels %.1f) over shoal %.1f ms (%.1f, %.1f, %.1f); "
                  "medians of %d in turns, %d + %d photons, %dx%d, water_speed.toml; %s",
                  both.paper.work(), both.paper.caustics, both.paper.godrays, both.paper.toPixels, both.shoal.work(),
                  both.shoal.caustics, both.shoal.godrays, both.shoal.toPixels, settings.repetitions, work.photons,
                  work.godrayPhotons, work.width, work.height, check.c_str());
    return std::vector<Row>{rowOf(work.id, both.paper.work() / both.shoal.work(), "x", text)};
}

Result<std::vector<Row>> speedup160k(const Settings& settings) {
    return speedup(settings, {"water.speedup_160k", 800, 800, 160000, 40000});
}
Result<std::vector<Row>> speedup1m(const Settings& settings) {
    return speedup(settings, {"water.speedup_1m", 1440, 850, 1000000, 360000});
}

}  // namespace

std::vector<Benchmark> waterSpeedBenchmarks() {
    std::vector<Benchmark> rows = {
        {"water.speedup_160k", "the paper's method's time over ours, 160 k + 40 k photons", speedup160k},
        {"water.speedup_1m", "the paper's method's time over ours, 1 M + 360 k photons", speedup1m},
    };
    for (Benchmark& row : waterPaperBenchmarks()) rows.push_back(std::move(row));
    return rows;
}

}  // namespace shoal::bench
