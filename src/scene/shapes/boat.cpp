// A rowing boat, or a small sailing boat with her sail stowed.
#include <algorithm>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr int kStations = 36, kRibs = 32;
constexpr float kPlank = 0.03f, kFloor = 0.07f;

struct Hull {
    const BoatShape& shape;
    // t: 0 at the transom, 1 at the stem.
    float halfBeam(float t) const {
        const float aft = 0.72f + 0.28f * smoothstep(0.0f, 0.45f, t);
        return 0.5f * shape.beam * aft *
               std::sqrt(std::max(0.0f, 1 - std::pow(std::max(0.0f, (t - 0.4f) / 0.6f), 2.2f)));
    }
    float rim(float t) const { return shape.freeboard * (1 + 0.16f * (1 - t) * (1 - t) + 0.62f * std::pow(t, 3.0f)); }
    float keel(float t) const {
        return -shape.draught * (0.72f + 0.28f * std::sin(kPi * std::min(1.0f, t + 0.2f))) +
               (shape.draught + 0.4f * rim(t)) * std::pow(t, 7.0f);
    }
    // s: -1 port rim, 0 keel, 1 starboard rim; inset moves the skin inwards.
    Vec3 skin(float t, float s, float inset) const {
        const float b = std::max(0.0f, halfBeam(t) - inset), low = keel(t) + inset, high = rim(t);
        const float a = std::abs(s) * kPi / 2, full = mix(0.62f, 1.0f, smoothstep(0.75f, 1.0f, t));
        return {(s < 0 ? -b : b) * std::pow(std::sin(a), full), low + (high - low) * std::pow(1 - std::cos(a), 1.15f),
                -shape.length * (t - 0.5f)};
    }
};

Blob skinBlob(const Hull& hull, float inset, bool inside) {
    Blob blob;
    for (int i = 0; i <= kStations; ++i)
        for (int k = -kRibs; k <= kRibs; ++k) {
            Vec3 p = hull.skin(float(i) / kStations, float(k) / kRibs, inset);
            if (inside) p.y = std::max(p.y, kFloor - 0.02f);
            blob.positions.push_back(p);
        }
    const std::uint32_t side = 2 * kRibs + 1;
    for (std::uint32_t i = 0; i < kStations; ++i)
        for (std::uint32_t k = 0; k + 1 < side; ++k) {
            const std::uint32_t a = i * side + k, b = a + 1, c = a + side, d = c + 1;
            if (inside)
                blob.indices.insert(blob.indices.end(), {a, b, d, a, d, c});
            else
                blob.indices.insert(blob.indices.end(), {a, d, b, a, c, d});
        }
    return blob;
}

// Stripes by height: antifouling under the water, the boat's colour, a light strake under the rim.
void paintSkin(Blob& blob, const BoatShape& shape, const Hull& hull) {
    for (const Vec3& p : blob.positions) {
        const float t = 0.5f - p.z / shape.length, up = p.y / hull.rim(t);
        blob.colors.push_back(p.y < 0.06f ? Vec3{0.22f, 0.045f, 0.03f}
                              : up > 0.8f ? Vec3{0.72f, 0.68f, 0.58f}
                                          : shape.color);
    }
}

void addTransom(Part& part, const Hull& hull, const BoatShape& shape) {
    for (int k = -kRibs; k < kRibs; ++k) {
        const Vec3 a = hull.skin(0, float(k) / kRibs, 0), b = hull.skin(0, float(k + 1) / kRibs, 0),
                   top{0, hull.rim(0), a.z};
        for (const float s : {1.0f, -1.0f}) {
            const Vec3 normal{0, 0, s}, shift{0, 0, s > 0 ? 0.001f : -kPlank};
            part.color = s > 0 ? shape.color : Vec3{0.5f, 0.36f, 0.22f};
            const std::uint32_t v[3] = {part.add({a + shift, normal, {1, 0, 0}, {a.x, a.y}}),
                                        part.add({b + shift, normal, {1, 0, 0}, {b.x, b.y}}),
                                        part.add({top + shift, normal, {1, 0, 0}, {top.x, top.y}})};
            part.triangle(v[0], v[1], v[2], normal);
        }
    }
}

void addFittings(Part& wood, Part& rope, const Hull& hull, const BoatShape& shape, Dice& dice) {
    const auto zOf = [&](float t) { return -shape.length * (t - 0.5f); };
    for (int i = 0; i < kStations; ++i)  // gunwales
        for (const float s : {-1.0f, 1.0f}) {
            wood.color = {0.62f, 0.45f, 0.29f};
            addBeam(wood, hull.skin(float(i) / kStations, s, 0.01f), hull.skin(float(i + 1) / kStations, s, 0.01f),
                    0.075f, 0.045f, 0.002f);
        }
    addBeam(wood, hull.skin(0, -1, 0), hull.skin(0, 1, 0), 0.07f, 0.05f, 0.014f);
    addBeam(wood, hull.skin(0.985f, 0, 0) - Vec3{0, 0.02f, 0.02f}, hull.skin(1, 1, 0) + Vec3{0, 0.09f, -0.03f}, 0.06f,
            0.09f, 0.015f, {0, 0, 1});
    for (const float t : {0.1f, 0.38f, 0.66f}) {  // thwarts
        wood.color = Vec3{0.72f, 0.55f, 0.37f} * dice.range(0.85f, 1.05f);
        wood.uvOffset = {dice.unit(), dice.unit()};
        const float y = 0.62f * hull.rim(t), half = hull.halfBeam(t) * 0.93f;
        addBox(wood, Frame{}.at({0, y, zOf(t)}), {half, 0.016f, t < 0.2f ? 0.2f : 0.12f}, 0.006f);
    }
    for (int i = -4; i <= 4; ++i) {  // bottom boards
        wood.color = Vec3{0.55f, 0.42f, 0.29f} * woodTint(dice, 0.3f);
        wood.uvOffset = {dice.unit(), dice.unit()};
        const float x = 0.105f * float(i), reach = 0.36f - 0.02f * std::abs(float(i));
        if (std::abs(x) < 0.34f * shape.beam)
            addBox(wood, Frame{}.at({x, kFloor, zOf(0.44f)}), {0.048f, 0.012f, reach * shape.length}, 0.004f);
    }
    for (const float s : {-1.0f, 1.0f}) {  // oars over the thwarts
        wood.color = {0.75f, 0.60f, 0.42f};
        const float y = 0.62f * hull.rim(0.38f) + 0.045f, x = s * 0.16f * shape.beam;
        addBeam(wood, {x, y, zOf(0.05f)}, {x * 0.7f, y + 0.02f, zOf(0.66f)}, 0.04f, 0.04f, 0.016f);
        addBox(wood, Frame{}.at({x * 0.66f, y + 0.03f, zOf(0.73f)}), {0.07f, 0.011f, 0.38f}, 0.006f);
    }
    rope.color = {0.5f, 0.42f, 0.3f};
    for (int turn = 0; turn < 4; ++turn)
        addLathe(rope, Frame{}.at({0.02f, kFloor + 0.03f + 0.025f * float(turn), zOf(0.82f)}),
                 {{0.12f, -0.012f}, {0.15f, -0.01f}, {0.16f, 0.002f}, {0.15f, 0.012f}, {0.12f, 0.012f}}, 20);
}

void addRig(Part& wood, Part& cloth, const Hull& hull, const BoatShape& shape) {
    const float high = 1.25f * shape.length, boom = 0.5f * hull.rim(0.5f) + 0.75f;
    const float mastZ = -shape.length * 0.16f;
    wood.color = {0.66f, 0.48f, 0.30f};
    addLathe(wood, Frame{}.at({0, 0, mastZ}),
             {{0, kFloor}, {0.06f, kFloor}, {0.055f, 0.5f * high}, {0.03f, high}, {0, high + 0.02f}}, 16, true);
    addBeam(wood, {0, boom, mastZ}, {0, boom + 0.12f, 0.46f * shape.length}, 0.06f, 0.06f, 0.025f);
    cloth.color = {0.70f, 0.66f, 0.56f};  // the sail rolled on the boom
    std::vector<Vec2> roll{{0, 0}};
    const float from = mastZ + 0.12f, run = 0.44f * shape.length - from;
    for (int i = 0; i <= 16; ++i) {  // lashed at every fourth step
        const float t = float(i) / 16;
        roll.push_back({(i % 4 ? 0.13f : 0.1f) * (1 - 0.4f * t), run * t});
    }
    roll.push_back({0, run});
    addLathe(cloth, Frame{{0, boom + 0.13f, from}, {1, 0, 0}, {0, 0.05f, 1}, {0, -1, 0.05f}}, roll, 18);
    cloth.color = {0.05f, 0.05f, 0.05f};  // stays
    const Vec3 top{0, high * 0.97f, mastZ};
    for (const Vec3 foot : {hull.skin(1, 1, 0) + Vec3{0, 0.08f, 0}, hull.skin(0.55f, 1, 0), hull.skin(0.55f, -1, 0)})
        addBeam(cloth, foot, top, 0.012f, 0.012f, 0, {0.3f, 0, 1});
}

}  // namespace

Result<Model> makeBoat(const BoatShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("boat");
    Dice dice(shape.seed * 83 + 7);
    const int paint = builder.addMaterial("paint", {1, 1, 1}, 0.35f);
    const int wood = builder.addMaterial("wood", {1, 1, 1}, makeWood(shape.seed));
    const int cloth = builder.addMaterial("cloth", {1, 1, 1}, 0.9f);
    const Hull hull{shape};
    builder.beginNode("hull");
    Blob outside = skinBlob(hull, 0, false);
    paintSkin(outside, shape, hull);
    addBlob(builder.part(paint), {}, outside);
    addTransom(builder.part(paint), hull, shape);
    builder.part(wood).color = {0.62f, 0.47f, 0.32f};
    addBlob(builder.part(wood), {}, skinBlob(hull, kPlank, true));
    builder.beginNode("fittings");
    addFittings(builder.part(wood), builder.part(cloth), hull, shape, dice);
    if (shape.mast) addRig(builder.part(wood), builder.part(cloth), hull, shape);
    return builder.finish();
}

}  // namespace shoal::scene
