// The rows of water that have an exact answer: closed forms, conservation, the double-precision reference.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <shoal/core/parallel.h>
#include <shoal/pipeline/water.h>
#include <shoal/water/reference.h>

#include "bench/harness.h"
#include "bench/water_stage.h"
#include "tests/support/misplaced_photons.h"

namespace shoal::bench {

namespace {

namespace analytic = water::analytic;

constexpr double kTexel = 1.0 / 128;  // metres a pixel of the check scenes
constexpr int kSide = 512;            // pixels

double degrees(double d) { return d * 3.14159265358979323846 / 180; }

// Light at zenith angle `zenithDeg` that travels towards +x.
std::string toSun(double zenithDeg) {
    return "sun.toSun=" + words(-std::sin(degrees(zenithDeg)), std::cos(degrees(zenithDeg)), 0);
}
std::string floorAt(double depth) { return "shape[0].position=" + words(0, -depth, 0); }
std::string photons(int count) { return "water.caustics.photons=" + std::to_string(count); }
std::string absorption(double c) { return "water.absorption=" + words(c, c, c); }

// Relative to `exact`, over the middle of the picture, channel 0.
double largestError(const Image& image, double exact) {
    double worst = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) worst = std::max(worst, std::abs(double(*image.at(x, y)) / exact - 1));
    return worst;
}

Result<std::vector<Row>> flat(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    const double depth = 4;
    double worst = 0;
    for (const double zenith : {0.0, 30.0, 60.0}) {
        for (const double c : {0.0, 0.13}) {
            SHOAL_TRY(stage.load("water_flat", {toSun(zenith), floorAt(depth), absorption(c)}));
            SHOAL_TRY_ASSIGN(const Image image, stage.draw("caustics"));
            const double cosIn = std::cos(degrees(zenith)), sinOut = std::sin(degrees(zenith)) / water::kWaterIndex;
            const double cosOut = std::sqrt(1 - sinOut * sinOut);
            const double exact =
                cosIn * water::fresnelTransmittance(cosIn, water::kWaterIndex) * std::exp(-c * depth / cosOut);
            worst = std::max(worst, largestError(image, exact));
        }
    }
    return std::vector<Row>{rowOf("water.flat_max_error", 100 * worst, "%",
                                  "largest of all pixels, sun 0, 30, 60 deg, c 0 and 0.13, D = 4; water_flat.toml")};
}

// Value at X: mean of the two columns that meet there (X a multiple of the pixel), or of the pixel's column.
double atX(const Image& image, double x) {
    const int column = int(std::lround(x / kTexel)) + kSide / 2;
    return columnMean(image, std::clamp(column - 1, 0, kSide - 2), std::clamp(column + 1, 2, kSide));
}
double exactAtX(const analytic::Sinusoid& s, double depth, double x) {
    return analytic::sinusoidBins(s, depth, x - kTexel, x + kTexel, 1)[0];
}

Result<double> sinusoidError(WaterStage& stage, int photonCount) {
    double worst = 0;
    const auto measure = [&](double depth, double c) -> Result<void> {
        SHOAL_TRY(stage.load("water_sinusoid", {floorAt(depth), absorption(c), photons(photonCount)}));
        SHOAL_TRY_ASSIGN(const Image image, stage.draw("caustics"));
        analytic::Sinusoid s;
        s.attenuation = c;
        for (const double x : {0.0, 0.25, 0.5, 0.75, 1.0})
            worst = std::max(worst, std::abs(atX(image, x) / exactAtX(s, depth, x) - 1));
        return {};
    };
    for (const double depth : {1.0, 2.0, 4.0, 6.0}) SHOAL_TRY(measure(depth, 0));
    SHOAL_TRY(measure(4, 0.13));
    return worst;
}

Result<std::vector<Row>> sinusoid(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    std::vector<Row> rows;
    for (const auto& [id, count] :
         {std::pair{"water.sinusoid_max_error_160k", 160000}, {"water.sinusoid_max_error_1m", 1000000}}) {
        SHOAL_TRY_ASSIGN(const double worst, sinusoidError(stage, count));
        rows.push_back(
            rowOf(id, 100 * worst, "%",
                  "largest at the note's 25 points, S1, D 1, 2, 4, 6 and 4 with c 0.13; water_sinusoid.toml"));
    }
    return rows;
}

Result<std::vector<Row>> oblique(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    double worst = 0;
    for (const double zenith : {30.0, 60.0}) {
        SHOAL_TRY(stage.load("water_sinusoid", {toSun(zenith), floorAt(2), photons(160000)}));
        SHOAL_TRY_ASSIGN(const Image image, stage.draw("caustics"));
        analytic::Sinusoid s;
        s.zenithAngle = degrees(zenith);
        for (const double x : {0.0, 0.5, 1.0, 1.5})
            worst = std::max(worst, std::abs(atX(image, x) / exactAtX(s, 2, x) - 1));
    }
    return std::vector<Row>{rowOf("water.oblique_max_error_160k", 100 * worst, "%",
                                  "largest at X 0, 0.5, 1, 1.5, S1o 30 and 60 deg, D = 2; water_sinusoid.toml")};
}

// Where a sampled curve is largest, by the parabola through the largest and its neighbours.
double peakOf(const std::vector<double>& x, const std::vector<double>& y) {
    const std::size_t i =
        std::clamp<std::size_t>(std::size_t(std::max_element(y.begin(), y.end()) - y.begin()), 1, y.size() - 2);
    const double a = y[i - 1], b = y[i], c = y[i + 1], curve = a - 2 * b + c;
    return x[i] + (curve != 0 ? 0.5 * (a - c) / curve : 0) * (x[1] - x[0]);
}

Result<std::vector<Row>> focus(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    std::vector<double> depths, ours, exact;
    for (double depth = 7; depth <= 10; depth += 0.25) {
        SHOAL_TRY(stage.load("water_sinusoid", {floorAt(depth)}));
        SHOAL_TRY_ASSIGN(const Image image, stage.draw("caustics"));
        depths.push_back(depth);
        ours.push_back(atX(image, 0));
        exact.push_back(exactAtX({}, depth, 0));
    }
    const double error = std::abs(peakOf(depths, ours) / peakOf(depths, exact) - 1);
    char method[200];
    std::snprintf(
        method, sizeof method,
        "depth of the largest mean over 2 pixels under a crest: %.3f m, exact bins %.3f m (first focus %.3f m)",
        peakOf(depths, ours), peakOf(depths, exact), analytic::focusDepth({}));
    return std::vector<Row>{rowOf("water.focus_depth_error", 100 * error, "%", method)};
}

// Outer edge of the fold right of X = 0: where irradiance falls through half of its peak.
double foldEdge(const std::vector<double>& bins) {
    const std::size_t middle = bins.size() / 2;
    const std::size_t peak = std::size_t(
        std::max_element(bins.begin() + std::ptrdiff_t(middle), bins.begin() + std::ptrdiff_t(middle + 32)) -
        bins.begin());
    const double half = 0.5 * bins[peak];
    std::size_t i = peak;
    while (i + 1 < bins.size() && bins[i + 1] > half) ++i;
    return double(i) + (bins[i] - half) / (bins[i] - bins[i + 1]);
}

Result<std::vector<Row>> fold(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY(stage.load("water_sinusoid", {floorAt(12)}));
    SHOAL_TRY_ASSIGN(const Image image, stage.draw("caustics"));
    std::vector<double> ours;
    for (int x = 0; x < kSide; ++x) ours.push_back(columnMean(image, x, x + 1));
    const double off = std::abs(foldEdge(ours) - foldEdge(analytic::sinusoidBins({}, 12, -2, 2, kSide)));
    return std::vector<Row>{rowOf("water.fold_position_texels", off, "px",
                                  "outer edge of the fold at half of its peak, S1, D = 12, pixels of 1/128 m")};
}

Result<std::vector<Row>> patch(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY(stage.load("water_patch"));
    SHOAL_TRY_ASSIGN(const water::WaveField waves, wavesOf(stage.pipeline().scene()));
    std::vector<Row> rows;
    for (const bool disc : {false, true}) {
        const Image exact = exactPatch(waves, disc ? double(radians(0.2667f)) : 0.0);
        for (const int count : {160000, 1000000}) {
            SHOAL_TRY(stage.load("water_patch", {photons(count), disc ? "sun.discDeg=0.2667" : "sun.discDeg=0"}));
            SHOAL_TRY_ASSIGN(const Image image, stage.draw("caustics"));
            const std::string id =
                std::string(disc ? "water.patch_sun_rmse" : "water.patch_rmse") + (count == 160000 ? "_160k" : "_1m");
            rows.push_back(rowOf(id.c_str(), 100 * errorOf(image, exact).rmse, "%",
                                 "P6, D = 2, 512 x 512 pixels of 1/128 m, against 151 M traced rays"));
        }
    }
    return rows;
}

Result<std::vector<Row>> energy(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY(stage.load("water_patch"));
    SHOAL_TRY_ASSIGN(const water::WaveField waves, wavesOf(stage.pipeline().scene()));
    const water::FloorResult exact =
        water::traceFloor(waves, water::kWaterIndex, 0, {0, 1, 0}, 0, 2, {{-2, -2}, {2, 2}, 64, 64, true}, 2048, 1);
    double worst = 0;
    const auto measure = [&](const Overrides& overrides) -> Result<void> {
        SHOAL_TRY(stage.load("water_patch", overrides));
        SHOAL_TRY_ASSIGN(const Image image, stage.draw("caustics"));
        worst = std::max(worst, std::abs(columnMean(image, 0, image.width) / exact.received - 1));
        return {};
    };
    for (const int count : {40000, 160000, 1000000, 4000000}) SHOAL_TRY(measure({photons(count)}));
    for (const int side : {256, 1024, 2048}) SHOAL_TRY(measure({"water.caustics.resolution=" + std::to_string(side)}));
    for (const double shift : {0.0013, 0.0039}) {  // metres: a fraction of a cell
        const std::string x = std::to_string(shift);
        SHOAL_TRY(measure({"camera.position=[" + x + ", 6, 0]", "camera.target=[" + x + ", 0, 0]"}));
    }
    SHOAL_TRY(measure({"camera.position=[0, 30, 0]"}));
    return std::vector<Row>{
        rowOf("water.energy_error", 100 * worst, "%",
              "mean irradiance of a whole period of P6, largest deviation over 40 k to 4 M photons, maps of "
              "256 to 2048 texels, shifted and distant eyes")};
}

Result<std::vector<Row>> flicker(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY(stage.load("water_patch", {"render.width=640", "render.height=480"}));
    // An eye that looks straight down and moves by whole pixels of the floor: the same points of the floor are seen at
    // pixel centres in every frame.
    const float eyeY = 6, depth = 2, fov = radians(40);
    const float pixel = 2 * std::tan(0.5f * fov) * (eyeY + depth) / 480;
    constexpr int kFrames = 16, kStep = 7, kMargin = kFrames * kStep;
    std::vector<Image> frames;
    for (int i = 0; i < kFrames; ++i) {
        const float x = pixel * float(i * kStep);
        SHOAL_TRY_ASSIGN(Image image,
                         stage.draw("caustics", light::cameraLookingAt({x, eyeY, 0}, {x, 0, 0}, fov, {0, 0, -1})));
        frames.push_back(std::move(image));
    }
    double sum = 0;
    int count = 0;
    for (int y = 8; y < 472; y += 4) {
        for (int x = kMargin + 8; x < 632; x += 4, ++count) {
            double mean = 0, square = 0;
            for (int i = 0; i < kFrames; ++i) {
                const double e = double(*frames[std::size_t(i)].at(x - i * kStep, y));
                mean += e / kFrames, square += e * e / kFrames;
            }
            sum += std::sqrt(std::max(0.0, square - mean * mean)) / std::max(mean, 1e-9);
        }
    }
    return std::vector<Row>{
        rowOf("water.flicker", 100 * sum / count, "%",
              "std / mean over 16 frames of a dolly, still water, mean of points of the floor, 160 k photons")};
}

Result<std::vector<Row>> jerlov(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    double worstSunlight = 0, worstTransmittance = 0;
    const double surface = water::fresnelTransmittance(1, water::kWaterIndex);
    for (const water::NamedMedium& medium : water::namedMedia()) {
        if (std::string(medium.name).rfind("jerlov", 0) != 0) continue;
        const double f = 0.924 * 0.924;
        for (const double depth : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
            SHOAL_TRY(stage.load("water_flat", {"water.medium=" + std::string(medium.name), floorAt(depth),
                                                "render.width=32", "render.height=32", "camera.heightM=0.25",
                                                "sun.irradiance=" + words(1000, 1000, 1000)}));
            SHOAL_TRY_ASSIGN(const Image sunlight, stage.draw("caustics"));
            SHOAL_TRY_ASSIGN(const Image transmittance, stage.draw("transmittance"));
            const double a[] = {medium.absorption.x, medium.absorption.y, medium.absorption.z};
            const double b[] = {medium.scattering.x, medium.scattering.y, medium.scattering.z};
            for (int c = 0; c < 3; ++c) {
                const double left = std::exp(-(a[c] + b[c] * (1 - f)) * depth);
                const auto error = [&](const Image& image, double exact) {
                    return std::abs(double(image.at(16, 16)[c]) / exact - 1);
                };
                if (left > 1e-4) worstSunlight = std::max(worstSunlight, error(sunlight, 1000 * surface * left));
                if (left > 1e-3) worstTransmittance = std::max(worstTransmittance, error(transmittance, left));
            }
        }
    }
    char method[240];
    std::snprintf(method, sizeof method,
                  "ten types, 1 to 50 m straight down: sunlight on a level floor where 1e-4 is left %.2f %%, the AOV "
                  "transmittance where 1e-3 is left %.2f %%",
                  100 * worstSunlight, 100 * worstTransmittance);
    return std::vector<Row>{
        rowOf("water.jerlov_error", 100 * std::max(worstSunlight, worstTransmittance), "%", method)};
}

Result<std::vector<Row>> window(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY(stage.load("water_window"));
    SHOAL_TRY_ASSIGN(const Image image, stage.draw("radiance"));
    const double centre = double(*image.at(image.width / 2, image.height / 2));
    double inside = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) inside += double(*image.at(x, y)) > 0.05 * centre ? 1 : 0;
    const double radius = std::sqrt(inside / 3.14159265358979323846);
    const double focal = 0.5 * image.height / std::tan(degrees(110) / 2);
    const double n = water::kWaterIndex;
    const double expected = n * n * water::fresnelTransmittance(1, n);
    char method[200];
    std::snprintf(
        method, sizeof method,
        "radius of the window's area at 1080p %.2f px, exact %.2f; straight up %.5f times the sky, exact %.5f", radius,
        1.134542 * focal, centre, expected);
    return std::vector<Row>{rowOf("water.snell_radius_px", std::abs(radius - 1.134542 * focal), "px", method)};
}

Result<std::vector<Row>> reflected(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    SHOAL_TRY(stage.load("water_ceiling"));
    SHOAL_TRY_ASSIGN(const Image image, stage.draw("caustics"));
    // The waves run along z; a period of 1 m is 128 rows. Flux thrown up by a metre of the level plane.
    const double sunX = 1 / std::sqrt(1.25), sunY = 0.5 / std::sqrt(1.25);
    SHOAL_TRY_ASSIGN(const water::WaveField waves, wavesOf(stage.pipeline().scene()));
    double exact = 0;
    constexpr int kPoints = 20000;
    for (int i = 0; i < kPoints; ++i) {
        const water::WaveSample w = waves.at(0, (i + 0.5) / kPoints);
        const double length = std::sqrt(1 + w.hx * w.hx + w.hz * w.hz);
        const double flux = sunY - sunX * w.hx;  // of the surface above a unit of the level plane
        exact += flux * (1 - water::fresnelTransmittance(flux / length, water::kWaterIndex)) / kPoints;
    }
    double mean = 0;
    for (int y = 64; y < 64 + 384; ++y)
        for (int x = 128; x < 384; ++x) mean += double(*image.at(x, y)) / (384.0 * 256);
    return std::vector<Row>{
        rowOf("water.reflected_energy_error", 100 * std::abs(mean / exact - 1), "%",
              "mean irradiance of a ceiling over three periods against the reflected flux; water_ceiling.toml")};
}

Result<std::vector<Row>> misplaced(const Settings& settings) {
    SHOAL_TRY_ASSIGN(WaterStage stage, WaterStage::create(settings));
    double worst = 0;
    std::string shares;
    for (const double zenith : {0.0, 20.0, 40.0}) {
        SHOAL_TRY(stage.load("water_boxes", {toSun(zenith)}));
        gl::setKnownState();
        SHOAL_TRY_ASSIGN(const double share,
                         test::misplacedPhotons(stage.device(), stage.pipeline().scene(), stage.pipeline().content()));
        char text[40];
        std::snprintf(text, sizeof text, "%s%.2f", shares.empty() ? "" : ", ", 100 * share);
        shares += text;
        worst = std::max(worst, share);
    }
    return std::vector<Row>{
        rowOf("water.misplaced_photons", 100 * worst, "%",
              "of 160 k photons, more than 2 cm off what a ray of theirs meets; sun 0, 20, 40 deg: " + shares +
                  " %; water_boxes.toml")};
}

}  // namespace

std::vector<Benchmark> waterTruthBenchmarks() {
    return {
        {"water.flat_max_error", "irradiance under level water against Fresnel, Snell and Beer", flat},
        {"water.energy_error", "light that arrives against light that enters, in many settings", energy},
        {"water.oblique_max_error_160k", "irradiance under one wave, sun at 30 and 60 degrees, against the exact one",
         oblique},
        {"water.sinusoid_max_error", "irradiance under one wave against the exact one", sinusoid},
        {"water.focus_depth_error", "depth at which light under a crest is brightest", focus},
        {"water.fold_position_texels", "place of a fold of light beyond the focus", fold},
        {"water.patch_rmse", "irradiance under six crossing waves against traced rays, with and without the sun's disc",
         patch},
        {"water.misplaced_photons", "photons among boxes that end where they should not", misplaced},
        {"water.flicker", "change of light on still points while the eye moves", flicker},
        {"water.jerlov_error", "light left at depth in ten kinds of water", jerlov},
        {"water.snell_radius_px", "size of the window upwards", window},
        {"water.reflected_energy_error", "light thrown up at a ceiling", reflected},
    };
}

}  // namespace shoal::bench
