// Where on the level plane light enters that can reach what is seen: cells of a grid, each with its share of the rays.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "water/reference/light_source.h"

namespace shoal::water {

// A box of what is seen, and how much it counts (pixels).
struct SeenBox {
    Vec3 lo, hi;
    float weight = 1;
};

struct EmissionCell {
    double x = 0, z = 0;  // corner
    double size = 0;      // metres a side
    std::uint32_t raysPerSide = 1;
    double rayArea() const { return size * size / (double(raysPerSide) * raysPerSide); }
};

// At most 256 x 256 cells, and no more than a 64th of the rays. A cell is taken where light of the source can enter
// that, through waves no higher than their bound and no steeper than greatestSlope, reaches one of the boxes; nine
// tenths of the rays are shared by how many boxes there are to a cell, one tenth evenly.
std::vector<EmissionCell> emissionCells(const Body& body, const LightSource& source, std::span<const SeenBox> seen,
                                        std::int64_t rays);

}  // namespace shoal::water
