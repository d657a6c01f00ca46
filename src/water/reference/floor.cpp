// Light traced ray by ray onto a level floor: stratified over the level plane, exact at the surface (rays are named by
// the point of the level plane that they enter at), each ray's flux into the bin it lands in. Sums are integers, so
// their order does not matter.
#include <atomic>

#include <shoal/core/assert.h>
#include <shoal/core/parallel.h>
#include <shoal/water/reference.h>

#include "water/reference/entry.h"

namespace shoal::water {

namespace {

struct Rectangle {
    double minX, minZ, maxX, maxZ;
    double area() const { return (maxX - minX) * (maxZ - minZ); }
};

// What the rays carry, in sums over rays.
struct Totals {
    double incoming = 0, reflected = 0, absorbed = 0, received = 0;
    Totals operator+(const Totals& o) const {
        return {incoming + o.incoming, reflected + o.reflected, absorbed + o.absorbed, received + o.received};
    }
};

// The part of the level plane that light on the bins can come from; all of one period where they repeat.
Rectangle emissionOf(const FloorBins& bins, const WaveBounds& bounds, DVec3 travel, double index, double disc,
                     double depth) {
    const Rectangle floor{bins.min.x, bins.min.y, bins.max.x, bins.max.y};
    if (bins.periodic) return floor;
    const DriftRange drift = driftRange(travel, index, bounds.slope, disc);
    const double low = std::max(0.0, depth - bounds.height), high = depth + bounds.height;
    return {floor.minX - std::max(low * drift.maxX, high * drift.maxX),
            floor.minZ - std::max(low * drift.maxZ, high * drift.maxZ),
            floor.maxX - std::min(low * drift.minX, high * drift.minX),
            floor.maxZ - std::min(low * drift.minZ, high * drift.minZ)};
}

// Bin along one axis, -1 outside.
int binOf(double place, double min, double max, int count, bool periodic) {
    double share = (place - min) / (max - min);
    if (periodic) share -= std::floor(share);
    if (!(share >= 0 && share <= 1)) return -1;
    return std::min(int(share * count), count - 1);
}

}  // namespace

FloorResult traceFloor(const WaveField& waves, double index, double attenuation, Vec3 toSun, double discHalfAngle,
                       double depth, const FloorBins& bins, int raysPerSide, std::uint32_t seed) {
    SHOAL_ASSERT(bins.countX > 0 && bins.countZ > 0 && bins.max.x > bins.min.x && bins.max.y > bins.min.y);
    SHOAL_ASSERT(raysPerSide > 0 && depth > 0 && index > 1);
    FloorResult result;
    result.irradiance = Image(bins.countX, bins.countZ, 1);
    const DVec3 travel = -normalize(widened(toSun));
    if (travel.y >= 0) return result;  // the sun is below the horizon

    const WaveBounds bounds = waves.bounds();
    const Rectangle from = emissionOf(bins, bounds, travel, index, discHalfAngle, depth);
    const double rayCount = double(raysPerSide) * raysPerSide;
    // All rays in one bin do not wrap 63 bits; the step is then below 2^-30 of a ray for any count that ends.
    const double unit = std::exp2(std::floor(62 - std::log2(rayCount * (1.1 + bounds.slope))));
    std::vector<std::atomic<std::uint64_t>> sums(std::size_t(bins.countX) * std::size_t(bins.countZ));
    const double cellX = (from.maxX - from.minX) / raysPerSide, cellZ = (from.maxZ - from.minZ) / raysPerSide;

    const auto traceRay = [&](std::uint32_t column, std::uint32_t row, Totals& totals) {
        const Jitter jitter = jitterOf(column, row, seed);
        const double x = from.minX + (column + jitter.x) * cellX, z = from.minZ + (row + jitter.z) * cellZ;
        const DiscSample light = sampleDisc(travel, discHalfAngle, column, row, seed);
        const Entry entry = enterWater(waves.at(x, z), x, z, light.travel, index);
        const double fall = depth + entry.position.y;
        if (entry.incident <= 0 || entry.refracted.y >= 0 || fall <= 0) return;
        if (shadedByWaves(waves, bounds, entry.position, -light.travel, 1e30)) return;
        const double incident = entry.incident * light.weight, length = fall / -entry.refracted.y;
        const double entered = incident * entry.transmitted, landed = entered * std::exp(-attenuation * length);
        totals = totals + Totals{incident, incident - entered, entered - landed, landed};
        const int i = binOf(x + entry.refracted.x * length, bins.min.x, bins.max.x, bins.countX, bins.periodic);
        const int j = binOf(z + entry.refracted.z * length, bins.min.y, bins.max.y, bins.countZ, bins.periodic);
        if (i < 0 || j < 0) return;
        sums[std::size_t(j) * std::size_t(bins.countX) + std::size_t(i)].fetch_add(std::uint64_t(landed * unit + 0.5),
                                                                                   std::memory_order_relaxed);
    };
    const Totals totals = parallelReduce(
        std::size_t(raysPerSide), 4, Totals{},
        [&](std::size_t begin, std::size_t end) {
            Totals part;
            for (std::size_t row = begin; row < end; ++row)
                for (std::uint32_t column = 0; column < std::uint32_t(raysPerSide); ++column)
                    traceRay(column, std::uint32_t(row), part);
            return part;
        },
        [](const Totals& a, const Totals& b) { return a + b; });

    result.incoming = totals.incoming / rayCount;
    result.reflected = totals.reflected / rayCount;
    result.absorbed = totals.absorbed / rayCount;
    result.received = totals.received / rayCount;
    const Rectangle floor{bins.min.x, bins.min.y, bins.max.x, bins.max.y};
    const double binArea = floor.area() / (double(bins.countX) * bins.countZ);
    const double toIrradiance = from.area() / rayCount / unit / binArea;
    double binned = 0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double irradiance = double(sums[i].load(std::memory_order_relaxed)) * toIrradiance;
        result.irradiance.pixels[i] = float(irradiance);
        binned += irradiance;
    }
    // Where nothing leaves the bins, what they hold is what was received: the sum that the identities are tested on.
    if (bins.periodic) result.received = binned / double(sums.size());
    return result;
}

}  // namespace shoal::water
