// Squares become slots: corners at multiples of texels in the world, heights in steps, and the matrices of both.
#include "water/photons/slot_fit.h"

#include <algorithm>
#include <cmath>

#include "water/photons/slot_squares.h"

namespace shoal::water {
namespace {

constexpr double kLowestSun = 0.01;         // toSun.y below which the sun is taken as set
constexpr double kLeastLampHeightM = 0.05;  // above the level
constexpr double kSteepest = 0.7;           // slope that margins are made for: rarer ones may lose light at the rim
constexpr double kMostMargin = 0.25;        // of a square's side
constexpr double kGapM = 0.02;              // between the first layer and the second
constexpr int kSnapTexels = 8;

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
