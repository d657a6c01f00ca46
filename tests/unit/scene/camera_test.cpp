// Cameras and walks against positions worked out by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <shoal/scene/content.h>

namespace shoal::scene {
namespace {

light::Camera cameraOf(std::string_view text, float time, const Content& content = {}) {
    auto scene = parseScene(text, "test.toml");
    EXPECT_TRUE(scene) << scene.error().message;
    return cameraAt(*scene, content, time, 16.0f / 9);
}

Vec3 ahead(const light::Camera& camera) { return transformDirection(camera.worldFromView, {0, 0, -1}); }

void expectNear(Vec3 a, Vec3 b, float tolerance = 1e-4f) {
    EXPECT_LT(length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(SceneCamera, FixedLooksAtItsTarget) {
    const light::Camera camera = cameraOf("[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\nfovDeg = 40\n", 3);
    expectNear(camera.position(), {0, 0, 5});
    expectNear(ahead(camera), {0, 0, -1});
    EXPECT_NEAR(camera.verticalFov, radians(40), 1e-6);
}

TEST(SceneCamera, RollTurnsThePicture) {
    const light::Camera camera = cameraOf("[camera]\nposition = [0, 0, 5]\ntarget = [0, 0, 0]\nrollDeg = 90\n", 0);
    // Turned clockwise, the camera's up points to the right of what was up: +x.
    expectNear(transformDirection(camera.worldFromView, {0, 1, 0}), {1, 0, 0});
}

TEST(SceneCamera, OrbitGoesRound) {
    const char* text =
        "[camera]\norbit = { center = [1, 2, 3], radius = 4, elevationDeg = 0, startDeg = 0, degPerSecond = 90 }\n";
    expectNear(cameraOf(text, 0).position(), {1, 2, 7});
    expectNear(cameraOf(text, 1).position(), {5, 2, 3});
    expectNear(ahead(cameraOf(text, 1)), {-1, 0, 0});
}

TEST(SceneCamera, PathPassesItsKeysAndIsSmooth) {
    const char* text =
        "[camera]\npath = [ {time = 0, position = [0, 0, 0], target = [0, 0, -1]}, {time = 2, position = [4, 0, 0], "
        "target = [4, 0, -1]},"
        " {time = 4, position = [4, 0, 8], target = [4, 0, 7]} ]\n";
    expectNear(cameraOf(text, -5).position(), {0, 0, 0});
    expectNear(cameraOf(text, 2).position(), {4, 0, 0});
    expectNear(cameraOf(text, 9).position(), {4, 0, 8});
    const float h = 1e-2f;
    const Vec3 before = (cameraOf(text, 2).position() - cameraOf(text, 2 - h).position()) / h;
    const Vec3 after = (cameraOf(text, 2 + h).position() - cameraOf(text, 2).position()) / h;
    EXPECT_LT(length(before - after), 0.2f);
}

TEST(SceneCamera, FittedHoldsAllCorners) {
    Content content;
    content.focus.add(Vec3{-3, 0, -2});
    content.focus.add(Vec3{5, 7, 4});
    content.focusBoxes = {content.focus};
    const light::View view = light::makeView(cameraOf("", 0, content), 1600, 900);
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? 5.0f : -3.0f, corner & 2 ? 7.0f : 0.0f, corner & 4 ? 4.0f : -2.0f};
        const Vec3 clip = transformPoint(view.clipFromWorld(), p);
        EXPECT_LT(std::abs(clip.x), 1) << corner;
        EXPECT_LT(std::abs(clip.y), 1) << corner;
    }
}

TEST(SceneCamera, FittedPutsWhatIsSeenInTheMiddle) {
    Content content;
    content.focus.add(Vec3{-1, 0, -9});
    content.focus.add(Vec3{1, 4, 9});
    content.focusBoxes = {content.focus};
    const light::View view = light::makeView(cameraOf("", 0, content), 1600, 900);
    Vec3 lo{1, 1, 1}, hi{-1, -1, -1};
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? 1.0f : -1.0f, corner & 2 ? 4.0f : 0.0f, corner & 4 ? 9.0f : -9.0f};
        const Vec3 clip = transformPoint(view.clipFromWorld(), p);
        lo = {std::min(lo.x, clip.x), std::min(lo.y, clip.y), 0};
        hi = {std::max(hi.x, clip.x), std::max(hi.y, clip.y), 0};
    }
    EXPECT_NEAR(lo.x, -hi.x, 0.01f);
    EXPECT_NEAR(lo.y, -hi.y, 0.01f);
    EXPECT_GT(std::max(hi.x, hi.y), 0.85f);
}

TEST(SceneContent, LooksAtThingsAndNotAtGroundOrPebbles) {
    auto scene = parseScene(
        "[[shape]]\nkind = \"plane\"\nwidth = 200\ndepth = 200\n"
        "[[shape]]\nkind = \"sphere\"\nradius = 3\n"
        "[[shape]]\nkind = \"box\"\nsize = [0.2, 0.2, 0.2]\nposition = [60, 0, 0]\n",
        "unit.toml");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto content = loadContent(*scene);
    ASSERT_TRUE(content) << content.error().message;
    EXPECT_NEAR(content->bounds.size().x, 200, 1e-3f);
    EXPECT_NEAR(content->focus.size().x, 6, 1e-2f);
    EXPECT_NEAR(content->focus.size().z, 6, 1e-2f);
}

// The ground under a bare model is there for a jetty as for a figure, and not for a place that has one.
TEST(SceneContent, BareModelsStandOnGround) {
    const std::filesystem::path data = SHOAL_DATA_DIR;
    if (!std::filesystem::exists(data / "scenes")) GTEST_SKIP() << "no " << data;
    for (const auto& [file, expected] :
         {std::pair{"scenes/props/Dock_Long.glb", true}, std::pair{"scenes/props/CruiseShip.glb", true},
          std::pair{"characters/CesiumMan.glb", true}, std::pair{"scenes/town_street.glb", false},
          std::pair{"scenes/harbour.glb", false}, std::pair{"scenes/village_square.glb", false},
          std::pair{"scenes/sunken_ruin.glb", false}}) {
        auto scene = sceneForModel(data / file);
        ASSERT_TRUE(scene) << scene.error().message;
        const auto content = loadContent(*scene);
        ASSERT_TRUE(content) << content.error().message;
        EXPECT_EQ(content->instances.back().name == "ground", expected) << file;
    }
}

TEST(SceneWalk, FollowsItsPointsFacingForward) {
    Instance instance;
    instance.walk = WalkSpec{{{0, 0, 0}, {10, 0, 0}, {10, 0, 10}}, 2, false};
    expectNear(transformPoint(transformAt(instance, 0), {}), {0, 0, 0});
    expectNear(transformPoint(transformAt(instance, 2), {}), {4, 0, 0});
    expectNear(transformDirection(transformAt(instance, 2), {0, 0, 1}), {1, 0, 0});
    expectNear(transformPoint(transformAt(instance, 7), {}), {10, 0, 4});
    expectNear(transformDirection(transformAt(instance, 7), {0, 0, 1}), {0, 0, 1});
    expectNear(transformPoint(transformAt(instance, 100), {}), {10, 0, 10});
    instance.walk->loop = true;
    const float round = (10 + 10 + std::sqrt(200.0f)) / 2;
    expectNear(transformPoint(transformAt(instance, 2 + round), {}), {4, 0, 0}, 1e-3f);
}

TEST(SceneWalk, HeadingNeverJumps) {
    Instance instance;
    instance.walk = WalkSpec{{{0, 0, 0}, {3, 0, 0}, {3, 0, 3}, {0, 0, 3}}, 1, true};
    Vec3 last = transformDirection(transformAt(instance, 0), {0, 0, 1});
    for (int i = 1; i < 1500; ++i) {
        const Vec3 now = transformDirection(transformAt(instance, float(i) * 0.01f), {0, 0, 1});
        EXPECT_GT(dot(last, now), 0.99f) << i;
        last = now;
    }
}

}  // namespace
}  // namespace shoal::scene
