// Where the periodic tiles of a wave field come from.
#pragma once

#include <memory>
#include <vector>

#include <shoal/water/waves.h>

namespace shoal::water {

class TileSource {
public:
    virtual ~TileSource() = default;
    // Writes what the waves are at `seconds` of wave time; false where nothing changed. Makes the tiles where there are
    // none; they keep their number, sizes and periods.
    virtual bool fill(double seconds, std::vector<WaveTile>& tiles) = 0;
    virtual WaveBounds bounds() const = 0;  // of the sum of the tiles, at any time
};

// A tile of the right size with all heights 0.
WaveTile emptyTile(float periodM, int size);
// The bicubic Hermite surface, as in waves.io.glsl.
WaveSample sampleTile(const WaveTile& tile, double x, double z);

}  // namespace shoal::water
