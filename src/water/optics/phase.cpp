// [Fournier & Forand 1994] as given by [Fournier & Jonasz 1999]; [Mobley, Sundman & Boss 2002] for the choice of the
// two parameters by backscatter; [Potter 1970] for the function without its forward peak.
#include "water/optics/phase.h"

#include <algorithm>
#include <cmath>

#include <shoal/core/math.h>

namespace shoal::water {

double FournierForand::at(double sine2) const {
    const double v = 0.5 * (3 - slope), steep = 4 / (3 * (index - 1) * (index - 1));
    const double delta = steep * sine2, e = 1 - delta, power = std::pow(delta, v);
    double first = 0, second = 0;
    if (std::abs(e) < 1e-2) {
        // Binomial series of the two brackets over e^2.
        double a = 0.5 * v * (v - 1), b = 0.5 * (v + 1) * v, sign = 1, reach = 1;
        for (int j = 2; j < 10; ++j) {
            first += sign * a * reach, second -= sign * b * reach;
            a *= (v - j) / (j + 1), b *= (v + 1 - j) / (j + 1);
            sign = -sign, reach *= e;
        }
    } else {
        first = (v * e - (1 - power)) / (e * e);
        second = (delta * (1 - power) - v * e) / (e * e);
    }
    const double backPower = std::pow(steep, v), cosTheta = 1 - 2 * sine2;
    const double back = (1 - backPower) / (16 * kPiD * (steep - 1) * backPower) * (3 * cosTheta * cosTheta - 1);
    return std::max((first + second / sine2) / (4 * kPiD * power) + back, 0.0);
}

double FournierForand::backscatter() const {
    const double v = 0.5 * (3 - slope), delta = 2 / (3 * (index - 1) * (index - 1)), power = std::pow(delta, v);
    return 1 - (1 - delta * power - 0.5 * (1 - power)) / ((1 - delta) * power);
}

FournierForand fournierForandOf(double backscatter) {
    const auto family = [](double slope) { return FournierForand{1.01 + 0.1542 * (slope - 3), slope}; };
    double low = 3.01, high = 4.9;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (family(middle).backscatter() < backscatter ? low : high) = middle;
    }
    return family(0.5 * (low + high));
}

PhaseMoments momentsOf(const FournierForand& function, double peak) {
    // dOmega = 4 pi d(sine2); in the logarithm of sine2, where the function is smooth. Below `least` it is a power of
    // sine2, -(1 + v).
    const double least = 1e-10, from = std::max(peak, least);
    const int steps = 800;  // even; Simpson's rule
    const double low = std::log(from), width = -low / steps;
    PhaseMoments m;
    double cosine = 0;
    for (int i = 0; i <= steps; ++i) {
        const double sine2 = std::exp(low + width * i), weight = (i == 0 || i == steps) ? 1 : (i % 2 ? 4 : 2);
        const double light = weight * function.at(std::min(sine2, 1.0)) * sine2;
        m.total += light, cosine += light * (1 - 2 * sine2);
    }
    const double scale = 4 * kPiD * width / 3;
    m.total *= scale, cosine *= scale;
    const double belowPeak = peak >= least ? 1 : 2 / (function.slope - 3);
    const double held = 4 * kPiD * from * function.at(from) * belowPeak;
    m.total += held, cosine += held * (1 - from);
    m.meanCosine = m.total > 0 ? cosine / m.total : 0;
    return m;
}

double peakThatLeaves(const FournierForand& function, double rest) {
    const double target = rest * momentsOf(function, 0).total;
    double low = std::log(1e-10), high = 0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (momentsOf(function, std::exp(middle)).total > target ? low : high) = middle;
    }
    return std::exp(0.5 * (low + high));
}

}  // namespace shoal::water
