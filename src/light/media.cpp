// Henyey & Greenstein, Diffuse radiation in the galaxy, 1941; Beer and Lambert's law.
#include <shoal/light/media.h>

namespace shoal::light {

float henyeyGreenstein(float cosTheta, float g) {
    const float base = std::max(1 + g * g - 2 * g * cosTheta, 1e-6f);  // zero only straight on for |g| = 1
    return (1 - g * g) / (4 * kPi * base * std::sqrt(base));
}

Vec3 transmittance(const Medium& medium, float distance) {
    const Vec3 depth = medium.extinction() * distance;
    return {std::exp(-depth.x), std::exp(-depth.y), std::exp(-depth.z)};
}

}  // namespace shoal::light
