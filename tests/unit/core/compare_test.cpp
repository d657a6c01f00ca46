// Metrics against closed forms and a direct sum over every window.
#include <oneapi/tbb/task_arena.h>
#include <shoal/core/compare.h>
#include <shoal/core/parallel.h>
#include <shoal/core/random.h>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace shoal {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

Image constant(int width, int height, int channelCount, float value) {
    Image image(width, height, channelCount);
    for (float& p : image.pixels) p = value;
    return image;
}

Image noise(int width, int height, int channelCount, std::uint32_t seed, float scale = 1) {
    Image image(width, height, channelCount);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = scale * randomFloat(seed, std::uint32_t(i));
    return image;
}

// SSIM by the definition [Wang et al. 2004]: for each pixel a weighted mean, variances and covariance over its window.
double directSsim(const Image& a, const Image& b, double range) {
    const bool inner = a.width >= 11 && a.height >= 11;
    const double c1 = std::pow(0.01 * range, 2), c2 = std::pow(0.03 * range, 2);
    const auto value = [](const Image& image, int x, int y) {
        const float* p = image.at(x, y);
        return image.channelCount >= 3 ? double(luminance({p[0], p[1], p[2]})) : double(p[0]);
    };
    double total = 0;
    int count = 0;
    for (int y = inner ? 5 : 0; y < a.height - (inner ? 5 : 0); ++y)
        for (int x = inner ? 5 : 0; x < a.width - (inner ? 5 : 0); ++x, ++count) {
            const auto weighted = [&](const auto& term) {
                double sum = 0, weights = 0;
                for (int v = std::max(0, y - 5); v <= std::min(a.height - 1, y + 5); ++v)
                    for (int u = std::max(0, x - 5); u <= std::min(a.width - 1, x + 5); ++u) {
                        const double w = std::exp(-((u - x) * (u - x) + (v - y) * (v - y)) / (2 * 1.5 * 1.5));
                        sum += w * term(value(a, u, v), value(b, u, v));
                        weights += w;
                    }
                return sum / weights;
            };
            const double ma = weighted([](double p, double) { return p; }),
                         mb = weighted([](double, double q) { return q; });
            const double va = weighted([&](double p, double) { return (p - ma) * (p - ma); });
            const double vb = weighted([&](double, double q) { return (q - mb) * (q - mb); });
            const double cov = weighted([&](double p, double q) { return (p - ma) * (q - mb); });
            total += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
        }
    return total / count;
}

TEST(Compare, EqualPicturesAreEqual) {
    const Image a = noise(33, 21, 3, 1);
    const Comparison c = *compare(a, a);
    EXPECT_EQ(c.rmse, 0);
    EXPECT_EQ(c.psnr, std::numeric_limits<double>::infinity());
    EXPECT_EQ(c.ssim, 1);
    EXPECT_EQ(c.largest, 0);
    EXPECT_EQ(c.differingPixels, 0u);
    EXPECT_EQ(c.nonFinite, 0u);
}

TEST(Compare, OneChangedChannel) {
    const Image a = constant(40, 30, 4, 0.5f);
    Image b = a;
    b.at(17, 23)[2] = 0.75f;
    const Comparison c = *compare(a, b);
    EXPECT_NEAR(c.rmse, std::sqrt(0.25 * 0.25 / (40 * 30 * 4)), 1e-12);
    EXPECT_NEAR(c.psnr, -20 * std::log10(c.rmse), 1e-9);
    EXPECT_EQ(c.largest, 0.25);
    EXPECT_EQ(c.largestX, 17);
    EXPECT_EQ(c.largestY, 23);
    EXPECT_EQ(c.differingPixels, 1u);
    EXPECT_NEAR(c.meanA, 0.5, 1e-12);
    EXPECT_NEAR(c.meanB, 0.5 + 0.25 / 4800, 1e-12);
    EXPECT_LT(c.ssim, 1);
}

TEST(Compare, LargestIsTheFirstOfEqualOnesFromTheTop) {
    const Image a = constant(8, 200, 1, 0);
    Image b = a;
    b.at(3, 150)[0] = b.at(5, 60)[0] = b.at(6, 60)[0] = 1;
    EXPECT_EQ(compare(a, b)->largestX, 5);
    EXPECT_EQ(compare(a, b)->largestY, 60);
}

TEST(Compare, PsnrOfHdrTakesTheReferencesPeak) {
    const Comparison c = *compare(constant(12, 12, 1, 9), constant(12, 12, 1, 10));
    EXPECT_NEAR(c.rmse, 1, 1e-12);
    EXPECT_NEAR(c.psnr, 20, 1e-9);
}

TEST(Compare, SsimOfConstantsIsTheLuminanceTerm) {
    const double a = 0.25, b = 0.5, c1 = 0.01 * 0.01;
    const Comparison c = *compare(constant(20, 20, 1, float(a)), constant(20, 20, 1, float(b)));
    EXPECT_NEAR(c.ssim, (2 * a * b + c1) / (a * a + b * b + c1), 1e-9);
}

TEST(Compare, SsimEqualsTheDirectSum) {
    struct Case {
        int width, height, channelCount;
    };
    for (const Case s :
         {Case{47, 81, 3}, Case{11, 11, 1}, Case{12, 70, 4}, Case{7, 5, 3}, Case{40, 3, 1}, Case{1, 1, 1}}) {
        const Image a = noise(s.width, s.height, s.channelCount, 1),
                    other = noise(s.width, s.height, s.channelCount, 2);
        Image b = a;
        for (std::size_t i = 0; i < b.pixels.size(); ++i) b.pixels[i] = 0.7f * a.pixels[i] + 0.3f * other.pixels[i];
        EXPECT_NEAR(compare(a, b)->ssim, directSsim(a, b, 1), 1e-9) << s.width << "x" << s.height;
    }
}

TEST(Compare, SsimTellsStructureFromBrightness) {
    const Image b = noise(64, 64, 1, 3);
    Image brighter = b, negative = b;
    for (float& p : brighter.pixels) p += 0.05f;
    for (float& p : negative.pixels) p = 1 - p;
    EXPECT_GT(compare(brighter, b)->ssim, 0.95);
    EXPECT_LT(compare(negative, b)->ssim, 0);
    EXPECT_LT(std::abs(compare(noise(64, 64, 1, 4), b)->ssim), 0.1);
}

// A few very bright pixels must not blind the measure for the rest.
TEST(Compare, SsimOfHdrIsNotRuledByTheSun) {
    Image a = noise(64, 64, 1, 3), b = noise(64, 64, 1, 4);
    for (Image* image : {&a, &b}) image->at(2, 2)[0] = 1e5f;
    EXPECT_LT(compare(a, b)->ssim, 0.2);
    const Image depthA = noise(40, 40, 1, 5, 50),
                depthB = noise(40, 40, 1, 6, 50);  // metres: the range grows with them
    std::vector<float> sorted = depthB.pixels;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_NEAR(compare(depthA, depthB)->ssim, directSsim(depthA, depthB, double(sorted[std::size_t(0.99 * 1599)])),
                1e-9);
}

TEST(Compare, NonFiniteValuesAreCountedAndTheRestStaysFinite) {
    const Image a = noise(30, 30, 3, 1);
    Image b = a;
    b.at(4, 4)[1] = kNan;
    b.at(9, 9)[0] = kInfinity;
    b.at(20, 20)[0] += 0.5f;
    for (const Comparison& c : {*compare(a, b), *compare(b, a)}) {
        EXPECT_EQ(c.nonFinite, 2u);
        EXPECT_EQ(c.differingPixels, 3u);
        EXPECT_EQ(c.largestX, 20);
        EXPECT_NEAR(c.rmse, std::sqrt(0.25 / (2700 - 2)), 1e-6);
        EXPECT_TRUE(std::isfinite(c.psnr) && std::isfinite(c.ssim) && std::isfinite(c.meanA) && std::isfinite(c.meanB));
    }
    EXPECT_EQ(compare(b, b)->nonFinite, 4u);  // equal bits, and still counted
    EXPECT_EQ(compare(b, b)->differingPixels, 0u);
    const Comparison all = *compare(constant(4, 4, 1, kNan), constant(4, 4, 1, 1));
    EXPECT_EQ(all.nonFinite, 16u);
    EXPECT_TRUE(std::isfinite(all.rmse));
}

TEST(Compare, SignedZeroIsAnotherBit) {
    EXPECT_EQ(compare(constant(2, 2, 1, 0.0f), constant(2, 2, 1, -0.0f))->differingPixels, 4u);
}

TEST(Compare, SizesMustAgree) {
    EXPECT_EQ(compare(Image(2, 3, 1), Image(3, 2, 4)).error().message,
              "pictures differ in size: found 2x3 with 1 channel, expected 3x2 with 4 channels");
    EXPECT_FALSE(compare(Image(2, 3, 1), Image(2, 3, 3)));
    EXPECT_EQ(compare(Image(), Image()).error().message,
              "pictures are empty: found 0x0 with 0 channels, expected at least one pixel");
}

TEST(Compare, SameBitsForAnyThreadCount) {
    const Image a = noise(320, 200, 3, 1, 3), b = noise(320, 200, 3, 2, 3);
    const Comparison all = *compare(a, b);
    for (const int threadCount : {1, 2, 8}) {
        const ThreadLimit limit(threadCount);
        tbb::task_arena arena(threadCount);
        const Comparison c = arena.execute([&] { return *compare(a, b); });
        EXPECT_EQ(c.rmse, all.rmse);
        EXPECT_EQ(c.ssim, all.ssim);
        EXPECT_EQ(c.meanA, all.meanA);
        EXPECT_EQ(c.largestX, all.largestX);
    }
}

TEST(DifferenceImage, IsTheAbsoluteDifferenceTimesGain) {
    Image a = constant(3, 2, 3, 0.5f), b = a;
    b.at(1, 1)[0] = 0.75f;
    b.at(1, 1)[2] = 0.25f;
    a.at(0, 0)[1] = kNan;
    a.at(2, 0)[1] = b.at(2, 0)[1] = kInfinity;
    const Image d = differenceImage(a, b, 4);
    EXPECT_EQ(d.channelCount, 3);
    EXPECT_EQ(d.at(1, 1)[0], 1);
    EXPECT_EQ(d.at(1, 1)[1], 0);
    EXPECT_EQ(d.at(1, 1)[2], 1);
    EXPECT_EQ(d.at(0, 0)[1], 4);  // NaN on one side
    EXPECT_EQ(d.at(2, 0)[1], 0);  // the same infinity on both
}

TEST(DifferenceImage, ADifferenceInAlphaIsSeen) {
    const Image a = constant(1, 1, 4, 0.5f);
    Image b = a;
    b.at(0, 0)[3] = 1;
    const Image d = differenceImage(a, b, 1);
    ASSERT_EQ(d.channelCount, 3);
    for (int c = 0; c < 3; ++c) EXPECT_EQ(d.at(0, 0)[c], 0.5f);
}

TEST(DifferenceImageDeathTest, RefusesOtherSizes) {
    EXPECT_DEATH(differenceImage(Image(1, 2, 3), Image(2, 1, 3), 1), "1x2 with 3 channels and 2x1 with 3 channels");
}

}  // namespace
}  // namespace shoal
