// [Perlin 2002] Improving Noise: quintic fade and twelve gradients. Derivatives are those of the same polynomial.
#include "water/waves/perlin_noise.h"

#include <array>
#include <cmath>

#include <shoal/core/math.h>
#include <shoal/core/parallel.h>
#include <shoal/core/random.h>

namespace shoal::water {
namespace {

constexpr int kCells = 16, kTexels = 256;
constexpr double kFiner = 0.35;  // amplitude of the second octave over the first
// What the cubic between texels may pass the noise by: with 8 texels a cell its slope is off by 360 / 8^3 sqrt(3) / 216
// = 0.6 % an axis, of the height of a gradient over the spacing (360: the fade's greatest fourth derivative).
constexpr double kBetweenTexels = 1.02;

struct Fade {  // weight of the nearer and of the farther lattice point, and its derivative by the coordinate
    double w[2], d[2];
};

Fade fadeAt(double u) {
    const double s = u * u * u * (u * (u * 6 - 15) + 10), d = 30 * u * u * (u - 1) * (u - 1);
    return {{1 - s, s}, {-d, d}};
}

// At one time a lattice point adds x * dx + z * dz + at, weighted.
struct Corner {
    double x = 0, z = 0, at = 0;
};

void addGradient(std::uint32_t bits, double weight, double t, Corner& to) {
    const auto sign = [&](int bit) { return bits >> bit & 1 ? -weight : weight; };
    switch (bits % 3) {
        case 0:
            to.x += sign(8), to.z += sign(9);
            break;
        case 1:
            to.x += sign(8), to.at += sign(9) * t;
            break;
        default:
            to.z += sign(8), to.at += sign(9) * t;
            break;
    }
}

struct Octave {
    int cells = 0;
    double amplitude = 0, spacing = 1, rate = 0;  // metres, metres, lattice points a second
    std::uint32_t seed = 0;
    std::vector<Corner> corners;
    std::vector<Fade> fades;  // by texel within a cell

    void moveTo(double seconds);
    void add(int column, int row, float* to) const;
};

void Octave::moveTo(double seconds) {
    const double t = seconds * rate, before = std::floor(t), part = t - before;
    const Fade fade = fadeAt(part);
    corners.assign(std::size_t(cells) * std::size_t(cells), {});
    const auto slice = std::uint32_t(std::int64_t(std::fmod(before, 4294967296.0)));
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        for (std::uint32_t k = 0; k < 2; ++k)
            addGradient(randomBits(seed, i, slice + k), fade.w[k], part - double(k), corners[i]);
}

void Octave::add(int column, int row, float* to) const {
    const int texels = kTexels / cells, i = column / texels, j = row / texels;
    const Fade &fx = fades[std::size_t(column % texels)], &fz = fades[std::size_t(row % texels)];
    const double u = double(column % texels) / texels, v = double(row % texels) / texels;
    double n = 0, nx = 0, nz = 0, nxz = 0;
    for (int b = 0; b < 2; ++b)
        for (int a = 0; a < 2; ++a) {
            const Corner& c = corners[std::size_t((j + b) % cells) * std::size_t(cells) + std::size_t((i + a) % cells)];
            const double value = c.x * (u - a) + c.z * (v - b) + c.at;
            const double wx = fx.w[a], wz = fz.w[b], dx = fx.d[a], dz = fz.d[b];
            n += wx * wz * value;
            nx += dx * wz * value + wx * wz * c.x;
            nz += wx * dz * value + wx * wz * c.z;
            nxz += dx * dz * value + dx * wz * c.z + wx * dz * c.x;
        }
    const double slope = amplitude / spacing;
    to[0] += float(amplitude * n), to[1] += float(slope * nx), to[2] += float(slope * nz);
    to[3] += float(slope / spacing * nxz);
}

class PerlinNoise final : public TileSource {
public:
    explicit PerlinNoise(const NoiseParams& params) : periodM_(float(params.spacing * kCells)) {
        const double share[2] = {1 / (1 + kFiner), kFiner / (1 + kFiner)};
        for (int o = 0; o < 2; ++o) {
            Octave octave;
            octave.cells = kCells << o;
            octave.amplitude = params.amplitude * share[o] / (kNoiseHeight * kBetweenTexels);
            octave.spacing = double(periodM_) / octave.cells;
            // As often as a deep-water wave of two cells rises and falls.
            octave.rate = std::sqrt(9.80665 * kPiD / octave.spacing) / (2 * kPiD);
            octave.seed = params.seed * 2 + std::uint32_t(o);
            const int texels = kTexels / octave.cells;
            for (int i = 0; i < texels; ++i) octave.fades.push_back(fadeAt(double(i) / texels));
            octaves_[std::size_t(o)] = std::move(octave);
        }
    }

    bool fill(double seconds, std::vector<WaveTile>& tiles) override {
        if (tiles.empty()) tiles.push_back(emptyTile(periodM_, kTexels));
        WaveTile& tile = tiles[0];
        for (Octave& octave : octaves_) octave.moveTo(seconds);
        parallelFor(kTexels, 16, [&](std::size_t row) {
            for (std::size_t column = 0; column < kTexels; ++column) {
                float* to = &tile.texels[4 * (row * kTexels + column)];
                std::fill_n(to, 4, 0.0f);
                for (const Octave& octave : octaves_) octave.add(int(column), int(row), to);
            }
        });
        return true;
    }

    WaveBounds bounds() const override {
        WaveBounds b;
        for (const Octave& octave : octaves_) {
            b.height += kBetweenTexels * octave.amplitude * kNoiseHeight;
            b.slope += kBetweenTexels * octave.amplitude * kNoiseSlope / octave.spacing;
            b.wavelength = octave.spacing;
        }
        return b;
    }

private:
    float periodM_;
    std::array<Octave, 2> octaves_;
};

}  // namespace

std::unique_ptr<TileSource> makePerlinNoise(const NoiseParams& params) { return std::make_unique<PerlinNoise>(params); }

}  // namespace shoal::water
