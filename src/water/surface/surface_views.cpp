// A mirrored eye is kept rigid: position, forward and up are mirrored, so that right points the other way and the
// picture is flipped. World points are projected into it as into any other. Every view's borders lie where what is seen
// through it ends, so that it is as sharp as the picture and none of it is drawn in vain.
#include "water/surface/surface_views.h"

#include <cmath>
#include <optional>
#include <span>

namespace shoal::water {
namespace {

constexpr int kColumns = 17, kRows = 33;       // rays of the picture that a view is laid out for
constexpr float kWidestTangent = 3;            // of a view, off its axis
constexpr float kFinest = 1.5f;                // pixels of a view to one of the picture, along an axis
constexpr float kDeepest = 8;                  // metres under the surface that the view along bent rays is laid out for
constexpr float kWiden = 1.15f;                // of an orthographic view, beyond the picture's borders
constexpr float kNearly = 0.05f;               // of its length, by which a ray may miss the water
constexpr float kMostIncidence = radians(54);  // that the view along bent rays is laid out about: beyond, its eye would
                                               // stand so far off that what is near is small
constexpr float kLeastSlope = 0.003f;          // downwards, of the rays that it is laid out for

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
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i < kColumns; ++i)
            f(rayAt(view, 2.0f * float(i) / float(kColumns - 1) - 1, 2.0f * float(j) / float(kRows - 1) - 1));
}

int scaled(int size, float scale) { return std::max(int(std::lround(float(size) * scale)), 8); }

// A view that holds all the directions (from its eye), turned like `axes`: its borders lie a tangent of `margin` beyond
// them. Its size is that of `like` times `scale`, whatever it holds: targets stay as they are. finest: its pixels a
// tangent to those of `like`, at most.
std::optional<light::View> viewOf(const Mat4& axes, std::span<const Vec3> directions, const light::View& like,
                                  float scale, float margin, float finest = kFinest) {
    if (directions.empty()) return std::nullopt;
    Vec2 lo{kWidestTangent, kWidestTangent}, hi = lo * -1.0f;
    for (const Vec3& d : directions) {
        const float ahead = std::max(-dot(d, column(axes, 2)), 1e-3f * length(d));
        const Vec2 t{std::clamp(dot(d, column(axes, 0)) / ahead, -kWidestTangent, kWidestTangent),
                     std::clamp(dot(d, column(axes, 1)) / ahead, -kWidestTangent, kWidestTangent)};
        lo = {std::min(lo.x, t.x), std::min(lo.y, t.y)};
        hi = {std::max(hi.x, t.x), std::max(hi.y, t.y)};
    }
    const int width = scaled(like.width, scale), height = scaled(like.height, scale);
    const auto grown = [&](float span, int pixels, float likePixels) {
        return std::max(span + 2 * margin, float(pixels) / (finest * likePixels));
    };
    const Vec2 span{grown(hi.x - lo.x, width, 0.5f * float(like.width) * std::abs(like.clipFromView(0, 0))),
                    grown(hi.y - lo.y, height, 0.5f * float(like.height) * std::abs(like.clipFromView(1, 1)))};
    light::Intrinsics intrinsics;
    intrinsics.widthPx = float(width), intrinsics.heightPx = float(height);
    intrinsics.fx = intrinsics.widthPx / span.x, intrinsics.fy = intrinsics.heightPx / span.y;
    intrinsics.cx = (0.5f * (span.x - lo.x - hi.x)) * intrinsics.fx;
    intrinsics.cy = (0.5f * (span.y + lo.y + hi.y)) * intrinsics.fy;
    light::Camera camera;
    camera.worldFromView = axes;
    camera.nearZ = like.nearZ;
    camera.intrinsics = intrinsics;
    return light::makeView(camera, width, height);
}

Mat4 axesOf(Vec3 right, Vec3 up, Vec3 back, Vec3 eye) {
    Mat4 axes;
    setColumn(axes, 0, right), setColumn(axes, 1, up), setColumn(axes, 2, back), setColumn(axes, 3, eye);
    return axes;
}

// The picture's eye mirrored at the level. looksUp: of the picture's rays, those that meet the surface.
std::optional<light::View> mirroredView(const light::View& view, float level, bool looksUp, float scale, float margin) {
    const auto turned = [](Vec3 v) { return Vec3{v.x, -v.y, v.z}; };
    const Vec3 up = turned(column(view.worldFromView, 1)), back = turned(column(view.worldFromView, 2));
    const Mat4 axes = axesOf(cross(up, back), up, back, {view.eye.x, 2 * level - view.eye.y, view.eye.z});
    if (!view.orthographic) {
        std::vector<Vec3> directions;
        forRays(view, [&](const Ray& ray) {
            if (looksUp == (ray.direction.y > 0)) directions.push_back(turned(ray.direction));
        });
        return viewOf(axes, directions, view, scale, margin);
    }
    light::View out = view;
    out.eye = column(axes, 3);
    out.worldFromView = axes;
    out.viewFromWorld = inverse(out.worldFromView).value_or(view.viewFromWorld);
    for (int i = 0; i < 4; ++i) {
        out.clipFromView(0, i) *= -1 / kWiden;  // what is off the middle to the right is so to the left
        out.clipFromView(1, i) *= 1 / kWiden;
    }
    out.viewFromClip = inverse(out.clipFromView).value_or(view.viewFromClip);
    out.width = scaled(view.width, scale), out.height = scaled(view.height, scale);
    return out;
}

// From the surface above the eye: all that the picture sees through the window upwards. Nothing where it sees none.
std::optional<light::View> windowView(const light::View& view, const Body& body, float scale, float margin) {
    const float index = body.optics.index;
    std::vector<Vec3> directions;
    Vec3 sum{};
    forRays(view, [&](const Ray& ray) {
        const Vec3 d = ray.direction;
        const float horizontal2 = (d.x * d.x + d.z * d.z) * index * index;
        if (d.y <= 0 || horizontal2 > 1.2f) return;  // just outside the rim counts: waves tilt it
        const float shrink = horizontal2 > 0.98f ? std::sqrt(0.98f / horizontal2) : 1.0f;
        directions.push_back({d.x * index * shrink, std::sqrt(1 - std::min(horizontal2, 0.98f)), d.z * index * shrink});
        sum += directions.back();
    });
    if (directions.empty()) return std::nullopt;
    const Vec3 eye{view.eye.x, body.params.level, view.eye.z};
    const light::Camera camera = light::cameraLookingAt(eye, eye + normalize(sum), 1);
    return viewOf(camera.worldFromView, directions, view, scale, margin);
}

// Whether a ray from above meets the water, or nearly.
bool meetsWater(const Ray& ray, const Body& body) {
    if (ray.direction.y > -kLeastSlope) return false;
    const float along = std::max(ray.origin.y - body.params.level, 0.0f) / -ray.direction.y, slack = kNearly * along;
    const Vec3 p = ray.origin + ray.direction * along;
    const Vec2 lo = body.params.areaMin, hi = body.params.areaMax;
    return p.x > lo.x - slack && p.z > lo.y - slack && p.x < hi.x + slack && p.z < hi.y + slack;
}

// The mean angle of incidence of the picture's rays on the water, radians; nothing where none meets it.
std::optional<float> meanIncidence(const light::View& view, const Body& body) {
    float sum = 0;
    int count = 0;
    forRays(view, [&](const Ray& ray) {
        if (!meetsWater(ray, body)) return;
        sum += std::acos(std::min(-ray.direction.y, 1.0f)), ++count;
    });
    if (count == 0) return std::nullopt;
    return sum / float(count);
}

// From where an eye above the water seems to stand, seen along bent rays: neighbours of the ray at the mean angle meet
// there when they are prolonged (its tangential focus, n h (cos t / cos i)^3 above the water and on the prolonged ray).
std::optional<light::View> bentView(const light::View& view, const Body& body, float depth, float scale, float margin) {
    const std::optional<float> mean = meanIncidence(view, body);
    if (view.orthographic || !mean) return std::nullopt;
    const float index = body.optics.index, level = body.params.level;
    const float height = std::max(view.eye.y - level, view.nearZ);
    const float incidence = std::min(*mean, kMostIncidence), refracted = std::asin(std::sin(incidence) / index);
    const float up = index * height * std::pow(std::cos(refracted) / std::cos(incidence), 3.0f);
    const float ahead = height * std::tan(incidence) - up * std::tan(refracted);
    const Vec3 right = column(view.worldFromView, 0), forward = column(view.worldFromView, 2) * -1.0f;
    const float levelled = std::max(std::hypot(forward.x, forward.z), 1e-3f);
    const Vec3 eye{view.eye.x + forward.x / levelled * ahead, level + up, view.eye.z + forward.z / levelled * ahead};
    std::vector<Vec3> directions;
    Vec3 sum{};
    float farther = 0;  // than the eye
    forRays(view, [&](const Ray& ray) {
        const Vec3 d = ray.direction;
        if (!meetsWater(ray, body)) return;
        const Vec3 start = Vec3{view.eye.x, level + height, view.eye.z} + d * (-height / d.y);
        const Vec3 bent{d.x / index, -std::sqrt(1 - (1 - d.y * d.y) / (index * index)), d.z / index};
        directions.push_back(normalize(start - eye));
        const Vec3 end = start + bent * (-depth / bent.y);
        directions.push_back(normalize(end - eye));
        sum += directions.back();
        farther += length(end - eye) / length(end - view.eye);
    });
    farther /= 0.5f * float(directions.size());
    const Vec3 back = normalize(sum) * -1.0f, above = normalize(cross(back, right));
    return viewOf(axesOf(cross(above, back), above, back, eye), directions, view, scale, margin / farther,
                  kFinest * farther);
}

// Whether pixels may begin above the waves, at the eye's place.
bool beginsInAir(const light::View& view, const Body& body) {
    const double h = body.waves ? body.waves->at(double(view.eye.x), double(view.eye.z)).h : 0.0;
    float highest = view.eye.y;
    for (const Vec2 corner : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{1, 1}}) {
        const Vec3 p = transformPoint(view.viewFromClip, {corner.x, corner.y, 1});
        highest = std::max(highest, transformPoint(view.worldFromView, p).y);
    }
    return double(highest) > double(body.params.level) + h;
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
    const bool airy = above || (crossing && beginsInAir(view, body));
    bool looksDown = false, looksUp = false;
    forRays(view, [&](const Ray& ray) { (ray.direction.y < 0 ? looksDown : looksUp) = true; });
    // Things that stand in a wave's trough are mirrored too.
    const float slack = std::min(0.25f * height, 0.1f);
    const float scale = params.reflectionScale, fineScale = std::min(2 * scale, 1.0f);
    const float slope = body.waves ? float(body.waves->bounds().slope) : 0.0f;
    // Waves tilt rays by twice their slope in the mirror; from below, all of it is seen.
    const float margin = std::clamp(0.5f * slope, 0.04f, 0.2f), wide = std::clamp(0.75f * slope, 0.04f, 0.35f);
    const auto add = [&](std::optional<light::View> seen, Mirror shows) {
        if (!seen) return;
        const bool under = shows != kAirMirror;
        const Vec4 plane = under ? Vec4{0, -1, 0, level + slack} : Vec4{0, 1, 0, slack - level};
        chosen.push_back({{*seen, plane, under}, shows});
    };
    // An eye in a trough: mirrored at its own height.
    if (sceneBounds.hi.y > level && (!airy || looksDown))
        add(airy ? mirroredView(view, std::min(level, view.eye.y), false, scale, margin)
                 : windowView(view, body, scale, margin),
            kAirMirror);
    const float depth = std::min(level - sceneBounds.lo.y, kDeepest);
    if (depth > 0 && looksDown && (above || crossing))
        add(bentView(view, body, depth, fineScale, 0.5f * margin), kBentView);
    if (depth > 0 && looksUp && (!above || crossing))
        // An eye under a crest above the level: mirrored at its own height, not under what it sees.
        add(mirroredView(view, std::max(level, view.eye.y), true, fineScale, wide), kWaterMirror);
    return chosen;
}

}  // namespace shoal::water
