#include <gtest/gtest.h>
#include <shoal/light/view.h>

namespace shoal::light {
namespace {

Vec2 pixelOf(const View& view, Vec3 world) {
    const Vec4 clip = view.clipFromWorld() * Vec4{world.x, world.y, world.z, 1};
    return {(clip.x / clip.w * 0.5f + 0.5f) * float(view.width), (0.5f - clip.y / clip.w * 0.5f) * float(view.height)};
}

TEST(View, TargetIsInTheMiddleAndUpIsUp) {
    const View view = makeView(cameraLookingAt({4, 3, 5}, {1, 2, -1}, radians(40)), 320, 200);
    const Vec2 middle = pixelOf(view, {1, 2, -1});
    EXPECT_NEAR(middle.x, 160, 1e-3);
    EXPECT_NEAR(middle.y, 100, 1e-3);
    EXPECT_LT(pixelOf(view, {1, 2.5f, -1}).y, 99);
    EXPECT_EQ(view.eye, (Vec3{4, 3, 5}));
}

TEST(View, FieldOfViewReachesTheEdge) {
    const View view = makeView(cameraLookingAt({0, 0, 0}, {0, 0, -1}, radians(60)), 100, 100);
    const Vec2 edge = pixelOf(view, {0, std::tan(radians(30)) * 7, -7});
    EXPECT_NEAR(edge.y, 0, 1e-3);
}

TEST(View, InversesAreInverses) {
    Camera camera = cameraLookingAt({40, 3, -500}, {1, 2, -1}, radians(40));
    for (const auto kind : {Camera::Projection::perspective, Camera::Projection::orthographic}) {
        camera.projection = kind;
        const View view = makeView(camera, 640, 360);
        const Mat4 a = view.viewFromWorld * view.worldFromView, b = view.clipFromView * view.viewFromClip;
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 4; ++column) {
                EXPECT_NEAR(a(row, column), row == column, 2e-4);
                EXPECT_NEAR(b(row, column), row == column, 1e-4);
            }
    }
}

TEST(View, IntrinsicsPutTheAxisOnThePrincipalPoint) {
    Camera camera = cameraLookingAt({0, 0, 0}, {0, 0, -1}, radians(50));
    camera.intrinsics = Intrinsics{500, 520, 300, 210, 640, 480};
    const View view = makeView(camera, 640, 480);
    const Vec2 axis = pixelOf(view, {0, 0, -3});
    EXPECT_NEAR(axis.x, 300, 1e-3);
    EXPECT_NEAR(axis.y, 210, 1e-3);
    const Vec2 aside = pixelOf(view, {1, -1, -10});  // right and down
    EXPECT_NEAR(aside.x, 350, 1e-3);
    EXPECT_NEAR(aside.y, 262, 1e-3);
    // The same camera drawn at half the size sees the same picture.
    const Vec2 half = pixelOf(makeView(camera, 320, 240), {1, -1, -10});
    EXPECT_NEAR(half.x, 175, 1e-3);
}

TEST(View, OrthographicHeightIsMetres) {
    Camera camera = cameraLookingAt({0, 0, 10}, {0, 0, 0}, 1);
    camera.projection = Camera::Projection::orthographic;
    camera.heightM = 4;
    const View view = makeView(camera, 200, 100);
    EXPECT_TRUE(view.orthographic);
    EXPECT_NEAR(pixelOf(view, {0, 2, 0}).y, 0, 1e-3);
    EXPECT_NEAR(pixelOf(view, {4, 0, -50}).x, 200, 1e-3);
}

TEST(View, JitterMovesByPixelsAtEveryDepth) {
    Camera camera = cameraLookingAt({0, 0, 0}, {0, 0, -1}, radians(50));
    for (const auto kind : {Camera::Projection::perspective, Camera::Projection::orthographic}) {
        camera.projection = kind;
        View view = makeView(camera, 320, 180);
        View moved = view;
        moved.clipFromView = jittered(view, 0.25f, -0.5f);
        for (const float depth : {1.0f, 30.0f}) {
            const Vec3 point{0.1f * depth, -0.05f * depth, -depth};
            EXPECT_NEAR(pixelOf(moved, point).x - pixelOf(view, point).x, 0.25f, 1e-3);
            EXPECT_NEAR(pixelOf(moved, point).y - pixelOf(view, point).y, 0.5f, 1e-3);  // y counts down in pixels
        }
    }
}

}  // namespace
}  // namespace shoal::light
