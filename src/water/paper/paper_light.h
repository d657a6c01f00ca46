// The light's view of the paper's method (section 3.1) and what its photons carry.
#pragma once

#include <shoal/water/paper.h>

namespace shoal::water {

inline constexpr int kPaperShadowResolution = 1024;  // texels a side of the shadow map
inline constexpr float kPaperIntensity = 9.2f;  // W/sr (4.1): PaperParams::intensity that leaves the light as it is
inline constexpr float kPaperGainDistance = 8;  // metres: where gain 1 is right

struct PaperLight {
    bool lit = false;   // false: no light reaches water that the eye may see
    bool lamp = false;  // rays leave a point
    light::View view;
    Vec3 ray;            // the sun: where its light travels; lamps: their place
    Vec3 axis;           // where a spot shines
    float cosCone = -1;  // least cosine from the axis
    float coneScale = 1;
    Vec3 light;             // sun: W/m2 across its rays; lamps: W/sr
    float screenArea = 0;   // what the light's screen covers: m2 across the rays; lamps: sr, were all of it at the axis
    float farZ = 0;         // metres, the eye's z_far
    Vec3 middle;            // p_mid
    Vec2 maskMin, maskMax;  // x, z of the water in the light's view
};

PaperLight fitPaperLight(const light::View& eye, const PaperParams& params, const Body& body, const BodyLights& lights,
                         const Bounds& sceneBounds);

}  // namespace shoal::water
