// Heights between pixels are those of the periodic cubic B-spline through them [Unser 1999]: its derivatives at the
// pixels are the tile's.
#include "water/waves/heightmap_tile.h"

#include <bit>
#include <cmath>
#include <string>

#include <shoal/core/parallel.h>

namespace shoal::water {
namespace {

constexpr int kLeastSize = 4, kMostSize = 4096;

Result<void> check(const std::vector<Image>& maps) {
    if (maps.empty()) return badInput("waves.file: found no picture, expected a map of heights");
    const int size = maps[0].width;
    for (std::size_t f = 0; f < maps.size(); ++f) {
        const Image& map = maps[f];
        const std::string which = "waves.file: picture " + std::to_string(f);
        const std::string found = std::to_string(map.width) + " x " + std::to_string(map.height);
        if (map.channelCount < 1 || map.width != map.height || map.width < kLeastSize || map.width > kMostSize ||
            !std::has_single_bit(unsigned(map.width)))
            return badInput(which + " is " + found + ", expected a square of 4, 8, 16 .. 4096 pixels a side");
        if (map.width != size)
            return badInput(which + " is " + found + ", expected " + std::to_string(size) + " x " +
                            std::to_string(size) + " as picture 0");
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                if (!(std::abs(map.at(x, y)[0]) < 1e6f))
                    return badInput(which + " has " + std::to_string(map.at(x, y)[0]) + " at (" + std::to_string(x) +
                                    ", " + std::to_string(y) + "), expected finite heights in metres");
    }
    return {};
}

// Makes the coefficients of the periodic cubic B-spline through `count` values that stand `stride` apart.
void toCoefficients(float* values, std::size_t count, std::size_t stride, std::vector<double>& line) {
    const double pole = std::sqrt(3.0) - 2;
    line.resize(count);
    for (std::size_t i = 0; i < count; ++i) line[i] = 6 * double(values[i * stride]);
    // The filter runs round the ring until what it started from is forgotten.
    const std::size_t warm = std::min<std::size_t>(count * 8, 64);
    double last = 0;
    for (std::size_t i = 0; i < warm; ++i) last = line[(count * 8 - warm + i) % count] + pole * last;
    for (std::size_t i = 0; i < count; ++i) last = line[i] = line[i] + pole * last;
    for (std::size_t i = 0; i < warm; ++i) last = pole * (last - line[(warm - 1 - i) % count]);
    for (std::size_t i = count; i-- > 0;) last = line[i] = pole * (last - line[i]);
    for (std::size_t i = 0; i < count; ++i) values[i * stride] = float(line[i]);
}

class HeightmapTile final : public TileSource {
public:
    HeightmapTile(const std::vector<Image>& maps, float periodM, float gain, float fps)
        : periodM_(periodM), fps_(double(fps)), size_(std::size_t(maps[0].width)) {
        std::vector<double> line;
        const std::size_t half = size_ / 2;
        for (const Image& map : maps) {
            std::vector<float> c(size_ * size_);
            for (std::size_t j = 0; j < size_; ++j)
                for (std::size_t i = 0; i < size_; ++i)
                    c[j * size_ + i] = gain * map.at(int((i + half) % size_), int((j + half) % size_))[0];
            for (std::size_t j = 0; j < size_; ++j) toCoefficients(&c[j * size_], size_, 1, line);
            for (std::size_t i = 0; i < size_; ++i) toCoefficients(&c[i], size_, size_, line);
            coefficients_.push_back(std::move(c));
        }
        measure();
    }

    bool fill(double seconds, std::vector<WaveTile>& tiles) override {
        const std::size_t count = coefficients_.size();
        const bool first = tiles.empty();
        if (first) tiles.push_back(emptyTile(periodM_, int(size_)));
        if (count == 1) {
            if (first) differentiate(coefficients_[0], tiles[0]);
            return first;
        }
        const double frames = seconds * fps_, at = frames - double(count) * std::floor(frames / double(count));
        const std::size_t before = std::size_t(at) % count, after = (before + 1) % count;
        const float part = float(at - std::floor(at));
        mixed_.resize(size_ * size_);
        parallelFor(size_ * size_, 16384, [&](std::size_t i) {
            mixed_[i] = coefficients_[before][i] + part * (coefficients_[after][i] - coefficients_[before][i]);
        });
        differentiate(mixed_, tiles[0]);
        return true;
    }

    WaveBounds bounds() const override { return bounds_; }

private:
    // Value and derivatives of the spline at its knots: with them the bicubic surface of a tile is the spline itself.
    void differentiate(const std::vector<float>& c, WaveTile& tile) const {
        const double slope = 0.5 * double(size_) / double(periodM_);
        parallelFor(size_, 8, [&](std::size_t j) {
            const std::size_t mask = size_ - 1;
            const float* rows[3] = {&c[((j + mask) & mask) * size_], &c[j * size_], &c[((j + 1) & mask) * size_]};
            for (std::size_t i = 0; i < size_; ++i) {
                const std::size_t before = (i + mask) & mask, after = (i + 1) & mask;
                double value[3], rise[3];  // along x, by row
                for (int r = 0; r < 3; ++r) {
                    const double a = double(rows[r][before]), b = double(rows[r][i]), d = double(rows[r][after]);
                    value[r] = (a + 4 * b + d) / 6, rise[r] = d - a;
                }
                const auto across = [](const double* v) { return (v[0] + 4 * v[1] + v[2]) / 6; };
                float* to = &tile.texels[4 * (j * size_ + i)];
                to[0] = float(across(value)), to[1] = float(slope * across(rise));
                to[2] = float(slope * (value[2] - value[0])), to[3] = float(slope * slope * (rise[2] - rise[0]));
            }
        });
    }

    // A spline stays within its coefficients, its derivatives within their differences; a mix of pictures too.
    void measure() {
        const double scale = double(size_) / double(periodM_);
        for (const std::vector<float>& c : coefficients_) {
            double height = 0, x = 0, z = 0;
            for (std::size_t j = 0; j < size_; ++j)
                for (std::size_t i = 0; i < size_; ++i) {
                    const double here = double(c[j * size_ + i]);
                    height = std::max(height, std::abs(here));
                    x = std::max(x, std::abs(double(c[j * size_ + (i + 1) % size_]) - here));
                    z = std::max(z, std::abs(double(c[(j + 1) % size_ * size_ + i]) - here));
                }
            bounds_.height = std::max(bounds_.height, height);
            bounds_.slope = std::max(bounds_.slope, scale * std::hypot(x, z));
        }
        bounds_.height *= 1 + 1e-5, bounds_.slope *= 1 + 1e-5;  // of 32-bit arithmetic
        bounds_.wavelength = 2 * double(periodM_) / double(size_);
    }

    float periodM_;
    double fps_;
    std::size_t size_;
    std::vector<std::vector<float>> coefficients_;
    std::vector<float> mixed_;
    WaveBounds bounds_;
};

}  // namespace

Result<std::unique_ptr<TileSource>> makeHeightmapTile(std::vector<Image> maps, float periodM, float gain, float fps) {
    if (Result<void> ok = check(maps); !ok) return ok.error();
    return std::unique_ptr<TileSource>(std::make_unique<HeightmapTile>(maps, periodM, gain, fps));
}

}  // namespace shoal::water
