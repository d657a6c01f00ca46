#include "water/reference/light_mesh.h"

#include <algorithm>

#include <shoal/core/parallel.h>

namespace shoal::water {

namespace {

float largest(DVec3 v) { return float(std::max({v.x, v.y, v.z})); }

// Bits of x and y in turn: points near each other have keys near each other.
std::uint64_t mortonKey(std::uint32_t x, std::uint32_t y) {
    const auto spread = [](std::uint64_t v) {
        v = (v | v << 16) & 0x0000ffff0000ffffu;
        v = (v | v << 8) & 0x00ff00ff00ff00ffu;
        v = (v | v << 4) & 0x0f0f0f0f0f0f0f0fu;
        v = (v | v << 2) & 0x3333333333333333u;
        return (v | v << 1) & 0x5555555555555555u;
    };
    return spread(x) | spread(y) << 1;
}

}  // namespace

void LightMesh::Box::add(const Box& o) {
    minAx = std::min(minAx, o.minAx), maxAx = std::max(maxAx, o.maxAx);
    minAz = std::min(minAz, o.minAz), maxAz = std::max(maxAz, o.maxAz);
    minQx = std::min(minQx, o.minQx), maxQx = std::max(maxQx, o.maxQx);
    minQz = std::min(minQz, o.minQz), maxQz = std::max(maxQz, o.maxQz);
}

LightMesh::LightMesh(const Body& body, const LightSource& source, const Triangles& triangles,
                     const std::vector<EmissionCell>& cells, std::uint32_t seed)
    : color_(source.lamp ? source.lamp->intensity : source.irradiance) {
    LightSource point = source;
    point.discHalfAngle = 0;
    const SurfaceLight light(body, point, triangles);
    std::size_t rayCount = 0;
    for (const EmissionCell& cell : cells) {
        Patch patch;
        patch.x = cell.x, patch.z = cell.z;
        patch.area = cell.rayArea();
        patch.side = cell.raysPerSide;
        patch.first = rayCount;
        rayCount += std::size_t(patch.side + 1) * (patch.side + 1);
        patches_.push_back(patch);
    }
    rays_.resize(rayCount);
    parallelFor(cells.size(), 1,
                [&](std::size_t i) { addPatch(light, body.params.level, triangles, cells[i], patches_[i], seed); });
    buildTree();
}

void LightMesh::addPatch(const SurfaceLight& light, double level, const Triangles& triangles, const EmissionCell& cell,
                         Patch& patch, std::uint32_t seed) {
    const double step = cell.size / patch.side;
    const float strongest = largest(widened(color_));
    for (std::uint32_t row = 0; row <= patch.side; ++row)
        for (std::uint32_t column = 0; column <= patch.side; ++column) {
            Ray& ray = rays_[patch.first + std::size_t(row) * (patch.side + 1) + column];
            const LitEntry entry = light.at(cell.x + column * step, cell.z + row * step, column, row, seed);
            if (entry.direction.y >= 0) continue;  // no light comes from there
            const double qx = entry.direction.x / -entry.direction.y, qz = entry.direction.z / -entry.direction.y;
            const double height = entry.position.y - level;
            ray.qx = float(qx), ray.qz = float(qz);
            ray.ax = float(entry.position.x - cell.x + height * qx);
            ray.az = float(entry.position.z - cell.z + height * qz);
            ray.flux = strongest > 0 ? largest(entry.flux) / strongest : 0;
            ray.height = float(height);
            ray.reach = 1e30f;
            if (ray.flux <= 0) continue;
            const auto hit = triangles.first(entry.position, entry.direction, leave(entry.position), 1e30);
            if (hit) ray.reach = float(hit->distance * -entry.direction.y - height);
        }
}

LightMesh::Box LightMesh::boxOf(const Tile& tile) const {
    const Patch& patch = patches_[tile.patch];
    Box box;
    for (std::uint32_t row = tile.row; row <= std::min(tile.row + kTile, patch.side); ++row)
        for (std::uint32_t column = tile.column; column <= std::min(tile.column + kTile, patch.side); ++column) {
            const Ray& ray = rays_[patch.first + std::size_t(row) * (patch.side + 1) + column];
            if (ray.flux < 0) continue;
            const double x = patch.x + ray.ax, z = patch.z + ray.az;
            box.add({x, x, z, z, ray.qx, ray.qx, ray.qz, ray.qz});
        }
    return box;
}

void LightMesh::buildTree() {
    if (patches_.empty()) return;
    double minX = 1e30, minZ = 1e30, maxSide = 0;
    for (const Patch& patch : patches_) minX = std::min(minX, patch.x), minZ = std::min(minZ, patch.z);
    for (const Patch& patch : patches_) maxSide = std::max({maxSide, patch.x - minX, patch.z - minZ}) + 1e-9;
    struct Keyed {
        std::uint64_t key;
        Tile tile;
    };
    std::vector<Keyed> keyed;
    for (std::uint32_t i = 0; i < patches_.size(); ++i) {
        const Patch& patch = patches_[i];
        const double step = std::sqrt(patch.area), scale = double(1u << 30) / (maxSide + step * patch.side);
        for (std::uint32_t row = 0; row < patch.side; row += kTile)
            for (std::uint32_t column = 0; column < patch.side; column += kTile)
                keyed.push_back({mortonKey(std::uint32_t((patch.x - minX + column * step) * scale),
                                           std::uint32_t((patch.z - minZ + row * step) * scale)),
                                 {i, column, row}});
    }
    std::stable_sort(keyed.begin(), keyed.end(), [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
    tiles_.reserve(keyed.size());
    for (const Keyed& k : keyed) tiles_.push_back(k.tile);
    levels_.emplace_back(tiles_.size());
    parallelFor(tiles_.size(), 1024, [&](std::size_t i) { levels_[0][i] = boxOf(tiles_[i]); });
    while (levels_.back().size() > 1) {
        const std::vector<Box>& below = levels_.back();
        std::vector<Box> level((below.size() + kChildren - 1) / kChildren);
        for (std::size_t i = 0; i < below.size(); ++i) level[i / kChildren].add(below[i]);
        levels_.push_back(std::move(level));
    }
}

}  // namespace shoal::water
