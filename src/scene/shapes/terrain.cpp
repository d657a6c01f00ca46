// Land as a height field, with boulders and shrubs on it; and boulders alone.
#include <cmath>

#include <shoal/core/parallel.h>
#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/props.h"
#include "scene/shapes/scatter.h"

namespace shoal::scene {
namespace {

using namespace shapes;

// Ground height at (x, z) in metres.
class Ground {
public:
    explicit Ground(const TerrainShape& shape) : shape_(shape) {}

    float height(float x, float z) const {
        const float scale = 3.2f / shape_.size;
        const float wx = x + 0.07f * shape_.size * noise(x * scale * 1.7f, z * scale * 1.7f, shape_.seed + 101);
        const float wz = z + 0.07f * shape_.size * noise(x * scale * 1.7f, z * scale * 1.7f, shape_.seed + 102);
        const float hills = 0.5f + 0.5f * fractal(wx * scale, wz * scale, 3, shape_.seed);
        // Ridges where the noise passes zero; they show only high up, so valleys stay smooth.
        float ridges = 0, strength = 0.5f, frequency = scale * 1.6f;
        for (std::uint32_t i = 0; i < 5; ++i, strength *= 0.5f, frequency *= 2.1f)
            ridges += strength * (1 - std::abs(noise(wx * frequency, wz * frequency, shape_.seed + 31 + i)) * 1.8f);
        const float rugged = shape_.roughness * smoothstep(0.2f, 0.8f, hills);
        const float fine = 0.012f * fractal(x * 0.35f, z * 0.35f, 3, shape_.seed + 71);
        const float land = mix(hills, hills * 0.55f + 0.45f * ridges, rugged) + fine;
        return shape_.island ? shore(x, z, land) : shape_.height * std::clamp(land, 0.0f, 1.2f);
    }

    Vec3 normal(float x, float z, float step) const {
        return normalize(
            Vec3{height(x - step, z) - height(x + step, z), 2 * step, height(x, z - step) - height(x, z + step)});
    }

private:
    // Pulls the land down to the sea floor outside, with a beach that is flat about the waterline.
    float shore(float x, float z, float land) const {
        const float scale = 4 / shape_.size;
        const float coast = 0.16f * fractal(x * scale, z * scale, 3, shape_.seed + 55);
        const float from = std::sqrt(x * x + z * z) / (0.5f * shape_.size) + coast;
        const float dome = std::pow(1 - smoothstep(0.0f, 0.95f, from), 1.3f);
        const float raised = shape_.height * (1.45f * std::max(0.0f, land) * dome - 0.07f) -
                             shape_.seaDepth * smoothstep(0.5f, 1.0f, from);
        const float h = std::min(raised, shape_.height);
        return h * (0.3f + 0.7f * smoothstep(0.0f, 2.2f, std::abs(h)));
    }

    TerrainShape shape_;
};

Vec3 groundColor(const TerrainShape& shape, Vec3 p, float steepness) {
    const float patch = fractal(p.x * 0.13f, p.z * 0.13f, 4, shape.seed + 200),
                fine = noise(p.x * 1.1f, p.z * 1.1f, shape.seed + 210);
    const Vec3 sand = Vec3{0.72f, 0.60f, 0.42f} * (1 + 0.06f * fine);
    const Vec3 grass = lerp(Vec3{0.105f, 0.145f, 0.05f}, Vec3{0.235f, 0.22f, 0.10f}, smoothstep(-0.5f, 0.7f, patch)) *
                       (1 + 0.25f * fine);
    const Vec3 rock = lerp(Vec3{0.40f, 0.37f, 0.33f}, Vec3{0.27f, 0.25f, 0.23f}, smoothstep(-0.5f, 0.5f, fine + patch));
    const float line = shape.island ? shape.grassLine : -1e9f;
    Vec3 color = lerp(sand, grass, smoothstep(line - 0.35f, line + 0.45f, p.y + 0.7f * patch));
    if (shape.island) color = color * mix(1.0f, 0.62f, (1 - smoothstep(0.02f, 0.32f, p.y)));  // wet by the waves
    return lerp(color, rock, smoothstep(0.13f, 0.30f, steepness + 0.09f * fine + 0.06f * patch));
}

void addGround(ModelBuilder& builder, const TerrainShape& shape, const Ground& ground, int material) {
    const std::size_t side = std::size_t(shape.cells) + 1;
    const float cell = shape.size / float(shape.cells);
    const auto at = [&](std::size_t i) { return float(i) * cell - shape.size / 2; };
    std::vector<float> heights(side * side);
    parallelFor(side, 8, [&](std::size_t row) {
        for (std::size_t i = 0; i < side; ++i) heights[row * side + i] = ground.height(at(i), at(row));
    });
    const auto heightAt = [&](std::size_t column, std::size_t row) { return heights[row * side + column]; };
    Part& part = builder.part(material);
    for (std::size_t row = 0; row < side; ++row)
        for (std::size_t i = 0; i < side; ++i) {
            const std::size_t left = i > 0 ? i - 1 : 0, right = std::min(i + 1, side - 1), back = row > 0 ? row - 1 : 0,
                              front = std::min(row + 1, side - 1);
            const float dx = (heightAt(right, row) - heightAt(left, row)) / (float(right - left) * cell);
            const float dz = (heightAt(i, front) - heightAt(i, back)) / (float(front - back) * cell);
            const Vec3 p{at(i), heightAt(i, row), at(row)}, n = normalize(Vec3{-dx, 1, -dz});
            part.color = groundColor(shape, p, 1 - n.y);
            part.add({p, n, {1, 0, 0}, {p.x * part.uvPerMetre, p.z * part.uvPerMetre}});
        }
    for (std::uint32_t row = 0; row + 1 < side; ++row)
        for (std::uint32_t i = 0; i + 1 < side; ++i) {
            const std::uint32_t a = row * std::uint32_t(side) + i, b = a + std::uint32_t(side);
            // The diagonal that follows the ridge or the valley.
            if (std::abs(heights[a] - heights[b + 1]) < std::abs(heights[a + 1] - heights[b]))
                part.quad(a, b, b + 1, a + 1, {0, 1, 0});
            else
                part.quad(b, b + 1, a + 1, a, {0, 1, 0});
        }
}

constexpr int kBoulderKinds = 6, kBushKinds = 3, kTreeKinds = 4;

void scatterRocks(ModelBuilder& builder, const TerrainShape& shape, const Ground& ground, int stone,
                  std::size_t& nodeCount) {
    Dice dice(shape.seed * 31 + 7);
    Scatter scatter(builder, "rock", nodeCount);
    for (int i = 0; i < shape.rocks; ++i) {
        const float x = dice.range(-0.48f, 0.48f) * shape.size, z = dice.range(-0.48f, 0.48f) * shape.size;
        const float radius = shape.size / 120 * 0.25f * std::pow(7.0f, dice.unit() * dice.unit());
        const Quat turn = uprightTurn(dice, 0.4f);
        const std::uint32_t kind = std::uint32_t(i % kBoulderKinds);
        scatter.place(kind, {x, ground.height(x, z) - 0.1f * radius, z}, turn, radius, [&] {
            addBlob(builder.part(stone), {}, makeBoulder(shape.seed * 13 + kind, 3, shape.island ? 0.15f : 0.4f));
        });
    }
}

// Where grass grows and the ground is not steep; groves follow a noise of their own.
bool isFertile(const TerrainShape& shape, const Ground& ground, float x, float z, float grove) {
    const bool grows = !shape.island || ground.height(x, z) > shape.grassLine + 0.5f;
    return grows && ground.normal(x, z, 0.5f).y > 0.82f && noise(x * 0.09f, z * 0.09f, shape.seed + 300) > grove;
}

void scatterBushes(ModelBuilder& builder, const TerrainShape& shape, const Ground& ground, int leaf,
                   std::size_t& nodeCount) {
    Dice dice(shape.seed * 37 + 11);
    Scatter scatter(builder, "bush", nodeCount);
    int placed = 0;
    for (int attempt = 0; attempt < shape.bushes * 8 && placed < shape.bushes; ++attempt) {
        const float x = dice.range(-0.48f, 0.48f) * shape.size, z = dice.range(-0.48f, 0.48f) * shape.size;
        const float scale = dice.range(0.45f, 1.3f);
        const Quat turn = uprightTurn(dice, 0.1f);
        if (!isFertile(shape, ground, x, z, -0.1f)) continue;
        const std::uint32_t kind = std::uint32_t(placed++ % kBushKinds);
        scatter.place(kind, {x, ground.height(x, z), z}, turn, scale, [&] {
            Dice shapeDice(shape.seed * 41 + kind);
            Part& leaves = builder.part(leaf);
            for (int clump = 0; clump < 3; ++clump)
                addFoliage(leaves, {shapeDice.range(-0.35f, 0.35f), 0.35f, shapeDice.range(-0.35f, 0.35f)},
                           {0.5f, 0.45f, 0.5f}, 110, 0.1f, shapeDice);
        });
    }
}

void scatterTrees(ModelBuilder& builder, const TerrainShape& shape, const Ground& ground, const Palette& palette,
                  std::size_t& nodeCount) {
    Dice dice(shape.seed * 47 + 5);
    Scatter scatter(builder, "tree", nodeCount);
    int placed = 0;
    for (int attempt = 0; attempt < shape.trees * 12 && placed < shape.trees; ++attempt) {
        const float x = dice.range(-0.48f, 0.48f) * shape.size, z = dice.range(-0.48f, 0.48f) * shape.size;
        const float scale = dice.range(0.7f, 1.35f);
        const Quat turn = uprightTurn(dice, 0.08f);
        if (!isFertile(shape, ground, x, z, 0.08f)) continue;
        const std::uint32_t kind = std::uint32_t(placed++ % kTreeKinds);
        scatter.place(kind, {x, ground.height(x, z), z}, turn, scale, [&] {
            Dice shapeDice(shape.seed * 67 + kind);
            addTree(builder, palette, {}, shapeDice.range(3.6f, 4.6f), shapeDice);
        });
    }
}

}  // namespace

Result<Model> makeTerrain(const TerrainShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("terrain");
    const int grit = builder.addMaterial("ground", {1, 1, 1}, makeGrit(shape.seed));
    const Ground ground(shape);
    std::size_t nodeCount = 1;
    builder.beginNode("ground");
    addGround(builder, shape, ground, grit);
    if (shape.rocks > 0)
        scatterRocks(builder, shape, ground, builder.addMaterial("rock", {0.75f, 0.72f, 0.68f}, makeRock(shape.seed)),
                     nodeCount);
    if (shape.bushes > 0 || shape.trees > 0) {
        Palette palette;
        palette.leaf = builder.addMaterial("leaves", {0.10f, 0.15f, 0.045f}, 0.7f);
        builder.material(palette.leaf).doubleSided = true;
        scatterBushes(builder, shape, ground, palette.leaf, nodeCount);
        if (shape.trees > 0) palette.bark = builder.addMaterial("bark", {0.16f, 0.12f, 0.085f}, 0.9f);
        scatterTrees(builder, shape, ground, palette, nodeCount);
    }
    return builder.finish();
}

Result<Model> makeRocks(const RocksShape& shape) {
    SHOAL_TRY(validate(shape));
    if (shape.largest < shape.smallest) return badInput("largest: found less than smallest, expected at least as much");
    ModelBuilder builder("rocks");
    const int stone = builder.addMaterial("rock", min(shape.color * 2.0f, Vec3{1, 1, 1}), makeRock(shape.seed));
    Dice dice(shape.seed * 29 + 3);
    struct Placed {
        Vec2 at;
        float radius;
    };
    std::vector<Placed> placed;
    std::size_t nodeCount = 0;
    Scatter scatter(builder, "rock", nodeCount);
    for (int i = 0; i < shape.count; ++i) {
        const float radius = shape.smallest * std::pow(shape.largest / shape.smallest, dice.unit() * dice.unit());
        Vec2 at;
        for (int attempt = 0; attempt < 12; ++attempt) {  // not inside one another, where there is room
            at = {dice.range(-0.5f, 0.5f) * shape.area.x, dice.range(-0.5f, 0.5f) * shape.area.y};
            bool free = true;
            for (std::size_t k = placed.size() > 64 ? placed.size() - 64 : 0; k < placed.size(); ++k)
                free = free && length(placed[k].at - at) > 0.85f * (placed[k].radius + radius);
            if (free) break;
        }
        placed.push_back({at, radius});
        const std::uint32_t kind = std::uint32_t(i % kBoulderKinds);
        scatter.place(kind, {at.x, 0.25f * radius, at.y}, uprightTurn(dice, 0.35f), radius,
                      [&] { addBlob(builder.part(stone), {}, makeBoulder(shape.seed * 17 + kind, 4, shape.moss)); });
    }
    return builder.finish();
}

}  // namespace shoal::scene
