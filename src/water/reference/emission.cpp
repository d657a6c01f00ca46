#include "water/reference/emission.h"

#include <algorithm>
#include <cmath>

namespace shoal::water {

namespace {

constexpr double kMostCellsPerSide = 256, kRaysPerCell = 64;

struct Rectangle {
    double minX = 1e30, minZ = 1e30, maxX = -1e30, maxZ = -1e30;
    bool empty() const { return !(minX < maxX && minZ < maxZ); }
    void add(const Rectangle& o) {
        minX = std::min(minX, o.minX), maxX = std::max(maxX, o.maxX);
        minZ = std::min(minZ, o.minZ), maxZ = std::max(maxZ, o.maxZ);
    }
};

// Where light of the sun enters that reaches a box whose depths lie between `shallow` and `deep`: each ray falls that
// much and up to a wave's height more or less.
Rectangle entryOfParallel(const SeenBox& box, const DriftRange& drift, double shallow, double deep) {
    return {box.lo.x - std::max(shallow * drift.maxX, deep * drift.maxX),
            box.lo.z - std::max(shallow * drift.maxZ, deep * drift.maxZ),
            box.hi.x - std::min(shallow * drift.minX, deep * drift.minX),
            box.hi.z - std::min(shallow * drift.minZ, deep * drift.minZ)};
}

// Where light of a lamp `height` metres above level water crosses it on its way to a point `depth` below and `across`
// metres aside: by bisection on Snell's law.
double crossing(double height, double depth, double across, double index) {
    double low = 0, high = across;
    for (int i = 0; i < 60; ++i) {
        const double at = 0.5 * (low + high);
        const double inAir = at / std::hypot(at, height), inWater = (across - at) / std::hypot(across - at, depth);
        (inAir < index * inWater ? low : high) = at;
    }
    return 0.5 * (low + high);
}

// What waves change of a lamp's light: metres aside per metre of descent at most, over all incidences, and the drift
// itself. A lamp's map of entry to landing spreads, so the entry is no farther off than the landing.
struct LampDrift {
    double change = 0, most = 0;
};
LampDrift lampDrift(double index, double slope) {
    LampDrift drift;
    for (double degrees = 0; degrees <= 88; degrees += 4) {
        const double angle = degrees * kPiD / 180;
        const DVec3 travel{std::sin(angle), -std::cos(angle), 0};
        const DriftRange range = driftRange(travel, index, slope, 0);
        const double level = std::tan(std::asin(std::sin(angle) / index));
        drift.change = std::max({drift.change, range.maxX - level, level - range.minX, range.maxZ, -range.minZ});
        drift.most = std::max({drift.most, range.maxX, -range.minX, range.maxZ, -range.minZ});
    }
    return drift;
}

Rectangle entryOfLamp(const SeenBox& box, const LightSource& source, double level, double index, double waveHeight,
                      const LampDrift& drift) {
    const Vec3 lamp = source.lamp->position;
    const double height = std::max(1e-3, lamp.y - level);
    Rectangle entry;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                     corner & 4 ? box.hi.z : box.lo.z};
        const double depth = std::max(1e-3, level - p.y), dx = p.x - lamp.x, dz = p.z - lamp.z;
        const double across = std::hypot(dx, dz);
        const double share = across > 1e-9 ? crossing(height, depth, across, index) / across : 0;
        const double margin = (depth + waveHeight) * drift.change + 2 * waveHeight * drift.most;
        const double x = lamp.x + dx * share, z = lamp.z + dz * share;
        entry.add({x - margin, z - margin, x + margin, z + margin});
    }
    return entry;
}

// Sums over rectangles of cells by their corners: O(1) a rectangle.
class CellSums {
public:
    CellSums(int width, int height)
        : width_(width), height_(height), corners_(std::size_t(width + 1) * std::size_t(height + 1)) {}
    void add(int x0, int z0, int x1, int z1, double value) {  // ends included
        corner(x0, z0) += value, corner(x1 + 1, z0) -= value;
        corner(x0, z1 + 1) -= value, corner(x1 + 1, z1 + 1) += value;
    }
    void finish() {
        for (int z = 0; z <= height_; ++z)
            for (int x = 1; x <= width_; ++x) corner(x, z) += corner(x - 1, z);
        for (int z = 1; z <= height_; ++z)
            for (int x = 0; x <= width_; ++x) corner(x, z) += corner(x, z - 1);
    }
    double& corner(int x, int z) { return corners_[std::size_t(z) * std::size_t(width_ + 1) + std::size_t(x)]; }

private:
    int width_, height_;
    std::vector<double> corners_;
};

std::vector<Rectangle> entryRectangles(const Body& body, const LightSource& source, std::span<const SeenBox> seen) {
    const double level = body.params.level, waveHeight = body.waves->bounds().height, index = body.optics.index;
    Vec2 lo{1e30f, 1e30f}, hi{-1e30f, -1e30f};
    for (const SeenBox& box : seen) {
        lo = {std::min(lo.x, box.lo.x), std::min(lo.y, box.lo.z)};
        hi = {std::max(hi.x, box.hi.x), std::max(hi.y, box.hi.z)};
    }
    const double slope = greatestSlope(*body.waves, lo, hi);
    DriftRange parallel;
    LampDrift lamp;
    if (source.lamp)
        lamp = lampDrift(index, slope);
    else
        parallel = driftRange(source.travel, index, slope, source.discHalfAngle);
    std::vector<Rectangle> entries;
    entries.reserve(seen.size());
    for (const SeenBox& box : seen) {
        const double shallow = std::max(0.0, level - box.hi.y - waveHeight), deep = level - box.lo.y + waveHeight;
        Rectangle entry;
        if (deep >= 0)
            entry = source.lamp ? entryOfLamp(box, source, level, index, waveHeight, lamp)
                                : entryOfParallel(box, parallel, shallow, deep);
        // A point's light may all come through one point (level water): give it some width.
        const double widen = 1e-3 + 1e-3 * deep;
        entry.minX = std::max(entry.minX - widen, double(body.params.areaMin.x));
        entry.minZ = std::max(entry.minZ - widen, double(body.params.areaMin.y));
        entry.maxX = std::min(entry.maxX + widen, double(body.params.areaMax.x));
        entry.maxZ = std::min(entry.maxZ + widen, double(body.params.areaMax.y));
        entries.push_back(entry);
    }
    return entries;
}

}  // namespace

std::vector<EmissionCell> emissionCells(const Body& body, const LightSource& source, std::span<const SeenBox> seen,
                                        std::int64_t rays) {
    if (seen.empty() || rays <= 0) return {};
    const std::vector<Rectangle> entries = entryRectangles(body, source, seen);
    Rectangle all;
    for (const Rectangle& entry : entries)
        if (!entry.empty()) all.add(entry);
    if (all.empty()) return {};
    const double cellsPerSide = std::clamp(std::floor(std::sqrt(double(rays) / kRaysPerCell)), 8.0, kMostCellsPerSide);
    const double size = std::max(all.maxX - all.minX, all.maxZ - all.minZ) / cellsPerSide;
    const auto cellOf = [&](double offset, int count) {
        return std::clamp(int(std::floor(offset / size)), 0, count - 1);
    };
    const int width = std::max(1, int(std::ceil((all.maxX - all.minX) / size - 1e-9)));
    const int height = std::max(1, int(std::ceil((all.maxZ - all.minZ) / size - 1e-9)));
    // Counts apart from weights: what rounding leaves of a weight is no cell.
    CellSums weights(width, height), counts(width, height);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const Rectangle& entry = entries[i];
        if (entry.empty()) continue;
        const int x0 = cellOf(entry.minX - all.minX, width), x1 = cellOf(entry.maxX - all.minX, width);
        const int z0 = cellOf(entry.minZ - all.minZ, height), z1 = cellOf(entry.maxZ - all.minZ, height);
        weights.add(x0, z0, x1, z1, double(seen[i].weight) / (double(x1 - x0 + 1) * (z1 - z0 + 1)));
        counts.add(x0, z0, x1, z1, 1);
    }
    weights.finish(), counts.finish();
    double total = 0, taken = 0;
    for (int z = 0; z < height; ++z)
        for (int x = 0; x < width; ++x)
            if (counts.corner(x, z) > 0.5) total += std::max(0.0, weights.corner(x, z)), ++taken;
    std::vector<EmissionCell> cells;
    for (int z = 0; z < height; ++z)
        for (int x = 0; x < width; ++x) {
            if (counts.corner(x, z) <= 0.5) continue;
            const double share = 0.1 / taken + (total > 0 ? 0.9 * std::max(0.0, weights.corner(x, z)) / total : 0);
            const double side = std::ceil(std::sqrt(double(rays) * share));
            cells.push_back({all.minX + x * size, all.minZ + z * size, size, std::uint32_t(std::max(1.0, side))});
        }
    return cells;
}

}  // namespace shoal::water
