// Wind waves as up to four periodic tiles.
#pragma once

#include "water/waves/ocean_spectrum.h"
#include "water/waves/tile_source.h"

namespace shoal::water {

inline constexpr int kOceanSize = 256;  // texels a side

// One tile's share of the spectrum: wave numbers from kLow up to kHigh, 1/m.
struct OceanBand {
    double periodM = 1, kLow = 0, kHigh = 0;
    double texels = 8;  // in its shortest wave
};
// Longest waves last. Bands touch and do not overlap; no period is near a simple fraction of another.
std::vector<OceanBand> oceanBands(const OceanSpectrum& spectrum, double shortestM);

std::unique_ptr<TileSource> makeOceanTiles(const WaveParams& params);

}  // namespace shoal::water
