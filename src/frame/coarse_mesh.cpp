#include "frame/coarse_mesh.h"

#include <unordered_map>

namespace shoal::frame {

CoarseMesh coarseMesh(std::span<const Vec3> positions, std::span<const Vec3> normals,
                      std::span<const std::uint32_t> indices, int cellCount) {
    CoarseMesh coarse;
    Bounds bounds;
    for (const Vec3& p : positions) bounds.add(p);
    const Vec3 size = bounds.size();
    const float cell = std::max({size.x, size.y, size.z}) / float(cellCount);
    if (!(cell > 0) || indices.size() < 3) return coarse;
    std::unordered_map<std::uint64_t, std::uint32_t> firstOf;
    firstOf.reserve(positions.size() / 2);
    std::vector<std::uint32_t> standIn(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3 p = (positions[i] - bounds.lo) / cell;
        std::uint64_t key = std::uint64_t(std::max(0.0f, p.x)) | std::uint64_t(std::max(0.0f, p.y)) << 16 |
                            std::uint64_t(std::max(0.0f, p.z)) << 32;
        if (i < normals.size()) {
            const Vec3 n = normals[i];
            key |= std::uint64_t((n.x > 0.1f) | (n.x < -0.1f) << 1 | (n.y > 0.1f) << 2 | (n.y < -0.1f) << 3 |
                                 (n.z > 0.1f) << 4 | (n.z < -0.1f) << 5)
                   << 48;
        }
        standIn[i] = firstOf.emplace(key, std::uint32_t(i)).first->second;
    }
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t a = standIn[indices[i]], b = standIn[indices[i + 1]], c = standIn[indices[i + 2]];
        if (a == b || b == c || c == a) continue;
        coarse.indices.insert(coarse.indices.end(), {a, b, c});
    }
    if (coarse.indices.empty() || 3 * coarse.indices.size() > 2 * indices.size()) return {};
    coarse.cell = cell;
    return coarse;
}

}  // namespace shoal::frame
