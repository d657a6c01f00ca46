// Nodes, skins, cameras and punctual lights of glTF 2.0 (§3.5, §3.7.3, §3.10; KHR_lights_punctual).
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/gltf_parts.h"

namespace shoal::io {

namespace {

// Lumens a watt at 555 nm: candela to W/sr, lux to W/m2 (docs/conventions.md).
constexpr float kLuminousEfficacy = 683.0f;

struct Tree {
    std::vector<int> parents;  // of the file's nodes; -1 for none
    std::vector<std::vector<int>> children;
    std::vector<int> order;  // parents first
};

// Checks that every node has one parent at most and that there is no cycle, and orders the nodes.
Tree readTree(const JsonValue& nodes) {
    Tree tree;
    tree.parents.assign(nodes.size(), -1);
    tree.children.resize(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const JsonValue children = nodes[i].array("children");
        for (std::size_t c = 0; c < children.size(); ++c) {
            const int child = children[c].asIndex(nodes.size(), "node");
            int& parent = tree.parents[std::size_t(child)];
            if (parent >= 0)
                nodes[std::size_t(child)].fail(fmt::format("is a child of nodes[{}] and of nodes[{}]", parent, i));
            parent = int(i);
            tree.children[i].push_back(child);
        }
    }
    std::vector<int> pending;
    for (std::size_t i = nodes.size(); i-- > 0;)
        if (tree.parents[i] < 0) pending.push_back(int(i));
    std::vector<bool> reached(nodes.size(), false);
    while (!pending.empty()) {
        const int node = pending.back();
        pending.pop_back();
        reached[std::size_t(node)] = true;
        tree.order.push_back(node);
        const auto& children = tree.children[std::size_t(node)];
        pending.insert(pending.end(), children.rbegin(), children.rend());
    }
    // With one parent each, whatever no root leads to hangs from a cycle.
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!reached[i]) nodes[i].fail("is its own ancestor or hangs from one that is (a cycle in the node tree)");
    return tree;
}

// Which nodes the default scene shows; all of them where the file has no scenes.
std::vector<bool> readShown(const GltfDocument& document, const Tree& tree) {
    const JsonValue scenes = document.list("scenes");
    if (scenes.size() == 0) return std::vector<bool>(tree.parents.size(), true);
    std::vector<bool> shown(tree.parents.size(), false);
    const int scene = std::max(0, document.root().index("scene", scenes.size()));
    const JsonValue roots = scenes[std::size_t(scene)].array("nodes");
    for (std::size_t i = 0; i < roots.size(); ++i) shown[std::size_t(roots[i].asIndex(shown.size(), "node"))] = true;
    for (const int node : tree.order)
        if (const int parent = tree.parents[std::size_t(node)]; parent >= 0 && shown[std::size_t(parent)])
            shown[std::size_t(node)] = true;
    return shown;
}

// Splits a column-major matrix into T * R * S; a mirror goes into the sign of the x scale.
void decompose(const JsonValue& json, const std::array<float, 16>& m, Node& node) {
    double axis[3][3], scale[3];
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) axis[c][r] = double(m[std::size_t(c * 4 + r)]);
        scale[c] = std::sqrt(axis[c][0] * axis[c][0] + axis[c][1] * axis[c][1] + axis[c][2] * axis[c][2]);
        for (int r = 0; r < 3; ++r) axis[c][r] = scale[c] > 0 ? axis[c][r] / scale[c] : 0;
        if (scale[c] > 1e30) json.fail("matrix: a scale too large");
    }
    const auto crossInto = [&](int a, int b, int out) {
        for (int r = 0; r < 3; ++r)
            axis[out][r] = axis[a][(r + 1) % 3] * axis[b][(r + 2) % 3] - axis[a][(r + 2) % 3] * axis[b][(r + 1) % 3];
    };
    const int flat = int(scale[0] == 0) + int(scale[1] == 0) + int(scale[2] == 0);
    if (flat == 1) {  // a shadow or a decal pressed flat: its third axis follows from the other two
        const int f = scale[0] == 0 ? 0 : scale[1] == 0 ? 1 : 2;
        crossInto((f + 1) % 3, (f + 2) % 3, f);
    }
    double determinant = 0;
    for (int r = 0; r < 3; ++r)
        determinant +=
            axis[0][r] * (axis[1][(r + 1) % 3] * axis[2][(r + 2) % 3] - axis[1][(r + 2) % 3] * axis[2][(r + 1) % 3]);
    if (determinant < 0) {
        scale[0] = -scale[0];
        for (double& value : axis[0]) value = -value;
    }
    node.translation = {m[12], m[13], m[14]};
    node.scale = {float(scale[0]), float(scale[1]), float(scale[2])};
    if (flat > 1) return;  // no rotation can be told
    node.rotation = quatOfAxes(axis);
}

void readTransform(const JsonValue& json, Node& node) {
    if (json.find("matrix")) {
        decompose(json, json.reals<16>("matrix", {}), node);
        return;
    }
    const auto t = json.reals<3>("translation", {0, 0, 0}), s = json.reals<3>("scale", {1, 1, 1});
    const auto r = json.reals<4>("rotation", {0, 0, 0, 1});
    node.translation = {t[0], t[1], t[2]};
    node.scale = {s[0], s[1], s[2]};
    const double length =
        std::sqrt(double(r[0]) * r[0] + double(r[1]) * r[1] + double(r[2]) * r[2] + double(r[3]) * r[3]);
    if (!(length > 1e-12)) json.fail("rotation: a quaternion of length 0");
    node.rotation = {float(r[0] / length), float(r[1] / length), float(r[2] / length), float(r[3] / length)};
}

void readCamera(const JsonValue& json, Model& model) {
    ModelCamera camera;
    camera.name = json.text("name");
    const std::string& type = json.text("type");
    if (type == "perspective") {
        const JsonValue lens = json.object("perspective");
        camera.verticalFov = lens.real("yfov", 0);
        camera.nearZ = lens.real("znear", 0.1f);
        if (!(camera.verticalFov > 0 && camera.verticalFov < 3.1415f))
            json.fail(fmt::format("perspective.yfov {:g}, expected radians between 0 and pi", camera.verticalFov));
    } else if (type == "orthographic") {
        const JsonValue lens = json.object("orthographic");
        camera.orthographic = true;
        camera.heightM = 2 * std::abs(lens.real("ymag", 0));
        camera.nearZ = lens.real("znear", 0.1f);
        if (!(camera.heightM > 0)) json.fail("orthographic.ymag 0, expected more");
    } else {
        json.fail("type, expected \"perspective\" or \"orthographic\"");
    }
    if (!(camera.nearZ > 0)) camera.nearZ = camera.orthographic ? 0.0f : 0.1f;
    model.cameras.push_back(std::move(camera));
}

void readLight(const JsonValue& json, Model& model) {
    ModelLight light;
    light.name = json.text("name");
    const std::string& type = json.text("type");
    if (type == "directional")
        light.kind = ModelLight::Kind::directional;
    else if (type == "point")
        light.kind = ModelLight::Kind::point;
    else if (type == "spot")
        light.kind = ModelLight::Kind::spot;
    else
        json.fail("type, expected \"directional\", \"point\" or \"spot\"");
    const auto color = json.reals<3>("color", {1, 1, 1});
    const float intensity = json.real("intensity", 1);
    if (intensity < 0) json.fail(fmt::format("intensity {:g}, expected 0 or more", intensity));
    light.intensity = max(Vec3{color[0], color[1], color[2]} * (intensity / kLuminousEfficacy), {0, 0, 0});
    light.range = std::max(json.real("range", 0), 0.0f);
    const JsonValue spot = json.object("spot");
    light.outerCone = std::clamp(spot.real("outerConeAngle", kPi / 4), 1e-3f, kPi / 2);
    light.innerCone = std::clamp(spot.real("innerConeAngle", 0), 0.0f, light.outerCone);
    model.lights.push_back(std::move(light));
}

void readSkin(GltfDocument& document, const JsonValue& json, std::span<const int> placeOfNode, Model& model) {
    Skin skin;
    skin.name = json.text("name");
    json.require("joints");
    const JsonValue joints = json.array("joints");
    if (joints.size() == 0) json.fail("no joints");
    for (std::size_t i = 0; i < joints.size(); ++i)
        skin.joints.push_back(placeOfNode[std::size_t(joints[i].asIndex(placeOfNode.size(), "node"))]);
    skin.jointFromMesh.resize(skin.joints.size());
    if (const JsonValue where = json.find("inverseBindMatrices")) {
        const GltfAccessor accessor = document.accessor(where, "MAT4");
        if (accessor.count < skin.joints.size())
            where.fail(fmt::format("{} matrices, but there are {} joints", accessor.count, skin.joints.size()));
        const std::vector<Mat4> matrices = document.vectors<Mat4>(accessor);
        for (std::size_t i = 0; i < skin.joints.size(); ++i) {
            for (const float value : matrices[i].m)
                if (!(std::abs(value) <= 1e18f)) where.fail(fmt::format("matrix {} is not finite", i));
            skin.jointFromMesh[i] = matrices[i];
        }
    }
    model.skins.push_back(std::move(skin));
}

// The largest joint index that the mesh uses, and in which primitive; -1 for none.
struct LargestJoint {
    int joint = -1;
    std::size_t primitive = 0;
};
LargestJoint largestJoint(const ModelMesh& mesh) {
    LargestJoint largest;
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p)
        for (const U16Vec4 j : mesh.primitives[p].joints)
            if (const int joint = std::max({j.x, j.y, j.z, j.w}); joint > largest.joint) largest = {joint, p};
    return largest;
}

void readNodeContent(const JsonValue& json, const Model& model, const std::vector<LargestJoint>& largest, Node& node) {
    node.mesh = json.index("mesh", model.meshes.size());
    node.skin = json.index("skin", model.skins.size());
    node.camera = json.index("camera", model.cameras.size());
    node.light = json.object("extensions").object("KHR_lights_punctual").index("light", model.lights.size());
    if (node.mesh < 0) {
        node.skin = -1;
        return;
    }
    const auto mesh = std::size_t(node.mesh);
    if (node.skin >= 0) {
        const std::size_t jointCount = model.skins[std::size_t(node.skin)].joints.size();
        if (largest[mesh].joint >= int(jointCount))
            json.fail(fmt::format("skin {} has {} joints, but meshes[{}].primitives[{}] uses joint {}", node.skin,
                                  jointCount, mesh, largest[mesh].primitive, largest[mesh].joint));
    }
    if (const JsonValue weights = json.array("weights")) {
        const std::size_t targetCount = model.meshes[mesh].morphWeights.size();
        if (weights.size() != targetCount && !model.meshes[mesh].primitives.empty())
            weights.fail(
                fmt::format("{} weights, but meshes[{}] has {} morph targets", weights.size(), mesh, targetCount));
        for (std::size_t i = 0; i < targetCount; ++i) node.morphWeights.push_back(weights[i].asReal());
    }
}

}  // namespace

std::vector<int> readGltfNodes(GltfDocument& document, Model& model) {
    const JsonValue nodes = document.list("nodes"), skins = document.list("skins"), cameras = document.list("cameras");
    const JsonValue lights = document.root().object("extensions").object("KHR_lights_punctual").array("lights");
    const Tree tree = readTree(nodes);
    std::vector<int> placeOfNode(nodes.size(), -1);
    for (std::size_t i = 0; i < tree.order.size(); ++i) placeOfNode[std::size_t(tree.order[i])] = int(i);
    for (std::size_t i = 0; i < cameras.size(); ++i) readCamera(cameras[i], model);
    for (std::size_t i = 0; i < lights.size(); ++i) readLight(lights[i], model);
    for (std::size_t i = 0; i < skins.size(); ++i) readSkin(document, skins[i], placeOfNode, model);

    std::vector<LargestJoint> largest;
    for (const ModelMesh& mesh : model.meshes) largest.push_back(largestJoint(mesh));
    const std::vector<bool> shown = readShown(document, tree);
    for (const int fileNode : tree.order) {
        const JsonValue json = nodes[std::size_t(fileNode)];
        Node node;
        node.name = json.text("name");
        const int parent = tree.parents[std::size_t(fileNode)];
        node.parent = parent < 0 ? -1 : placeOfNode[std::size_t(parent)];
        readTransform(json, node);
        readNodeContent(json, model, largest, node);
        if (!shown[std::size_t(fileNode)]) {
            node.mesh = node.skin = node.camera = node.light = -1;
            node.morphWeights.clear();
        }
        model.nodes.push_back(std::move(node));
    }
    return placeOfNode;
}

}  // namespace shoal::io
