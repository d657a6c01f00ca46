// Supersampling, temporal antialiasing, exposure, display and read-back.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <cmath>
#include <functional>
#include <optional>

#include <shoal/frame/post.h>
#include <shoal/frame/targets.h>

#include "support/gl_device.h"
#include "support/lit_patch.h"

namespace shoal::frame {
namespace {

constexpr int kWidth = 48, kHeight = 32;

class FramePost : public test::GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        gl::setKnownState();
        auto post = Post::create(device());
        ASSERT_TRUE(post) << post.error().message;
        post_.emplace(*std::move(post));
        targets_.emplace(*Targets::create(device(), kWidth, kHeight));
        context_.device = &device();
        context_.view = context_.previousView = test::straightView(kWidth, kHeight);
        targets_->beginSurfaces();
        const float depth = 5;
        glClearTexImage(targets_->gbuffer().viewDepth.name, 0, GL_RED, GL_FLOAT, &depth);
    }
    void TearDown() override {
        post_.reset();
        targets_.reset();
        GlTest::TearDown();
    }
    // radiance(x, y), x and y in pixels from the bottom left, sampled where the jitter says.
    using Scene = std::function<Vec3(float x, float y)>;
    void put(const Scene& scene, float alpha = 1) {
        std::vector<float> pixels;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                // The picture moves by +jitter, so that a pixel sees what lies -jitter off its centre.
                const Vec3 c = scene(float(x) + 0.5f - context_.jitterPx.x, float(y) + 0.5f - context_.jitterPx.y);
                pixels.insert(pixels.end(), {c.x, c.y, c.z, alpha});
            }
        glTextureSubImage2D(targets_->radiance().name, 0, 0, 0, kWidth, kHeight, GL_RGBA, GL_FLOAT, pixels.data());
    }
    void supersample(const Scene& scene, int count) {
        post_->beginAccumulation(kWidth, kHeight);
        for (int i = 0; i < count; ++i) {
            context_.jitterPx = samplePattern(i, count);
            context_.sampleIndex = std::uint32_t(i);
            put(scene);
            post_->accumulate(context_, *targets_);
        }
        context_.jitterPx = {};
        context_.sampleIndex = 0;
    }
    void temporal(const Scene& scene, int frame) {
        context_.frameIndex = std::uint32_t(frame);
        context_.jitterPx = samplePattern(frame, 0);
        put(scene);
        post_->temporal(context_, *targets_, frame == 0);
        context_.jitterPx = {};
    }
    Image radiance() { return *readImage(device(), post_->radiance(), 4); }
    ByteImage display(const PostParams& params, bool reset = true) {
        post_->present(context_, params, reset);
        return *readByteImage(device(), post_->display());
    }
    static PostParams plain(const char* curve) {
        PostParams params;
        params.exposureMode = "fixed";
        params.toneCurve = curve;
        params.saturation = params.contrast = 1;
        return params;
    }

    std::optional<Post> post_;
    std::optional<Targets> targets_;
    Context context_;
};

Vec3 constant(float, float) { return {0.1875f, 3.5f, 100}; }  // exact in half floats

// A slanted edge and a bright line thinner than a pixel.
Vec3 hardScene(float x, float y) {
    const float edge = x - 0.3f * y - 8, line = std::abs(x + 0.2f * y - 34);
    if (line < 0.3f) return {4, 4, 4};
    return edge < 0 ? Vec3{0.1f, 0.1f, 0.1f} : Vec3{0.8f, 0.6f, 0.4f};
}

double meanDifference(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::abs(double(a.pixels[i]) - double(b.pixels[i]));
    return sum / double(a.pixels.size());
}
double largestDifference(const Image& a, const Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max(largest, std::abs(double(a.pixels[i]) - double(b.pixels[i])));
    return largest;
}

// ---- supersampling ----

TEST_F(FramePost, SamplesOfAConstantSumToItExactly) {
    for (const int count : {1, 4, 64, 100}) {
        supersample(constant, count);
        const Image image = radiance();
        const float* p = image.at(20, 10);
        EXPECT_EQ((Vec3{p[0], p[1], p[2]}), constant(0, 0)) << count;
        EXPECT_EQ(image.at(20, 10)[3], 1);
    }
}

TEST_F(FramePost, RadianceIsTheMeanOfTheSamples) {
    supersample([](float x, float) { return Vec3{x, 0.5f * x, 1}; }, 16);  // linear: the mean is the pixel centre's
    const Image image = radiance();
    for (int x = 1; x < kWidth; ++x) EXPECT_NEAR(image.at(x, 7)[0], float(x) + 0.5f, 0.02f);
}

TEST_F(FramePost, BrightEdgesStayGradualOnTheDisplay) {
    // Half of the pixel's samples are 100 times brighter than white: their linear mean is white still, the weighted one
    // is not.
    post_->setExpectedExposure(1);
    const Scene scene = [](float x, float) { return x < 20.5f ? Vec3{0.2f, 0.2f, 0.2f} : Vec3{100, 100, 100}; };
    supersample(scene, 16);
    EXPECT_NEAR(radiance().at(20, 5)[0], 50.1f, 0.2f);
    const ByteImage shown = display(plain("agx"));
    const int middle = shown.pixels[(5 * kWidth + 20) * 4];
    EXPECT_GT(middle, shown.pixels[(5 * kWidth + 18) * 4] + 10);
    EXPECT_LT(middle, shown.pixels[(5 * kWidth + 22) * 4] - 10);
}

TEST_F(FramePost, CoverageIsStraightOnTheDisplay) {
    post_->beginAccumulation(kWidth, kHeight);
    for (int i = 0; i < 4; ++i) {  // a quarter covered by 0.5
        put([&](float, float) { return i == 0 ? Vec3{0.5f, 0.5f, 0.5f} : Vec3{}; }, i == 0 ? 1.0f : 0.0f);
        post_->accumulate(context_, *targets_);
    }
    EXPECT_NEAR(radiance().at(3, 3)[0], 0.125f, 1e-6f) << "premultiplied";
    const ByteImage shown = display(plain("none"));
    EXPECT_NEAR(shown.pixels[0], 127.5, 1);
    EXPECT_NEAR(shown.pixels[3], 63.75, 1);
}

// ---- temporal ----

TEST_F(FramePost, HistoriesBecomeTheSupersampledPicture) {
    // The limit is the mean of many samples, weighted for the display.
    const double factor = 0.5;
    post_->setExpectedExposure(float(factor));
    std::vector<double> sums(std::size_t(kWidth) * kHeight * 3), weights(std::size_t(kWidth) * kHeight);
    for (int i = 0; i < 256; ++i) {
        const Vec2 jitter = samplePattern(i, 256);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x) {
                const Vec3 c = hardScene(float(x) + 0.5f - jitter.x, float(y) + 0.5f - jitter.y);
                const double w = 1 / (1 + double(luminance(c)) * factor);
                const std::size_t p = std::size_t(kHeight - 1 - y) * kWidth + std::size_t(x);
                sums[p * 3] += c.x * w, sums[p * 3 + 1] += c.y * w, sums[p * 3 + 2] += c.z * w, weights[p] += w;
            }
    }
    Image expected(kWidth, kHeight, 4);
    for (std::size_t p = 0; p < weights.size(); ++p) {
        for (std::size_t k = 0; k < 3; ++k) expected.pixels[p * 4 + k] = float(sums[p * 3 + k] / weights[p]);
        expected.pixels[p * 4 + 3] = 1;
    }
    temporal(hardScene, 0);
    const Image first = radiance();
    for (int frame = 1; frame < 96; ++frame) temporal(hardScene, frame);
    const Image last = radiance();
    EXPECT_GT(meanDifference(first, expected), 0.02) << "the scene is too easy";
    EXPECT_LT(meanDifference(last, expected), 0.004);  // 0.0007 measured
}

TEST_F(FramePost, StillViewsDoNotFlicker) {
    for (int frame = 0; frame < 64; ++frame) temporal(hardScene, frame);
    Image before = radiance();
    double largest = 0;
    for (int frame = 64; frame < 96; ++frame) {
        temporal(hardScene, frame);
        const Image now = radiance();
        largest = std::max(largest, largestDifference(before, now));
        before = now;
    }
    // The line is 4 W/(m2 sr): one sample in 64 moves a pixel by 0.06 at most, unless something resets its history.
    EXPECT_LT(largest, 0.1);
}

TEST_F(FramePost, ChangesOfLightShowAtOnce) {
    for (int frame = 0; frame < 40; ++frame) temporal([](float, float) { return Vec3{1, 1, 1}; }, frame);
    temporal([](float, float) { return Vec3{0.25f, 0.25f, 0.25f}; }, 40);
    EXPECT_NEAR(radiance().at(10, 10)[0], 0.25f, 0.02f);
}

TEST_F(FramePost, MovingPicturesAreFollowed) {
    // The picture moves 3 pixels right a frame; the motion buffer says so.
    const float motion[2] = {3, 0};
    glClearTexImage(targets_->gbuffer().motion.name, 0, GL_RG, GL_FLOAT, motion);
    const auto smooth = [](float x, float y) {
        return Vec3{0.5f + 0.3f * std::sin(x * 0.4f), 0.5f + 0.2f * std::cos(y * 0.5f), 0.5f};
    };
    for (int frame = 0; frame < 12; ++frame)
        temporal([&](float x, float y) { return smooth(x - 3.0f * float(frame), y); }, frame);
    const Image image = radiance();
    double sum = 0;
    for (int y = 4; y < kHeight - 4; ++y)
        for (int x = 4; x < kWidth - 4; ++x)
            sum += std::abs(double(image.at(x, kHeight - 1 - y)[0]) -
                            double(smooth(float(x) + 0.5f - 33, float(y) + 0.5f).x));
    EXPECT_LT(sum / double((kWidth - 8) * (kHeight - 8)), 0.02);
}

TEST_F(FramePost, FirstFrameAndResetAreTheFrameItself) {
    temporal(hardScene, 0);
    const Image first = radiance();
    const Image drawn = *readImage(device(), targets_->radiance(), 4);
    EXPECT_EQ(first.pixels, drawn.pixels);
    for (int frame = 1; frame < 5; ++frame) temporal(constant, frame);
    put(hardScene);
    post_->temporal(context_, *targets_, true);
    EXPECT_EQ(radiance().pixels, readImage(device(), targets_->radiance(), 4)->pixels);
}

// ---- exposure and display ----

TEST_F(FramePost, FixedExposureIsStops) {
    supersample([](float, float) { return Vec3{0.125f, 0.25f, 0.5f}; }, 1);
    PostParams params = plain("none");
    params.exposureEv = 1;
    const ByteImage shown = display(params);
    EXPECT_EQ(shown.pixels[0], 64);
    EXPECT_EQ(shown.pixels[1], 128);
    EXPECT_EQ(shown.pixels[2], 255);
    EXPECT_EQ(shown.pixels[3], 255);
    EXPECT_EQ(post_->exposure(), 2);
}

TEST_F(FramePost, PlainCurveIsSrgbWithinTheNoiseOfHalfAStep) {
    const auto ramp = [](float x, float) { return Vec3{x / kWidth, x / kWidth, x / kWidth}; };
    supersample(ramp, 1);
    const ByteImage shown = display(plain("plain"));
    for (int x = 0; x < kWidth; ++x) {
        const float expected = 255 * srgbFromLinear((float(x) + 0.5f) / kWidth);
        EXPECT_NEAR(shown.pixels[(9 * kWidth + x) * 4], expected, 1.2f);
    }
}

TEST_F(FramePost, BlackIsBlackAndWhiteIsWhite) {
    for (const char* curve : {"plain", "none"}) {
        supersample([](float x, float) { return x < 24 ? Vec3{} : Vec3{1, 1, 1}; }, 1);
        const ByteImage shown = display(plain(curve));
        for (int y = 0; y < kHeight; ++y) {
            EXPECT_EQ(shown.pixels[(y * kWidth + 3) * 4], 0);
            EXPECT_EQ(shown.pixels[(y * kWidth + 40) * 4], 255);
        }
    }
}

TEST_F(FramePost, AutomaticExposureBringsTheSceneToMiddleGrey) {
    for (const float light : {0.001f, 1.0f, 300.0f}) {
        supersample([&](float, float) { return Vec3{light, light, light}; }, 1);
        PostParams params = plain("none");
        params.exposureMode = "automatic";
        display(params);
        // A bin of the histogram is 0.3125 stops wide.
        EXPECT_NEAR(std::log2(post_->exposure() * light / 0.285f), 0, 0.17f) << light;
    }
}

TEST_F(FramePost, AutomaticExposureIgnoresLampsAndFollowsOverTime) {
    PostParams params = plain("none");
    params.exposureMode = "automatic";
    params.adaptation = 2;
    supersample(
        [](float x, float y) {
            return x > 22 && x < 26 && y > 12 && y < 15 ? Vec3{9000, 9000, 9000} : Vec3{1, 1, 1};
        },
        1);
    display(params, true);
    const float start = post_->exposure();
    EXPECT_NEAR(std::log2(start / 0.285f), 0, 0.25f);
    supersample([](float, float) { return Vec3{16, 16, 16}; }, 1);
    context_.timeStep = 2;  // one time constant: 63 % of the way, in stops
    display(params, false);
    EXPECT_NEAR(std::log2(start / post_->exposure()), 4 * (1 - std::exp(-1.0f)), 0.3f);
}

TEST_F(FramePost, BloomKeepsTheSumAndSpreads) {
    const auto lamp = [](float x, float y) {
        return std::abs(x - 24) < 2 && std::abs(y - 16) < 2 ? Vec3{0.9f, 0.9f, 0.9f} : Vec3{};
    };
    supersample(lamp, 1);
    PostParams params = plain("none");
    const ByteImage sharp = display(params);
    params.bloom = 0.5f;
    const ByteImage glowing = display(params);
    EXPECT_EQ(sharp.pixels[(16 * kWidth + 30) * 4], 0);
    EXPECT_GT(glowing.pixels[(16 * kWidth + 28) * 4], 0);
    EXPECT_LT(glowing.pixels[(16 * kWidth + 24) * 4], sharp.pixels[(16 * kWidth + 24) * 4]);
}

TEST_F(FramePost, SameInputSameBits) {
    PostParams params;
    params.exposureMode = "automatic";
    params.bloom = 0.1f;
    supersample(hardScene, 8);
    const ByteImage first = display(params);
    const Image linear = radiance();
    for (int i = 0; i < 3; ++i) {
        supersample(hardScene, 8);
        EXPECT_EQ(display(params).pixels, first.pixels);
        EXPECT_EQ(radiance().pixels, linear.pixels);
    }
    EXPECT_EQ(device().debugErrorCount(), 0);
}

// ---- read-back ----

TEST_F(FramePost, ReadingTurnsTheTopRowUp) {
    struct Case {
        gl::Enum format;
        int channels;
    };
    for (const Case c : {Case{GL_RGBA32F, 4}, Case{GL_RGBA16F, 4}, Case{GL_R11F_G11F_B10F, 3}, Case{GL_RG16F, 2},
                         Case{GL_RG16, 2}, Case{GL_R32F, 1}, Case{GL_R8, 1}, Case{GL_RGBA8, 4}}) {
        const gl::Texture texture =
            gl::Texture::create(device(), {.format = c.format, .width = 3, .height = 2, .label = "pattern"});
        const float rows[24] = {0, 0,    0,     1, 0, 0,    0,     1, 0,     0,    0,     1,  // bottom, as GL counts
                                1, 0.5f, 0.25f, 1, 1, 0.5f, 0.25f, 1, 0.25f, 0.5f, 0.25f, 1};
        glTextureSubImage2D(texture.name(), 0, 0, 0, 3, 2, GL_RGBA, GL_FLOAT, rows);
        const auto image = readImage(device(), texture, c.channels);
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_NEAR(image->at(0, 0)[0], 1, 1e-6f) << c.format;
        EXPECT_NEAR(image->at(2, 0)[0], 0.25f, 0.003f);
        EXPECT_EQ(image->at(0, 1)[0], 0);
        if (c.channels > 1) {
            EXPECT_NEAR(image->at(1, 0)[1], 0.5f, 0.003f);
            EXPECT_EQ(readImage(device(), texture, 1)->channelCount, 1);
        }
    }
    const gl::Texture ids =
        gl::Texture::create(device(), {.format = GL_R32UI, .width = 2, .height = 2, .label = "ids"});
    const std::uint32_t values[4] = {1, 2, 70000, 4};
    glTextureSubImage2D(ids.name(), 0, 0, 0, 2, 2, GL_RED_INTEGER, GL_UNSIGNED_INT, values);
    const Image image = *readImage(device(), ids, 1);
    EXPECT_EQ(image.at(0, 0)[0], 70000);
    EXPECT_EQ(image.at(1, 1)[0], 2);
    const gl::Texture bytes =
        gl::Texture::create(device(), {.format = GL_RGBA8, .width = 1, .height = 2, .label = "bytes"});
    const std::uint8_t pixels[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    glTextureSubImage2D(bytes.name(), 0, 0, 0, 1, 2, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    EXPECT_EQ(readByteImage(device(), bytes)->pixels, (std::vector<std::uint8_t>{5, 6, 7, 8, 1, 2, 3, 4}));
}

TEST_F(FramePost, ReadingSaysWhatItCannot) {
    EXPECT_FALSE(readImage(device(), {}, 1));
    const gl::Texture texture =
        gl::Texture::create(device(), {.format = GL_R8, .width = 1, .height = 1, .label = "one"});
    const auto tooMany = readImage(device(), texture, 4);
    ASSERT_FALSE(tooMany);
    EXPECT_NE(tooMany.error().message.find("4 channels"), std::string::npos) << tooMany.error().message;
    EXPECT_FALSE(readByteImage(device(), texture));
}

}  // namespace
}  // namespace shoal::frame
