// A temple fallen to ruin.
#include <array>
#include <cmath>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr int kFlutes = 18, kAround = 3 * kFlutes, kSteps = 3;
constexpr float kStepHeight = 0.26f, kStepDepth = 0.38f;

// A stone cut of the same quarry as the others, laid a little askew.
void tintStone(Part& stone, Dice& dice) {
    stone.color = Vec3{0.92f, 0.88f, 0.80f} * dice.range(0.78f, 1.05f);
    stone.uvOffset = {dice.unit(), dice.unit()};
}

void addBlock(Part& stone, const Frame& base, Vec3 size, Dice& dice) {
    tintStone(stone, dice);
    addStandingBox(stone, base.turned(dice.range(-0.012f, 0.012f)), size - Vec3{0.008f, 0.004f, 0.008f},
                   0.035f * std::min(1.0f, 2 * size.y));
}

// A fluted piece of a shaft with rings `low` to `high` up the column; its upper end is even or broken.
struct Drum {
    float lowRadius, highRadius, height;
    bool broken;
    std::uint32_t seed;

    Vec3 point(int ring, int rings, int k) const {
        const float t = float(ring) / float(rings), a = 2 * kPi * float(k % kAround) / kAround;
        const float worn = 1 - 0.035f * std::abs(noise(3 * std::cos(a) + 5, 3 * std::sin(a) + 4 * t, seed + 1));
        const float flute = k % 3 == 0 ? 1.0f : 0.925f;
        const float r = mix(lowRadius, highRadius, t) * flute * worn;
        const float ragged = broken ? 0.30f * highRadius *
                                          (1.4f * noise(1.2f * std::cos(a), 1.2f * std::sin(a), seed + 2) +
                                           noise(4 * std::cos(a), 4 * std::sin(a), seed + 3))
                                    : 0;
        return {r * std::cos(a), height * t + ragged * t * t, r * std::sin(a)};
    }
};

void addDrum(Part& stone, const Frame& frame, const Drum& drum, Dice& dice) {
    tintStone(stone, dice);
    const int rings = std::max(2, int(drum.height / 0.45f));
    const float turns = std::max(1.0f, std::round(2 * kPi * drum.lowRadius * stone.uvPerMetre));
    std::vector<std::uint32_t> before;
    for (int ring = 0; ring <= rings; ++ring) {
        std::vector<std::uint32_t> now;
        for (int k = 0; k <= kAround; ++k) {
            const Vec3 p = drum.point(ring, rings, k),
                       round = drum.point(ring, rings, k + 1) - drum.point(ring, rings, k + kAround - 1);
            const Vec3 n = normalize(cross(Vec3{0, 1, 0}, round)), t = normalize(round) * -1.0f;
            now.push_back(stone.add({frame.point(p), frame.direction(n), frame.direction(t),
                                     stone.uvOffset + Vec2{-turns * float(k) / kAround, -p.y * stone.uvPerMetre}}));
        }
        for (std::size_t k = 0; k + 1 < now.size() && ring > 0; ++k) {
            const float a = 2 * kPi * (float(k) + 0.5f) / kAround;
            stone.quad(before[k], now[k], now[k + 1], before[k + 1], frame.direction({std::cos(a), 0, std::sin(a)}));
        }
        before = std::move(now);
    }
    for (const bool top : {false, true}) {  // both ends, level or broken
        const float s = top ? 1.0f : -1.0f;
        std::vector<std::uint32_t> rim;
        Vec3 middle;
        for (int k = 0; k < kAround; ++k) {
            const Vec3 p = drum.point(top ? rings : 0, rings, k);
            middle += p / float(kAround);
            rim.push_back(
                stone.add({frame.point(p), frame.y * s, frame.x, {p.x * stone.uvPerMetre, p.z * stone.uvPerMetre}}));
        }
        if (top && drum.broken) middle.y += 0.12f * drum.highRadius;
        const std::uint32_t c = stone.add({frame.point(middle), frame.y * s, frame.x, {0, 0}});
        for (std::size_t k = 0; k < rim.size(); ++k) stone.triangle(c, rim[k], rim[(k + 1) % rim.size()], frame.y * s);
    }
}

struct Order {  // measures of a column
    float radius, height, base, capital;
    float radiusAt(float y) const { return radius * (1 - 0.15f * std::pow(y / height, 1.5f)); }
};

// Doric capital: necking, a cushion and a slab.
void addCapital(Part& stone, const Frame& at, const Order& order, Dice& dice) {
    const float r = order.radiusAt(order.height), h = order.capital;
    tintStone(stone, dice);
    addLathe(stone, at,
             {{0, 0},
              {r * 0.98f, 0},
              {r * 1.0f, 0.2f * h},
              {r * 1.14f, 0.38f * h},
              {r * 1.34f, 0.56f * h},
              {r * 1.36f, 0.6f * h},
              {0, 0.6f * h}},
             36);
    addStandingBox(stone, at.at({0, 0.6f * h, 0}), {2.85f * r, 0.4f * h, 2.85f * r}, 0.03f);
}

// Up to `standing` metres of a column, in drums.
void addColumn(Part& stone, const Frame& foot, const Order& order, float standing, Dice& dice) {
    tintStone(stone, dice);
    addStandingBox(stone, foot, {2.7f * order.radius, 0.45f * order.base, 2.7f * order.radius}, 0.03f);
    addLathe(stone, foot.at({0, 0.45f * order.base, 0}),
             {{1.2f * order.radius, 0},
              {1.27f * order.radius, 0.25f * order.base},
              {1.15f * order.radius, 0.5f * order.base},
              {1.02f * order.radius, 0.55f * order.base},
              {0, 0.55f * order.base}},
             36);
    const float shaft = order.height - order.base - order.capital, end = std::min(standing, shaft);
    float y = 0;
    Frame at = foot.at({0, order.base, 0});
    while (y < end - 0.05f) {
        const float piece = std::min(dice.range(0.8f, 1.25f), end - y);
        const bool last = y + piece > end - 0.05f;
        addDrum(stone, at,
                {order.radiusAt(y), order.radiusAt(y + piece), piece, last && standing < shaft,
                 std::uint32_t(dice.below(1 << 20))},
                dice);
        at = at.at({dice.range(-0.012f, 0.012f), piece, dice.range(-0.012f, 0.012f)}).turned(dice.range(-0.03f, 0.03f));
        y += piece;
    }
    if (standing >= shaft) addCapital(stone, at, order, dice);
}

// The rest of a column, lying outwards from its foot: drums in a row with gaps, the capital last.
void addFallen(Part& stone, Vec3 from, float heading, float height, const Order& order, Dice& dice) {
    float way = 0.4f, left = height;
    while (left > 0.4f) {
        const float piece = std::min(dice.range(0.7f, 1.3f), left), r = order.radiusAt(order.height - left) * 0.97f;
        const float turn = heading + dice.range(-0.16f, 0.16f);
        const Vec3 at =
            from + Vec3{std::sin(heading), 0, std::cos(heading)} * (way + 0.5f * piece) + Vec3{0, 0.80f * r, 0};
        const Frame lying = Frame{}
                                .at(at)
                                .turned(turn)
                                .tipped({1, 0, 0}, kPi / 2 + dice.range(-0.06f, 0.06f))
                                .turned(dice.range(0, 6))
                                .at({0, -0.5f * piece, 0});
        addDrum(stone, lying, {r, r * 0.96f, piece, dice.chance(0.5f), std::uint32_t(dice.below(1 << 20))}, dice);
        way += piece + dice.range(0.05f, 0.4f);
        left -= piece;
    }
    const float r = order.radiusAt(order.height);
    const Frame thrown =
        Frame{}.at(from + Vec3{std::sin(heading), 0, std::cos(heading)} * (way + 0.5f) + Vec3{0, 0.9f * r, 0});
    addCapital(stone, thrown.turned(dice.range(0, 6)).tipped({1, 0, 0}, dice.range(1.2f, 1.9f)), order, dice);
}

void addPlatform(Part& stone, const RuinShape& shape, Dice& dice) {
    for (int step = 0; step < kSteps; ++step) {
        const float inset = kStepDepth * float(step), w = shape.length - 2 * inset, d = shape.width - 2 * inset;
        const int columns = std::max(2, int(w / 1.3f)), rows = std::max(2, int(d / 1.1f));
        for (int row = 0; row < rows; ++row)
            for (int i = 0; i < columns; ++i) {
                const bool edge = row == 0 || i == 0 || row == rows - 1 || i == columns - 1;
                if (step + 1 < kSteps && !edge) continue;  // covered by the next step
                if (edge && dice.chance(0.10f * shape.decay)) continue;
                const float y =
                    kStepHeight * float(step) - (dice.chance(0.25f * shape.decay) ? dice.range(0, 0.05f) : 0.0f);
                const Vec3 at{-w / 2 + w / float(columns) * (float(i) + 0.5f), y,
                              -d / 2 + d / float(rows) * (float(row) + 0.5f)};
                addBlock(stone, Frame{}.at(at), {w / float(columns), kStepHeight, d / float(rows)}, dice);
            }
    }
}

void addColonnades(Part& stone, const RuinShape& shape, const Order& order, Dice& dice) {
    const float top = kStepHeight * kSteps, half = shape.length / 2 - kStepDepth * kSteps - 0.5f,
                z = shape.width / 2 - kStepDepth * kSteps - 0.5f;
    for (const float side : {-1.0f, 1.0f}) {
        bool beforeWhole = false;
        for (int i = 0; i < shape.columns; ++i) {
            const float x = -half + 2 * half * float(i) / float(shape.columns - 1);
            const Vec3 foot{x, top, side * z};
            const bool whole = !dice.chance(shape.decay);
            const float shaft = order.height - order.base - order.capital,
                        standing = whole ? shaft : shaft * dice.range(0.08f, 0.75f);
            addColumn(stone, Frame{}.at(foot), order, standing, dice);
            if (!whole && dice.chance(0.75f)) {
                const float heading = (side > 0 ? 0 : kPi) + dice.range(-0.6f, 0.6f);
                addFallen(stone, {x, 0, side * (shape.width / 2 + 0.35f)}, heading, shaft - standing, order, dice);
            }
            if (whole && beforeWhole) {  // the beam over both
                const float step = 2 * half / float(shape.columns - 1);
                const Frame beam = Frame{}.at({x - step / 2, top + order.height, side * z});
                addBlock(stone, beam, {step + 0.5f, 0.42f, 0.62f}, dice);
                if (dice.chance(1 - shape.decay * 0.6f))
                    addBlock(stone, beam.at({0, 0.42f, 0}), {step * 0.9f, 0.26f, 0.8f}, dice);
            }
            beforeWhole = whole;
        }
    }
}

// Courses of blocks across the -x end with a window; the upper courses crumble.
void addWall(Part& stone, const RuinShape& shape, const Order& order, Dice& dice) {
    const float x = -shape.length / 2 + kStepDepth * kSteps - 0.1f, half = shape.width / 2 - kStepDepth * kSteps - 1.1f,
                top = kStepHeight * kSteps;
    if (half < 0.6f) return;
    const int courses = std::max(3, int(order.height / 0.42f));
    const float high = order.height / float(courses), window = 0.42f * half;
    const std::uint32_t seed = std::uint32_t(dice.below(1 << 20));
    for (int course = 0; course < courses; ++course) {
        const int count = std::max(2, int(2 * half / 0.95f));
        const float step = 2 * half / float(count), y = high * float(course);
        for (int i = course % 2 ? 0 : -1; i < count; ++i) {
            const float from = std::max(-half, -half + step * (float(i) + (course % 2 ? 0.0f : 0.5f)));
            const float to = std::min(half, -half + step * (float(i) + (course % 2 ? 1.0f : 1.5f)));
            const float z = 0.5f * (from + to);
            if (to - from < 0.1f) continue;
            const float left = order.height * (1 - shape.decay * (0.45f + 0.6f * noise(z * 0.9f, 3, seed)) *
                                                       (0.5f + 0.5f * std::abs(z) / half));
            if (y + high > left) continue;
            if (std::abs(z) < window && y > 0.3f * order.height && y < 0.68f * order.height) continue;
            addBlock(stone, Frame{}.at({x, top + y, z}), {0.62f, high, to - from}, dice);
        }
    }
}

// Two piers and a ring of wedges.
void addArch(Part& stone, const RuinShape& shape, const Order& order, Dice& dice) {
    const float x = shape.length / 2 + 2.2f, radius = 1.25f, high = 0.62f * order.height, pier = 0.85f;
    const Frame gate = Frame{}.at({x, 0, 0.2f}).turned(0.35f);
    const int courses = std::max(2, int(high / 0.5f));
    for (const float side : {-1.0f, 1.0f}) {
        for (int course = 0; course < courses; ++course)
            addBlock(stone, gate.at({0, high / float(courses) * float(course), side * (radius + pier / 2)}),
                     {pier, high / float(courses), pier}, dice);
        addBlock(stone, gate.at({0, high, side * (radius + pier / 2 - 0.03f)}), {pier + 0.2f, 0.16f, pier + 0.22f},
                 dice);
    }
    constexpr int kWedges = 13;
    for (int i = 0; i < kWedges; ++i) {
        const float a = kPi * (float(i) + 0.5f) / kWedges, mid = radius + 0.30f;
        tintStone(stone, dice);
        const bool key = i == kWedges / 2;
        Frame wedge = gate.at({dice.range(-0.02f, 0.02f), high + 0.16f + mid * std::sin(a), mid * std::cos(a)})
                          .tipped({1, 0, 0}, kPi / 2 - a);
        addBox(stone, wedge, {(key ? 0.44f : 0.38f), key ? 0.36f : 0.30f, 0.5f * kPi * (mid + 0.30f) / kWedges},
               0.025f);
    }
    for (int i = 0; i < 3; ++i)  // what came down from its attic
        addBlock(stone,
                 Frame{}
                     .at({x + dice.range(-1.2f, 1.6f), -0.08f, dice.range(-2.6f, 2.6f)})
                     .turned(dice.range(0, 6))
                     .tipped({0, 0, 1}, dice.range(-0.3f, 0.3f)),
                 {0.9f, 0.4f, 0.55f}, dice);
}

void addAmphora(Part& clay, const Frame& at, float size, Dice& dice) {
    clay.color = Vec3{0.62f, 0.33f, 0.19f} * dice.range(0.75f, 1.05f);
    addLathe(clay, at,
             {{0, -0.02f * size},
              {0.05f * size, 0},
              {0.10f * size, 0.10f * size},
              {0.20f * size, 0.34f * size},
              {0.235f * size, 0.55f * size},
              {0.19f * size, 0.72f * size},
              {0.09f * size, 0.82f * size},
              {0.075f * size, 0.94f * size},
              {0.11f * size, 0.98f * size},
              {0.10f * size, size},
              {0.06f * size, 0.96f * size},
              {0, 0.8f * size}},
             28);
    for (const float side : {-1.0f, 1.0f}) {
        addBeam(clay, at.point({side * 0.08f * size, 0.92f * size, 0}),
                at.point({side * 0.19f * size, 0.90f * size, 0}), 0.035f * size, 0.03f * size, 0.01f * size);
        addBeam(clay, at.point({side * 0.19f * size, 0.91f * size, 0}),
                at.point({side * 0.175f * size, 0.70f * size, 0}), 0.035f * size, 0.03f * size, 0.01f * size);
    }
}

// Algae and silt: green-brown on what faces up, darker low down, more where the noise says.
void overgrow(Model& model, const RuinShape& shape) {
    for (ModelMesh& mesh : model.meshes)
        for (Primitive& primitive : mesh.primitives)
            for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
                const Vec3 p = primitive.positions[i];
                const float patch = fractal3(p * 0.9f, 3, shape.seed + 300), up = primitive.normals[i].y;
                const float green = shape.overgrowth * smoothstep(-0.5f, 0.6f, 0.55f * up + patch);
                const Vec3 algae = lerp(Vec3{0.30f, 0.33f, 0.15f}, Vec3{0.42f, 0.34f, 0.20f},
                                        smoothstep(-0.3f, 0.4f, fractal3(p * 1.7f, 2, shape.seed + 310)));
                Vec4& c = primitive.colors[i];
                const Vec3 mixed = lerp(Vec3{c.x, c.y, c.z}, algae * 1.6f * luminance({c.x, c.y, c.z}), 0.8f * green);
                c = {mixed.x, mixed.y, mixed.z, 1};
            }
}

}  // namespace

Result<Model> makeRuin(const RuinShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("ruin");
    Dice dice(shape.seed * 113 + 17);
    const int stone = builder.addMaterial("stone", {1, 1, 1}, makeStone(shape.seed)),
              clay = builder.addMaterial("clay", {1, 1, 1}, 0.85f);
    const Order order{shape.columnHeight / 11, shape.columnHeight, 0.06f * shape.columnHeight,
                      0.11f * shape.columnHeight};
    builder.beginNode("platform");
    addPlatform(builder.part(stone), shape, dice);
    builder.beginNode("columns");
    addColonnades(builder.part(stone), shape, order, dice);
    builder.beginNode("wall");
    if (shape.wall) addWall(builder.part(stone), shape, order, dice);
    builder.beginNode("arch");
    if (shape.arch) addArch(builder.part(stone), shape, order, dice);
    builder.beginNode("amphorae");
    for (int i = 0; i < 5; ++i) {
        const Vec3 at{dice.range(-0.4f, 0.5f) * shape.length, 0.1f,
                      (dice.chance(0.5f) ? 1.0f : -1.0f) * (shape.width / 2 + dice.range(0.4f, 1.4f))};
        addAmphora(builder.part(clay),
                   Frame{}.at(at).turned(dice.range(0, 6)).tipped({1, 0, 0}, dice.range(1.1f, 1.7f)),
                   dice.range(0.6f, 0.95f), dice);
    }
    Model model = builder.finish();
    overgrow(model, shape);
    return model;
}

}  // namespace shoal::scene
