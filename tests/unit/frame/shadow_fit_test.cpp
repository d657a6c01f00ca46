// Cascades hold what the view sees, do not change size when the eye turns, and move in whole texels.
#include <gtest/gtest.h>

#include <cmath>

#include "frame/shadow_fit.h"

namespace shoal::frame {
namespace {

light::View view(Vec3 eye, Vec3 target, float fovDeg = 50) {
    return makeView(light::cameraLookingAt(eye, target, radians(fovDeg)), 1280, 720);
}

Bounds scene() { return {{-100, 0, -100}, {100, 30, 100}}; }
const Vec3 kToSun = normalize(Vec3{0.3f, 0.8f, 0.4f});

Vec3 sunPosition(const CascadeFit& fit, Vec3 world) { return transformPoint(fit.sunFromWorld, world); }

TEST(ShadowFit, EverySeenPointLiesInItsCascade) {
    const light::View v = view({3, 1.7f, 20}, {-4, 3, 0});
    const CascadeFit fit = fitCascades(v, kToSun, scene(), {});
    ASSERT_EQ(fit.count, 4);
    float before = 0;
    int asked = 0;
    for (int i = 0; i < fit.count; ++i) {
        const Cascade& c = fit.cascades[std::size_t(i)];
        EXPECT_GT(c.endDepth, before);
        EXPECT_GT(c.fadeDepth, before);
        EXPECT_LT(c.fadeDepth, c.endDepth);
        for (const float x : {-1.0f, 0.0f, 1.0f})
            for (const float y : {-1.0f, 0.0f, 1.0f})
                for (float d = std::max(before, 0.1f); d < c.endDepth; d += 0.05f * c.endDepth) {
                    const Vec3 ray = transformPoint(v.viewFromClip, {x, y, 1});
                    const Vec3 world = transformPoint(v.worldFromView, ray * (d / -ray.z));
                    if (std::max(std::abs(world.x), std::abs(world.z)) > 100 || world.y < 0 || world.y > 30) continue;
                    const Vec3 p = sunPosition(fit, world);
                    ++asked;
                    EXPECT_LT(std::abs(p.x - c.center.x), c.halfExtent) << "cascade " << i << " depth " << d;
                    EXPECT_LT(std::abs(p.y - c.center.y), c.halfExtent) << "cascade " << i << " depth " << d;
                }
        before = c.endDepth;
    }
    EXPECT_GT(asked, 100);
}

TEST(ShadowFit, TheMatrixOfAMapAgreesWithTheSunsAxes) {
    const CascadeFit fit = fitCascades(view({3, 1.7f, 20}, {-4, 3, 0}), kToSun, scene(), {});
    for (int i = 0; i < fit.count; ++i) {
        const Cascade& c = fit.cascades[std::size_t(i)];
        const Vec3 world{5, 2, -7};
        const Vec3 sun = sunPosition(fit, world), clip = transformPoint(c.view.clipFromWorld(), world);
        EXPECT_NEAR(clip.x, (sun.x - c.center.x) / c.halfExtent, 1e-4);
        EXPECT_NEAR(clip.y, (sun.y - c.center.y) / c.halfExtent, 1e-4);
        EXPECT_NEAR(clip.z, sun.z, 1e-5);
    }
}

TEST(ShadowFit, DepthHoldsTheWholeSceneAndGrowsTowardsTheSun) {
    const CascadeFit fit = fitCascades(view({0, 2, 5}, {0, 2, 0}), kToSun, scene(), {});
    const Bounds b = scene();
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner{(i & 1) ? b.hi.x : b.lo.x, (i & 2) ? b.hi.y : b.lo.y, (i & 4) ? b.hi.z : b.lo.z};
        const float z = sunPosition(fit, corner).z;
        EXPECT_GT(z, 0);
        EXPECT_LT(z, 1);
        EXPECT_NEAR(sunPosition(fit, corner + kToSun).z - z, 1 / fit.depthRangeM, 1e-5);
    }
}

TEST(ShadowFit, SizesDoNotChangeAsTheEyeTurnsAndWalks) {
    const CascadeFit first = fitCascades(view({3, 1.7f, 20}, {-4, 3, 0}), kToSun, scene(), {.sunDistance = 80});
    for (int i = 0; i < 50; ++i) {
        const float a = 0.13f * float(i);
        const Vec3 eye{3 + 0.1f * float(i), 1.7f, 20};
        const CascadeFit fit =
            fitCascades(view(eye, eye + Vec3{std::sin(a), 0.1f, std::cos(a)}), kToSun, scene(), {.sunDistance = 80});
        ASSERT_EQ(fit.count, first.count);
        for (int k = 0; k < fit.count; ++k) {
            const Cascade& c = fit.cascades[std::size_t(k)];
            EXPECT_NEAR(c.halfExtent, first.cascades[std::size_t(k)].halfExtent, 1e-4f * c.halfExtent);
            const float steps = c.center.x / (c.halfExtent / 8);
            EXPECT_NEAR(steps, std::round(steps), 1e-3) << "a sixteenth of the map's width";
        }
        EXPECT_EQ(fit.sunFromWorld, first.sunFromWorld);
    }
}

TEST(ShadowFit, ASmallSceneNeedsOneMap) {
    const Bounds person{{-0.5f, 0, -0.5f}, {0.5f, 1.8f, 0.5f}};
    const CascadeFit fit = fitCascades(view({2, 1.5f, 3}, {0, 0.9f, 0}), kToSun, person, {});
    ASSERT_EQ(fit.count, 1);
    EXPECT_LT(fit.cascades[0].halfExtent, 2);
    EXPECT_LT(fit.depthRangeM, 4);
}

TEST(ShadowFit, SunInTheZenithAndOrthographicEyesWork) {
    light::Camera camera = light::cameraLookingAt({0, 50, 0}, {0, 0, -1}, radians(50));
    camera.projection = light::Camera::Projection::orthographic;
    camera.heightM = 40;
    const light::View v = makeView(camera, 640, 640);
    const CascadeFit fit = fitCascades(v, {0, 1, 0}, scene(), {});
    ASSERT_GE(fit.count, 1);
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{15, 0, -10}}) {
        const float depth = -transformPoint(v.viewFromWorld, p).z;
        int i = 0;
        while (i + 1 < fit.count && depth >= fit.cascades[std::size_t(i)].endDepth) ++i;
        const Cascade& c = fit.cascades[std::size_t(i)];
        EXPECT_LT(depth, c.endDepth);
        const Vec3 sun = sunPosition(fit, p);
        EXPECT_LT(std::abs(sun.x - c.center.x), c.halfExtent);
        EXPECT_LT(std::abs(sun.y - c.center.y), c.halfExtent);
    }
}

TEST(ShadowFit, SpotSeesItsCone) {
    light::PunctualLight spot;
    spot.kind = light::PunctualLight::Kind::spot;
    spot.position = {1, 5, 2};
    spot.direction = normalize(Vec3{0.2f, -1, 0.1f});
    spot.outerCone = radians(30);
    const light::View v = spotView(spot, 512);
    const Vec3 ahead = transformPoint(v.clipFromWorld(), spot.position + spot.direction * 3);
    EXPECT_NEAR(ahead.x, 0, 1e-5);
    EXPECT_NEAR(ahead.y, 0, 1e-5);
    const Vec3 side = normalize(cross(spot.direction, {0, 0, 1}));
    const Vec3 edge = transformPoint(v.clipFromWorld(), spot.position + spot.direction + side * std::tan(radians(30)));
    EXPECT_LT(std::hypot(edge.x, edge.y), 1);
    EXPECT_GT(std::hypot(edge.x, edge.y), 0.97f);
}

}  // namespace
}  // namespace shoal::frame
