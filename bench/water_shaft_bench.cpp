// The rows of water that weigh god rays: single scattering has a closed form under level water, and a quadrature under
// one wave.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <shoal/light/view.h>
#include <shoal/water/reference.h>

#include "bench/water_stage.h"

namespace shoal::bench {

namespace {

namespace analytic = water::analytic;

// Odd, so that the middle pixel looks along the camera's axis.
const Overrides kOdd = {"render.width=321", "render.height=181"};

// One straight look through level water: where to, where the sun stands, how long the way in the water is.
struct Look {
    double vy, length, zenithDeg;
};

Result<std::vector<Row>> flat(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    double worst = 0;
    for (const Look look : {Look{0, 10, 0}, {0.5, 4, 0}, {-0.5, 10, 0}, {0, 10, 30}}) {
        const double zenith = look.zenithDeg * 3.14159265358979323846 / 180, vx = std::sqrt(1 - look.vy * look.vy);
        Overrides overrides = kOdd;
        overrides.push_back("camera.target=" + words(10 * vx, -2 + 10 * look.vy, 0));
        overrides.push_back("shape[0].position=" + words(0, look.vy < 0 ? -2 + look.vy * look.length : -8, 0));
        overrides.push_back("sun.toSun=" + words(-std::sin(zenith), std::cos(zenith), 0));
        SHOAL_TRY(stage.load("water_shafts", overrides));
        SHOAL_TRY_ASSIGN(const Image image, stage.draw("inscatter"));
        analytic::ShaftRay ray;
        ray.vx = vx, ray.vy = look.vy, ray.length = look.length;
        const double exact = analytic::flatShaft({}, zenith, ray);
        worst = std::max(worst, std::abs(double(*image.at(160, 90)) / exact - 1));
    }
    return std::vector<Row>{rowOf("water.godray_flat_error", 100 * worst, "%",
                                  "looking level, 30 deg up, 30 deg down, and level under a sun 30 deg off the zenith; "
                                  "water_shafts.toml")};
}

// S1 from 2 m below, across its crests, over a floor at 6 m and with a post before it.
const Overrides kWavy = {
    "camera.target=[0, -2.6, 10]",
    "camera.fovDeg=60",
    "render.width=640",
    "render.height=360",
    "shape[0].position=[0, -6, 0]",
    "shape[1].size=[0.3, 4, 0.3]",
    "shape[1].position=[0.6, -6, 4]",
    "water.waves={ kind = \"sum\", speed = 0, components = [ { amplitude = 0.05, wavelength = 2 } ] }"};

struct Wavy {
    double rmse = 0, edgeRmse = 0;
};

Result<Wavy> wavyError(WaterStage& stage, const Overrides& more) {
    Overrides overrides = kWavy;
    overrides.insert(overrides.end(), more.begin(), more.end());
    SHOAL_TRY(stage.load("water_shafts", overrides));
    SHOAL_TRY_ASSIGN(const Image image, stage.draw("inscatter"));
    SHOAL_TRY_ASSIGN(const Image depth, stage.draw("depth"));
    const light::View view = stage.pipeline().view();
    const auto atEdge = [&](int x, int y) {
        for (int dy = -4; dy <= 4; dy += 2)
            for (int dx = -4; dx <= 4; dx += 2)
                if (std::abs(*depth.at(x + dx, y + dy) - *depth.at(x, y)) > 0.2f * *depth.at(x, y)) return true;
        return false;
    };
    double sum = 0, edgeSum = 0, mean = 0;
    int count = 0, edgeCount = 0;
    for (int y = 8; y < image.height - 8; y += 8) {
        for (int x = 8; x < image.width - 8; x += 8) {
            const Vec3 onNear = transformPoint(view.viewFromClip, {2 * (float(x) + 0.5f) / float(image.width) - 1,
                                                                   1 - 2 * (float(y) + 0.5f) / float(image.height), 1});
            const Vec3 perDepth = transformDirection(view.worldFromView, onNear * (-1 / onNear.z));
            const double stretch = double(length(perDepth));
            analytic::ShaftRay ray;
            ray.vx = double(perDepth.x) / stretch, ray.vy = double(perDepth.y) / stretch;
            ray.vz = double(perDepth.z) / stretch;
            const double opaque = *depth.at(x, y) > 0 ? double(*depth.at(x, y)) * stretch : 1e4;
            ray.length = std::min(opaque, ray.vy > 0 ? ray.eyeDepth / ray.vy : 1e4);
            if (ray.length > 60) continue;  // to the horizon
            const double exact = analytic::sinusoidShaft({}, {}, ray, 160);
            const double d = double(*image.at(x, y)) - exact;
            sum += d * d, mean += exact, ++count;
            if (atEdge(x, y)) edgeSum += d * d, ++edgeCount;
        }
    }
    mean /= count;
    return Wavy{std::sqrt(sum / count) / mean, edgeCount > 0 ? std::sqrt(edgeSum / edgeCount) / mean : 0};
}

Result<std::vector<Row>> wavy(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY_ASSIGN(const Wavy half, wavyError(stage, {"water.shafts.resolutionScale=0.5", "water.shafts.steps=32"}));
    SHOAL_TRY_ASSIGN(const Wavy quarter, wavyError(stage, {"water.shafts.resolutionScale=0.25"}));
    char method[200];
    std::snprintf(
        method, sizeof method,
        "S1 from 2 m below, marched at a quarter of the size (the default); within 4 px of an edge %.2f %%; at half of "
        "the size with 32 steps %.2f %%, at edges %.2f %%",
        100 * quarter.edgeRmse, 100 * half.rmse, 100 * half.edgeRmse);
    return std::vector<Row>{rowOf("water.godray_wavy_rmse", 100 * quarter.rmse, "%", method)};
}

Result<std::vector<Row>> invariance(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    std::vector<double> means;
    for (const char* change :
         {"water.shafts.photons=40000", "water.shafts.photons=160000", "water.shafts.photons=360000",
          "water.shafts.resolutionScale=0.25", "water.shafts.resolutionScale=1", "water.shafts.steps=64",
          "water.caustics.resolution=1024", "water.caustics.resolution=256"}) {
        Overrides overrides = kWavy;
        overrides.push_back(change);
        SHOAL_TRY(stage.load("water_shafts", overrides));
        SHOAL_TRY_ASSIGN(const Image image, stage.draw("inscatter"));
        means.push_back(columnMean(image, 0, image.width));
    }
    double worst = 0;
    for (const double mean : means) worst = std::max(worst, std::abs(mean / means[0] - 1));
    return std::vector<Row>{
        rowOf("water.godray_invariance", 100 * worst, "%",
              "mean radiance of S1's picture, largest change over 40 k to 360 k photons, buffers of a "
              "quarter to all of the size, 64 steps, maps of 256 to 1024 texels")};
}

}  // namespace

std::vector<Benchmark> waterShaftBenchmarks() {
    return {
        {"water.godray_flat_error", "light that level water scatters against its closed form", flat},
        {"water.godray_wavy_rmse", "light that water scatters under one wave against exact integration", wavy},
        {"water.godray_invariance", "change of the mean with buffers and counts", invariance},
    };
}

}  // namespace shoal::bench
