// The reference of the water technique against closed forms: interface, level water, one sinusoid, oblique light, a
// patch of six waves, and the balance of energy.
#include <cmath>
#include <fstream>
#include <numeric>
#include <string>

#include <gtest/gtest.h>

#include <shoal/core/parallel.h>
#include <shoal/water/reference.h>

#include "support/known_waves.h"

namespace shoal::water {
namespace {

using test::patchP6;
using test::sinusoidS1;
using test::toSunAt;

constexpr double kDegree = kPiD / 180;

double meanOf(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / double(image.pixels.size());
}

// Irradiance over one period of S1 in `count` bins, E / E_perp, bin 0 at x = 0; the second axis is averaged over.
std::vector<double> tracedProfile(double depth, double attenuation, double zenith, int count, int raysPerSide) {
    const WaveField waves = sinusoidS1();
    const FloorBins bins{{0, 0}, {2, 2}, count, 1, true};
    const FloorResult floor =
        traceFloor(waves, kWaterIndex, attenuation, toSunAt(zenith), 0, depth, bins, raysPerSide, 1);
    return {floor.irradiance.pixels.begin(), floor.irradiance.pixels.end()};
}

TEST(WaterOptics, FresnelTransmittance) {
    const std::pair<double, double> table[] = {{0, .979627},  {10, .979616}, {20, .979445}, {30, .978564},
                                               {40, .975498}, {45, .972102}, {50, .966332}, {60, .940309},
                                               {70, .866525}, {80, .652083}, {85, .416477}};
    for (const auto& [degrees, expected] : table)
        EXPECT_NEAR(fresnelTransmittance(std::cos(degrees * kDegree), kWaterIndex), expected, 6e-7) << degrees;
}

// A floor under level water is lit evenly: every ray carries the same, so only the edges of strata show.
TEST(WaterReference, LevelWater) {
    const WaveField waves = test::levelWater();
    for (const double degrees : {0.0, 30.0, 45.0, 60.0})
        for (const double attenuation : {0.0, 0.13}) {
            const FloorBins bins{{-3, -3}, {3, 3}, 4, 4, false};
            const FloorResult floor =
                traceFloor(waves, kWaterIndex, attenuation, toSunAt(degrees * kDegree), 0, 4, bins, 2048, 3);
            const double expected = analytic::flatIrradiance(kWaterIndex, attenuation, degrees * kDegree, 4);
            EXPECT_NEAR(meanOf(floor.irradiance), expected, 2e-4 * expected) << degrees;
            for (const float irradiance : floor.irradiance.pixels)
                EXPECT_NEAR(irradiance, expected, 1e-3 * expected) << degrees;
        }
    EXPECT_NEAR(analytic::flatIrradiance(kWaterIndex, .13, 45 * kDegree, 4) / std::cos(45 * kDegree), .52639, 5e-6);
    EXPECT_NEAR(analytic::flatIrradiance(kWaterIndex, 0, 0, 4), .979627, 6e-7);
}

struct SinusoidRow {
    double depth, attenuation;
    double expected[5];  // at X = 0, .25, .5, .75, 1
};
constexpr SinusoidRow kSinusoid[] = {
    {1, 0, {1.125285, 1.060975, .959667, .896755, .876927}},  {2, 0, {1.310921, 1.127520, .921435, .819515, .789773}},
    {4, 0, {1.956412, 1.148775, .807054, .689792, .658818}},  {6, 0, {3.854202, 1.008997, .689526, .590770, .565115}},
    {4, .13, {1.155592, .681347, .480991, .412351, .394235}},
};

TEST(WaterReference, SinusoidClosedForm) {
    for (const SinusoidRow& row : kSinusoid) {
        const analytic::Sinusoid s{.attenuation = row.attenuation};
        for (int i = 0; i < 5; ++i)
            EXPECT_NEAR(analytic::sinusoidIrradiance(s, row.depth, .25 * i), row.expected[i], 6e-7) << row.depth;
    }
    EXPECT_NEAR(analytic::focusDepth({}), 8.061780, 5e-7);
    EXPECT_TRUE(analytic::sinusoidFolds({}, 8.06).empty());
    EXPECT_EQ(analytic::sinusoidFolds({}, 8.07).size(), 2u);
    for (const auto& [depth, fold] : {std::pair{10.0, .031400}, {12.0, .083829}, {16.0, .210352}}) {
        const std::vector<double> folds = analytic::sinusoidFolds({}, depth);
        ASSERT_EQ(folds.size(), 2u) << depth;
        EXPECT_NEAR(folds[0], -fold, 6e-7) << depth;
        EXPECT_NEAR(folds[1], fold, 6e-7) << depth;
    }
}

// Rays into narrow bins round the table's points: the bin's mean differs from the point by less than .05 %.
TEST(WaterReference, SinusoidTraced) {
    for (const SinusoidRow& row : kSinusoid) {
        const int count = 400;  // of 5 mm
        const std::vector<double> profile = tracedProfile(row.depth, row.attenuation, 0, count, 4096);
        for (int i = 0; i < 5; ++i) {
            const int right = i * count / 8;
            const double mean = 0.5 * (profile[std::size_t(right)] + profile[std::size_t((right + count - 1) % count)]);
            EXPECT_NEAR(mean, row.expected[i], 2e-3 * row.expected[i]) << row.depth << " " << i;
        }
    }
}

TEST(WaterReference, SinusoidPastItsFocus) {
    const double expected[6] = {4.3972, 5.1677, 7.8644, .7441, .6906, .6480};
    const auto check = [&](const std::vector<double>& bins, double tolerance) {
        for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(bins[i], expected[i], tolerance * expected[i]) << i;
        const double mean = std::accumulate(bins.begin(), bins.end(), 0.0) / 64;
        double variance = 0;
        for (const double bin : bins) variance += (bin - mean) * (bin - mean) / 64;
        EXPECT_NEAR(mean, .979624, 1e-6 + tolerance * 0.01);
        EXPECT_NEAR(std::sqrt(variance) / mean, 1.6551, 5e-5 + tolerance);
    };
    check(analytic::sinusoidBins({}, 12, 0, 2, 64), 8e-5);
    check(tracedProfile(12, 0, 0, 64, 2048), 2e-3);
}

// Light over a period is what got in, folds or none.
TEST(WaterReference, SinusoidKeepsItsFlux) {
    for (const double depth : {1.0, 8.061780, 12.0, 30.0})
        EXPECT_NEAR(analytic::sinusoidBins({}, depth, -1, 1, 1)[0], .979624, 6e-7) << depth;
}

// Where the brightest bin on the axis is found as the floor sinks.
TEST(WaterReference, FocusDepth) {
    double brightest = 0, at = 0;
    for (double depth = 7; depth <= 9.2; depth += 0.1) {
        const std::vector<double> profile = tracedProfile(depth, 0, 0, 2000, 1024);
        const double onAxis = profile.front() + profile.back();
        if (onAxis > brightest) brightest = onAxis, at = depth;
    }
    EXPECT_NEAR(at, analytic::focusDepth({}), 0.03 * analytic::focusDepth({}));
}

TEST(WaterReference, SinusoidInObliqueLight) {
    struct Row {
        double degrees, expected[4], mean;
    };
    for (const Row& row :
         {Row{30, {.77539, 1.07979, 1.28930, .74731}, .978215}, Row{60, {.59051, .47928, .62292, 1.11724}, .936775}}) {
        const double zenith = row.degrees * kDegree, level = std::cos(zenith);
        const analytic::Sinusoid s{.zenithAngle = zenith};
        const int count = 400;
        const std::vector<double> profile = tracedProfile(2, 0, zenith, count, 4096);
        for (int i = 0; i < 4; ++i) {
            EXPECT_NEAR(analytic::sinusoidIrradiance(s, 2, .5 * i) / level, row.expected[i], 6e-6) << i;
            const int right = i * count / 4;
            const double mean = 0.5 * (profile[std::size_t(right)] + profile[std::size_t((right + count - 1) % count)]);
            EXPECT_NEAR(mean / level, row.expected[i], 2e-3 * row.expected[i]) << row.degrees << " " << i;
        }
        EXPECT_NEAR(analytic::sinusoidBins(s, 2, 0, 2, 1)[0] / level, row.mean, 6e-7);
        EXPECT_NEAR(std::accumulate(profile.begin(), profile.end(), 0.0) / count / level, row.mean, 2e-5);
    }
}

// Mean, coefficient of variation and peak of a 512^2 map of P6. Two runs with different strata have the same map and
// independent noise: their covariance is the variance of the map alone.
struct MapFigures {
    double mean = 0, variation = 0, peak = 0;
};
MapFigures patchFigures(double depth, double disc) {
    const WaveField waves = patchP6();
    const FloorBins bins{{0, 0}, {4, 4}, 512, 512, true};
    const FloorResult a = traceFloor(waves, kWaterIndex, 0, {0, 1, 0}, disc, depth, bins, 2048, 1);
    const FloorResult b = traceFloor(waves, kWaterIndex, 0, {0, 1, 0}, disc, depth, bins, 2048, 2);
    MapFigures figures;
    figures.mean = 0.5 * (meanOf(a.irradiance) + meanOf(b.irradiance));
    double covariance = 0, peak = 0;
    const std::size_t count = a.irradiance.pixels.size();
    for (std::size_t i = 0; i < count; ++i) {
        const double u = a.irradiance.pixels[i], v = b.irradiance.pixels[i];
        covariance += (u - figures.mean) * (v - figures.mean) / double(count);
        peak = std::max(peak, 0.5 * (u + v));
    }
    figures.variation = std::sqrt(covariance) / figures.mean;
    figures.peak = peak / figures.mean;
    return figures;
}

TEST(WaterReference, PatchOfSixWaves) {
    for (const auto& [depth, variation, peak] : {std::tuple{.7, .269, 2.47}, {2., 1.477, 45.1}, {5., 1.842, 62.5}}) {
        const MapFigures figures = patchFigures(depth, 0);
        EXPECT_NEAR(figures.mean, .979622, 1e-5) << depth;
        EXPECT_NEAR(figures.variation, variation, .0006 + .001 * variation) << depth;
        EXPECT_NEAR(figures.peak, peak, .08 * peak) << depth;
    }
}

TEST(WaterReference, PatchUnderTheSunsDisc) {
    for (const auto& [depth, variation, peak] : {std::tuple{2., 1.300, 29.4}, {5., 1.474, 19.0}}) {
        const MapFigures figures = patchFigures(depth, .004653);
        EXPECT_NEAR(figures.mean, .979622, 1e-5) << depth;
        EXPECT_NEAR(figures.variation, variation, .003 * variation) << depth;
        EXPECT_NEAR(figures.peak, peak, .08 * peak) << depth;
    }
}

// All light that arrives is reflected, absorbed or received; and as much arrives as falls on level water, because waves
// shade each other when the sun is low.
TEST(WaterReference, EnergyIsKept) {
    const WaveField waves = patchP6();
    const FloorBins bins{{0, 0}, {4, 4}, 64, 64, true};
    for (const double degrees : {0.0, 30.0, 60.0, 80.0, 85.0, 88.0})
        for (const auto& [attenuation, depth] : {std::pair{0.0, 5.0}, {0.13, 0.5}}) {
            const double level = std::cos(degrees * kDegree);
            const FloorResult floor =
                traceFloor(waves, kWaterIndex, attenuation, toSunAt(degrees * kDegree), 0, depth, bins, 384, 5);
            EXPECT_NEAR(floor.incoming, level, (degrees > 86 ? 3e-3 : 1e-3) * level) << degrees;  // few are lit at 88
            EXPECT_NEAR(floor.received + floor.reflected + floor.absorbed, floor.incoming, 1e-7) << degrees;
            EXPECT_EQ(floor.absorbed == 0, attenuation == 0);
        }
}

TEST(WaterReference, FloorIsTheSameForAnyThreadCount) {
    const WaveField waves = patchP6();
    const FloorBins bins{{0, 0}, {4, 4}, 128, 128, true};
    const auto trace = [&](int threads) {
        const ThreadLimit limit(threads);
        return traceFloor(waves, kWaterIndex, .13, toSunAt(.5), .004653, 2, bins, 512, 7);
    };
    const FloorResult one = trace(1), many = trace(0);
    EXPECT_EQ(one.irradiance.pixels, many.irradiance.pixels);
    EXPECT_EQ(one.absorbed, many.absorbed);
    EXPECT_EQ(one.incoming, many.incoming);
}

TEST(WaterReference, NoSunBelowTheHorizon) {
    const FloorResult floor =
        traceFloor(sinusoidS1(), kWaterIndex, 0, {1, -.1f, 0}, 0, 2, {{0, 0}, {2, 2}, 8, 8, true}, 64, 1);
    for (const float irradiance : floor.irradiance.pixels) EXPECT_EQ(irradiance, 0);
    EXPECT_EQ(floor.incoming, 0);
}

TEST(WaterReference, ShaftsInLevelWater) {
    const analytic::ShaftMedium medium;
    const double up = std::sqrt(.75);
    EXPECT_NEAR(analytic::flatShaft(medium, 0, {2, 0, 1, 0, 0, 10}), .00155893, 6e-9);
    EXPECT_NEAR(analytic::flatShaft(medium, 0, {2, 0, up, .5, 0, 4}), .00276248, 6e-9);
    EXPECT_NEAR(analytic::flatShaft(medium, 0, {2, 0, up, -.5, 0, 10}), .00066805, 6e-9);
    // A sinusoid of no height is level water, at any angle of the light and where bracket over denominator is S.
    const analytic::Sinusoid level{.amplitude = 0};
    for (const double zenith : {0.0, .5, 1.0})
        for (const double vy : {-.9, 0.0, .3, std::sqrt(1 - std::pow(std::sin(zenith) / kWaterIndex, 2))}) {
            const analytic::ShaftRay ray{2, 0, std::sqrt(1 - vy * vy) * .6, vy, std::sqrt(1 - vy * vy) * .8, 2};
            analytic::Sinusoid s = level;
            s.zenithAngle = zenith;
            const double expected = analytic::flatShaft(medium, zenith, ray);
            EXPECT_NEAR(analytic::sinusoidShaft(medium, s, ray, 400), expected, 1e-6 * expected) << zenith << " " << vy;
        }
}

// Past the focus the point value is singular; the mean over a footprint is not, and tends to the same.
TEST(WaterReference, ShaftsUnderASinusoid) {
    const analytic::ShaftMedium medium;
    const analytic::ShaftRay near{2, .1, std::sqrt(.75), -.5, 0, 10}, deep{10, .1, std::sqrt(.99), .1, 0, 4};
    const double point = analytic::sinusoidShaft(medium, {}, near, 400);
    EXPECT_NEAR(analytic::sinusoidShaft(medium, {}, near, 1600), point, 1e-5 * point);
    EXPECT_NEAR(analytic::sinusoidShaft(medium, {}, near, 400, .01), point, 1e-4 * point);
    const double coarse = analytic::sinusoidShaft(medium, {}, deep, 1000, .02);
    EXPECT_NEAR(analytic::sinusoidShaft(medium, {}, deep, 2000, .02), coarse, 2e-3 * coarse);
    EXPECT_NEAR(analytic::sinusoidShaft(medium, {}, deep, 2000, .01), coarse, 1e-2 * coarse);
}

// Somebody else's program: POV-Ray's photons through an isosurface (scripts/povray_check made the table). Its density
// estimate by nearest neighbours spreads .2 % (standard deviation, over 62.5 mm) round the exact means, .4 % single
// values.
TEST(WaterReference, AgreesWithPovRay) {
    std::ifstream file(SHOAL_SOURCE_DIR "/tests/data/povray_sinusoid.csv");
    ASSERT_TRUE(file);
    std::vector<double> table;
    for (std::string line; std::getline(file, line);)
        if (!line.empty() && line[0] != '#') table.push_back(std::stod(line.substr(line.find(',') + 1)));
    ASSERT_EQ(table.size(), 256u);
    const FloorBins bins{{-1, -1}, {1, 1}, 256, 1, true};
    const FloorResult floor = traceFloor(sinusoidS1(), kWaterIndex, 0, {0, 1, 0}, 0, 4, bins, 2048, 1);
    const std::vector<float>& ours = floor.irradiance.pixels;
    double theirMean = 0, ourMean = 0;
    for (std::size_t i = 0; i < 256; i += 8) {
        double theirs = 0, traced = 0;
        for (std::size_t j = i; j < i + 8; ++j) {
            EXPECT_NEAR(table[j], ours[j], .02 * table[j]) << j;
            theirs += table[j], traced += ours[j];
        }
        EXPECT_NEAR(theirs, traced, .009 * theirs) << i;
        theirMean += theirs / 256, ourMean += traced / 256;
    }
    EXPECT_NEAR(theirMean, ourMean, .003 * theirMean);
}

}  // namespace
}  // namespace shoal::water
