#include "io/model_axes.h"

#include <utility>

namespace shoal::io {

void applyAxes(Model& model, Quat metresFromFile, float scale) {
    if (metresFromFile == Quat{} && scale == 1) return;
    for (Node& node : model.nodes) ++node.parent;  // -1 becomes the new root, 0
    for (Skin& skin : model.skins)
        for (int& joint : skin.joints) ++joint;
    for (Clip& clip : model.clips)
        for (Channel& channel : clip.channels) ++channel.node;
    Node root;
    root.name = "axes and unit";
    root.rotation = metresFromFile;
    root.scale = {scale, scale, scale};
    model.nodes.insert(model.nodes.begin(), std::move(root));
    for (ModelCamera& camera : model.cameras) {
        camera.nearZ *= scale;
        camera.heightM *= scale;
    }
    for (ModelLight& light : model.lights) light.range *= scale;
}

void flipWinding(Model& model) {
    for (ModelMesh& mesh : model.meshes)
        for (Primitive& primitive : mesh.primitives) {
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3)
                std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
            for (Vec3& n : primitive.normals) n = -n;
            for (Vec4& t : primitive.tangents) t.w = -t.w;
            for (auto& target : primitive.morphTargets)
                for (Vec3& n : target.normals) n = -n;
        }
}

}  // namespace shoal::io
