// Closed forms of light under level water and under one sinusoid: Snell, Fresnel and a change of variables from where a
// ray enters to where it lands. Nothing is sampled but smooth one-dimensional integrals (Gauss-Legendre).
#include <algorithm>
#include <array>
#include <cmath>

#include <shoal/core/assert.h>
#include <shoal/water/reference.h>

namespace shoal::water::analytic {

namespace {

constexpr int kSamplesPerWave = 64;  // of dX/dx, to bracket its zeros
constexpr double kInverseGolden = 0.61803398874989485;

// x with f(x) = 0 between a and b, where f has different signs; to the last bits.
template <class F>
double bisect(const F& f, double a, double b) {
    const bool risingFromA = f(a) < 0;
    for (int i = 0; i < 200 && std::abs(b - a) > 1e-15 * (1 + std::abs(a)); ++i) {
        const double middle = 0.5 * (a + b);
        if (middle == a || middle == b) break;
        ((f(middle) < 0) == risingFromA ? a : b) = middle;
    }
    return 0.5 * (a + b);
}

// Integral of f over [a, b] in pieces no longer than `longest`, five Gauss-Legendre points each.
template <class F>
double integrate(const F& f, double a, double b, double longest) {
    constexpr std::array<double, 3> kNode = {0, 0.5384693101056831, 0.9061798459386640};
    constexpr std::array<double, 3> kWeight = {0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    const int pieces = std::max(1, int(std::ceil((b - a) / longest)));
    const double half = 0.5 * (b - a) / pieces;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) {
        const double middle = a + (2 * i + 1) * half;
        sum += kWeight[0] * f(middle);
        for (std::size_t j = 1; j < kNode.size(); ++j)
            sum += kWeight[j] * (f(middle - kNode[j] * half) + f(middle + kNode[j] * half));
    }
    return sum * half;
}

double jacobianAt(const Sinusoid& s, double depth, double x) { return sinusoidRay(s, depth, x).jacobian; }
double landingAt(const Sinusoid& s, double depth, double x) { return sinusoidRay(s, depth, x).landing; }

// Zeros of dX/dx in [0, 2 pi / k), ascending.
std::vector<double> foldEntries(const Sinusoid& s, double depth) {
    const double step = 2 * kPiD / s.k / kSamplesPerWave;
    const auto jacobian = [&](double x) { return jacobianAt(s, depth, x); };
    std::vector<double> folds;
    double before = jacobian(-step), here = jacobian(0);
    for (int i = 0; i < kSamplesPerWave; ++i) {
        const double x = i * step, after = jacobian(x + step);
        // A dip below zero between samples that are all above: two folds close together, just past a focus.
        if (before > here && here <= after && here > 0 && before > 0 && after > 0) {
            double a = x - step, b = x + step;
            while (b - a > 1e-12) {
                const double u = b - kInverseGolden * (b - a), v = a + kInverseGolden * (b - a);
                (jacobian(u) < jacobian(v) ? b : a) = jacobian(u) < jacobian(v) ? v : u;
            }
            const double lowest = 0.5 * (a + b);
            if (jacobian(lowest) < 0) {
                folds.push_back(bisect(jacobian, x - step, lowest));
                folds.push_back(bisect(jacobian, lowest, x + step));
            }
        }
        if ((here < 0) != (after < 0)) folds.push_back(bisect(jacobian, x, x + step));
        before = here;
        here = after;
    }
    const double period = 2 * kPiD / s.k;
    for (double& x : folds) x -= period * std::floor(x / period);
    std::sort(folds.begin(), folds.end());
    return folds;
}

// An interval of entry points on which X(x) is monotone.
struct Piece {
    double from = 0, to = 0;  // x
    double landingFrom = 0, landingTo = 0;
};

// All pieces from which light can land in [min, max].
std::vector<Piece> pieces(const Sinusoid& s, double depth, double min, double max) {
    const double steepest = std::atan(s.amplitude * s.k);
    const auto drift = [&](double phi) { return std::tan(phi + std::asin(std::sin(s.zenithAngle - phi) / s.index)); };
    double least = 1e30, most = -1e30;
    for (const double phi : {-steepest, steepest})
        for (const double height : {depth - s.amplitude, depth + s.amplitude}) {
            least = std::min(least, height * drift(phi));
            most = std::max(most, height * drift(phi));
        }
    // A nanometre more: without waves both ends are one point.
    const double period = 2 * kPiD / s.k, first = min - most - 1e-9, last = max - least + 1e-9;
    std::vector<double> ends{first};
    const std::vector<double> folds = foldEntries(s, depth);
    for (double base = std::floor(first / period) * period; base < last; base += period)
        for (const double fold : folds)
            if (base + fold > first && base + fold < last) ends.push_back(base + fold);
    ends.push_back(last);
    std::vector<Piece> found;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        found.push_back({ends[i], ends[i + 1], landingAt(s, depth, ends[i]), landingAt(s, depth, ends[i + 1])});
    return found;
}

// Where a piece's rays that land in [min, max] enter; empty (from >= to) where none do.
Piece preimage(const Sinusoid& s, double depth, const Piece& piece, double min, double max) {
    const bool rises = piece.landingTo > piece.landingFrom;
    const double low = std::min(piece.landingFrom, piece.landingTo),
                 high = std::max(piece.landingFrom, piece.landingTo);
    if (max <= low || min >= high) return {};
    const auto entry = [&](double landing) {
        if (landing <= low) return rises ? piece.from : piece.to;
        if (landing >= high) return rises ? piece.to : piece.from;
        return bisect([&](double x) { return landingAt(s, depth, x) - landing; }, piece.from, piece.to);
    };
    Piece inside;
    inside.from = entry(rises ? min : max);
    inside.to = entry(rises ? max : min);
    return inside;
}

// Integral over the rays that land in [min, max] of flux exp(-c l) times weight(ray).
template <class Weight>
double landedFlux(const Sinusoid& s, double depth, const std::vector<Piece>& from, double min, double max,
                  const Weight& weight) {
    double sum = 0;
    for (const Piece& piece : from) {
        const Piece part = preimage(s, depth, piece, min, max);
        if (part.to <= part.from) continue;
        sum += integrate(
            [&](double x) {
                const SinusoidRay ray = sinusoidRay(s, depth, x);
                return ray.flux * std::exp(-s.attenuation * ray.length) * weight(ray);
            },
            part.from, part.to, 2 * kPiD / s.k / 32);
    }
    return sum;
}

}  // namespace

double flatIrradiance(double index, double attenuation, double zenithAngle, double depth) {
    const double cosRefracted = std::sqrt(1 - std::pow(std::sin(zenithAngle) / index, 2));
    return std::cos(zenithAngle) * fresnelTransmittance(std::cos(zenithAngle), index) *
           std::exp(-attenuation * depth / cosRefracted);
}

SinusoidRay sinusoidRay(const Sinusoid& s, double depth, double x) {
    const double h = s.amplitude * std::cos(s.k * x), slope = -s.amplitude * s.k * std::sin(s.k * x);
    const double curvature = -s.k * s.k * h;
    const double phi = std::atan(slope);                                 // of the surface
    const double incidence = s.zenithAngle - phi;                        // signed, to the normal
    const double refraction = std::asin(std::sin(incidence) / s.index);  // signed, to the normal
    const double psi = phi + refraction;                                 // to the vertical
    const double cosPhi = std::cos(phi), cosPsi = std::cos(psi), drift = std::tan(psi);
    SinusoidRay ray;
    ray.landing = x + (depth + h) * drift;
    const double psiByX = (1 - std::cos(incidence) / (s.index * std::cos(refraction))) * cosPhi * cosPhi * curvature;
    ray.jacobian = 1 + slope * drift + (depth + h) / (cosPsi * cosPsi) * psiByX;
    ray.length = (depth + h) / cosPsi;
    const double incident = std::cos(s.zenithAngle) + std::sin(s.zenithAngle) * slope;
    if (incident > 0) ray.flux = incident * fresnelTransmittance(std::cos(incidence), s.index);
    ray.directionX = std::sin(psi);
    ray.directionY = -cosPsi;
    return ray;
}

std::vector<SinusoidRay> sinusoidBranches(const Sinusoid& s, double depth, double landing) {
    std::vector<SinusoidRay> rays;
    for (const Piece& piece : pieces(s, depth, landing, landing)) {
        if ((piece.landingFrom - landing) * (piece.landingTo - landing) > 0) continue;
        rays.push_back(sinusoidRay(
            s, depth, bisect([&](double x) { return landingAt(s, depth, x) - landing; }, piece.from, piece.to)));
    }
    return rays;
}

double sinusoidIrradiance(const Sinusoid& s, double depth, double landing) {
    double sum = 0;
    for (const SinusoidRay& ray : sinusoidBranches(s, depth, landing))
        sum += ray.flux * std::exp(-s.attenuation * ray.length) / std::abs(ray.jacobian);
    return sum;
}

std::vector<double> sinusoidBins(const Sinusoid& s, double depth, double min, double max, int count) {
    SHOAL_ASSERT(count > 0 && max > min);
    const std::vector<Piece> from = pieces(s, depth, min, max);
    const double width = (max - min) / count;
    std::vector<double> bins;
    for (int i = 0; i < count; ++i)
        bins.push_back(
            landedFlux(s, depth, from, min + i * width, min + (i + 1) * width, [](const SinusoidRay&) { return 1.0; }) /
            width);
    return bins;
}

double focusDepth(const Sinusoid& s) { return s.index / ((s.index - 1) * s.amplitude * s.k * s.k) - s.amplitude; }

std::vector<double> sinusoidFolds(const Sinusoid& s, double depth) {
    const double period = 2 * kPiD / s.k;
    std::vector<double> landings;
    for (const double x : foldEntries(s, depth)) {
        const double landing = landingAt(s, depth, x);
        landings.push_back(landing - period * std::ceil(landing / period - 0.5));
    }
    std::sort(landings.begin(), landings.end());
    return landings;
}

double henyeyGreenstein(double anisotropy, double cosTheta) {
    const double g = anisotropy, base = 1 + g * g - 2 * g * cosTheta;
    return (1 - g * g) / (4 * kPiD * base * std::sqrt(base));
}

double flatShaft(const ShaftMedium& medium, double zenithAngle, const ShaftRay& ray) {
    const double sinRefracted = std::sin(zenithAngle) / medium.index;
    const double cosRefracted = std::sqrt(1 - sinRefracted * sinRefracted);
    const double cosScatter = -(sinRefracted * ray.vx - cosRefracted * ray.vy);
    const double c = medium.attenuation, rate = 1 - ray.vy / cosRefracted;
    const double beam =
        std::cos(zenithAngle) * fresnelTransmittance(std::cos(zenithAngle), medium.index) / cosRefracted;
    // (1 - exp(-c rate S)) / (c rate), which tends to S
    const double exponent = c * rate * ray.length;
    const double reach = std::abs(exponent) < 1e-12 ? ray.length : -std::expm1(-exponent) / (c * rate);
    return medium.scattering * henyeyGreenstein(medium.anisotropy, cosScatter) * beam *
           std::exp(-c * ray.eyeDepth / cosRefracted) * reach;
}

double sinusoidShaft(const ShaftMedium& medium, const Sinusoid& sinusoid, const ShaftRay& ray, int steps,
                     double footprint) {
    SHOAL_ASSERT(steps > 0 && footprint >= 0);
    Sinusoid s = sinusoid;
    s.index = medium.index;
    s.attenuation = medium.attenuation;
    // Scattered towards the eye from a beam that crosses a level plane.
    const auto weight = [&](const SinusoidRay& light) {
        const double cosScatter = -(light.directionX * ray.vx + light.directionY * ray.vy);
        return henyeyGreenstein(medium.anisotropy, cosScatter) / -light.directionY;
    };
    const double step = ray.length / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) * step, depth = ray.eyeDepth - ray.vy * t, x = ray.eyeX + ray.vx * t;
        double source = 0;
        if (footprint > 0) {
            const double min = x - footprint / 2, max = x + footprint / 2;
            source = landedFlux(s, depth, pieces(s, depth, min, max), min, max, weight) / footprint;
        } else {
            for (const SinusoidRay& light : sinusoidBranches(s, depth, x))
                source +=
                    light.flux * std::exp(-s.attenuation * light.length) / std::abs(light.jacobian) * weight(light);
        }
        sum += source * std::exp(-medium.attenuation * t);
    }
    return medium.scattering * sum * step;
}

}  // namespace shoal::water::analytic
