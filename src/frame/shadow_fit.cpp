// Cascaded shadow maps [Engel 2006; Zhang et al. 2006 for the splits], stable by spheres and texel steps [Valient
// 2009]. Departures: steps are a sixteenth of a map rather than one texel (more frames find a cascade unchanged), and
// sizes follow the scene's bounds where those are smaller than the view.
#include "frame/shadow_fit.h"

#include <cmath>

namespace shoal::frame {
namespace {

constexpr int kStepsPerMap = 16;        // a cascade moves by this fraction of its width
constexpr double kFadeFraction = 0.1;   // part of a slice in which it turns into the next one
constexpr double kNearestSplit = 0.01;  // slices begin at this fraction of the covered distance, not at the near plane
constexpr double kWholeSceneGain =
    1.4;  // a map of all the scene replaces several when its texels are at most this much larger
constexpr int kFilterMarginTexels = 12;  // the widest filter of shadow.io.glsl and its bilinear footprint

struct Vec3d {
    double x = 0, y = 0, z = 0;
};
double dot(Vec3d a, Vec3d b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(Vec3d a) { return std::sqrt(dot(a, a)); }
Vec3d wide(Vec3 a) { return {a.x, a.y, a.z}; }
Vec3d cross(Vec3d a, Vec3d b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
Vec3d unit(Vec3d a) {
    const double l = length(a);
    return {a.x / l, a.y / l, a.z / l};
}

struct SunAxes {
    Vec3d right, up, toSun;
    Vec3d project(Vec3d p) const { return {dot(right, p), dot(up, p), dot(toSun, p)}; }
};

SunAxes sunAxes(Vec3 toSun) {
    SunAxes axes;
    axes.toSun = unit(wide(toSun));
    const Vec3d up = std::abs(axes.toSun.y) < 0.99 ? Vec3d{0, 1, 0} : Vec3d{0, 0, -1};
    axes.right = unit(cross(up, axes.toSun));
    axes.up = cross(axes.toSun, axes.right);
    return axes;
}

double roundedDown(double x) { return x < 1e-3 ? 0 : std::exp2(std::floor(std::log2(x) * 4 + 1e-6) / 4); }

struct SceneBox {
    Vec3d lo{1e30, 1e30, 1e30}, hi{-1e30, -1e30, -1e30};
    void add(Vec3d p) {
        lo = {std::min(lo.x, p.x), std::min(lo.y, p.y), std::min(lo.z, p.z)};
        hi = {std::max(hi.x, p.x), std::max(hi.y, p.y), std::max(hi.z, p.z)};
    }
};

Vec3 cornerOf(const Bounds& b, int i) {
    return {(i & 1) ? b.hi.x : b.lo.x, (i & 2) ? b.hi.y : b.lo.y, (i & 4) ? b.hi.z : b.lo.z};
}

// The four edges of the view's frustum: points at view depth d are origin + d * direction (view space).
struct FrustumEdges {
    Vec3d origin[4], direction[4];
    Vec3d at(int i, double d) const { return {origin[i].x + d * direction[i].x, origin[i].y + d * direction[i].y, -d}; }
};

FrustumEdges frustumEdges(const light::View& view) {
    FrustumEdges edges;
    for (int i = 0; i < 4; ++i) {
        const Vec3 p = transformPoint(view.viewFromClip, {(i & 1) ? 1.0f : -1.0f, (i & 2) ? 1.0f : -1.0f, 1.0f});
        if (view.orthographic)
            edges.origin[i] = {p.x, p.y, 0};
        else
            edges.direction[i] = {p.x / -double(p.z), p.y / -double(p.z), -1};
    }
    return edges;
}

struct Sphere {
    Vec3d center;  // world
    double radius = 0;
};

// Bounds the slice of the view between two depths. The centre lies on the frustum's mean axis where near and far
// corners are equally far from it, but not beyond the far plane.
Sphere sliceSphere(const light::View& view, const FrustumEdges& edges, double from, double to) {
    auto meanAt = [&](double d) {
        Vec3d mean;
        for (int i = 0; i < 4; ++i) {
            const Vec3d p = edges.at(i, d);
            mean = {mean.x + p.x / 4, mean.y + p.y / 4, -d};
        }
        return mean;
    };
    double spread = 0;  // squared, of the corners around the mean axis at unit depth
    if (!view.orthographic) {
        const Vec3d mean = meanAt(1);
        for (int i = 0; i < 4; ++i) {
            const Vec3d p = edges.at(i, 1);
            spread = std::max(spread, (p.x - mean.x) * (p.x - mean.x) + (p.y - mean.y) * (p.y - mean.y));
        }
    }
    const Vec3d center = meanAt(std::min(to, 0.5 * (from + to) * (1 + spread)));
    Sphere sphere;
    for (int i = 0; i < 4; ++i)
        for (const double d : {from, to}) {
            const Vec3d p = edges.at(i, d);
            sphere.radius = std::max(sphere.radius, length({p.x - center.x, p.y - center.y, p.z - center.z}));
        }
    const Mat4& m = view.worldFromView;
    sphere.center = {m(0, 0) * center.x + m(0, 1) * center.y + m(0, 2) * center.z + m(0, 3),
                     m(1, 0) * center.x + m(1, 1) * center.y + m(1, 2) * center.z + m(1, 3),
                     m(2, 0) * center.x + m(2, 1) * center.y + m(2, 2) * center.z + m(2, 3)};
    return sphere;
}

// Where slices end, metres of view depth [Zhang et al. 2006].
std::array<double, kMaxCascades + 1> splitDepths(double from, double to, int count, double blend) {
    std::array<double, kMaxCascades + 1> ends{};
    const double logFrom = std::max(from, kNearestSplit * to);
    for (int i = 0; i <= count; ++i) {
        const double t = double(i) / count;
        ends[i] = blend * logFrom * std::pow(to / logFrom, t) + (1 - blend) * (from + (to - from) * t);
    }
    ends[0] = from;
    return ends;
}

light::View cascadeView(const SunAxes& axes, Vec2 center, double halfExtent, double top, double range, int resolution) {
    light::View view;
    view.width = view.height = resolution;
    Mat4& m = view.viewFromWorld;
    const Vec3d rows[3] = {axes.right, axes.up, axes.toSun};
    const double shift[3] = {-center.x, -center.y, -top};
    for (int r = 0; r < 3; ++r)
        m(r, 0) = float(rows[r].x), m(r, 1) = float(rows[r].y), m(r, 2) = float(rows[r].z), m(r, 3) = float(shift[r]);
    view.worldFromView = inverse(m).value_or(Mat4{});
    const float h = float(halfExtent);
    view.clipFromView = orthographicReversed(-h, h, -h, h, 0, float(range));
    view.viewFromClip = inverse(view.clipFromView).value_or(Mat4{});
    view.eye = transformPoint(view.worldFromView, {0, 0, 0});
    view.nearZ = 0;
    view.orthographic = true;
    return view;
}

}  // namespace

double roundedUp(double size) { return std::exp2(std::ceil(std::log2(std::max(size, 1e-3)) * 4 - 1e-6) / 4); }

CascadeFit fitCascades(const light::View& view, Vec3 toSun, const Bounds& bounds, const CascadeFitSetup& setup) {
    const SunAxes axes = sunAxes(toSun);
    SceneBox inSun;
    double nearest = 1e30, farthest = 0;
    for (int i = 0; i < 8; ++i) {
        const Vec3 corner = cornerOf(bounds, i);
        inSun.add(axes.project(wide(corner)));
        const double depth = -transformPoint(view.viewFromWorld, corner).z;
        nearest = std::min(nearest, depth), farthest = std::max(farthest, depth);
    }

    CascadeFit fit;
    // Depth is shared and changes in coarse steps, so that a character's swinging arm redraws nothing but itself.
    const double depthStep = roundedUp(inSun.hi.z - inSun.lo.z) / 16;
    const double bottom = (std::floor(inSun.lo.z / depthStep) - 0.5) * depthStep;
    const double top = (std::ceil(inSun.hi.z / depthStep) + 0.5) * depthStep;
    const double range = top - bottom;
    fit.depthRangeM = float(range);
    const Vec3d rows[3] = {axes.right, axes.up, axes.toSun};
    for (int r = 0; r < 3; ++r) {
        const double scale = r == 2 ? 1 / range : 1;
        fit.sunFromWorld(r, 0) = float(rows[r].x * scale), fit.sunFromWorld(r, 1) = float(rows[r].y * scale);
        fit.sunFromWorld(r, 2) = float(rows[r].z * scale),
                            fit.sunFromWorld(r, 3) = r == 2 ? float(-bottom * scale) : 0.0f;
    }

    // In steps of a quarter octave, hence seldom another size while the eye moves.
    const double to = std::min(double(setup.sunDistance), roundedUp(std::max(farthest, double(view.nearZ) * 2)));
    const double from = std::min(roundedDown(nearest), 0.9 * to);
    const FrustumEdges edges = frustumEdges(view);
    const auto ends = splitDepths(from, to, setup.cascadeCount, setup.splitBlend);
    const double paddedShare = (1 - 1.0 / kStepsPerMap) * (1 - 2.0 * kFilterMarginTexels / setup.resolution);
    const double sceneHalf = roundedUp(0.5 * std::max(inSun.hi.x - inSun.lo.x, inSun.hi.y - inSun.lo.y)) / paddedShare;

    for (int i = 0; i < setup.cascadeCount; ++i) {
        Cascade& cascade = fit.cascades[fit.count++];
        const Sphere sphere =
            sliceSphere(view, edges, i == 0 ? from : ends[i] - kFadeFraction * (ends[i] - ends[i - 1]), ends[i + 1]);
        const double sphereHalf = sphere.radius / paddedShare;
        const bool wholeScene = sceneHalf <= kWholeSceneGain * sphereHalf;
        const double half = wholeScene ? sceneHalf : sphereHalf;
        Vec3d center = axes.project(sphere.center);
        if (wholeScene) center = {0.5 * (inSun.lo.x + inSun.hi.x), 0.5 * (inSun.lo.y + inSun.hi.y), 0};
        const double step = 2 * half / kStepsPerMap;
        cascade.center = {float(std::round(center.x / step) * step), float(std::round(center.y / step) * step)};
        cascade.halfExtent = float(half);
        cascade.metresPerTexel = float(2 * half / setup.resolution);
        // A map of the whole scene serves every depth that the sun's distance allows.
        cascade.endDepth = float(wholeScene ? double(setup.sunDistance) : ends[i + 1]);
        cascade.fadeDepth = float(cascade.endDepth - kFadeFraction * (ends[i + 1] - ends[i]));
        cascade.view = cascadeView(axes, cascade.center, half, top, range, setup.resolution);
        if (wholeScene) break;
    }
    return fit;
}

light::View spotView(const light::PunctualLight& light, int resolution) {
    constexpr float kWidest = radians(85);  // half angle: a perspective view cannot hold a hemisphere
    constexpr float kMarginShare = 4;       // texels beyond the cone on each side, for the filter
    const float half = std::min(light.outerCone, kWidest);
    const float tangent = std::tan(half) * (1 + 2 * kMarginShare / float(resolution));
    light::View view;
    view.width = view.height = resolution;
    view.viewFromWorld = lookAt(light.position, light.position + light.direction, {0, 1, 0});
    view.worldFromView = inverse(view.viewFromWorld).value_or(Mat4{});
    view.nearZ = std::max(light.radius, 0.02f);
    view.clipFromView = perspectiveReversed(2 * std::atan(tangent), 1, view.nearZ);
    view.viewFromClip = inverse(view.clipFromView).value_or(Mat4{});
    view.eye = light.position;
    return view;
}

}  // namespace shoal::frame
