// An animated model as plain data: what a glTF, OBJ or FBX file holds, after reading and checking. All indices in it
// are valid (the readers check them), -1 where "none" is allowed. Metres, y up.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/core/math.h>

namespace shoal {

enum class AlphaMode { opaque, mask, blend };
enum class Wrap { repeat, mirror, clamp };

// A texture as a material uses it: which image, how it is sampled, and KHR_texture_transform.
struct TextureUse {
    int image = -1;  // index into Model::images, -1 for none
    int uvSet = 0;   // 0 or 1
    Wrap wrapU = Wrap::repeat, wrapV = Wrap::repeat;
    bool nearest = false;            // magnification filter NEAREST
    Vec2 offset{0, 0}, scale{1, 1};  // KHR_texture_transform
    float rotation = 0;              // radians, counter-clockwise
};

// Metal-rough material, glTF 2.0 §3.9 with its unlit and emissive-strength extensions.
struct Material {
    std::string name;
    Vec4 baseColor{1, 1, 1, 1};  // linear, times the texture and the vertex colour
    float metallic = 1, roughness = 1;
    Vec3 emission{0, 0, 0};  // linear radiance, strength multiplied in
    float normalScale = 1, occlusionStrength = 1;
    TextureUse baseColorTexture, metallicRoughnessTexture, normalTexture, occlusionTexture, emissionTexture;
    AlphaMode alphaMode = AlphaMode::opaque;
    float alphaCutoff = 0.5f;
    bool doubleSided = false;
    bool unlit = false;
    float transmission = 0;  // 0..1, KHR_materials_transmission
    float ior = 1.5f;
};

// One triangle list with one material. Every non-empty array has vertexCount entries.
struct Primitive {
    int material = -1;  // -1: the default material (white, rough, not metallic as glTF's default is metallic 1)
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;   // unit; readers make flat normals where the file has none
    std::vector<Vec4> tangents;  // xyz unit, w = handedness; present when the material has a normal map
    std::vector<Vec2> uv0, uv1;
    std::vector<Vec4> colors;            // linear
    std::vector<U16Vec4> joints;         // indices into the skin's joints
    std::vector<Vec4> weights;           // sum to 1
    std::vector<std::uint32_t> indices;  // 3 a triangle, all < vertexCount
    struct MorphTarget {
        std::vector<Vec3> positions, normals, tangents;  // offsets; empty or vertexCount
    };
    std::vector<MorphTarget> morphTargets;
    Bounds bounds;  // of positions (bind pose, no morphs)
    std::size_t vertexCount() const { return positions.size(); }
    std::size_t triangleCount() const { return indices.size() / 3; }
};

struct ModelMesh {
    std::string name;
    std::vector<Primitive> primitives;
    std::vector<float> morphWeights;  // default weights, one a target
};

struct Skin {
    std::string name;
    std::vector<int> joints;          // node indices
    std::vector<Mat4> jointFromMesh;  // inverse bind matrices, one a joint
};

struct Node {
    std::string name;
    int parent = -1;  // parents come before their children in Model::nodes: one forward pass poses all
    Vec3 translation{0, 0, 0};
    Quat rotation{};
    Vec3 scale{1, 1, 1};
    int mesh = -1, skin = -1, camera = -1, light = -1;
    std::vector<float> morphWeights;  // overrides the mesh's when not empty
};

enum class Interpolation { step, linear, cubicSpline };
enum class ChannelTarget { translation, rotation, scale, morphWeights };

// Keys of one property of one node. Values: 3, 4, 3 or morph-count floats a key; three times that for cubicSpline
// (in-tangent, value, out-tangent).
struct Channel {
    int node = -1;
    ChannelTarget target = ChannelTarget::translation;
    Interpolation interpolation = Interpolation::linear;
    std::vector<float> times;  // seconds, strictly increasing
    std::vector<float> values;
};

struct Clip {
    std::string name;
    float duration = 0;  // seconds, the last key of any channel
    std::vector<Channel> channels;
};

struct ModelCamera {
    std::string name;
    bool orthographic = false;
    float verticalFov = 0.8f;  // radians
    float heightM = 2;         // orthographic: full height in metres
    float nearZ = 0.1f;
};

struct ModelLight {
    enum class Kind { directional, point, spot } kind = Kind::point;
    std::string name;
    Vec3 intensity{1, 1, 1};  // W/sr (point, spot) or W/m2 (directional): the file's candela or lux / 683
    float range = 0;          // metres, 0: infinite
    float innerCone = 0, outerCone = 0.785398f;  // radians, half angles
};

struct Model {
    std::string name;
    std::vector<Node> nodes;
    std::vector<ModelMesh> meshes;
    std::vector<Material> materials;
    std::vector<ByteImage> images;
    std::vector<Skin> skins;
    std::vector<Clip> clips;
    std::vector<ModelCamera> cameras;
    std::vector<ModelLight> lights;
};

// Whether a node's name is one of `patterns`: whole names, or beginnings that end in `*`.
bool matchesAny(std::span<const std::string> patterns, std::string_view name);

// What `shoal info` tells of a model.
struct ModelCounts {
    std::size_t uniqueTriangles = 0;   // of all meshes, each once
    std::size_t drawnTriangles = 0;    // of all nodes' meshes: what a frame draws
    std::size_t vertices = 0;          // of all meshes, each once
    std::size_t joints = 0;            // of the largest skin
    std::size_t morphTargetSlots = 0;  // targets summed over primitives
};
ModelCounts count(const Model& model);

}  // namespace shoal
