// Fills the light block and the local lights (shaders/light.shared.h).
#pragma once

#include <span>
#include <vector>

#include <shoal/frame/lighting.h>

#include "frame/light.shared.h"

namespace shoal::frame {

// What the light block needs to know of the uploaded environment.
struct EnvironmentShape {
    light::Sh9 sh;
    float rotation = 0;  // radians
    int prefilteredLevels = 2;
    int prefilteredSize = 16;  // texels a side at level 0
    int sharpWidth = 1;        // texels
    int sharpLevels = 1;
};

LightBlock makeLightBlock(const Context& context, const LightingParams& params, const Lights& lights,
                          const EnvironmentShape& environment);
// Shadow indices go to spots with castsShadow in order, as shaders/shadow.shared.h says.
void makeLocalLights(std::span<const light::PunctualLight> lights, std::vector<LocalLight>& to);

}  // namespace shoal::frame
