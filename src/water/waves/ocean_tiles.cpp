// [Tessendorf 2001] Simulating Ocean Water, heights only; every wave has the amplitude that the spectrum gives and a
// random phase [Longuet-Higgins 1952], so that a tile's energy is the spectrum's. Four fields (height, slopes, twist)
// in two complex transforms. Bounds between texels: [Ehlich & Zeller 1964] on trigonometric polynomials.
#include "water/waves/ocean_tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include <shoal/core/math.h>
#include <shoal/core/parallel.h>
#include <shoal/core/random.h>

#include "water/waves/tile_transform.h"

namespace shoal::water {
namespace {

using Complex = std::complex<float>;

constexpr std::size_t kSize = kOceanSize;
// A sea is Gaussian: texels pass so many standard deviations once in some 10^6 (slopes: 10^8) places. Where they would,
// the tile is scaled.
constexpr double kHeightSigmas = 5, kSlopeSigmas = 4.5;

// The waves of one wave vector (m, q) and of its opposite: together one Fourier coefficient.
struct Mode {
    int m = 0, q = 0;  // waves in a period along x, z
    double omega = 0;
    double half[2] = {0, 0}, phase[2] = {0, 0};  // half the amplitude, phase; [1]: of -(m, q)
};

struct Tile {
    OceanBand band;
    double variance = 0, slopeSquare = 0;  // as the spectrum has it in this band: m2, and of the slope
    std::vector<Mode> modes;
};

// Variance of the waves whose vectors lie in the cell of (m, q) and in the band: mean over points of the cell. Where
// the density changes much across a cell (long waves), more of them.
double cellVariance(const OceanSpectrum& spectrum, const OceanBand& band, int m, int q) {
    const double dk = 2 * kPiD / band.periodM;
    const int points = m * m + q * q < 100 ? 16 : 4;
    double sum = 0;
    for (int j = 0; j < points; ++j)
        for (int i = 0; i < points; ++i) {
            const double kx = dk * (m - 0.5 + (i + 0.5) / points), kz = dk * (q - 0.5 + (j + 0.5) / points);
            const double k = std::hypot(kx, kz);
            if (k >= band.kLow && k < band.kHigh) sum += spectrum.density(kx, kz);
        }
    return sum * dk * dk / (points * points);
}

Tile makeTile(const OceanSpectrum& spectrum, const OceanBand& band, std::uint32_t seed) {
    Tile tile;
    tile.band = band;
    const double dk = 2 * kPiD / band.periodM;
    const int reach = int(std::ceil(band.kHigh / dk + 0.5));
    for (int q = 0; q <= reach; ++q)
        for (int m = -reach; m <= reach; ++m) {
            if (q == 0 && m <= 0) continue;
            const double k = dk * std::hypot(double(m), double(q));
            // Of a cell that only touches the band its own vector may lie outside; the energy belongs here all the
            // same.
            if (k + dk < band.kLow || k - dk >= band.kHigh) continue;
            tile.modes.push_back({m, q, std::sqrt(kGravity * k), {}, {}});
        }
    parallelFor(tile.modes.size(), 64, [&](std::size_t i) {
        Mode& mode = tile.modes[i];
        for (int side = 0; side < 2; ++side) {
            const int m = side ? -mode.m : mode.m, q = side ? -mode.q : mode.q;
            // variance = amplitude^2 / 2
            mode.half[side] = std::sqrt(0.5 * cellVariance(spectrum, band, m, q));
            const std::uint32_t place = std::uint32_t(m + 512) | std::uint32_t(q + 512) << 10;
            mode.phase[side] = 2 * kPiD * double(randomFloat(seed, place, 77));
        }
    });
    std::erase_if(tile.modes, [](const Mode& mode) { return mode.half[0] + mode.half[1] < 1e-12; });
    tile.variance = spectrum.integral(band.kLow, band.kHigh);
    tile.slopeSquare = spectrum.integral(band.kLow, band.kHigh, 2);
    return tile;
}

class OceanTiles final : public TileSource {
public:
    explicit OceanTiles(const WaveParams& params) : shortestM_(double(params.shortestM)) {
        const OceanSpectrum spectrum(params);
        std::uint32_t seed = params.seed * 4;
        for (const OceanBand& band : oceanBands(spectrum, shortestM_))
            tiles_.push_back(makeTile(spectrum, band, seed++));
    }

    bool fill(double seconds, std::vector<WaveTile>& tiles) override {
        if (tiles.empty())
            for (const Tile& tile : tiles_) tiles.push_back(emptyTile(float(tile.band.periodM), kOceanSize));
        transforms_.resize(2 * tiles_.size());
        parallelFor(transforms_.size(), 1, [&](std::size_t job) {
            setSpectrum(tiles_[job / 2], int(job % 2), seconds, transforms_[job]);
            transforms_[job].transformFirst();
        });
        const std::size_t rowsAtOnce = 16, chunks = kSize / rowsAtOnce;
        peaks_.assign(tiles_.size() * chunks, {});
        parallelFor(peaks_.size(), 1, [&](std::size_t job) {
            const std::size_t t = job / chunks, from = job % chunks * rowsAtOnce;
            peaks_[job] = writeRows(&transforms_[2 * t], from, from + rowsAtOnce, tiles[t]);
        });
        for (std::size_t t = 0; t < tiles_.size(); ++t) keepWithin(t, chunks, tiles[t]);
        return true;
    }

    WaveBounds bounds() const override {
        WaveBounds b;
        for (const Tile& tile : tiles_) {
            // Waves of `texels` texels and more pass the texels' greatest value by 1 / cos(pi / texels) at most an
            // axis; the cubic between texels is off by (2 pi / texels)^3 sqrt(3) / 216 of the slope, and less of
            // height.
            const double turn = 2 * kPiD / tile.band.texels, c = std::cos(0.5 * turn);
            const double between = (1 + 2 * turn * turn * turn * std::sqrt(3.0) / 216) / (c * c);
            b.height += between * mostHeight(tile), b.slope += between * mostSlope(tile);
        }
        b.wavelength = shortestM_;
        return b;
    }

private:
    struct Peak {
        float height = 0, slope2 = 0;
    };
    static double mostHeight(const Tile& tile) { return kHeightSigmas * std::sqrt(tile.variance); }
    static double mostSlope(const Tile& tile) { return kSlopeSigmas * std::sqrt(tile.slopeSquare); }

    // Real fields F and G as F + i G: which 0: (h, hx), 1: (hz, hxz).
    static void setSpectrum(const Tile& tile, int which, double seconds, TileTransform& to) {
        const double dk = 2 * kPiD / tile.band.periodM;
        to.clear();
        for (const Mode& mode : tile.modes) {
            const double turn = std::fmod(mode.omega * seconds, 2 * kPiD);
            const double a = mode.phase[0] - turn, b = turn - mode.phase[1];
            const std::complex<double> h{mode.half[0] * std::cos(a) + mode.half[1] * std::cos(b),
                                         mode.half[0] * std::sin(a) + mode.half[1] * std::sin(b)};
            const double kx = dk * mode.m, kz = dk * mode.q;
            const auto packed = [&](std::complex<double> c, double x, double z) {
                return c * (1 - x) * (which == 0 ? std::complex<double>(1, 0) : std::complex<double>(0, z));
            };
            to.set(mode.m, mode.q, Complex(packed(h, kx, kz)));
            to.set(-mode.m, -mode.q, Complex(packed(std::conj(h), -kx, -kz)));
        }
    }

    static Peak writeRows(const TileTransform* t, std::size_t begin, std::size_t end, WaveTile& tile) {
        std::array<std::array<Complex, kSize>, 2> row;
        Peak peak;
        for (std::size_t j = begin; j < end; ++j) {
            for (std::size_t f = 0; f < 2; ++f) t[f].transformSecond(j, row[f].data());
            float* h = &tile.texels[4 * j * kSize];
            for (std::size_t i = 0; i < kSize; ++i, h += 4) {
                h[0] = row[0][i].real(), h[1] = row[0][i].imag(), h[2] = row[1][i].real(), h[3] = row[1][i].imag();
                peak.height = std::max(peak.height, std::abs(h[0]));
                peak.slope2 = std::max(peak.slope2, h[1] * h[1] + h[2] * h[2]);
            }
        }
        return peak;
    }

    void keepWithin(std::size_t t, std::size_t chunks, WaveTile& tile) const {
        Peak peak;
        for (std::size_t i = 0; i < chunks; ++i) {
            peak.height = std::max(peak.height, peaks_[t * chunks + i].height);
            peak.slope2 = std::max(peak.slope2, peaks_[t * chunks + i].slope2);
        }
        const double height = double(peak.height), slope = std::sqrt(double(peak.slope2));
        double scale = 1;
        if (height > mostHeight(tiles_[t])) scale = mostHeight(tiles_[t]) / height;
        if (slope > mostSlope(tiles_[t])) scale = std::min(scale, mostSlope(tiles_[t]) / slope);
        if (scale == 1) return;
        const float s = float(scale * (1 - 1e-6));
        for (float& v : tile.texels) v *= s;
    }

    double shortestM_;
    std::vector<Tile> tiles_;
    std::vector<TileTransform> transforms_;  // kept, so that nothing is allocated each time
    std::vector<Peak> peaks_;
};

}  // namespace

std::vector<OceanBand> oceanBands(const OceanSpectrum& spectrum, double shortestM) {
    // A tile holds waves from its shortest, `texels` texels long, to a `waves`th of its period. The ratio of periods is
    // a whole number and the golden section's fraction, which is as far from simple fractions as can be.
    const double fraction = 0.618034, longest = 10 * 2 * kPiD / spectrum.peak();
    struct Plan {
        double texels, waves;
        int most;
    };
    const Plan plans[] = {{8, 4, 3}, {6, 4, 3}, {8, 4, 4}, {6, 4, 4}, {5, 3, 4}, {4, 3, 4}, {3, 2, 4}};
    double texels = 3, ratio = 0;
    int count = 4;
    for (const Plan& plan : plans) {
        const double first = shortestM * kOceanSize / plan.texels, greatest = kOceanSize / (plan.texels * plan.waves);
        texels = plan.texels;
        bool fits = false;
        for (count = 1; count <= plan.most && !fits; ++count) {
            const double needed = count == 1 ? (first >= longest ? 1.0 : 1e9)
                                             : std::pow(std::max(longest / first, 1.0), 1.0 / (count - 1));
            ratio = std::max(std::ceil(needed - fraction), 2.0) + fraction;
            fits = needed == 1.0 || ratio <= greatest;
        }
        if (fits) {
            --count;
            break;
        }
        count = plan.most;
    }
    std::vector<OceanBand> bands;
    double period = shortestM * kOceanSize / texels, high = 2 * kPiD / shortestM;
    for (int c = 0; c < count; ++c) {
        const double low = c + 1 < count ? high / ratio : 0;
        bands.push_back({double(float(period)), low, high, texels});
        period *= ratio, high = low;
    }
    return bands;
}

std::unique_ptr<TileSource> makeOceanTiles(const WaveParams& params) { return std::make_unique<OceanTiles>(params); }

}  // namespace shoal::water
