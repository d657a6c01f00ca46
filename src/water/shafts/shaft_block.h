// Which slots the shafts' photons go to, how many, and where the slices lie (shaders/shaft.shared.h).
#pragma once

#include <span>

#include <shoal/water/shafts.h>

#include "water/shaft.shared.h"

namespace shoal::water {

struct ShaftPlan {
    ShaftBlock block{};
    int side = 0;      // texels of a slice, without the border
    int cells = 0;     // photons a slot's side
    int sunSlots = 0;  // 0: no light of the sun reaches into the water
    int lampSlots = 0;
};
ShaftPlan makeShaftPlan(const ShaftSetup& setup, const ShaftParams& params, const Body& body,
                        std::span<const LightSlot> slots, const frame::Context& context);

}  // namespace shoal::water
