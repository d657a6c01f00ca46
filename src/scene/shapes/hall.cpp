// A storage hall.
#include <algorithm>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr float kRoofPitch = 0.16f, kPanel = 1.0f, kPlinth = 1.0f, kWindow = 1.3f;
constexpr float kGateWidth = 4, kGateHeight = 4.2f;

struct Hall {
    const HallShape& shape;
    ModelBuilder& builder;
    Palette palette;
    int cladding = -1, concreteFloor = -1;
    float halfWidth, halfLength, bay, ridge;
    float frameZ(int i) const { return -halfLength + bay * float(i); }
    float windowTop() const { return shape.height - 0.5f; }
    float windowBottom() const { return std::max(kPlinth + 0.3f, windowTop() - kWindow); }
    float roofY(float x) const { return ridge - (ridge - shape.height) * std::abs(x) / halfWidth; }
};

void addFloor(Hall& hall, Dice& dice) {
    Part& part = hall.builder.part(hall.concreteFloor);
    part.color = {0.35f, 0.35f, 0.34f};
    addStandingBox(part, Frame{}.at({0, -0.25f, 0}), {2 * hall.halfWidth + 0.5f, 0.24f, 2 * hall.halfLength + 0.5f},
                   0.02f);
    const int across = std::max(1, int(std::round(hall.shape.width / 5))),
              along = std::max(1, int(std::round(hall.shape.length / 5)));
    const float w = hall.shape.width / float(across), l = hall.shape.length / float(along);
    for (int i = 0; i < across; ++i)
        for (int k = 0; k < along; ++k) {
            part.color = Vec3{1.0f, 0.99f, 0.96f} * dice.range(0.82f, 1.0f);
            part.uvOffset = {dice.unit(), dice.unit()};
            addSlab(part,
                    Frame{}.at({-hall.halfWidth + w * (float(i) + 0.5f), 0, -hall.halfLength + l * (float(k) + 0.5f)}),
                    w / 2 - 0.005f, l / 2 - 0.005f, 0.006f);
        }
    Part& paint = hall.builder.part(hall.palette.paint);
    paint.color = {0.62f, 0.44f, 0.05f};  // worn yellow lines along the aisle
    for (const float s : {-1.0f, 1.0f})
        addStandingBox(paint, Frame{}.at({s * 1.7f, -0.004f, 0}), {0.1f, 0.007f, 2 * hall.halfLength - 0.6f}, 0);
}

// Three boxes: flange, web, flange. `deep` is the direction of the web's depth.
void addIBeam(Part& part, Vec3 from, Vec3 to, float depth, float width, Vec3 deep) {
    const Vec3 offset = deep * (depth / 2 - 0.008f);
    addBeam(part, from + offset, to + offset, width, 0.016f, 0.003f, deep);
    addBeam(part, from - offset, to - offset, width, 0.016f, 0.003f, deep);
    addBeam(part, from, to, 0.011f, depth - 0.03f, 0, deep);
}

void addFrames(Hall& hall) {
    Part& steel = hall.builder.part(hall.palette.steel);
    Part& concrete = hall.builder.part(hall.palette.concrete);
    for (int i = 0; i <= hall.shape.bays; ++i) {
        const float z = std::clamp(hall.frameZ(i), -hall.halfLength + 0.15f, hall.halfLength - 0.15f),
                    x = hall.halfWidth - 0.2f;
        for (const float s : {-1.0f, 1.0f}) {
            steel.color = {0.13f, 0.22f, 0.26f};
            addIBeam(steel, {s * x, 0.3f, z}, {s * x, hall.shape.height, z}, 0.3f, 0.2f, {1, 0, 0});
            concrete.color = {0.9f, 0.9f, 0.88f};
            addStandingBox(concrete, Frame{}.at({s * x, -0.02f, z}), {0.5f, 0.34f, 0.4f}, 0.02f);
            addStandingBox(steel, Frame{}.at({s * x, 0.32f, z}), {0.38f, 0.025f, 0.3f}, 0.004f);
        }
        if (!hall.shape.roof) continue;
        // Truss: chords, posts and diagonals.
        steel.color = {0.13f, 0.22f, 0.26f};
        const float low = hall.shape.height - 0.45f;
        const int panels = std::max(4, 2 * int(std::round(hall.shape.width / 4)));
        const auto chordX = [&](int k) { return -x + 2 * x * float(k) / float(panels); };
        const auto upper = [&](int k) { return Vec3{chordX(k), hall.roofY(chordX(k)) - 0.22f, z}; };
        addBeam(steel, {-x, low, z}, {x, low, z}, 0.12f, 0.12f, 0.01f);
        addBeam(steel, upper(0), upper(panels / 2), 0.14f, 0.14f, 0.01f);
        addBeam(steel, upper(panels / 2), upper(panels), 0.14f, 0.14f, 0.01f);
        for (int k = 0; k <= panels; ++k) {
            addBeam(steel, {chordX(k), low, z}, upper(k), 0.07f, 0.07f, 0.006f, {0, 0, 1});
            if (k == panels) break;
            const bool left = k < panels / 2;
            const int foot = left ? k + 1 : k, head = left ? k : k + 1;
            addBeam(steel, {chordX(foot), low, z}, upper(head), 0.055f, 0.055f, 0.006f, {0, 0, 1});
        }
    }
}

// One wall of panels from a to b (left to right seen from outside), with a band of windows.
void addSideWall(Hall& hall, Vec3 a, Vec3 b, Vec3 outward, Dice& dice) {
    const Vec3 along = normalize(b - a);
    const float length = shoal::length(b - a), top = hall.shape.height, sill = hall.windowBottom(),
                head = hall.windowTop();
    Part& concrete = hall.builder.part(hall.palette.concrete);
    concrete.color = {0.85f, 0.85f, 0.83f};
    addBeam(concrete, a + Vec3{0, kPlinth / 2, 0}, b + Vec3{0, kPlinth / 2, 0}, 0.22f, kPlinth, 0.015f);
    Part& panels = hall.builder.part(hall.cladding);
    const int count = std::max(1, int(std::round(length / kPanel)));
    const float width = length / float(count);
    const Frame frame{a, along, {0, 1, 0}, outward};
    for (int i = 0; i < count; ++i) {
        const float x = width * (float(i) + 0.5f);
        panels.color = Vec3{0.60f, 0.66f, 0.68f} * dice.range(0.93f, 1.05f);
        addBox(panels, frame.at({x, (kPlinth + sill) / 2, 0}), {width / 2, (sill - kPlinth) / 2, 0.045f}, 0.012f);
        addBox(panels, frame.at({x, (head + top) / 2, 0}), {width / 2, (top - head) / 2, 0.045f}, 0.012f);
        for (const float rib : {-0.25f, 0.0f, 0.25f})  // ribs outside stiffen the sheet
            addBox(panels, frame.at({x + rib * width, (kPlinth + sill) / 2, 0.05f}),
                   {0.035f, (sill - kPlinth) / 2 - 0.01f, 0.02f}, 0.015f);
    }
    Part& steel = hall.builder.part(hall.palette.steel);
    steel.color = {0.75f, 0.76f, 0.76f};
    for (int i = 0; i <= count; ++i) {
        const float x = std::min(length, width * float(i)), wide = i % 3 == 0 ? 0.08f : 0.035f;
        addBox(steel, frame.at({x, (sill + head) / 2, 0}), {wide / 2, (head - sill) / 2, 0.04f}, 0.006f);
    }
    for (const float y : {sill, (sill + head) / 2, head})
        addBeam(steel, a + Vec3{0, y, 0}, b + Vec3{0, y, 0}, 0.09f, 0.045f, 0.006f);
}

// The wall of an end up to the roof's slope, in upright panels; a gate in the middle where `gate`.
void addGable(Hall& hall, float z, bool gate, Dice& dice) {
    const int count = std::max(2, 2 * int(std::round(hall.halfWidth / kPanel)));
    const float width = 2 * hall.halfWidth / float(count);
    Part& panels = hall.builder.part(hall.cladding);
    Part& concrete = hall.builder.part(hall.palette.concrete);
    concrete.color = {0.85f, 0.85f, 0.83f};
    const float gateHeight = std::min(kGateHeight, hall.shape.height - 0.6f);
    for (int i = 0; i < count; ++i) {
        const float x = -hall.halfWidth + width * (float(i) + 0.5f);
        const float top = hall.shape.roof ? hall.roofY(std::abs(x) + width / 2) : hall.shape.height;
        const bool open = gate && std::abs(x) < kGateWidth / 2;
        const float from = open ? gateHeight : kPlinth;
        if (!open) addBox(concrete, Frame{}.at({x, kPlinth / 2, z}), {width / 2, kPlinth / 2, 0.11f}, 0.012f);
        panels.color = Vec3{0.60f, 0.66f, 0.68f} * dice.range(0.93f, 1.05f);
        addBox(panels, Frame{}.at({x, (from + top) / 2, z}), {width / 2, (top - from) / 2, 0.045f}, 0.012f);
    }
    if (hall.shape.roof) {  // boards under the slope close what the panels' level tops leave open
        panels.color = {0.5f, 0.55f, 0.57f};
        for (const float s : {-1.0f, 1.0f})
            addBeam(panels, {s * hall.halfWidth, hall.shape.height - 0.12f, z}, {0, hall.ridge - 0.12f, z}, 0.14f,
                    0.34f, 0.01f);
    }
    if (!gate) return;
    Part& steel = hall.builder.part(hall.palette.steel);
    steel.color = {0.65f, 0.33f, 0.05f};
    const float x = std::ceil(kGateWidth / 2 / width) * width;
    for (const float s : {-1.0f, 1.0f})
        addStandingBox(steel, Frame{}.at({s * (x + 0.02f), 0, z}), {0.16f, gateHeight + 0.1f, 0.26f}, 0.015f);
    addBeam(steel, {-x - 0.1f, gateHeight + 0.06f, z}, {x + 0.1f, gateHeight + 0.06f, z}, 0.26f, 0.16f, 0.015f);
}

void addRoof(Hall& hall, Dice& dice) {
    Part& sheet = hall.builder.part(hall.cladding);
    Part& steel = hall.builder.part(hall.palette.steel);
    const float slope = std::hypot(hall.halfWidth, hall.ridge - hall.shape.height);
    for (const float s : {-1.0f, 1.0f}) {
        const Vec3 eave{s * (hall.halfWidth + 0.25f), hall.roofY(hall.halfWidth + 0.25f), 0}, ridge{0, hall.ridge, 0};
        const Vec3 up = normalize(cross(s > 0 ? Vec3{0, 0, 1} : Vec3{0, 0, -1}, ridge - eave)) * 1.0f;
        const Vec3 normal = up.y > 0 ? up : -up;
        const auto strip = [&](float from, float to, float z, float width) {  // from, to: 0 at the eave, 1 at the ridge
            sheet.color = Vec3{0.50f, 0.51f, 0.52f} * dice.range(0.92f, 1.06f);
            const Vec3 offset = normal * 0.06f + Vec3{0, 0, z};
            addBeam(sheet, lerp(eave, ridge, from) + offset, lerp(eave, ridge, to) + offset, width - 0.008f, 0.06f,
                    0.015f, normal);
        };
        for (int bay = 0; bay < hall.shape.bays; ++bay) {
            const int count = std::max(1, int(std::round(hall.bay / 1.2f)));
            const float width = hall.bay / float(count);
            // Every bay has a band of light in the middle of its slope, framed by bars.
            const bool light = hall.bay > 2;
            for (int i = 0; i < count; ++i) {
                const float z = hall.frameZ(bay) + width * (float(i) + 0.5f);
                const bool open = light && i > 0 && i + 1 < count;
                if (open)
                    strip(0, 0.42f, z, width), strip(0.74f, 1, z, width);
                else
                    strip(0, 1, z, width);
            }
            if (!light || count < 3) continue;
            steel.color = {0.78f, 0.79f, 0.79f};
            const float z0 = hall.frameZ(bay) + width, z1 = hall.frameZ(bay + 1) - width;
            for (const float at : {0.42f, 0.58f, 0.74f}) {
                const Vec3 p = lerp(eave, ridge, at) + normal * 0.07f;
                addBeam(steel, p + Vec3{0, 0, z0}, p + Vec3{0, 0, z1}, 0.07f, 0.09f, 0.008f, normal);
            }
            for (int i = 1; i < count; ++i) {
                const Vec3 offset = normal * 0.07f + Vec3{0, 0, hall.frameZ(bay) + width * float(i)};
                addBeam(steel, lerp(eave, ridge, 0.42f) + offset, lerp(eave, ridge, 0.74f) + offset, 0.05f, 0.08f,
                        0.006f, normal);
            }
        }
        sheet.color = {0.45f, 0.46f, 0.47f};  // the ridge's cap
        const Vec3 cap = normal * 0.1f, down = normalize(eave - ridge) * 0.3f;
        addBeam(sheet, ridge + down * 0.5f + cap + Vec3{0, 0, -hall.halfLength},
                ridge + down * 0.5f + cap + Vec3{0, 0, hall.halfLength}, 0.36f, 0.03f, 0.008f, normal);
        steel.color = {0.13f, 0.22f, 0.26f};  // purlins
        const int purlins = std::max(2, int(slope / 1.6f));
        for (int i = 0; i <= purlins; ++i) {
            const Vec3 p = lerp(eave, ridge, 0.04f + 0.94f * float(i) / float(purlins)) - normal * 0.06f;
            addBeam(steel, p + Vec3{0, 0, -hall.halfLength}, p + Vec3{0, 0, hall.halfLength}, 0.06f, 0.14f, 0.006f,
                    normal);
        }
    }
}

void addPallet(Hall& hall, const Frame& base, Dice& dice) {
    Part& wood = hall.builder.part(hall.palette.wood);
    wood.color = Vec3{1.05f, 0.9f, 0.7f} * woodTint(dice, 0.35f);
    wood.uvOffset = {dice.unit(), dice.unit()};
    for (const float z : {-0.34f, 0.0f, 0.34f}) addStandingBox(wood, base.at({0, 0, z}), {1.16f, 0.1f, 0.1f}, 0.004f);
    for (int i = 0; i < 5; ++i)
        addStandingBox(wood, base.at({-0.52f + 0.26f * float(i), 0.1f, 0}), {0.14f, 0.022f, 0.8f}, 0.003f);
}

// Goods on a pallet, at most `high` above its foot.
void addGoods(Hall& hall, const Frame& base, float high, Dice& dice) {
    addPallet(hall, base, dice);
    const Frame top = base.at({0, 0.122f, 0});
    const float room = high - 0.2f;
    const int kind = dice.below(5);
    if (kind == 0) {
        for (const float x : {-0.28f, 0.28f})
            addBarrel(hall.builder, hall.palette, top.at({x, 0, dice.range(-0.05f, 0.05f)}), std::min(0.78f, room),
                      dice);
        return;
    }
    if (kind == 1) {
        addCrate(hall.builder, hall.palette, top, {1.0f, std::min(0.75f, room), 0.74f}, dice);
        return;
    }
    // Layers of cardboard boxes.
    const int layers = std::clamp(int(room / 0.34f), 1, 1 + dice.below(4)), across = 2 + dice.below(2);
    const float h = std::min(0.34f, room / float(layers));
    for (int layer = 0; layer < layers; ++layer)
        for (int i = 0; i < across; ++i)
            for (int k = 0; k < 2; ++k) {
                if (layer > 0 && layer + 1 == layers && dice.chance(0.3f)) continue;
                const float w = 1.06f / float(across), d = 0.37f;
                addCardboardBox(hall.builder, hall.palette,
                                top.at({-0.53f + w * (float(i) + 0.5f), h * float(layer), (float(k) - 0.5f) * d})
                                    .turned(dice.range(-0.03f, 0.03f)),
                                {w - 0.02f, h - 0.004f, d - 0.02f}, dice);
            }
}

// A row of racks along z with its middle at x.
void addRackRow(Hall& hall, float x, float z0, float z1, Dice& dice) {
    const int fields = std::max(1, int((z1 - z0) / 2.75f)),
              levels = std::clamp(int((hall.shape.height - 1.2f) / 1.5f), 1, 5);
    const float field = (z1 - z0) / float(fields), deep = 0.5f, high = 1.5f;
    Part& steel = hall.builder.part(hall.palette.steel);
    for (int i = 0; i <= fields; ++i) {
        const float z = z0 + field * float(i);
        steel.color = {0.03f, 0.12f, 0.30f};
        for (const float s : {-deep, deep}) {
            addStandingBox(steel, Frame{}.at({x + s, 0, z}), {0.09f, high * float(levels) + 0.2f, 0.08f}, 0.006f);
            addStandingBox(steel, Frame{}.at({x + s, 0, z}), {0.16f, 0.012f, 0.14f}, 0.002f);
        }
        for (int k = 0; k < levels * 2; ++k) {
            const float y = 0.2f + 0.75f * float(k), s = k % 2 ? 1.0f : -1.0f;
            addBeam(steel, {x - s * deep, y, z}, {x + s * deep, y + 0.7f, z}, 0.035f, 0.035f, 0.004f, {0, 0, 1});
        }
    }
    for (int level = 0; level < levels; ++level) {
        const float y = level == 0 ? 0.0f : high * float(level);
        for (int i = 0; i < fields; ++i) {
            const float from = z0 + field * float(i) + 0.045f, to = z0 + field * float(i + 1) - 0.045f;
            steel.color = {0.62f, 0.19f, 0.02f};
            if (level > 0)
                for (const float s : {-deep, deep})
                    addBeam(steel, {x + s, y - 0.06f, from}, {x + s, y - 0.06f, to}, 0.05f, 0.12f, 0.006f);
            const int places = std::max(1, int((to - from) / 1.3f));
            for (int place = 0; place < places; ++place) {
                if (!dice.chance(hall.shape.fill)) continue;
                const float z = from + (to - from) * (float(place) + 0.5f) / float(places);
                addGoods(hall, Frame{}.at({x, y, z}).turned(kPi / 2 + dice.range(-0.03f, 0.03f)),
                         level + 1 == levels ? 1.5f : high - 0.15f, dice);
            }
        }
    }
}

void addRacks(Hall& hall, Dice& dice) {
    const float z0 = -hall.halfLength + 1.5f, z1 = hall.halfLength - 4.5f;
    if (z1 - z0 < 2 || hall.shape.shelfRows == 0) return;
    // Either side of the aisle in the middle, from its edge to the columns.
    const int perSide = (hall.shape.shelfRows + 1) / 2;
    int left = hall.shape.shelfRows;
    for (int i = 0; i < perSide; ++i)
        for (const float s : {-1.0f, 1.0f}) {
            if (left-- <= 0) return;
            const float inner = 2.5f, outer = std::max(inner, hall.halfWidth - 1.2f);
            const float x = perSide == 1 ? inner : inner + (outer - inner) * float(i) / float(perSide - 1);
            addRackRow(hall, s * x, z0, z1, dice);
        }
    for (int i = 0; i < 4; ++i)  // what was put down near the gate
        addGoods(hall,
                 Frame{}
                     .at({(i % 2 ? 1.0f : -1.0f) * (hall.halfWidth * 0.5f + dice.range(-0.5f, 0.5f)), 0.005f,
                          hall.halfLength - 1.4f - 1.4f * float(i / 2)})
                     .turned(dice.range(-0.2f, 0.2f)),
                 1.3f, dice);
}

}  // namespace

Result<Model> makeHall(const HallShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("hall");
    Dice dice(shape.seed * 47 + 3);
    Hall hall{shape,
              builder,
              {},
              -1,
              -1,
              shape.width / 2,
              shape.length / 2,
              shape.length / float(shape.bays),
              shape.height + kRoofPitch * shape.width / 2};
    hall.palette.concrete = hall.concreteFloor = builder.addMaterial("concrete", {1, 1, 1}, makeConcrete(shape.seed));
    hall.palette.steel = builder.addMaterial("painted steel", {1, 1, 1}, 0.42f);
    hall.palette.paint = builder.addMaterial("matt", {1, 1, 1}, 0.8f);
    hall.palette.darkMetal = builder.addMaterial("iron", {0.06f, 0.058f, 0.055f}, 0.5f, 0.5f);
    hall.cladding = builder.addMaterial("sheet metal", {1, 1, 1}, 0.5f, 0.2f);
    if (shape.shelves) hall.palette.wood = builder.addMaterial("wood", {1, 1, 1}, makeWood(shape.seed));
    builder.beginNode("floor");
    addFloor(hall, dice);
    builder.beginNode("frames");
    addFrames(hall);
    builder.beginNode("walls");
    const float w = hall.halfWidth, l = hall.halfLength;
    addSideWall(hall, {-w, 0, -l}, {-w, 0, l}, {-1, 0, 0}, dice);
    addSideWall(hall, {w, 0, l}, {w, 0, -l}, {1, 0, 0}, dice);
    addGable(hall, -l, false, dice);
    builder.beginNode("front");
    if (shape.frontWall) addGable(hall, l, true, dice);
    builder.beginNode("roof");
    if (shape.roof) addRoof(hall, dice);
    builder.beginNode("shelves");
    if (shape.shelves) addRacks(hall, dice);
    return builder.finish();
}

}  // namespace shoal::scene
