// Where photons start: a lattice over the level plane, anchored in the world.
#pragma once

#include <algorithm>
#include <cmath>

#include <shoal/water/body.h>
#include <shoal/water/light_views.h>

namespace shoal::water {

// Cell (i, j) has its middle at ((first + i + 0.5) cellM, ...): the same cells whichever way the slot's square moves,
// as long as its texel and margin stay.
struct EmissionLattice {
    float cellM = 0;
    int firstX = 0, firstZ = 0;
    int countX = 0, countZ = 0;  // 0: none of them lies in the water
};

// About `photons` cells over the square of `resolution` texels a side and its margin; of those the ones that touch the
// water's area.
inline EmissionLattice emissionLattice(const LightSlot& slot, int resolution, int photons, const BodyParams& body) {
    EmissionLattice e;
    const double side = double(slot.texel) * resolution + 2 * double(slot.margin);
    e.cellM = float(side / std::sqrt(double(photons)));
    const auto cells = [&](float origin, float areaMin, float areaMax, int& first, int& count) {
        const double from = double(origin) - double(slot.margin);
        first = int(std::floor(std::max(from, double(areaMin)) / e.cellM));
        count = std::max(int(std::ceil(std::min(from + side, double(areaMax)) / e.cellM)) - first, 0);
    };
    cells(slot.origin.x, body.areaMin.x, body.areaMax.x, e.firstX, e.countX);
    cells(slot.origin.y, body.areaMin.y, body.areaMax.y, e.firstZ, e.countZ);
    return e;
}

}  // namespace shoal::water
