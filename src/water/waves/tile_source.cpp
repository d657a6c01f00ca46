#include "water/waves/tile_source.h"

#include <algorithm>
#include <cmath>

namespace shoal::water {
namespace {

// Weights of the cubic through p0 and p1 with derivatives d0 and d1 that stand `step` apart: of p1 - p0, d0 and d1, for
// the value above p0 and for the first and second derivative.
struct Cubic {
    double rise[3], before[3], after[3];
    Cubic(double u, double step)
        : rise{u * u * (3 - 2 * u), 6 * u * (1 - u) / step, (6 - 12 * u) / (step * step)},
          before{u * (1 - u) * (1 - u) * step, 1 + u * (3 * u - 4), (6 * u - 4) / step}, after{u * u * (u - 1) * step,
                                                                                               u * (3 * u - 2),
                                                                                               (6 * u - 2) / step} {}
    double at(int derivative, double p0, double p1, double d0, double d1) const {
        const double above = rise[derivative] * (p1 - p0) + before[derivative] * d0 + after[derivative] * d1;
        return derivative == 0 ? p0 + above : above;
    }
};

}  // namespace

WaveTile emptyTile(float periodM, int size) {
    WaveTile tile;
    tile.periodM = periodM;
    tile.size = size;
    tile.texels.assign(std::size_t(size) * std::size_t(size) * 4, 0.0f);
    return tile;
}

WaveSample sampleTile(const WaveTile& tile, double x, double z) {
    const double step = double(tile.periodM) / double(tile.size), scale = double(tile.size) / double(tile.periodM);
    const double u = x * scale, v = z * scale, column = std::floor(u), row = std::floor(v);
    // Far away a double still counts texels; an int would not.
    const auto wrap = [&](double i) {
        const double n = double(tile.size), r = i - n * std::floor(i / n);
        return std::size_t(std::min(std::max(r, 0.0), n - 1));
    };
    const std::size_t i[2] = {wrap(column), wrap(column + 1)}, j[2] = {wrap(row), wrap(row + 1)};
    const Cubic alongX(u - column, step), alongZ(v - row, step);
    double heights[3][2], slopes[3][2];  // by derivative along x and by row: of the height, of dh/dz
    for (int r = 0; r < 2; ++r) {
        const float* a = &tile.texels[4 * (j[r] * std::size_t(tile.size) + i[0])];
        const float* b = &tile.texels[4 * (j[r] * std::size_t(tile.size) + i[1])];
        for (int d = 0; d < 3; ++d) {
            heights[d][r] = alongX.at(d, double(a[0]), double(b[0]), double(a[1]), double(b[1]));
            slopes[d][r] = alongX.at(d, double(a[2]), double(b[2]), double(a[3]), double(b[3]));
        }
    }
    const auto value = [&](int byX, int byZ) {
        return alongZ.at(byZ, heights[byX][0], heights[byX][1], slopes[byX][0], slopes[byX][1]);
    };
    return {value(0, 0), value(1, 0), value(0, 1), value(2, 0), value(1, 1), value(0, 2)};
}

}  // namespace shoal::water
