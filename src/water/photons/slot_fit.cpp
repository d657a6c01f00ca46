// Squares of light space follow what the eye sees in steps: their texels are powers of two of a metre, their corners
// multiples of texels, their sizes depend on distances and on the scene, not on where the eye stands. So a moving eye
// sees one and the same pattern of light.
#include "water/photons/slot_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shoal::water {
namespace {

constexpr double kLowestSun = 0.01;         // toSun.y below which the sun is taken as set
constexpr double kLeastLampHeightM = 0.05;  // above the level
constexpr double kSteepest = 0.7;           // slope that margins are made for: rarer ones may lose light at the rim
constexpr double kMostMargin = 0.25;        // of a square's side
constexpr double kGapM = 0.02;              // between the first layer and the second
constexpr int kRays = 9;                    // a side of the grid of sight rays
constexpr int kSnapTexels = 8;

struct Square {
    double x = 0, z = 0, side = 0;  // middle
};

// Grows with x in quarter octaves.
double steppedUp(double x) { return std::exp2(std::ceil(std::log2(std::max(x, 1e-3)) * 4 - 1e-6) / 4); }
double powerBelow(double x) { return std::exp2(std::floor(std::log2(std::max(x, 1e-6)) + 1e-4)); }
double powerAbove(double x) { return std::exp2(std::ceil(std::log2(std::max(x, 1e-6)) - 1e-4)); }

// One side of the surface for one light. Heights count along the light's way ("travel"): e = side * y.
struct Side {
    int light = -1;
    bool up = false;
    bool lamp = false;
    Vec3 toLight;   // unit, or the lamp's place
    Vec3 apparent;  // unit towards the apparent light, or its apparent place
    Vec2 mean;      // metres along x, z a metre of travel
    double cosMean = 1;
    double level = 0, top = 0, bottom = 0;
    double sign() const { return up ? 1 : -1; }
    double nearY() const { return up ? bottom : top; }
    double farY() const { return up ? top : bottom; }

    Vec2 slide(Vec3 p) const {
        if (!lamp) {
            const float travel = float(sign() * (double(p.y) - level));
            return {p.x - mean.x * travel, p.z - mean.y * travel};
        }
        const float scale = float((level - double(apparent.y)) / (double(p.y) - double(apparent.y)));
        return {apparent.x + (p.x - apparent.x) * scale, apparent.z + (p.z - apparent.z) * scale};
    }
};

// What the eye sees of the scene between two heights: its extent in light space and how far away it is.
struct Seen {
    double nearest = 1e30, farthest = 0;  // metres of view depth
    Vec2 lo{1e30f, 1e30f}, hi{-1e30f, -1e30f};
    bool any() const { return farthest > 0; }
};

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

// The finest first; the last holds all that is seen.
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

// Where the lamp's light meets the level, as far as it matters.
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

// Where light travels behind a plane of slope (gx, gz); d unit, downwards. Metres along x, z a metre of height.
Vec2 driftOf(Vec3 d, double gx, double gz, double index, bool up) {
    const double slant = std::sqrt(1 + gx * gx + gz * gz);
    const double cosIn = (double(d.x) * gx + double(d.z) * gz - double(d.y)) / slant;
    if (cosIn <= 0) return {};
    const double cosOut = std::sqrt(1 - (1 - cosIn * cosIn) / (index * index));
    const double bend = (up ? 2 * cosIn : cosIn / index - cosOut) / slant, scale = up ? 1 : 1 / index;
    const double x = double(d.x) * scale - bend * gx, y = double(d.y) * scale + bend,
                 z = double(d.z) * scale - bend * gz;
    if ((up ? y : -y) < 0.05) return {};
    return {float(x / std::abs(y)), float(z / std::abs(y))};
}

// Greatest distance that light leaves its mean way by, a metre of height.
double greatestDrift(const Side& side, Vec3 d, double slope, double index) {
    const double g = std::min(slope, kSteepest);
    const Vec2 mean = driftOf(d, 0, 0, index, side.up);
    double most = 0;
    for (int i = 0; i < 16; ++i) {
        const double angle = 2 * kPiD * i / 16;
        const Vec2 drift = driftOf(d, g * std::cos(angle), g * std::sin(angle), index, side.up);
        most = std::max(most, double(length(drift - mean)));
    }
    return most;
}

light::View viewOf(const Mat4& clipFromWorld, Vec2 middle, double startY, bool up, bool lamp, int resolution) {
    light::View view;
    view.width = view.height = resolution;
    // Straight down with x to the right, or straight up with z upwards: neither is a mirror image.
    Mat4& m = view.viewFromWorld;
    const float z = up ? 1.0f : -1.0f;
    m = Mat4{};
    m(1, 1) = 0, m(1, 2) = z, m(2, 1) = -z, m(2, 2) = 0;
    m(0, 3) = -middle.x, m(1, 3) = -z * middle.y, m(2, 3) = z * float(startY);
    view.worldFromView = inverse(m).value_or(Mat4{});
    view.clipFromView = clipFromWorld * view.worldFromView;
    view.viewFromClip = inverse(view.clipFromView).value_or(Mat4{});
    view.eye = {middle.x, float(startY), middle.y};
    view.nearZ = 0;
    view.orthographic = !lamp;
    return view;
}

// clipFromWorld of the square, and how its depth becomes height. nearY is drawn nearest (depth 1), farY has depth 0.
Mat4 lightMatrix(const Side& side, Vec2 mean, Vec3 place, bool up, double nearY, double farY, Vec2 middle, double half,
                 Vec4& height) {
    const double sign = up ? 1 : -1, row = up ? 1 : -1;
    const double en = sign * nearY, ef = sign * farY, inverseHalf = 1 / half;
    double a[4][4] = {};  // rows of clip x, y, z, w over (x, y, z, 1)
    if (!side.lamp) {
        const double m[2] = {double(mean.x) * sign, double(mean.y) * sign};
        const double c[2] = {double(middle.x), double(middle.y)};
        a[0][0] = inverseHalf, a[0][1] = -m[0] * inverseHalf, a[0][3] = (m[0] * side.level - c[0]) * inverseHalf;
        a[1][2] = row * inverseHalf, a[1][1] = -row * m[1] * inverseHalf;
        a[1][3] = row * (m[1] * side.level - c[1]) * inverseHalf;
        a[2][1] = -sign / (ef - en), a[2][3] = ef / (ef - en);
        a[3][3] = 1;
        height = {float(-sign * (ef - en)), float(sign * ef), 0, 1};
    } else {
        // s = A + (P - A) (eLevel - eA) / (e - eA), clip w = e - eA.
        const double ea = sign * double(place.y), el = sign * side.level, g = (en - ea) / (ef - en);
        const double offset[2] = {double(place.x) - double(middle.x), double(place.z) - double(middle.y)};
        const double at[2] = {double(place.x), double(place.z)};
        for (int i = 0; i < 2; ++i) {
            const double s = inverseHalf * (i == 1 ? row : 1);
            a[i][i == 0 ? 0 : 2] = (el - ea) * s;
            a[i][1] = offset[i] * sign * s;
            a[i][3] = (-offset[i] * ea - at[i] * (el - ea)) * s;
        }
        a[2][1] = -g * sign, a[2][3] = g * ef;
        a[3][1] = sign, a[3][3] = -ea;
        height = {float(sign * ea), float(sign * g * ef), 1, float(g)};
    }
    Mat4 out;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) out(r, c) = float(a[r][c]);
    return out;
}

struct Surroundings {
    const LightViewSetup& setup;
    const Body& body;
    const BodyLights& lights;
    double waveHeight = 0, slope = 0;
    double sceneTop = 0;
};

// Irradiance of map value 1, the light's size and a lamp's cone.
void fillLight(const Surroundings& around, const Side& side, LightSlotRecord& r) {
    const double index = double(around.body.optics.index);
    if (!side.lamp) {
        const light::Sun& sun = *around.lights.sun;
        const double cosIn = double(side.toLight.y), disc = std::tan(double(sun.discHalfAngle));
        const double across = side.up ? disc / cosIn : disc / (index * side.cosMean);
        const double along = side.up ? 1 / cosIn : cosIn / (side.cosMean * side.cosMean);
        r.irradiance = {sun.irradiance.x, sun.irradiance.y, sun.irradiance.z, float(across)};
        const float flat = std::hypot(side.toLight.x, side.toLight.z);
        r.disc = {flat > 1e-6f ? side.toLight.x / flat : 1, flat > 1e-6f ? side.toLight.z / flat : 0, float(along), 1};
        r.cone = {0, 1, 1, 0};
        return;
    }
    const light::PunctualLight& lamp = around.lights.punctual[std::size_t(side.light)];
    const double height = double(side.toLight.y) - side.level;
    const double nearest = std::max(height, double(lamp.radius));
    const float unit = float(1 / (nearest * nearest));
    r.irradiance = {lamp.intensity.x * unit, lamp.intensity.y * unit, lamp.intensity.z * unit,
                    float(double(lamp.radius) / (height * (side.up ? 1 : index)))};
    r.disc = {1, 0, 1, 1};
    const Vec3 axis = normalize(lamp.direction);
    r.spot = {axis.x, axis.y, axis.z, lamp.range};
    const bool spot = lamp.kind == light::PunctualLight::Kind::spot;
    const float cosOuter = std::cos(lamp.outerCone);
    const float scale = spot ? 1 / std::max(0.001f, std::cos(lamp.innerCone) - cosOuter) : 0;
    r.cone = {scale, spot ? -cosOuter * scale : 1, 1 / unit, lamp.radius};
}

SlotFit makeSlot(const Surroundings& around, const Side& side, const Square& square, int cascade, int group) {
    const int resolution = around.setup.resolution;
    SlotFit fit;
    LightSlot& slot = fit.slot;
    slot.light = side.light, slot.reflected = side.up, slot.cascade = cascade;
    const double texel = square.side / resolution;
    slot.texel = float(texel);
    const auto corner = [&](double middle) {
        const double step = kSnapTexels * texel, low = middle - 0.5 * square.side;
        return float(std::floor(low / step + 0.5) * step);
    };
    slot.origin = {corner(square.x), corner(square.z)};
    const float lampFlag = side.lamp ? 1.0f : 0.0f;
    slot.source = {side.apparent.x, side.apparent.y, side.apparent.z, lampFlag};
    slot.top = float(side.top), slot.bottom = float(side.bottom);

    const double sign = side.sign(), reach = sign * (side.farY() - side.level) + around.waveHeight;
    const Vec3 d = side.lamp ? Vec3{0, -1, 0} : -side.toLight;
    const double drift = greatestDrift(side, d, around.slope, double(around.body.optics.index));
    const double margin = drift * reach + double(length(side.mean)) * around.waveHeight + 2 * texel;
    const double steps = std::ceil(margin / (kSnapTexels * texel)) * kSnapTexels * texel;
    slot.margin = float(std::min(steps, kMostMargin * square.side));

    LightSlotRecord& r = fit.record;
    r = LightSlotRecord{};
    r.place = {slot.origin.x, slot.origin.y, slot.texel, 1 / slot.texel};
    r.source = slot.source;
    r.toLight = {side.toLight.x, side.toLight.y, side.toLight.z, lampFlag};
    r.mean = {side.mean.x, side.mean.y, float(side.cosMean), float(sign)};
    r.reach = {slot.top, slot.bottom, float(side.level), float(reach)};
    r.rows = {side.up ? 1.0f : -1.0f, side.up ? 0.0f : float(resolution - 1), float(group), slot.margin};
    r.inner = {1, 1, 0, 0};
    fillLight(around, side, r);
    slot.discRadius = float(double(r.irradiance.w) * std::max(sign * (side.farY() - side.level), 0.0));

    const float half = float(0.5 * square.side);
    const Vec2 middle{slot.origin.x + half, slot.origin.y + half};
    const Mat4 lit =
        lightMatrix(side, side.mean, side.apparent, side.up, side.nearY(), side.farY(), middle, double(half), r.height);
    fit.lit = viewOf(lit, middle, side.nearY(), side.up, side.lamp, resolution);
    fit.peelGap = float(kGapM / (side.top - side.bottom));

    // Above the water, down to the lowest trough.
    const double airBottom = side.level - around.waveHeight;
    double airTop = std::max(side.level + steppedUp(std::max(around.sceneTop - side.level, 0.0)), airBottom + 0.1);
    if (side.lamp) airTop = std::min(airTop, double(side.toLight.y) - 0.02 * (double(side.toLight.y) - side.level));
    const Vec2 airMean = side.lamp ? Vec2{} : Vec2{d.x / -d.y, d.z / -d.y};
    fit.airDrawn = around.sceneTop > airBottom && airTop > airBottom;
    if (fit.airDrawn) {
        const Mat4 air =
            lightMatrix(side, airMean, side.toLight, false, airTop, airBottom, middle, double(half), r.airHeight);
        fit.air = viewOf(air, middle, airTop, false, side.lamp, resolution);
    }
    r.flags = {float(slot.light), side.up ? 1.0f : 0.0f, float(cascade), fit.airDrawn ? 1.0f : 0.0f};
    return fit;
}

// The two sides of the surface that a light has, heights apart.
Side sideOf(const Surroundings& around, int light, bool up) {
    Side side;
    side.light = light, side.up = up, side.lamp = light >= 0;
    side.level = double(around.body.params.level);
    const double index = double(around.body.optics.index);
    if (side.lamp) {
        side.toLight = around.lights.punctual[std::size_t(light)].position;
        const double height = std::max(double(side.toLight.y) - side.level, kLeastLampHeightM);
        side.toLight.y = float(side.level + height);
        side.apparent = {side.toLight.x, float(side.level + (up ? -height : height * index)), side.toLight.z};
        return side;
    }
    side.toLight = normalize(around.lights.sun->toSun);
    const Vec3 d = -side.toLight;
    side.mean = driftOf(d, 0, 0, index, up);
    side.cosMean = 1 / std::sqrt(1 + double(dot(side.mean, side.mean)));
    const float c = float(side.cosMean);
    side.apparent = {-side.mean.x * c, up ? -c : c, -side.mean.y * c};
    return side;
}

Bounds cut(Bounds box, const BodyParams& params, double loY, double hiY) {
    box.lo.y = std::max(box.lo.y, float(loY)), box.hi.y = std::min(box.hi.y, float(hiY));
    // What lies far outside of the water gets none of its light.
    const float spread = std::max(box.hi.y - box.lo.y, 0.0f) * 2 + 1;
    box.lo.x = std::max(box.lo.x, params.areaMin.x - spread), box.hi.x = std::min(box.hi.x, params.areaMax.x + spread);
    box.lo.z = std::max(box.lo.z, params.areaMin.y - spread), box.hi.z = std::min(box.hi.z, params.areaMax.y + spread);
    return box;
}

bool empty(const Bounds& b) { return b.lo.x > b.hi.x || b.lo.y > b.hi.y || b.lo.z > b.hi.z; }

}  // namespace

std::vector<SlotFit> fitSlots(const light::View& eye, const LightViewSetup& setup, const LightViewParams& params,
                              const Body& body, const BodyLights& lights, const Bounds& sceneBounds) {
    std::vector<SlotFit> fits;
    if (sceneBounds.empty()) return fits;
    Surroundings around{setup, body, lights};
    if (body.waves) {
        const WaveBounds bounds = body.waves->bounds();
        around.waveHeight = bounds.height, around.slope = bounds.slope;
    }
    around.sceneTop = double(sceneBounds.hi.y);
    const double level = double(body.params.level), crest = level + around.waveHeight,
                 trough = level - around.waveHeight;
    const Bounds below = cut(sceneBounds, body.params, -1e30, crest);
    const Bounds above = cut(sceneBounds, body.params, trough, 1e30);
    int group = 0;
    const auto full = [&] { return int(fits.size()) >= setup.maxSlots; };
    // Heights in coarse steps: what moves does not change the maps' depth all the time.
    const auto setHeights = [&](Side& side) {
        side.top = side.up ? level + steppedUp(double(above.hi.y) - level + 0.05) : crest + 1e-3;
        side.bottom = side.up ? trough - 1e-3 : level - steppedUp(level - double(below.lo.y) + 0.05);
        side.bottom = std::min(side.bottom, side.top - 0.01);
    };
    const auto addAll = [&](const Side& side, std::vector<Square> squares) {
        int cascade = 0;
        for (const Square& square : squares)
            if (!full()) fits.push_back(makeSlot(around, side, square, cascade++, group));
        ++group;
    };
    const bool sunUp = lights.sun && double(normalize(lights.sun->toSun).y) > kLowestSun;
    if (sunUp && !empty(below)) {
        Side side = sideOf(around, -1, false);
        setHeights(side);
        addAll(side, sunSquares(eye, side, below, double(params.distance), params.cascades));
    }
    const auto addLamps = [&](bool up) {
        for (std::size_t i = 0; i < lights.punctual.size() && !full(); ++i) {
            if (double(lights.punctual[i].position.y) <= crest) continue;
            Side side = sideOf(around, int(i), up);
            setHeights(side);
            const double height = double(side.toLight.y) - level;
            // Seen from below the surface must lie under the lamp's apparent place, crests included.
            side.top = up ? side.top : std::min(side.top, double(side.apparent.y) - 0.01);
            if (!whatIsSeen(eye, side, up ? above : below, double(params.distance)).any()) continue;
            addAll(side, {lampSquare(lights.punctual[i], height, double(params.distance))});
        }
    };
    if (!empty(below)) addLamps(false);
    if (!params.reflected || empty(above) || double(above.hi.y) < crest + 1e-3) return fits;
    if (sunUp) {
        Side side = sideOf(around, -1, true);
        setHeights(side);
        // One map: light from below is seen near by (hulls, piers, ceilings).
        std::vector<Square> squares = sunSquares(eye, side, above, double(params.distance) / 2, 2);
        if (!squares.empty()) addAll(side, {squares.front()});
    }
    addLamps(true);
    return fits;
}

}  // namespace shoal::water
