// Fewer triangles on the same vertices, for drafts.
// [Rossignac, Borrel 1993] "Multi-resolution 3D approximations for rendering complex scenes": vertices of a cell of a
// grid become one. Here only indices change: a cell's first vertex stands for all of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <shoal/core/math.h>

namespace shoal::frame {

struct CoarseMesh {
    std::vector<std::uint32_t> indices;  // into the same vertices
    float cell = 0;                      // metres a vertex may be away from where it was, in the mesh's own space
};

// `cellCount` cells along the longest side of the mesh. Vertices that look elsewhere (normals of another octant) stay
// apart. Empty where that would leave more than two thirds of the triangles.
CoarseMesh coarseMesh(std::span<const Vec3> positions, std::span<const Vec3> normals,
                      std::span<const std::uint32_t> indices, int cellCount);

}  // namespace shoal::frame
