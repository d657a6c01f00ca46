// An open tank for water: tiled basin with a stone rim, or glass panes in a steel frame.
#include <array>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"

namespace shoal::scene {
namespace {

using namespace shapes;

// A rectangle of tiles that begin in its corner.
void addTiles(Part& part, const Frame& middle, float halfX, float halfZ) {
    part.uvOffset = {halfX * part.uvPerMetre, halfZ * part.uvPerMetre};
    addSheet(part, middle, halfX, halfZ);
}

// Frame whose y is the wall's inward normal and whose x runs along the wall; origin at the wall's foot.
struct Wall {
    Frame frame;
    float half;  // of its length
};
std::array<Wall, 4> wallsOf(const TankShape& shape) {
    const float w = shape.width / 2, d = shape.depth / 2;
    return {Wall{{{0, 0, -d}, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, w},
            Wall{{{0, 0, d}, {-1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, w},
            Wall{{{-w, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}}, d},
            Wall{{{w, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}}, d}};
}

void addFloor(ModelBuilder& builder, const TankShape& shape, int tiles, int concrete) {
    Part& part = builder.part(tiles);
    const float border =
        shape.tileSize * std::min(2.0f, std::floor(0.2f * std::min(shape.width, shape.depth) / shape.tileSize));
    const float w = shape.width / 2, d = shape.depth / 2;
    const Vec3 light = lerp(shape.color, Vec3{0.9f, 0.94f, 0.94f}, 0.62f);
    part.color = light;
    addTiles(part, {}, w - border, d - border);
    if (border > 0) {
        part.color = shape.color;
        for (const float s : {-1.0f, 1.0f}) {
            addTiles(part, Frame{}.at({0, 0, s * (d - border / 2)}), w, border / 2);
            addTiles(part, Frame{}.at({s * (w - border / 2), 0, 0}), border / 2, d - border);
        }
    }
    builder.part(concrete).color = {1, 1, 1};
    const float t = shape.thickness;
    addStandingBox(builder.part(concrete), Frame{}.at({0, -t - 0.01f, 0}),
                   {shape.width + 2 * t, t, shape.depth + 2 * t}, 0.01f);
}

void addTiledWalls(ModelBuilder& builder, const TankShape& shape, int tiles, int concrete, int stone, Dice& dice) {
    const float t = shape.thickness, skin = std::min(0.006f, t * 0.2f);
    const float band = std::min(2 * shape.tileSize, 0.3f * shape.height);
    for (const Wall& wall : wallsOf(shape)) {
        const bool longWall = std::abs(wall.frame.x.x) > 0.5f;
        const float outer = wall.half + (longWall ? t : 0);  // the walls along x own the corners
        Part& core = builder.part(concrete);
        core.color = {1, 1, 1};
        const float thick = t - skin;
        addBox(core, wall.frame.at({0, -skin - thick / 2, -(shape.height - 0.01f) / 2}),
               {outer, thick / 2, (shape.height + 0.01f) / 2}, 0.004f);
        Part& part = builder.part(tiles);
        part.color = shape.color;
        addTiles(part, wall.frame.at({0, 0, -(shape.height - band) / 2}), wall.half, (shape.height - band) / 2);
        part.color = shape.color * 0.45f;  // the band at the water's edge
        addTiles(part, wall.frame.at({0, 0, -shape.height + band / 2}), wall.half, band / 2);
        // Coping stones, a little proud of the wall on both sides.
        Part& rim = builder.part(stone);
        const float over = 0.25f * t + 0.02f, length = 2 * outer + (longWall ? 2 * over : -2 * over),
                    thickness = std::clamp(0.5f * t, 0.02f, 0.08f);
        const int count = std::max(1, int(length / 0.8f));
        for (int i = 0; i < count; ++i) {
            const float step = length / float(count);
            rim.color = Vec3{1.05f, 1.02f, 0.97f} * dice.range(0.9f, 1.1f);
            rim.uvOffset = {dice.unit(), dice.unit()};
            addBox(rim, wall.frame.at({-length / 2 + step * (float(i) + 0.5f), -t / 2, -shape.height - thickness / 2}),
                   {step / 2 - 0.002f, t / 2 + over, thickness / 2}, 0.012f);
        }
    }
}

void addGlassWalls(ModelBuilder& builder, const TankShape& shape, int glass, int steel) {
    const float t = shape.thickness, bar = std::max(0.03f, t);
    Part& panes = builder.part(glass);
    Part& frame = builder.part(steel);
    for (const Wall& wall : wallsOf(shape)) {
        addBox(panes, wall.frame.at({0, -t / 2, -shape.height / 2}),
               {wall.half - 0.001f, t / 2, shape.height / 2 - 0.001f}, 0);
        for (const float y : {-bar / 2, shape.height + bar / 2})  // sill and rim
            addBox(frame, wall.frame.at({0, -bar / 2, -y}), {wall.half + 0.0005f, bar / 2, bar / 2}, 0.2f * bar);
    }
    for (const float sx : {-1.0f, 1.0f})
        for (const float sz : {-1.0f, 1.0f})
            addStandingBox(frame, Frame{}.at({sx * (shape.width + bar) / 2, -bar, sz * (shape.depth + bar) / 2}),
                           {bar, shape.height + 2 * bar, bar}, 0.2f * bar);
}

}  // namespace

Result<Model> makeTank(const TankShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("tank");
    Dice dice(shape.seed * 23 + 5);
    const int tiles = builder.addMaterial("tiles", {1, 1, 1}, makeTiles(shape.seed, shape.tileSize, 8));
    const int concrete = builder.addMaterial("concrete", {1, 1, 1}, makeConcrete(shape.seed));
    builder.beginNode("floor");
    addFloor(builder, shape, tiles, concrete);
    builder.beginNode("walls");
    if (shape.walls == "glass") {
        const int glass = builder.addMaterial("glass", {0.96f, 0.99f, 0.98f}, 0.02f);
        builder.material(glass).transmission = 1;
        addGlassWalls(builder, shape, glass, builder.addMaterial("steel", {0.05f, 0.052f, 0.055f}, 0.4f, 0));
    } else {
        addTiledWalls(builder, shape, tiles, concrete, builder.addMaterial("rim", {1, 1, 1}, makeStone(shape.seed)),
                      dice);
    }
    return builder.finish();
}

}  // namespace shoal::scene
