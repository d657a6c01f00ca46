// [Papadopoulos & Papaioannou 2010] section 3.1: the light's view follows the eye's and looks at its middle, p_mid. The
// paper prints no size for it; here it holds what the eye may see of the scene under water, and the places on the
// surface where level water lets light through to that.
#include "water/paper/paper_light.h"

#include <algorithm>
#include <cmath>

#include "water/paper/clip_polygon.h"

namespace shoal::water {
namespace {

constexpr float kWidestTangent = 1.7320508f;  // of half a lamp's view: 60 degrees
constexpr float kLowestSun = 0.02f;           // toSun.y below which there is no sun
constexpr float kMostDrift = 0.1f;            // part of the view's size added for rays that waves turn aside

struct Frame {
    Vec3 right, up, back;  // back: against the direction of light
    Vec3 origin;
    Vec3 place(Vec3 p) const { return {dot(right, p - origin), dot(up, p - origin), dot(back, p - origin)}; }
};

// An edge of the view runs along the eye's direction, so that its rectangle fits what the eye sees.
Frame frameAlong(Vec3 back, Vec3 origin, const light::View& eye) {
    const Vec3 ahead{eye.worldFromView(0, 2), eye.worldFromView(1, 2), eye.worldFromView(2, 2)};
    const Vec3 above{eye.worldFromView(0, 1), eye.worldFromView(1, 1), eye.worldFromView(2, 1)};
    Vec3 right = cross(ahead, back);
    if (length(right) < 0.05f) right = cross(above, back);
    Frame frame;
    frame.back = back;
    frame.right = normalize(right);
    frame.up = cross(back, frame.right);
    frame.origin = origin;
    return frame;
}

Vec3 cornerOf(const Bounds& b, int i) {
    return {(i & 1) ? b.hi.x : b.lo.x, (i & 2) ? b.hi.y : b.lo.y, (i & 4) ? b.hi.z : b.lo.z};
}

// The eye's z_far: the scene's farthest corner, not beyond params.distance.
float farDistance(const light::View& eye, const PaperParams& params, const Bounds& scene) {
    float farthest = 0;
    for (int i = 0; i < 8; ++i) farthest = std::max(farthest, -transformPoint(eye.viewFromWorld, cornerOf(scene, i)).z);
    return std::clamp(farthest, 4 * eye.nearZ, std::max(params.distance, 4 * eye.nearZ));
}

// Corners of the eye's frustum: bit 0 right, bit 1 top, bit 2 far.
std::array<Vec3, 8> frustumCorners(const light::View& eye, float farZ) {
    std::array<Vec3, 8> corners;
    for (int i = 0; i < 8; ++i) {
        const Vec3 p = transformPoint(eye.viewFromClip, {(i & 1) ? 1.0f : -1.0f, (i & 2) ? 1.0f : -1.0f, 1.0f});
        const float z = (i & 4) ? farZ : -p.z;
        const float scale = eye.orthographic ? 1 : z / -p.z;
        corners[std::size_t(i)] = transformPoint(eye.worldFromView, {p.x * scale, p.y * scale, -z});
    }
    return corners;
}

// Where light is seen: the water over the scene, from its bottom to the surface (god rays need nothing to fall on).
Bounds waterBounds(const Body& body, const Bounds& scene, float waveHeight) {
    const BodyParams& p = body.params;
    Bounds b;
    b.lo = {std::max(scene.lo.x, p.areaMin.x), scene.lo.y, std::max(scene.lo.z, p.areaMin.y)};
    b.hi = {std::min(scene.hi.x, p.areaMax.x), p.level + waveHeight, std::min(scene.hi.z, p.areaMax.y)};
    if (b.lo.x > b.hi.x || b.lo.y > b.hi.y || b.lo.z > b.hi.z) return {};
    return b;
}

struct Rectangle {
    Vec2 lo{1e30f, 1e30f}, hi{-1e30f, -1e30f};
    void add(Vec3 p) {
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
};

const light::PunctualLight* lampAbove(const BodyLights& lights, float level) {
    for (const light::PunctualLight& lamp : lights.punctual)
        if (lamp.position.y > level) return &lamp;
    return nullptr;
}

void finishView(light::View& view) {
    view.width = view.height = kPaperShadowResolution;
    view.worldFromView = inverse(view.viewFromWorld).value_or(Mat4{});
    view.viewFromClip = inverse(view.clipFromView).value_or(Mat4{});
}

// Where light enters level water to reach p; p itself above it. refracted.y < 0.
Vec3 entryAbove(Vec3 p, Vec3 refracted, float level) {
    const float below = level - p.y;
    return below > 0 ? p + refracted * (below / refracted.y) : p;
}

void fitSun(PaperLight& fit, const light::View& eye, const Body& body, const light::Sun& sun, const Bounds& scene,
            const VisiblePoints& visible, float deepest) {
    const Vec3 toSun = normalize(sun.toSun);
    const Frame frame = frameAlong(toSun, fit.middle, eye);
    const float index = body.optics.index;
    const float cosIn = toSun.y, cosOut = std::sqrt(1 - (1 - cosIn * cosIn) / (index * index));
    const Vec3 refracted = toSun * (-1 / index) + Vec3{0, cosIn / index - cosOut, 0};

    const WaveBounds waves = body.waves ? body.waves->bounds() : WaveBounds{};
    const float top = body.params.level + float(waves.height);
    Rectangle rectangle;
    for (int i = 0; i < visible.count; ++i) {
        rectangle.add(frame.place(visible.points[std::size_t(i)]));
        Vec3 entry = entryAbove(visible.points[std::size_t(i)], refracted, body.params.level);
        entry.x = std::clamp(entry.x, body.params.areaMin.x, body.params.areaMax.x);
        entry.z = std::clamp(entry.z, body.params.areaMin.y, body.params.areaMax.y);
        rectangle.add(frame.place(entry));
    }
    const float size = std::max(rectangle.hi.x - rectangle.lo.x, rectangle.hi.y - rectangle.lo.y);
    const float drift = std::min(0.3f * float(waves.slope) * deepest, kMostDrift * size) + 0.005f * size + 1e-3f;
    rectangle.lo = rectangle.lo - Vec2{drift, drift};
    rectangle.hi = rectangle.hi + Vec2{drift, drift};

    // Along the light: everything that may stand in it, and the water.
    float nearest = -1e30f, farthest = 1e30f;
    for (int i = 0; i < 8; ++i) {
        const float z = frame.place(cornerOf(scene, i)).z;
        nearest = std::max(nearest, z), farthest = std::min(farthest, z);
    }
    for (int i = 0; i < 4; ++i) {  // where the view's edges meet the water
        const Vec2 at{(i & 1) ? rectangle.hi.x : rectangle.lo.x, (i & 2) ? rectangle.hi.y : rectangle.lo.y};
        const Vec3 foot = frame.origin + frame.right * at.x + frame.up * at.y;
        const float z = (top - foot.y) / toSun.y;
        nearest = std::max(nearest, z), farthest = std::min(farthest, z - 2 * float(waves.height) / toSun.y);
        const Vec3 p = foot + toSun * z;
        fit.maskMin = {std::min(fit.maskMin.x, p.x), std::min(fit.maskMin.y, p.z)};
        fit.maskMax = {std::max(fit.maskMax.x, p.x), std::max(fit.maskMax.y, p.z)};
    }
    const float margin = 0.01f * (nearest - farthest) + 0.01f;
    nearest += margin, farthest -= margin;

    light::View& view = fit.view;
    const Vec3 rows[3] = {frame.right, frame.up, frame.back};
    view.eye = fit.middle + toSun * nearest;
    for (int r = 0; r < 3; ++r) {
        view.viewFromWorld(r, 0) = rows[r].x, view.viewFromWorld(r, 1) = rows[r].y;
        view.viewFromWorld(r, 2) = rows[r].z, view.viewFromWorld(r, 3) = -dot(rows[r], view.eye);
    }
    view.clipFromView =
        orthographicReversed(rectangle.lo.x, rectangle.hi.x, rectangle.lo.y, rectangle.hi.y, 0, nearest - farthest);
    view.nearZ = 0;
    view.orthographic = true;
    finishView(view);
    fit.ray = -toSun;
    fit.light = sun.irradiance;
    fit.screenArea = (rectangle.hi.x - rectangle.lo.x) * (rectangle.hi.y - rectangle.lo.y);
    fit.lit = true;
}

void fitLamp(PaperLight& fit, const Body& body, const light::PunctualLight& lamp, const VisiblePoints& visible) {
    light::View& view = fit.view;
    view.viewFromWorld = lookAt(lamp.position, fit.middle, {0, 1, 0});
    float tangent = 0.05f;
    for (int i = 0; i < visible.count; ++i) {
        const Vec3 p = transformPoint(view.viewFromWorld, visible.points[std::size_t(i)]);
        const float across = std::max(std::abs(p.x), std::abs(p.y));
        tangent = std::max(tangent, p.z < -1e-3f ? across / -p.z : kWidestTangent);
    }
    tangent = std::min(tangent, kWidestTangent);
    view.eye = lamp.position;
    view.nearZ = std::max(lamp.radius, 0.02f);
    view.clipFromView = perspectiveReversed(2 * std::atan(tangent), 1, view.nearZ);
    finishView(view);
    fit.lamp = true;
    fit.ray = lamp.position;
    fit.light = lamp.intensity;
    fit.screenArea = 4 * tangent * tangent;
    if (lamp.kind == light::PunctualLight::Kind::spot) {
        fit.axis = normalize(lamp.direction);
        fit.cosCone = std::cos(lamp.outerCone);
        fit.coneScale = 1 / std::max(std::cos(lamp.innerCone) - fit.cosCone, 1e-4f);
    } else {
        fit.cosCone = -2;  // all directions are well within
    }
    // The mask is drawn over all that a lamp can see: half a sphere flattened onto the water.
    const float reach = 20 * (lamp.position.y - body.params.level) + fit.farZ;
    fit.maskMin = {lamp.position.x - reach, lamp.position.z - reach};
    fit.maskMax = {lamp.position.x + reach, lamp.position.z + reach};
    fit.lit = true;
}

}  // namespace

PaperLight fitPaperLight(const light::View& eye, const PaperParams& params, const Body& body, const BodyLights& lights,
                         const Bounds& sceneBounds) {
    PaperLight fit;
    fit.farZ = 4 * eye.nearZ;
    fit.maskMin = {1e30f, 1e30f}, fit.maskMax = {-1e30f, -1e30f};
    if (sceneBounds.empty()) return fit;
    fit.farZ = farDistance(eye, params, sceneBounds);
    const Vec3 look{-eye.worldFromView(0, 2), -eye.worldFromView(1, 2), -eye.worldFromView(2, 2)};
    fit.middle = eye.eye + look * (0.5f * (eye.nearZ + fit.farZ));

    const WaveBounds waves = body.waves ? body.waves->bounds() : WaveBounds{};
    const Bounds water = waterBounds(body, sceneBounds, float(waves.height));
    if (water.empty()) return fit;
    const VisiblePoints visible = visiblePoints(frustumCorners(eye, fit.farZ), water);
    if (visible.count == 0) return fit;
    const bool sunUp =
        lights.sun && normalize(lights.sun->toSun).y > kLowestSun && luminance(lights.sun->irradiance) > 0;
    if (sunUp)
        fitSun(fit, eye, body, *lights.sun, sceneBounds, visible, body.params.level - water.lo.y);
    else if (const light::PunctualLight* lamp = lampAbove(lights, body.params.level))
        fitLamp(fit, body, *lamp, visible);
    fit.maskMin = {std::max(fit.maskMin.x, body.params.areaMin.x), std::max(fit.maskMin.y, body.params.areaMin.y)};
    fit.maskMax = {std::min(fit.maskMax.x, body.params.areaMax.x), std::min(fit.maskMax.y, body.params.areaMax.y)};
    return fit;
}

}  // namespace shoal::water
