#include <gtest/gtest.h>
#include <shoal/core/random.h>

#include <cmath>

#include "water/waves/ocean_tiles.h"
#include "water/waves/perlin_noise.h"
#include "water/waves/tile_transform.h"

namespace shoal::water {
namespace {

WaveParams ocean(const char* spectrum = "jonswap", float wind = 5) {
    WaveParams p;
    p.spectrum = spectrum, p.windSpeed = wind;
    return p;
}

WaveField made(const WaveParams& params) {
    auto field = WaveField::create(params);
    if (!field) throw std::runtime_error(field.error().message);
    return *std::move(field);
}

struct Moments {
    double variance = 0, slopeSquare = 0;
};
Moments momentsOf(const WaveTile& tile) {
    Moments m;
    const double count = double(tile.texels.size()) / 4;
    for (std::size_t t = 0; t < tile.texels.size(); t += 4) {
        const double h = double(tile.texels[t]), x = double(tile.texels[t + 1]), z = double(tile.texels[t + 2]);
        m.variance += h * h / count, m.slopeSquare += (x * x + z * z) / count;
    }
    return m;
}

TEST(TileTransform, OfAnImpulseIsOneWave) {
    TileTransform transform;
    std::complex<float> row[TileTransform::kSize];
    for (const IVec2 wave : {IVec2{0, 0}, {3, -5}, {-100, 77}}) {
        transform.clear();
        transform.set(wave.x, wave.y, {1, 0});
        transform.transformFirst();
        for (const std::size_t j : {0u, 9u, 200u}) {
            transform.transformSecond(j, row);
            for (int i = 0; i < TileTransform::kSize; i += 7) {
                const double angle = 2 * kPiD * (wave.x * i + wave.y * int(j)) / TileTransform::kSize;
                EXPECT_NEAR(row[i].real(), std::cos(angle), 1e-5);
                EXPECT_NEAR(row[i].imag(), std::sin(angle), 1e-5);
            }
        }
    }
}

TEST(TileTransform, IsTheSumOfItsWaves) {
    TileTransform transform;
    std::vector<std::complex<double>> coefficients;
    std::vector<IVec2> waves;
    for (std::uint32_t i = 0; i < 300; ++i) {
        const IVec2 wave{int(randomBits(1, i) % 60) - 30, int(randomBits(2, i) % 60) - 30};
        if (std::find(waves.begin(), waves.end(), wave) != waves.end()) continue;
        waves.push_back(wave);
        coefficients.emplace_back(double(randomFloat(3, i)) - 0.5, double(randomFloat(4, i)) - 0.5);
        transform.set(wave.x, wave.y, std::complex<float>(coefficients.back()));
    }
    transform.transformFirst();
    std::complex<float> row[TileTransform::kSize];
    for (const std::size_t j : {0u, 1u, 130u, 255u}) {
        transform.transformSecond(j, row);
        for (int i = 0; i < TileTransform::kSize; i += 5) {
            std::complex<double> sum;
            for (std::size_t w = 0; w < waves.size(); ++w)
                sum += coefficients[w] *
                       std::polar(1.0, 2 * kPiD * (waves[w].x * i + waves[w].y * int(j)) / TileTransform::kSize);
            EXPECT_NEAR(std::abs(sum - std::complex<double>(row[i])), 0, 2e-5);
        }
    }
}

TEST(OceanSpectrum, HasJonswapsSignificantHeight) {
    // 4 sqrt(m0) by integrating the frequency spectrum as published, with other quadrature than the class's.
    for (const float wind : {4.0f, 10.0f, 20.0f}) {
        WaveParams p = ocean("jonswap", wind);
        p.fetch = 20000;
        const double u = double(wind), fetch = kGravity * 20000 / (u * u);
        const double alpha = 0.076 * std::pow(fetch, -0.22), peak = 22 * kGravity / u * std::pow(fetch, -1.0 / 3);
        double m0 = 0;
        const double step = peak / 2000;
        for (double w = step / 2; w < 40 * peak; w += step) {
            const double width = w <= peak ? 0.07 : 0.09, off = (w - peak) / (width * peak);
            m0 += alpha * kGravity * kGravity * std::pow(w, -5) * std::exp(-1.25 * std::pow(peak / w, 4)) *
                  std::pow(3.3, std::exp(-0.5 * off * off)) * step;
        }
        const OceanSpectrum spectrum(p);
        EXPECT_NEAR(4 * std::sqrt(spectrum.integral(0, 1600 * peak * peak / kGravity)) / (4 * std::sqrt(m0)), 1, 1e-3);
        // The published growth of the height with fetch, 0.0016 sqrt(fetch) U^2 / g, was fitted to the same data by
        // itself.
        if (fetch < 1000) {
            EXPECT_NEAR(4 * std::sqrt(m0) / (0.0016 * std::sqrt(fetch) * u * u / kGravity), 1, 0.2) << wind;
        }
    }
}

TEST(OceanSpectrum, DirectionsIntegrateToOne) {
    for (const char* name : {"jonswap", "phillips"})
        for (const float spread : {0.0f, 0.3f, 1.0f, 10.0f}) {
            WaveParams p = ocean(name);
            p.spread = spread, p.windDeg = 40;
            const OceanSpectrum spectrum(p);
            for (const double times : {0.7, 1.0, 3.0, 100.0}) {
                const double k = times * spectrum.peak();
                double sum = 0;
                const int steps = 4096;
                for (int i = 0; i < steps; ++i) {
                    const double angle = 2 * kPiD * i / steps;
                    sum += spectrum.density(k * std::cos(angle), k * std::sin(angle)) * k * 2 * kPiD / steps;
                }
                EXPECT_NEAR(sum / spectrum.overDirections(k), 1, 1e-3) << name << " " << spread << " " << times;
            }
        }
}

TEST(OceanBands, AreDisjointAndOfIncommensuratePeriods) {
    for (const char* name : {"jonswap", "phillips"})
        for (const float wind : {0.1f, 2.0f, 5.0f, 12.0f, 60.0f})
            for (const double shortest : {0.01, 0.1, 5.0}) {
                const OceanSpectrum spectrum(ocean(name, wind));
                const auto bands = oceanBands(spectrum, shortest);
                ASSERT_GE(bands.size(), 1u);
                ASSERT_LE(bands.size(), 4u);
                EXPECT_DOUBLE_EQ(bands[0].kHigh, 2 * kPiD / shortest);
                EXPECT_EQ(bands.back().kLow, 0);
                for (std::size_t i = 0; i < bands.size(); ++i) {
                    // At least three texels a wave.
                    EXPECT_GE(2 * kPiD / bands[i].kHigh / (bands[i].periodM / kOceanSize), 2.99);
                    if (i + 1 == bands.size()) break;
                    EXPECT_EQ(bands[i].kLow, bands[i + 1].kHigh);
                    EXPECT_GE(bands[i].kLow * bands[i].periodM / (2 * kPiD), 1.9);  // waves of the longest in a period
                    const double ratio = bands[i + 1].periodM / bands[i].periodM;
                    for (int q = 1; q <= 4; ++q)
                        EXPECT_GT(std::abs(ratio * q - std::round(ratio * q)), 0.1) << ratio << " times " << q;
                }
                // The longest tile holds several of the waves that carry most.
                if (shortest < 0.1 * 2 * kPiD / spectrum.peak()) {
                    EXPECT_GT(bands.back().periodM * spectrum.peak() / (2 * kPiD), 5) << wind << " " << shortest;
                }
            }
}

TEST(Ocean, TilesHaveTheSpectrumsEnergy) {
    for (const char* name : {"jonswap", "phillips"})
        for (const float wind : {3.0f, 8.0f, 20.0f}) {
            const WaveParams p = ocean(name, wind);
            const OceanSpectrum spectrum(p);
            const auto bands = oceanBands(spectrum, double(p.shortestM));
            WaveField field = made(p);
            ASSERT_EQ(field.tiles().size(), bands.size());
            // Waves against each other stand, so that one moment may have more height than another: mean over some.
            std::vector<Moments> mean(bands.size());
            const int moments = 24;
            for (int t = 0; t < moments; ++t) {
                field.setTime(7.3 * t);
                for (std::size_t b = 0; b < bands.size(); ++b) {
                    const Moments m = momentsOf(field.tiles()[b]);
                    mean[b].variance += m.variance / moments, mean[b].slopeSquare += m.slopeSquare / moments;
                }
            }
            double total = 0;
            for (std::size_t b = 0; b < bands.size(); ++b) {
                const double low = bands[b].kLow, high = bands[b].kHigh;
                EXPECT_NEAR(mean[b].variance / spectrum.integral(low, high), 1, 0.04) << name << wind << " band " << b;
                EXPECT_NEAR(mean[b].slopeSquare / spectrum.integral(low, high, 2), 1, 0.04)
                    << name << wind << " band " << b;
                total += mean[b].variance;
            }
            const double height = 4 * std::sqrt(spectrum.integral(0, bands[0].kHigh));
            EXPECT_NEAR(4 * std::sqrt(total) / height, 1, 0.02) << name << wind;
        }
}

TEST(Ocean, RunsWithTheWindAtTheSpeedOfDeepWater) {
    for (const float windDeg : {0.0f, 130.0f}) {
        WaveParams p = ocean();
        p.windDeg = windDeg, p.spread = 4;
        WaveField field = made(p);
        const double e = 1e-2;
        double towards = 0, away = 0, rise2 = 0;
        const std::size_t last = field.tiles().size() - 1, count = field.tiles()[last].texels.size() / 4;
        for (int t = 0; t < 20; ++t) {
            field.setTime(11.0 * t);
            const std::vector<float> before = field.tiles()[last].texels;
            field.setTime(11.0 * t + e);
            const std::vector<float>& after = field.tiles()[last].texels;
            const double c = std::cos(double(windDeg) * kPiD / 180), s = std::sin(double(windDeg) * kPiD / 180);
            for (std::size_t i = 0; i < count; ++i) {
                const double rise = (double(after[4 * i]) - double(before[4 * i])) / e;
                const double slope = c * double(before[4 * i + 1]) + s * double(before[4 * i + 2]);
                (rise * slope < 0 ? towards : away) += std::abs(rise * slope);
                rise2 += rise * rise / double(count) / 20;
            }
        }
        EXPECT_GT(towards, 5 * away) << windDeg;  // h_t = -speed h_x
        // omega^2 = g k: the mean square of the rise is g times the integral of k S.
        const OceanSpectrum spectrum(p);
        const auto bands = oceanBands(spectrum, double(p.shortestM));
        EXPECT_NEAR(rise2 / (kGravity * spectrum.integral(bands[last].kLow, bands[last].kHigh, 1)), 1, 0.04);
    }
}

TEST(Ocean, IsItsSeeds) {
    WaveParams p = ocean(), q = p;
    q.seed = 9;
    EXPECT_EQ(made(p).at(3, 4).h, made(p).at(3, 4).h);
    EXPECT_NE(made(p).at(3, 4).h, made(q).at(3, 4).h);
    p.gain = 0;
    EXPECT_EQ(made(p).at(3, 4).h, 0);
    EXPECT_EQ(made(p).bounds().height, 0);
}

// The greatest sums that eight corners can make, over cell positions and directions.
TEST(PerlinNoise, NeverPassesItsBounds) {
    double height = 0, slope = 0;
    const auto fade = [](double u) { return u * u * u * (u * (u * 6 - 15) + 10); };
    const auto fadeSlope = [](double u) { return 30 * u * u * (u - 1) * (u - 1); };
    const auto worst = [](double a, double b, double c) {  // of twelve gradients: the two greatest components
        a = std::abs(a), b = std::abs(b), c = std::abs(c);
        return a + b + c - std::min({a, b, c});
    };
    const int n = 24;
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            for (int l = 0; l <= n; ++l)
                for (int d = 0; d <= 6; ++d) {
                    const double p[3] = {double(i) / n, double(j) / n, double(l) / n};
                    const double ex = std::cos(d * kPiD / 12), ez = std::sin(d * kPiD / 12);
                    double h = 0, s = 0;
                    for (int corner = 0; corner < 8; ++corner) {
                        double w[3], dw[3], off[3];
                        for (int axis = 0; axis < 3; ++axis) {
                            const int far = corner >> axis & 1;
                            w[axis] = far ? fade(p[axis]) : 1 - fade(p[axis]);
                            dw[axis] = far ? fadeSlope(p[axis]) : -fadeSlope(p[axis]);
                            off[axis] = p[axis] - far;
                        }
                        const double weight = w[0] * w[1] * w[2];
                        const double change = (ex * dw[0] * w[1] + ez * w[0] * dw[1]) * w[2];
                        h += weight * worst(off[0], off[1], off[2]);
                        s += worst(change * off[0] + weight * ex, change * off[1] + weight * ez, change * off[2]);
                    }
                    height = std::max(height, h), slope = std::max(slope, s);
                }
    EXPECT_LE(height, kNoiseHeight);
    EXPECT_LE(slope, kNoiseSlope);
    EXPECT_GT(height, 0.998 * kNoiseHeight);
    EXPECT_GT(slope, 0.998 * kNoiseSlope);
}

}  // namespace
}  // namespace shoal::water
