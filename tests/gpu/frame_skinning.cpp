// Skinning and morphing on the GPU against core's poses applied in C++.
#include <gtest/gtest.h>

#include <filesystem>

#include <shoal/core/pose.h>
#include <shoal/core/random.h>
#include <shoal/io/model.h>

#include "frame/fullscreen.h"
#include "frame/glsl_math.h"
#include "frame/skinning.h"
#include "support/frame_scene.h"
#include "support/gl_device.h"

namespace shoal::frame {
namespace {

// Positions and octahedral normals carry 32 and 16 bits, weights 16: see packInfluence.
constexpr float kPositionTolerance = 1e-4f;  // of the model's size
constexpr float kNormalTolerance = 3e-4f;  // radians; the sum of an octahedral step in, one out and the weights' steps

struct Posed {
    std::vector<Vec3> positions, normals;
};

// glTF 2.0, 3.7.3: morph targets first, then the weighted sum of the joints' matrices.
Posed poseOnCpu(const Primitive& p, const std::vector<Mat4>* modelFromBind, const std::vector<float>& weights) {
    Posed posed{p.positions, p.normals};
    for (std::size_t i = 0; i < p.vertexCount(); ++i) {
        Vec3 x = p.positions[i], n = p.normals[i];
        for (std::size_t k = 0; k < p.morphTargets.size(); ++k) {
            if (!p.morphTargets[k].positions.empty()) x += p.morphTargets[k].positions[i] * weights[k];
            if (!p.morphTargets[k].normals.empty()) n += p.morphTargets[k].normals[i] * weights[k];
        }
        if (modelFromBind) {
            const std::uint16_t joints[4] = {p.joints[i].x, p.joints[i].y, p.joints[i].z, p.joints[i].w};
            const float w[4] = {p.weights[i].x, p.weights[i].y, p.weights[i].z, p.weights[i].w};
            Mat4 sum;
            sum.m.fill(0);
            for (int k = 0; k < 4; ++k)
                for (std::size_t e = 0; e < 16; ++e) sum.m[e] += w[k] * (*modelFromBind)[joints[k]].m[e];
            const Mat3 cofactors = normalMatrix(sum);
            x = transformPoint(sum, x);
            n = {cofactors.m[0] * n.x + cofactors.m[3] * n.y + cofactors.m[6] * n.z,
                 cofactors.m[1] * n.x + cofactors.m[4] * n.y + cofactors.m[7] * n.z,
                 cofactors.m[2] * n.x + cofactors.m[5] * n.y + cofactors.m[8] * n.z};
        }
        posed.positions[i] = x;
        posed.normals[i] = normalize(n);
    }
    return posed;
}

class FrameSkinning : public test::GlTest {
protected:
    // Poses every primitive of every node that has a skin or morphs, on both sides, and compares.
    void compare(const Model& model, const Pose& pose, float size) {
        registerFrameShaders();
        auto materials = MaterialStore::create(device());
        ASSERT_TRUE(materials);
        auto first = materials->add(model);
        ASSERT_TRUE(first);
        MeshStore store;
        auto gpu = store.add(device(), model, *first, *materials);
        ASSERT_TRUE(gpu) << gpu.error().message;
        auto skinner = Skinner::create(device());
        ASSERT_TRUE(skinner) << skinner.error().message;

        std::vector<SkinJob> jobs;
        std::vector<Posed> expected;
        std::vector<Vec4> rows;
        for (std::size_t n = 0; n < model.nodes.size(); ++n) {
            const Node& node = model.nodes[n];
            if (node.mesh < 0) continue;
            const std::vector<float>& weights = pose.morphWeights[n];
            SkinJob job;
            job.jointRow = std::uint32_t(rows.size());
            if (node.skin >= 0)
                for (const Mat4& m : pose.modelFromBind[std::size_t(node.skin)])
                    for (int r = 0; r < 3; ++r) rows.push_back({m(r, 0), m(r, 1), m(r, 2), m(r, 3)});
            job.weightRow = std::uint32_t(rows.size());
            for (std::size_t k = 0; k < weights.size(); k += 4)
                rows.push_back({weights[k], k + 1 < weights.size() ? weights[k + 1] : 0,
                                k + 2 < weights.size() ? weights[k + 2] : 0,
                                k + 3 < weights.size() ? weights[k + 3] : 0});
            const auto& primitives = model.meshes[std::size_t(node.mesh)].primitives;
            for (std::size_t p = 0; p < primitives.size(); ++p) {
                job.primitive = &gpu->meshes[std::size_t(node.mesh)][p];
                job.skinned = job.primitive->skinned && node.skin >= 0;
                if (!job.primitive->posed()) continue;
                jobs.push_back(job);
                expected.push_back(poseOnCpu(
                    primitives[p], job.skinned ? &pose.modelFromBind[std::size_t(node.skin)] : nullptr, weights));
            }
        }
        ASSERT_FALSE(jobs.empty());
        skinner->rebuild(jobs, rows.size(), store);
        skinner->run(jobs, rows, store);

        for (int which = 0; which < 2; ++which) {  // the previous positions of a first frame are the same
            std::vector<Vec3> positions(skinner->vertexCount());
            skinner->positions(which).read(0, std::as_writable_bytes(std::span(positions)));
            std::vector<PackedFrame> frames(skinner->vertexCount());
            skinner->frames().read(0, std::as_writable_bytes(std::span(frames)));
            float worstPosition = 0, worstNormal = 0;
            for (std::size_t j = 0; j < jobs.size(); ++j)
                for (std::size_t i = 0; i < expected[j].positions.size(); ++i) {
                    const std::size_t at = jobs[j].targetVertex + i;
                    const float nx = float(std::int16_t(frames[at].normal & 0xffff)) / 32767;
                    const float ny = float(std::int16_t(frames[at].normal >> 16)) / 32767;
                    const glsl::vec3 n = glsl::normalFromOctahedral({nx, ny});
                    worstPosition = std::max(worstPosition, length(positions[at] - expected[j].positions[i]));
                    worstNormal = std::max(worstNormal, length(Vec3{n.x, n.y, n.z} - expected[j].normals[i]));
                }
            EXPECT_LT(worstPosition, kPositionTolerance * size);
            EXPECT_LT(worstNormal, kNormalTolerance);
            RecordProperty("worstPosition", std::to_string(worstPosition));
            RecordProperty("worstNormal", std::to_string(worstNormal));
        }
    }
};

// A strip of 1000 vertices on three joints with odd weights, two morph targets, and a joint that shears.
Model syntheticModel() {
    Model model;
    model.name = "strip";
    Primitive p;
    for (std::uint32_t i = 0; i < 1000; ++i) {
        p.positions.push_back({randomFloat(1, i) - 0.5f, randomFloat(2, i) * 2, randomFloat(3, i) - 0.5f});
        p.normals.push_back(
            normalize(Vec3{randomFloat(4, i) - 0.5f, randomFloat(5, i) - 0.5f, randomFloat(6, i) - 0.45f}));
        const float a = randomFloat(7, i), b = (1 - a) * randomFloat(8, i);
        p.joints.push_back({0, 1, 2, 2});
        p.weights.push_back({a, b, 1 - a - b, 0});
    }
    for (std::uint32_t t = 0; t < 2; ++t) {
        Primitive::MorphTarget target;
        for (std::uint32_t i = 0; i < 1000; ++i) {
            target.positions.push_back({0.2f * randomFloat(10 + t, i), -0.1f * randomFloat(12 + t, i), 0.05f});
            target.normals.push_back({0.1f * randomFloat(14 + t, i), 0, -0.1f});
        }
        p.morphTargets.push_back(target);
    }
    for (std::uint32_t i = 0; i < 999; ++i) p.indices.push_back(i);
    for (const Vec3& v : p.positions) p.bounds.add(v);
    model.meshes.push_back({"strip", {p}, {0.25f, 0.75f}});
    Node root;
    root.translation = {0.1f, 0.2f, 0.3f};
    root.rotation = axisAngle({0, 1, 0}, 0.7f);
    Node child;
    child.parent = 0;
    child.translation = {0, 1, 0};
    child.rotation = axisAngle(normalize(Vec3{1, 0, 1}), 1.1f);
    child.scale = {1, 1.5f, 0.8f};
    Node tip = child;
    tip.parent = 1;
    Node body;
    body.mesh = 0, body.skin = 0;
    body.translation = {5, 5, 5};  // ignored: the mesh is skinned
    model.nodes = {root, child, tip, body};
    model.skins.push_back(
        {"skin", {0, 1, 2}, {translation({0, 0, 0}), translation({0, -1, 0}), translation({0, -2, 0})}});
    return model;
}

TEST_F(FrameSkinning, SyntheticSkinWithMorphsEqualsTheCpu) {
    const Model model = syntheticModel();
    Pose pose;
    poseModel(model, -1, 0, false, pose);
    compare(model, pose, 2);
}

TEST_F(FrameSkinning, MorphsWithoutSkinEqualTheCpu) {
    Model model = syntheticModel();
    model.nodes[3].skin = -1;
    Pose pose;
    poseModel(model, -1, 0, false, pose);
    compare(model, pose, 2);
}

// What is posed anew keeps where it was; what is not posed keeps both; what is fresh has no other place before.
TEST_F(FrameSkinning, PreviousPositionsAreThoseOfTheFrameBefore) {
    registerFrameShaders();
    Model model = syntheticModel();
    auto materials = MaterialStore::create(device());
    ASSERT_TRUE(materials);
    MeshStore store;
    auto gpu = store.add(device(), model, 0, *materials);
    ASSERT_TRUE(gpu);
    auto skinner = Skinner::create(device());
    ASSERT_TRUE(skinner);
    const GpuPrimitive& primitive = gpu->meshes[0][0];
    std::vector<SkinJob> jobs(2);
    for (SkinJob& job : jobs) job.primitive = &primitive;
    jobs[1].jointRow = 9;
    auto rowsAt = [](float x) {  // three joints each, moved by x and by -x; no morph weights
        std::vector<Vec4> rows;
        for (const float t : {x, -x})
            for (int joint = 0; joint < 3; ++joint) {
                rows.push_back({1, 0, 0, t});
                rows.push_back({0, 1, 0, 0});
                rows.push_back({0, 0, 1, 0});
            }
        rows.push_back({0, 0, 0, 0});
        return rows;
    };
    for (SkinJob& job : jobs) job.skinned = true, job.weightRow = 18;
    skinner->rebuild(jobs, 19, store);
    auto offset = [&](int job, bool previous) {
        Vec3 p;
        const int which = previous ? 1 - skinner->current() : skinner->current();
        skinner->positions(which).read(jobs[std::size_t(job)].targetVertex * sizeof(Vec3),
                                       std::as_writable_bytes(std::span(&p, 1)));
        return p.x - model.meshes[0].primitives[0].positions[0].x;
    };
    skinner->run(jobs, rowsAt(1), store);
    EXPECT_NEAR(offset(0, false), 1, 1e-5);
    EXPECT_NEAR(offset(0, true), 1, 1e-5);
    jobs[0].fresh = jobs[1].fresh = false;
    skinner->run(jobs, rowsAt(2), store);
    EXPECT_NEAR(offset(0, false), 2, 1e-5);
    EXPECT_NEAR(offset(0, true), 1, 1e-5);
    EXPECT_NEAR(offset(1, true), -1, 1e-5);
    jobs[1].fresh = true;
    skinner->run(jobs, rowsAt(3), store);
    EXPECT_NEAR(offset(0, true), 2, 1e-5);
    EXPECT_NEAR(offset(1, false), -3, 1e-5);
    EXPECT_NEAR(offset(1, true), -3, 1e-5);
    jobs[1].fresh = jobs[1].active = false;
    skinner->run(jobs, rowsAt(4), store);
    EXPECT_NEAR(offset(0, false), 4, 1e-5);
    EXPECT_NEAR(offset(1, false), -3, 1e-5);
    EXPECT_NEAR(offset(1, true), -3, 1e-5);
}

TEST_F(FrameSkinning, CharactersEqualTheCpu) {
    struct Case {
        const char* file;
        float size;  // metres, about its height
    };
    for (const Case& c : {Case{"characters/uacp/Casual_Male.gltf", 3.3f}, Case{"characters/RobotExpressive.glb", 4.5f},
                          Case{"characters/CesiumMan.glb", 1.5f}}) {
        const std::string file = test::dataFile(c.file);
        if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
        const auto model = io::readModel(file);
        ASSERT_TRUE(model) << model.error().message;
        Pose pose;
        poseModel(*model, 0, 0.37f, true, pose);
        SCOPED_TRACE(c.file);
        compare(*model, pose, c.size);
    }
}

}  // namespace
}  // namespace shoal::frame
