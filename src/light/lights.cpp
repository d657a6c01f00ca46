// Punctual lights after KHR_lights_punctual (Khronos): range window and spot cone as its text recommends.
#include <shoal/light/lights.h>

namespace shoal::light {
namespace {

float rangeWindow(float distance, float range) {
    if (range <= 0) return 1;
    const float ratio = distance / range;
    return std::clamp(1 - ratio * ratio * ratio * ratio, 0.0f, 1.0f);
}

float spotCone(const PunctualLight& light, Vec3 fromLight) {
    if (light.kind != PunctualLight::Kind::spot) return 1;
    const float cosOuter = std::cos(light.outerCone), cosInner = std::cos(light.innerCone);
    const float scale = 1 / std::max(0.001f, cosInner - cosOuter);
    const float fade = std::clamp((dot(normalize(light.direction), fromLight) - cosOuter) * scale, 0.0f, 1.0f);
    return fade * fade;
}

}  // namespace

Vec3 irradianceAt(const PunctualLight& light, Vec3 point) {
    const Vec3 toPoint = point - light.position;
    const float distance = length(toPoint);
    const float closest = std::max(distance, std::max(light.radius, 1e-4f));
    // At the light itself there is no direction; the cone's axis stands for it.
    const Vec3 fromLight = distance > 0 ? toPoint / distance : normalize(light.direction);
    return light.intensity * (rangeWindow(distance, light.range) * spotCone(light, fromLight) / (closest * closest));
}

}  // namespace shoal::light
