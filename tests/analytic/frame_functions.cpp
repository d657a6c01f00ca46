// The shaders' pure functions, compiled by C++, against closed forms, quadrature and published curves.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/core/random.h>
#include <shoal/frame/post.h>

#include "frame/glsl_compat.h"

namespace shoal::frame::glsl {
#include "frame/brdf.lib.glsl"
#include "frame/tonemap.lib.glsl"
}  // namespace shoal::frame::glsl

namespace shoal::frame {
namespace {

using glsl::vec2;
using glsl::vec3;

// ---- reflection ----

TEST(FrameBrdf, NormalDistributionProjectsToOne) {
    for (const double alpha : {0.05, 0.3, 1.0}) {
        double sum = 0;
        const int n = 20000;
        for (int i = 0; i < n; ++i) {
            const double c = (i + 0.5) / n;  // cosine of the half vector
            sum += 2 * kPiD * double(glsl::distributionGgx(float(c), float(alpha))) * c / n;
        }
        EXPECT_NEAR(sum, 1, 5e-3) << alpha;
    }
}

TEST(FrameBrdf, MaskingIsReciprocal) {
    for (const float alpha : {0.01f, 0.3f, 1.0f})
        for (const float v : {0.1f, 0.5f, 0.9f})
            for (const float l : {0.2f, 1.0f})
                EXPECT_FLOAT_EQ(glsl::visibilitySmith(v, l, alpha), glsl::visibilitySmith(l, v, alpha));
}

// Albedo of the height-correlated lobe by sampling visible normals [Heitz 2018], for f0 = 1 (x) and the
// Fresnel-weighted part (y).
struct Albedo {
    double all = 0, grazing = 0;
};
Albedo albedoByQuadrature(double cosView, double roughness) {
    const double a = roughness * roughness, sinView = std::sqrt(1 - cosView * cosView);
    const auto lambda = [a](double c) { return 0.5 * (std::sqrt(1 + a * a * (1 / (c * c) - 1)) - 1); };
    double vx = a * sinView, vz = cosView;
    const double norm = std::hypot(vx, vz);
    vx /= norm, vz /= norm;
    Albedo sum;
    const int n = 4096;
    for (int i = 0; i < n; ++i) {
        const double r = std::sqrt((i + 0.5) / n), phi = 2 * kPiD * radicalInverse(2, std::uint64_t(i));
        const double t1 = r * std::cos(phi), s = 0.5 * (1 + vz);
        const double t2 = (1 - s) * std::sqrt(1 - t1 * t1) + s * r * std::sin(phi);
        const double t3 = std::sqrt(std::max(1 - t1 * t1 - t2 * t2, 0.0));
        // Frame about the stretched view: (0, 1, 0) and its complement in the plane of view and normal.
        double hx = a * (-t2 * vz + t3 * vx), hy = a * t1, hz = std::max(t2 * vx + t3 * vz, 0.0);
        const double h = std::sqrt(hx * hx + hy * hy + hz * hz);
        hx /= h, hz /= h;
        const double vDotH = sinView * hx + cosView * hz, cosLight = 2 * vDotH * hz - cosView;
        if (cosLight <= 0) continue;
        const double weight = (1 + lambda(cosView)) / (1 + lambda(cosView) + lambda(cosLight));
        sum.all += weight / n;
        sum.grazing += weight * std::pow(1 - vDotH, 5) / n;
    }
    return sum;
}

TEST(FrameBrdf, SplitSumFitsQuadrature) {
    double worstAll = 0, worstGrazing = 0;
    for (double roughness = 0.05; roughness <= 1; roughness += 0.05)
        for (double cosView = 0.05; cosView <= 1; cosView += 0.05) {
            const Albedo expected = albedoByQuadrature(cosView, roughness);
            const vec2 got = glsl::splitSum(float(cosView), float(roughness));
            worstAll = std::max(worstAll, std::abs(double(got.x + got.y) - expected.all));
            worstGrazing = std::max(worstGrazing, std::abs(double(got.y) - expected.grazing));
        }
    EXPECT_LT(worstAll, 0.035);  // the fit was made with 0.030 and 0.013 on another grid
    EXPECT_LT(worstGrazing, 0.017);
    EXPECT_GT(worstAll + worstGrazing, 0.001) << "the quadrature compares the fit with itself";
}

TEST(FrameBrdf, WhiteLobesLoseNothing) {
    for (const float roughness : {0.1f, 0.5f, 1.0f})
        for (const float cosView : {0.1f, 0.5f, 1.0f}) {
            const vec3 albedo = glsl::specularAlbedo(vec3(1), 1, glsl::splitSum(cosView, roughness));
            EXPECT_NEAR(albedo.x, 1, 1e-5f);
        }
}

TEST(FrameBrdf, InterreflectionBrightensBrightSurfacesOnly) {
    EXPECT_NEAR(glsl::interreflection(1, vec3(0.5f)).x, 1, 1e-3f);
    EXPECT_NEAR(glsl::interreflection(0.5f, vec3(0)).x, 0.5f, 0.03f);
    EXPECT_GT(glsl::interreflection(0.5f, vec3(0.9f)).x, 0.6f);
    EXPECT_EQ(glsl::interreflection(0, vec3(0.9f)).x, 0);
}

TEST(FrameBrdf, LevelsAndRoughnessesMatch) {
    for (int level = 0; level < 6; ++level)
        EXPECT_NEAR(glsl::levelOfRoughness(glsl::roughnessOfLevel(float(level), 6), 6), float(level), 1e-4f);
    EXPECT_EQ(glsl::levelOfRoughness(0, 6), 0);
    EXPECT_NEAR(glsl::levelOfRoughness(1, 6), 5, 1e-5f);
}

TEST(FrameBrdf, SquareHoldsEveryDirection) {
    for (int i = 0; i < 500; ++i) {
        const Vec3 d = normalize(Vec3{randomFloat(1, std::uint32_t(i)) - 0.5f, randomFloat(2, std::uint32_t(i)) - 0.5f,
                                      randomFloat(3, std::uint32_t(i)) - 0.5f});
        const vec2 square = glsl::squareFromDirection({d.x, d.y, d.z});
        ASSERT_TRUE(square.x >= 0 && square.x <= 1 && square.y >= 0 && square.y <= 1);
        const vec3 back = glsl::directionFromSquare(square);
        EXPECT_NEAR(back.x * d.x + back.y * d.y + back.z * d.z, 1, 1e-5f);
    }
    EXPECT_NEAR(glsl::directionFromSquare({0.5f, 0.5f}).y, 1, 1e-6f) << "up is in the middle";
    // The border folds about its middle: this is what makes look-ups seamless.
    const vec3 a = glsl::directionFromSquare({0, 0.3f}), b = glsl::directionFromSquare({0, 0.7f});
    EXPECT_NEAR(a.x, b.x, 1e-6f);
    EXPECT_NEAR(a.y, b.y, 1e-6f);
    EXPECT_NEAR(a.z, b.z, 1e-6f);
}

// ---- tone curves ----

// The sigmoid that generates AgX's look-up table, as its script writes it.
double agxByScript(double x) {
    const double pivotX = 10 / 16.5, pivotY = 0.5, slope = 2;
    const bool upper = x >= pivotX;
    const double power = upper ? 3.25 : 3.0;
    const double scaleX = upper ? 1 - pivotX : pivotX, scaleY = upper ? 1 - pivotY : pivotY;
    double scale =
        std::pow(std::pow(slope * scaleX, -power) * (std::pow(slope * (scaleX / scaleY), power) - 1), -1 / power);
    if (!upper) scale = -scale;
    const double term = slope * (x - pivotX) / scale;
    return scale * (term / std::pow(1 + std::pow(term, power), 1 / power)) + pivotY;
}

TEST(FrameTonemap, AgxCurveIsThePublishedOne) {
    for (double x = 0; x <= 1; x += 0.01) EXPECT_NEAR(glsl::agxContrast(float(x)), agxByScript(x), 1.3e-4) << x;
}

TEST(FrameTonemap, AgxKeepsMiddleGreyAndNeutrals) {
    // 0.18 is half of the display's range, which a power of 2.2 shows as 0.2176; greys stay grey; black is black,
    // bright is white.
    const vec3 grey = glsl::displayByAgx(vec3(0.18f));
    EXPECT_NEAR(grey.x, 0.5f, 1e-3f);
    EXPECT_NEAR(grey.y, 0.5f, 1e-3f);
    EXPECT_NEAR(grey.z, 0.5f, 1e-3f);
    EXPECT_NEAR(glsl::displayByAgx(vec3(0)).x, 0, 1e-3f);
    EXPECT_NEAR(glsl::displayByAgx(vec3(100)).x, 1, 1e-3f);
    float last = -1;
    for (float stops = -9; stops <= 6; stops += 0.25f) {
        const vec3 c = glsl::displayByAgx(vec3(0.18f * std::exp2(stops)));
        EXPECT_GT(c.x, last);
        EXPECT_NEAR(c.x, c.z, 2e-3f);
        last = c.x;
    }
    // Bright saturated light loses its saturation instead of its shape.
    const vec3 dim = glsl::displayByAgx(vec3(0.1f, 0, 0)), bright = glsl::displayByAgx(vec3(50, 0, 0));
    EXPECT_GT(dim.x / std::max(dim.y, 1e-3f), 3);
    EXPECT_GT(bright.y, 0.4f);
}

TEST(FrameTonemap, PlainIsSrgbAndNoneIsLinear) {
    for (float x = 0; x <= 1; x += 0.05f) {
        EXPECT_NEAR(glsl::displayByPlain(vec3(x)).y, srgbFromLinear(x), 1e-6f);
        EXPECT_EQ(glsl::displayByNone(vec3(x)).y, x);
    }
    EXPECT_NEAR(glsl::displayByPlain(vec3(7)).x, 1, 1e-6f);
    EXPECT_EQ(glsl::displayByPlain(vec3(-7)).x, 0);
}

TEST(FrameTonemap, LooksLeaveMiddleGreyAndAtOneEverything) {
    const vec3 c(0.2f, 0.6f, 0.9f), same = glsl::applyLook(c, 1, 1);
    EXPECT_NEAR(same.x, c.x, 1e-6f);
    EXPECT_NEAR(same.z, c.z, 1e-6f);
    EXPECT_NEAR(glsl::applyLook(c, 0, 1).x, glsl::applyLook(c, 0, 1).z, 1e-6f);
    EXPECT_LT(glsl::applyLook(vec3(0.3f), 1, 1.5f).x, 0.3f);
    EXPECT_GT(glsl::applyLook(vec3(0.7f), 1, 1.5f).x, 0.7f);
}

// ---- sample pattern ----

TEST(FrameSamplePattern, FillsEveryRowAndColumnOnce) {
    for (const int count : {1, 2, 3, 4, 5, 8, 16, 48, 64, 100}) {
        std::vector<int> rows(std::size_t(count), 0), columns(std::size_t(count), 0);
        double x = 0, y = 0;
        for (int i = 0; i < count; ++i) {
            const Vec2 p = samplePattern(i, count);
            ASSERT_TRUE(std::abs(p.x) <= 0.5f && std::abs(p.y) <= 0.5f);
            ++columns[std::size_t((p.x + 0.5f) * float(count))];
            ++rows[std::size_t((p.y + 0.5f) * float(count))];
            x += double(p.x), y += double(p.y);
        }
        for (int i = 0; i < count; ++i) EXPECT_TRUE(rows[std::size_t(i)] == 1 && columns[std::size_t(i)] == 1) << count;
        EXPECT_NEAR(x / count, 0, 1e-6);
        EXPECT_NEAR(y / count, 0, 1e-6);
    }
    EXPECT_EQ(samplePattern(0, 1), (Vec2{0, 0}));
}

TEST(FrameSamplePattern,
     FillsSquaresToo) {  // a (0, m, 2)-net in base 2: every elementary box holds as many points as any
    const int m = 6, count = 1 << m;
    for (int k = 0; k <= m; ++k) {
        std::vector<int> boxes(std::size_t(count), 0);
        for (int i = 0; i < count; ++i) {
            const Vec2 p = samplePattern(i, count);
            const int column = int((p.x + 0.5f) * float(1 << k)), row = int((p.y + 0.5f) * float(1 << (m - k)));
            ++boxes[std::size_t((column << (m - k)) + row)];
        }
        for (const int n : boxes) EXPECT_EQ(n, 1) << "boxes of 1 / " << (1 << k);
    }
}

TEST(FrameSamplePattern, EndlessPointsCoverInAnyRun) {
    for (int start = 0; start < 40; start += 7) {
        int quarters[4] = {};
        for (int i = start; i < start + 16; ++i) {
            const Vec2 p = samplePattern(i, 0);
            ++quarters[(p.x >= 0 ? 1 : 0) + (p.y >= 0 ? 2 : 0)];
        }
        for (const int n : quarters) EXPECT_GE(n, 2) << start;
    }
}

}  // namespace
}  // namespace shoal::frame
