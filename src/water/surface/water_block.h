// Fills the block of a body of water (shaders/water.shared.h), and makes the module's shaders known.
#pragma once

#include <shoal/water/body.h>

#include "water/water.shared.h"

namespace shoal::water {

// Makes what shoal::water embeds known to shoal::gl; every create() of this module calls it.
void registerWaterShaders();

// body.waves may be null: level water. Without a sun (or with one below the horizon) toSun.w is 0 and its irradiance 0.
WaterBlock makeWaterBlock(const Body& body, const BodyLights& lights);

}  // namespace shoal::water
