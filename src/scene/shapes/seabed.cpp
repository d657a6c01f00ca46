// The floor of the sea: rippled sand with stones and grass, finely meshed in the middle and coarse far out.
#include <cmath>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/corals.h"
#include "scene/shapes/scatter.h"

namespace shoal::scene {
namespace {

using namespace shapes;

float heightOf(const SeabedShape& shape, float x, float z) {
    const float far = smoothstep(0.5f * shape.flat, 1.6f * shape.flat + 1, std::sqrt(x * x + z * z));
    const float banks = fractal(x * 0.055f, z * 0.055f, 3, shape.seed),
                lumps = fractal(x * 0.35f, z * 0.35f, 3, shape.seed + 40);
    const float falls = shape.slope * std::max(0.0f, -z - 0.5f * shape.flat);
    return shape.relief * (far * banks + 0.07f * lumps) - falls;
}

// Lines closer together in the middle: t in -1 .. 1.
float lineAt(const SeabedShape& shape, float t) { return 0.5f * shape.size * t * (0.12f + 0.88f * t * t); }

void addSand(Part& part, const SeabedShape& shape) {
    const std::size_t side = std::size_t(shape.cells) + 1;
    for (std::size_t row = 0; row < side; ++row)
        for (std::size_t i = 0; i < side; ++i) {
            const float x = lineAt(shape, 2 * float(i) / float(shape.cells) - 1),
                        z = lineAt(shape, 2 * float(row) / float(shape.cells) - 1);
            const float e = 0.1f + 0.01f * std::sqrt(x * x + z * z);
            const Vec3 n = normalize(Vec3{heightOf(shape, x - e, z) - heightOf(shape, x + e, z), 2 * e,
                                          heightOf(shape, x, z - e) - heightOf(shape, x, z + e)});
            const float patch = fractal(x * 0.16f, z * 0.16f, 4, shape.seed + 80);
            part.color = lerp(Vec3{1.04f, 1.0f, 0.95f}, Vec3{0.68f, 0.66f, 0.55f}, smoothstep(-0.1f, 0.7f, patch));
            part.add({{x, heightOf(shape, x, z), z}, n, {1, 0, 0}, {x * part.uvPerMetre, z * part.uvPerMetre}});
        }
    for (std::uint32_t row = 0; row + 1 < side; ++row)
        for (std::uint32_t i = 0; i + 1 < side; ++i) {
            const std::uint32_t a = row * std::uint32_t(side) + i, b = a + std::uint32_t(side);
            part.quad(a, b, b + 1, a + 1, {0, 1, 0});
        }
}

// A place on the floor: dense in the middle, thinning out.
Vec3 anywhere(const SeabedShape& shape, Dice& dice) {
    const float a = dice.range(0, 2 * kPi), r = std::min(shape.scatter, 0.5f * shape.size) * dice.unit();
    const float x = r * std::cos(a), z = r * std::sin(a);
    return {x, heightOf(shape, x, z), z};
}

}  // namespace

Result<Model> makeSeabed(const SeabedShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("seabed");
    const int sand = builder.addMaterial("sand", shape.color, makeSilt(shape.seed));
    const int rock = builder.addMaterial("rock", {1, 1, 1}, makeRock(shape.seed));
    const int grass = builder.addMaterial("seagrass", {1, 1, 1}, 0.7f);
    builder.material(grass).doubleSided = true;
    builder.beginNode("sand");
    addSand(builder.part(sand), shape);
    std::size_t nodeCount = 1;
    Dice dice(shape.seed * 61 + 9);
    Scatter stones(builder, "stone", nodeCount);
    for (int i = 0; i < shape.stones; ++i) {
        const Vec3 at = anywhere(shape, dice);
        const float radius = 0.05f * std::pow(14.0f, dice.unit() * dice.unit());
        const std::uint32_t kind = std::uint32_t(i % 4);
        stones.place(kind, at - Vec3{0, 0.2f * radius, 0}, uprightTurn(dice, 0.6f), radius,
                     [&] { addBlob(builder.part(rock), {}, makeReefRock(shape.seed * 43 + kind, 3)); });
    }
    Scatter tufts(builder, "seagrass", nodeCount);
    for (int i = 0; i < shape.grass; ++i) {
        Vec3 at = anywhere(shape, dice);
        for (int attempt = 0; attempt < 8 && noise(at.x * 0.3f, at.z * 0.3f, shape.seed + 90) < 0.1f; ++attempt)
            at = anywhere(shape, dice);
        const std::size_t kind = std::size_t(i % 3);
        const float size = dice.range(0.35f, 0.8f);
        tufts.place(kind, at, uprightTurn(dice, 0.15f), size, [&] {
            Dice own(shape.seed * 67 + std::uint32_t(kind));
            addSeagrass(builder.part(grass), {}, 1, own);
        });
    }
    return builder.finish();
}

}  // namespace shoal::scene
