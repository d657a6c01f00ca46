// Meshes of glTF 2.0 (§3.7): attributes, indices, strips and fans, morph targets.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/gltf_parts.h"
#include "io/mesh_finish.h"

namespace shoal::io {

namespace {

// Larger coordinates overflow when squared; no file in metres or millimetres comes near.
constexpr float kCoordinateLimit = 1e18f;

constexpr std::size_t kModeTriangles = 4, kModeFan = 6;  // 5, the strip, is between

void checkPositions(const JsonValue& where, const std::vector<Vec3>& positions, const char* what) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3 p = positions[i];
        const bool good = std::abs(p.x) <= kCoordinateLimit && std::abs(p.y) <= kCoordinateLimit &&
                          std::abs(p.z) <= kCoordinateLimit;  // false for NaN
        if (!good)
            where.fail(fmt::format("{} {} is ({:g}, {:g}, {:g}), expected finite numbers", what, i, p.x, p.y, p.z));
    }
}

// An attribute of one vector a vertex; empty where the file has none.
template <class V>
std::vector<V> attribute(GltfDocument& document, const JsonValue& attributes, std::string_view name,
                         std::string_view type, std::size_t vertexCount) {
    const JsonValue where = attributes.find(name);
    if (!where) return {};
    const GltfAccessor accessor = document.accessor(where, type);
    if (vertexCount && accessor.count != vertexCount)
        where.fail(fmt::format("{} elements, but POSITION has {}", accessor.count, vertexCount));
    std::vector<V> out = document.vectors<V>(accessor);
    if (name != "POSITION")
        clearNonFinite({reinterpret_cast<float*>(out.data()), out.size() * sizeof(V) / sizeof(float)});
    return out;
}

std::vector<Vec4> readColors(GltfDocument& document, const JsonValue& attributes, std::size_t vertexCount) {
    const JsonValue where = attributes.find("COLOR_0");
    if (!where) return {};
    if (document.accessor(where, "VEC3|VEC4").componentCount == 4)
        return attribute<Vec4>(document, attributes, "COLOR_0", "VEC4", vertexCount);
    const std::vector<Vec3> opaque = attribute<Vec3>(document, attributes, "COLOR_0", "VEC3", vertexCount);
    std::vector<Vec4> out;
    out.reserve(opaque.size());
    for (const Vec3 c : opaque) out.push_back({c.x, c.y, c.z, 1});
    return out;
}

struct Influence {
    std::uint32_t joint = 0;
    float weight = 0;
};

// JOINTS_0, WEIGHTS_0 and further sets; of more than four influences the four strongest stay.
void readInfluences(GltfDocument& document, const JsonValue& attributes, Primitive& primitive) {
    const std::size_t vertexCount = primitive.vertexCount();
    std::vector<std::vector<std::uint32_t>> joints;
    std::vector<std::vector<Vec4>> weights;
    for (std::size_t set = 0; set < 4; ++set) {
        const std::string jointsName = fmt::format("JOINTS_{}", set), weightsName = fmt::format("WEIGHTS_{}", set);
        const JsonValue where = attributes.find(jointsName);
        if (!where && !attributes.find(weightsName)) break;
        if (!where) attributes.fail(fmt::format("{} without {}", weightsName, jointsName));
        if (!attributes.find(weightsName)) attributes.fail(fmt::format("{} without {}", jointsName, weightsName));
        const GltfAccessor accessor = document.accessor(where, "VEC4");
        if (accessor.count != vertexCount)
            where.fail(fmt::format("{} elements, but POSITION has {}", accessor.count, vertexCount));
        joints.push_back(document.wholes(where, accessor));
        for (const std::uint32_t joint : joints.back())
            if (joint > 0xFFFF) where.fail(fmt::format("joint {}, expected at most 65535", joint));
        weights.push_back(attribute<Vec4>(document, attributes, weightsName, "VEC4", vertexCount));
    }
    if (joints.empty()) return;
    primitive.joints.resize(vertexCount);
    if (joints.size() > 1) document.log(LogLevel::info, attributes.path() + ": the four strongest influences are kept");
    for (std::size_t v = 0; v < vertexCount; ++v) {
        std::vector<Influence> all;
        if (joints.size() > 1) {
            for (std::size_t set = 0; set < joints.size(); ++set) {
                const std::uint32_t* j = joints[set].data() + v * 4;
                const Vec4 w = weights[set][v];
                all.insert(all.end(), {{j[0], w.x}, {j[1], w.y}, {j[2], w.z}, {j[3], w.w}});
            }
            std::stable_sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.weight > b.weight; });
            for (std::size_t i = 0; i < 4; ++i) joints[0][v * 4 + i] = all[i].joint;
            weights[0][v] = {all[0].weight, all[1].weight, all[2].weight, all[3].weight};
        }
        const std::uint32_t* j = joints[0].data() + v * 4;
        primitive.joints[v] = {std::uint16_t(j[0]), std::uint16_t(j[1]), std::uint16_t(j[2]), std::uint16_t(j[3])};
    }
    primitive.weights = std::move(weights[0]);
}

void readMorphTargets(GltfDocument& document, const JsonValue& json, Primitive& primitive) {
    const JsonValue targets = json.array("targets");
    for (std::size_t t = 0; t < targets.size(); ++t) {
        Primitive::MorphTarget target;
        const std::size_t n = primitive.vertexCount();
        target.positions = attribute<Vec3>(document, targets[t], "POSITION", "VEC3", n);
        checkPositions(targets[t].find("POSITION"), target.positions, "offset");
        target.normals = attribute<Vec3>(document, targets[t], "NORMAL", "VEC3", n);
        target.tangents = attribute<Vec3>(document, targets[t], "TANGENT", "VEC3", n);
        primitive.morphTargets.push_back(std::move(target));
    }
}

// Triangle corners of a strip or fan; every other triangle of a strip is turned over (glTF 2.0 §3.7.2.1).
std::vector<std::uint32_t> unrolled(const std::vector<std::uint32_t>& corners, std::size_t mode) {
    std::vector<std::uint32_t> out;
    for (std::size_t i = 2; i < corners.size(); ++i) {
        if (mode == kModeFan)
            out.insert(out.end(), {corners[0], corners[i - 1], corners[i]});
        else if (i % 2 == 0)
            out.insert(out.end(), {corners[i - 2], corners[i - 1], corners[i]});
        else
            out.insert(out.end(), {corners[i - 1], corners[i - 2], corners[i]});
    }
    return out;
}

void readIndices(GltfDocument& document, const JsonValue& json, std::size_t mode, Primitive& primitive) {
    const std::size_t vertexCount = primitive.vertexCount();
    std::vector<std::uint32_t>& indices = primitive.indices;
    if (const JsonValue where = json.find("indices")) {
        indices = document.wholes(where, document.accessor(where, "SCALAR"));
        for (std::size_t i = 0; i < indices.size(); ++i)
            if (indices[i] >= vertexCount)
                where.fail(fmt::format("element {} is vertex {}, but there are only {}", i, indices[i], vertexCount));
    } else {
        document.charge(json, vertexCount * 4);
        indices.resize(vertexCount);
        for (std::size_t i = 0; i < vertexCount; ++i) indices[i] = std::uint32_t(i);
    }
    if (mode != kModeTriangles) {
        document.charge(json, indices.size() * 12);
        indices = unrolled(indices, mode);
    } else if (indices.size() % 3) {
        document.log(LogLevel::warning, fmt::format("{}: {} corners, the last {} make no triangle and are dropped",
                                                    json.path(), indices.size(), indices.size() % 3));
        indices.resize(indices.size() / 3 * 3);
    }
}

// Nothing to draw: false.
bool readPrimitive(GltfDocument& document, const JsonValue& json, const Model& model, Primitive& primitive) {
    const std::size_t mode = json.whole("mode", kModeTriangles);
    if (mode > kModeFan) json.fail(fmt::format("mode {}, expected 0 to 6", mode));
    if (mode < kModeTriangles) {
        document.log(LogLevel::warning,
                     fmt::format("{}: {} are not drawn", json.path(), mode == 0 ? "points" : "lines"));
        return false;
    }
    if (json.object("extensions").find("KHR_draco_mesh_compression") && !json.object("attributes").find("POSITION"))
        json.fail("compressed with KHR_draco_mesh_compression, which is not supported");
    json.require("attributes");
    const JsonValue attributes = json.object("attributes");
    if (!attributes.find("POSITION")) {
        document.log(LogLevel::warning, fmt::format("{}: has no POSITION and is not drawn", json.path()));
        return false;
    }
    primitive.material = json.index("material", model.materials.size());
    primitive.positions = attribute<Vec3>(document, attributes, "POSITION", "VEC3", 0);
    checkPositions(attributes.find("POSITION"), primitive.positions, "vertex");
    const std::size_t n = primitive.vertexCount();
    primitive.normals = attribute<Vec3>(document, attributes, "NORMAL", "VEC3", n);
    const bool normalMapped =
        primitive.material >= 0 && model.materials[std::size_t(primitive.material)].normalTexture.image >= 0;
    if (normalMapped) primitive.tangents = attribute<Vec4>(document, attributes, "TANGENT", "VEC4", n);
    primitive.uv0 = attribute<Vec2>(document, attributes, "TEXCOORD_0", "VEC2", n);
    primitive.uv1 = attribute<Vec2>(document, attributes, "TEXCOORD_1", "VEC2", n);
    primitive.colors = readColors(document, attributes, n);
    readInfluences(document, attributes, primitive);
    readMorphTargets(document, json, primitive);
    readIndices(document, json, mode, primitive);
    if (primitive.normals.empty()) document.charge(json, primitive.indices.size() * 128);  // vertices are doubled
    return true;
}

void readMesh(GltfDocument& document, const JsonValue& json, Model& model) {
    ModelMesh mesh;
    mesh.name = json.text("name");
    const JsonValue primitives = json.array("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) {
        Primitive primitive;
        if (!readPrimitive(document, primitives[i], model, primitive)) continue;
        const std::size_t targetCount = primitive.morphTargets.size();
        if (!mesh.primitives.empty() && mesh.primitives[0].morphTargets.size() != targetCount)
            primitives[i].fail(fmt::format("{} morph targets, but the mesh's first primitive has {}", targetCount,
                                           mesh.primitives[0].morphTargets.size()));
        const std::string repaired = finishPrimitive(
            primitive, primitive.material < 0 ? nullptr : &model.materials[std::size_t(primitive.material)]);
        if (!repaired.empty()) document.log(LogLevel::warning, fmt::format("{}: {}", primitives[i].path(), repaired));
        mesh.primitives.push_back(std::move(primitive));
    }
    const std::size_t targetCount = mesh.primitives.empty() ? 0 : mesh.primitives[0].morphTargets.size();
    mesh.morphWeights.assign(targetCount, 0.0f);
    if (const JsonValue weights = json.array("weights"); weights && !mesh.primitives.empty()) {
        if (weights.size() != targetCount)
            weights.fail(fmt::format("{} weights, but there are {} morph targets", weights.size(), targetCount));
        for (std::size_t i = 0; i < targetCount; ++i) mesh.morphWeights[i] = weights[i].asReal();
    }
    model.meshes.push_back(std::move(mesh));
}

}  // namespace

std::string finishPrimitive(Primitive& primitive, const Material* material) {
    std::string repaired;
    if (primitive.normals.empty()) {
        makeFlatNormals(primitive);
    } else if (const std::size_t count = repairNormals(primitive)) {
        repaired = fmt::format("{} normals of length 0 were replaced by the faces'", count);
    }
    if (!material || material->normalTexture.image < 0)
        primitive.tangents.clear();
    else if (primitive.tangents.empty())
        makeTangents(primitive, material->normalTexture.uvSet == 1);
    else
        repairTangents(primitive);
    if (const std::size_t count = repairWeights(primitive))
        repaired += fmt::format("{}{} vertices whose weights are all 0 follow their first joint",
                                repaired.empty() ? "" : "; ", count);
    computeBounds(primitive);
    return repaired;
}

void readGltfMeshes(GltfDocument& document, Model& model) {
    const JsonValue meshes = document.list("meshes");
    for (std::size_t i = 0; i < meshes.size(); ++i) readMesh(document, meshes[i], model);
}

}  // namespace shoal::io
