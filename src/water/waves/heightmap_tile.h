// A tile from a picture of heights, or from a sequence of pictures.
#pragma once

#include <shoal/core/result.h>

#include "water/waves/tile_source.h"

namespace shoal::water {

// `maps`: at least one, all of one size, square, a power of two from 4 to 4096 pixels a side, finite; channel 0 is the
// height in metres. Row 0 and column 0 lie at z, x = -periodM / 2. A sequence plays `fps` pictures a second, mixed
// between neighbours, the last followed by the first.
Result<std::unique_ptr<TileSource>> makeHeightmapTile(std::vector<Image> maps, float periodM, float gain, float fps);

}  // namespace shoal::water
