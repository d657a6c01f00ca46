#include "water/waves/tile_source.h"

#include <cmath>

namespace shoal::water {

WaveTile emptyTile(float periodM, int size) {
    WaveTile tile;
    tile.periodM = periodM;
    tile.size = size;
    tile.height.assign(std::size_t(size) * std::size_t(size) * 4, 0.0f);
    tile.curvature = tile.height;
    return tile;
}

WaveSample sampleTile(const WaveTile& tile, double x, double z) {
    const double scale = double(tile.size) / double(tile.periodM);
    const double u = x * scale, v = z * scale;
    const double column = std::floor(u), row = std::floor(v), fu = u - column, fv = v - row;
    // Far away a double still counts texels; an int would not.
    const auto wrap = [&](double i) {
        const double n = double(tile.size), r = i - n * std::floor(i / n);
        return std::size_t(std::min(std::max(r, 0.0), n - 1));
    };
    const std::size_t i0 = wrap(column), i1 = wrap(column + 1), j0 = wrap(row), j1 = wrap(row + 1);
    const std::size_t size = std::size_t(tile.size);
    const std::size_t at[4] = {4 * (j0 * size + i0), 4 * (j0 * size + i1), 4 * (j1 * size + i0), 4 * (j1 * size + i1)};
    const double weight[4] = {(1 - fu) * (1 - fv), fu * (1 - fv), (1 - fu) * fv, fu * fv};
    WaveSample s;
    for (int c = 0; c < 4; ++c) {
        const float* a = &tile.height[at[c]];
        const float* b = &tile.curvature[at[c]];
        const double w = weight[c];
        s.h += w * double(a[0]), s.hx += w * double(a[1]), s.hz += w * double(a[2]);
        s.hxx += w * double(b[0]), s.hxz += w * double(b[1]), s.hzz += w * double(b[2]);
    }
    return s;
}

}  // namespace shoal::water
