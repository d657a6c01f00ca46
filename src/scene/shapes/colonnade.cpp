// A covered walk: a row of columns that carry a beam and a lean-to roof, with a wall behind.
#include <algorithm>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr float kBeam = 0.42f, kRise = 0.35f, kEaves = 0.35f;

// Plinth, torus base, shaft with entasis, capital: Tuscan proportions.
void addColumn(Part& stone, Vec3 foot, float height, Dice& dice) {
    const float r = height / 13;
    stone.color = Vec3{1.0f, 0.95f, 0.87f} * dice.range(0.92f, 1.0f);
    stone.uvOffset = {dice.unit(), dice.unit()};
    addStandingBox(stone, Frame{}.at(foot), {2.9f * r, 0.5f * r, 2.9f * r}, 0.015f);
    addStandingBox(stone, Frame{}.at(foot + Vec3{0, height - 0.4f * r, 0}), {2.7f * r, 0.4f * r, 2.7f * r}, 0.015f);
    std::vector<Vec2> profile;
    for (int i = 0; i <= 8; ++i) {
        const float a = kPi * (float(i) / 8 - 0.5f);
        profile.push_back({r * (1.12f + 0.25f * std::cos(a)), r * (0.75f + 0.25f * std::sin(a))});
    }
    profile.push_back({r * 1.06f, r * 1.05f});
    profile.push_back({r, r * 1.2f});
    const float low = 1.2f * r, high = height - 1.5f * r;
    for (int i = 1; i <= 10; ++i) {
        const float t = float(i) / 10;
        profile.push_back({r * (1 - 0.16f * t * t), mix(low, high, t)});
    }
    for (const Vec2 p : {Vec2{0.95f, 0.02f}, Vec2{0.97f, 0.1f}, Vec2{0.86f, 0.16f}, Vec2{0.86f, 0.55f},
                         Vec2{1.0f, 0.62f}, Vec2{1.18f, 0.8f}, Vec2{1.25f, 1.0f}, Vec2{1.25f, 1.12f}})
        profile.push_back({r * p.x, high + r * p.y});
    addLathe(stone, Frame{}.at(foot), profile, 36);
}

void addLeanTo(ModelBuilder& builder, const ColonnadeShape& shape, int tiles, int wood) {
    const float low = shape.height + kBeam, half = shape.length / 2 + 0.3f, back = -shape.depth - 0.2f;
    const Vec3 eave{-half, low - kRise * kEaves, kEaves + 0.2f}, head{-half, low + kRise * (0.2f - back), back};
    const Vec3 slope = head - eave, along{1, 0, 0}, normal = normalize(cross(along, slope * -1.0f));
    Part& cover = builder.part(tiles);
    cover.color = {0.92f, 0.92f, 0.92f};
    const Vec3 n = normal.y > 0 ? normal : normal * -1.0f, middle = (eave + head) * 0.5f + along * half;
    const Vec3 down = normalize(eave - head);
    addSheet(cover, Frame{middle + n * 0.13f, along, n, down}, half, length(slope) / 2);
    Part& board = builder.part(wood);
    board.color = {0.75f, 0.62f, 0.5f};
    addBox(board, Frame{middle + n * 0.06f, along, n, down}, {half, 0.06f, length(slope) / 2}, 0.004f);
    const int rafters = std::max(2, int(shape.length / 0.8f));
    for (int i = 0; i <= rafters; ++i) {
        const Vec3 at = along * (0.1f + (2 * half - 0.2f) * float(i) / float(rafters)) - n * 0.06f;
        addBeam(board, eave + at, head + at, 0.1f, 0.12f, 0.01f, n);
    }
}

}  // namespace

Result<Model> makeColonnade(const ColonnadeShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("colonnade");
    Dice dice(shape.seed * 71 + 3);
    const int stone = builder.addMaterial("stone", {1, 1, 1}, makeStone(shape.seed));
    const int plaster = builder.addMaterial("plaster", {1, 1, 1}, makePlaster(shape.seed));
    const int tiles = builder.addMaterial("roof tiles", {1, 1, 1}, makeRoofTiles(shape.seed));
    const int wood = builder.addMaterial("wood", {1, 1, 1}, makeWood(shape.seed));
    builder.beginNode("columns");
    const int bays = std::max(1, int(std::round(shape.length / shape.spacing)));
    const float step = shape.length / float(bays);
    Part& part = builder.part(stone);
    for (int i = 0; i <= bays; ++i) addColumn(part, {-shape.length / 2 + step * float(i), 0, 0}, shape.height, dice);
    for (int i = 0; i < bays; ++i) {  // the beam, a block a bay
        part.color = Vec3{1.0f, 0.96f, 0.89f} * dice.range(0.9f, 1.0f);
        part.uvOffset = {dice.unit(), dice.unit()};
        const Frame at = Frame{}.at({-shape.length / 2 + step * (float(i) + 0.5f), shape.height, 0});
        addStandingBox(part, at, {step - 0.006f, kBeam * 0.62f, 0.4f}, 0.012f);
        addStandingBox(part, at.at({0, kBeam * 0.62f, 0}), {step - 0.004f, kBeam * 0.38f, 0.54f}, 0.02f);
    }
    if (shape.wall) {
        builder.beginNode("wall");
        const float top = shape.height + kBeam + kRise * shape.depth;
        const Frame back = Frame{}.at({0, 0, -shape.depth - 0.2f});
        builder.part(plaster).color = shape.color;
        addStandingBox(builder.part(plaster), back, {shape.length + 0.5f, top + 0.5f, 0.4f}, 0.02f);
        Part& skirting = builder.part(stone);
        skirting.color = {0.9f, 0.86f, 0.8f};
        addStandingBox(skirting, back, {shape.length + 0.52f, 0.7f, 0.46f}, 0.02f);
        addStandingBox(skirting, back.at({0, top + 0.5f, 0}), {shape.length + 0.7f, 0.1f, 0.6f}, 0.02f);
    }
    builder.beginNode("roof");
    if (shape.roof) addLeanTo(builder, shape, tiles, wood);
    return builder.finish();
}

}  // namespace shoal::scene
