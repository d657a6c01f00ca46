// A wooden pier.
#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr float kPlank = 0.15f, kPlankThickness = 0.045f, kGap = 0.008f, kPileSpacing = 3;

void addDeck(Part& wood, const PierShape& shape, Dice& dice) {
    const int count = std::max(1, int(shape.length / (kPlank + kGap)));
    const float step = shape.length / float(count);
    for (int i = 0; i < count; ++i) {
        wood.color = shape.color * woodTint(dice, 0.5f);
        wood.uvOffset = {dice.unit(), dice.unit()};
        const float length = shape.width / 2 + dice.range(-0.015f, 0.03f);
        const Frame frame =
            Frame{}
                .at({dice.range(-0.01f, 0.01f), shape.deckHeight - kPlankThickness / 2 - dice.range(0, 0.004f),
                     -step * (float(i) + 0.5f)})
                .turned(dice.range(-0.003f, 0.003f))
                .tipped({1, 0, 0}, dice.range(-0.02f, 0.02f));
        addBox(wood, frame, {length, kPlankThickness / 2, (step - kGap) / 2}, 0.006f);
    }
    // Beams underneath, along the pier.
    const float under = shape.deckHeight - kPlankThickness - 0.09f;
    for (const float x : {-0.42f, 0.0f, 0.42f}) {
        wood.color = shape.color * 0.72f;
        addBeam(wood, {x * shape.width, under, 0}, {x * shape.width, under, -shape.length}, 0.12f, 0.17f, 0.012f);
    }
}

// Dark and green where waves wet it, darker below.
void addPile(Part& wood, const PierShape& shape, Vec3 foot, float top, float radius, Dice& dice) {
    const Frame frame = Frame{}.at(foot).turned(dice.range(0, 6)).tipped({1, 0, 0}, dice.range(-0.012f, 0.012f));
    wood.uvOffset = {dice.unit(), dice.unit()};
    const float bottom = -shape.waterDepth, wet = std::min(0.28f, top - 0.1f);
    wood.color = shape.color * Vec3{0.34f, 0.37f, 0.30f};
    addLathe(wood, frame, {{0, bottom}, {radius * 1.08f, bottom}, {radius * 1.04f, wet}}, 14, true);
    wood.color = shape.color * 0.8f * woodTint(dice, 0.25f);
    addLathe(wood, frame, {{radius * 1.04f, wet}, {radius, top - 0.03f}, {radius - 0.03f, top}, {0, top + 0.01f}}, 14,
             true);
}

void addPiles(ModelBuilder& builder, const Palette& palette, const PierShape& shape, Dice& dice) {
    Part& wood = builder.part(palette.wood);
    const int rows = std::max(2, int(std::ceil(shape.length / kPileSpacing)) + 1);
    const float x = shape.width / 2 - 0.02f, beam = shape.deckHeight - kPlankThickness - 0.18f;
    for (int i = 0; i < rows; ++i) {
        const float z = -0.2f - (shape.length - 0.4f) * float(i) / float(rows - 1);
        for (const float s : {-1.0f, 1.0f}) {
            const bool tall = i % 2 == 0;
            addPile(wood, shape, {s * (x + 0.14f), 0, z}, shape.deckHeight + (tall ? 0.55f : -0.05f), 0.125f, dice);
            if (!tall) continue;
            Part& rope = builder.part(palette.paint);  // a few turns of rope
            rope.color = {0.45f, 0.36f, 0.24f};
            for (int turn = 0; turn < 3; ++turn) {
                const float y = shape.deckHeight + 0.28f + 0.035f * float(turn);
                addLathe(rope, Frame{}.at({s * (x + 0.14f), y, z}),
                         {{0.12f, -0.016f}, {0.142f, -0.013f}, {0.15f, 0}, {0.142f, 0.013f}, {0.12f, 0.016f}}, 18);
            }
        }
        wood.color = shape.color * 0.66f;
        wood.uvOffset = {dice.unit(), dice.unit()};
        addBeam(wood, {-x - 0.3f, beam - 0.09f, z}, {x + 0.3f, beam - 0.09f, z}, 0.14f, 0.18f, 0.014f);
        const float low = std::max(-shape.waterDepth, -0.5f);
        addBeam(wood, {-x, low, z + 0.13f}, {x, beam - 0.2f, z + 0.13f}, 0.05f, 0.14f, 0.01f);
        addBeam(wood, {x, low, z - 0.13f}, {-x, beam - 0.2f, z - 0.13f}, 0.05f, 0.14f, 0.01f);
    }
}

void addRailing(Part& wood, const PierShape& shape, Dice& dice) {
    const float x = shape.width / 2 - 0.08f;
    const int posts = std::max(2, int(shape.length / 1.7f) + 1);
    for (int i = 0; i < posts; ++i) {
        const float z = -0.1f - (shape.length - 0.2f) * float(i) / float(posts - 1);
        wood.color = shape.color * woodTint(dice, 0.3f) * 0.92f;
        wood.uvOffset = {dice.unit(), dice.unit()};
        addStandingBox(wood, Frame{}.at({x, shape.deckHeight - 0.15f, z}).turned(dice.range(-0.02f, 0.02f)),
                       {0.09f, 1.15f, 0.09f}, 0.012f);
    }
    for (const float y : {0.45f, 0.75f, 1.02f}) {
        wood.color = shape.color * woodTint(dice, 0.3f);
        wood.uvOffset = {dice.unit(), dice.unit()};
        const float out = y > 1 ? 0.0f : -0.06f, wide = y > 1 ? 0.13f : 0.03f, high = y > 1 ? 0.035f : 0.11f;
        addBeam(wood, {x + out, shape.deckHeight + y, 0.02f}, {x + out, shape.deckHeight + y, -shape.length - 0.02f},
                wide, high, 0.008f);
    }
}

void addLadder(Part& steel, const PierShape& shape) {
    const float x = -shape.width / 2 - 0.06f, z = -shape.length * 0.6f, bottom = std::max(-shape.waterDepth, -1.4f);
    steel.color = {1, 1, 1};
    for (const float s : {-0.21f, 0.21f})
        addCylinder(steel, Frame{}.at({x - 0.12f, bottom, z + s}), 0.02f, shape.deckHeight + 0.8f - bottom, 0.01f, 10);
    for (float y = bottom + 0.15f; y < shape.deckHeight; y += 0.28f)
        addBeam(steel, {x - 0.12f, y, z - 0.21f}, {x - 0.12f, y, z + 0.21f}, 0.035f, 0.022f, 0.006f);
    for (const float s : {-0.21f, 0.21f})
        addBeam(steel, {x - 0.12f, shape.deckHeight + 0.78f, z + s}, {x + 0.2f, shape.deckHeight + 0.78f, z + s},
                0.035f, 0.035f, 0.01f);
    for (const float s : {-0.21f, 0.21f})
        addBeam(steel, {x + 0.2f, shape.deckHeight, z + s}, {x + 0.2f, shape.deckHeight + 0.79f, z + s}, 0.035f, 0.035f,
                0.01f);
}

void addProps(ModelBuilder& builder, const Palette& palette, const PierShape& shape, Dice& dice) {
    // Along the open side and towards the end, out of the walkway.
    for (int i = 0; i < shape.props; ++i) {
        const float along = shape.length * (0.3f + 0.66f * (float(i) + dice.range(0.2f, 0.8f)) / float(shape.props));
        const float side = (shape.railing && dice.chance(0.6f)) ? 1.0f : -1.0f;
        const Frame base =
            Frame{}.at({side * (shape.width / 2 - 0.48f), shape.deckHeight, -along}).turned(dice.range(-0.3f, 0.3f));
        if (dice.chance(0.5f)) {
            addBarrel(builder, palette, base, 0.85f * dice.range(0.9f, 1.1f), dice);
        } else {
            const float s = dice.range(0.5f, 0.68f);
            addCrate(builder, palette, base, {s * 1.15f, s * 0.85f, s}, dice);
            if (dice.chance(0.4f))
                addCrate(builder, palette, base.at({0.02f, s * 0.85f, 0}).turned(dice.range(-0.4f, 0.4f)),
                         {s * 0.7f, s * 0.55f, s * 0.7f}, dice);
        }
    }
}

}  // namespace

Result<Model> makePier(const PierShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("pier");
    Dice dice(shape.seed * 19 + 3);
    Palette palette;
    palette.wood = builder.addMaterial("wood", {1.0f, 1.0f, 1.0f}, makeWood(shape.seed));
    palette.darkMetal = builder.addMaterial("iron", {0.06f, 0.058f, 0.055f}, 0.55f, 0.6f);
    palette.steel = builder.addMaterial("steel", {0.5f, 0.51f, 0.52f}, 0.35f, 1);
    palette.paint = builder.addMaterial("rope", {1, 1, 1}, 0.9f);
    builder.beginNode("deck");
    addDeck(builder.part(palette.wood), shape, dice);
    builder.beginNode("piles");
    addPiles(builder, palette, shape, dice);
    addLadder(builder.part(palette.steel), shape);
    builder.beginNode("railing");
    if (shape.railing) addRailing(builder.part(palette.wood), shape, dice);
    builder.beginNode("props");
    addProps(builder, palette, shape, dice);
    return builder.finish();
}

}  // namespace shoal::scene
