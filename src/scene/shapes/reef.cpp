// A coral reef: a mound of boulders, and what grows on them.
#include <array>
#include <cmath>
#include <functional>

#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/corals.h"
#include "scene/shapes/scatter.h"

namespace shoal::scene {
namespace {

using namespace shapes;

constexpr std::size_t kRockKinds = 5;

// Boulders where they lie, to ask what is highest at a place.
class Mound {
public:
    struct Spot {
        float y = 0;
        Vec3 normal{0, 1, 0};
        bool rock = false;  // else the sand at y = 0
    };

    void add(const Blob& blob, const Mat4& worldFromRock) {
        Rock rock{{}, {}, &blob};
        for (const Vec3 p : blob.positions) {
            rock.positions.push_back(transformPoint(worldFromRock, p));
            rock.bounds.add(rock.positions.back());
        }
        rocks_.push_back(std::move(rock));
    }

    Spot at(float x, float z) const {
        Spot best;
        for (const Rock& rock : rocks_) {
            const Bounds& b = rock.bounds;
            if (x < b.lo.x || x > b.hi.x || z < b.lo.z || z > b.hi.z || b.hi.y < best.y) continue;
            for (std::size_t t = 0; t < rock.blob->indices.size(); t += 3) hit(rock, t, x, z, best);
        }
        return best;
    }

private:
    struct Rock {
        std::vector<Vec3> positions;
        Bounds bounds;
        const Blob* blob;
    };
    static void hit(const Rock& rock, std::size_t triangle, float x, float z, Spot& best) {
        const std::uint32_t* v = &rock.blob->indices[triangle];
        const Vec3 a = rock.positions[v[0]], b = rock.positions[v[1]], c = rock.positions[v[2]];
        const float area = (b.x - a.x) * (c.z - a.z) - (c.x - a.x) * (b.z - a.z);
        if (area >= -1e-9f) return;  // from below, or on edge
        const float u = ((x - a.x) * (c.z - a.z) - (c.x - a.x) * (z - a.z)) / area;
        const float w = ((b.x - a.x) * (z - a.z) - (x - a.x) * (b.z - a.z)) / area;
        if (u < 0 || w < 0 || u + w > 1) return;
        const float y = a.y + u * (b.y - a.y) + w * (c.y - a.y);
        if (y > best.y) best = {y, normalize(cross(b - a, c - a)), true};
    }
    std::vector<Rock> rocks_;
};

// 1 in the middle of the reef, 0 at its edge.
float moundAt(const ReefShape& shape, float x, float z) {
    const float a = 2 * x / shape.area.x, b = 2 * z / shape.area.y;
    return std::max(0.0f, 1 - a * a - b * b);
}

void pileRocks(ModelBuilder& builder, const ReefShape& shape, const std::array<Blob, kRockKinds>& kinds, int material,
               Mound& mound, std::size_t& nodeCount, Dice& dice) {
    Scatter scatter(builder, "rock", nodeCount);
    const float usual = 0.72f * std::sqrt(shape.area.x * shape.area.y / float(std::max(shape.rocks, 1)));
    for (int i = 0; i < shape.rocks; ++i) {
        const float a = dice.range(0, 2 * kPi), out = std::pow(dice.unit(), 0.7f);
        const float x = 0.5f * shape.area.x * out * std::cos(a), z = 0.5f * shape.area.y * out * std::sin(a);
        const float inside = moundAt(shape, x, z), radius = usual * (0.55f + 0.75f * inside) * dice.range(0.65f, 1.25f);
        const Vec3 at{x, shape.height * inside * dice.range(0.25f, 0.85f) - 0.15f * radius, z};
        const Quat turn = uprightTurn(dice, 0.6f);
        const std::size_t kind = std::size_t(i) % kRockKinds;
        mound.add(kinds[kind], compose(at, turn, {radius, radius, radius}));
        scatter.place(kind, at, turn, radius, [&] { addBlob(builder.part(material), {}, kinds[kind]); });
    }
}

struct Growth {
    const char* name;
    std::function<void(Part&, const Frame&, float, Vec3, Dice&)> add;
    int material;
    std::vector<Vec3> colors;          // one prototype each
    float smallest, largest, upright;  // metres; 1 grows straight up whatever it stands on
    float share, highest;              // of all corals; prefers this part of the reef's height
};

std::vector<Growth> growths(const SeaPalette& p, int sheets) {
    return {
        {"staghorn coral",
         addBranchingCoral,
         p.polyps,
         {{0.62f, 0.42f, 0.16f}, {0.30f, 0.34f, 0.62f}, {0.66f, 0.52f, 0.30f}, {0.52f, 0.26f, 0.44f}},
         0.35f,
         0.85f,
         0.6f,
         0.30f,
         0.7f},
        {"table coral",
         addTableCoral,
         p.polyps,
         {{0.40f, 0.44f, 0.24f}, {0.56f, 0.40f, 0.24f}},
         0.6f,
         1.5f,
         0.9f,
         0.10f,
         0.9f},
        {"brain coral",
         addBrainCoral,
         p.meanders,
         {{0.58f, 0.50f, 0.20f}, {0.34f, 0.46f, 0.26f}},
         0.3f,
         0.9f,
         0.3f,
         0.18f,
         0.3f},
        {"tube sponge",
         addTubeSponge,
         p.polyps,
         {{0.80f, 0.56f, 0.10f}, {0.46f, 0.26f, 0.58f}},
         0.3f,
         0.75f,
         0.7f,
         0.12f,
         0.5f},
        {"barrel sponge", addBarrelSponge, p.polyps, {{0.50f, 0.27f, 0.20f}}, 0.4f, 0.8f, 0.95f, 0.04f, 0.1f},
        {"sea fan",
         addSeaFan,
         p.smooth,
         {{0.55f, 0.16f, 0.40f}, {0.78f, 0.40f, 0.10f}},
         0.6f,
         1.25f,
         0.85f,
         0.11f,
         0.6f},
        {"leaf coral",
         addLeafCoral,
         sheets,
         {{0.56f, 0.46f, 0.24f}, {0.62f, 0.34f, 0.34f}},
         0.4f,
         0.95f,
         0.5f,
         0.15f,
         0.4f},
    };
}

// Up between the ground's normal and the sky's, any heading.
Quat standOn(Vec3 normal, float upright, float heading) {
    const Vec3 up = normalize(lerp(normal, Vec3{0, 1, 0}, upright)), axis = cross({0, 1, 0}, up);
    const Quat lean =
        length(axis) > 1e-5f ? axisAngle(normalize(axis), std::acos(std::clamp(up.y, -1.0f, 1.0f))) : Quat{};
    return lean * axisAngle({0, 1, 0}, heading);
}

// Corals of a kind grow in patches: each tries a few places and takes the one that suits it best.
void grow(ModelBuilder& builder, const ReefShape& shape, const Growth& growth, std::uint32_t which, const Mound& mound,
          std::size_t& nodeCount) {
    Dice dice(shape.seed * 97 + which * 13 + 5);
    Scatter scatter(builder, growth.name, nodeCount);
    const int count = int(std::round(float(shape.corals) * growth.share));
    for (int i = 0; i < count; ++i) {
        float best = -1e9f;
        Vec3 at;
        Mound::Spot on;
        for (int attempt = 0; attempt < 9; ++attempt) {
            const float a = dice.range(0, 2 * kPi), out = std::sqrt(dice.unit()) * 0.98f;
            const float x = 0.5f * shape.area.x * out * std::cos(a), z = 0.5f * shape.area.y * out * std::sin(a);
            const Mound::Spot spot = mound.at(x, z);
            const float suits = -std::abs(spot.y / std::max(shape.height, 0.1f) - growth.highest) +
                                (spot.rock ? 0.5f : 0.0f) + 0.5f * spot.normal.y +
                                0.6f * noise(x * 0.5f, z * 0.5f, shape.seed * 7 + which);
            if (suits > best) best = suits, at = {x, spot.y, z}, on = spot;
        }
        const float size = mix(growth.smallest, growth.largest, dice.unit() * dice.unit());
        const std::size_t kind = std::size_t(i) % growth.colors.size();
        scatter.place(kind, at, standOn(on.normal, growth.upright, dice.range(0, 2 * kPi)), size, [&] {
            Dice own(shape.seed * 101 + which * 17 + std::uint32_t(kind));
            growth.add(builder.part(growth.material), {}, 1, growth.colors[kind], own);
        });
    }
}

}  // namespace

Result<Model> makeReef(const ReefShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("reef");
    SeaPalette palette;
    palette.rock = builder.addMaterial("rock", {1, 1, 1}, makeRock(shape.seed));
    palette.polyps = builder.addMaterial("polyps", {1, 1, 1}, makePolyps(shape.seed));
    palette.meanders = builder.addMaterial("meanders", {1, 1, 1}, makeMeanders(shape.seed));
    palette.smooth = builder.addMaterial("fans", {1, 1, 1}, 0.9f);
    const int sheets = builder.addMaterial("sheets", {1, 1, 1}, 0.9f);
    builder.material(sheets).doubleSided = true;
    std::array<Blob, kRockKinds> rocks;
    for (std::size_t i = 0; i < kRockKinds; ++i) rocks[i] = makeReefRock(shape.seed * 23 + std::uint32_t(i), 3);
    Dice dice(shape.seed * 89 + 7);
    Mound mound;
    std::size_t nodeCount = 0;
    pileRocks(builder, shape, rocks, palette.rock, mound, nodeCount, dice);
    std::uint32_t which = 0;
    for (const Growth& growth : growths(palette, sheets)) grow(builder, shape, growth, which++, mound, nodeCount);
    return builder.finish();
}

}  // namespace shoal::scene
