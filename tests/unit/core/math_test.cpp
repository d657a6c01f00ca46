// Matrices, rotations, projections and the sRGB curve against their definitions.
#include <shoal/core/math.h>
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

void expectNear(const Mat4& a, const Mat4& b, float tolerance) {
    for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(a.m[i], b.m[i], tolerance) << "element " << i;
}

float uniform(std::uint32_t i, float lo, float hi) { return lo + (hi - lo) * randomFloat(77, i); }

Quat someRotation(std::uint32_t i) {
    return normalize(Quat{uniform(i, -1, 1), uniform(i + 1, -1, 1), uniform(i + 2, -1, 1), uniform(i + 3, -1, 1)});
}

Mat4 someTransform(std::uint32_t i) {
    return compose({uniform(i, -9, 9), uniform(i + 1, -9, 9), uniform(i + 2, -9, 9)}, someRotation(i + 3),
                   {uniform(i + 7, 0.3f, 3), uniform(i + 8, 0.3f, 3), uniform(i + 9, -3, -0.3f)});
}

// Window coordinates, x right and y down from the top left corner, as glViewport with a lower left origin makes them.
Vec3 pixelOf(const Mat4& clipFromView, Vec3 viewPoint, float width, float height) {
    const Vec3 ndc = transformPoint(clipFromView, viewPoint);
    return {(ndc.x + 1) * 0.5f * width, (1 - ndc.y) * 0.5f * height, ndc.z};
}

TEST(Quat, AxisAngleTurnsRightHanded) {
    const float quarter = kPi / 2;
    expectNear(rotate(axisAngle({0, 0, 1}, quarter), {1, 0, 0}), {0, 1, 0}, 1e-6f);
    expectNear(rotate(axisAngle({1, 0, 0}, quarter), {0, 1, 0}), {0, 0, 1}, 1e-6f);
    expectNear(rotate(axisAngle({0, 1, 0}, quarter), {0, 0, 1}), {1, 0, 0}, 1e-6f);
}

TEST(Quat, ProductAppliesTheRightOneFirst) {
    for (std::uint32_t i = 0; i < 20; ++i) {
        const Quat a = someRotation(10 * i), b = someRotation(10 * i + 5);
        const Vec3 v{1, -2, 0.5f};
        expectNear(rotate(a * b, v), rotate(a, rotate(b, v)), 2e-6f);
        expectNear(rotation(a * b), rotation(a) * rotation(b), 2e-6f);
        expectNear(transformDirection(rotation(a), v), rotate(a, v), 2e-6f);
    }
}

TEST(Quat, EulerAnglesTurnAboutXThenYThenZ) {
    const Vec3 angles{0.4f, -1.1f, 2.0f}, v{1, 2, 3};
    const Vec3 byX = rotate(axisAngle({1, 0, 0}, angles.x), v);
    const Vec3 byXy = rotate(axisAngle({0, 1, 0}, angles.y), byX);
    expectNear(rotate(eulerXyz(angles), v), rotate(axisAngle({0, 0, 1}, angles.z), byXy), 2e-6f);
}

TEST(Quat, OfAMatrixTurnsAsTheMatrixDoes) {
    for (std::uint32_t i = 0; i < 200; ++i) {
        const Quat q = someRotation(7 * i), back = quatOf(rotation(q));
        EXPECT_NEAR(std::abs(q.x * back.x + q.y * back.y + q.z * back.z + q.w * back.w), 1, 1e-6);
        expectNear(rotate(back, {1, -2, 0.5f}), rotate(q, {1, -2, 0.5f}), 4e-6f);
    }
    // Half turns, where w is 0: each of the other three components is the largest once.
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, normalize(Vec3{1, 2, -3})}) {
        const Quat half{axis.x, axis.y, axis.z, 0};
        expectNear(rotate(quatOf(rotation(half)), {3, 1, -2}), rotate(half, {3, 1, -2}), 4e-6f);
    }
    EXPECT_EQ(quatOf(Mat4{}), Quat{});
    EXPECT_EQ(quatOfAxes({{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}), axisAngle({0, 0, 1}, kPi / 2));
}

TEST(Quat, NormalizeOfZeroOrNanIsTheIdentity) {
    EXPECT_EQ(normalize(Quat{0, 0, 0, 0}), Quat{});
    EXPECT_EQ(normalize(Quat{kNan, 0, 0, 1}), Quat{});
}

TEST(Quat, SlerpHasConstantSpeedOnTheShortArc) {
    const Vec3 axis = normalize(Vec3{1, 2, -1});
    const Quat a = axisAngle(axis, 0.2f);
    for (const float arc : {2.5f, 0.3f, 0.01f, 1e-4f}) {
        const Quat b = axisAngle(axis, 0.2f + arc);
        for (float t = 0; t <= 1; t += 0.125f) {
            const Quat expected = axisAngle(axis, 0.2f + arc * t);
            const Quat direct = slerp(a, b, t), negated = slerp(a, {-b.x, -b.y, -b.z, -b.w}, t);
            expectNear(rotate(direct, {3, -1, 2}), rotate(expected, {3, -1, 2}), 3e-6f);
            expectNear(rotate(negated, {3, -1, 2}), rotate(expected, {3, -1, 2}), 3e-6f);
        }
    }
}

TEST(Quat, SlerpBetweenOppositeRotationsStaysFinite) {
    const Quat q = slerp({0, 0, 0, 1}, {0, 1, 0, 0}, 0.5f);  // half a turn: either way round is right
    EXPECT_NEAR(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w, 1, 1e-6);
    expectNear(rotate(q, {0, 1, 0}), {0, 1, 0}, 1e-6f);
}

TEST(Mat4, ComposeScalesThenTurnsThenMoves) {
    const Quat q = someRotation(3);
    const Mat4 a = compose({1, 2, 3}, q, {2, 3, 4});
    expectNear(a, translation({1, 2, 3}) * rotation(q) * scaling({2, 3, 4}), 1e-6f);
    expectNear(transformPoint(a, {1, 1, 1}), rotate(q, {2, 3, 4}) + Vec3{1, 2, 3}, 2e-6f);
}

TEST(Mat4, InverseTimesMatrixIsTheIdentity) {
    for (std::uint32_t i = 0; i < 50; ++i) {
        const Mat4 a = someTransform(20 * i);
        const auto b = inverse(a);
        ASSERT_TRUE(b);
        expectNear(*b * a, Mat4{}, 2e-5f);
    }
    const Mat4 clip = perspectiveReversed(1, 1.5f, 0.01f);
    expectNear(*inverse(clip) * clip, Mat4{}, 1e-6f);
    Mat4 general;  // no zero anywhere: every cofactor counts
    for (std::uint32_t i = 0; i < 16; ++i) general.m[i] = uniform(900 + i, -1, 1);
    expectNear(*inverse(general) * general, Mat4{}, 1e-5f);
    expectNear(general * *inverse(general), Mat4{}, 1e-5f);
}

TEST(Mat4, InverseOfASingularOrNanMatrixIsNothing) {
    EXPECT_FALSE(inverse(scaling({1, 0, 1})));
    EXPECT_FALSE(inverse(scaling({1e-12f, 1e-12f, 1e-12f})));
    EXPECT_TRUE(inverse(scaling({1e-6f, 1e-6f, 1e-6f})));
    Mat4 bad;
    bad(1, 2) = kNan;
    bad(2, 1) = 1;
    EXPECT_FALSE(inverse(bad));
}

TEST(Mat4, TransposeSwapsRowsAndColumns) {
    const Mat4 a = someTransform(5);
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) EXPECT_EQ(transpose(a)(r, c), a(c, r));
}

TEST(Mat4, DeterminantIsTheVolumeAndNegativeForAMirror) {
    EXPECT_NEAR(determinant3(compose({5, 5, 5}, someRotation(1), {2, 3, 4})), 24, 1e-4);
    EXPECT_NEAR(determinant3(scaling({-2, 3, 4})), -24, 1e-5);
}

// A normal is what stays perpendicular to the two edges, and points out of the body.
TEST(Mat4, NormalMatrixKeepsNormalsPerpendicularAndOutward) {
    const Vec3 edge1{1, 0.2f, -0.4f}, edge2{0.1f, 1, 0.3f}, inside{0, 0, 0};
    const Vec3 normal = normalize(cross(edge1, edge2)), onFace = normal * 2.0f;  // outward: away from `inside`
    for (const Vec3 scale : {Vec3{1, 5, 0.2f}, Vec3{-1, 1, 1}, Vec3{-1, -2, -3}, Vec3{1, -4, -1}}) {
        const Mat4 a = compose({3, 1, 2}, someRotation(8), scale);
        const Mat3 n = normalMatrix(a);
        const Vec3 turned{n.m[0] * normal.x + n.m[3] * normal.y + n.m[6] * normal.z,
                          n.m[1] * normal.x + n.m[4] * normal.y + n.m[7] * normal.z,
                          n.m[2] * normal.x + n.m[5] * normal.y + n.m[8] * normal.z};
        EXPECT_NEAR(dot(normalize(turned), normalize(transformDirection(a, edge1))), 0, 1e-5);
        EXPECT_NEAR(dot(normalize(turned), normalize(transformDirection(a, edge2))), 0, 1e-5);
        EXPECT_GT(dot(turned, transformPoint(a, onFace) - transformPoint(a, inside)), 0);
    }
}

TEST(LookAt, PutsTheTargetOnMinusZAndUpAbove) {
    const Vec3 eye{3, 2, 5}, target{-1, 0, 1};
    const Mat4 view = lookAt(eye, target, {0, 1, 0});
    expectNear(transformPoint(view, eye), {0, 0, 0}, 1e-6f);
    expectNear(transformPoint(view, target), {0, 0, -length(target - eye)}, 2e-6f);
    EXPECT_NEAR(transformDirection(view, {0, 1, 0}).x, 0, 1e-6);
    EXPECT_GT(transformDirection(view, {0, 1, 0}).y, 0);
    EXPECT_NEAR(determinant3(view), 1, 1e-5);
}

TEST(LookAt, FallsBackWhenUpIsOfNoUse) {
    struct Case {
        Vec3 target, up;
    };
    for (const Case c : {Case{{0, -5, 0}, {0, 1, 0}}, Case{{0, 5, 0}, {0, 1, 0}}, Case{{2, 0, 0}, {1, 0, 0}},
                         Case{{1, 2, 3}, {0, 0, 0}}, Case{{1, 2, 3}, {2, 4, 6}}, Case{{0, 0, 0}, {0, 1, 0}}}) {
        const Mat4 view = lookAt({0, 0, 0}, c.target, c.up);
        EXPECT_NEAR(determinant3(view), 1, 1e-5);
        expectNear(view * transpose(view), Mat4{}, 1e-5f);
        expectNear(transformPoint(view, c.target), {0, 0, -length(c.target)}, 1e-5f);
    }
    // Straight down, north (-z) is on top of the picture.
    expectNear(transformDirection(lookAt({0, 9, 0}, {0, 0, 0}, {0, 1, 0}), {0, 0, -1}), {0, 1, 0}, 1e-6f);
}

TEST(LookAt, KeepsUpVeryNearTheVertical) {
    const float angle = 1e-4f;  // radians from straight down, towards +x
    const Mat4 view = lookAt({0, 0, 0}, {std::sin(angle), -std::cos(angle), 0}, {0, 1, 0});
    EXPECT_GT(transformDirection(view, {1, 0, 0}).y, 0.99f);  // what lies ahead is on top
}

TEST(Projection, PerspectiveDepthIsOneAtNearAndZeroAtInfinity) {
    const float nearZ = 0.25f, fov = 1.1f, aspect = 1.6f;
    const Mat4 clip = perspectiveReversed(fov, aspect, nearZ);
    EXPECT_FLOAT_EQ(transformPoint(clip, {0, 0, -nearZ}).z, 1);
    EXPECT_FLOAT_EQ(transformPoint(clip, {0, 0, -10}).z, nearZ / 10);
    EXPECT_EQ((clip * Vec4{0, 0, -1, 0}).z, 0);  // a point at infinity straight ahead
    const float top = std::tan(fov / 2) * 7;
    expectNear(transformPoint(clip, {top * aspect, top, -7}), {1, 1, nearZ / 7}, 1e-6f);
    expectNear(transformPoint(clip, {-top * aspect, -top, -7}), {-1, -1, nearZ / 7}, 1e-6f);
}

TEST(Projection, CentredIntrinsicsAreThePerspective) {
    const float w = 1280, h = 720, fov = 0.9f, f = h / 2 / std::tan(fov / 2);
    expectNear(intrinsicsReversed(f, f, w / 2, h / 2, w, h, 0.1f), perspectiveReversed(fov, w / h, 0.1f), 1e-6f);
}

TEST(Projection, IntrinsicsAreThePinholeModelWithYDown) {
    const float fx = 800, fy = 780, cx = 300, cy = 400, w = 640, h = 720, nearZ = 0.1f;
    const Mat4 clip = intrinsicsReversed(fx, fy, cx, cy, w, h, nearZ);
    for (std::uint32_t i = 0; i < 20; ++i) {
        // The usual camera frame of vision: x right, y down, z ahead.
        const Vec3 p{uniform(5 * i, -2, 2), uniform(5 * i + 1, -2, 2), uniform(5 * i + 2, 1, 20)};
        const Vec3 pixel = pixelOf(clip, {p.x, -p.y, -p.z}, w, h);
        EXPECT_NEAR(pixel.x, fx * p.x / p.z + cx, 2e-3);
        EXPECT_NEAR(pixel.y, fy * p.y / p.z + cy, 2e-3);
        EXPECT_FLOAT_EQ(pixel.z, nearZ / p.z);
    }
}

TEST(Projection, OrthographicMapsItsBoxToClipSpace) {
    const Mat4 clip = orthographicReversed(-1, 5, -2, 4, 0.5f, 20);
    expectNear(transformPoint(clip, {-1, -2, -0.5f}), {-1, -1, 1}, 1e-6f);
    expectNear(transformPoint(clip, {5, 4, -20}), {1, 1, 0}, 1e-6f);
    expectNear(transformPoint(clip, {2, 1, -10.25f}), {0, 0, 0.5f}, 1e-6f);
}

TEST(ProjectionDeathTest, RefusesSenselessCameras) {
    EXPECT_DEATH(perspectiveReversed(0, 1, 0.1f), "verticalFov");
    EXPECT_DEATH(perspectiveReversed(1, 1, -1), "nearZ > 0 \\(left -1, right 0\\)");
    EXPECT_DEATH(orthographicReversed(1, 1, 0, 1, 0, 1), "left != right");
}

TEST(Bounds, TransformedBoxIsTheBoxOfItsCorners) {
    const Bounds box{{-1, 2, 0.5f}, {3, 4, 5}};
    for (std::uint32_t i = 0; i < 20; ++i) {
        const Mat4 a = someTransform(31 * i);
        Bounds corners;
        for (int k = 0; k < 8; ++k)
            corners.add(transformPoint(
                a, {k & 1 ? box.hi.x : box.lo.x, k & 2 ? box.hi.y : box.lo.y, k & 4 ? box.hi.z : box.lo.z}));
        expectNear(transformBounds(a, box).lo, corners.lo, 2e-5f);
        expectNear(transformBounds(a, box).hi, corners.hi, 2e-5f);
    }
}

TEST(Bounds, EmptyStaysEmptyAndNanPointsAreLeftOut) {
    EXPECT_TRUE(transformBounds(translation({1, 2, 3}), Bounds{}).empty());
    EXPECT_EQ(Bounds{}.size(), Vec3{});
    Bounds b;
    b.add(Vec3{kNan, kNan, kNan});
    EXPECT_TRUE(b.empty());
    b.add(Vec3{1, 2, 3});
    b.add(Vec3{kNan, 5, 0});
    EXPECT_EQ(b.lo, (Vec3{1, 2, 0}));
    EXPECT_EQ(b.hi, (Vec3{1, 5, 3}));
}

TEST(Srgb, KnownValuesAndRoundTrip) {
    EXPECT_FLOAT_EQ(srgbFromLinear(0), 0);
    EXPECT_NEAR(srgbFromLinear(1), 1, 1e-6);
    EXPECT_NEAR(srgbFromLinear(0.5f), 0.735357, 1e-5);
    EXPECT_NEAR(linearFromSrgb(0.5f), 0.214041, 1e-5);
    EXPECT_NEAR(srgbFromLinear(0.0031308f), 0.04045, 1e-5);  // the two pieces meet
    for (int i = 0; i <= 255; ++i) EXPECT_NEAR(srgbFromLinear(linearFromSrgb(float(i) / 255)), float(i) / 255, 1e-6);
    EXPECT_TRUE(std::isnan(srgbFromLinear(kNan)));
    EXPECT_LT(srgbFromLinear(-0.1f), 0);
}

TEST(Vec3, NormalizeOfZeroIsZero) { EXPECT_EQ(normalize(Vec3{}), Vec3{}); }

}  // namespace
}  // namespace shoal
