#include "frame/gpu_model.h"

#include <cmath>
#include <cstring>
#include <string>

#include <shoal/core/parallel.h>

#include "frame/coarse_mesh.h"
#include "frame/glsl_math.h"

namespace shoal::frame {
namespace {

constexpr std::size_t kLargestBuffer = std::size_t(1) << 31;  // bytes of one vertex stream
constexpr std::size_t kVerticesPerTask = 8192;

std::uint32_t snorm(float x, int bits) {
    const float largest = float((1 << (bits - 1)) - 1);
    const std::int32_t i = std::int32_t(std::lround(std::min(std::max(x, -1.0f), 1.0f) * largest));
    return std::uint32_t(i) & ((1u << bits) - 1);
}

std::uint32_t unorm8(float x) { return std::uint32_t(std::lround(std::min(std::max(x, 0.0f), 1.0f) * 255)); }

std::uint32_t packColor(Vec4 c) {
    return unorm8(std::sqrt(std::max(c.x, 0.0f))) | unorm8(std::sqrt(std::max(c.y, 0.0f))) << 8 |
           unorm8(std::sqrt(std::max(c.z, 0.0f))) << 16 | unorm8(c.w) << 24;
}

struct Packed {
    std::vector<Vec3> positions;
    std::vector<PackedFrame> frames;
    std::vector<PackedAttribute> attributes;
    std::vector<Vec2> uv1;
    std::vector<std::uint32_t> indices;
    std::vector<PackedInfluence> influences;
    std::vector<MorphOffset> morphs;
};

void packVertices(const Primitive& p, std::size_t first, Packed& to) {
    parallelFor(p.vertexCount(), kVerticesPerTask, [&](std::size_t i) {
        const Vec4 tangent = p.tangents.empty() ? Vec4{1, 0, 0, 1} : p.tangents[i];
        const Vec3 normal = p.normals.empty() ? Vec3{0, 1, 0} : p.normals[i];
        to.positions[first + i] = p.positions[i];
        to.frames[first + i] = packFrame(normal, tangent);
        to.attributes[first + i] = {p.uv0.empty() ? Vec2{} : p.uv0[i], p.colors.empty() ? ~0u : packColor(p.colors[i])};
        if (!to.uv1.empty()) to.uv1[first + i] = p.uv1.empty() ? Vec2{} : p.uv1[i];
    });
}

std::vector<JointBox> jointBoxes(const Primitive& p) {
    std::vector<Bounds> boxes;
    for (std::size_t i = 0; i < p.vertexCount(); ++i) {
        const std::uint16_t joints[4] = {p.joints[i].x, p.joints[i].y, p.joints[i].z, p.joints[i].w};
        const float weights[4] = {p.weights[i].x, p.weights[i].y, p.weights[i].z, p.weights[i].w};
        for (int k = 0; k < 4; ++k) {
            if (weights[k] <= 0) continue;
            if (boxes.size() <= joints[k]) boxes.resize(std::size_t(joints[k]) + 1);
            boxes[joints[k]].add(p.positions[i]);
        }
    }
    std::vector<JointBox> used;
    for (std::size_t j = 0; j < boxes.size(); ++j)
        if (!boxes[j].empty()) used.push_back({int(j), boxes[j]});
    return used;
}

void packMorphs(const Primitive& p, GpuPrimitive& gpu, Packed& to) {
    for (const Primitive::MorphTarget& target : p.morphTargets) {
        Bounds reach;
        for (std::size_t i = 0; i < p.vertexCount(); ++i) {
            MorphOffset offset;
            if (!target.positions.empty()) offset.position = target.positions[i];
            if (!target.normals.empty()) offset.normal = target.normals[i];
            to.morphs.push_back(offset);
            reach.add(offset.position);
        }
        gpu.morphReach.push_back(reach);
    }
}

// Cells along a mesh: one is a pixel or two where a draft takes it.
constexpr int kCoarseCells = 14;
constexpr std::size_t kLeastCoarse = 3 * 48;  // indices

void packCoarse(const Primitive& p, GpuPrimitive& gpu, Packed& to) {
    if (p.indices.size() < kLeastCoarse) return;
    const CoarseMesh coarse = coarseMesh(p.positions, p.normals, p.indices, kCoarseCells);
    gpu.firstCoarse = std::uint32_t(to.indices.size());
    gpu.coarseCount = std::uint32_t(coarse.indices.size());
    gpu.coarseCell = coarse.cell;
    to.indices.insert(to.indices.end(), coarse.indices.begin(), coarse.indices.end());
}

GpuPrimitive packPrimitive(const Primitive& p, std::size_t first, bool wantsCoarse, Packed& to) {
    GpuPrimitive gpu;
    gpu.firstVertex = std::uint32_t(first);
    gpu.vertexCount = std::uint32_t(p.vertexCount());
    gpu.firstIndex = std::uint32_t(to.indices.size());
    gpu.indexCount = std::uint32_t(p.indices.size());
    to.indices.insert(to.indices.end(), p.indices.begin(), p.indices.end());
    if (wantsCoarse) packCoarse(p, gpu, to);
    packVertices(p, first, to);
    for (const Vec3& v : p.positions) gpu.bounds.add(v);
    gpu.skinned = !p.joints.empty() && !p.weights.empty();
    if (gpu.skinned) {
        gpu.firstInfluence = std::uint32_t(to.influences.size());
        for (std::size_t i = 0; i < p.vertexCount(); ++i)
            to.influences.push_back(packInfluence(p.joints[i], p.weights[i]));
        gpu.jointBoxes = jointBoxes(p);
    }
    gpu.firstMorph = std::uint32_t(to.morphs.size());
    gpu.morphCount = std::uint32_t(p.morphTargets.size());
    packMorphs(p, gpu, to);
    return gpu;
}

// What poseModel reads of a model.
Model skeletonOf(const Model& model) {
    Model s;
    s.name = model.name;
    s.nodes = model.nodes;
    s.skins = model.skins;
    s.clips = model.clips;
    s.meshes.resize(model.meshes.size());
    for (std::size_t m = 0; m < model.meshes.size(); ++m) {
        s.meshes[m].name = model.meshes[m].name;
        s.meshes[m].morphWeights = model.meshes[m].morphWeights;
        for (const Primitive& p : model.meshes[m].primitives) {
            Primitive bare;
            bare.morphTargets.resize(p.morphTargets.size());
            s.meshes[m].primitives.push_back(std::move(bare));
        }
    }
    return s;
}

Result<void> checkSize(const char* what, std::size_t used, std::size_t added, const std::string& name) {
    if (used + added <= kLargestBuffer) return {};
    return badInput(name + ": " + std::to_string(used + added) + " bytes of " + what +
                    " with the models before it, expected at most " + std::to_string(kLargestBuffer));
}

template <class T>
std::size_t bytesOf(const std::vector<T>& v) {
    return v.size() * sizeof(T);
}

template <class T>
Result<std::uint32_t> appendAll(gl::Device& device, GrowBuffer& buffer, const std::vector<T>& data) {
    SHOAL_TRY_ASSIGN(const std::size_t offset, buffer.append(device, std::as_bytes(std::span(data))));
    return std::uint32_t(offset / sizeof(T));
}

}  // namespace

Shell shellOf(const ModelMesh& mesh) {
    Bounds bounds;
    for (const Primitive& p : mesh.primitives)
        for (const Vec3& v : p.positions) bounds.add(v);
    const Vec3 center = (bounds.lo + bounds.hi) * 0.5f;
    Shell shell;
    for (const Primitive& p : mesh.primitives)
        for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
            const Vec3 a = p.positions[p.indices[i]] - center, b = p.positions[p.indices[i + 1]] - center,
                       c = p.positions[p.indices[i + 2]] - center;
            const Vec3 area = cross(b - a, c - a) * 0.5f;
            shell.area += area;
            shell.total += length(area);
            shell.volume += double(dot(area, a)) / 3;
        }
    return shell;
}

bool shadowsByFrontFaces(const Shell& shell, const Mat4& worldFromModel) {
    constexpr float kOpenAside = 0.06f, kOpenBelow = 0.35f;  // shares of the surface that may be missing
    if (!(shell.volume > 0)) return false;
    const Mat3 m = normalMatrix(worldFromModel);
    const Vec3 a = shell.area;
    const Vec3 world{m.m[0] * a.x + m.m[3] * a.y + m.m[6] * a.z, m.m[1] * a.x + m.m[4] * a.y + m.m[7] * a.z,
                     m.m[2] * a.x + m.m[5] * a.y + m.m[8] * a.z};
    const float scale = std::cbrt(std::abs(determinant3(worldFromModel)));
    const float total = shell.total * scale * scale;
    return std::hypot(world.x, world.z) < kOpenAside * total && world.y > -kOpenAside * total &&
           world.y < kOpenBelow * total;
}

PackedFrame packFrame(Vec3 normal, Vec4 tangent) {
    const glsl::vec2 e =
        dot(normal, normal) > 0 ? glsl::octahedralFromNormal({normal.x, normal.y, normal.z}) : glsl::vec2(0, 0);
    return {snorm(e.x, 16) | snorm(e.y, 16) << 16, snorm(tangent.x, 10) | snorm(tangent.y, 10) << 10 |
                                                       snorm(tangent.z, 10) << 20 | (tangent.w < 0 ? 3u : 1u) << 30};
}

PackedInfluence packInfluence(U16Vec4 joints, Vec4 weights) {
    const float w[4] = {weights.x, weights.y, weights.z, weights.w};
    std::uint32_t q[4];
    std::uint32_t sum = 0;
    int heaviest = 0;
    for (int k = 0; k < 4; ++k) {
        q[k] = std::uint32_t(std::lround(std::min(std::max(w[k], 0.0f), 1.0f) * 65535));
        sum += q[k];
        if (q[k] > q[heaviest]) heaviest = k;
    }
    q[heaviest] = std::min(q[heaviest] + 65535u - std::min(sum, 65535u + q[heaviest]), 65535u);
    return {std::uint32_t(joints.x) | std::uint32_t(joints.y) << 16,
            std::uint32_t(joints.z) | std::uint32_t(joints.w) << 16, q[0] | q[1] << 16, q[2] | q[3] << 16};
}

Result<GpuModel> MeshStore::add(gl::Device& device, const Model& model, int firstMaterial,
                                const MaterialStore& materials) {
    std::size_t total = 0;
    bool needsUv1 = hasUv1;
    for (const ModelMesh& mesh : model.meshes)
        for (const Primitive& p : mesh.primitives) {
            total += p.vertexCount();
            needsUv1 |= p.material >= 0 && materials.at(firstMaterial + p.material).usesUv1;
        }
    SHOAL_TRY(checkSize("vertices", positions.used(), total * sizeof(Vec3), model.name));

    Packed packed;
    packed.positions.resize(total), packed.frames.resize(total), packed.attributes.resize(total);
    if (needsUv1) packed.uv1.resize(total);
    GpuModel gpu;
    gpu.skeleton = skeletonOf(model);
    std::size_t next = 0;
    for (const ModelMesh& mesh : model.meshes) {
        std::vector<GpuPrimitive>& primitives = gpu.meshes.emplace_back();
        const Shell shell = shellOf(mesh);
        for (const Primitive& p : mesh.primitives) {
            primitives.push_back(packPrimitive(p, next, wantsCoarse, packed));
            primitives.back().shell = shell;
            primitives.back().material = p.material < 0 ? 0 : firstMaterial + p.material;
            next += p.vertexCount();
        }
    }
    SHOAL_TRY(checkSize("indices", indices.used(), bytesOf(packed.indices), model.name));
    SHOAL_TRY(checkSize("morph offsets", morphs.used(), bytesOf(packed.morphs), model.name));

    if (needsUv1 && !hasUv1) {
        const std::vector<Vec2> before(vertexCount());  // models before this one use none
        SHOAL_TRY(appendAll(device, uv1, before));
        hasUv1 = true;
    }
    SHOAL_TRY_ASSIGN(const std::uint32_t firstVertex, appendAll(device, positions, packed.positions));
    SHOAL_TRY(appendAll(device, frames, packed.frames));
    SHOAL_TRY(appendAll(device, attributes, packed.attributes));
    SHOAL_TRY(appendAll(device, uv1, packed.uv1));
    SHOAL_TRY_ASSIGN(const std::uint32_t firstIndex, appendAll(device, indices, packed.indices));
    SHOAL_TRY_ASSIGN(const std::uint32_t firstInfluence, appendAll(device, influences, packed.influences));
    SHOAL_TRY_ASSIGN(const std::uint32_t firstMorph, appendAll(device, morphs, packed.morphs));
    for (std::vector<GpuPrimitive>& primitives : gpu.meshes)
        for (GpuPrimitive& p : primitives)
            p.firstVertex += firstVertex, p.firstIndex += firstIndex, p.firstCoarse += firstIndex,
                p.firstInfluence += firstInfluence, p.firstMorph += firstMorph;
    return gpu;
}

void MeshStore::clear() {
    for (GrowBuffer* b : {&positions, &frames, &attributes, &uv1, &indices, &influences, &morphs}) b->clear();
    hasUv1 = false;
}

}  // namespace shoal::frame
