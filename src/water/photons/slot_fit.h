// Which squares of light space an eye needs, and the matrices and records of a slot. No GL.
#pragma once

#include <vector>

#include <shoal/light/view.h>
#include <shoal/water/light_views.h>

#include "water/light_space.shared.h"

namespace shoal::water {

// A slot before it has a texture: all that the GPU and whoever draws it are told.
struct SlotFit {
    LightSlot slot;
    LightSlotRecord record;
    light::View lit;        // what is below the surface (reflected: above it)
    light::View air;        // what is above the surface, along the light's own way
    bool airDrawn = false;  // something can be there
    float peelGap = 0;      // of depth
};

// At most setup.maxSlots: of the sun (finest first), of lamps above the water, then what the surface reflects.
std::vector<SlotFit> fitSlots(const light::View& eye, const LightViewSetup& setup, const LightViewParams& params,
                              const Body& body, const BodyLights& lights, const Bounds& sceneBounds);

}  // namespace shoal::water
