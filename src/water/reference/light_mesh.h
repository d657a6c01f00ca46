// All light of one direction (or one lamp) in the water, as a mesh of rays: at every depth a point lies in the images
// of some triangles of the mesh, and a triangle's light there is its flux over the area of its image. One triangle for
// each branch of the caustic: the mean over any region is right up to how straight the mesh is within a triangle.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "water/reference/emission.h"

namespace shoal::water {

class LightMesh {
public:
    // source: parallel ones as points (their disc is left out). triangles: cut the light in the air and in the water.
    LightMesh(const Body& body, const LightSource& source, const Triangles& triangles,
              const std::vector<EmissionCell>& cells, std::uint32_t seed);

    // What comes down at a point along one branch.
    struct Branch {
        DVec3 direction;        // unit
        double irradiance = 0;  // on a plane facing it, relative to color(), not dimmed
        double length = 0;      // metres in the water
    };
    // Calls use(branch) for each; depth below the level, at least 0.
    template <class Use>
    void gather(double x, double z, double depth, const Use& use) const;

    Vec3 color() const { return color_; }  // W/m2 (sun) or W/sr (lamp)

private:
    // A ray: at depth D it is at corner + a + D q.
    struct Ray {
        float ax = 0, az = 0, qx = 0, qz = 0;
        float flux = -1;   // W per m2 of the level plane over color; below 0: no ray
        float height = 0;  // of the surface where it enters
        float reach = 0;   // depth of the first triangle
    };
    struct Patch {
        double x = 0, z = 0;     // its corner in the world
        double area = 0;         // of a cell of rays, m2
        std::uint32_t side = 1;  // cells of rays a side
        std::size_t first = 0;   // of its (side + 1)^2 rays
    };
    // Bounds of a and q in world coordinates.
    struct Box {
        double minAx = 1e30, maxAx = -1e30, minAz = 1e30, maxAz = -1e30;
        double minQx = 1e30, maxQx = -1e30, minQz = 1e30, maxQz = -1e30;
        void add(const Box& o);
        bool mayHold(double x, double z, double depth) const {
            return x >= minAx + depth * minQx && x <= maxAx + depth * maxQx && z >= minAz + depth * minQz &&
                   z <= maxAz + depth * maxQz;
        }
    };
    struct Tile {
        std::uint32_t patch, column, row;
    };
    static constexpr std::uint32_t kTile = 4;    // cells of rays a side of a tile
    static constexpr std::size_t kChildren = 4;  // of a node of the tree

    void addPatch(const SurfaceLight& light, double level, const Triangles& triangles, const EmissionCell& cell,
                  Patch& patch, std::uint32_t seed);
    void buildTree();
    Box boxOf(const Tile& tile) const;
    template <class Use>
    void gatherTile(const Tile& tile, double x, double z, double depth, const Use& use) const;
    template <class Use>
    void gatherTriangle(const Patch& patch, const Ray& a, const Ray& b, const Ray& c, double x, double z, double depth,
                        const Use& use) const;

    Vec3 color_;
    std::vector<Patch> patches_;
    std::vector<Ray> rays_;
    std::vector<Tile> tiles_;               // near ones together
    std::vector<std::vector<Box>> levels_;  // of the tree; the first a box a tile
};

template <class Use>
void LightMesh::gatherTriangle(const Patch& patch, const Ray& a, const Ray& b, const Ray& c, double x, double z,
                               double depth, const Use& use) const {
    if (a.flux < 0 || b.flux < 0 || c.flux < 0) return;
    const double px = x - patch.x, pz = z - patch.z;
    const double ax = a.ax + depth * a.qx - px, az = a.az + depth * a.qz - pz;
    const double bx = b.ax + depth * b.qx - px, bz = b.az + depth * b.qz - pz;
    const double cx = c.ax + depth * c.qx - px, cz = c.az + depth * c.qz - pz;
    // Twice the areas that the point spans with each side; all of one sign inside, whichever way the image is turned.
    const double u = bx * cz - bz * cx, v = cx * az - cz * ax, w = ax * bz - az * bx, area = u + v + w;
    if (area > 0 ? (u < 0 || v < 0 || w < 0) : (u > 0 || v > 0 || w > 0)) return;
    if (std::abs(area) < 1e-18) return;
    const double ka = u / area, kb = v / area, kc = w / area;
    const double flux =
        ka * (depth < a.reach ? a.flux : 0) + kb * (depth < b.reach ? b.flux : 0) + kc * (depth < c.reach ? c.flux : 0);
    if (flux <= 0) return;
    const double qx = ka * a.qx + kb * b.qx + kc * c.qx, qz = ka * a.qz + kb * b.qz + kc * c.qz;
    const double slant = std::sqrt(1 + qx * qx + qz * qz);
    Branch branch;
    branch.direction = DVec3{qx, -1, qz} * (1 / slant);
    branch.irradiance = flux * patch.area / std::abs(area) * slant;
    branch.length = (depth + ka * a.height + kb * b.height + kc * c.height) * slant;
    if (branch.length > 0) use(branch);
}

template <class Use>
void LightMesh::gatherTile(const Tile& tile, double x, double z, double depth, const Use& use) const {
    const Patch& patch = patches_[tile.patch];
    const std::uint32_t columnEnd = std::min(tile.column + kTile, patch.side);
    const std::uint32_t rowEnd = std::min(tile.row + kTile, patch.side);
    for (std::uint32_t row = tile.row; row < rowEnd; ++row)
        for (std::uint32_t column = tile.column; column < columnEnd; ++column) {
            const Ray* low = &rays_[patch.first + std::size_t(row) * (patch.side + 1) + column];
            const Ray* high = low + patch.side + 1;
            gatherTriangle(patch, low[0], low[1], high[0], x, z, depth, use);
            gatherTriangle(patch, low[1], high[1], high[0], x, z, depth, use);
        }
}

template <class Use>
void LightMesh::gather(double x, double z, double depth, const Use& use) const {
    if (levels_.empty()) return;
    struct Node {
        std::size_t level, index;
    };
    Node stack[128];
    int count = 0;
    stack[count++] = {levels_.size() - 1, 0};
    while (count > 0) {
        const Node node = stack[--count];
        if (!levels_[node.level][node.index].mayHold(x, z, depth)) continue;
        if (node.level == 0) {
            gatherTile(tiles_[node.index], x, z, depth, use);
            continue;
        }
        const std::size_t end = std::min((node.index + 1) * kChildren, levels_[node.level - 1].size());
        for (std::size_t child = node.index * kChildren; child < end; ++child) stack[count++] = {node.level - 1, child};
    }
}

}  // namespace shoal::water
