#include "scene/shapes/builder.h"

#include <shoal/core/assert.h>

namespace shoal::scene::shapes {

Frame Frame::turned(float yaw) const {
    const float c = std::cos(yaw), s = std::sin(yaw);
    return {origin, x * c - z * s, y, z * c + x * s};
}

Frame Frame::tipped(Vec3 axis, float angle) const {
    const Quat q = axisAngle(direction(axis), angle);
    return {origin, rotate(q, x), rotate(q, y), rotate(q, z)};
}

std::uint32_t Part::add(const Corner& corner) {
    primitive_.positions.push_back(corner.position);
    primitive_.normals.push_back(corner.normal);
    primitive_.tangents.push_back({corner.tangent.x, corner.tangent.y, corner.tangent.z, 1});
    primitive_.uv0.push_back(corner.uv);
    primitive_.colors.push_back({color.x, color.y, color.z, 1});
    return std::uint32_t(primitive_.positions.size() - 1);
}

void Part::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, Vec3 facing) {
    const std::vector<Vec3>& p = primitive_.positions;
    if (dot(cross(p[b] - p[a], p[c] - p[a]), facing) < 0) std::swap(b, c);
    primitive_.indices.insert(primitive_.indices.end(), {a, b, c});
}

void Part::quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, Vec3 facing) {
    triangle(a, b, c, facing);
    triangle(a, c, d, facing);
}

Primitive Part::finish(bool withTangents) {
    Primitive& p = primitive_;
    for (std::size_t i = 0; i < p.positions.size(); ++i) {
        p.bounds.add(p.positions[i]);
        const Vec3 n = normalize(p.normals[i]);
        p.normals[i] = n;
        Vec3 t{p.tangents[i].x, p.tangents[i].y, p.tangents[i].z};
        t = t - n * dot(n, t);
        if (length(t) < 1e-6f) t = std::abs(n.x) < 0.7f ? cross(n, Vec3{1, 0, 0}) : cross(n, Vec3{0, 1, 0});
        t = normalize(t);
        p.tangents[i] = {t.x, t.y, t.z, 1};
    }
    if (!withTangents) p.tangents.clear();
    return std::move(p);
}

ModelBuilder::ModelBuilder(std::string name) { model_.name = std::move(name); }

void ModelBuilder::beginNode(const std::string& name, Vec3 at, Quat turned, float scale) {
    Node node;
    node.name = name;
    node.translation = at;
    node.rotation = turned;
    node.scale = {scale, scale, scale};
    node.mesh = int(model_.meshes.size());
    model_.nodes.push_back(node);
    ModelMesh mesh;
    mesh.name = name;
    model_.meshes.push_back(mesh);
}

void ModelBuilder::addInstance(const std::string& name, std::size_t ofNode, Vec3 at, Quat turned, float scale) {
    Node node;
    node.name = name;
    node.translation = at;
    node.rotation = turned;
    node.scale = {scale, scale, scale};
    node.mesh = model_.nodes[ofNode].mesh;
    model_.nodes.push_back(node);
}

int ModelBuilder::addMaterial(const std::string& name, Vec3 color, float roughness, float metallic) {
    Material m;
    m.name = name;
    m.baseColor = {color.x, color.y, color.z, 1};
    m.roughness = roughness;
    m.metallic = metallic;
    model_.materials.push_back(m);
    uvPerMetre_.push_back(1);
    return int(model_.materials.size()) - 1;
}

int ModelBuilder::addMaterial(const std::string& name, Vec3 color, Surface surface) {
    const int index = addMaterial(name, color, 1);
    const int firstImage = int(model_.images.size());
    model_.images.push_back(std::move(surface.color));
    model_.images.push_back(std::move(surface.normal));
    model_.images.push_back(std::move(surface.roughness));
    Material& m = material(index);
    m.baseColorTexture.image = firstImage;
    m.normalTexture.image = firstImage + 1;
    m.metallicRoughnessTexture.image = firstImage + 2;
    uvPerMetre_.back() = 1 / surface.metres;
    return index;
}

Part& ModelBuilder::part(int material) {
    if (model_.nodes.empty()) beginNode(model_.name);
    const std::size_t mesh = model_.meshes.size() - 1;
    for (Piece& piece : pieces_)
        if (piece.mesh == mesh && piece.material == material) return piece.part;
    pieces_.push_back({mesh, material, Part(material, uvPerMetre_[std::size_t(material)])});
    return pieces_.back().part;
}

Model ModelBuilder::finish() {
    for (Piece& piece : pieces_) {
        if (piece.part.empty()) continue;
        const bool mapped = material(piece.material).normalTexture.image >= 0;
        model_.meshes[piece.mesh].primitives.push_back(piece.part.finish(mapped));
    }
    // A node that got no geometry (no crates wanted) keeps its name, but has no mesh to draw.
    std::vector<ModelMesh> meshes;
    std::vector<int> newIndex;
    for (ModelMesh& mesh : model_.meshes) {
        newIndex.push_back(mesh.primitives.empty() ? -1 : int(meshes.size()));
        if (!mesh.primitives.empty()) meshes.push_back(std::move(mesh));
    }
    for (Node& node : model_.nodes) node.mesh = newIndex[std::size_t(node.mesh)];
    model_.meshes = std::move(meshes);
    return std::move(model_);
}

}  // namespace shoal::scene::shapes
