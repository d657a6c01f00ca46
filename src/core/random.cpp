// Random numbers and low-discrepancy points as pure functions of seed and index.
// [Jarzynski & Olano 2020] Hash Functions for GPU Rendering, JCGT 9(3): pcg3d.
// [Salmon et al. 2011] Parallel Random Numbers: As Easy as 1, 2, 3, SC11: Philox4x32-10.
// [Burley 2020] Practical Hash-based Owen Scrambling, JCGT 9(4); the permutation's constants are those of
// [Vegdahl 2021] Building a Better LK Hash, which removes the bias the paper's own ones have.
// [Roberts 2018] The Unreasonable Effectiveness of Quasirandom Sequences: R2.
#include <shoal/core/assert.h>
#include <shoal/core/random.h>
#include <algorithm>

namespace shoal {

namespace {

constexpr float kUnitFrom24Bits = 1.0f / 16777216.0f;
constexpr double kLargestBelowOne = 1.0 - 0x1p-53;

float unitFloat(std::uint32_t bits) { return float(bits >> 8) * kUnitFrom24Bits; }

std::uint32_t reverseBits(std::uint32_t x) {
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
}

// Flips every bit of x by a hash of the bits above it: Owen scrambling in base 2.
std::uint32_t owenScramble(std::uint32_t x, std::uint32_t seed) {
    x = reverseBits(x);
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reverseBits(x);
}

// Second dimension of Sobol's sequence, first polynomial x + 1: each direction number is the last one xor its half.
std::uint32_t sobolSecond(std::uint32_t index) {
    std::uint32_t x = 0;
    for (std::uint32_t direction = 0x80000000u; index != 0; index >>= 1, direction ^= direction >> 1)
        if (index & 1u) x ^= direction;
    return x;
}

}  // namespace

// pcg3d's mixing step three times instead of twice: after two the high bits of a do not reach the low bits of the
// result.
std::uint32_t randomBits(std::uint32_t seed, std::uint32_t a, std::uint32_t b) {
    std::uint32_t x = a * 1664525u + 1013904223u;
    std::uint32_t y = b * 1664525u + 1013904223u;
    std::uint32_t z = seed * 1664525u + 1013904223u;
    for (int round = 0; round < 3; ++round) {
        x += y * z;
        y += z * x;
        z += x * y;
        x ^= x >> 16;
        y ^= y >> 16;
        z ^= z >> 16;
    }
    return x;
}

float randomFloat(std::uint32_t seed, std::uint32_t a, std::uint32_t b) { return unitFloat(randomBits(seed, a, b)); }

Philox4 philox(std::uint32_t key0, std::uint32_t key1, std::uint32_t c0, std::uint32_t c1, std::uint32_t c2,
               std::uint32_t c3) {
    constexpr std::uint64_t kMultiplier0 = 0xd2511f53u, kMultiplier1 = 0xcd9e8d57u;
    constexpr std::uint32_t kWeyl0 = 0x9e3779b9u, kWeyl1 = 0xbb67ae85u;  // golden ratio, sqrt(3) - 1
    constexpr int kRounds = 10;
    for (int round = 0; round < kRounds; ++round) {
        const std::uint64_t p0 = kMultiplier0 * c0, p1 = kMultiplier1 * c2;
        c0 = std::uint32_t(p1 >> 32) ^ c1 ^ key0;
        c1 = std::uint32_t(p1);
        c2 = std::uint32_t(p0 >> 32) ^ c3 ^ key1;
        c3 = std::uint32_t(p0);
        key0 += kWeyl0;
        key1 += kWeyl1;
    }
    return {{c0, c1, c2, c3}};
}

double radicalInverse(std::uint32_t base, std::uint64_t index) {
    SHOAL_ASSERT_GE(base, 2u);
    double value = 0, place = 1.0 / base;
    for (; index != 0; index /= base, place /= base) value += double(index % base) * place;
    return std::min(value, kLargestBelowOne);  // 64 digits of 1 would round up
}

// The index is scrambled as well [Burley 2020, §4]: points of two seeds paired up are then uncorrelated, and the first
// 2^k points remain a (0,k,2)-net.
Vec2 sobol2(std::uint32_t index, std::uint32_t seed) {
    index = owenScramble(index, randomBits(seed, 0, 0x50b01u));
    return {unitFloat(owenScramble(reverseBits(index), randomBits(seed, 1, 0x50b01u))),
            unitFloat(owenScramble(sobolSecond(index), randomBits(seed, 2, 0x50b01u)))};
}

// Fixed point in 64 bits: exact for every index. The steps are 2^64 / g and 2^64 / g^2, g the root of g^3 = g + 1.
Vec2 r2Point(std::uint32_t index) {
    constexpr std::uint64_t kStepX = 0xc13fa9a902a6328full, kStepY = 0x91e10da5c79e7b1dull;
    constexpr std::uint64_t kHalf = 1ull << 63;
    const std::uint64_t n = std::uint64_t(index) + 1;
    return {unitFloat(std::uint32_t((kHalf + n * kStepX) >> 32)), unitFloat(std::uint32_t((kHalf + n * kStepY) >> 32))};
}

}  // namespace shoal
