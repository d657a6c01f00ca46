// The sun and local lights.
#pragma once

#include <optional>
#include <vector>

#include <shoal/core/math.h>

namespace shoal::light {

struct Sun {
    Vec3 toSun{0.3f, 0.9f, 0.25f};      // world, unit after loading
    Vec3 irradiance{9.2f, 9.2f, 8.8f};  // W/m2 per channel on a plane FACING the sun (E_perp)
    float discHalfAngle = 0.004654f;    // radians (0.2667 degrees: the sun); 0 is a point
    bool castsShadow = true;
};

struct PunctualLight {
    enum class Kind { point, spot } kind = Kind::point;
    Vec3 position;                               // world
    Vec3 direction{0, -1, 0};                    // where a spot shines, unit
    Vec3 intensity{1, 1, 1};                     // W/sr per channel; irradiance at distance d is intensity / d2
    float range = 0;                             // metres, 0: infinite; smooth window [KHR_lights_punctual]
    float innerCone = 0, outerCone = 0.785398f;  // half angles, radians
    float radius = 0.05f;      // metres: distance below which the light stops getting brighter, softness of the shadow
    bool castsShadow = false;  // spots only
};

// Irradiance (W/m2) that `light` puts on a plane at `point` facing it, without shadow.
Vec3 irradianceAt(const PunctualLight& light, Vec3 point);

}  // namespace shoal::light
