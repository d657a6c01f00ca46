// Light at a height field: Snell in vector form, Fresnel, the shadow of waves on waves.
#include "water/reference/entry.h"

#include <algorithm>

#include <shoal/core/random.h>
#include <shoal/water/optics.h>

namespace shoal::water {

Entry enterWater(const WaveSample& wave, double x, double z, DVec3 travel, double index) {
    Entry entry;
    entry.position = {x, wave.h, z};
    const double toSlope = std::sqrt(1 + wave.hx * wave.hx + wave.hz * wave.hz);  // area of surface per level area
    const DVec3 normal = DVec3{-wave.hx, 1, -wave.hz} * (1 / toSlope);
    const double cosIncidence = std::min(1.0, -dot(travel, normal));
    if (cosIncidence <= 0) return entry;
    const double cosRefracted = std::sqrt(1 - (1 - cosIncidence * cosIncidence) / (index * index));
    entry.refracted = travel * (1 / index) + normal * (cosIncidence / index - cosRefracted);
    entry.reflected = travel + normal * (2 * cosIncidence);
    entry.incident = cosIncidence * toSlope;
    entry.transmitted = fresnelTransmittance(cosIncidence, index);
    return entry;
}

bool shadedByWaves(const WaveField& waves, const WaveBounds& bounds, DVec3 surface, DVec3 toLight, double maxDistance) {
    const double across = std::hypot(toLight.x, toLight.z);
    if (across < 1e-9) return false;
    const double rise = toLight.y / across, closing = bounds.slope - rise;
    if (closing <= 0) return false;
    const double stepX = toLight.x / across, stepZ = toLight.z / across;
    const double end = std::min((bounds.height - surface.y) / std::max(rise, 1e-4), maxDistance * across);
    const double least = bounds.wavelength / 64;
    for (double s = least; s < end;) {
        const double gap = surface.y + s * rise - waves.at(surface.x + s * stepX, surface.z + s * stepZ).h;
        if (gap < 0) return true;
        s += std::max(gap / closing, least);
    }
    return false;
}

void DriftRange::add(const DriftRange& other) {
    minX = std::min(minX, other.minX), maxX = std::max(maxX, other.maxX);
    minZ = std::min(minZ, other.minZ), maxZ = std::max(maxZ, other.maxZ);
}

DriftRange driftRange(DVec3 travel, double index, double slope, double discHalfAngle) {
    constexpr int kRings = 12, kTurns = 48;
    DriftRange range{1e30, -1e30, 1e30, -1e30};
    for (int ring = 0; ring <= kRings; ++ring)
        for (int turn = 0; turn < kTurns; ++turn) {
            const double steep = slope * ring / kRings, angle = 2 * kPiD * turn / kTurns;
            const DVec3 normal = normalize(DVec3{-steep * std::cos(angle), 1, -steep * std::sin(angle)});
            // Grazing light counts too: the slope may be there that catches it.
            const double cosIncidence = std::clamp(-dot(travel, normal), 0.0, 1.0);
            const double cosRefracted = std::sqrt(1 - (1 - cosIncidence * cosIncidence) / (index * index));
            const DVec3 r = travel * (1 / index) + normal * (cosIncidence / index - cosRefracted);
            if (r.y > -0.05) continue;  // nearly level: no floor is reached
            range.add({r.x / -r.y, r.x / -r.y, r.z / -r.y, r.z / -r.y});
        }
    // A change of incidence turns the refracted ray by at most that over the index and its cosine; twice that is safe.
    const double wider = 4 * discHalfAngle + 0.01 * (range.maxX - range.minX + range.maxZ - range.minZ);
    return {range.minX - wider, range.maxX + wider, range.minZ - wider, range.maxZ + wider};
}

DiscSample sampleDisc(DVec3 travel, double halfAngle, std::uint32_t column, std::uint32_t row, std::uint32_t seed) {
    if (halfAngle <= 0) return {travel, 1};
    const std::uint32_t inBlock = (row & 3u) * 4 + (column & 3u);
    const Vec2 u = sobol2(inBlock, randomBits(seed, column >> 2, row >> 2));
    const double sine = std::sin(halfAngle) * std::sqrt(double(u.x)), angle = 2 * kPiD * double(u.y);
    const double cosine = std::sqrt(1 - sine * sine);
    const DVec3 aside = normalize(cross(travel, std::abs(travel.y) < 0.9 ? DVec3{0, 1, 0} : DVec3{1, 0, 0}));
    const DVec3 other = cross(travel, aside);
    return {travel * cosine + aside * (sine * std::cos(angle)) + other * (sine * std::sin(angle)), 1 / cosine};
}

Jitter jitterOf(std::uint32_t column, std::uint32_t row, std::uint32_t seed) {
    const std::uint32_t a = randomBits(seed, column, row), b = randomBits(seed ^ 0x9e3779b9u, column, row);
    return {(a + 0.5) * 0x1p-32, (b + 0.5) * 0x1p-32};
}

}  // namespace shoal::water
