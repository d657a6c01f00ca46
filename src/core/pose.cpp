// Keyframe interpolation after glTF 2.0, appendix C ("Animation Sampler Interpolation Modes"), skinning after §3.7.3.
#include <shoal/core/assert.h>
#include <shoal/core/parallel.h>
#include <shoal/core/pose.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <span>

namespace shoal {

namespace {

constexpr std::size_t kVertexGrain = 4096;

bool sameIgnoringCase(std::string_view a, std::string_view b) {
    const auto same = [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); };
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same);
}

// Seconds within the clip.
float clipTime(const Clip& clip, float time, bool loop) {
    if (!std::isfinite(time) || !(clip.duration > 0)) return 0;
    if (!loop) return std::clamp(time, 0.0f, clip.duration);
    const float wrapped = std::fmod(time, clip.duration);
    return wrapped < 0 ? wrapped + clip.duration : wrapped;
}

// Between which two keys, and how far. Before the first and after the last key both are the same.
struct KeySpan {
    std::size_t from = 0, to = 0;
    float fraction = 0;  // 0 .. 1
    float seconds = 0;   // from one key to the next
};

KeySpan findKeys(const std::vector<float>& times, float time) {
    const std::size_t last = times.size() - 1;
    if (!(time > times.front())) return {0, 0, 0, 0};
    if (time >= times[last]) return {last, last, 0, 0};
    const std::size_t to = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin());
    const float seconds = times[to] - times[to - 1];
    return {to - 1, to, seconds > 0 ? (time - times[to - 1]) / seconds : 0, seconds};
}

Quat quatAt(const float* v) { return {v[0], v[1], v[2], v[3]}; }

void storeQuat(Quat q, float* to) { to[0] = q.x, to[1] = q.y, to[2] = q.z, to[3] = q.w; }

// Samples `channel` at `time` into out. Rotations come out with unit length. Morph weights that the mesh has no target
// for are left out, targets without a weight keep their default.
void sampleChannel(const Channel& channel, float time, std::span<float> out) {
    const bool cubic = channel.interpolation == Interpolation::cubicSpline;
    const std::size_t stride = channel.values.size() / channel.times.size();
    const std::size_t keySize = cubic ? stride / 3 : stride;  // floats of one value
    if (channel.target == ChannelTarget::morphWeights) out = out.first(std::min(out.size(), keySize));
    SHOAL_ASSERT_GE(keySize, out.size());
    const std::size_t n = out.size();

    const KeySpan keys = findKeys(channel.times, time);
    const float* a = channel.values.data() + keys.from * stride;
    const float* b = channel.values.data() + keys.to * stride;
    const float t = keys.fraction;
    if (cubic) {
        const float t2 = t * t, t3 = t2 * t;
        const float valueA = 2 * t3 - 3 * t2 + 1, tangentA = keys.seconds * (t3 - 2 * t2 + t);
        const float valueB = -2 * t3 + 3 * t2, tangentB = keys.seconds * (t3 - t2);
        for (std::size_t i = 0; i < n; ++i)
            out[i] =
                valueA * a[keySize + i] + tangentA * a[2 * keySize + i] + valueB * b[keySize + i] + tangentB * b[i];
    } else if (channel.interpolation == Interpolation::step || keys.from == keys.to) {
        std::copy(a, a + n, out.begin());
    } else if (channel.target == ChannelTarget::rotation) {
        storeQuat(slerp(quatAt(a), quatAt(b), t), out.data());
    } else {
        for (std::size_t i = 0; i < n; ++i) out[i] = (1 - t) * a[i] + t * b[i];
    }
    if (channel.target == ChannelTarget::rotation) storeQuat(normalize(quatAt(out.data())), out.data());
}

// While channels are sampled, a node's slot in Pose::modelFromNode holds its translation, rotation and scale in the
// first ten floats: that saves a second array. The forward pass turns them into matrices.
constexpr std::size_t kTranslationAt = 0, kRotationAt = 3, kScaleAt = 7;

void storeLocal(const Node& node, Mat4& slot) {
    const Vec3 t = node.translation, s = node.scale;
    const Quat r = node.rotation;
    slot.m = {t.x, t.y, t.z, r.x, r.y, r.z, r.w, s.x, s.y, s.z, 0, 0, 0, 0, 0, 0};
}

Mat4 localMatrix(const Mat4& slot) {
    const float* v = slot.m.data();
    return compose({v[0], v[1], v[2]}, quatAt(v + kRotationAt), {v[kScaleAt], v[kScaleAt + 1], v[kScaleAt + 2]});
}

void defaultMorphWeights(const Model& model, const Node& node, std::vector<float>& weights) {
    weights.clear();
    if (node.mesh < 0) return;
    const ModelMesh& mesh = model.meshes[std::size_t(node.mesh)];
    std::size_t targetCount = 0;
    for (const Primitive& primitive : mesh.primitives)
        targetCount = std::max(targetCount, primitive.morphTargets.size());
    if (targetCount == 0) return;
    const std::vector<float>& given = node.morphWeights.empty() ? mesh.morphWeights : node.morphWeights;
    weights.assign(given.begin(), given.begin() + std::ptrdiff_t(std::min(given.size(), targetCount)));
    weights.resize(targetCount, 0.0f);
}

void applyChannel(const Channel& channel, float time, Pose& pose) {
    if (channel.times.empty() || channel.node < 0) return;
    const std::size_t node = std::size_t(channel.node);
    float* slot = pose.modelFromNode[node].m.data();
    switch (channel.target) {
        case ChannelTarget::translation:
            return sampleChannel(channel, time, {slot + kTranslationAt, 3});
        case ChannelTarget::rotation:
            return sampleChannel(channel, time, {slot + kRotationAt, 4});
        case ChannelTarget::scale:
            return sampleChannel(channel, time, {slot + kScaleAt, 3});
        case ChannelTarget::morphWeights:
            return sampleChannel(channel, time, pose.morphWeights[node]);
    }
}

// Position of vertex i with the morph targets added.
Vec3 morphed(const Primitive& primitive, std::span<const float> weights, std::size_t i) {
    Vec3 p = primitive.positions[i];
    const std::size_t targetCount = std::min(weights.size(), primitive.morphTargets.size());
    for (std::size_t k = 0; k < targetCount; ++k) {
        const std::vector<Vec3>& offsets = primitive.morphTargets[k].positions;
        if (weights[k] != 0 && !offsets.empty()) p += offsets[i] * weights[k];
    }
    return p;
}

Vec3 skinned(const Primitive& primitive, std::span<const Mat4> modelFromBind, std::size_t i, Vec3 p) {
    const U16Vec4 j = primitive.joints[i];
    const Vec4 w = primitive.weights[i];
    const std::pair<std::uint16_t, float> influences[4] = {{j.x, w.x}, {j.y, w.y}, {j.z, w.z}, {j.w, w.w}};
    Vec3 sum;
    for (const auto& [joint, weight] : influences)
        if (weight != 0) sum += transformPoint(modelFromBind[joint], p) * weight;
    return sum;
}

}  // namespace

int findClip(const Model& model, std::string_view name) {
    for (std::size_t i = 0; i < model.clips.size(); ++i)
        if (model.clips[i].name == name) return int(i);
    for (std::size_t i = 0; i < model.clips.size(); ++i)
        if (sameIgnoringCase(model.clips[i].name, name)) return int(i);
    return -1;
}

void poseModel(const Model& model, int clip, float time, bool loop, Pose& pose) {
    SHOAL_ASSERT_LT(clip, int(model.clips.size()));
    pose.modelFromNode.resize(model.nodes.size());
    pose.morphWeights.resize(model.nodes.size());
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        storeLocal(model.nodes[i], pose.modelFromNode[i]);
        defaultMorphWeights(model, model.nodes[i], pose.morphWeights[i]);
    }
    if (clip >= 0) {
        const Clip& c = model.clips[std::size_t(clip)];
        const float t = clipTime(c, time, loop);
        for (const Channel& channel : c.channels) applyChannel(channel, t, pose);
    }

    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        const Mat4 parentFromNode = localMatrix(pose.modelFromNode[i]);
        const int parent = model.nodes[i].parent;
        SHOAL_ASSERT_LT(parent, int(i));
        pose.modelFromNode[i] = parent < 0 ? parentFromNode : pose.modelFromNode[std::size_t(parent)] * parentFromNode;
    }

    pose.modelFromBind.resize(model.skins.size());
    for (std::size_t s = 0; s < model.skins.size(); ++s) {
        const Skin& skin = model.skins[s];
        pose.modelFromBind[s].resize(skin.joints.size());
        for (std::size_t j = 0; j < skin.joints.size(); ++j)
            pose.modelFromBind[s][j] = pose.modelFromNode[std::size_t(skin.joints[j])] * skin.jointFromMesh[j];
    }
}

std::vector<Vec3> posedPositions(const Model& model, const Pose& pose, int node, const Primitive& primitive) {
    SHOAL_ASSERT_EQ(pose.modelFromNode.size(), model.nodes.size());
    const std::size_t n = std::size_t(node);
    const int skin = primitive.joints.empty() ? -1 : model.nodes[n].skin;
    std::vector<Vec3> positions(primitive.vertexCount());
    parallelFor(positions.size(), kVertexGrain, [&](std::size_t i) {
        const Vec3 p = morphed(primitive, pose.morphWeights[n], i);
        positions[i] = skin >= 0 ? skinned(primitive, pose.modelFromBind[std::size_t(skin)], i, p)
                                 : transformPoint(pose.modelFromNode[n], p);
    });
    return positions;
}

Bounds posedBounds(const Model& model, const Pose& pose) {
    SHOAL_ASSERT_EQ(pose.modelFromNode.size(), model.nodes.size());
    Bounds all;
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        const Node& node = model.nodes[n];
        if (node.mesh < 0) continue;
        for (const Primitive& primitive : model.meshes[std::size_t(node.mesh)].primitives) {
            const bool skin = node.skin >= 0 && !primitive.joints.empty();
            const auto boundsOf = [&](std::size_t begin, std::size_t end) {
                Bounds bounds;
                for (std::size_t i = begin; i < end; ++i) {
                    const Vec3 p = morphed(primitive, pose.morphWeights[n], i);
                    bounds.add(skin ? skinned(primitive, pose.modelFromBind[std::size_t(node.skin)], i, p)
                                    : transformPoint(pose.modelFromNode[n], p));
                }
                return bounds;
            };
            const auto unite = [](Bounds a, const Bounds& b) { return a.add(b), a; };
            all.add(parallelReduce(primitive.vertexCount(), kVertexGrain, Bounds{}, boundsOf, unite));
        }
    }
    return all;
}

}  // namespace shoal
