#include <shoal/core/model.h>
#include <algorithm>

namespace shoal {

bool matchesAny(std::span<const std::string> patterns, std::string_view name) {
    return std::any_of(patterns.begin(), patterns.end(), [&](std::string_view pattern) {
        return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1)) : name == pattern;
    });
}

ModelCounts count(const Model& model) {
    ModelCounts counts;
    std::vector<std::size_t> meshTriangles;
    for (const ModelMesh& mesh : model.meshes) {
        std::size_t triangles = 0;
        for (const Primitive& primitive : mesh.primitives) {
            triangles += primitive.triangleCount();
            counts.vertices += primitive.vertexCount();
            counts.morphTargetSlots += primitive.morphTargets.size();
        }
        counts.uniqueTriangles += triangles;
        meshTriangles.push_back(triangles);
    }
    for (const Node& node : model.nodes)
        if (node.mesh >= 0) counts.drawnTriangles += meshTriangles[std::size_t(node.mesh)];
    for (const Skin& skin : model.skins) counts.joints = std::max(counts.joints, skin.joints.size());
    return counts;
}

}  // namespace shoal
