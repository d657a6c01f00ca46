// Statistics of the random numbers, known answers, and the nets of the low-discrepancy points. All seeds are fixed, so
// a statistic is a number; limits are six standard deviations of a fair generator.
#include <shoal/core/random.h>
#include <bit>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace shoal {
namespace {

using Stream = std::function<std::uint32_t(std::uint32_t)>;  // index to 32 bits

// Counters as programs use them: one runs, the others stand.
std::vector<std::pair<const char*, Stream>> streams() {
    return {{"a runs", [](std::uint32_t i) { return randomBits(1, i); }},
            {"b runs", [](std::uint32_t i) { return randomBits(1, 0, i); }},
            {"seed runs", [](std::uint32_t i) { return randomBits(i, 0); }},
            {"pixels", [](std::uint32_t i) { return randomBits(0, i % 320, i / 320); }},
            {"far apart", [](std::uint32_t i) { return randomBits(5, i << 12, 0xffffffffu - i); }},
            {"philox word 0", [](std::uint32_t i) { return philox(1, 2, i, 0).v[0]; }},
            {"philox word 3", [](std::uint32_t i) { return philox(1, 2, 0, i).v[3]; }}};
}

double chiSquare(const std::vector<int>& bins, double expected) {
    double sum = 0;
    for (const int n : bins) sum += (n - expected) * (n - expected) / expected;
    return sum;
}

double chiSquareLimit(double freedom) { return freedom + 6 * std::sqrt(2 * freedom); }

constexpr std::uint32_t kCount = 1 << 17;

// The worst chi-square of the four bytes, 255 degrees of freedom.
double worstByte(const Stream& bits) {
    double worst = 0;
    for (int byte = 0; byte < 4; ++byte) {
        std::vector<int> bins(256);
        for (std::uint32_t i = 0; i < kCount; ++i) ++bins[bits(i) >> (8 * byte) & 0xff];
        worst = std::max(worst, chiSquare(bins, kCount / 256.0));
    }
    return worst;
}

// Joint distribution of four bits of one number and four of the next; the highest and the lowest four.
double worstNeighbours(const Stream& bits) {
    double worst = 0;
    for (const int shift : {0, 28}) {
        std::vector<int> bins(256);
        for (std::uint32_t i = 0; i < kCount; ++i) ++bins[(bits(i) >> shift & 15) * 16 + (bits(i + 1) >> shift & 15)];
        worst = std::max(worst, chiSquare(bins, kCount / 256.0));
    }
    return worst;
}

TEST(Random, BytesAreUniform) {
    for (const auto& [name, bits] : streams()) EXPECT_LT(worstByte(bits), chiSquareLimit(255)) << name;
}

TEST(Random, NeighboursAreIndependent) {
    for (const auto& [name, bits] : streams()) EXPECT_LT(worstNeighbours(bits), chiSquareLimit(255)) << name;
}

TEST(Random, TheStatisticsRejectAWeakGenerator) {
    const Stream weak = [](std::uint32_t i) { return i * 1664525u + 1013904223u; };
    EXPECT_GT(worstByte(weak) + worstNeighbours(weak), 2 * chiSquareLimit(255));
    EXPECT_GT(worstNeighbours(weak), chiSquareLimit(255));
}

TEST(Random, FloatsAreInTheUnitIntervalWithMeanHalfAndVarianceOneTwelfth) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        double sum = 0, squares = 0;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            const double x = randomFloat(seed, i);
            ASSERT_GE(x, 0);
            ASSERT_LT(x, 1);
            sum += x;
            squares += x * x;
        }
        const double mean = sum / kCount, variance = squares / kCount - mean * mean;
        EXPECT_NEAR(mean, 0.5, 6 * std::sqrt(1 / 12.0 / kCount));
        EXPECT_NEAR(variance, 1 / 12.0, 6 * std::sqrt(1 / 180.0 / kCount));
    }
}

// Pixel x and pixel y, seed and seed + 1, a and b exchanged: the pairs a program is likely to correlate.
TEST(Random, CountersAndSeedsAreIndependent) {
    const std::pair<Stream, Stream> pairs[] = {
        {[](std::uint32_t i) { return randomBits(3, i, 0); }, [](std::uint32_t i) { return randomBits(3, i, 1); }},
        {[](std::uint32_t i) { return randomBits(3, i, 7); }, [](std::uint32_t i) { return randomBits(4, i, 7); }},
        {[](std::uint32_t i) { return randomBits(3, i, 9); }, [](std::uint32_t i) { return randomBits(3, 9, i); }},
        {[](std::uint32_t i) { return randomBits(i, 3, 9); }, [](std::uint32_t i) { return randomBits(3, i, 9); }}};
    for (const auto& [one, other] : pairs)
        for (const int shift : {0, 28}) {
            std::vector<int> bins(256);
            for (std::uint32_t i = 100; i < kCount + 100; ++i)
                ++bins[(one(i) >> shift & 15) * 16 + (other(i) >> shift & 15)];
            EXPECT_LT(chiSquare(bins, kCount / 256.0), chiSquareLimit(255));
        }
}

// A flipped bit of any input flips every bit of the output half of the time.
TEST(Random, EveryInputBitReachesEveryOutputBit) {
    constexpr int kTrials = 4096;
    for (int input = 0; input < 3; ++input)
        for (int bit = 0; bit < 32; ++bit) {
            std::vector<int> flips(32);
            for (std::uint32_t n = 0; n < kTrials; ++n) {
                const Philox4 base = philox(9, 9, n, 0);
                std::uint32_t in[3] = {base.v[0], base.v[1], base.v[2]};
                const std::uint32_t before = randomBits(in[0], in[1], in[2]);
                in[input] ^= 1u << bit;
                const std::uint32_t changed = before ^ randomBits(in[0], in[1], in[2]);
                for (int k = 0; k < 32; ++k) flips[std::size_t(k)] += int(changed >> k & 1u);
            }
            for (int k = 0; k < 32; ++k)
                ASSERT_NEAR(flips[std::size_t(k)] / double(kTrials), 0.5, 6 * 0.5 / std::sqrt(kTrials))
                    << "input " << input << " bit " << bit << " output bit " << k;
        }
}

// kat_vectors of Random123 [Salmon et al. 2011].
TEST(Philox, KnownAnswers) {
    const auto expectWords = [](Philox4 p, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        EXPECT_EQ(p.v[0], a);
        EXPECT_EQ(p.v[1], b);
        EXPECT_EQ(p.v[2], c);
        EXPECT_EQ(p.v[3], d);
    };
    const std::uint32_t ones = 0xffffffffu;
    expectWords(philox(0, 0, 0, 0, 0, 0), 0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u);
    expectWords(philox(ones, ones, ones, ones, ones, ones), 0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu);
    expectWords(philox(0xa4093822u, 0x299f31d0u, 0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u), 0xd16cfe09u,
                0x94fdccebu, 0x5001e420u, 0x24126ea1u);
}

TEST(RadicalInverse, KnownValues) {
    EXPECT_EQ(radicalInverse(2, 0), 0);
    EXPECT_EQ(radicalInverse(2, 1), 0.5);
    EXPECT_EQ(radicalInverse(2, 2), 0.25);
    EXPECT_EQ(radicalInverse(2, 3), 0.75);
    EXPECT_EQ(radicalInverse(2, 6), 0.375);               // 110 becomes .011
    EXPECT_NEAR(radicalInverse(3, 5), 7.0 / 9, 1e-15);    // 12 becomes .21
    EXPECT_NEAR(radicalInverse(5, 7), 11.0 / 25, 1e-15);  // 12 becomes .21
    EXPECT_NEAR(radicalInverse(10, 1234), 0.4321, 1e-15);
    EXPECT_LT(radicalInverse(2, ~std::uint64_t(0)), 1);
    EXPECT_LT(radicalInverse(3, ~std::uint64_t(0)), 1);
}

TEST(RadicalInverse, FirstPointsFallIntoEveryInterval) {
    for (const std::uint32_t base : {2u, 3u, 5u, 7u}) {
        const std::uint32_t count = base * base * base;
        std::vector<int> hits(count);
        for (std::uint32_t i = 0; i < count; ++i) ++hits[std::size_t(radicalInverse(base, i) * count + 1e-9)];
        for (const int n : hits) EXPECT_EQ(n, 1);
    }
}

// A (0,m,2)-net: each of the 2^m boxes of every shape 2^-k by 2^-(m-k) holds exactly one of the 2^m points.
TEST(Sobol, EveryAlignedBlockIsANet) {
    for (const std::uint32_t seed : {0u, 1u, 12345u, 0xffffffffu})
        for (int m = 0; m <= 10; ++m)
            for (const std::uint32_t block : {0u, 1u, 5u, 1000u})
                for (int k = 0; k <= m; ++k) {
                    const std::uint32_t count = 1u << m, first = block * count;
                    std::vector<int> hits(count);
                    for (std::uint32_t i = first; i < first + count; ++i) {
                        const Vec2 p = sobol2(i, seed);
                        const auto column = std::size_t(p.x * float(1u << k)),
                                   row = std::size_t(p.y * float(1u << (m - k)));
                        ++hits[row << k | column];
                    }
                    for (const int n : hits)
                        ASSERT_EQ(n, 1) << "seed " << seed << " m " << m << " block " << block << " k " << k;
                }
}

TEST(Sobol, AnyOnePointIsUniformOverSeeds) {
    for (const std::uint32_t index : {0u, 1u, 2u, 77u}) {
        std::vector<int> x(256), y(256), both(256);
        for (std::uint32_t seed = 0; seed < kCount; ++seed) {
            const Vec2 p = sobol2(index, seed);
            ++x[std::size_t(p.x * 256)];
            ++y[std::size_t(p.y * 256)];
            ++both[std::size_t(p.x * 16) * 16 + std::size_t(p.y * 16)];
        }
        EXPECT_LT(chiSquare(x, kCount / 256.0), chiSquareLimit(255)) << index;
        EXPECT_LT(chiSquare(y, kCount / 256.0), chiSquareLimit(255)) << index;
        EXPECT_LT(chiSquare(both, kCount / 256.0), chiSquareLimit(255)) << index;
    }
}

// Pairs of dimensions are padded with other seeds: they must not move together.
TEST(Sobol, SeedsAreIndependent) {
    std::vector<int> bins(256);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const std::uint32_t block = i / 64;  // new seeds every 64 points, as pixels would take them
        const Vec2 p = sobol2(i % 64, 2 * block), q = sobol2(i % 64, 2 * block + 1);
        ++bins[std::size_t(p.x * 16) * 16 + std::size_t(q.x * 16)];
    }
    EXPECT_LT(chiSquare(bins, kCount / 256.0), chiSquareLimit(255));
}

// Owen's variance for a smooth function falls with n^-3; random points are at n^-1.
TEST(Sobol, IntegratesASmoothFunctionFarBetterThanRandomPoints) {
    constexpr std::uint32_t kPoints = 1024;
    const double exact = 4 / (double(kPi) * kPi);  // of sin(pi x) sin(pi y)
    const auto error = [&](const std::function<Vec2(std::uint32_t)>& point) {
        double sum = 0;
        for (std::uint32_t i = 0; i < kPoints; ++i) sum += std::sin(kPiD * point(i).x) * std::sin(kPiD * point(i).y);
        return std::abs(sum / kPoints - exact);
    };
    double sobolSquares = 0, r2Error = error(r2Point), randomSquares = 0;
    for (std::uint32_t seed = 0; seed < 16; ++seed) {
        sobolSquares += std::pow(error([&](std::uint32_t i) { return sobol2(i, seed); }), 2);
        randomSquares += std::pow(error([&](std::uint32_t i) {
                                      return Vec2{randomFloat(seed, i, 0), randomFloat(seed, i, 1)};
                                  }),
                                  2);
    }
    EXPECT_LT(std::sqrt(sobolSquares), 0.02 * std::sqrt(randomSquares));
    EXPECT_LT(r2Error, 0.2 * std::sqrt(randomSquares / 16));
}

TEST(R2, FirstPointsOfTheRecurrence) {
    constexpr double g = 1.32471795724474602596;
    for (const std::uint32_t i : {0u, 1u, 2u, 1000u, 4000000000u}) {
        const long double n = (long double)(i) + 1;
        const Vec2 p = r2Point(i);
        EXPECT_NEAR(p.x, double(std::fmod(0.5L + n / g, 1.0L)), 1e-6);
        EXPECT_NEAR(p.y, double(std::fmod(0.5L + n / g / g, 1.0L)), 1e-6);
    }
}

TEST(R2, StarDiscrepancyIsFarBelowRandom) {
    constexpr std::uint32_t kPoints = 1000;
    const auto discrepancy = [](const std::function<Vec2(std::uint32_t)>& point) {
        double worst = 0;
        for (int cornerX = 1; cornerX <= 40; ++cornerX)
            for (int cornerY = 1; cornerY <= 40; ++cornerY) {
                const double w = cornerX / 40.0, h = cornerY / 40.0;
                int inside = 0;
                for (std::uint32_t i = 0; i < kPoints; ++i) inside += point(i).x < w && point(i).y < h;
                worst = std::max(worst, std::abs(inside / double(kPoints) - w * h));
            }
        return worst;
    };
    const double random = discrepancy([](std::uint32_t i) { return Vec2{randomFloat(1, i, 0), randomFloat(1, i, 1)}; });
    EXPECT_LT(discrepancy(r2Point), 0.4 * random);
}

}  // namespace
}  // namespace shoal
