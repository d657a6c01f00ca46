// A mirrored eye is kept rigid: position, forward and up are mirrored, so that right points the other way and the
// picture is flipped. World points are projected into it as into any other.
#include "water/surface/surface_views.h"

#include <cmath>
#include <optional>
#include <span>

namespace shoal::water {
namespace {

constexpr float kWiden = 1.15f;         // waves mirror more than a level surface: beyond the picture's borders
constexpr int kRays = 9;                // looked at a side of the picture
constexpr float kSeenDepth = 4;         // metres under the surface that the view along bent rays is laid out for
constexpr float kWidest = radians(70);  // half angle of the view through the window

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

std::optional<light::View> mirroredView(const light::View& view, float level, float scale) {
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

// A camera at `eye`, wide enough for all the directions.
light::View viewOf(Vec3 eye, std::span<const Vec3> directions, const light::View& like, float scale) {
    Vec3 sum{};
    for (const Vec3& d : directions) sum += d;
    const Vec3 forward = normalize(sum);
    float least = 1;
    for (const Vec3& d : directions) least = std::min(least, dot(d, forward));
    const float half = std::min(std::acos(std::clamp(least, -1.0f, 1.0f)) + radians(8), kWidest);
    light::Camera camera = light::cameraLookingAt(eye, eye + forward, 2 * half);
    camera.nearZ = like.nearZ;
    const int side = scaled(like.height, scale);
    return light::makeView(camera, side, side);
}

// From the surface above the eye: all that the picture sees through the window upwards. Nothing where it sees none.
std::optional<light::View> windowView(const light::View& view, const Body& body, float scale) {
    const float index = body.optics.index;
    std::vector<Vec3> directions;
    forRays(view, [&](const Ray& ray) {
        const Vec3 d = ray.direction;
        const float horizontal2 = (d.x * d.x + d.z * d.z) * index * index;
        if (d.y <= 0 || horizontal2 > 1.2f) return;  // just outside the rim counts: waves tilt it
        const float shrink = horizontal2 > 0.98f ? std::sqrt(0.98f / horizontal2) : 1.0f;
        directions.push_back({d.x * index * shrink, std::sqrt(1 - std::min(horizontal2, 0.98f)), d.z * index * shrink});
    });
    if (directions.empty()) return std::nullopt;
    return viewOf({view.eye.x, body.params.level, view.eye.z}, directions, view, scale);
}

// Where an eye above the water seems to stand, seen along the bent rays (index times as high): what they meet beyond
// the picture's border or behind what hides it there.
std::optional<light::View> bentView(const light::View& view, const Body& body, float scale) {
    if (view.orthographic) return std::nullopt;
    const float index = body.optics.index, level = body.params.level, height = view.eye.y - level;
    const Vec3 eye{view.eye.x, level + index * height, view.eye.z};
    std::vector<Vec3> directions;
    forRays(view, [&](const Ray& ray) {
        const Vec3 d = ray.direction;
        if (d.y > -0.05f) return;
        const Vec3 start = view.eye + d * (-height / d.y);
        const Vec3 bent{d.x / index, -std::sqrt(1 - (1 - d.y * d.y) / (index * index)), d.z / index};
        directions.push_back(normalize(start - eye));
        directions.push_back(normalize(start + bent * (-kSeenDepth / bent.y) - eye));
    });
    if (directions.empty()) return std::nullopt;
    return viewOf(eye, directions, view, scale);
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
    const float scale = params.reflectionScale;
    const auto add = [&](std::optional<light::View> seen, Mirror shows) {
        if (!seen) return;
        const bool under = shows == kWaterMirror;
        const Vec4 plane = under ? Vec4{0, -1, 0, level + slack} : Vec4{0, 1, 0, slack - level};
        chosen.push_back({{*seen, plane, under}, shows});
    };
    if (sceneBounds.hi.y > level && (!above || looksDown))
        add(above ? mirroredView(view, level, scale) : windowView(view, body, scale), kAirMirror);
    if (sceneBounds.lo.y < level && looksUp && (!above || crossing))
        add(mirroredView(view, level, scale), kWaterMirror);
    else if (sceneBounds.lo.y < level && above && looksDown)
        add(bentView(view, body, scale), kWaterMirror);
    return chosen;
}

}  // namespace shoal::water
