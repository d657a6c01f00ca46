// Where photons start: a lattice over the level plane, anchored in the world.
#pragma once

#include <cmath>

#include <shoal/water/light_views.h>

namespace shoal::water {

// Cell (i, j) has its middle at ((first + i + 0.5) cellM, ...): the same cells whichever way the slot's square moves,
// as long as its texel and margin stay.
struct EmissionLattice {
    float cellM = 0;
    int firstX = 0, firstZ = 0;
    int countX = 0, countZ = 0;
};

// About `photons` cells over the square of `resolution` texels a side and its margin.
inline EmissionLattice emissionLattice(const LightSlot& slot, int resolution, int photons) {
    EmissionLattice e;
    const double side = double(slot.texel) * resolution + 2 * double(slot.margin);
    e.cellM = float(side / std::sqrt(double(photons)));
    const auto first = [&](float origin) { return int(std::floor((double(origin) - slot.margin) / e.cellM)); };
    const auto last = [&](float origin) { return int(std::ceil((double(origin) - slot.margin + side) / e.cellM)); };
    e.firstX = first(slot.origin.x), e.firstZ = first(slot.origin.y);
    e.countX = last(slot.origin.x) - e.firstX, e.countZ = last(slot.origin.y) - e.firstZ;
    return e;
}

}  // namespace shoal::water
