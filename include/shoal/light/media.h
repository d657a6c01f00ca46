// A homogeneous participating medium.
#pragma once

#include <shoal/core/math.h>

namespace shoal::light {

struct Medium {
    Vec3 absorption{0, 0, 0};  // 1/m per channel, >= 0
    Vec3 scattering{0, 0, 0};  // 1/m per channel, >= 0
    float anisotropy = 0;      // Henyey-Greenstein g, -1 < g < 1: mean cosine between the way light comes and goes
    Vec3 extinction() const { return absorption + scattering; }
};

// Henyey-Greenstein phase function, 1/sr; integrates to 1 over the sphere. cosTheta: between the directions light
// travels in before and after scattering (1: straight on).
float henyeyGreenstein(float cosTheta, float g);
// Fraction left after `distance` metres.
Vec3 transmittance(const Medium& medium, float distance);

}  // namespace shoal::light
