// Meshes on the GPU: packed vertices of all models in shared buffers, and what posing them needs.
#pragma once

#include <cstdint>
#include <vector>

#include <shoal/core/model.h>
#include <shoal/core/pose.h>
#include <shoal/core/result.h>

#include "frame/gpu_material.h"
#include "frame/grow_buffer.h"

namespace shoal::frame {

// Vertex streams beside the positions (3 floats).
struct PackedFrame {
    std::uint32_t normal;   // octahedral, snorm16 x 2
    std::uint32_t tangent;  // snorm10 x 3, handedness in the upper 2 bits
};
struct PackedAttribute {
    Vec2 uv;
    std::uint32_t color;  // square roots of linear rgb, plain alpha: unorm8 x 4
};
// Four joints and weights of a skinned vertex: u16 and unorm16 (sum exactly 65535).
struct PackedInfluence {
    std::uint32_t joints01, joints23, weights01, weights23;
};
// One morph target's offsets of one vertex.
struct MorphOffset {
    Vec3 position, normal;
};

PackedFrame packFrame(Vec3 normal, Vec4 tangent);
PackedInfluence packInfluence(U16Vec4 joints, Vec4 weights);

// Box of the bind-pose vertices that a joint moves.
struct JointBox {
    int joint = 0;
    Bounds box;
};

// What tells whether a mesh is a closed shell that faces outwards.
struct Shell {
    Vec3 area;          // sum of the triangles' area vectors: zero for a closed surface, else what its holes lack
    float total = 0;    // sum of their sizes
    double volume = 0;  // signed; positive where triangles face outwards
};
// Whether a shell casts the same shadow when its back faces are left out: it faces outwards, and where it is open it is
// open to the ground.
Shell shellOf(const ModelMesh& mesh);
bool shadowsByFrontFaces(const Shell& shell, const Mat4& worldFromModel);

struct GpuPrimitive {
    std::uint32_t firstIndex = 0, indexCount = 0;
    std::uint32_t firstCoarse = 0, coarseCount = 0;  // indices of a draft; 0: none
    float coarseCell = 0;                            // how far a draft's vertices are off, mesh space
    std::uint32_t firstVertex = 0, vertexCount = 0;
    int material = 0;  // of the store
    Bounds bounds;     // bind pose
    Shell shell;       // of all of the mesh
    bool skinned = false;
    std::uint32_t firstInfluence = 0;              // skinned only
    std::uint32_t firstMorph = 0, morphCount = 0;  // targets lie one after another, vertexCount offsets each
    std::vector<JointBox> jointBoxes;              // skinned only
    std::vector<Bounds> morphReach;                // box of each target's offsets
    bool posed() const { return skinned || morphCount > 0; }
};

struct GpuModel {
    Model skeleton;  // nodes, skins, clips, meshes' weights; no vertices, materials or images
    std::vector<std::vector<GpuPrimitive>> meshes;
};

struct MeshStore {
    GrowBuffer positions{"positions"}, frames{"normals and tangents"}, attributes{"uvs and colours"}, uv1{"second uvs"},
        indices{"indices"};
    GrowBuffer influences{"joints and weights"}, morphs{"morph offsets"};
    bool hasUv1 = false;
    bool wantsCoarse = false;  // of what is added from now on
    std::size_t vertexCount() const { return positions.used() / sizeof(Vec3); }

    // Packs and uploads. Errors: storage beyond 2 GiB, no graphics memory.
    Result<GpuModel> add(gl::Device& device, const Model& model, int firstMaterial, const MaterialStore& materials);
    void clear();
};

}  // namespace shoal::frame
