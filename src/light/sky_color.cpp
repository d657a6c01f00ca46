// Skylight and sunlight behind air have smooth spectra: the logarithm of radiance is close to a parabola over the
// logarithm of wavelength (scattering is a power of it, extinction the exponential of one). The spectrum is therefore
// taken through the three wavelengths that were integrated and weighted with the eye's matching functions. Taking 680
// nm as red itself, as is often done, makes twilight purple and noon too saturated.
//   [Wyman, Sloan & Shirley 2013] Simple Analytic Approximations to the CIE XYZ Color Matching Functions, JCGT 2(2).
#include "light/sky_color.h"

#include <array>
#include <cmath>

namespace shoal::light {
namespace {

constexpr int kBandCount = 16;  // even in the logarithm of wavelength
constexpr double kFirstNm = 405, kLastNm = 700;

double lobe(double nm, double center, double below, double above) {
    const double t = (nm - center) * (nm < center ? below : above);
    return std::exp(-0.5 * t * t);
}

struct Bands {
    std::array<Vec3, kBandCount> weights;  // of a band in red, green and blue
    double first, step;                    // logarithm of wavelength over 550 nm
};

Bands makeBands() {
    Bands bands;
    bands.first = std::log(kFirstNm / 550);
    bands.step = std::log(kLastNm / kFirstNm) / (kBandCount - 1);
    double rgb[kBandCount][3], sum[3]{};
    for (int i = 0; i < kBandCount; ++i) {
        const double nm = kFirstNm * std::exp(bands.step * i);
        const double x = 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) + 0.362 * lobe(nm, 442.0, 0.0624, 0.0374) -
                         0.065 * lobe(nm, 501.1, 0.0490, 0.0382);
        const double y = 0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322);
        const double z = 1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725);
        rgb[i][0] = nm * (3.2406 * x - 1.5372 * y - 0.4986 * z);  // nm: bands are wider at long wavelengths
        rgb[i][1] = nm * (-0.9689 * x + 1.8758 * y + 0.0415 * z);
        rgb[i][2] = nm * (0.0557 * x - 0.2040 * y + 1.0570 * z);
        for (int k = 0; k < 3; ++k) sum[k] += rgb[i][k];
    }
    for (int i = 0; i < kBandCount; ++i)
        bands.weights[std::size_t(i)] = {float(rgb[i][0] / sum[0]), float(rgb[i][1] / sum[1]),
                                         float(rgb[i][2] / sum[2])};
    return bands;
}

}  // namespace

Vec3 colorOfThreeWavelengths(Vec3 at) {
    static const Bands bands = makeBands();
    static const double kRed = std::log(680.0 / 550), kBlue = std::log(440.0 / 550);
    constexpr float kLeast = 1e-20f;  // keeps the logarithm finite in the dark
    const double middle = std::log(double(std::max(at.y, kLeast)));
    const double red = (std::log(double(std::max(at.x, kLeast))) - middle) / kRed;
    const double blue = (std::log(double(std::max(at.z, kLeast))) - middle) / kBlue;
    const double bend = (red - blue) / (kRed - kBlue), slope = red - bend * kRed;
    // exp of a parabola at even steps: each value and each ratio of neighbours follows from the last by a product.
    double value = std::exp(middle + bands.first * (slope + bend * bands.first));
    double ratio = std::exp(bands.step * (slope + bend * (2 * bands.first + bands.step)));
    const double change = std::exp(2 * bend * bands.step * bands.step);
    Vec3 color;
    for (const Vec3& weight : bands.weights) {
        color += weight * float(value);
        value *= ratio;
        ratio *= change;
    }
    return max(color, {0, 0, 0});
}

}  // namespace shoal::light
