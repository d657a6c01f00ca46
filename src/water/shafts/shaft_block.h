// Which slots the shafts' photons go to, how many, and where the slices lie (shaders/shaft.shared.h).
#pragma once

#include <span>

#include <shoal/water/shafts.h>

#include "water/shaft.shared.h"

namespace shoal::water {

// Texels of one slot's slices, borders included.
inline std::size_t sliceTexels(int side, int slices) {
    return std::size_t(side + 2) * std::size_t(side + 2) * std::size_t(slices);
}

// grid.w is 0 where no slot of the sun reaches into the water.
ShaftBlock makeShaftBlock(const ShaftSetup& setup, const ShaftParams& params, const Body& body,
                          std::span<const LightSlot> slots, const frame::Context& context);

}  // namespace shoal::water
