// One ray of light at the water surface, and what bounds where such rays go.
#pragma once

#include <shoal/water/waves.h>

#include "water/reference/vector.h"

namespace shoal::water {

// Where a ray meets the surface above (x, z) of the level plane. Flux is per area of the LEVEL plane and relative to
// the irradiance on a plane facing the ray (note: E_perp (cos s + sin s (h_x cos a + h_z sin a))).
struct Entry {
    DVec3 position;          // y: above the level
    DVec3 refracted;         // unit, down
    DVec3 reflected;         // unit
    double incident = 0;     // flux that arrives, 0 where the surface faces away
    double transmitted = 0;  // share of it that enters
};
// travel: unit, where the light travels to, down.
Entry enterWater(const WaveSample& wave, double x, double z, DVec3 travel, double index);

// Whether another wave stands between a point of the surface and the light. Steps as far as the slope bound allows, so
// that no crest is missed that is wider than a 64th of the shortest wave.
bool shadedByWaves(const WaveField& waves, const WaveBounds& bounds, DVec3 surface, DVec3 toLight, double maxDistance);

// The range of horizontal metres that refracted light goes per metre of descent.
struct DriftRange {
    double minX = 0, maxX = 0, minZ = 0, maxZ = 0;
    void add(const DriftRange& other);
};
// Of light along `travel` through all slopes up to `slope`, widened by what a disc of that half angle adds.
DriftRange driftRange(DVec3 travel, double index, double slope, double discHalfAngle);

// Direction of travel of sample (column, row) of a disc of light about `travel`: 16 strata over blocks of 4 x 4 rays,
// uniform over the disc's projected solid angle. weight: its share of the irradiance on level things is weight times
// that of the centre direction.
struct DiscSample {
    DVec3 travel;
    double weight = 1;
};
DiscSample sampleDisc(DVec3 travel, double halfAngle, std::uint32_t column, std::uint32_t row, std::uint32_t seed);

// Uniform in [0, 1)^2, different for each (column, row).
struct Jitter {
    double x, z;
};
Jitter jitterOf(std::uint32_t column, std::uint32_t row, std::uint32_t seed);

}  // namespace shoal::water
