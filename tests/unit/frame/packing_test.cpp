// Packed vertices, G-buffer encodings and mips: what goes in comes out within the stated steps.
#include <gtest/gtest.h>

#include <cmath>

#include <shoal/core/random.h>

#include "frame/glsl_math.h"
#include "frame/gpu_model.h"
#include "frame/gpu_texture.h"
#include "support/frame_scene.h"

namespace shoal::frame {
namespace {

Vec3 randomDirection(std::uint32_t i) {
    const float z = 2 * randomFloat(1, i) - 1, a = 2 * kPi * randomFloat(2, i),
                r = std::sqrt(std::max(1 - z * z, 0.0f));
    return {r * std::cos(a), r * std::sin(a), z};
}

float snorm16(std::uint32_t word) { return std::max(float(std::int16_t(word & 0xffff)) / 32767, -1.0f); }
float snorm10(std::uint32_t word) { return std::max(float(std::int32_t(word << 22) >> 22) / 511, -1.0f); }

TEST(Packing, NormalsSurviveSixteenBitOctahedrons) {
    double worst = 0;
    for (std::uint32_t i = 0; i < 20000; ++i) {
        const Vec3 n = randomDirection(i);
        const PackedFrame f = packFrame(n, {1, 0, 0, 1});
        const glsl::vec3 back = glsl::normalFromOctahedral({snorm16(f.normal), snorm16(f.normal >> 16)});
        worst = std::max(worst, double(length(n - Vec3{back.x, back.y, back.z})));
    }
    EXPECT_LT(worst, radians(0.0037f));
}

TEST(Packing, OctahedronsAreExactOnTheAxes) {
    for (const glsl::vec3 n : {glsl::vec3(0, 0, 1), glsl::vec3(0, 0, -1), glsl::vec3(1, 0, 0), glsl::vec3(-1, 0, 0),
                               glsl::vec3(0, 1, 0), glsl::vec3(0, -1, 0)}) {
        const glsl::vec3 back = glsl::decodeNormal(glsl::encodeNormal(n));
        EXPECT_NEAR(back.x, n.x, 1e-6);
        EXPECT_NEAR(back.y, n.y, 1e-6);
        EXPECT_NEAR(back.z, n.z, 1e-6);
    }
}

TEST(Packing, TangentsKeepDirectionAndHandedness) {
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const Vec3 t = randomDirection(i);
        const float hand = i % 2 ? 1.0f : -1.0f;
        const PackedFrame f = packFrame({0, 0, 1}, {t.x, t.y, t.z, hand});
        EXPECT_NEAR(snorm10(f.tangent), t.x, 0.001f);
        EXPECT_NEAR(snorm10(f.tangent >> 10), t.y, 0.001f);
        EXPECT_NEAR(snorm10(f.tangent >> 20), t.z, 0.001f);
        EXPECT_EQ(std::int32_t(f.tangent) >> 30, int(hand));
    }
}

TEST(Packing, WeightsSumToOneExactly) {
    for (std::uint32_t i = 0; i < 5000; ++i) {
        Vec4 w{randomFloat(1, i), randomFloat(2, i), randomFloat(3, i), randomFloat(4, i)};
        w = w * (1 / (w.x + w.y + w.z + w.w));
        const PackedInfluence p = packInfluence({1, 2, 3, 65535}, w);
        EXPECT_EQ((p.weights01 & 0xffff) + (p.weights01 >> 16) + (p.weights23 & 0xffff) + (p.weights23 >> 16), 65535u);
        EXPECT_NEAR(float(p.weights01 & 0xffff) / 65535, w.x, 3e-5f);
        EXPECT_EQ(p.joints23, 3u | 65535u << 16);
    }
    EXPECT_EQ(packInfluence({0, 0, 0, 0}, {1, 0, 0, 0}).weights01, 65535u);
    EXPECT_EQ(packInfluence({0, 0, 0, 0}, {0, 0, 0, 0}).weights01, 65535u) << "no weights: the first joint";
}

TEST(Shell, OnlyOutwardShellsOpenToTheGroundLeaveOutTheirBackFaces) {
    auto meshOf = [](std::vector<Primitive> parts) { return ModelMesh{"mesh", std::move(parts), {}}; };
    const Mat4 here;
    const Primitive box = test::box({-1, 0, -1}, {1, 2, 1});
    EXPECT_TRUE(shadowsByFrontFaces(shellOf(meshOf({box})), here));
    EXPECT_TRUE(shadowsByFrontFaces(shellOf(meshOf({box})), scaling({-2, 3, 1}))) << "a mirror keeps it closed";
    Primitive room = box;  // seen from inside
    for (std::size_t i = 0; i < room.indices.size(); i += 3) std::swap(room.indices[i], room.indices[i + 1]);
    EXPECT_FALSE(shadowsByFrontFaces(shellOf(meshOf({room})), here));
    EXPECT_FALSE(shadowsByFrontFaces(shellOf(meshOf({test::quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0})})), here))
        << "a single wall";
    Primitive withoutFloor = box, withoutWall = box;  // sides in the order -z, +z, -y, +y, -x, +x
    withoutFloor.indices.erase(withoutFloor.indices.begin() + 12, withoutFloor.indices.begin() + 18);
    withoutWall.indices.erase(withoutWall.indices.begin(), withoutWall.indices.begin() + 6);
    EXPECT_TRUE(shadowsByFrontFaces(shellOf(meshOf({withoutFloor})), here));
    EXPECT_FALSE(shadowsByFrontFaces(shellOf(meshOf({withoutFloor})), rotation(axisAngle({1, 0, 0}, kPi))))
        << "upside down";
    EXPECT_FALSE(shadowsByFrontFaces(shellOf(meshOf({withoutWall})), here));
}

TEST(GBufferLib, FlagsAndReflectanceSurviveEightBits) {
    for (std::uint32_t flags = 0; flags < 4; ++flags)
        EXPECT_EQ(glsl::decodeFlags(std::round(glsl::encodeFlags(flags) * 255) / 255), flags);
    EXPECT_NEAR(glsl::decodeF0(std::round(glsl::encodeF0(0.04f) * 255) / 255), 0.04f, 0.0004f);
}

TEST(GBufferLib, ViewDepthInvertsBothProjections) {
    const Mat4 perspective = perspectiveReversed(1, 1.5f, 0.1f),
               parallel = orthographicReversed(-2, 2, -1, 1, 0.5f, 90);
    for (const Mat4& m : {perspective, parallel})
        for (const float depth : {0.6f, 3.0f, 80.0f}) {
            const float z = transformPoint(m, {0.2f, 0.1f, -depth}).z;
            EXPECT_NEAR(glsl::viewDepthFromDepth(z, {m(2, 2), m(2, 3), m(3, 2), m(3, 3)}), depth, 1e-4f * depth);
        }
}

TEST(ShadowLib, TentWeightsReproduceTheTent) {
    for (float f = 0; f < 1; f += 0.0625f) {
        const glsl::vec4 t = glsl::tentAxis(f);
        EXPECT_NEAR(t.z + t.w, 4, 1e-6);
        // Four texels around the corner at -1, 0, 1, 2; a bilinear fetch at offset o takes 1 - frac and frac.
        float weight[4] = {};
        const float offsets[2] = {t.x, t.y}, weights[2] = {t.z, t.w};
        for (int k = 0; k < 2; ++k) {
            const float at = offsets[k] + 1;  // relative to the first texel
            const int left = int(std::floor(at));
            weight[left] += weights[k] * (1 - (at - float(left)));
            weight[std::min(left + 1, 3)] += weights[k] * (at - float(left));
        }
        const float expected[4] = {1 - f, 2 - f, 1 + f, f};
        for (int k = 0; k < 4; ++k) EXPECT_NEAR(weight[k], expected[k], 1e-5) << "f " << f << " texel " << k;
    }
}

TEST(ShadowLib, DiscPointsCoverTheDiscEvenly) {
    double x = 0, y = 0, inner = 0;
    constexpr int kCount = 16;
    for (int i = 0; i < kCount; ++i) {
        const glsl::vec2 p = glsl::discPoint(i, kCount);
        x += p.x, y += p.y;
        inner += p.x * p.x + p.y * p.y < 0.5f;
        EXPECT_LE(glsl::length(p), 1);
    }
    EXPECT_NEAR(x / kCount, 0, 0.05);
    EXPECT_NEAR(y / kCount, 0, 0.05);
    EXPECT_EQ(inner, kCount / 2);
}

ByteImage checkerboard(int width, int height, std::uint8_t alphaDark, std::uint8_t alphaLight) {
    ByteImage image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::uint8_t* p = image.pixels.data() + 4 * (y * width + x);
            const bool light = (x + y) % 2;
            p[0] = p[1] = p[2] = light ? 255 : 0;
            p[3] = light ? alphaLight : alphaDark;
        }
    return image;
}

TEST(Mips, ColoursAverageInLinearLightAndNumbersAsTheyAre) {
    const ByteImage board = checkerboard(8, 8, 255, 255);
    const auto color = makeMips(board, {.color = true});
    ASSERT_EQ(color.size(), 3u);
    EXPECT_NEAR(color[0].pixels[0], 188, 1);  // half of the light is 188 in sRGB
    EXPECT_NEAR(color[2].pixels[0], 188, 2);
    const auto plain = makeMips(board, {});
    EXPECT_EQ(plain[0].pixels[0], 128);
    EXPECT_EQ(plain[2].width, 1);
}

TEST(Mips, ColourOfClearTexelsDoesNotBleed) {
    const auto mips = makeMips(checkerboard(4, 4, 0, 255), {.color = true});  // black is clear, white is solid
    EXPECT_EQ(mips[0].pixels[0], 255);
    EXPECT_EQ(mips[0].pixels[3], 128);
}

TEST(Mips, OddSizesGoDownToOneTexel) {
    const auto mips = makeMips(checkerboard(13, 3, 255, 255), {.color = true});
    ASSERT_EQ(mips.size(), 3u);
    EXPECT_EQ(mips[0].width, 6);
    EXPECT_EQ(mips[0].height, 1);
    EXPECT_EQ(mips[2].width, 1);
    EXPECT_TRUE(makeMips(ByteImage(1, 1), {}).empty());
}

TEST(Mips, MaskedTexturesKeepTheirCoverage) {
    ByteImage image(64, 64);  // thin twigs: a quarter of the texels reach the cutoff, scattered
    constexpr float kCutoff = 0.75f;
    for (std::uint32_t i = 0; i < 64 * 64; ++i) image.pixels[4 * i + 3] = std::uint8_t(256 * randomFloat(9, i));
    auto share = [](const ByteImage& mip, int cutoff) {
        int passing = 0;
        for (std::size_t i = 3; i < mip.pixels.size(); i += 4) passing += mip.pixels[i] >= cutoff;
        return double(passing) * 4 / double(mip.pixels.size());
    };
    const auto kept = makeMips(image, {.color = true, .coverageCutoff = kCutoff}),
               plain = makeMips(image, {.color = true});
    for (int level = 0; level < 3; ++level)
        EXPECT_NEAR(share(kept[std::size_t(level)], 192), 0.25, 0.05) << "level " << level;
    EXPECT_LT(share(plain[2], 192), 0.01) << "without it twigs vanish";
}

}  // namespace
}  // namespace shoal::frame
