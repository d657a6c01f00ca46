// JONSWAP [Hasselmann et al. 1973] with the directions of [Hasselmann, Dunckel & Ewing 1980]; Phillips' spectrum as
// used by [Tessendorf 2001], with the constant of [Pierson & Moskowitz 1964]. Deep water: omega^2 = g k.
#include "water/waves/ocean_spectrum.h"

#include <algorithm>
#include <cmath>

#include <shoal/core/math.h>

namespace shoal::water {
namespace {

constexpr double kPeakRaise = 3.3;          // gamma
constexpr double kPhillips = 0.0081;        // alpha of a sea that grows no more
constexpr double kFullyDeveloped = 1.58e4;  // g F / U^2 where JONSWAP's peak reaches Pierson & Moskowitz's
constexpr double kWeakest = 1e-12;

// cos^2s(angle / 2), integrates to 1 over the circle.
double cosinePower(double s, double angle) {
    const double scale = std::exp(std::lgamma(s + 1) - std::lgamma(s + 0.5)) / (2 * std::sqrt(kPiD));
    return scale * std::pow(std::abs(std::cos(0.5 * angle)), 2 * s);
}

}  // namespace

OceanSpectrum::OceanSpectrum(const WaveParams& params)
    : jonswap_(params.spectrum == "jonswap"), wind_(double(params.windSpeed)), alpha_(kPhillips), peak_(0),
      spread_(double(params.spread)), gain2_(double(params.gain) * double(params.gain)),
      toX_(std::cos(double(params.windDeg) * (kPiD / 180))), toZ_(std::sin(double(params.windDeg) * (kPiD / 180))) {
    if (jonswap_) {
        const double fetch = std::min(kGravity * double(params.fetch) / (wind_ * wind_), kFullyDeveloped);
        alpha_ = 0.076 * std::pow(fetch, -0.22);
        const double omega = 22 * kGravity / wind_ * std::pow(fetch, -1.0 / 3);
        peak_ = omega * omega / kGravity;
    } else {
        // k^-3 exp(-1 / (k L)^2), L = U^2 / g, is greatest at k = sqrt(2 / 3) / L.
        peak_ = std::sqrt(2.0 / 3) * kGravity / (wind_ * wind_);
    }
}

double OceanSpectrum::overDirections(double k) const {
    if (!(k > 0)) return 0;
    if (!jonswap_) {
        const double kl = k * wind_ * wind_ / kGravity;
        return gain2_ * 0.5 * alpha_ / (k * k * k) * std::exp(-1 / (kl * kl));
    }
    const double r = k / peak_, omega = std::sqrt(r);  // over that of the peak
    const double width = omega <= 1 ? 0.07 : 0.09, off = (omega - 1) / width;
    const double raise = std::pow(kPeakRaise, std::exp(-0.5 * off * off));
    // S(omega) = alpha g^2 omega^-5 exp(-5/4 (omega_p / omega)^4) raise; dk = 2 omega domega / g.
    return gain2_ * 0.5 * alpha_ / (k * k * k) * std::exp(-1.25 / (r * r)) * raise;
}

double OceanSpectrum::spreading(double k, double angle) const {
    if (spread_ <= 0) return 1 / (2 * kPiD);
    if (!jonswap_) {
        // |cos|^2p, both ways along the wind; p = 1 is Tessendorf's.
        const double c = std::abs(std::cos(angle));
        const double scale = std::exp(std::lgamma(spread_ + 1) - std::lgamma(spread_ + 0.5)) / (2 * std::sqrt(kPiD));
        return scale * std::pow(c, 2 * spread_);
    }
    const double omega = std::sqrt(k / peak_);
    const double age = wind_ * std::sqrt(peak_ / kGravity);  // wind over the speed of the waves at the peak
    const double s = omega < 1.05 ? 6.97 * std::pow(omega, 4.06)
                                  : 9.77 * std::pow(omega, -2.33 - 1.45 * (std::max(age, 1.0) - 1.17));
    return cosinePower(spread_ * s, angle);
}

double OceanSpectrum::density(double kx, double kz) const {
    const double k = std::hypot(kx, kz);
    if (!(k > 0)) return 0;
    const double s = overDirections(k);
    if (s < kWeakest * kWeakest) return 0;
    const double along = kx * toX_ + kz * toZ_, across = kz * toX_ - kx * toZ_;
    return s / k * spreading(k, std::atan2(across, along));
}

double OceanSpectrum::integral(double low, double high, int weightPower) const {
    // In the logarithm of k, Simpson's rule; below a tenth of the peak there is nothing.
    const double from = std::log(std::max(low, 0.1 * peak_)), to = std::log(high);
    if (!(to > from)) return 0;
    const int steps = 4000;
    const double width = (to - from) / steps;
    double sum = 0;
    for (int i = 0; i <= steps; ++i) {
        const double k = std::exp(from + width * i), weight = (i == 0 || i == steps) ? 1 : (i % 2 ? 4 : 2);
        sum += weight * overDirections(k) * k * std::pow(k, weightPower);
    }
    return sum * width / 3;
}

}  // namespace shoal::water
