// Counter-based random numbers and low-discrepancy points: a value is a function of (seed, index), so any thread may
// ask in any order and the bits are the same.
#pragma once

#include <cstdint>

#include <shoal/core/math.h>

namespace shoal {

// 32 random bits for counter (a, b) under `seed`: pcg3d [Jarzynski & Olano 2020] with three rounds instead of two;
// tests check it for bias.
std::uint32_t randomBits(std::uint32_t seed, std::uint32_t a, std::uint32_t b = 0);
// Uniform in [0, 1), 24 bits.
float randomFloat(std::uint32_t seed, std::uint32_t a, std::uint32_t b = 0);
// Four independent 32-bit words: Philox4x32-10 [Salmon et al. 2011].
struct Philox4 {
    std::uint32_t v[4];
};
Philox4 philox(std::uint32_t key0, std::uint32_t key1, std::uint32_t c0, std::uint32_t c1, std::uint32_t c2 = 0,
               std::uint32_t c3 = 0);

// Radical inverse of index in `base` (a prime): Halton's points take bases 2, 3, 5, ... In [0, 1).
double radicalInverse(std::uint32_t base, std::uint64_t index);
// Point i of Sobol's (0,2)-sequence with Owen scrambling and shuffling by hash [Burley 2020]; in [0, 1)^2. Any
// 2^k points that start at a multiple of 2^k are a (0,k,2)-net.
Vec2 sobol2(std::uint32_t index, std::uint32_t seed);
// Point i of the additive R2 recurrence [Roberts 2018].
Vec2 r2Point(std::uint32_t index);

}  // namespace shoal
