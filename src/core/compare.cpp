// [Wang et al. 2004] Image Quality Assessment: From Error Visibility to Structural Similarity, IEEE TIP 13(4). The
// Gaussian window is separable: rows are filtered first, then columns, a strip of rows at a time.
#include <fmt/format.h>
#include <shoal/core/assert.h>
#include <shoal/core/compare.h>
#include <shoal/core/parallel.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace shoal {

namespace {

constexpr std::size_t kRowGrain = 32;
constexpr int kReach = 5;  // the window's pixels to either side of its middle
constexpr int kWindow = 2 * kReach + 1;
constexpr double kSigma = 1.5, kK1 = 0.01, kK2 = 0.03;
constexpr double kRangePercentile = 0.99;

bool sameBits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

struct Sums {
    double squares = 0, a = 0, b = 0, peak = 0, largest = 0;
    int largestX = 0, largestY = 0;
    std::size_t finite = 0, nonFinite = 0, differingPixels = 0;
};

void addPixel(const float* a, const float* b, int channelCount, int x, int y, Sums& sums) {
    bool differs = false;
    for (int c = 0; c < channelCount; ++c) {
        differs |= !sameBits(a[c], b[c]);
        const bool finiteA = std::isfinite(a[c]), finiteB = std::isfinite(b[c]);
        sums.nonFinite += std::size_t(!finiteA) + std::size_t(!finiteB);
        if (!finiteA || !finiteB) continue;
        ++sums.finite;
        const double difference = std::abs(double(a[c]) - double(b[c]));
        sums.squares += difference * difference;
        sums.a += a[c];
        sums.b += b[c];
        sums.peak = std::max(sums.peak, double(b[c]));
        if (difference > sums.largest) sums.largest = difference, sums.largestX = x, sums.largestY = y;
    }
    sums.differingPixels += differs;
}

Sums combine(Sums sum, const Sums& next) {
    sum.squares += next.squares;
    sum.a += next.a;
    sum.b += next.b;
    sum.peak = std::max(sum.peak, next.peak);
    if (next.largest > sum.largest)
        sum.largest = next.largest, sum.largestX = next.largestX, sum.largestY = next.largestY;
    sum.finite += next.finite;
    sum.nonFinite += next.nonFinite;
    sum.differingPixels += next.differingPixels;
    return sum;
}

Sums sumUp(const Image& a, const Image& b) {
    const auto sumRows = [&](std::size_t begin, std::size_t end) {
        Sums sums;
        for (int y = int(begin); y < int(end); ++y)
            for (int x = 0; x < a.width; ++x) addPixel(a.at(x, y), b.at(x, y), a.channelCount, x, y, sums);
        return sums;
    };
    return parallelReduce(std::size_t(a.height), kRowGrain, Sums{}, sumRows, combine);
}

float luminanceOf(const float* pixel, int channelCount) {
    const float value = channelCount >= 3   ? luminance({pixel[0], pixel[1], pixel[2]})
                        : channelCount == 2 ? 0.5f * (pixel[0] + pixel[1])
                                            : pixel[0];
    return std::isfinite(value) ? value : 0.0f;
}

// Weights of the window, and their sum over the part that lies inside [0, size) for a window around each of its places.
struct Window {
    std::array<double, kWindow> weights{};
    Window() {
        double sum = 0;
        for (int i = 0; i < kWindow; ++i) {
            const double offset = (i - kReach) / kSigma;
            sum += weights[std::size_t(i)] = std::exp(-0.5 * offset * offset);
        }
        for (double& weight : weights) weight /= sum;
    }
    std::vector<double> sumsInside(int size) const {
        std::vector<double> sums(std::size_t(size), 0.0);
        for (int middle = 0; middle < size; ++middle)
            for (int i = 0; i < kWindow; ++i)
                if (const int at = middle + i - kReach; at >= 0 && at < size)
                    sums[std::size_t(middle)] += weights[std::size_t(i)];
        return sums;
    }
};

enum Moment { meanA, meanB, squareA, squareB, product, kMomentCount };

// The moments of one row, filtered along it. moments: kMomentCount rows of width values each.
void filterRow(const Image& a, const Image& b, int y, const Window& window, std::vector<double>& padded,
               double* moments) {
    const std::size_t width = std::size_t(a.width), stride = width + 2 * kReach;
    padded.assign(stride * kMomentCount, 0.0);  // zeros beyond the border
    for (std::size_t x = 0; x < width; ++x) {
        const double la = luminanceOf(a.at(int(x), y), a.channelCount),
                     lb = luminanceOf(b.at(int(x), y), b.channelCount);
        double* to = padded.data() + x + kReach;
        to[meanA * stride] = la;
        to[meanB * stride] = lb;
        to[squareA * stride] = la * la;
        to[squareB * stride] = lb * lb;
        to[product * stride] = la * lb;
    }
    for (int m = 0; m < kMomentCount; ++m) {
        const double* from = padded.data() + std::size_t(m) * stride;
        double* to = moments + std::size_t(m) * width;
        for (std::size_t x = 0; x < width; ++x) {
            double sum = 0;
            for (std::size_t i = 0; i < kWindow; ++i) sum += window.weights[i] * from[x + i];
            to[x] = sum;
        }
    }
}

double similarity(const std::array<double, kMomentCount>& m, double range) {
    const double c1 = kK1 * range * kK1 * range, c2 = kK2 * range * kK2 * range;
    const double varianceA = m[squareA] - m[meanA] * m[meanA], varianceB = m[squareB] - m[meanB] * m[meanB];
    const double covariance = m[product] - m[meanA] * m[meanB];
    return (2 * m[meanA] * m[meanB] + c1) * (2 * covariance + c2) /
           ((m[meanA] * m[meanA] + m[meanB] * m[meanB] + c1) * (varianceA + varianceB + c2));
}

double structuralSimilarity(const Image& a, const Image& b, double range) {
    const Window window;
    const int border = a.width >= kWindow && a.height >= kWindow ? kReach : 0;
    const std::vector<double> insideX = window.sumsInside(a.width), insideY = window.sumsInside(a.height);
    const std::size_t width = std::size_t(a.width), rowSize = width * kMomentCount;
    const int rowCount = a.height - 2 * border;

    const auto sumRows = [&](std::size_t begin, std::size_t end) {
        const int top = int(begin) + border, bottom = int(end) + border;
        const int first = std::max(top - kReach, 0), last = std::min(bottom + kReach, a.height);
        std::vector<double> filtered(std::size_t(last - first) * rowSize), padded, sums(rowSize);
        for (int y = first; y < last; ++y)
            filterRow(a, b, y, window, padded, filtered.data() + std::size_t(y - first) * rowSize);
        double total = 0;
        for (int y = top; y < bottom; ++y) {
            std::fill(sums.begin(), sums.end(), 0.0);
            for (int i = 0; i < kWindow; ++i) {
                const int row = y + i - kReach;
                if (row < first || row >= last) continue;
                const double weight = window.weights[std::size_t(i)] / insideY[std::size_t(y)];
                const double* from = filtered.data() + std::size_t(row - first) * rowSize;
                for (std::size_t k = 0; k < rowSize; ++k) sums[k] += weight * from[k];
            }
            for (std::size_t x = std::size_t(border); x < width - std::size_t(border); ++x) {
                std::array<double, kMomentCount> moments;
                for (std::size_t m = 0; m < kMomentCount; ++m) moments[m] = sums[m * width + x] / insideX[x];
                total += similarity(moments, range);
            }
        }
        return total;
    };
    const double total = parallelReduce(std::size_t(rowCount), kRowGrain, 0.0, sumRows, std::plus<>());
    return total / (double(rowCount) * double(a.width - 2 * border));
}

double luminanceRange(const Image& b) {
    std::vector<float> luminances(std::size_t(b.width) * std::size_t(b.height));
    parallelFor(luminances.size(), std::size_t(b.width) * kRowGrain, [&](std::size_t i) {
        luminances[i] = luminanceOf(b.pixels.data() + i * std::size_t(b.channelCount), b.channelCount);
    });
    const auto at = luminances.begin() + std::ptrdiff_t(double(luminances.size() - 1) * kRangePercentile);
    std::nth_element(luminances.begin(), at, luminances.end());
    return std::max(1.0, double(*at));
}

std::string sizeWords(const Image& image) {
    return fmt::format("{}x{} with {} channel{}", image.width, image.height, image.channelCount,
                       image.channelCount == 1 ? "" : "s");
}

bool sameSize(const Image& a, const Image& b) {
    return a.width == b.width && a.height == b.height && a.channelCount == b.channelCount;
}

}  // namespace

Result<Comparison> compare(const Image& a, const Image& b) {
    if (!sameSize(a, b))
        return badInput(fmt::format("pictures differ in size: found {}, expected {}", sizeWords(a), sizeWords(b)));
    if (a.empty())
        return badInput(fmt::format("pictures are empty: found {}, expected at least one pixel", sizeWords(a)));
    SHOAL_ASSERT_EQ(a.pixels.size(), b.pixels.size());

    const Sums sums = sumUp(a, b);
    Comparison result;
    result.largest = sums.largest;
    result.largestX = sums.largestX;
    result.largestY = sums.largestY;
    result.differingPixels = sums.differingPixels;
    result.nonFinite = sums.nonFinite;
    const double peak = std::max(1.0, sums.peak);
    if (sums.finite > 0) {
        result.rmse = std::sqrt(sums.squares / double(sums.finite));
        result.meanA = sums.a / double(sums.finite);
        result.meanB = sums.b / double(sums.finite);
    }
    result.psnr = result.rmse > 0 ? 20 * std::log10(peak / result.rmse) : std::numeric_limits<double>::infinity();
    if (sums.differingPixels > 0) result.ssim = structuralSimilarity(a, b, peak > 1 ? luminanceRange(b) : 1.0);
    return result;
}

Image differenceImage(const Image& a, const Image& b, float gain) {
    SHOAL_ASSERT_MSG(sameSize(a, b), sizeWords(a) + " and " + sizeWords(b));
    const int channelCount = a.channelCount;
    const bool alpha = channelCount == 2 || channelCount == 4;
    Image result(a.width, a.height, alpha ? channelCount - 1 : channelCount);
    const auto difference = [](float x, float y) {
        if (std::isfinite(x) && std::isfinite(y)) return std::abs(x - y);
        return sameBits(x, y) ? 0.0f : 1.0f;
    };
    parallelFor(std::size_t(a.height), kRowGrain, [&](std::size_t y) {
        for (int x = 0; x < a.width; ++x) {
            const float *pa = a.at(x, int(y)), *pb = b.at(x, int(y));
            const float alphaDifference = alpha ? difference(pa[channelCount - 1], pb[channelCount - 1]) : 0.0f;
            float* to = result.at(x, int(y));
            for (int c = 0; c < result.channelCount; ++c)
                to[c] = gain * std::max(alphaDifference, difference(pa[c], pb[c]));
        }
    });
    return result;
}

}  // namespace shoal
