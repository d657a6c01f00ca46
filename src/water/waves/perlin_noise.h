// Perlin's improved noise as a periodic tile that moves: the third coordinate is time.
#pragma once

#include "water/waves/tile_source.h"

namespace shoal::water {

// What one octave never exceeds, with lattice points a unit apart: the greatest sum over cell positions when all eight
// corners have the worst of their twelve gradients.
inline constexpr double kNoiseHeight = 1.0363, kNoiseSlope = 3.75;

struct NoiseParams {
    double amplitude = 0;  // metres: |height| <= amplitude
    double spacing = 1;    // metres between lattice points
    std::uint32_t seed = 1;
};
// Two octaves in a tile of 16 x 16 cells of the coarser one.
std::unique_ptr<TileSource> makePerlinNoise(const NoiseParams& params);

}  // namespace shoal::water
