// Where the camera is: fixed, circling, along keys, a model file's own, from a list of poses, or fitted.
#include <algorithm>
#include <cmath>

#include <shoal/core/pose.h>
#include <shoal/scene/content.h>

#include "scene/content_parts.h"

namespace shoal::scene {

namespace {

struct ModelCameraPlace {
    const Instance* instance = nullptr;
    const Model* model = nullptr;
    std::size_t node = 0;
};

// `wanted`: "model", "model/camera" or "/camera"; a camera goes by its own name or its node's.
std::optional<ModelCameraPlace> findModelCamera(const std::string& wanted, const Content& content) {
    const std::size_t slash = wanted.find('/');
    const std::string modelName = wanted.substr(0, slash);
    const std::string cameraName = slash == std::string::npos ? "" : wanted.substr(slash + 1);
    for (const Instance& instance : content.instances) {
        if (!modelName.empty() && instance.name != modelName) continue;
        const Model& model = content.models[std::size_t(instance.model)];
        for (std::size_t i = 0; i < model.nodes.size(); ++i) {
            if (model.nodes[i].camera < 0) continue;
            const std::string& name = model.cameras[std::size_t(model.nodes[i].camera)].name;
            if (cameraName.empty() || name == cameraName || model.nodes[i].name == cameraName)
                return ModelCameraPlace{&instance, &model, i};
        }
    }
    return {};
}

light::Camera modelCamera(const ModelCameraPlace& place, float time) {
    Pose pose;
    poseModel(*place.model, place.instance->clip, place.instance->startTime + time * place.instance->speed,
              place.instance->loop, pose);
    const Mat4 worldFromNode = transformAt(*place.instance, time) * pose.modelFromNode[place.node];
    const ModelCamera& from = place.model->cameras[std::size_t(place.model->nodes[place.node].camera)];
    // A scaled node must not scale the view: only its axes' directions count.
    const Vec3 eye = transformPoint(worldFromNode, {0, 0, 0});
    const Vec3 ahead = normalize(transformDirection(worldFromNode, {0, 0, -1}));
    light::Camera camera = light::cameraLookingAt(eye, eye + ahead, from.verticalFov,
                                                  normalize(transformDirection(worldFromNode, {0, 1, 0})));
    camera.nearZ = std::max(from.nearZ, 1e-3f);
    if (from.orthographic) {
        camera.projection = light::Camera::Projection::orthographic;
        camera.heightM = from.heightM;
    }
    return camera;
}

template <class T>
T catmullRom(const T& p0, const T& p1, const T& p2, const T& p3, float t) {
    const float t2 = t * t, t3 = t2 * t;
    return (p1 * 2.0f + (p2 - p0) * t + (p0 * 2.0f - p1 * 5.0f + p2 * 4.0f - p3) * t2 +
            (p1 * 3.0f - p0 - p2 * 3.0f + p3) * t3) *
           0.5f;
}

CameraKey keyAt(const std::vector<CameraKey>& keys, float time) {
    if (time <= keys.front().time) return keys.front();
    if (time >= keys.back().time) return keys.back();
    std::size_t i = 0;
    while (keys[i + 1].time <= time) ++i;
    const CameraKey &a = keys[i], &b = keys[i + 1];
    const CameraKey& before = i > 0 ? keys[i - 1] : a;
    const CameraKey& after = i + 2 < keys.size() ? keys[i + 2] : b;
    const float t = (time - a.time) / (b.time - a.time);
    CameraKey key;
    key.time = time;
    key.position = catmullRom(before.position, a.position, b.position, after.position, t);
    key.target = catmullRom(before.target, a.target, b.target, after.target, t);
    key.fovDeg = std::clamp(catmullRom(before.fovDeg, a.fovDeg, b.fovDeg, after.fovDeg, t), 1.0f, 179.0f);
    return key;
}

Mat4 poseAt(const std::vector<CameraPoseKey>& poses, float time) {
    // Poses are taken as they stand: the last one not after `time` (half a microsecond forgives rounding of frame
    // times).
    std::size_t i = 0;
    while (i + 1 < poses.size() && poses[i + 1].time <= time + 5e-7f) ++i;
    return poses[i].worldFromView;
}

Vec3 cornerOf(const Bounds& box, int corner) {
    return {corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y, corner & 4 ? box.hi.z : box.lo.z};
}

// Where along `axis` an eye at `distance` behind the centre has as much of the boxes on one side of the picture as on
// the other.
float middleSeen(const std::vector<Bounds>& boxes, Vec3 center, Vec3 axis, Vec3 back, float distance) {
    const auto imbalance = [&](float eye) {
        float most = -1e30f, least = 1e30f;
        for (const Bounds& box : boxes) {
            for (int corner = 0; corner < 8; ++corner) {
                const Vec3 p = cornerOf(box, corner) - center;
                const float slope = (dot(p, axis) - eye) / (distance - dot(p, back));
                most = std::max(most, slope), least = std::min(least, slope);
            }
        }
        return most + least;  // falls as the eye moves along
    };
    float lo = -distance * 4, hi = distance * 4;
    for (int i = 0; i < 40; ++i) {
        const float middle = 0.5f * (lo + hi);
        (imbalance(middle) > 0 ? lo : hi) = middle;
    }
    return 0.5f * (lo + hi);
}

// Looks down a little and from the side, as near as holds every box in the picture. For a given direction that is a
// closed form: with coordinates right, up and back of the camera, a point p is inside the left and right edges when
// eye.back >= p.back + |p.right - eye.right| / tanX; two lines whose crossing is the nearest eye. The same goes for up
// and down.
light::Camera fittedCamera(const CameraSpec& spec, const Content& content, float aspect) {
    const float fov = radians(spec.fovDeg);
    const Bounds& all = content.focus;
    if (all.empty()) return light::cameraLookingAt({4, 3, 6}, {0, 0, 0}, fov);
    const Vec3 size = all.size();
    // Flat, wide things (a street, a harbour) are looked at from higher up.
    const float flatness = std::clamp(size.y / std::max({size.x, size.z, 1e-6f}), 0.0f, 1.0f);
    // Long things (ships, fish) are looked at more from the side.
    const float longness = std::clamp((size.z / std::max(size.x, 1e-6f) - 1.2f) / 1.5f, 0.0f, 1.0f);
    const float elevation = radians(10.0f + 18.0f * (1 - flatness)), azimuth = radians(32 + 23 * longness);
    const Vec3 back{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                    std::cos(elevation) * std::cos(azimuth)};
    const Vec3 right = normalize(cross({0, 1, 0}, back)), up = cross(back, right);
    const float tanY = std::tan(0.5f * fov), tanX = tanY * aspect;
    float toRight = -1e30f, toLeft = -1e30f, toUp = -1e30f, toDown = -1e30f, nearest = -1e30f;
    const Vec3 center = all.center();
    for (const Bounds& box : content.focusBoxes) {
        for (int corner = 0; corner < 8; ++corner) {
            const Vec3 p = cornerOf(box, corner) - center;
            const float r = dot(p, right), u = dot(p, up), b = dot(p, back);
            toRight = std::max(toRight, b + r / tanX), toLeft = std::max(toLeft, b - r / tanX);
            toUp = std::max(toUp, b + u / tanY), toDown = std::max(toDown, b - u / tanY);
            nearest = std::max(nearest, b);
        }
    }
    constexpr float kMargin = 1.06f;
    const float distance = std::max(0.5f * std::max(toRight + toLeft, toUp + toDown), nearest + 1e-3f) * kMargin;
    // From there the edges have slack; what is seen goes to the middle of the picture.
    const Vec3 target = center + right * middleSeen(content.focusBoxes, center, right, back, distance) +
                        up * middleSeen(content.focusBoxes, center, up, back, distance);
    light::Camera camera = light::cameraLookingAt(target + back * distance, target, fov);
    camera.nearZ = std::clamp(0.002f * distance, 1e-4f, 0.1f);
    camera.heightM = 2 * distance * tanY;
    return camera;
}

light::Camera lookingCamera(const CameraSpec& spec, Vec3 position, Vec3 target, float fovDeg) {
    Vec3 up = spec.up;
    if (spec.rollDeg != 0) up = rotate(axisAngle(normalize(target - position), radians(spec.rollDeg)), up);
    light::Camera camera = light::cameraLookingAt(position, target, radians(fovDeg), up);
    camera.nearZ = spec.near;
    camera.heightM = spec.heightM;
    return camera;
}

}  // namespace

int preferredClip(const Model& model) {
    for (const char* wanted : {"walk", "walking", "walking_a", "idle"}) {
        const int clip = findClip(model, wanted);
        if (clip >= 0) return clip;
    }
    return 0;
}

Image toRgb(Image picture) {
    if (picture.channelCount == 3) return picture;
    Image rgb(picture.width, picture.height, 3);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) std::copy_n(picture.at(x, y), 3, rgb.at(x, y));
    return rgb;
}

Result<void> checkModelCamera(const Scene& scene, const Content& content) {
    if (findModelCamera(scene.cameraOfModel, content)) return {};
    std::string found;
    for (const Instance& instance : content.instances)
        for (const Node& node : content.models[std::size_t(instance.model)].nodes)
            if (node.camera >= 0) found += (found.empty() ? "" : ", ") + instance.name + "/" + node.name;
    return badInput(scene.cameraPlace.describe() + ": camera.model: found \"" + scene.cameraOfModel + "\", expected " +
                    (found.empty() ? "another kind of camera: no model of this scene has one" : "one of " + found));
}

light::Camera cameraAt(const Scene& scene, const Content& content, float time, float aspect) {
    const CameraSpec& spec = scene.camera;
    light::Camera camera;
    switch (scene.cameraKind) {
        case CameraKind::fixed:
            camera = lookingCamera(spec, spec.position, spec.target, spec.fovDeg);
            break;
        case CameraKind::orbit: {
            const float angle = radians(scene.orbit.startDeg + time * scene.orbit.degPerSecond),
                        elevation = radians(scene.orbit.elevationDeg);
            const Vec3 toEye{std::cos(elevation) * std::sin(angle), std::sin(elevation),
                             std::cos(elevation) * std::cos(angle)};
            camera =
                lookingCamera(spec, scene.orbit.center + toEye * scene.orbit.radius, scene.orbit.center, spec.fovDeg);
            break;
        }
        case CameraKind::path: {
            const CameraKey key = keyAt(scene.cameraKeys, time);
            camera = lookingCamera(spec, key.position, key.target, key.fovDeg);
            break;
        }
        case CameraKind::modelCamera:
            camera = modelCamera(*findModelCamera(scene.cameraOfModel, content), time);
            break;
        case CameraKind::poses:
            camera.worldFromView = poseAt(content.poses, time);
            camera.verticalFov = radians(spec.fovDeg);
            camera.nearZ = spec.near;
            camera.heightM = spec.heightM;
            break;
        case CameraKind::fitted:
            camera = fittedCamera(spec, content, aspect);
            break;
    }
    if (spec.projection == "orthographic") camera.projection = light::Camera::Projection::orthographic;
    if (scene.intrinsics) {
        const IntrinsicsSpec& i = *scene.intrinsics;
        camera.intrinsics = light::Intrinsics{i.fx, i.fy, i.cx, i.cy, i.width, i.height};
    }
    return camera;
}

}  // namespace shoal::scene
