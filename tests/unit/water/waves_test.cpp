#include <gtest/gtest.h>
#include <shoal/core/parallel.h>
#include <shoal/core/random.h>
#include <shoal/water/waves.h>

#include <cmath>

#include "support/water_fields.h"

namespace shoal::water {
namespace {

WaveField made(const WaveParams& params, std::span<const WaveComponentParams> components = {},
               std::vector<Image> maps = {}) {
    auto field = WaveField::create(params, components, std::move(maps));
    if (!field) throw std::runtime_error(field.error().message);
    return *std::move(field);
}

std::string whyNot(const WaveParams& params, std::span<const WaveComponentParams> components = {},
                   std::vector<Image> maps = {}) {
    const auto field = WaveField::create(params, components, std::move(maps));
    return field ? "" : field.error().message;
}

WaveParams ofKind(const char* kind) {
    WaveParams p;
    p.kind = kind;
    return p;
}

WaveComponentParams component(float amplitude, float wavelength, float directionDeg = 0) {
    WaveComponentParams c;
    c.amplitude = amplitude, c.wavelength = wavelength, c.directionDeg = directionDeg;
    return c;
}

TEST(Waves, OneCosineIsTheFormula) {
    const WaveComponentParams c = component(0.05f, 2);
    WaveField field = made(ofKind("sum"), std::span(&c, 1));
    const double k = kPiD;
    for (const double x : {-3.3, 0.0, 0.25, 71.0}) {
        const WaveSample w = field.at(x, 5);
        EXPECT_NEAR(w.h, 0.05 * std::cos(k * x), 1e-6);
        EXPECT_NEAR(w.hx, -0.05 * k * std::sin(k * x), 3e-6);
        EXPECT_NEAR(w.hxx, -0.05 * k * k * std::cos(k * x), 1e-5);
        EXPECT_EQ(w.hz, 0);
    }
    EXPECT_NEAR(field.bounds().slope, 0.157080, 1e-6);
    EXPECT_NEAR(field.bounds().wavelength, 2, 1e-6);
    // Deep water: a period of sqrt(2 pi lambda / g), and towards +x.
    const double period = std::sqrt(2 * kPiD * 2 / 9.80665);
    field.setTime(period / 4);
    EXPECT_NEAR(field.at(0.5, 0).h, 0.05, 1e-6);
    field.setTime(1000 * period);
    EXPECT_NEAR(field.at(0, 0).h, 0.05, 1e-6);
}

TEST(Waves, ComponentsByPeriodAndByWavelengthAgree) {
    WaveComponentParams byPeriod;
    byPeriod.amplitude = 0.02f, byPeriod.m = 3, byPeriod.q = -4, byPeriod.phase = 0.7f;
    WaveParams p = ofKind("sum");
    p.periodM = 10;
    WaveComponentParams byLength = component(0.02f, 2, degrees(std::atan2(-4.0f, 3.0f)));
    byLength.phase = 0.7f;
    WaveField a = made(p, std::span(&byPeriod, 1)), b = made(p, std::span(&byLength, 1));
    a.setTime(3), b.setTime(3);
    for (std::uint32_t i = 0; i < 20; ++i) {
        const double x = double(randomFloat(1, i)) * 10, z = double(randomFloat(2, i)) * 10;
        EXPECT_NEAR(a.at(x, z).h, b.at(x, z).h, 1e-6);
        EXPECT_NEAR(a.at(x, z).hz, b.at(x, z).hz, 1e-5);
    }
}

// Derivatives are those of the height, between texels too.
TEST(Waves, DerivativesAreOfTheHeight) {
    for (test::NamedField& named : test::waveFields()) {
        const WaveField& field = named.field;
        named.field.setTime(1.7);
        for (std::uint32_t i = 0; i < 200; ++i) {
            // The first at the centre of the circular wave, where a cosine of the radius would have a cusp.
            const double x = i ? double(randomFloat(1, i)) * 4 - 2 : 0, z = i ? double(randomFloat(2, i)) * 4 - 2 : 0;
            const double e = 1e-6;
            const WaveSample w = field.at(x, z), px = field.at(x + e, z), mx = field.at(x - e, z),
                             pz = field.at(x, z + e), mz = field.at(x, z - e);
            const double slope = field.bounds().slope, curve = slope * 2 * kPiD / field.bounds().wavelength;
            EXPECT_NEAR(w.hx, (px.h - mx.h) / (2 * e), 1e-6 * slope) << named.name;
            EXPECT_NEAR(w.hz, (pz.h - mz.h) / (2 * e), 1e-6 * slope) << named.name;
            if (i == 0) continue;  // where four texels meet curvature jumps
            EXPECT_NEAR(w.hxx, (px.hx - mx.hx) / (2 * e), 1e-5 * curve) << named.name;
            EXPECT_NEAR(w.hxz, (pz.hx - mz.hx) / (2 * e), 1e-5 * curve) << named.name;
            EXPECT_NEAR(w.hzz, (pz.hz - mz.hz) / (2 * e), 1e-5 * curve) << named.name;
        }
    }
}

// A tile's numbers at its texels against differences of its heights.
TEST(Waves, TilesDerivativesAreOfTheirHeights) {
    for (test::NamedField& named : test::waveFields()) {
        named.field.setTime(2.2);
        for (const WaveTile& tile : named.field.tiles()) {
            const int n = tile.size;
            const double step = double(tile.periodM) / n;
            const auto at = [&](int i, int j, int c) {
                return double(tile.texels[std::size_t(((j & (n - 1)) * n + (i & (n - 1))) * 4 + c)]);
            };
            const auto along = [&](int i, int j, int c, int di, int dj) {
                const auto far = [&](int s) { return at(i + s * di, j + s * dj, c); };
                return (45 * (far(1) - far(-1)) - 9 * (far(2) - far(-2)) + far(3) - far(-3)) / (60 * step);
            };
            // Noise has kinks in its third derivatives where cells of 8 texels meet; inside it is a polynomial.
            const bool noise = std::string(named.name) == "circular" || std::string(named.name) == "turbulent";
            const auto skipped = [&](int i) { return noise && (i % 8 < 3 || i % 8 > 5); };
            double slope = 0, slopeOff = 0, twist = 0, twistOff = 0;
            for (int j = 0; j < n; j += 3)
                for (int i = 0; i < n; i += 3) {
                    if (skipped(i) || skipped(j)) continue;
                    const auto meet = [](double& worst, double value) { worst = std::max(worst, std::abs(value)); };
                    meet(slope, at(i, j, 1)), meet(slope, at(i, j, 2)), meet(twist, at(i, j, 3));
                    meet(slopeOff, at(i, j, 1) - along(i, j, 0, 1, 0));
                    meet(slopeOff, at(i, j, 2) - along(i, j, 0, 0, 1));
                    meet(twistOff, at(i, j, 3) - along(i, j, 1, 0, 1));
                    meet(twistOff, at(i, j, 3) - along(i, j, 2, 1, 0));
                }
            EXPECT_GT(slope, 0) << named.name;
            EXPECT_LT(slopeOff, 0.02 * slope) << named.name << " " << tile.periodM << " m";
            EXPECT_LT(twistOff, 0.05 * twist) << named.name << " " << tile.periodM << " m";
        }
    }
}

// The shortest waves of an ocean are 8 texels long: what the cubic between texels makes of them.
TEST(Waves, TilesKeepShortWavesBetweenTexels) {
    WaveParams p = ofKind("heightmap");
    p.periodM = 1;
    Image map(64, 64, 1);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) map.at(x, y)[0] = 0.01f * std::cos(2 * kPi * float(x) / 8);
    const WaveField field = made(p, {}, {map});
    const double k = 2 * kPiD * 8;
    double height = 0, slope = 0, curve = 0;
    for (int i = 0; i < 500; ++i) {
        const double x = -0.5 + i / 500.0, angle = k * (x + 0.5);
        const WaveSample w = field.at(x, 0.123);
        height = std::max(height, std::abs(w.h - 0.01 * std::cos(angle)) / 0.01);
        slope = std::max(slope, std::abs(w.hx + 0.01 * k * std::sin(angle)) / (0.01 * k));
        curve = std::max(curve, std::abs(w.hxx + 0.01 * k * k * std::cos(angle)) / (0.01 * k * k));
    }
    EXPECT_LT(height, 0.003);
    EXPECT_LT(slope, 0.012);
    EXPECT_LT(curve, 0.08);
}

TEST(Waves, StayWithinTheirBounds) {
    for (test::NamedField& named : test::waveFields()) {
        const WaveBounds b = named.field.bounds();
        EXPECT_GT(b.height, 0) << named.name;
        EXPECT_GT(b.wavelength, 0) << named.name;
        double height = 0, slope = 0;
        for (std::uint32_t t = 0; t < 40; ++t) {
            named.field.setTime(double(randomFloat(3, t)) * 1000 - 300);
            for (std::uint32_t i = 0; i < 2000; ++i) {
                const WaveSample w =
                    named.field.at(double(randomFloat(4 + t, i)) * 60 - 30, double(randomFloat(90 + t, i)) * 60 - 30);
                height = std::max(height, std::abs(w.h)), slope = std::max(slope, std::hypot(w.hx, w.hz));
            }
        }
        EXPECT_LE(height, b.height) << named.name;
        EXPECT_LE(slope, b.slope) << named.name;
        // And the bounds are of some use.
        EXPECT_GT(height, 0.2 * b.height) << named.name;
        EXPECT_GT(slope, 0.15 * b.slope) << named.name;
        EXPECT_EQ(named.field.bounds().slope, b.slope);
    }
}

TEST(Waves, MoveSmoothlyAndAreTheSameForAnyThreads) {
    for (test::NamedField& named : test::waveFields()) {
        named.field.setTime(5);
        const WaveSample before = named.field.at(1.1, 2.3);
        std::vector<float> alone;
        {
            const ThreadLimit one(1);
            named.field.setTime(6), named.field.setTime(5);
            if (!named.field.tiles().empty()) alone = named.field.tiles()[0].texels;
        }
        EXPECT_EQ(named.field.at(1.1, 2.3).h, before.h) << named.name;
        EXPECT_EQ(named.field.at(1.1, 2.3).hxz, before.hxz) << named.name;
        if (!alone.empty()) {
            named.field.setTime(6), named.field.setTime(5);
            EXPECT_EQ(named.field.tiles()[0].texels, alone) << named.name;
        }
        const double height = named.field.bounds().height;
        named.field.setTime(5 + 1e-3);
        EXPECT_NEAR(named.field.at(1.1, 2.3).h, before.h, 0.1 * height) << named.name;
    }
}

TEST(Waves, RevisionTellsOfChange) {
    WaveField flat = made(ofKind("flat")), sea = made(ofKind("sum"), test::sixWaves());
    EXPECT_NE(flat.revision(), sea.revision());
    const std::uint64_t flatBefore = flat.revision(), seaBefore = sea.revision();
    flat.setTime(4), sea.setTime(4);
    EXPECT_EQ(flat.revision(), flatBefore);
    EXPECT_NE(sea.revision(), seaBefore);
    const std::uint64_t moved = sea.revision();
    sea.setTime(4);
    sea.setTime(std::nan(""));
    EXPECT_EQ(sea.revision(), moved);
    EXPECT_EQ(sea.time(), 4);
    EXPECT_EQ(flat.at(3, 4).h, 0);
    EXPECT_EQ(flat.bounds().height, 0);

    WaveParams still = ofKind("turbulent");
    still.speed = 0;
    WaveField frozen = made(still);
    const WaveSample w = frozen.at(1, 1);
    frozen.setTime(99);
    EXPECT_EQ(frozen.at(1, 1).h, w.h);
    EXPECT_EQ(frozen.time(), 99);
}

TEST(Waves, PaperSurfacesKeepTheirAmplitude) {
    for (const char* kind : {"circular", "turbulent"}) {
        WaveParams p = ofKind(kind);
        EXPECT_NEAR(made(p).bounds().height, 0.05, 1e-6);
        EXPECT_EQ(made(p).tiles().size(), 1u);
        p.noise = 0;
        EXPECT_NEAR(made(p).bounds().height, 0.05, 1e-6);
        EXPECT_TRUE(made(p).tiles().empty());
        EXPECT_NEAR(made(p).bounds().slope, 0.05 * 2 * kPiD / 1.2, 1e-6);
        p.noise = 1;
        EXPECT_TRUE(made(p).planeWaves().empty() || made(p).planeWaves()[0].amplitude == 0);
    }
    // Noise of another seed is another noise.
    WaveParams p = ofKind("turbulent"), q = p;
    q.seed = 2;
    EXPECT_NE(made(p).at(1, 1).h, made(q).at(1, 1).h);
}

TEST(Heightmaps, AreFoundWhereTheyLie) {
    WaveParams p = ofKind("heightmap");
    p.periodM = 8;
    Image map(32, 32, 1);
    const double turn = 2 * kPiD / 32;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) map.at(x, y)[0] = float(0.1 * std::sin(turn * x) + 0.05 * std::cos(turn * 2 * y));
    const WaveField field = made(p, {}, {map});
    const double k = 2 * kPiD / 8;
    for (const IVec2 at : {IVec2{0, 0}, {3, 7}, {16, 16}, {31, 20}}) {
        const double x = -4 + at.x * 0.25, z = -4 + at.y * 0.25;
        const WaveSample w = field.at(x, z);
        EXPECT_NEAR(w.h, double(map.at(at.x, at.y)[0]), 1e-6);
        EXPECT_NEAR(w.hx, 0.1 * k * std::cos(turn * at.x), 1e-4);
        EXPECT_NEAR(w.hz, -0.05 * 2 * k * std::sin(turn * 2 * at.y), 1e-4);
        EXPECT_NEAR(w.hxx, -0.1 * k * k * std::sin(turn * at.x), 1e-3);
    }
    EXPECT_NEAR(field.at(13.3, -6.1).h, field.at(13.3 - 8, -6.1 + 8).h, 1e-6);
    p.gain = 2;
    EXPECT_NEAR(made(p, {}, {map}).at(0, 1).h, 2 * field.at(0, 1).h, 1e-6);
}

TEST(Heightmaps, SequencesAreMixedAndGoRound) {
    WaveParams p = ofKind("heightmap");
    p.fps = 10;
    std::vector<Image> maps = {test::bumpyMap(16, 1), test::bumpyMap(16, 2), test::bumpyMap(16, 3)};
    WaveField field = made(p, {}, maps);
    std::vector<double> heights;
    for (int f = 0; f < 4; ++f) {
        field.setTime(f / 10.0 + 1e-9);
        heights.push_back(field.at(0.3, 0.4).h);
    }
    EXPECT_NEAR(heights[3], heights[0], 1e-6);
    EXPECT_GT(std::abs(heights[1] - heights[0]), 1e-4);
    field.setTime(0.125);
    EXPECT_NEAR(field.at(0.3, 0.4).h, 0.75 * heights[1] + 0.25 * heights[2], 1e-6);
    field.setTime(-0.1);
    EXPECT_NEAR(field.at(0.3, 0.4).h, heights[2], 1e-6);
}

TEST(Waves, ErrorsNameTheField) {
    EXPECT_NE(whyNot(ofKind("sea")).find("waves."), std::string::npos);
    EXPECT_NE(whyNot(ofKind("sum")).find("waves.components is empty"), std::string::npos);
    WaveComponentParams c = component(-0.1f, 2);
    EXPECT_NE(whyNot(ofKind("sum"), std::span(&c, 1)).find("waves.components[0].amplitude is -0.1"), std::string::npos);
    c = component(0.1f, 0);
    EXPECT_NE(whyNot(ofKind("sum"), std::span(&c, 1)).find("waves.components[0] has no wavelength"), std::string::npos);
    c = component(1, 1);
    EXPECT_NE(whyNot(ofKind("sum"), std::span(&c, 1)).find("slopes of up to 6.28319, expected 4 at most"),
              std::string::npos);
    const std::vector<WaveComponentParams> many(65, component(0.001f, 2));
    EXPECT_NE(whyNot(ofKind("sum"), many).find("65 waves, expected at most 64"), std::string::npos);
    WaveParams steep = ofKind("circular");
    steep.amplitude = 3;
    EXPECT_NE(whyNot(steep).find("waves.amplitude makes slopes"), std::string::npos);
    steep = ofKind("ocean");
    steep.gain = 50;
    EXPECT_NE(whyNot(steep).find("waves.gain makes slopes"), std::string::npos);
    WaveParams bad = ofKind("ocean");
    bad.windSpeed = NAN;
    EXPECT_NE(whyNot(bad).find("windSpeed"), std::string::npos);

    const WaveParams map = ofKind("heightmap");
    EXPECT_NE(whyNot(map).find("waves.file"), std::string::npos);
    EXPECT_NE(whyNot(map, {}, {Image(16, 8, 1)}).find("16 x 8, expected a square"), std::string::npos);
    EXPECT_NE(whyNot(map, {}, {Image(24, 24, 1)}).find("24 x 24, expected a square"), std::string::npos);
    EXPECT_NE(whyNot(map, {}, {Image(16, 16, 1), Image(8, 8, 1)}).find("picture 1 is 8 x 8, expected 16 x 16"),
              std::string::npos);
    Image holed(8, 8, 1);
    holed.at(3, 5)[0] = NAN;
    EXPECT_NE(whyNot(map, {}, {holed}).find("nan at (3, 5)"), std::string::npos);
    Image cliff(8, 8, 1);
    cliff.at(3, 5)[0] = 100;
    EXPECT_NE(whyNot(map, {}, {cliff}).find("waves.gain makes slopes"), std::string::npos);
}

}  // namespace
}  // namespace shoal::water
