#include <shoal/core/model.h>
#include <algorithm>

namespace shoal {

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
