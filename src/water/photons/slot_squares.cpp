#include "water/photons/slot_squares.h"

#include <algorithm>

namespace shoal::water {
namespace {

constexpr int kRays = 9;  // a side of the grid of sight rays

double powerBelow(double x) { return std::exp2(std::floor(std::log2(std::max(x, 1e-6)) + 1e-4)); }
double powerAbove(double x) { return std::exp2(std::ceil(std::log2(std::max(x, 1e-6)) - 1e-4)); }

// Clips origin + t direction to a slab of one axis.
void clip(double origin, double direction, double lo, double hi, double& t0, double& t1) {
    if (std::abs(direction) < 1e-9) {
        if (origin < lo || origin > hi) t1 = t0 - 1;
        return;
    }
    const double a = (lo - origin) / direction, b = (hi - origin) / direction;
    t0 = std::max(t0, std::min(a, b)), t1 = std::min(t1, std::max(a, b));
}

struct SightRay {
    Vec3 origin, direction;  // direction: one metre of view depth
};
SightRay sightRay(const light::View& eye, float x, float y) {
    const Vec3 p = transformPoint(eye.viewFromClip, {x, y, 1});
    SightRay ray;
    ray.origin = eye.orthographic ? transformPoint(eye.worldFromView, {p.x, p.y, 0}) : eye.eye;
    ray.direction = transformDirection(eye.worldFromView, eye.orthographic ? Vec3{0, 0, -1} : p * (-1 / p.z));
    return ray;
}

Square boxInLightSpace(const Side& side, const Bounds& box) {
    Vec2 lo{1e30f, 1e30f}, hi{-1e30f, -1e30f};
    for (int i = 0; i < 8; ++i) {
        const Vec2 s =
            side.slide({(i & 1) ? box.hi.x : box.lo.x, (i & 2) ? box.hi.y : box.lo.y, (i & 4) ? box.hi.z : box.lo.z});
        lo = {std::min(lo.x, s.x), std::min(lo.y, s.y)};
        hi = {std::max(hi.x, s.x), std::max(hi.y, s.y)};
    }
    return {0.5 * (double(lo.x) + double(hi.x)), 0.5 * (double(lo.y) + double(hi.y)),
            double(std::max(hi.x - lo.x, hi.y - lo.y))};
}

}  // namespace

Seen whatIsSeen(const light::View& eye, const Side& side, const Bounds& box, double distance) {
    Seen seen;
    for (int j = 0; j < kRays; ++j)
        for (int i = 0; i < kRays; ++i) {
            const SightRay ray = sightRay(eye, 2 * float(i) / (kRays - 1) - 1, 2 * float(j) / (kRays - 1) - 1);
            double t0 = eye.nearZ, t1 = eye.orthographic ? 1e9 : distance;
            // A flat scene is a little thick, or no ray would be in it.
            constexpr double kThick = 1e-3;
            clip(ray.origin.x, ray.direction.x, box.lo.x - kThick, box.hi.x + kThick, t0, t1);
            clip(ray.origin.y, ray.direction.y, box.lo.y - kThick, box.hi.y + kThick, t0, t1);
            clip(ray.origin.z, ray.direction.z, box.lo.z - kThick, box.hi.z + kThick, t0, t1);
            if (t0 > t1) continue;
            seen.nearest = std::min(seen.nearest, t0), seen.farthest = std::max(seen.farthest, t1);
            for (const double t : {t0, t1}) {
                Vec3 p = ray.origin + ray.direction * float(t);
                p = max(box.lo, min(box.hi, p));
                const Vec2 s = side.slide(p);
                seen.lo = {std::min(seen.lo.x, s.x), std::min(seen.lo.y, s.y)};
                seen.hi = {std::max(seen.hi.x, s.x), std::max(seen.hi.y, s.y)};
            }
        }
    return seen;
}

std::vector<Square> sunSquares(const light::View& eye, const Side& side, const Bounds& box, double distance,
                               int cascades) {
    const Seen seen = whatIsSeen(eye, side, box, distance);
    if (!seen.any()) return {};
    const Square scene = boxInLightSpace(side, box);
    if (eye.orthographic) {
        const double extent = double(std::max(seen.hi.x - seen.lo.x, seen.hi.y - seen.lo.y));
        return {{0.5 * (double(seen.lo.x) + double(seen.hi.x)), 0.5 * (double(seen.lo.y) + double(seen.hi.y)),
                 powerAbove(extent)}};
    }

    // Widest angle from the view's axis, as a tangent, and where the view's axis points.
    const SightRay corner = sightRay(eye, 1, 1), axis = sightRay(eye, 0, 0);
    const double tangent = double(length(corner.direction - axis.direction));
    const double to = std::min(distance, steppedUp(seen.farthest));
    const double from = std::clamp(powerBelow(seen.nearest), to / 16, to);
    const double whole = powerAbove(scene.side);
    std::vector<Square> squares;
    for (int k = 0; k < cascades; ++k) {
        const bool last = k == cascades - 1;
        const double begin = from * std::pow(to / from, double(k) / cascades);
        const double end = from * std::pow(to / from, double(k + 1) / cascades);
        const double spread = std::max(2 * end * tangent, end - (k == 0 ? 0 : begin));
        const double side2 = std::min(last ? powerAbove(spread) : powerBelow(spread), whole);
        const Vec3 middle = axis.origin + axis.direction * float(0.5 * ((k == 0 ? 0 : begin) + end));
        const Vec2 s = side.slide(max(box.lo, min(box.hi, middle)));
        // Not beyond the scene: what is there is seen from nowhere.
        const double room = std::max(0.5 * (scene.side - side2), 0.0);
        Square square{std::clamp(double(s.x), scene.x - room, scene.x + room),
                      std::clamp(double(s.y), scene.z - room, scene.z + room), side2};
        if (!squares.empty() && squares.back().side >= side2) squares.pop_back();
        squares.push_back(square);
    }
    // A map between two that are four times apart or less costs more than it shows.
    for (std::size_t k = 1; k + 1 < squares.size();)
        if (squares[k + 1].side <= 4 * squares[k - 1].side)
            squares.erase(squares.begin() + std::ptrdiff_t(k));
        else
            ++k;
    // No step wider than four, so that sharpness fades.
    for (std::size_t k = squares.size() - 1; k-- > 0;)
        squares[k].side = std::max(squares[k].side, squares[k + 1].side / 4);
    return squares;
}

Square lampSquare(const light::PunctualLight& light, double height, double distance) {
    double radius = 4 * height;
    Vec2 lo{light.position.x - float(radius), light.position.z - float(radius)};
    Vec2 hi{light.position.x + float(radius), light.position.z + float(radius)};
    if (light.kind == light::PunctualLight::Kind::spot) {
        const Vec3 axis = normalize(light.direction);
        const Vec3 u = normalize(std::abs(axis.y) < 0.9f ? cross(axis, {0, 1, 0}) : cross(axis, {1, 0, 0}));
        const Vec3 v = cross(axis, u);
        Vec2 coneLo{1e30f, 1e30f}, coneHi{-1e30f, -1e30f};
        const float across = std::sin(light.outerCone), along = std::cos(light.outerCone);
        for (int i = 0; i < 33; ++i) {
            const float angle = 2 * kPi * float(i) / 32;
            const Vec3 d = i == 32 ? axis : axis * along + (u * std::cos(angle) + v * std::sin(angle)) * across;
            const float flat = std::max(-d.y, 0.05f);
            const Vec2 s{light.position.x + d.x * float(height) / flat, light.position.z + d.z * float(height) / flat};
            coneLo = {std::min(coneLo.x, s.x), std::min(coneLo.y, s.y)};
            coneHi = {std::max(coneHi.x, s.x), std::max(coneHi.y, s.y)};
        }
        const float reach = float(6 * height);
        lo = {std::max(coneLo.x, light.position.x - reach), std::max(coneLo.y, light.position.z - reach)};
        hi = {std::min(coneHi.x, light.position.x + reach), std::min(coneHi.y, light.position.z + reach)};
    }
    if (light.range > 0) {
        const float reach = float(std::sqrt(std::max(double(light.range) * light.range - height * height, 1e-4)));
        lo = {std::max(lo.x, light.position.x - reach), std::max(lo.y, light.position.z - reach)};
        hi = {std::min(hi.x, light.position.x + reach), std::min(hi.y, light.position.z + reach)};
    }
    const double side = std::clamp(double(std::max(hi.x - lo.x, hi.y - lo.y)), 0.1, 2 * distance);
    return {0.5 * (double(lo.x) + double(hi.x)), 0.5 * (double(lo.y) + double(hi.y)), powerAbove(side)};
}

}  // namespace shoal::water
