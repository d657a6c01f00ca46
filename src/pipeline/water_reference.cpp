// A scene's opaque triangles for the reference.
#include <shoal/core/pose.h>
#include <shoal/pipeline/water.h>

namespace shoal::pipeline {

namespace {

// What is opaque: the first surface that a picture's AOVs tell of. Cut-outs of masked materials are not cut out.
bool isOpaque(const Model& model, const Primitive& primitive) {
    if (primitive.material < 0) return true;
    const Material& material = model.materials[std::size_t(primitive.material)];
    return material.alphaMode != AlphaMode::blend && material.transmission <= 0;
}

void addTriangles(const scene::Instance& instance, const Model& model, float time, std::vector<Vec3>& triangles) {
    Pose pose;
    poseModel(model, instance.clip, instance.clip < 0 ? 0 : instance.startTime + instance.speed * time, instance.loop,
              pose);
    const Mat4 worldFromModel = scene::transformAt(instance, time);
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        const Node& node = model.nodes[n];
        if (node.mesh < 0 || matchesAny(instance.hide, node.name)) continue;
        for (const Primitive& primitive : model.meshes[std::size_t(node.mesh)].primitives) {
            if (!isOpaque(model, primitive)) continue;
            std::vector<Vec3> positions = posedPositions(model, pose, int(n), primitive);
            for (Vec3& p : positions) p = transformPoint(worldFromModel, p);
            for (const std::uint32_t index : primitive.indices) triangles.push_back(positions[index]);
        }
    }
}

}  // namespace

water::ReferenceScene referenceScene(const scene::Content& content, float time) {
    water::ReferenceScene scene;
    for (const scene::Instance& instance : content.instances)
        if (instance.visible)
            addTriangles(instance, content.models[std::size_t(instance.model)], time, scene.triangles);
    return scene;
}

}  // namespace shoal::pipeline
