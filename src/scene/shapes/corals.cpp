#include "scene/shapes/corals.h"

// Tables, branches, heads and fans; sponges, leaves, grass and rocks stand in sponges.cpp.

namespace shoal::scene::shapes {
namespace {

Vec3 anyAcross(Vec3 d) { return normalize(std::abs(d.y) < 0.9f ? cross(d, Vec3{0, 1, 0}) : cross(d, Vec3{1, 0, 0})); }

Vec3 jittered(Vec3 d, float by, Dice& dice) {
    return normalize(d + Vec3{dice.range(-by, by), dice.range(-by, by), dice.range(-by, by)});
}

struct Branch {
    Vec3 from, direction;
    float length, radius;
    int level;
};

}  // namespace

void addTube(Part& part, const Frame& frame, const Tube& tube) {
    const std::size_t count = tube.points.size();
    Vec3 across = anyAcross(normalize(tube.points[1] - tube.points[0]));
    std::vector<std::uint32_t> before;
    float run = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 back = i > 0 ? tube.points[i] - tube.points[i - 1] : tube.points[1] - tube.points[0];
        const Vec3 on = i + 1 < count ? tube.points[i + 1] - tube.points[i] : back;
        const Vec3 along = normalize(normalize(back) + normalize(on));
        across = normalize(across - along * dot(across, along));
        const Vec3 other = cross(along, across);
        if (i > 0) run += length(back);
        part.color = lerp(tube.root, tube.tip, float(i) / float(count - 1));
        const float turns = std::max(1.0f, std::round(2 * kPi * tube.radii[0] * part.uvPerMetre));
        std::vector<std::uint32_t> ring;
        for (int k = 0; k <= tube.around; ++k) {
            const float a = 2 * kPi * float(k % tube.around) / float(tube.around);
            const Vec3 n = across * std::cos(a) + other * std::sin(a),
                       round = other * std::cos(a) - across * std::sin(a);
            ring.push_back(
                part.add({frame.point(tube.points[i] + n * tube.radii[i]), frame.direction(n), frame.direction(round),
                          part.uvOffset + Vec2{turns * float(k) / float(tube.around), -run * part.uvPerMetre}}));
        }
        for (std::size_t k = 0; k + 1 < ring.size() && i > 0; ++k) {
            const float a = 2 * kPi * (float(k) + 0.5f) / float(tube.around);
            part.quad(before[k], ring[k], ring[k + 1], before[k + 1],
                      frame.direction(across * std::cos(a) + other * std::sin(a)));
        }
        if (i + 1 == count) {  // the rounded end
            const std::uint32_t top =
                part.add({frame.point(tube.points[i] + along * (0.8f * tube.radii[i])), frame.direction(along),
                          frame.direction(across), part.uvOffset + Vec2{0, -(run + tube.radii[i]) * part.uvPerMetre}});
            for (std::size_t k = 0; k + 1 < ring.size(); ++k)
                part.triangle(ring[k], ring[k + 1], top, frame.direction(along));
        }
        before = std::move(ring);
    }
}

void addBranchingCoral(Part& part, const Frame& base, float size, Vec3 color, Dice& dice) {
    std::vector<Branch> open;
    const int stems = 5;
    for (int i = 0; i < stems; ++i) {
        const float a = 2 * kPi * (float(i) + dice.range(-0.3f, 0.3f)) / stems, lean = dice.range(0.45f, 0.95f);
        open.push_back({{0.06f * size * std::cos(a), -0.05f * size, 0.06f * size * std::sin(a)},
                        normalize(Vec3{lean * std::cos(a), 0.75f, lean * std::sin(a)}),
                        size * dice.range(0.26f, 0.34f),
                        0.042f * size,
                        0});
    }
    for (std::size_t n = 0; n < open.size(); ++n) {
        const Branch b = open[n];
        Tube tube;
        tube.around = b.level < 2 ? 7 : 5;
        const float depth = float(b.level) / 3;
        tube.root = color * (0.55f + 0.35f * depth);
        tube.tip =
            lerp(color * (0.85f + 0.2f * depth), Vec3{0.95f, 0.92f, 0.85f}, b.level == 3 ? 0.65f : 0.12f * depth);
        Vec3 at = b.from, direction = b.direction;
        const int steps = b.level < 2 ? 3 : 2;
        std::vector<Vec3> headings;
        for (int i = 0; i <= steps; ++i) {
            tube.points.push_back(at);
            tube.radii.push_back(b.radius * (1 - 0.32f * float(i) / float(steps)));
            direction = normalize(jittered(direction, 0.16f, dice) + Vec3{0, 0.10f, 0});
            headings.push_back(direction);
            at += direction * (b.length / float(steps));
        }
        addTube(part, base, tube);
        if (b.level == 3) continue;
        const int children = b.level == 0 ? 3 : 2;
        const float spin = dice.range(0, 2 * kPi);
        for (int i = 0; i < children; ++i) {
            const Vec3 axis = headings.back(), side = anyAcross(axis), other = cross(axis, side);
            const float a = spin + 2 * kPi * float(i) / float(children), spread = dice.range(0.45f, 0.8f);
            const std::size_t joint = tube.points.size() - (i == 0 ? 1 : 2);
            open.push_back({tube.points[joint], normalize(axis + (side * std::cos(a) + other * std::sin(a)) * spread),
                            b.length * dice.range(0.62f, 0.85f), tube.radii[joint] * 0.82f, b.level + 1});
        }
    }
}

void addTableCoral(Part& part, const Frame& base, float size, Vec3 color, Dice& dice) {
    const float radius = 0.5f * size, rise = dice.range(0.20f, 0.32f) * size;
    const std::uint32_t seed = std::uint32_t(dice.below(1 << 20));
    Tube stem;
    stem.around = 10;
    stem.points = {{0, -0.06f * size, 0}, {0.02f * size, 0.4f * rise, 0}, {0.03f * size, 0.85f * rise, 0.01f * size}};
    stem.radii = {0.13f * size, 0.08f * size, 0.16f * size};
    stem.root = color * 0.45f, stem.tip = color * 0.6f;
    addTube(part, base, stem);
    // A shallow dish with a ragged edge; upper and lower side.
    constexpr int kRings = 8, kAround = 36;
    const auto pointAt = [&](int ring, int k, bool upper) {
        const float a = 2 * kPi * float(k % kAround) / kAround, t = float(ring) / kRings;
        const float edge = 1 + 0.16f * noise(2.2f * std::cos(a) + 7, 2.2f * std::sin(a), seed) +
                           0.06f * noise(6 * std::cos(a), 6 * std::sin(a), seed + 1);
        const float r = radius * t * mix(1.0f, edge, t);
        const float x = r * std::cos(a), z = r * std::sin(a);
        const float wave = 0.05f * size * noise(x * 3.2f / size, z * 3.2f / size, seed + 2) +
                           0.012f * size * noise(x * 16 / size, z * 16 / size, seed + 3);
        const float y = rise + 0.16f * size * t * t + wave * t;
        return Vec3{x + 0.03f * size, upper ? y : y - size * mix(0.085f, 0.018f, std::sqrt(t)), z};
    };
    for (const bool upper : {true, false}) {
        std::vector<std::uint32_t> before;
        for (int ring = 0; ring <= kRings; ++ring) {
            std::vector<std::uint32_t> now;
            for (int k = 0; k <= kAround; ++k) {
                const Vec3 p = pointAt(ring, k, upper);
                const Vec3 out =
                    pointAt(std::min(ring + 1, kRings), k, upper) - pointAt(std::max(ring - 1, 0), k, upper);
                const Vec3 round =
                    pointAt(std::max(ring, 1), k + 1, upper) - pointAt(std::max(ring, 1), k + kAround - 1, upper);
                const Vec3 n = normalize(cross(round, out)) * (upper ? 1.0f : -1.0f);
                part.color = upper ? lerp(color * 0.8f, Vec3{0.88f, 0.86f, 0.78f},
                                          ring == kRings ? 0.6f : 0.14f * float(ring) / kRings)
                                   : color * 0.42f;
                now.push_back(part.add(
                    {base.point(p), base.direction(n), base.x, {p.x * part.uvPerMetre, p.z * part.uvPerMetre}}));
            }
            for (std::size_t k = 0; k + 1 < now.size() && ring > 0; ++k) {
                const Vec3 facing = base.y * (upper ? 1.0f : -1.0f);
                part.triangle(before[k], now[k], now[k + 1], facing);
                if (ring > 1) part.triangle(before[k], now[k + 1], before[k + 1], facing);
            }
            before = std::move(now);
        }
    }
    for (int k = 0; k < kAround; ++k) {  // the rim between them
        part.color = lerp(color, Vec3{0.9f, 0.88f, 0.8f}, 0.55f);
        const Vec3 a = pointAt(kRings, k, true), b = pointAt(kRings, k + 1, true), c = pointAt(kRings, k + 1, false),
                   d = pointAt(kRings, k, false);
        const Vec3 n = normalize((a + b) * 0.5f * Vec3{1, 0, 1});
        std::uint32_t v[4];
        int i = 0;
        for (const Vec3 p : {a, b, c, d})
            v[i++] =
                part.add({base.point(p), base.direction(n), base.y, {p.x * part.uvPerMetre, p.z * part.uvPerMetre}});
        part.quad(v[0], v[1], v[2], v[3], base.direction(n));
    }
}

void addBrainCoral(Part& part, const Frame& base, float size, Vec3 color, Dice& dice) {
    Blob blob = makeIcosphere(3);
    const std::uint32_t seed = std::uint32_t(dice.below(1 << 20));
    for (Vec3& p : blob.positions) {
        const float bump = 1 + 0.09f * fractal3(p * 1.6f, 2, seed);
        blob.colors.push_back(Vec3{1, 1, 1} * (0.62f + 0.38f * smoothstep(-0.35f, 0.5f, p.y)));
        p = p * bump * Vec3{0.5f * size, 0.40f * size, 0.5f * size} + Vec3{0, 0.14f * size, 0};
    }
    part.color = color;
    addBlob(part, base, blob);
}

void addSeaFan(Part& part, const Frame& base, float size, Vec3 color, Dice& dice) {
    struct Twig {
        Vec3 from;
        float angle, length, radius;
        int level;
    };
    std::vector<Twig> open{{{0, -0.03f * size, 0}, 0, 0.17f * size, 0.022f * size, 0}};
    constexpr int kLevels = 7;
    for (std::size_t n = 0; n < open.size(); ++n) {
        const Twig t = open[n];
        Tube tube;
        tube.around = t.level < 3 ? 6 : 4;
        tube.root = color * (0.6f + 0.06f * float(t.level)), tube.tip = color * (0.66f + 0.06f * float(t.level));
        Vec3 at = t.from;
        float angle = t.angle;
        for (int i = 0; i <= 2; ++i) {
            tube.points.push_back(at);
            tube.radii.push_back(t.radius * (1 - 0.12f * float(i)));
            angle += dice.range(-0.10f, 0.10f);
            const float bow = 0.10f * (at.x * at.x + at.y * at.y) / size;  // the fan is a little hollow
            at += Vec3{std::sin(angle), std::cos(angle), 0} * (t.length / 2);
            at.z = bow + dice.range(-0.004f, 0.004f) * size;
        }
        addTube(part, base, tube);
        if (t.level + 1 == kLevels) continue;
        for (const float side : {-1.0f, 1.0f})
            open.push_back({tube.points[side < 0 ? 2 : 2 - dice.below(2)],
                            std::clamp(angle + side * dice.range(0.26f, 0.48f), -1.9f, 1.9f),
                            size * dice.range(0.105f, 0.165f), t.radius * 0.74f, t.level + 1});
    }
}

}  // namespace shoal::scene::shapes
