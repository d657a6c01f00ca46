#include "scene/shapes/props.h"

namespace shoal::scene::shapes {

Vec3 woodTint(Dice& dice, float spread) {
    const float value = 1 + 1.3f * spread * (dice.unit() - 0.55f), grey = std::min(1.0f, 1.6f * spread * dice.unit());
    return lerp(Vec3{1.04f, 1, 0.94f} * value, Vec3{0.80f, 0.94f, 1.12f} * value, grey);
}

Blob makeBoulder(std::uint32_t seed, int level, float moss) {
    Blob blob = makeIcosphere(level);
    Dice dice(seed * 7919u + 17u);
    const Vec3 stretch{dice.range(0.85f, 1.25f), dice.range(0.6f, 0.9f), dice.range(0.75f, 1.1f)};
    std::vector<Vec4> cuts;  // planes: broken faces make it a stone and not a potato
    for (int i = 0; i < 13; ++i) {
        const Vec3 n = normalize(Vec3{dice.range(-1, 1), dice.range(-0.7f, 1), dice.range(-1, 1)});
        cuts.push_back({n.x, n.y, n.z, dice.range(0.62f, 0.9f)});
    }
    blob.colors.resize(blob.positions.size());
    for (std::size_t i = 0; i < blob.positions.size(); ++i) {
        Vec3 p = blob.positions[i] * (1 + 0.22f * fractal3(blob.positions[i] * 1.4f, 3, seed));
        for (const Vec4& cut : cuts) {
            const Vec3 n{cut.x, cut.y, cut.z};
            p -= n * (0.92f * std::max(0.0f, dot(p, n) - cut.w));
        }
        p += blob.positions[i] * (0.045f * fractal3(p * 5, 3, seed + 5));
        blob.positions[i] = p * stretch;
        const float patch = fractal3(p * 3, 3, seed + 9);
        const float green = moss * smoothstep(0.15f, 0.6f, p.y + 0.6f * patch);
        const Vec3 stone = Vec3{1.0f, 0.98f, 0.95f} * (0.95f + 0.22f * patch);
        blob.colors[i] = lerp(stone, Vec3{0.34f, 0.44f, 0.15f} * (0.8f + 0.3f * patch), std::clamp(green, 0.0f, 0.85f));
    }
    return blob;
}

void addCrate(ModelBuilder& builder, const Palette& palette, const Frame& base, Vec3 size, Dice& dice) {
    Part& wood = builder.part(palette.wood);
    const Vec3 tint = Vec3{1.25f, 1.12f, 0.95f} * (0.8f + 0.35f * dice.unit());
    const float board = 0.022f, frameWidth = std::clamp(0.12f * std::min(size.x, size.y), 0.05f, 0.11f);
    wood.color = tint * 0.8f;
    addStandingBox(wood, base.at({0, board, 0}), {size.x - 3 * board, size.y - 2 * board, size.z - 3 * board}, 0.004f);
    // Boards on the four sides, then battens over them.
    for (int side = 0; side < 4; ++side) {
        const Frame turned = base.turned(float(side) * kPi / 2);
        const float across = side % 2 ? size.z : size.x, out = (side % 2 ? size.x : size.z) / 2 - board * 1.5f;
        const int count = std::max(2, int(size.y / 0.16f));
        const float step = size.y / float(count);
        for (int i = 0; i < count; ++i) {
            wood.color = tint * woodTint(dice, 0.35f);
            wood.uvOffset = {dice.unit(), dice.unit()};
            addBox(wood, turned.at({0, step * (float(i) + 0.5f), out + board / 2}),
                   {across / 2 - board * 1.2f, step / 2 - 0.003f, board / 2}, 0.003f);
        }
        wood.color = tint * woodTint(dice, 0.3f) * 0.92f;
        const float face = out + board * 1.35f;
        for (const float s : {-1.0f, 1.0f}) {
            addBox(wood, turned.at({s * (across - frameWidth) / 2, size.y / 2, face}),
                   {frameWidth / 2, size.y / 2, board * 0.6f}, 0.004f);
            addBox(wood, turned.at({0, s > 0 ? size.y - frameWidth / 2 : frameWidth / 2, face}),
                   {across / 2 - frameWidth, frameWidth / 2, board * 0.5f}, 0.004f);
        }
    }
    const int lid = std::max(2, int(size.z / 0.17f));
    for (int i = 0; i < lid; ++i) {
        const float step = size.z / float(lid);
        wood.color = tint * woodTint(dice, 0.4f);
        wood.uvOffset = {dice.unit(), dice.unit()};
        addBox(wood, base.at({0, size.y - board / 2, -size.z / 2 + step * (float(i) + 0.5f)}),
               {size.x / 2, board / 2, step / 2 - 0.003f}, 0.004f);
    }
}

void addBarrel(ModelBuilder& builder, const Palette& palette, const Frame& base, float height, Dice& dice) {
    const float r = height * 0.34f;
    const auto radiusAt = [&](float y) { return r * (0.82f + 0.18f * std::sin(kPi * y / height)); };
    Part& wood = builder.part(palette.wood);
    wood.color = Vec3{0.85f, 0.68f, 0.52f} * (0.8f + 0.4f * dice.unit());
    wood.uvOffset = {dice.unit(), dice.unit()};
    std::vector<Vec2> body{{0, 0.03f}, {radiusAt(0) - 0.03f, 0.03f}, {radiusAt(0) - 0.025f, 0}, {radiusAt(0), 0}};
    for (int i = 1; i < 10; ++i) body.push_back({radiusAt(height * float(i) / 10), height * float(i) / 10});
    body.insert(body.end(), {{radiusAt(height), height},
                             {radiusAt(height) - 0.025f, height},
                             {radiusAt(height) - 0.03f, height - 0.03f},
                             {0, height - 0.03f}});
    addLathe(wood, base, body, 28, true);
    Part& iron = builder.part(palette.darkMetal);
    iron.color = {1, 1, 1};
    for (const float at : {0.08f, 0.27f, 0.73f, 0.92f}) {
        const float y = at * height, half = 0.022f * height, t = 0.006f;
        addLathe(iron, base,
                 {{radiusAt(y - half), y - half},
                  {radiusAt(y - half) + t, y - half},
                  {radiusAt(y + half) + t, y + half},
                  {radiusAt(y + half), y + half}},
                 28);
    }
}

void addCardboardBox(ModelBuilder& builder, const Palette& palette, const Frame& base, Vec3 size, Dice& dice) {
    Part& paint = builder.part(palette.paint);
    const float shade = 0.8f + 0.35f * dice.unit();
    paint.color = Vec3{0.50f, 0.345f, 0.20f} * shade;
    addStandingBox(paint, base, size, 0.012f);
    paint.color = Vec3{0.66f, 0.55f, 0.38f} * shade;  // tape
    addStandingBox(paint, base.at({0, size.y - 0.05f, 0}), {0.05f, 0.0515f, size.z + 0.003f}, 0.001f);
    if (dice.chance(0.7f)) {  // a label
        paint.color = {0.85f, 0.84f, 0.8f};
        addBox(paint, base.at({size.x * dice.range(-0.2f, 0.2f), size.y * 0.45f, size.z / 2}), {0.08f, 0.055f, 0.002f},
               0);
    }
}

void addBollard(ModelBuilder& builder, const Palette& palette, const Frame& base) {
    Part& iron = builder.part(palette.darkMetal);
    iron.color = {1, 1, 1};
    addLathe(iron, base,
             {{0, 0},
              {0.24f, 0},
              {0.24f, 0.03f},
              {0.16f, 0.06f},
              {0.125f, 0.12f},
              {0.12f, 0.3f},
              {0.125f, 0.36f},
              {0.17f, 0.41f},
              {0.195f, 0.45f},
              {0.19f, 0.49f},
              {0.14f, 0.53f},
              {0.06f, 0.55f},
              {0, 0.552f}},
             28);
    for (int i = 0; i < 6; ++i) {
        const float a = float(i) * kPi / 3;
        addCylinder(iron, base.at({0.205f * std::cos(a), 0.03f, 0.205f * std::sin(a)}), 0.018f, 0.02f, 0.004f, 6);
    }
}

void addBench(ModelBuilder& builder, const Palette& palette, const Frame& base, Dice& dice) {
    Part& iron = builder.part(palette.darkMetal);
    iron.color = {1, 1, 1};
    for (const float x : {-0.72f, 0.72f}) {
        const auto at = [&](float y, float z) { return base.point({x, y, z}); };
        addBeam(iron, at(0, 0.2f), at(0.42f, 0.18f), 0.05f, 0.05f, 0.01f);
        addBeam(iron, at(0, -0.24f), at(0.42f, -0.2f), 0.05f, 0.05f, 0.01f);
        addBeam(iron, at(0.42f, 0.26f), at(0.42f, -0.24f), 0.05f, 0.05f, 0.01f);
        addBeam(iron, at(0.42f, -0.22f), at(0.86f, -0.34f), 0.05f, 0.05f, 0.01f);
        addBeam(iron, at(0.64f, 0.24f), at(0.64f, -0.27f), 0.05f, 0.035f, 0.01f);
        addBeam(iron, at(0.42f, 0.24f), at(0.64f, 0.24f), 0.05f, 0.035f, 0.01f);
    }
    Part& wood = builder.part(palette.wood);
    const auto plank = [&](float y, float z, float tilt) {
        wood.color = Vec3{1.0f, 0.78f, 0.58f} * woodTint(dice, 0.3f);
        wood.uvOffset = {dice.unit(), dice.unit()};
        addBox(wood, base.at({0, y, z}).tipped({1, 0, 0}, tilt), {0.9f, 0.016f, 0.05f}, 0.008f);
    };
    for (int i = 0; i < 4; ++i) plank(0.462f, -0.165f + 0.118f * float(i), 0);
    for (int i = 0; i < 3; ++i) plank(0.56f + 0.125f * float(i), -0.225f - 0.034f * float(i), -1.83f);
}

void addLamp(ModelBuilder& builder, const Palette& palette, const Frame& base, float height) {
    Part& iron = builder.part(palette.darkMetal);
    iron.color = {1, 1, 1};
    addLathe(iron, base,
             {{0, 0},
              {0.17f, 0},
              {0.17f, 0.06f},
              {0.12f, 0.10f},
              {0.09f, 0.30f},
              {0.075f, 0.75f},
              {0.055f, 0.8f},
              {0.05f, height - 0.6f},
              {0.07f, height - 0.56f},
              {0.04f, height - 0.5f},
              {0.13f, height - 0.42f},
              {0, height - 0.42f}},
             20);
    addLathe(iron, base,
             {{0, height - 0.06f},
              {0.19f, height - 0.06f},
              {0.2f, height - 0.04f},
              {0.09f, height + 0.06f},
              {0.03f, height + 0.1f},
              {0.025f, height + 0.15f},
              {0, height + 0.16f}},
             20);
    for (int i = 0; i < 4; ++i) {
        const float a = (float(i) + 0.5f) * kPi / 2;
        const Vec3 d{std::cos(a), 0, std::sin(a)};
        addBeam(iron, base.point(d * 0.12f + Vec3{0, height - 0.42f, 0}),
                base.point(d * 0.175f + Vec3{0, height - 0.05f, 0}), 0.014f, 0.014f, 0.002f);
    }
    addLathe(builder.part(palette.lamp), base,
             {{0, height - 0.415f}, {0.1f, height - 0.415f}, {0.15f, height - 0.065f}, {0, height - 0.065f}}, 16);
}

void addFoliage(Part& leaves, Vec3 center, Vec3 half, int count, float leafSize, Dice& dice) {
    for (int i = 0; i < count; ++i) {
        const float z = dice.range(-1, 1), a = dice.range(0, 2 * kPi), s = std::sqrt(std::max(0.0f, 1 - z * z));
        const Vec3 out{s * std::cos(a), z, s * std::sin(a)};
        const float depth = std::cbrt(dice.range(0.25f, 1.0f));
        const Vec3 at = center + out * half * depth * (1 + 0.18f * noise3(out * 2.5f, 77));
        const Vec3 tilt{dice.range(-1, 1), dice.range(-1, 1), dice.range(-1, 1)};
        const Vec3 n = normalize(out + Vec3{0, 0.35f, 0} + tilt * 0.8f);
        Vec3 t = cross(n, tilt);
        t = length(t) > 1e-3f ? normalize(t) : Vec3{1, 0, 0};
        const Vec3 b = cross(n, t);
        const float size = leafSize * dice.range(0.6f, 1.15f),
                    shade = (0.45f + 0.55f * depth * depth) * dice.range(0.75f, 1.2f);
        leaves.color = lerp(Vec3{0.9f, 1, 0.8f}, Vec3{1.35f, 1.12f, 0.7f}, dice.unit() * 0.6f) * shade;
        // Lit as part of the crown, not each for itself: that is what makes a crown of loose leaves look round.
        const Vec3 shading = normalize(out * 1.6f + n);
        const std::uint32_t v[4] = {leaves.add({at - b * size, shading, t, {0.5f, 1}}),
                                    leaves.add({at + t * (size * 0.45f), shading, t, {1, 0.5f}}),
                                    leaves.add({at + b * size, shading, t, {0.5f, 0}}),
                                    leaves.add({at - t * (size * 0.45f), shading, t, {0, 0.5f}})};
        leaves.quad(v[0], v[1], v[2], v[3], shading);
    }
}

void addTree(ModelBuilder& builder, const Palette& palette, const Frame& base, float height, Dice& dice) {
    Part& bark = builder.part(palette.bark);
    bark.color = {1, 1, 1};
    const float r = 0.028f * height, fork = 0.42f * height;
    addLathe(bark, base,
             {{0, -0.05f},
              {r * 1.7f, -0.05f},
              {r * 1.15f, 0.1f * height},
              {r, 0.25f * height},
              {r * 0.85f, fork},
              {0.0f, fork + r}},
             12, true);
    Part& leaves = builder.part(palette.leaf);
    const int limbs = 6;
    for (int i = 0; i <= limbs; ++i) {
        const float a = (float(i) + dice.range(-0.3f, 0.3f)) * 2 * kPi / limbs,
                    reach = i == limbs ? 0 : height * dice.range(0.15f, 0.23f);
        const Vec3 from = base.point({0, fork - 0.02f * height * float(i % 3), 0});
        const Vec3 to = base.point(
            {reach * std::cos(a), height * (i == limbs ? 0.78f : dice.range(0.58f, 0.74f)), reach * std::sin(a)});
        addBeam(bark, from, to, r * 0.8f, r * 0.8f, r * 0.3f);
        const float size = height * dice.range(0.15f, 0.2f);
        addFoliage(leaves, to, {size, size * 0.85f, size}, 190, 0.03f * height, dice);
    }
}

}  // namespace shoal::scene::shapes
