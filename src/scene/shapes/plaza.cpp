// A paved square.
#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr float kMostSlabs = 200000;  // 1.6 million vertices

// 0: light stone, 1: dark stone.
float darkness(const PlazaShape& shape, float x, float z, int column, int row) {
    if (shape.pattern == "checker") return float((column / 2 + row / 2) % 2);
    if (shape.pattern == "bands") return column % 6 == 0 || row % 6 == 0 ? 1.0f : 0.0f;
    if (shape.pattern == "rings") {
        const float r = std::sqrt(x * x + z * z) / shape.size, spoke = std::abs(std::sin(4 * std::atan2(z, x)));
        const bool ring = (r > 0.155f && r < 0.185f) || (r > 0.30f && r < 0.33f) || (r > 0.44f && r < 0.47f);
        return ring || (r > 0.185f && r < 0.30f && spoke < 0.12f) ? 1.0f : 0.0f;
    }
    return 0;
}

void addPaving(ModelBuilder& builder, const PlazaShape& shape, const Palette& palette, Dice& dice) {
    const int count = std::max(1, int(std::round(shape.size / shape.slabSize)));
    const float step = shape.size / float(count);
    builder.part(palette.concrete).color = {0.42f, 0.40f, 0.37f};
    addStandingBox(builder.part(palette.concrete), Frame{}.at({0, -0.22f, 0}), {shape.size, 0.208f, shape.size}, 0);
    Part& stone = builder.part(palette.stone);
    for (int row = 0; row < count; ++row)
        for (int column = 0; column < count; ++column) {
            const float x = -shape.size / 2 + step * (float(column) + 0.5f),
                        z = -shape.size / 2 + step * (float(row) + 0.5f);
            const Vec3 light = lerp(Vec3{1.0f, 0.93f, 0.82f}, Vec3{0.88f, 0.85f, 0.80f}, dice.unit()),
                       dark = lerp(Vec3{0.42f, 0.40f, 0.40f}, Vec3{0.50f, 0.42f, 0.36f}, dice.unit());
            stone.color = lerp(light, dark, darkness(shape, x, z, column, row)) * dice.range(0.84f, 1.08f);
            stone.uvOffset = {dice.unit(), dice.unit()};
            addSlab(stone, Frame{}.at({x, -dice.range(0, 0.004f), z}), step / 2 - 0.004f, step / 2 - 0.004f, 0.010f);
        }
}

void addLowWalls(ModelBuilder& builder, const PlazaShape& shape, const Palette& palette, Dice& dice) {
    Part& stone = builder.part(palette.stone);
    const float edge = shape.size / 2 - 0.25f, opening = std::min(3.0f, 0.15f * shape.size);
    for (int side = 0; side < 4; ++side) {
        const Frame frame = Frame{}.turned(float(side) * kPi / 2);
        for (const float s : {-1.0f, 1.0f}) {
            const float length = edge - opening + (side % 2 ? -0.2f : 0.2f);  // two opposite sides own the corners
            const int blocks = std::max(1, int(length / 0.75f));
            const float step = length / float(blocks);
            for (int i = 0; i < blocks; ++i)
                for (int course = 0; course < 2; ++course) {
                    const float shift = course ? 0.0f : 0.06f * step;
                    stone.color = Vec3{0.95f, 0.90f, 0.82f} * dice.range(0.78f, 1.05f);
                    stone.uvOffset = {dice.unit(), dice.unit()};
                    addBox(stone,
                           frame.at({s * (opening + step * (float(i) + 0.5f)), 0.115f + 0.23f * float(course), edge}),
                           {step / 2 - 0.003f, 0.113f, 0.19f - 0.1f * shift}, 0.014f);
                }
            const int caps = std::max(1, int(length / 1.1f));
            for (int i = 0; i < caps; ++i) {
                const float cap = length / float(caps);
                stone.color = Vec3{1.0f, 0.97f, 0.92f} * dice.range(0.9f, 1.08f);
                addBox(stone, frame.at({s * (opening + cap * (float(i) + 0.5f)), 0.49f, edge}),
                       {cap / 2 - 0.003f, 0.032f, 0.235f}, 0.015f);
            }
            // A pier with a ball beside each opening.
            stone.color = {0.95f, 0.92f, 0.86f};
            addStandingBox(stone, frame.at({s * (opening - 0.26f), 0, edge}), {0.52f, 0.78f, 0.52f}, 0.02f);
            addStandingBox(stone, frame.at({s * (opening - 0.26f), 0.78f, edge}), {0.62f, 0.08f, 0.62f}, 0.02f);
            addSphere(stone, frame.at({s * (opening - 0.26f), 1.05f, edge}), 0.21f, 28);
        }
    }
}

void addFountain(ModelBuilder& builder, const PlazaShape& shape, const Palette& palette, int water) {
    Part& stone = builder.part(palette.stone);
    stone.color = {1.0f, 0.96f, 0.90f};
    const float r = std::clamp(0.085f * shape.size, 0.9f, 3.2f);
    addLathe(stone, {},
             {{r + 0.35f, 0},
              {r + 0.35f, 0.14f},
              {r + 0.33f, 0.16f},
              {r + 0.02f, 0.16f},
              {r, 0.18f},
              {r - 0.02f, 0.24f},
              {r - 0.04f, 0.46f},
              {r + 0.02f, 0.50f},
              {r + 0.06f, 0.53f},
              {r + 0.06f, 0.60f},
              {r + 0.03f, 0.63f},
              {r - 0.24f, 0.63f},
              {r - 0.27f, 0.60f},
              {r - 0.27f, 0.12f},
              {0, 0.12f}},
             72);
    const float b = 0.42f * r;
    addLathe(stone, {}, {{0.30f, 0.1f},      {0.32f, 0.5f},      {0.24f, 0.6f},      {0.15f, 0.75f},     {0.13f, 1.0f},
                         {0.17f, 1.12f},     {0.16f, 1.2f},      {b * 0.55f, 1.27f}, {b * 0.92f, 1.42f}, {b, 1.55f},
                         {b * 0.98f, 1.58f}, {b * 0.92f, 1.58f}, {b * 0.82f, 1.46f}, {b * 0.4f, 1.36f},  {0.12f, 1.34f},
                         {0.10f, 1.55f},     {0.075f, 1.75f},    {0.13f, 1.86f},     {0.10f, 1.97f},     {0, 2.02f}},
             48);
    Part& pool = builder.part(water);
    pool.color = {1, 1, 1};
    addLathe(pool, {}, {{r - 0.265f, 0.5f}, {0, 0.5f}}, 48);
    addLathe(pool, {}, {{b * 0.88f, 1.52f}, {0.1f, 1.52f}}, 36);
}

// A robed figure on a plinth: a silhouette, which is what a statue is from across a square.
void addStatue(ModelBuilder& builder, const Palette& palette, int bronze) {
    Part& stone = builder.part(palette.stone);
    stone.color = {0.98f, 0.95f, 0.90f};
    for (int step = 0; step < 3; ++step)
        addStandingBox(stone, Frame{}.at({0, 0.17f * float(step), 0}),
                       {3.4f - 0.7f * float(step), 0.17f, 3.4f - 0.7f * float(step)}, 0.02f);
    addStandingBox(stone, Frame{}.at({0, 0.51f, 0}), {1.5f, 0.16f, 1.5f}, 0.03f);
    addStandingBox(stone, Frame{}.at({0, 0.67f, 0}), {1.2f, 1.25f, 1.2f}, 0.02f);
    addStandingBox(stone, Frame{}.at({0, 1.92f, 0}), {1.44f, 0.14f, 1.44f}, 0.035f);
    Part& metal = builder.part(bronze);
    metal.color = {1, 1, 1};
    Blob robe = makeIcosphere(5);
    const float top = 1.5f;
    for (Vec3& p : robe.positions) {
        const float t = p.y * 0.5f + 0.5f, turn = std::atan2(p.z, p.x);
        const float waist = mix(0.44f, 0.20f, smoothstep(0.05f, 0.55f, t)) + 0.11f * smoothstep(0.6f, 0.84f, t) -
                            0.24f * smoothstep(0.86f, 1.0f, t);
        const float folds = 1 + 0.07f * (1 - smoothstep(0.5f, 0.8f, t)) * std::sin(turn * 9 + 3 * std::sin(t * 5));
        const float flat = std::sqrt(p.x * p.x + p.z * p.z),
                    round = flat > 1e-4f ? std::min(1.0f, flat * 2.2f) / flat : 0;
        p = {p.x * round * waist * folds * 1.08f, t * top, p.z * round * waist * folds * 0.82f};
    }
    addBlob(metal, Frame{}.at({0, 2.05f, 0}), robe);
    addLathe(metal, Frame{}.at({0, 2.05f + top - 0.06f, 0.02f}),
             {{0, 0},
              {0.075f, 0},
              {0.07f, 0.12f},
              {0.115f, 0.2f},
              {0.125f, 0.29f},
              {0.10f, 0.39f},
              {0.05f, 0.43f},
              {0, 0.435f}},
             24);
    for (const float s : {-1.0f, 1.0f}) {  // arms: one raised
        const Vec3 shoulder{s * 0.27f, 2.05f + 1.24f, 0},
            elbow = s > 0 ? Vec3{0.55f, 3.42f, 0.12f} : Vec3{-0.36f, 2.95f, 0.12f};
        const Vec3 hand = s > 0 ? Vec3{0.62f, 3.80f, 0.2f} : Vec3{-0.2f, 2.80f, 0.32f};
        addBeam(metal, shoulder, elbow, 0.14f, 0.14f, 0.065f);
        addBeam(metal, elbow, hand, 0.11f, 0.11f, 0.05f);
        addSphere(metal, Frame{}.at(elbow), 0.072f, 14);
        addSphere(metal, Frame{}.at(hand), 0.065f, 14);
    }
}

void addPlanter(ModelBuilder& builder, const Palette& palette, int soil, const Frame& base, Dice& dice) {
    Part& stone = builder.part(palette.stone);
    const float half = 0.8f, high = 0.52f;
    for (int side = 0; side < 4; ++side) {
        stone.color = Vec3{0.97f, 0.93f, 0.87f} * dice.range(0.9f, 1.05f);
        stone.uvOffset = {dice.unit(), dice.unit()};
        const float trim = side % 2 ? 0.14f : 0.0f;
        addBox(stone, base.turned(float(side) * kPi / 2).at({0, high / 2, half - 0.07f}),
               {half - trim, high / 2, 0.07f}, 0.018f);
    }
    builder.part(soil).color = {1, 1, 1};
    addSheet(builder.part(soil), base.at({0, high - 0.07f, 0}), half - 0.1f, half - 0.1f);
    addTree(builder, palette, base.at({0, high - 0.08f, 0}).turned(dice.range(0, 6)), dice.range(3.6f, 4.8f), dice);
    for (int i = 0; i < 5; ++i)
        addFoliage(builder.part(palette.leaf),
                   base.point({dice.range(-0.5f, 0.5f), high + 0.02f, dice.range(-0.5f, 0.5f)}), {0.24f, 0.16f, 0.24f},
                   28, 0.07f, dice);
}

// Where thing i of n goes round the square, `reach` of its half size out; straight sides, so that it stays parallel to
// the edge.
Frame roundTheSquare(const PlazaShape& shape, int i, int count, float reach, float phase) {
    const float a = 2 * kPi * (float(i) + phase) / float(count), r = reach * shape.size / 2;
    const float stretch = std::min(1.25f, 1 / std::max(std::abs(std::cos(a)), std::abs(std::sin(a))));
    return Frame{}
        .at({std::sin(a) * r * stretch, 0, std::cos(a) * r * stretch})
        .turned(std::round(a / (kPi / 2)) * kPi / 2 + kPi);
}

}  // namespace

Result<Model> makePlaza(const PlazaShape& shape) {
    SHOAL_TRY(validate(shape));
    const float slabs = shape.size / shape.slabSize;
    if (slabs * slabs > kMostSlabs)
        return badInput("slabSize: found too small for a square of this size, expected at most 200000 slabs");
    ModelBuilder builder("plaza");
    Dice dice(shape.seed * 53 + 3);
    Palette palette;
    palette.stone = builder.addMaterial("stone", {1, 1, 1}, makeStone(shape.seed));
    palette.concrete = builder.addMaterial("joints", {1, 1, 1}, makeConcrete(shape.seed));
    palette.darkMetal = builder.addMaterial("iron", {0.03f, 0.034f, 0.034f}, 0.45f, 0.4f);
    palette.lamp = builder.addMaterial("lamp", {0.9f, 0.88f, 0.82f}, 0.3f);
    builder.material(palette.lamp).emission = {1.6f, 1.25f, 0.8f};
    palette.bark = builder.addMaterial("bark", {0.16f, 0.12f, 0.085f}, 0.9f);
    palette.leaf = builder.addMaterial("leaves", {0.10f, 0.17f, 0.04f}, 0.6f);
    builder.material(palette.leaf).doubleSided = true;
    if (shape.benches > 0) palette.wood = builder.addMaterial("wood", {1, 1, 1}, makeWood(shape.seed));
    builder.beginNode("paving");
    addPaving(builder, shape, palette, dice);
    builder.beginNode("walls");
    if (shape.walls) addLowWalls(builder, shape, palette, dice);
    builder.beginNode("center");
    if (shape.center == "fountain") {
        const int water = builder.addMaterial("water", {0.02f, 0.06f, 0.065f}, 0.03f);
        addFountain(builder, shape, palette, water);
    } else if (shape.center == "statue") {
        addStatue(builder, palette, builder.addMaterial("bronze", {0.24f, 0.30f, 0.24f}, 0.5f, 0.7f));
    }
    builder.beginNode("benches");
    for (int i = 0; i < shape.benches; ++i) {
        const float a = 2 * kPi * (float(i) + 0.5f) / float(shape.benches), r = 0.29f * shape.size;
        addBench(builder, palette, Frame{}.at({std::sin(a) * r, 0, std::cos(a) * r}).turned(a + kPi), dice);
    }
    builder.beginNode("lamps");
    for (int i = 0; i < shape.lamps; ++i)
        addLamp(builder, palette, roundTheSquare(shape, i, shape.lamps, 0.7f, 0.25f), 3.9f);
    builder.beginNode("trees");
    const int soil = builder.addMaterial("soil", {0.07f, 0.05f, 0.035f}, 0.95f);
    for (int i = 0; i < shape.trees; ++i)
        addPlanter(builder, palette, soil, roundTheSquare(shape, i, shape.trees, 0.78f, 0.5f), dice);
    return builder.finish();
}

}  // namespace shoal::scene
