#include "scene/shapes/corals.h"
#include "scene/shapes/props.h"

namespace shoal::scene::shapes {

void addTubeSponge(Part& part, const Frame& base, float size, Vec3 color, Dice& dice) {
    const int pipes = 4 + dice.below(4);
    for (int i = 0; i < pipes; ++i) {
        const float a = 2 * kPi * float(i) / float(pipes) + dice.range(-0.3f, 0.3f), lean = dice.range(0.05f, 0.32f);
        const float r = size * dice.range(0.07f, 0.11f), h = size * dice.range(0.55f, 1.15f);
        const Frame pipe = base.at({0.15f * size * std::cos(a), -0.05f * size, 0.15f * size * std::sin(a)})
                               .tipped(normalize(Vec3{std::sin(a), 0, -std::cos(a)}), lean);
        part.uvOffset = {dice.unit(), dice.unit()};
        part.color = color * dice.range(0.75f, 1.0f);
        addLathe(part, pipe,
                 {{r * 0.62f, 0},
                  {r * 0.85f, 0.25f * h},
                  {r * 0.8f, 0.5f * h},
                  {r * 1.0f, 0.8f * h},
                  {r * 1.12f, 0.96f * h},
                  {r * 1.08f, h},
                  {r * 0.92f, 1.01f * h}},
                 14);
        part.color = color * 0.22f;
        addLathe(part, pipe, {{r * 0.92f, 1.01f * h}, {r * 0.8f, 0.93f * h}, {r * 0.7f, 0.6f * h}, {0, 0.58f * h}}, 14);
    }
}

void addBarrelSponge(Part& part, const Frame& base, float size, Vec3 color, Dice& dice) {
    // Ribs that rise and fork: a lathe whose radius swells round about.
    constexpr int kAround = 56, kRows = 10;
    const std::uint32_t seed = std::uint32_t(dice.below(1 << 20));
    const float ribs = std::round(dice.range(13, 18));
    const auto pointAt = [&](int row, int k, bool inner) {
        const float t = float(row) / kRows, a = 2 * kPi * float(k % kAround) / kAround;
        const float barrel = 0.30f + 0.24f * std::sin(kPi * std::pow(t, 0.9f) * 0.82f);
        const float rib = 0.035f * std::cos(ribs * a + 2.5f * noise(t * 3, a, seed)) * smoothstep(0, 0.2f, t);
        const float r = size * (inner ? (barrel - 0.10f) * mix(0.5f, 1.0f, t) : barrel + rib);
        return Vec3{r * std::cos(a), size * (1.05f * t + 0.03f * noise(2 * std::cos(a), 2 * std::sin(a), seed + 1) * t),
                    r * std::sin(a)};
    };
    for (const bool inner : {false, true}) {
        std::vector<std::uint32_t> before;
        for (int row = inner ? 4 : 0; row <= kRows; ++row) {
            std::vector<std::uint32_t> now;
            for (int k = 0; k <= kAround; ++k) {
                const Vec3 p = pointAt(row, k, inner),
                           round = pointAt(row, k + 1, inner) - pointAt(row, k + kAround - 1, inner);
                const Vec3 up = pointAt(std::min(row + 1, kRows), k, inner) - pointAt(std::max(row - 1, 0), k, inner);
                const Vec3 n = normalize(cross(up, round)) * (inner ? -1.0f : 1.0f);
                part.color = color * (inner ? 0.25f
                                            : 0.6f + 0.4f * float(row) / kRows +
                                                  0.12f * noise(p.x * 9 / size, p.y * 9 / size, seed + 4));
                const float u = std::round(kPi * size * part.uvPerMetre) * float(k) / kAround;
                now.push_back(part.add({base.point(p),
                                        base.direction(n),
                                        base.direction(normalize(round)) * -1.0f,
                                        {-u, -p.y * part.uvPerMetre}}));
            }
            for (std::size_t k = 0; k + 1 < now.size() && !before.empty(); ++k) {
                const float a = 2 * kPi * (float(k) + 0.5f) / kAround, s = inner ? -1.0f : 1.0f;
                part.quad(before[k], now[k], now[k + 1], before[k + 1],
                          base.direction({s * std::cos(a), 0, s * std::sin(a)}));
            }
            if (row == kRows && inner) {  // the lip
                for (int k = 0; k < kAround; ++k) {
                    std::uint32_t v[4];
                    int i = 0;
                    part.color = color * 1.05f;
                    for (const Vec3 p : {pointAt(row, k, false), pointAt(row, k + 1, false), pointAt(row, k + 1, true),
                                         pointAt(row, k, true)})
                        v[i++] =
                            part.add({base.point(p), base.y, base.x, {p.x * part.uvPerMetre, p.z * part.uvPerMetre}});
                    part.quad(v[0], v[1], v[2], v[3], base.y);
                }
            }
            before = std::move(now);
        }
    }
}

void addLeafCoral(Part& part, const Frame& base, float size, Vec3 color, Dice& dice) {
    const int leaves = 9;
    for (int leaf = 0; leaf < leaves; ++leaf) {
        const std::uint32_t seed = std::uint32_t(dice.below(1 << 20));
        const float a = 2.4f * float(leaf), out = 0.10f * size * std::sqrt(float(leaf)),
                    reach = size * dice.range(0.28f, 0.42f);
        const Frame frame =
            base.at({out * std::cos(a), -0.04f * size, -out * std::sin(a)}).turned(a + dice.range(-0.3f, 0.3f));
        constexpr int kAround = 14, kRows = 5;
        const float half = dice.range(0.7f, 1.1f), steep = dice.range(0.5f, 1.1f);
        const auto pointAt = [&](int row, int k) {
            const float t = float(row) / kRows, s = (2 * float(k) / kAround - 1) * half;
            const float r = reach * (0.12f + t * (0.95f + 0.2f * noise(s * 2.5f + 3, 0.5f, seed)));
            const float frill = 0.09f * reach * t * noise(s * 4.5f, 2, seed + 1);
            return Vec3{r * std::cos(s),
                        reach * steep * t * t * (1 + 0.2f * noise(s * 1.5f, 9, seed + 2)) + reach * 0.35f * t + frill,
                        -r * std::sin(s)};
        };
        std::uint32_t v[kRows + 1][kAround + 1];
        for (int row = 0; row <= kRows; ++row)
            for (int k = 0; k <= kAround; ++k) {
                const Vec3 round = pointAt(row, std::min(k + 1, kAround)) - pointAt(row, std::max(k - 1, 0));
                const Vec3 up = pointAt(std::min(row + 1, kRows), k) - pointAt(std::max(row - 1, 0), k);
                const Vec3 p = pointAt(row, k), n = normalize(cross(up, round) * -1.0f);
                part.color = lerp(color * (0.5f + 0.4f * float(row) / kRows), Vec3{0.92f, 0.9f, 0.82f},
                                  row == kRows ? 0.55f : 0.0f);
                v[row][k] = part.add(
                    {frame.point(p),
                     frame.direction(n),
                     frame.direction(normalize(round)),
                     {float(k) * reach / kAround * part.uvPerMetre, -float(row) * reach / kRows * part.uvPerMetre}});
            }
        for (int row = 0; row < kRows; ++row)
            for (int k = 0; k < kAround; ++k) {
                const Vec3 up = pointAt(row + 1, k) - pointAt(row, k), round = pointAt(row, k + 1) - pointAt(row, k);
                part.quad(v[row][k], v[row + 1][k], v[row + 1][k + 1], v[row][k + 1],
                          frame.direction(cross(up, round) * -1.0f));
            }
    }
}

void addSeagrass(Part& part, const Frame& base, float size, Dice& dice) {
    for (int blade = 0; blade < 26; ++blade) {
        const float a = dice.range(0, 2 * kPi), out = 0.32f * size * std::sqrt(dice.unit());
        const float h = size * dice.range(0.5f, 1.1f), w = 0.011f * size * dice.range(0.8f, 1.3f),
                    lean = dice.range(0.1f, 0.75f);
        const Frame frame =
            base.at({out * std::cos(a), -0.02f * size, out * std::sin(a)}).turned(dice.range(0, 2 * kPi));
        const Vec3 color = lerp(Vec3{0.13f, 0.22f, 0.05f}, Vec3{0.30f, 0.36f, 0.09f}, dice.unit());
        constexpr int kSteps = 4;
        std::uint32_t before[2] = {0, 0};
        for (int i = 0; i <= kSteps; ++i) {
            const float t = float(i) / kSteps;
            const Vec3 p{0, h * t * (1 - 0.25f * lean * t), h * lean * t * t * 0.8f},
                n = normalize(Vec3{0, -lean * t, 1});
            part.color = color * (0.6f + 0.5f * t);
            std::uint32_t now[2];
            for (int k = 0; k < 2; ++k)
                now[k] = part.add({frame.point(p + Vec3{(k ? w : -w) * (i == kSteps ? 0.25f : 1.0f), 0, 0}),
                                   frame.direction(n),
                                   frame.x,
                                   {0, 0}});
            if (i > 0) part.quad(before[0], before[1], now[1], now[0], frame.direction(n));
            before[0] = now[0], before[1] = now[1];
        }
    }
}

Blob makeReefRock(std::uint32_t seed, int level) {
    Blob blob = makeBoulder(seed, level, 0);
    for (std::size_t i = 0; i < blob.positions.size(); ++i) {
        const Vec3 p = blob.positions[i];
        const float patch = fractal3(p * 2.2f, 3, seed + 31), other = fractal3(p * 3.1f + Vec3{7, 3, 1}, 3, seed + 37);
        Vec3 color =
            lerp(Vec3{0.62f, 0.54f, 0.40f}, Vec3{0.40f, 0.36f, 0.20f}, smoothstep(-0.2f, 0.4f, patch));  // turf
        color = lerp(color, Vec3{0.62f, 0.34f, 0.42f}, 0.75f * smoothstep(0.15f, 0.4f, other));  // coralline crust
        color = lerp(color, Vec3{0.75f, 0.40f, 0.14f}, 0.8f * smoothstep(0.35f, 0.5f, patch - 0.5f * other));  // sponge
        blob.colors[i] = color * (0.7f + 0.3f * smoothstep(-0.4f, 0.5f, p.y));
    }
    return blob;
}

}  // namespace shoal::scene::shapes
