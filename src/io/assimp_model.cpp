// OBJ, PLY, STL, FBX, Collada, 3DS and more through assimp: meshes, materials, node tree, skins and node animations.
// Morph targets, cameras and lights of these formats are left out; materials are in assimp_material.cpp. assimp is run
// behind checks of the file before and of the scene after; its own faults are not chased.
#include "io/assimp_model.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/Importer.hpp>

#include <shoal/io/file.h>

#include "io/assimp_parts.h"
#include "io/gltf_parts.h"
#include "io/mesh_finish.h"
#include "io/model_axes.h"

namespace shoal::io {

namespace {

constexpr std::string_view kExtensions[] = {".obj", ".ply",  ".stl", ".fbx",     ".dae", ".3ds",
                                            ".off", ".x",    ".lwo", ".blend",   ".ac",  ".ase",
                                            ".3mf", ".ms3d", ".b3d", ".md5mesh", ".dxf"};
constexpr float kCreaseDegrees = 40;  // sharper edges stay edges where the file has no normals
constexpr float kCoordinateLimit = 1e18f;
constexpr double kDefaultTicksPerSecond = 25;
constexpr const char* kNoTriangles = "has no triangles (points and lines are not drawn)";

struct ReadError {
    std::string message;
};

std::string text(const aiString& s) { return {s.C_Str(), s.length}; }
Vec3 vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

// ---- the scene assimp made --------------------------------------------------------------------------------------

class SceneReader {
public:
    SceneReader(const aiScene& scene, const std::filesystem::path& path, const ModelReadOptions& options)
        : scene_(scene), path_(path), options_(options) {}

    Model read() {
        readAssimpMaterials(scene_, path_, options_.log, model_);
        readNodes();
        for (unsigned i = 0; i < scene_.mNumAnimations; ++i) readClip(*scene_.mAnimations[i]);
        return std::move(model_);
    }

private:
    void log(LogLevel level, const std::string& message) const {
        if (options_.log) options_.log(level, fmt::format("{}: {}", path_.string(), message));
    }
    void readNodes();
    void readNodeMeshes(const aiNode& source, int place);
    int readMeshes(const std::vector<unsigned>& meshes, const std::string& name, Skin* skin);
    Primitive readPrimitive(unsigned index, Skin* skin);
    void readBones(const aiMesh& source, Skin& skin, Primitive& primitive);
    void readClip(const aiAnimation& source);

    const aiScene& scene_;
    const std::filesystem::path& path_;
    const ModelReadOptions& options_;
    Model model_;
    std::map<std::string, int> nodeOfName_;
    std::map<std::vector<unsigned>, int> meshOfList_;
    std::vector<const aiNode*> sources_;  // by place in model_.nodes; null for nodes added here
    std::size_t bytes_ = 0;
};

// ---- nodes, meshes, skins ---------------------------------------------------------------------------------------

void SceneReader::readNodes() {
    struct Pending {
        const aiNode* node;
        int parent;
    };
    std::vector<Pending> pending{{scene_.mRootNode, -1}};
    while (!pending.empty()) {
        const auto [source, parent] = pending.back();
        pending.pop_back();
        Node node;
        node.name = text(source->mName);
        node.parent = parent;
        aiVector3D scale, position;
        aiQuaternion rotation;
        source->mTransformation.Decompose(scale, rotation, position);
        node.translation = vec(position);
        node.scale = vec(scale);
        const Quat q{rotation.x, rotation.y, rotation.z, rotation.w};
        const float l = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
        if (l > 1e-6f && std::isfinite(l)) node.rotation = {q.x / l, q.y / l, q.z / l, q.w / l};
        for (const float value : {position.x, position.y, position.z, scale.x, scale.y, scale.z})
            if (!(std::abs(value) <= kCoordinateLimit))
                throw ReadError{fmt::format("node \"{}\" has a transform that is not finite", node.name)};
        const int place = int(model_.nodes.size());
        nodeOfName_.emplace(node.name, place);
        sources_.push_back(source);
        model_.nodes.push_back(std::move(node));
        for (unsigned i = source->mNumChildren; i-- > 0;) pending.push_back({source->mChildren[i], place});
    }
    for (std::size_t i = 0; i < sources_.size(); ++i)  // nodes added on the way have no source
        if (sources_[i]) readNodeMeshes(*sources_[i], int(i));
}

// Rigid meshes hang at the node itself, each set with bones at its own node: bones follow the skin, not the node.
void SceneReader::readNodeMeshes(const aiNode& source, int place) {
    std::vector<unsigned> rigid, skinned;
    for (unsigned i = 0; i < source.mNumMeshes; ++i) {
        const unsigned mesh = source.mMeshes[i];
        if (mesh >= scene_.mNumMeshes)
            throw ReadError{fmt::format("mesh {}, but there are only {}", mesh, scene_.mNumMeshes)};
        (scene_.mMeshes[mesh]->mNumBones ? skinned : rigid).push_back(mesh);
    }
    const std::string name = text(source.mName);
    if (!rigid.empty()) model_.nodes[std::size_t(place)].mesh = readMeshes(rigid, name, nullptr);
    if (skinned.empty()) return;
    Skin skin;
    skin.name = name;
    const int mesh = readMeshes(skinned, name, &skin);
    int holder = place;
    if (!rigid.empty()) {
        Node extra;
        extra.name = name + " (skinned)";
        extra.parent = place;
        holder = int(model_.nodes.size());
        model_.nodes.push_back(std::move(extra));
        sources_.push_back(nullptr);
    }
    Node& node = model_.nodes[std::size_t(holder)];
    node.mesh = mesh;
    if (skin.joints.empty()) return;
    node.skin = int(model_.skins.size());
    model_.skins.push_back(std::move(skin));
}

int SceneReader::readMeshes(const std::vector<unsigned>& meshes, const std::string& name, Skin* skin) {
    if (!skin)
        if (const auto found = meshOfList_.find(meshes); found != meshOfList_.end()) return found->second;
    ModelMesh mesh;
    mesh.name = name;
    for (const unsigned index : meshes) {
        Primitive primitive = readPrimitive(index, skin);
        if (!primitive.indices.empty()) mesh.primitives.push_back(std::move(primitive));
    }
    const int place = int(model_.meshes.size());
    model_.meshes.push_back(std::move(mesh));
    if (!skin) meshOfList_.emplace(meshes, place);
    return place;
}

Primitive SceneReader::readPrimitive(unsigned index, Skin* skin) {
    const aiMesh& source = *scene_.mMeshes[index];
    const std::size_t n = source.mNumVertices;
    bytes_ += n * 96 + std::size_t(source.mNumFaces) * 12;
    if (bytes_ > kModelByteLimit) throw ReadError{"decodes to more than 2 GiB"};
    Primitive out;
    if (source.mMaterialIndex < model_.materials.size()) out.material = int(source.mMaterialIndex);
    out.positions.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 p = vec(source.mVertices[i]);
        if (!(std::abs(p.x) <= kCoordinateLimit && std::abs(p.y) <= kCoordinateLimit &&
              std::abs(p.z) <= kCoordinateLimit))
            throw ReadError{fmt::format("mesh {} \"{}\": vertex {} is ({:g}, {:g}, {:g}), expected finite numbers",
                                        index, text(source.mName), i, p.x, p.y, p.z)};
        out.positions.push_back(p);
    }
    for (std::size_t i = 0; i < n && source.HasNormals(); ++i) out.normals.push_back(vec(source.mNormals[i]));
    const auto readUv = [&](unsigned set, std::vector<Vec2>& uv) {
        for (std::size_t i = 0; i < n && source.HasTextureCoords(set); ++i)
            uv.push_back({source.mTextureCoords[set][i].x, source.mTextureCoords[set][i].y});
        clearNonFinite({reinterpret_cast<float*>(uv.data()), uv.size() * 2});
    };
    readUv(0, out.uv0);
    readUv(1, out.uv1);
    for (std::size_t i = 0; i < n && source.HasVertexColors(0); ++i) {
        const aiColor4D c = source.mColors[0][i];  // these formats store what the author's screen showed
        out.colors.push_back({linearFromSrgb(c.r), linearFromSrgb(c.g), linearFromSrgb(c.b), c.a});
    }
    clearNonFinite({reinterpret_cast<float*>(out.colors.data()), out.colors.size() * 4});
    for (unsigned f = 0; f < source.mNumFaces; ++f) {
        const aiFace& face = source.mFaces[f];
        if (face.mNumIndices != 3) continue;
        for (unsigned c = 0; c < 3; ++c) {
            if (face.mIndices[c] >= n)
                throw ReadError{fmt::format("mesh {}: face {} uses vertex {}, but there are only {}", index, f,
                                            face.mIndices[c], n)};
            out.indices.push_back(face.mIndices[c]);
        }
    }
    if (skin) readBones(source, *skin, out);
    if (out.normals.empty()) makeCreaseNormals(out, std::cos(radians(kCreaseDegrees)));
    const Material* material = out.material < 0 ? nullptr : &model_.materials[std::size_t(out.material)];
    if (const std::string repaired = finishPrimitive(out, material); !repaired.empty())
        log(LogLevel::warning, fmt::format("mesh {} \"{}\": {}", index, text(source.mName), repaired));
    return out;
}

// Adds the mesh's bones to the skin; a bone of another mesh is shared where node and bind matrix are the same.
void SceneReader::readBones(const aiMesh& source, Skin& skin, Primitive& primitive) {
    primitive.joints.resize(primitive.vertexCount());
    primitive.weights.assign(primitive.vertexCount(), {0, 0, 0, 0});
    std::vector<std::uint8_t> used(primitive.vertexCount(), 0);
    for (unsigned b = 0; b < source.mNumBones; ++b) {
        const aiBone& bone = *source.mBones[b];
        const auto node = nodeOfName_.find(text(bone.mName));
        if (node == nodeOfName_.end()) {
            log(LogLevel::warning, fmt::format("bone \"{}\" has no node and is left out", text(bone.mName)));
            continue;
        }
        Mat4 jointFromMesh;
        for (unsigned r = 0; r < 4; ++r)
            for (unsigned c = 0; c < 4; ++c) {
                jointFromMesh(int(r), int(c)) = bone.mOffsetMatrix[r][c];
                if (!(std::abs(bone.mOffsetMatrix[r][c]) <= kCoordinateLimit))
                    throw ReadError{fmt::format("bone \"{}\": its bind matrix is not finite", node->first)};
            }
        std::size_t joint = 0;
        while (joint < skin.joints.size() &&
               !(skin.joints[joint] == node->second && skin.jointFromMesh[joint] == jointFromMesh))
            ++joint;
        if (joint > 0xFFFF) throw ReadError{"a skin of more than 65536 joints"};
        if (joint == skin.joints.size()) {
            skin.joints.push_back(node->second);
            skin.jointFromMesh.push_back(jointFromMesh);
        }
        for (unsigned w = 0; w < bone.mNumWeights; ++w) {
            const unsigned vertex = bone.mWeights[w].mVertexId;
            if (vertex >= primitive.vertexCount() || used[vertex] == 4) continue;
            const int slot = used[vertex]++;
            (&primitive.joints[vertex].x)[slot] = std::uint16_t(joint);
            (&primitive.weights[vertex].x)[slot] = bone.mWeights[w].mWeight;
        }
    }
    if (skin.joints.empty()) primitive.joints.clear(), primitive.weights.clear();
}

// ---- animations -------------------------------------------------------------------------------------------------

// Appends the keys whose times increase; `value` appends one key's floats.
template <class Key, class Value>
Channel channelOf(int node, ChannelTarget target, const Key* keys, unsigned count, double secondsPerTick,
                  const Value& value) {
    Channel channel;
    channel.node = node;
    channel.target = target;
    for (unsigned i = 0; i < count; ++i) {
        const float time = float(keys[i].mTime * secondsPerTick);
        if (!std::isfinite(time) || (!channel.times.empty() && !(time > channel.times.back()))) continue;
        const std::size_t before = channel.values.size();
        value(keys[i].mValue, channel.values);
        if (channel.values.size() > before) channel.times.push_back(time);
    }
    return channel;
}

void SceneReader::readClip(const aiAnimation& source) {
    Clip clip;
    clip.name = text(source.mName);
    const double secondsPerTick = 1 / (source.mTicksPerSecond > 0 ? source.mTicksPerSecond : kDefaultTicksPerSecond);
    const auto vector = [](const aiVector3D& v, std::vector<float>& out) {
        if (std::abs(v.x) <= kCoordinateLimit && std::abs(v.y) <= kCoordinateLimit && std::abs(v.z) <= kCoordinateLimit)
            out.insert(out.end(), {v.x, v.y, v.z});
    };
    const auto quaternion = [](const aiQuaternion& q, std::vector<float>& out) {
        const float l = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
        if (l > 1e-6f && std::isfinite(l)) out.insert(out.end(), {q.x / l, q.y / l, q.z / l, q.w / l});
    };
    for (unsigned i = 0; i < source.mNumChannels; ++i) {
        const aiNodeAnim& a = *source.mChannels[i];
        const auto node = nodeOfName_.find(text(a.mNodeName));
        if (node == nodeOfName_.end()) continue;
        const int n = node->second;
        Channel channels[] = {
            channelOf(n, ChannelTarget::translation, a.mPositionKeys, a.mNumPositionKeys, secondsPerTick, vector),
            channelOf(n, ChannelTarget::rotation, a.mRotationKeys, a.mNumRotationKeys, secondsPerTick, quaternion),
            channelOf(n, ChannelTarget::scale, a.mScalingKeys, a.mNumScalingKeys, secondsPerTick, vector)};
        for (Channel& channel : channels) {
            if (channel.times.empty()) continue;
            clip.duration = std::max(clip.duration, channel.times.back());
            clip.channels.push_back(std::move(channel));
        }
    }
    model_.clips.push_back(std::move(clip));
}

// ---- unit and axes ----------------------------------------------------------------------------------------------

struct Axes {
    Quat rotation{};
    float scale = 1;
};

Axes axesOf(const aiScene& scene, const std::string& extension, const ModelReadOptions& options) {
    Axes axes;
    if (extension == ".fbx" && scene.mMetaData) {
        double centimetres = 0;
        float single = 0;
        if (!scene.mMetaData->Get("UnitScaleFactor", centimetres) && scene.mMetaData->Get("UnitScaleFactor", single))
            centimetres = double(single);
        axes.scale = centimetres > 0 ? float(centimetres / 100) : 0.01f;
        std::int32_t up = 1;
        scene.mMetaData->Get("UpAxis", up);
        if (up == 2 && options.up == UpAxis::automatic) axes.rotation = axisAngle({1, 0, 0}, -kPi / 2);
    }
    if (options.up == UpAxis::z) axes.rotation = axisAngle({1, 0, 0}, -kPi / 2);
    if (options.scale > 0) axes.scale = options.scale;
    if (options.scale > 0 && extension == ".dae") {  // assimp has put the file's unit into the root node
        aiVector3D unit, position;
        aiQuaternion rotation;
        scene.mRootNode->mTransformation.Decompose(unit, rotation, position);
        if (unit.x > 0) axes.scale /= unit.x;
    }
    return axes;
}

// assimp's ways to say that only points or lines were left.
std::string plainer(const std::string& message) {
    for (const char* words : {"contains no faces", "No meshes remaining", "At least one mesh must be there"})
        if (message.find(words) != std::string::npos) return kNoTriangles;
    return message;
}

Model readScene(const std::filesystem::path& path, const std::string& extension, const ModelReadOptions& options) {
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    importer.SetPropertyInteger(AI_CONFIG_PP_LBW_MAX_WEIGHTS, 4);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, options.up != UpAxis::automatic);
    const unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_JoinIdenticalVertices |
                           aiProcess_LimitBoneWeights | aiProcess_FlipUVs | aiProcess_ValidateDataStructure;
    const aiScene* scene = importer.ReadFile(path.string(), steps);
    if (!scene || !scene->mRootNode) throw ReadError{plainer(importer.GetErrorString())};
    if (scene->mNumMeshes == 0 && scene->mNumAnimations == 0) throw ReadError{kNoTriangles};
    Model model = SceneReader(*scene, path, options).read();
    const Axes axes = axesOf(*scene, extension, options);
    applyAxes(model, axes.rotation, axes.scale);
    if (options.flipWinding) flipWinding(model);
    model.name = path.stem().string();
    return model;
}

std::string oneLine(std::string message) {
    std::replace(message.begin(), message.end(), '\n', ' ');
    if (message.size() > 200) message.resize(200);
    return message;
}

}  // namespace

bool isAssimpExtension(const std::string& extension) {
    return std::find(std::begin(kExtensions), std::end(kExtensions), extension) != std::end(kExtensions);
}

Result<Model> readAssimp(const std::filesystem::path& path, std::span<const std::byte> bytes,
                         const ModelReadOptions& options) {
    const std::string extension = lowerExtension(path);
    try {
        if (const std::string fault = headerFault(extension, bytes); !fault.empty()) throw ReadError{fault};
        return readScene(path, extension, options);
    } catch (const ReadError& error) {
        return badInput(fmt::format("{}: {}", path.string(), oneLine(error.message)));
    } catch (const std::bad_alloc&) {
        return badInput(fmt::format("{}: not enough memory", path.string()));
    } catch (const std::exception& error) {
        return badInput(fmt::format("{}: {}", path.string(), oneLine(error.what())));
    }
}

}  // namespace shoal::io
