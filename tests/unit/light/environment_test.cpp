#include <gtest/gtest.h>
#include <shoal/core/parallel.h>
#include <shoal/light/environment.h>

namespace shoal::light {
namespace {

template <class Radiance>
Environment mapOf(int height, float rotation, const Radiance& radiance) {
    Environment e;
    e.radiance = Image(2 * height, height, 3);
    e.rotation = rotation;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 2 * height; ++x) {
            const Vec3 l = radiance(directionOfTexel(e, x, y));
            float* p = e.radiance.at(x, y);
            p[0] = l.x, p[1] = l.y, p[2] = l.z;
        }
    return e;
}

const Vec3 kNormals[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, {0, -1, 0}, {0.6f, 0, 0.8f}, {-0.48f, 0.6f, 0.64f}};

TEST(Environment, MiddleOfTheMapIsMinusZAndRightIsPlusX) {
    Environment e;
    e.radiance = Image(512, 256, 3);
    const Vec3 middle = directionOfTexel(e, 256, 128);
    EXPECT_NEAR(middle.z, -1, 1e-3);
    EXPECT_GT(directionOfTexel(e, 384, 128).x, 0.99f);
    EXPECT_GT(directionOfTexel(e, 10, 0).y, 0.99f);
    e.rotation = radians(90);  // counter-clockwise from above: what was at +x comes to -z
    EXPECT_LT(directionOfTexel(e, 384, 128).z, -0.99f);
}

TEST(Environment, LookUpFindsTheTexelWithAnyRotation) {
    for (const float rotation : {0.0f, 1.0f, -4.0f, 17.0f}) {
        const Environment e = mapOf(32, rotation, [](Vec3 d) { return Vec3{d.x + 2, d.y + 2, d.z + 2}; });
        for (const IVec2 at : {IVec2{0, 0}, {63, 31}, {17, 9}, {32, 16}, {63, 5}}) {
            const Vec3 found = lookUp(e, directionOfTexel(e, at.x, at.y));
            EXPECT_NEAR(found.x, e.radiance.at(at.x, at.y)[0], 1e-4);
            EXPECT_NEAR(found.z, e.radiance.at(at.x, at.y)[2], 1e-4);
        }
    }
}

TEST(Environment, LookUpIsContinuousAcrossTheSeam) {
    const Environment e = mapOf(64, 0.3f, [](Vec3 d) { return Vec3{d.x, d.y, d.z}; });
    for (int i = 0; i < 2000; ++i) {
        const float a = 2 * kPi * float(i) / 2000;
        const Vec3 d{std::sin(a) * 0.8f, 0.6f, std::cos(a) * 0.8f};
        EXPECT_LT(length(lookUp(e, d) - d), 0.01f);
    }
}

// L = a + b.d + quadratic: SH to l = 2 is exact, and E(n) = pi a + 2/3 pi b.n + pi/4 (quadratic without its mean).
TEST(Environment, ConstantMapGivesPiTimesRadianceExactly) {
    for (const int height : {1, 4, 64}) {
        const Environment e = mapOf(height, 0.7f, [](Vec3) { return Vec3{1, 2.5f, 0.25f}; });
        const Sh9 sh = projectSh(e);
        for (const Vec3 n : kNormals) {
            EXPECT_NEAR(evaluateIrradiance(sh, n).x, kPiD, 2e-6 * kPiD);
            EXPECT_NEAR(evaluateIrradiance(sh, n).y, 2.5 * kPiD, 5e-6 * kPiD);
        }
    }
}

TEST(Environment, LinearAndQuadraticRadianceGiveTheirClosedForm) {
    const Environment e = mapOf(256, 1.1f, [](Vec3 d) {
        return Vec3{2 + 0.5f * d.x - 0.3f * d.y + 0.7f * d.z, 1 + d.x * d.y - d.y * d.z + 0.5f * d.x * d.z,
                    1 + d.z * d.z - 0.5f * d.x * d.x};
    });
    const Sh9 sh = projectSh(e);
    for (const Vec3 n : kNormals) {
        const Vec3 found = evaluateIrradiance(sh, n);
        EXPECT_NEAR(found.x, kPiD * (2 + 2.0 / 3 * double(0.5f * n.x - 0.3f * n.y + 0.7f * n.z)), 1e-3);
        EXPECT_NEAR(found.y, kPiD * (1 + 0.25 * double(n.x * n.y - n.y * n.z + 0.5f * n.x * n.z)), 1e-3);
        const double mean = 1 + (1 - 0.5) / 3, rest = double(n.z * n.z - 0.5f * n.x * n.x) - (1 - 0.5) / 3;
        EXPECT_NEAR(found.z, kPiD * (mean + 0.25 * rest), 1e-3);
    }
}

TEST(Environment, OneBrightTexelShinesFromItsDirection) {
    Environment e;
    e.radiance = Image(64, 32, 3);
    e.rotation = 2.2f;
    for (int k = 0; k < 3; ++k) e.radiance.at(20, 9)[k] = 100;
    const Vec3 d = directionOfTexel(e, 20, 9);
    const Sh9 sh = projectSh(e);
    EXPECT_GT(dot(normalize(Vec3{sh.c[3].x, sh.c[1].x, sh.c[2].x}), d), 0.9999f);
    // Order 2 keeps 17/16 of a distant light's irradiance facing it, and nothing may be negative anywhere.
    const double solidAngle = 2 * kPiD / 64 * (std::cos(kPiD * 9 / 32) - std::cos(kPiD * 10 / 32));
    EXPECT_NEAR(evaluateIrradiance(sh, d).x, 100 * solidAngle * 17 / 16, 100 * solidAngle * 0.01);
    for (const Vec3 n : kNormals) EXPECT_GE(evaluateIrradiance(sh, n).x, 0);
}

TEST(Environment, RotationTurnsTheHarmonics) {
    const auto lobe = [](Vec3 d) { return Vec3{std::max(0.0f, d.x), 0, 0}; };
    Environment e = mapOf(64, 0, lobe);
    e.rotation = radians(90);  // the lobe at +x comes to -z
    const Sh9 sh = projectSh(e);
    const float facing = evaluateIrradiance(sh, {0, 0, -1}).x;
    EXPECT_NEAR(facing, 2 * kPiD / 3, 0.02);  // integral of cos2 over the hemisphere
    EXPECT_LT(evaluateIrradiance(sh, {0, 0, 1}).x, 0.1f * facing);
}

TEST(Environment, ProjectionHasTheSameBitsOnAnyThreadCount) {
    const Environment e = mapOf(100, 0.4f, [](Vec3 d) { return Vec3{std::exp(3 * d.x), 1 / (1.1f + d.y), d.z * d.z}; });
    const ThreadLimit one(1);
    const Sh9 a = projectSh(e);
    const ThreadLimit two(2);
    EXPECT_EQ(a.c, projectSh(e).c);
}

}  // namespace
}  // namespace shoal::light
