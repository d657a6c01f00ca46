// A stone quay.
#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr float kCoping = 0.3f, kCopingDepth = 0.75f, kOverhang = 0.06f, kStairWidth = 1.1f;
constexpr float kStairsStart = 0.12f;  // of the length, from the middle

// Stones darken and turn green towards the water, and are dark below it.
Vec3 stoneTint(float y, Dice& dice) {
    const Vec3 dry = lerp(Vec3{0.95f, 0.84f, 0.70f}, Vec3{0.70f, 0.72f, 0.74f}, dice.unit()) * dice.range(0.62f, 1.1f);
    const Vec3 wet = Vec3{0.36f, 0.40f, 0.30f} * dice.range(0.8f, 1.15f);
    return lerp(wet, dry, smoothstep(0.0f, 0.55f, y + dice.range(-0.1f, 0.1f)));
}

void addWall(ModelBuilder& builder, const QuayShape& shape, int stone, int mortar, Dice& dice) {
    const float top = shape.height - kCoping, bottom = -shape.waterDepth;
    builder.part(mortar).color = {0.45f, 0.45f, 0.42f};
    addBox(builder.part(mortar), Frame{}.at({0, (top + bottom) / 2, -0.3f}),
           {shape.length / 2 - 0.02f, (top - bottom) / 2, 0.27f}, 0);
    const int courses = std::max(1, int(std::round((top - bottom) / shape.blockHeight)));
    const float height = (top - bottom) / float(courses);
    Part& part = builder.part(stone);
    for (int course = 0; course < courses; ++course) {
        const float y = bottom + height * (float(course) + 0.5f);
        for (float x = -shape.length / 2; x < shape.length / 2 - 0.01f;) {
            float width = height * dice.range(1.3f, 2.5f);
            if (x + width > shape.length / 2 - 0.5f * height) width = shape.length / 2 - x;
            part.color = stoneTint(y, dice);
            part.uvOffset = {dice.unit(), dice.unit()};
            const float proud = dice.range(0, 0.025f);
            addBox(part, Frame{}.at({x + width / 2, y, -0.15f + proud}).tipped({0, 1, 0}, dice.range(-0.006f, 0.006f)),
                   {width / 2 - 0.006f, height / 2 - 0.006f, 0.15f}, 0.022f);
            x += width;
        }
    }
    for (float x = -shape.length / 2; x < shape.length / 2 - 0.01f;) {  // coping
        float width = dice.range(1.0f, 1.6f);
        if (x + width > shape.length / 2 - 0.5f) width = shape.length / 2 - x;
        part.color = Vec3{0.95f, 0.92f, 0.87f} * dice.range(0.85f, 1.08f);
        part.uvOffset = {dice.unit(), dice.unit()};
        addBox(part, Frame{}.at({x + width / 2, shape.height - kCoping / 2, kOverhang - kCopingDepth / 2}),
               {width / 2 - 0.004f, kCoping / 2, kCopingDepth / 2}, 0.03f);
        x += width;
    }
}

// Rows of slabs of uneven length behind the coping.
void addPavement(ModelBuilder& builder, const QuayShape& shape, int stone, int mortar, Dice& dice) {
    const float from = kOverhang - kCopingDepth, depth = shape.width + from;
    if (depth <= 0.1f) return;
    builder.part(mortar).color = {0.5f, 0.48f, 0.44f};
    addBox(builder.part(mortar), Frame{}.at({0, shape.height - 0.17f, from - depth / 2}),
           {shape.length / 2, 0.155f, depth / 2}, 0);
    const int rows = std::max(1, int(depth / 0.55f));
    const float rowDepth = depth / float(rows);
    Part& part = builder.part(stone);
    for (int row = 0; row < rows; ++row)
        for (float x = -shape.length / 2; x < shape.length / 2 - 0.01f;) {
            float width = rowDepth * dice.range(0.9f, 1.9f);
            if (x + width > shape.length / 2 - 0.4f * rowDepth) width = shape.length / 2 - x;
            part.color =
                lerp(Vec3{0.80f, 0.77f, 0.72f}, Vec3{0.66f, 0.66f, 0.66f}, dice.unit()) * dice.range(0.78f, 1.12f);
            part.uvOffset = {dice.unit(), dice.unit()};
            addSlab(part,
                    Frame{}.at({x + width / 2, shape.height - dice.range(0.002f, 0.01f),
                                from - rowDepth * (float(row) + 0.5f)}),
                    width / 2 - 0.004f, rowDepth / 2 - 0.004f, 0.016f);
            x += width;
        }
}

void addStairs(Part& stone, const QuayShape& shape, Dice& dice) {
    const float rise = 0.19f, run = 0.3f;
    const int steps = std::max(1, int((shape.height + std::min(0.5f, shape.waterDepth)) / rise));
    const float start = shape.length * kStairsStart;
    for (int i = 0; i < steps; ++i) {
        const float top = shape.height - rise * float(i + 1),
                    bottom = std::max(-shape.waterDepth, -2.0f - rise * float(i));
        if (top - bottom < 0.05f) break;
        const float x = start + run * (float(i) + 0.5f);
        if (x + run > shape.length / 2) break;
        stone.color = stoneTint(top + 0.1f, dice) * 0.96f;
        stone.uvOffset = {dice.unit(), dice.unit()};
        addBox(stone, Frame{}.at({x, (top + bottom) / 2, kStairWidth / 2 + 0.02f}),
               {run / 2 - 0.003f, (top - bottom) / 2, kStairWidth / 2}, 0.02f);
    }
}

void addFittings(ModelBuilder& builder, const Palette& palette, const QuayShape& shape) {
    for (int i = 0; i < shape.bollards; ++i) {
        const float x = shape.length * ((float(i) + 0.5f) / float(shape.bollards) - 0.5f);
        addBollard(builder, palette, Frame{}.at({x, shape.height, -0.32f}));
        // A rubber fender beside each, but not over the steps.
        if (shape.stairs && x + 1.1f > shape.length * kStairsStart && x + 0.3f < shape.length * kStairsStart + 3)
            continue;
        Part& rubber = builder.part(palette.paint);
        rubber.color = {0.018f, 0.018f, 0.019f};
        const Frame hang = Frame{}.at({x + 0.7f, shape.height - 0.75f, 0.13f}).tipped({1, 0, 0}, kPi / 2);
        std::vector<Vec2> tyre;
        for (int k = 0; k <= 14; ++k) {
            const float a = 2 * kPi * float(k) / 14 - kPi;
            tyre.push_back({0.27f + 0.1f * std::cos(a), 0.1f * std::sin(a)});
        }
        addLathe(rubber, hang, tyre, 28);
        Part& iron = builder.part(palette.darkMetal);
        iron.color = {1, 1, 1};
        for (const float s : {-0.13f, 0.13f})
            addBeam(iron, {x + 0.7f + s, shape.height - 0.55f, 0.12f},
                    {x + 0.7f + s * 0.6f, shape.height - 0.05f, 0.07f}, 0.02f, 0.02f, 0.004f, {0, 0, 1});
    }
}

void addProps(ModelBuilder& builder, const Palette& palette, const QuayShape& shape, Dice& dice) {
    const float deep = std::max(0.2f, shape.width - 2.6f);
    int left = shape.props;
    while (left > 0) {  // in groups, as goods stand on a quay
        const int group = std::min(left, 2 + dice.below(3));
        left -= group;
        const Vec3 middle{dice.range(-0.44f, 0.44f) * shape.length, shape.height, -1.6f - dice.unit() * deep};
        for (int i = 0; i < group; ++i) {
            const float a = 2 * kPi * float(i) / float(group) + dice.range(-0.3f, 0.3f), r = group == 1 ? 0 : 0.68f;
            const Frame base =
                Frame{}.at(middle + Vec3{r * std::cos(a), 0, r * std::sin(a)}).turned(dice.range(-0.5f, 0.5f));
            if (dice.chance(0.45f)) {
                addBarrel(builder, palette, base, dice.range(0.8f, 0.95f), dice);
            } else {
                const float s = dice.range(0.6f, 0.8f);
                addCrate(builder, palette, base, {s * 1.1f, s * 0.85f, s * 0.9f}, dice);
            }
        }
    }
}

}  // namespace

Result<Model> makeQuay(const QuayShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("quay");
    Dice dice(shape.seed * 43 + 3);
    Palette palette;
    palette.stone = builder.addMaterial("stone", {1, 1, 1}, makeStone(shape.seed));
    palette.concrete = builder.addMaterial("mortar", {1, 1, 1}, makeConcrete(shape.seed));
    palette.darkMetal = builder.addMaterial("iron", {0.05f, 0.048f, 0.046f}, 0.5f, 0.5f);
    palette.paint = builder.addMaterial("rubber", {1, 1, 1}, 0.75f);
    if (shape.props > 0) palette.wood = builder.addMaterial("wood", {1, 1, 1}, makeWood(shape.seed));
    builder.beginNode("wall");
    addWall(builder, shape, palette.stone, palette.concrete, dice);
    if (shape.stairs) addStairs(builder.part(palette.stone), shape, dice);
    builder.beginNode("pavement");
    addPavement(builder, shape, palette.stone, palette.concrete, dice);
    builder.beginNode("fittings");
    addFittings(builder, palette, shape);
    builder.beginNode("props");
    addProps(builder, palette, shape, dice);
    return builder.finish();
}

}  // namespace shoal::scene
