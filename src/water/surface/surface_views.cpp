// A mirrored eye is kept rigid: position, forward and up are mirrored, so that right points the other way and the
// picture is flipped. World points are projected into it as into any other.
#include "water/surface/surface_views.h"

#include <cmath>

namespace shoal::water {
namespace {

constexpr float kWiden = 1.15f;               // waves mirror more than a level surface: beyond the picture's borders
constexpr int kRays = 9;                      // looked at a side of the picture
constexpr float kWidestWindow = radians(70);  // half angle of the view through the window

Vec3 column(const Mat4& m, int i) { return {m(0, i), m(1, i), m(2, i)}; }

void setColumn(Mat4& m, int i, Vec3 v) { m(0, i) = v.x, m(1, i) = v.y, m(2, i) = v.z; }

// Direction of the ray through normalised device coordinates (x, y) and where it starts.
struct Ray {
    Vec3 origin, direction;
};
Ray rayAt(const light::View& view, float x, float y) {
    const Vec3 near = transformPoint(view.viewFromClip, {x, y, 1});
    if (view.orthographic)
        return {transformPoint(view.worldFromView, {near.x, near.y, 0}), column(view.worldFromView, 2) * -1.0f};
    return {view.eye, normalize(transformDirection(view.worldFromView, near))};
}

template <class F>
void forRays(const light::View& view, const F& f) {
    for (int j = 0; j < kRays; ++j)
        for (int i = 0; i < kRays; ++i)
            f(rayAt(view, 2.0f * float(i) / float(kRays - 1) - 1, 2.0f * float(j) / float(kRays - 1) - 1));
}

int scaled(int size, float scale) { return std::max(int(std::lround(float(size) * scale)), 8); }

light::View mirroredView(const light::View& view, float level, float scale) {
    const auto turned = [](Vec3 v) { return Vec3{v.x, -v.y, v.z}; };
    light::View out = view;
    const Vec3 up = turned(column(view.worldFromView, 1)), back = turned(column(view.worldFromView, 2));
    out.eye = {view.eye.x, 2 * level - view.eye.y, view.eye.z};
    setColumn(out.worldFromView, 0, cross(up, back));
    setColumn(out.worldFromView, 1, up);
    setColumn(out.worldFromView, 2, back);
    setColumn(out.worldFromView, 3, out.eye);
    out.viewFromWorld = inverse(out.worldFromView).value_or(view.viewFromWorld);
    for (int i = 0; i < 4; ++i) {
        out.clipFromView(0, i) *= (i == 0 ? 1 : -1) / kWiden;  // what is off the middle to the right is so to the left
        out.clipFromView(1, i) *= 1 / kWiden;
    }
    out.viewFromClip = inverse(out.clipFromView).value_or(view.viewFromClip);
    out.width = scaled(view.width, scale), out.height = scaled(view.height, scale);
    return out;
}

// From the surface above the eye, wide enough for all that the picture sees through it; false where it sees nothing.
bool windowView(const light::View& view, const Body& body, float scale, light::View& out) {
    const float index = body.optics.index, level = body.params.level;
    Vec3 sum{};
    std::vector<Vec3> directions;
    forRays(view, [&](const Ray& ray) {
        const Vec3 d = ray.direction;
        const float horizontal2 = (d.x * d.x + d.z * d.z) * index * index;
        if (d.y <= 0 || horizontal2 > 1.2f) return;  // just outside the rim counts: waves tilt it
        const float shrink = horizontal2 > 0.98f ? std::sqrt(0.98f / horizontal2) : 1.0f;
        const Vec3 air{d.x * index * shrink, std::sqrt(1 - std::min(horizontal2, 0.98f)), d.z * index * shrink};
        directions.push_back(air);
        sum += air;
    });
    if (directions.empty()) return false;
    const Vec3 forward = normalize(sum);
    float least = 1;
    for (const Vec3& d : directions) least = std::min(least, dot(normalize(d), forward));
    const float half = std::min(std::acos(std::clamp(least, -1.0f, 1.0f)) + radians(8), kWidestWindow);
    const Vec3 eye{view.eye.x, level, view.eye.z};
    light::Camera camera = light::cameraLookingAt(eye, eye + forward, 2 * half);
    camera.nearZ = view.nearZ;
    const int side = scaled(view.height, scale);
    out = light::makeView(camera, side, side);
    return true;
}

}  // namespace

std::vector<ChosenView> chooseViews(const frame::Context& context, const SurfaceParams& params, const Body& body,
                                    const Bounds& sceneBounds) {
    std::vector<ChosenView> chosen;
    if (!params.reflections || !body.params.surfaceVisible || sceneBounds.empty()) return chosen;
    const light::View& view = context.view;
    const float level = body.params.level, height = body.waves ? float(body.waves->bounds().height) : 0.0f;
    const bool above = view.eye.y > level;
    const bool crossing = std::abs(view.eye.y - level) < height + 2 * view.nearZ;
    bool looksDown = false, looksUp = false;
    forRays(view, [&](const Ray& ray) { (ray.direction.y < 0 ? looksDown : looksUp) = true; });
    // Things that stand in a wave's trough are mirrored too.
    const float slack = std::min(0.25f * height, 0.1f);
    if (sceneBounds.hi.y > level) {
        ChosenView air{{{}, {0, 1, 0, slack - level}, false}, kAirMirror};
        if (above && looksDown) {
            air.view.view = mirroredView(view, level, params.reflectionScale);
            chosen.push_back(air);
        } else if (!above && windowView(view, body, params.reflectionScale, air.view.view)) {
            chosen.push_back(air);
        }
    }
    if (sceneBounds.lo.y < level && looksUp && (!above || crossing))
        chosen.push_back(
            {{mirroredView(view, level, params.reflectionScale), {0, -1, 0, level + slack}, true}, kWaterMirror});
    return chosen;
}

}  // namespace shoal::water
