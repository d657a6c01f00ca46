// Keyframe interpolation against glTF 2.0 appendix C, hierarchies, skins, morph weights, and exact posed bounds.
#include <oneapi/tbb/task_arena.h>
#include <shoal/core/parallel.h>
#include <shoal/core/pose.h>
#include <shoal/core/random.h>
#include <limits>

#include <gtest/gtest.h>

namespace shoal {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

void expectNear(Vec3 a, Vec3 b, float tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

Vec3 origin(const Pose& pose, std::size_t node) { return transformPoint(pose.modelFromNode[node], {0, 0, 0}); }

// One node and one clip with one channel.
Model oneChannel(ChannelTarget target, Interpolation interpolation, std::vector<float> times,
                 std::vector<float> values) {
    Model model;
    model.nodes.resize(1);
    Clip clip;
    clip.name = "Walk";
    clip.duration = times.empty() ? 0 : times.back();
    clip.channels.push_back({0, target, interpolation, std::move(times), std::move(values)});
    model.clips.push_back(clip);
    return model;
}

Pose poseAt(const Model& model, float time, bool loop = false, int clip = 0) {
    Pose pose;
    poseModel(model, clip, time, loop, pose);
    return pose;
}

TEST(FindClip, ExactNameBeforeIgnoringCase) {
    Model model;
    model.clips.resize(3);
    model.clips[0].name = "WALK";
    model.clips[1].name = "walk";
    model.clips[2].name = "Run";
    EXPECT_EQ(findClip(model, "walk"), 1);
    EXPECT_EQ(findClip(model, "Walk"), 0);
    EXPECT_EQ(findClip(model, "run"), 2);
    EXPECT_EQ(findClip(model, "ru"), -1);
    EXPECT_EQ(findClip(Model{}, ""), -1);
}

TEST(PoseModel, WithoutAClipNodesHaveTheirOwnTransforms) {
    Model model;
    model.nodes.resize(2);
    model.nodes[0].translation = {1, 2, 3};
    model.nodes[0].rotation = axisAngle({0, 0, 1}, kPi / 2);
    model.nodes[0].scale = {2, 2, 2};
    model.nodes[1].parent = 0;
    model.nodes[1].translation = {1, 0, 0};
    const Pose pose = poseAt(model, 5, true, -1);
    expectNear(origin(pose, 0), {1, 2, 3}, 1e-6f);
    expectNear(origin(pose, 1), {1, 4, 3}, 1e-6f);  // two along the parent's x, which points up
    expectNear(transformPoint(pose.modelFromNode[1], {0, 1, 0}), {-1, 4, 3}, 1e-6f);
}

TEST(PoseModel, StepHoldsTheEarlierKey) {
    const Model model =
        oneChannel(ChannelTarget::translation, Interpolation::step, {1, 2, 3}, {1, 0, 0, 2, 0, 0, 3, 0, 0});
    EXPECT_EQ(origin(poseAt(model, 1.999f), 0).x, 1);
    EXPECT_EQ(origin(poseAt(model, 2), 0).x, 2);
    EXPECT_EQ(origin(poseAt(model, 2.5f), 0).x, 2);
    EXPECT_EQ(origin(poseAt(model, 3), 0).x, 3);
}

TEST(PoseModel, LinearBlendsAndHoldsBeyondTheEnds) {
    const Model model = oneChannel(ChannelTarget::scale, Interpolation::linear, {1, 3}, {1, 1, 1, 5, 3, 1});
    const auto scaleAt = [&](float t) { return transformDirection(poseAt(model, t).modelFromNode[0], {1, 1, 1}); };
    expectNear(scaleAt(0), {1, 1, 1}, 0);
    expectNear(scaleAt(2), {3, 2, 1}, 1e-6f);
    expectNear(scaleAt(2.5f), {4, 2.5f, 1}, 1e-6f);
    expectNear(scaleAt(99), {5, 3, 1}, 0);
    expectNear(scaleAt(-99), {1, 1, 1}, 0);
}

TEST(PoseModel, LinearRotationIsSlerpOnTheShortArc) {
    const Vec3 axis = normalize(Vec3{1, 1, 0});
    const Quat a = axisAngle(axis, 0.1f), b = axisAngle(axis, 2.1f);
    for (const float sign : {1.0f, -1.0f}) {
        const Model model = oneChannel(ChannelTarget::rotation, Interpolation::linear, {0, 1},
                                       {a.x, a.y, a.z, a.w, sign * b.x, sign * b.y, sign * b.z, sign * b.w});
        for (const float t : {0.0f, 0.25f, 0.5f, 0.9f, 1.0f})
            expectNear(transformPoint(poseAt(model, t).modelFromNode[0], {0, 0, 3}),
                       rotate(axisAngle(axis, 0.1f + 2 * t), {0, 0, 3}), 3e-6f);
    }
}

// A Hermite spline reproduces every cubic polynomial exactly, with keys at unequal distances.
TEST(PoseModel, CubicSplineReproducesCubicPolynomials) {
    const auto f = [](float t) { return Vec3{t * t * t - 2 * t * t + 3, 2 * t * t - t, -t}; };
    const auto slope = [](float t) { return Vec3{3 * t * t - 4 * t, 4 * t - 1, -1}; };
    const std::vector<float> times{0.5f, 1, 2.5f};
    std::vector<float> values;
    for (const float t : times)
        for (const Vec3 v : {slope(t), f(t), slope(t)}) values.insert(values.end(), {v.x, v.y, v.z});
    const Model model = oneChannel(ChannelTarget::translation, Interpolation::cubicSpline, times, values);
    for (float t = 0.5f; t <= 2.5f; t += 0.125f) expectNear(origin(poseAt(model, t), 0), f(t), 1e-5f);
    expectNear(origin(poseAt(model, 0), 0), f(0.5f), 1e-6f);
    expectNear(origin(poseAt(model, 9), 0), f(2.5f), 1e-6f);
}

// Only the out-tangent of the earlier and the in-tangent of the later key count.
TEST(PoseModel, CubicSplineTakesTheRightTangents) {
    const Model model = oneChannel(ChannelTarget::translation, Interpolation::cubicSpline, {0, 2},
                                   {99, 0, 0, 0, 0, 0, 1, 0, 0, -3, 0, 0, 0, 0, 0, 99, 0, 0});
    // td (t^3 - 2 t^2 + t) b + td (t^3 - t^2) a at t = 1/2: 2/8 * 1 - 2/8 * -3
    EXPECT_NEAR(origin(poseAt(model, 1), 0).x, 1, 1e-6);
}

TEST(PoseModel, CubicSplineRotationIsNormalised) {
    const Quat a = axisAngle({0, 1, 0}, 0), b = axisAngle({0, 1, 0}, 2);
    const Model model =
        oneChannel(ChannelTarget::rotation, Interpolation::cubicSpline, {0, 1},
                   {0, 0, 0, 0, a.x, a.y, a.z, a.w, 0, 0, 0, 0, 0, 0, 0, 0, b.x, b.y, b.z, b.w, 0, 0, 0, 0});
    const Mat4 half = poseAt(model, 0.5f).modelFromNode[0];
    EXPECT_NEAR(determinant3(half), 1, 1e-5);
    expectNear(transformPoint(half, {0, 0, 1}), rotate(axisAngle({0, 1, 0}, 1), {0, 0, 1}), 1e-6f);  // by symmetry
}

TEST(PoseModel, ASingleKeyHoldsForAllTimes) {
    for (const Interpolation i : {Interpolation::step, Interpolation::linear}) {
        const Model model = oneChannel(ChannelTarget::translation, i, {0.7f}, {1, 2, 3});
        for (const float t : {-1.0f, 0.0f, 0.7f, 5.0f}) EXPECT_EQ(origin(poseAt(model, t), 0), (Vec3{1, 2, 3}));
        EXPECT_EQ(origin(poseAt(model, 5, true), 0), (Vec3{1, 2, 3}));
    }
    const Model spline =
        oneChannel(ChannelTarget::translation, Interpolation::cubicSpline, {0}, {9, 9, 9, 1, 2, 3, 9, 9, 9});
    EXPECT_EQ(origin(poseAt(spline, 4, true), 0), (Vec3{1, 2, 3}));
}

TEST(PoseModel, AShorterChannelHoldsItsLastKeyWhileTheClipGoesOn) {
    Model model = oneChannel(ChannelTarget::translation, Interpolation::linear, {0, 1}, {1, 0, 0, 2, 0, 0});
    model.clips[0].channels.push_back({0, ChannelTarget::scale, Interpolation::linear, {0, 4}, {1, 1, 1, 5, 5, 5}});
    model.clips[0].duration = 4;
    for (const float t : {1.0f, 1.5f, 3.0f}) EXPECT_EQ(origin(poseAt(model, t), 0).x, 2);
    EXPECT_EQ(determinant3(poseAt(model, 4).modelFromNode[0]), 125);
    model.clips[0].duration = 0;  // not told: the beginning
    EXPECT_EQ(origin(poseAt(model, 3, true), 0).x, 1);
}

TEST(PoseModel, AChannelWithoutKeysChangesNothing) {
    Model model = oneChannel(ChannelTarget::translation, Interpolation::linear, {}, {});
    model.nodes[0].translation = {4, 5, 6};
    EXPECT_EQ(origin(poseAt(model, 1), 0), (Vec3{4, 5, 6}));
}

TEST(PoseModel, LoopWrapsTimeBothWays) {
    const Model model = oneChannel(ChannelTarget::translation, Interpolation::linear, {0, 2}, {0, 0, 0, 2, 0, 0});
    EXPECT_NEAR(origin(poseAt(model, 2.5f, true), 0).x, 0.5, 1e-6);
    EXPECT_NEAR(origin(poseAt(model, 7.25f, true), 0).x, 1.25, 1e-6);
    EXPECT_NEAR(origin(poseAt(model, -0.5f, true), 0).x, 1.5, 1e-6);
    EXPECT_EQ(origin(poseAt(model, 2, true), 0).x, 0);
    EXPECT_EQ(origin(poseAt(model, 2.5f, false), 0).x, 2);
}

TEST(PoseModel, NanAndInfiniteTimesAreTheBeginning) {
    const Model model = oneChannel(ChannelTarget::translation, Interpolation::linear, {0, 2}, {1, 0, 0, 2, 0, 0});
    for (const float t : {kNan, std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()})
        for (const bool loop : {false, true}) EXPECT_EQ(origin(poseAt(model, t, loop), 0).x, 1);
}

TEST(PoseModel, PropertiesWithoutAChannelKeepTheNodesOwn) {
    Model model = oneChannel(ChannelTarget::translation, Interpolation::linear, {0, 2}, {1, 0, 0, 2, 0, 0});
    model.nodes[0].rotation = axisAngle({0, 0, 1}, kPi / 2);
    model.nodes[0].scale = {3, 1, 1};
    expectNear(transformPoint(poseAt(model, 0).modelFromNode[0], {1, 0, 0}), {1, 3, 0}, 1e-6f);
}

TEST(PoseModel, ReusedStorageGivesTheSamePose) {
    Model model = oneChannel(ChannelTarget::translation, Interpolation::linear, {0, 2}, {1, 0, 0, 2, 0, 0});
    model.nodes.resize(3);
    model.nodes[1].parent = 0;
    Pose pose;
    poseModel(model, 0, 1.7f, false, pose);
    const Mat4* storage = pose.modelFromNode.data();
    poseModel(model, 0, 0.3f, false, pose);
    EXPECT_EQ(pose.modelFromNode.data(), storage);
    EXPECT_EQ(pose.modelFromNode, poseAt(model, 0.3f).modelFromNode);
}

// A mesh of one primitive with two morph targets.
Model morphing() {
    Model model = oneChannel(ChannelTarget::morphWeights, Interpolation::linear, {0, 1}, {0, 0, 1, 0.5f});
    Primitive primitive;
    primitive.positions = {{0, 0, 0}, {1, 0, 0}};
    primitive.morphTargets.resize(2);
    primitive.morphTargets[0].positions = {{0, 2, 0}, {0, 0, 0}};
    primitive.morphTargets[1].positions = {{0, 0, 0}, {4, 0, 0}};
    model.meshes.push_back({"face", {primitive}, {0.25f, 0.75f}});
    model.nodes[0].mesh = 0;
    return model;
}

TEST(PoseModel, MorphWeightsComeFromChannelNodeOrMesh) {
    Model model = morphing();
    using Weights = std::vector<float>;
    EXPECT_EQ(poseAt(model, 0, false, -1).morphWeights[0], (Weights{0.25f, 0.75f}));
    model.nodes[0].morphWeights = {0.1f, 0.2f};
    EXPECT_EQ(poseAt(model, 0, false, -1).morphWeights[0], (Weights{0.1f, 0.2f}));
    EXPECT_EQ(poseAt(model, 0.5f).morphWeights[0], (Weights{0.5f, 0.25f}));
    model.nodes[0].morphWeights.clear();
    model.meshes[0].morphWeights.clear();
    EXPECT_EQ(poseAt(model, 0, false, -1).morphWeights[0], (Weights{0, 0}));
    model.clips[0].channels[0].interpolation = Interpolation::cubicSpline;
    model.clips[0].channels[0].values = {0, 0, 1, 2, 0, 0, 0, 0, 3, 6, 0, 0};
    EXPECT_EQ(poseAt(model, 0.5f).morphWeights[0], (Weights{2, 4}));
}

TEST(PoseModel, MorphChannelOfAnotherTargetCountIsMatchedByIndex) {
    Model model = morphing();
    model.clips[0].channels[0].values = {0, 0, 0, 1, 2, 3};  // three weights a key, two targets
    EXPECT_EQ(poseAt(model, 0.5f).morphWeights[0], (std::vector<float>{0.5f, 1}));
    model.clips[0].channels[0].values = {0, 1};  // one weight a key: the other keeps its default
    EXPECT_EQ(poseAt(model, 0.5f).morphWeights[0], (std::vector<float>{0.5f, 0.75f}));
}

TEST(PoseModelDeathTest, RefusesBrokenModels) {
    Model cycle;
    cycle.nodes.resize(2);
    cycle.nodes[0].parent = 1;
    EXPECT_DEATH(poseAt(cycle, 0, false, -1), "parent < int\\(i\\)");
    EXPECT_DEATH(poseAt(oneChannel(ChannelTarget::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1}), 0),
                 "keySize");
    EXPECT_DEATH(poseAt(Model{}, 0, false, 0), "clip");
}

// A column of vertices on a chain of two joints at y = 0 and y = 1, each fully or half bound.
Model skinnedModel(std::size_t vertexCount) {
    Model model;
    model.nodes.resize(3);
    model.nodes[1].parent = 0;
    model.nodes[1].translation = {0, 1, 0};
    model.nodes[2].mesh = 0;
    model.nodes[2].skin = 0;
    model.nodes[2].translation = {50, 50, 50};  // of no effect: a skinned mesh hangs on its joints alone
    model.skins.push_back({"skin", {0, 1}, {Mat4{}, translation({0, -1, 0})}});
    Primitive primitive;
    for (std::uint32_t i = 0; i < vertexCount; ++i) {
        primitive.positions.push_back({randomFloat(1, i, 0), 2 * randomFloat(1, i, 1), randomFloat(1, i, 2)});
        const float w = randomFloat(1, i, 3);
        primitive.joints.push_back({0, 1, 0, 0});
        primitive.weights.push_back({w, 1 - w, 0, 0});
    }
    primitive.morphTargets.resize(1);
    for (std::uint32_t i = 0; i < vertexCount; ++i)
        primitive.morphTargets[0].positions.push_back({0, 0, randomFloat(2, i)});
    model.meshes.push_back({"column", {primitive}, {0.5f}});
    Clip clip{"bend", 1, {}};
    const Quat q = axisAngle({0, 0, 1}, 1.2f);
    clip.channels.push_back(
        {1, ChannelTarget::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, q.x, q.y, q.z, q.w}});
    model.clips.push_back(clip);
    return model;
}

TEST(PoseModel, BindPoseLeavesVerticesWhereTheyAre) {
    const Pose pose = poseAt(skinnedModel(1), 0);
    ASSERT_EQ(pose.modelFromBind.size(), 1u);
    for (const Mat4& m : pose.modelFromBind[0]) EXPECT_EQ(m, Mat4{});
}

TEST(PosedBounds, AreThoseOfEveryVertexSkinnedWithItsMorphs) {
    const Model model = skinnedModel(20000);
    const Pose pose = poseAt(model, 1);
    const Primitive& primitive = model.meshes[0].primitives[0];
    const Quat q = axisAngle({0, 0, 1}, 1.2f);
    Bounds expected;
    for (std::size_t i = 0; i < primitive.vertexCount(); ++i) {
        const Vec3 p = primitive.positions[i] + primitive.morphTargets[0].positions[i] * 0.5f;
        const Vec3 bent = rotate(q, p - Vec3{0, 1, 0}) + Vec3{0, 1, 0};
        expected.add(p * primitive.weights[i].x + bent * primitive.weights[i].y);
    }
    const Bounds bounds = posedBounds(model, pose);
    expectNear(bounds.lo, expected.lo, 1e-5f);
    expectNear(bounds.hi, expected.hi, 1e-5f);
}

// The same vertices one by one.
TEST(PosedPositions, AreSkinnedWithTheirMorphsOrMovedWithTheirNode) {
    const Model model = skinnedModel(5000);
    const Primitive& primitive = model.meshes[0].primitives[0];
    int node = 0;
    while (model.nodes[std::size_t(node)].mesh < 0) ++node;
    const std::vector<Vec3> positions = posedPositions(model, poseAt(model, 1), node, primitive);
    ASSERT_EQ(positions.size(), primitive.vertexCount());
    const Quat q = axisAngle({0, 0, 1}, 1.2f);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vec3 p = primitive.positions[i] + primitive.morphTargets[0].positions[i] * 0.5f;
        const Vec3 bent = rotate(q, p - Vec3{0, 1, 0}) + Vec3{0, 1, 0};
        expectNear(positions[i], p * primitive.weights[i].x + bent * primitive.weights[i].y, 1e-5f);
    }
    Model moved = morphing();
    moved.nodes[0].translation = {10, 0, 0};
    Bounds bounds;
    for (const Vec3 p : posedPositions(moved, poseAt(moved, 1), 0, moved.meshes[0].primitives[0])) bounds.add(p);
    EXPECT_EQ(bounds.lo, posedBounds(moved, poseAt(moved, 1)).lo);
    EXPECT_EQ(bounds.hi, posedBounds(moved, poseAt(moved, 1)).hi);
}

TEST(PosedBounds, SameBitsForAnyThreadCount) {
    const Model model = skinnedModel(50000);
    const Pose pose = poseAt(model, 0.7f);
    const Bounds all = posedBounds(model, pose);
    for (const int threadCount : {1, 2, 8}) {
        const ThreadLimit limit(threadCount);
        tbb::task_arena arena(threadCount);
        const Bounds some = arena.execute([&] { return posedBounds(model, pose); });
        EXPECT_EQ(some.lo, all.lo);
        EXPECT_EQ(some.hi, all.hi);
    }
}

TEST(PosedBounds, UnskinnedMeshesMoveWithTheirNode) {
    Model model = morphing();
    model.nodes[0].translation = {10, 0, 0};
    model.nodes[0].scale = {1, -1, 1};
    const Bounds bounds = posedBounds(model, poseAt(model, 1));  // weights 1 and 0.5
    EXPECT_EQ(bounds.lo, (Vec3{10, -2, 0}));
    EXPECT_EQ(bounds.hi, (Vec3{13, 0, 0}));
}

TEST(PosedBounds, NanPositionsAreLeftOutAndNothingIsEmpty) {
    Model model = morphing();
    model.meshes[0].primitives[0].positions[1] = {kNan, kNan, kNan};
    const Bounds bounds = posedBounds(model, poseAt(model, 0));
    EXPECT_EQ(bounds.lo, (Vec3{0, 0, 0}));
    EXPECT_EQ(bounds.hi, (Vec3{0, 0, 0}));
    EXPECT_TRUE(posedBounds(Model{}, Pose{}).empty());
}

}  // namespace
}  // namespace shoal
