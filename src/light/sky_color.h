// From three wavelengths to a colour.
#pragma once

#include <shoal/core/math.h>

namespace shoal::light {

// Linear Rec. 709 of light whose spectrum, relative to the sun's above the air, is `at` at 680, 550 and 440 nm; the sun
// above the air is white (1, 1, 1). Never negative.
Vec3 colorOfThreeWavelengths(Vec3 at);

}  // namespace shoal::light
