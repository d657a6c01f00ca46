// A row of town houses: plastered fronts with windows, shutters, doors and shops under tiled roofs.
#include <algorithm>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr float kGroundFloor = 3.7f, kUpperFloor = 3.15f, kReveal = 0.2f, kEaves = 0.45f, kRoofPitch = 0.5f;

struct Row {
    ModelBuilder& builder;
    int plaster = -1, stone = -1, tiles = -1, paint = -1, glass = -1;
    int wallKind = 0;
};

struct Opening {
    float x0, x1, y0, y1;
    enum Kind { window, door, shop } kind;
};

// A flat rectangle from corner a along the two edges; texture in metres from the row's origin, so that neighbours
// match.
void addPatch(Part& part, Vec3 a, Vec3 edgeU, Vec3 edgeV, Vec3 normal, Vec3 colorLow, Vec3 colorHigh) {
    const Vec3 u = normalize(edgeU), v = normalize(edgeV);
    const auto corner = [&](float s, float t) {
        const Vec3 p = a + edgeU * s + edgeV * t;
        part.color = t > 0.5f ? colorHigh : colorLow;
        return part.add(
            {p,
             normal,
             u,
             {dot(p, u) * part.uvPerMetre + part.uvOffset.x, -dot(p, v) * part.uvPerMetre + part.uvOffset.y}});
    };
    const std::uint32_t c[4] = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    part.quad(c[0], c[1], c[2], c[3], normal);
}

// Rain and dirt: darker near the street and just under the eaves.
Vec3 weathered(Vec3 color, float y, float top) {
    return color * (0.62f + 0.38f * smoothstep(0.0f, 1.1f, y)) * (1 - 0.22f * smoothstep(top - 0.9f, top, y));
}

// The front: everything but the openings, as one grid, so that no cracks open between its pieces.
void addFront(Part& part, Vec3 foot, float width, float top, const std::vector<Opening>& openings, Vec3 color) {
    std::vector<float> xs{0, width}, ys{0, 0.35f, 1.1f, top - 0.9f, top};
    for (const Opening& o : openings) xs.insert(xs.end(), {o.x0, o.x1}), ys.insert(ys.end(), {o.y0, o.y1});
    for (std::vector<float>* breaks : {&xs, &ys}) {
        std::sort(breaks->begin(), breaks->end());
        breaks->erase(std::unique(breaks->begin(), breaks->end(), [](float a, float b) { return b - a < 1e-4f; }),
                      breaks->end());
    }
    for (std::size_t i = 0; i + 1 < xs.size(); ++i)
        for (std::size_t k = 0; k + 1 < ys.size(); ++k) {
            const float x = (xs[i] + xs[i + 1]) / 2, y = (ys[k] + ys[k + 1]) / 2;
            const bool open = std::any_of(openings.begin(), openings.end(), [&](const Opening& o) {
                return x > o.x0 && x < o.x1 && y > o.y0 && y < o.y1;
            });
            if (open) continue;
            addPatch(part, foot + Vec3{xs[i], ys[k], 0}, {xs[i + 1] - xs[i], 0, 0}, {0, ys[k + 1] - ys[k], 0},
                     {0, 0, 1}, weathered(color, ys[k], top), weathered(color, ys[k + 1], top));
        }
}

void addReveal(Part& part, Vec3 a, Vec3 b, Vec3 color) {
    const Vec3 in{0, 0, -kReveal}, size = b - a, lit = color * 0.9f;
    addPatch(part, a, in, {0, size.y, 0}, {1, 0, 0}, lit, lit);
    addPatch(part, {b.x, a.y, a.z}, in, {0, size.y, 0}, {-1, 0, 0}, lit, lit);
    addPatch(part, a, {size.x, 0, 0}, in, {0, 1, 0}, lit, lit);
    addPatch(part, {a.x, b.y, a.z}, {size.x, 0, 0}, in, {0, -1, 0}, lit, lit);
}

// A leaf of a shutter flat on the wall: frame and slats.
void addShutter(Part& paint, Vec3 center, float width, float height, Vec3 color) {
    const Frame frame = Frame{}.at(center);
    paint.color = color;
    for (const float s : {-1.0f, 1.0f}) {
        addBox(paint, frame.at({s * (width / 2 - 0.035f), 0, 0.03f}), {0.035f, height / 2, 0.02f}, 0.005f);
        addBox(paint, frame.at({0, s * (height / 2 - 0.04f), 0.03f}), {width / 2 - 0.07f, 0.04f, 0.02f}, 0.005f);
    }
    const int slats = std::max(4, int(height / 0.11f));
    for (int i = 0; i < slats; ++i) {
        const float y = (height - 0.16f) * ((float(i) + 0.5f) / float(slats) - 0.5f);
        paint.color = color * 0.92f;
        addBox(paint, frame.at({0, y, 0.026f}).tipped({1, 0, 0}, 0.5f), {width / 2 - 0.07f, 0.05f, 0.006f}, 0);
    }
}

void addWindow(Row& row, Vec3 foot, const Opening& o, Vec3 wall, Vec3 shutter, bool shutters, Dice& dice) {
    const Vec3 a = foot + Vec3{o.x0, o.y0, 0}, b = foot + Vec3{o.x1, o.y1, 0};
    const Vec3 middle = (a + b) * 0.5f;
    const float width = b.x - a.x, height = b.y - a.y;
    addReveal(row.builder.part(row.plaster), a, b, wall);
    Part& glass = row.builder.part(row.glass);
    const float blind = dice.chance(0.35f) ? dice.range(0.3f, 0.9f) : 0.0f;  // curtains seen through some panes
    glass.color = lerp(Vec3{0.016f, 0.018f, 0.02f}, Vec3{0.17f, 0.16f, 0.14f}, blind);
    addBox(glass, Frame{}.at({middle.x, middle.y, a.z - kReveal}).tipped({0, 1, 0}, dice.range(-0.012f, 0.012f)),
           {width / 2, height / 2, 0.01f}, 0);
    Part& paint = row.builder.part(row.paint);
    paint.color = {0.62f, 0.60f, 0.55f};
    const float z = a.z - kReveal + 0.03f;
    for (const float s : {-1.0f, 1.0f}) {
        addBox(paint, Frame{}.at({middle.x + s * (width / 2 - 0.03f), middle.y, z}), {0.03f, height / 2, 0.03f},
               0.006f);
        addBox(paint, Frame{}.at({middle.x, middle.y + s * (height / 2 - 0.03f), z}), {width / 2 - 0.06f, 0.03f, 0.03f},
               0.006f);
    }
    addBox(paint, Frame{}.at({middle.x, middle.y, z}), {0.03f, height / 2 - 0.06f, 0.028f}, 0.006f);
    for (const float t : {0.33f, 0.66f})
        addBox(paint, Frame{}.at({middle.x, a.y + height * t, z - 0.005f}), {width / 2 - 0.06f, 0.014f, 0.02f}, 0.004f);
    Part& stone = row.builder.part(row.stone);
    stone.color = Vec3{1.25f, 1.2f, 1.1f} * dice.range(0.9f, 1.05f);
    stone.uvOffset = {dice.unit(), dice.unit()};
    addBox(stone, Frame{}.at({middle.x, a.y - 0.05f, a.z}), {width / 2 + 0.14f, 0.05f, 0.13f}, 0.012f);
    addBox(stone, Frame{}.at({middle.x, b.y + 0.09f, a.z}), {width / 2 + 0.12f, 0.09f, 0.035f}, 0.01f);
    for (const float s : {-1.0f, 1.0f})
        addBox(stone, Frame{}.at({middle.x + s * (width / 2 + 0.05f), middle.y, a.z}), {0.05f, height / 2, 0.025f},
               0.008f);
    if (!shutters) return;
    for (const float s : {-1.0f, 1.0f})
        addShutter(paint, {middle.x + s * (width * 0.75f + 0.11f), middle.y, a.z}, width / 2 + 0.02f, height, shutter);
}

void addDoor(Row& row, Vec3 foot, const Opening& o, Vec3 wall, Vec3 color, Dice& dice) {
    const Vec3 a = foot + Vec3{o.x0, o.y0, 0}, b = foot + Vec3{o.x1, o.y1, 0};
    const float x = (a.x + b.x) / 2, width = b.x - a.x, height = b.y - a.y, z = a.z - kReveal;
    addReveal(row.builder.part(row.plaster), a, b, wall);
    Part& paint = row.builder.part(row.paint);
    paint.color = color * 0.8f;
    const float leaf = height - 0.5f;
    addBox(paint, Frame{}.at({x, a.y + leaf / 2, z}), {width / 2, leaf / 2, 0.03f}, 0.004f);
    for (const float s : {-1.0f, 1.0f})
        for (const float t : {0.28f, 0.72f}) {
            paint.color = color;
            addBox(paint, Frame{}.at({x + s * width * 0.23f, a.y + leaf * t, z + 0.035f}),
                   {width * 0.17f, leaf * 0.17f, 0.015f}, 0.012f);
        }
    row.builder.part(row.glass).color = {0.016f, 0.018f, 0.02f};
    addBox(row.builder.part(row.glass), Frame{}.at({x, b.y - 0.24f, z}), {width / 2, 0.24f, 0.01f}, 0);
    paint.color = color;
    addBox(paint, Frame{}.at({x, b.y - 0.5f, z + 0.02f}), {width / 2, 0.04f, 0.04f}, 0.006f);
    Part& stone = row.builder.part(row.stone);
    stone.color = Vec3{1.25f, 1.2f, 1.1f} * dice.range(0.9f, 1.05f);
    for (const float s : {-1.0f, 1.0f})
        addBox(stone, Frame{}.at({x + s * (width / 2 + 0.09f), a.y + height / 2, a.z}), {0.09f, height / 2, 0.05f},
               0.012f);
    addBox(stone, Frame{}.at({x, b.y + 0.11f, a.z}), {width / 2 + 0.24f, 0.11f, 0.08f}, 0.015f);
    addStandingBox(stone, Frame{}.at({x, a.y - 0.02f, a.z + 0.1f}), {width + 0.36f, 0.14f, 0.5f}, 0.015f);
}

// A shop: wide window over a panelled base, and a striped awning.
void addShop(Row& row, Vec3 foot, const Opening& o, Vec3 wall, Vec3 color, Dice& dice) {
    const Vec3 a = foot + Vec3{o.x0, o.y0, 0}, b = foot + Vec3{o.x1, o.y1, 0};
    const float x = (a.x + b.x) / 2, width = b.x - a.x, height = b.y - a.y, z = a.z - kReveal;
    addReveal(row.builder.part(row.plaster), a, b, wall);
    Part& glass = row.builder.part(row.glass);
    glass.color = {0.035f, 0.03f, 0.025f};
    addBox(glass, Frame{}.at({x, a.y + height / 2, z}), {width / 2, height / 2, 0.01f}, 0);
    Part& paint = row.builder.part(row.paint);
    paint.color = color;
    addBox(paint, Frame{}.at({x, a.y + 0.3f, z + 0.05f}), {width / 2, 0.3f, 0.05f}, 0.01f);
    const int panes = std::max(2, int(width / 0.9f));
    for (int i = 0; i <= panes; ++i)
        addBox(paint, Frame{}.at({a.x + width * float(i) / float(panes), a.y + height / 2, z + 0.04f}),
               {0.04f, height / 2, 0.04f}, 0.008f);
    addBox(paint, Frame{}.at({x, b.y - 0.05f, z + 0.05f}), {width / 2, 0.05f, 0.05f}, 0.008f);
    addBox(paint, Frame{}.at({x, b.y + 0.28f, a.z + 0.04f}), {width / 2 + 0.15f, 0.2f, 0.05f},
           0.015f);  // the sign's board
    const Vec3 cloth = dice.chance(0.5f) ? Vec3{0.50f, 0.07f, 0.05f} : Vec3{0.07f, 0.20f, 0.16f};
    const int stripes = std::max(4, int(width / 0.28f));
    const float step = (width + 0.3f) / float(stripes), out = 1.25f, drop = 0.5f;
    for (int i = 0; i < stripes; ++i) {
        paint.color = i % 2 ? Vec3{0.78f, 0.74f, 0.66f} : cloth;
        const float at = a.x - 0.15f + step * (float(i) + 0.5f);
        addBeam(paint, {at, b.y + 0.05f, a.z + 0.05f}, {at, b.y + 0.05f - drop, a.z + out}, step, 0.015f, 0);
        addBox(paint, Frame{}.at({at, b.y - drop - 0.06f, a.z + out}), {step / 2, 0.1f, 0.008f}, 0);
    }
}

// Both slopes with their rows of tiles, the gables between them, a gutter and chimneys.
void addRoof(Row& row, Vec3 foot, float width, float depth, float top, Vec3 wall, Dice& dice) {
    Part& tiles = row.builder.part(row.tiles);
    const float ridge = top + kRoofPitch * depth / 2, low = top - kRoofPitch * kEaves;
    const Vec3 tint = lerp(Vec3{1, 1, 1}, Vec3{0.82f, 0.86f, 0.84f}, dice.unit()) * dice.range(0.82f, 1.08f);
    tiles.uvOffset = {dice.unit(), 0};
    const Vec3 crest = foot + Vec3{-0.06f, ridge + 0.1f, -depth / 2};
    for (const float s : {1.0f, -1.0f}) {
        const Vec3 eave{crest.x, low + 0.1f, foot.z - depth / 2 + s * (depth / 2 + kEaves)};
        const Vec3 normal = normalize(Vec3{0, 1, s * kRoofPitch});
        addPatch(tiles, eave, {width + 0.12f, 0, 0}, crest - eave, normal, tint * 0.92f, tint);
        tiles.color = tint * 0.8f;
        const Vec3 along{width + 0.12f, 0, 0};
        addPatch(tiles, eave - Vec3{0, 0.14f, 0}, along, {0, 0.14f, 0}, {0, 0, s}, tint * 0.5f, tint * 0.6f);
        for (const float e : {0.0f, 1.0f})  // verges
            addPatch(tiles, eave + along * e - Vec3{0, 0.16f, 0}, crest - eave, {0, 0.16f, 0},
                     {e > 0 ? 1.0f : -1.0f, 0, 0}, tint * 0.6f, tint * 0.6f);
        Part& plaster = row.builder.part(row.plaster);
        addPatch(plaster, eave - Vec3{0, 0.14f, 0}, along, {0, 0, -s * kEaves}, {0, -1, 0}, wall * 0.7f, wall * 0.7f);
        Part& paint = row.builder.part(row.paint);
        paint.color = {0.09f, 0.08f, 0.07f};
        addBeam(paint, eave + Vec3{0, -0.03f, s * 0.05f}, eave + along + Vec3{0, -0.03f, s * 0.05f}, 0.11f, 0.09f,
                0.03f);
    }
    tiles.color = tint * 1.05f;
    addBeam(tiles, crest + Vec3{0, 0.02f, 0}, crest + Vec3{width + 0.12f, 0.02f, 0}, 0.28f, 0.12f, 0.05f);
    Part& plaster = row.builder.part(row.plaster);
    for (const float side : {0.0f, width}) {  // gables
        const Vec3 normal{side > 0 ? 1.0f : -1.0f, 0, 0};
        plaster.color = wall * 0.9f;
        const auto corner = [&](float y, float z) {
            return plaster.add(
                {foot + Vec3{side, y, z}, normal, {0, 0, 1}, {z * plaster.uvPerMetre, -y * plaster.uvPerMetre}});
        };
        const std::uint32_t v[3] = {corner(top, 0), corner(top, -depth), corner(ridge, -depth / 2)};
        plaster.triangle(v[0], v[1], v[2], normal);
    }
    const int chimneys = 1 + dice.below(2);
    for (int i = 0; i < chimneys; ++i) {
        const float x = width * dice.range(0.12f, 0.88f), z = -depth * dice.range(0.28f, 0.6f),
                    high = ridge + dice.range(0.3f, 0.8f);
        plaster.color = wall * 0.85f;
        addStandingBox(plaster, Frame{}.at(foot + Vec3{x, top, z}), {0.75f, high - top, 0.5f}, 0.02f);
        tiles.color = tint * 0.9f;
        addStandingBox(tiles, Frame{}.at(foot + Vec3{x, high, z}), {0.9f, 0.09f, 0.62f}, 0.02f);
        for (const float s : {-0.18f, 0.18f})
            addCylinder(tiles, Frame{}.at(foot + Vec3{x + s, high + 0.09f, z}), 0.1f, 0.32f, 0.02f, 12);
    }
}

void addHouse(Row& row, const HousesShape& shape, Vec3 foot, float width, Dice& dice) {
    const Vec3 walls[] = {{0.80f, 0.56f, 0.27f}, {0.86f, 0.74f, 0.52f}, {0.68f, 0.36f, 0.24f}, {0.80f, 0.56f, 0.46f},
                          {0.62f, 0.62f, 0.50f}, {0.88f, 0.82f, 0.70f}, {0.74f, 0.46f, 0.20f}};
    const Vec3 paints[] = {{0.04f, 0.10f, 0.07f},
                           {0.08f, 0.13f, 0.18f},
                           {0.13f, 0.06f, 0.035f},
                           {0.12f, 0.16f, 0.12f},
                           {0.26f, 0.25f, 0.22f}};
    row.wallKind = (row.wallKind + 1 + dice.below(6)) % 7;  // never the neighbour's
    const Vec3 wall = walls[row.wallKind] * dice.range(0.9f, 1.05f), shutter = paints[dice.below(5)],
               doorColor = paints[dice.below(5)];
    const int floors = std::max(1, shape.floors - dice.below(2));
    const float top = kGroundFloor + kUpperFloor * float(floors - 1) + 0.5f + dice.range(0, 0.5f), depth = shape.depth;
    const int columns = std::max(1, int((width - 0.8f) / 2.15f));
    const float step = width / float(columns), half = dice.range(0.46f, 0.56f);
    const bool shutters = dice.chance(0.75f), shop = shape.shops && columns > 1 && dice.chance(0.6f);
    const int doorColumn = dice.below(columns);
    std::vector<Opening> openings;
    for (int c = 0; c < columns; ++c) {
        const float x = step * (float(c) + 0.5f);
        if (c == doorColumn)
            openings.push_back({x - 0.62f, x + 0.62f, 0, 2.85f, Opening::door});
        else if (shop)
            openings.push_back({x - 0.5f * step + 0.22f, x + 0.5f * step - 0.22f, 0.05f, 2.75f, Opening::shop});
        else
            openings.push_back({x - half, x + half, 1.05f, 2.75f, Opening::window});
        for (int f = 1; f < floors; ++f) {
            const float sill = kGroundFloor + kUpperFloor * float(f - 1) + 0.95f;
            openings.push_back(
                {x - half, x + half, sill, sill + (f + 1 == floors && f > 1 ? 1.35f : 1.7f), Opening::window});
        }
    }
    Part& plaster = row.builder.part(row.plaster);
    plaster.uvOffset = {dice.unit(), dice.unit()};
    addFront(plaster, foot, width, top, openings, wall);
    // Sides and back, plain.
    addPatch(plaster, foot, {0, 0, -depth}, {0, top, 0}, {-1, 0, 0}, wall * 0.75f, wall);
    addPatch(plaster, foot + Vec3{width, 0, 0}, {0, 0, -depth}, {0, top, 0}, {1, 0, 0}, wall * 0.75f, wall);
    addPatch(plaster, foot + Vec3{0, 0, -depth}, {width, 0, 0}, {0, top, 0}, {0, 0, -1}, wall * 0.75f, wall);
    for (const Opening& o : openings) {
        if (o.kind == Opening::door)
            addDoor(row, foot, o, wall, doorColor, dice);
        else if (o.kind == Opening::shop)
            addShop(row, foot, o, wall, doorColor, dice);
        else
            addWindow(row, foot, o, wall, shutter, shutters && o.y0 > 2, dice);
    }
    Part& stone = row.builder.part(row.stone);
    stone.color = Vec3{1.2f, 1.14f, 1.04f} * dice.range(0.9f, 1.05f);
    const auto band = [&](float y, float half, float out) {
        addBox(stone, Frame{}.at(foot + Vec3{width / 2, y, 0}), {width / 2 - 0.01f, half, out}, 0.02f);
    };
    band(kGroundFloor - 0.05f, 0.09f, 0.07f);
    band(top - 0.12f, 0.12f, 0.16f);  // cornice
    band(top - 0.3f, 0.05f, 0.07f);
    addRoof(row, foot, width, depth, top, wall, dice);
}

// A square bell tower: shaft, belfry with arches cut dark, pyramid of tiles.
void addTower(Row& row, Vec3 foot, float height, Dice& dice) {
    const float half = 2.1f;
    Part& plaster = row.builder.part(row.plaster);
    Part& stone = row.builder.part(row.stone);
    Part& glass = row.builder.part(row.glass);
    const Vec3 wall = Vec3{0.86f, 0.74f, 0.54f} * dice.range(0.95f, 1.05f);
    const Frame base = Frame{}.at(foot);
    plaster.color = wall;
    addStandingBox(plaster, base, {2 * half, height, 2 * half}, 0.03f);
    stone.color = {1.25f, 1.18f, 1.08f};
    for (const float y : {0.0f, height * 0.45f, height - 4.6f, height - 0.1f})
        addStandingBox(stone, base.at({0, y, 0}), {2 * half + 0.4f, y > 0 ? 0.3f : 1.0f, 2 * half + 0.4f}, 0.05f);
    glass.color = {0.012f, 0.011f, 0.01f};
    for (int side = 0; side < 4; ++side) {
        const Frame face = base.turned(float(side) * kPi / 2).at({0, 0, half});
        for (const float x : {-0.8f, 0.8f}) {
            addBox(glass, face.at({x, height - 2.6f, 0.005f}), {0.48f, 1.1f, 0.01f}, 0);
            addCylinder(glass, face.at({x, height - 1.5f, -0.004f}).tipped({1, 0, 0}, kPi / 2), 0.48f, 0.018f, 0, 32);
            addBox(stone, face.at({x, height - 3.78f, 0.05f}), {0.62f, 0.09f, 0.12f}, 0.02f);
        }
        addBox(glass, face.at({0, height * 0.3f, 0.005f}), {0.22f, 0.7f, 0.01f}, 0);
    }
    Part& tiles = row.builder.part(row.tiles);
    const float eave = half + 0.45f, y0 = height + 0.18f, rise = 3.4f;
    for (int side = 0; side < 4; ++side) {
        const Frame face = base.turned(float(side) * kPi / 2);
        const Vec3 normal = face.direction(normalize(Vec3{0, eave, rise})), along = face.x;
        tiles.color = {0.95f, 0.95f, 0.95f};
        const auto corner = [&](Vec3 p, Vec2 uv) {
            return tiles.add({face.point(p), normal, along, {uv.x * tiles.uvPerMetre, uv.y * tiles.uvPerMetre}});
        };
        const std::uint32_t v[3] = {corner({-eave, y0, eave}, {-eave, 0}), corner({eave, y0, eave}, {eave, 0}),
                                    corner({0, y0 + rise, 0}, {0, -std::hypot(eave, rise)})};
        tiles.triangle(v[0], v[1], v[2], normal);
    }
    addStandingBox(tiles, base.at({0, y0 - 0.12f, 0}), {2 * eave, 0.119f, 2 * eave}, 0.02f);
    row.builder.part(row.paint).color = {0.06f, 0.055f, 0.05f};
    addCylinder(row.builder.part(row.paint), base.at({0, y0 + rise - 0.1f, 0}), 0.04f, 1.2f, 0.01f, 10);
    addSphere(row.builder.part(row.paint), base.at({0, y0 + rise + 0.45f, 0}), 0.14f, 16);
}

}  // namespace

Result<Model> makeHouses(const HousesShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("houses");
    Dice dice(shape.seed * 61 + 13);
    Row row{builder};
    row.plaster = builder.addMaterial("plaster", {1, 1, 1}, makePlaster(shape.seed));
    row.stone = builder.addMaterial("stone", {1, 1, 1}, makeStone(shape.seed));
    row.tiles = builder.addMaterial("roof tiles", {1, 1, 1}, makeRoofTiles(shape.seed));
    row.paint = builder.addMaterial("paint", {1, 1, 1}, 0.55f);
    row.glass = builder.addMaterial("panes", {1, 1, 1}, 0.06f);
    float left = shape.length;
    for (Vec3 foot{-shape.length / 2, 0, 0}; left > 0.01f;) {
        float width = shape.houseWidth * dice.range(0.75f, 1.3f);
        if (left - width < 0.6f * shape.houseWidth) width = left;
        builder.beginNode("house");
        addHouse(row, shape, foot + Vec3{0, 0, dice.range(-0.25f, 0.0f)}, width, dice);
        foot.x += width, left -= width;
    }
    if (shape.tower) {
        builder.beginNode("tower");
        const float height = kGroundFloor + kUpperFloor * float(shape.floors + 2) + 1;
        addTower(row, {shape.length * dice.range(-0.15f, 0.15f), 0, -shape.depth - 2.5f}, height, dice);
    }
    return builder.finish();
}

}  // namespace shoal::scene
