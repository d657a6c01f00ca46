#include "view/camera.h"

#include <algorithm>
#include <cmath>

namespace shoal::viewer {

namespace {

constexpr float kSteepest = radians(89.5f);  // between looking level and straight up or down
constexpr float kLeastDistance = 1e-4f;      // metres

Vec3 anyAcross(Vec3 v) { return std::abs(v.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 0, 1}; }

}  // namespace

void ViewCamera::take(const light::Camera& camera, const scene::CameraSpec& spec, float pivotDistance) {
    const Mat4& m = camera.worldFromView;
    const Vec3 ahead = normalize(Vec3{-m(0, 2), -m(1, 2), -m(2, 2)});
    spec_ = spec;
    spec_.position = camera.position();
    spec_.target = spec_.position + ahead * std::max(pivotDistance, kLeastDistance);
    // A roll stays a roll: what is up in the picture, where it leans from the scene's own up.
    const Vec3 up{m(0, 1), m(1, 1), m(2, 1)};
    const Vec3 level = normalize(cross(cross(ahead, spec.up), ahead));
    if (dot(up, level) < 0.9999f) spec_.up = up;
    spec_.rollDeg = 0;
    spec_.near = camera.nearZ;
    spec_.heightM = camera.heightM;
    if (!camera.intrinsics) spec_.fovDeg = std::clamp(degrees(camera.verticalFov), 1.0f, 179.0f);
    spec_.projection = camera.projection == light::Camera::Projection::orthographic ? "orthographic" : "perspective";
}

ViewCamera::Axes ViewCamera::axes() const {
    Axes a;
    a.worldUp = normalize(spec_.up);
    if (length(a.worldUp) == 0) a.worldUp = {0, 1, 0};
    a.back = normalize(spec_.position - spec_.target);
    a.right = cross(a.worldUp, a.back);
    if (length(a.right) < 1e-5f) a.right = cross(anyAcross(a.worldUp), a.back);
    a.right = normalize(a.right);
    a.up = cross(a.back, a.right);
    return a;
}

void ViewCamera::turn(Vec3& offset, float yaw, float pitch) const {
    const Axes a = axes();
    const float size = length(offset);
    const Vec3 direction = offset / size;
    const float elevation = std::asin(std::clamp(dot(direction, a.worldUp), -1.0f, 1.0f));
    Vec3 level = direction - a.worldUp * dot(direction, a.worldUp);
    level = length(level) > 1e-5f ? normalize(level) : normalize(cross(a.right, a.worldUp));
    level = rotate(axisAngle(a.worldUp, yaw), level);
    const float raised = std::clamp(elevation + pitch, -kSteepest, kSteepest);
    offset = (level * std::cos(raised) + a.worldUp * std::sin(raised)) * size;
}

void ViewCamera::orbit(float yaw, float pitch) {
    Vec3 offset = spec_.position - spec_.target;
    turn(offset, yaw, pitch);
    spec_.position = spec_.target + offset;
    free_ = true;
}

void ViewCamera::look(float yaw, float pitch) {
    Vec3 offset = spec_.target - spec_.position;
    turn(offset, yaw, pitch);
    spec_.target = spec_.position + offset;
    free_ = true;
}

void ViewCamera::pan(float rightPx, float upPx, int heightPx) {
    const Axes a = axes();
    const float seen = spec_.projection == "orthographic"
                           ? spec_.heightM
                           : 2 * pivotDistance() * std::tan(0.5f * radians(spec_.fovDeg));
    const float metres = seen / float(std::max(heightPx, 1));
    const Vec3 shift = (a.right * -rightPx + a.up * -upPx) * metres;
    spec_.position += shift;
    spec_.target += shift;
    free_ = true;
}

void ViewCamera::dolly(float steps) {
    const float factor = std::pow(0.9f, steps);
    const Vec3 offset = spec_.position - spec_.target;
    if (length(offset) * factor < 1e-3f) return;
    spec_.position = spec_.target + offset * factor;
    spec_.heightM = std::clamp(spec_.heightM * factor, 1e-4f, 1e6f);
    free_ = true;
}

void ViewCamera::move(Vec3 direction, float metres) {
    const Axes a = axes();
    const Vec3 shift = (a.right * direction.x + a.worldUp * direction.y - a.back * direction.z) * metres;
    spec_.position += shift;
    spec_.target += shift;
    free_ = true;
}

void ViewCamera::frame(const Bounds& bounds, float aspect) {
    if (bounds.empty()) return;
    const Vec3 back = axes().back;
    const float tangent = std::tan(0.5f * radians(spec_.fovDeg)) * std::min(1.0f, aspect);
    const float radius = std::max(bounds.radius(), 1e-3f);
    const float distance = radius / std::sin(std::atan(tangent));
    spec_.target = bounds.center();
    spec_.position = spec_.target + back * distance;
    spec_.heightM = 2 * radius / std::min(1.0f, aspect);
    spec_.near = std::clamp(0.002f * distance, 1e-4f, 0.1f);
    free_ = true;
}

void ViewCamera::lookFrom(Side side, const Bounds& bounds, float aspect) {
    static constexpr Vec3 kBack[] = {{0, 0, 1}, {0, 0, -1}, {-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
    Vec3 back = kBack[int(side)];
    // Straight down would leave no direction that is up: a hair less keeps the front at the bottom.
    if (side == Side::top || side == Side::bottom) back = normalize(back + Vec3{0, 0, 0.004f});
    spec_.up = {0, 1, 0};
    spec_.target = bounds.empty() ? Vec3{} : bounds.center();
    spec_.position = spec_.target + back;
    frame(bounds, aspect);
    free_ = true;
}

void ViewCamera::toggleOrthographic() {
    const bool flat = spec_.projection == "orthographic";
    // What is at the pivot keeps its size.
    const float tangent = std::tan(0.5f * radians(spec_.fovDeg));
    if (flat)
        spec_.position = spec_.target + axes().back * (0.5f * spec_.heightM / tangent);
    else
        spec_.heightM = 2 * pivotDistance() * tangent;
    spec_.projection = flat ? "perspective" : "orthographic";
    free_ = true;
}

light::Camera ViewCamera::camera(const scene::Scene& scene, const scene::Content& content, float aspect) const {
    scene::Scene fixed;
    fixed.cameraKind = scene::CameraKind::fixed;
    fixed.camera = spec_;
    fixed.intrinsics = scene.intrinsics;
    return scene::cameraAt(fixed, content, 0, aspect);
}

}  // namespace shoal::viewer
