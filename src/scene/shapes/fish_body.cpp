#include "scene/shapes/fish_body.h"

#include <span>

#include "scene/shapes/noise.h"

namespace shoal::scene::shapes {
namespace {

// A cross-section at `at` (snout 0, tip of the tail 1): how far the body reaches up, down and to a side.
struct Section {
    float at, up, down, side;
};

struct Fin {
    float from, to, height, sweep;  // along the body; height and how far its edge lies back
};

struct Kind {
    std::span<const Section> sections;
    Fin dorsal, anal;
    float tailSpan, tailFork, pectoral;
    float eye, eyeAt, eyeUp;
    Vec3 finColor, finEdge;
};

constexpr Section kFusilierBody[] = {{0.004f, 0.006f, 0.006f, 0.004f}, {0.03f, 0.035f, 0.03f, 0.022f},
                                     {0.1f, 0.075f, 0.065f, 0.042f},   {0.25f, 0.12f, 0.115f, 0.062f},
                                     {0.42f, 0.135f, 0.135f, 0.066f},  {0.6f, 0.105f, 0.11f, 0.05f},
                                     {0.76f, 0.055f, 0.055f, 0.026f},  {0.85f, 0.032f, 0.032f, 0.014f}};
constexpr Kind kFusilier{
    kFusilierBody, {0.28f, 0.74f, 0.06f, 0.05f}, {0.56f, 0.76f, 0.05f, 0.05f}, 0.16f, 0.11f, 0.13f, 0.026f, 0.105f,
    0.02f,         {0.72f, 0.58f, 0.10f},        {0.30f, 0.36f, 0.30f}};

constexpr Section kButterflyBody[] = {
    {0.004f, 0.006f, 0.006f, 0.004f}, {0.04f, 0.022f, 0.024f, 0.014f}, {0.1f, 0.075f, 0.07f, 0.03f},
    {0.2f, 0.19f, 0.15f, 0.052f},     {0.35f, 0.28f, 0.25f, 0.066f},   {0.52f, 0.30f, 0.29f, 0.062f},
    {0.68f, 0.25f, 0.25f, 0.046f},    {0.79f, 0.11f, 0.11f, 0.026f},   {0.85f, 0.058f, 0.058f, 0.014f}};
constexpr Kind kButterfly{
    kButterflyBody, {0.26f, 0.80f, 0.09f, 0.05f}, {0.52f, 0.80f, 0.08f, 0.05f}, 0.10f, 0.01f, 0.14f, 0.028f, 0.125f,
    0.03f,          {0.88f, 0.66f, 0.08f},        {0.30f, 0.20f, 0.03f}};

constexpr Section kSergeantBody[] = {{0.004f, 0.008f, 0.008f, 0.006f}, {0.03f, 0.05f, 0.045f, 0.026f},
                                     {0.1f, 0.115f, 0.105f, 0.048f},   {0.22f, 0.185f, 0.17f, 0.066f},
                                     {0.38f, 0.22f, 0.215f, 0.07f},    {0.56f, 0.18f, 0.185f, 0.054f},
                                     {0.72f, 0.095f, 0.10f, 0.03f},    {0.83f, 0.052f, 0.052f, 0.015f}};
constexpr Kind kSergeant{
    kSergeantBody, {0.26f, 0.76f, 0.085f, 0.06f}, {0.5f, 0.76f, 0.09f, 0.06f}, 0.17f, 0.08f, 0.15f, 0.03f, 0.10f,
    0.03f,         {0.42f, 0.46f, 0.42f},         {0.05f, 0.06f, 0.08f}};

constexpr Section kGrouperBody[] = {{0.004f, 0.01f, 0.015f, 0.01f},  {0.03f, 0.045f, 0.06f, 0.045f},
                                    {0.12f, 0.11f, 0.125f, 0.085f},  {0.26f, 0.165f, 0.17f, 0.11f},
                                    {0.42f, 0.175f, 0.175f, 0.11f},  {0.6f, 0.14f, 0.14f, 0.08f},
                                    {0.75f, 0.085f, 0.085f, 0.045f}, {0.85f, 0.065f, 0.065f, 0.024f}};
constexpr Kind kGrouper{
    kGrouperBody, {0.28f, 0.80f, 0.085f, 0.04f}, {0.58f, 0.78f, 0.075f, 0.05f}, 0.13f, -0.02f, 0.17f, 0.024f, 0.115f,
    0.06f,        {0.30f, 0.23f, 0.17f},         {0.10f, 0.08f, 0.07f}};

constexpr Section kSardineBody[] = {{0.004f, 0.006f, 0.006f, 0.004f}, {0.03f, 0.028f, 0.032f, 0.02f},
                                    {0.1f, 0.058f, 0.068f, 0.038f},   {0.25f, 0.088f, 0.105f, 0.054f},
                                    {0.45f, 0.092f, 0.115f, 0.056f},  {0.65f, 0.066f, 0.08f, 0.04f},
                                    {0.8f, 0.034f, 0.036f, 0.02f},    {0.86f, 0.024f, 0.024f, 0.01f}};
constexpr Kind kSardine{
    kSardineBody, {0.42f, 0.56f, 0.075f, 0.06f}, {0.68f, 0.8f, 0.035f, 0.03f}, 0.13f, 0.11f, 0.10f, 0.026f, 0.09f,
    0.012f,       {0.34f, 0.42f, 0.42f},         {0.14f, 0.19f, 0.21f}};

const Kind& kindOf(std::string_view species) {
    if (species == "fusilier") return kFusilier;
    if (species == "butterfly") return kButterfly;
    if (species == "sergeant") return kSergeant;
    if (species == "grouper") return kGrouper;
    return kSardine;
}

float zOf(float u) { return 0.5f - u; }

Section sectionAt(std::span<const Section> all, float u) {
    std::size_t i = 0;
    while (i + 2 < all.size() && all[i + 1].at < u) ++i;
    const auto tangent = [&](std::size_t k, float Section::*of) {
        const Section &a = all[k > 0 ? k - 1 : 0], &b = all[std::min(k + 1, all.size() - 1)];
        return (b.*of - a.*of) / (b.at - a.at);
    };
    const float span = all[i + 1].at - all[i].at, t = std::clamp((u - all[i].at) / span, 0.0f, 1.0f);
    const auto hermite = [&](float Section::*of) {
        const float t2 = t * t, t3 = t2 * t;
        return (2 * t3 - 3 * t2 + 1) * all[i].*of + (t3 - 2 * t2 + t) * span * tangent(i, of) +
               (3 * t2 - 2 * t3) * all[i + 1].*of + (t3 - t2) * span * tangent(i + 1, of);
    };
    return {u, hermite(&Section::up), hermite(&Section::down), hermite(&Section::side)};
}

constexpr int kAround = 14;

void addBody(Part& part, const Kind& kind) {
    // Rings closer together at the head, where the shape turns.
    std::vector<float> rings;
    const float first = kind.sections.front().at, last = kind.sections.back().at;
    for (int i = 0; i <= 17; ++i) rings.push_back(mix(first, last, std::pow(float(i) / 17, 1.35f)));
    const auto pointAt = [&](float u, float turn) {
        const Section s = sectionAt(kind.sections, u);
        const float c = std::cos(turn), sine = std::sin(turn);
        return Vec3{s.side * sine, c * (c > 0 ? s.up : s.down), zOf(u)};
    };
    const auto add = [&](float u, int i) {
        const float turn = 2 * kPi * float(i) / kAround, e = 0.002f;
        const Vec3 along = pointAt(std::min(u + e, last), turn) - pointAt(std::max(u - e, first), turn);
        const Vec3 around = pointAt(u, turn + 0.02f) - pointAt(u, turn - 0.02f);
        return part.add({pointAt(u, i == kAround ? 0 : turn),
                         normalize(cross(around, along)),
                         normalize(along),
                         {u, float(i) / kAround}});
    };
    std::vector<std::uint32_t> before;
    for (std::size_t r = 0; r < rings.size(); ++r) {
        std::vector<std::uint32_t> ring;
        for (int i = 0; i <= kAround; ++i) ring.push_back(add(rings[r], i));
        for (int i = 0; i < kAround && r > 0; ++i) {
            const float turn = 2 * kPi * (float(i) + 0.5f) / kAround;
            const std::size_t k = std::size_t(i);
            part.quad(before[k], ring[k], ring[k + 1], before[k + 1], {std::sin(turn), std::cos(turn), 0});
        }
        if (r == 0 || r + 1 == rings.size()) {  // close both ends
            const float z = zOf(rings[r]), out = r == 0 ? 1.0f : -1.0f;
            const std::uint32_t middle =
                part.add({{0, 0, z + out * 0.003f}, {0, 0, out}, {0, 1, 0}, {rings[r], 0.25f}});
            for (std::size_t k = 0; k < kAround; ++k) part.triangle(middle, ring[k], ring[k + 1], {0, 0, out});
        }
        before = std::move(ring);
    }
}

// A strip of a fin: base and edge points in pairs.
void addStrip(Part& part, const Kind& kind, const std::vector<std::array<Vec3, 2>>& pairs, Vec3 normal) {
    std::uint32_t before[2] = {0, 0};
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::uint32_t now[2];
        for (std::size_t k = 0; k < 2; ++k) {
            // Rays: every other one a little darker.
            part.color = lerp(kind.finColor, kind.finEdge, float(k)) * (i % 2 ? 1.0f : 0.8f);
            now[k] = part.add({pairs[i][k], normal, {0, 0, 1}, {0, 0}});
        }
        if (i > 0) part.quad(before[0], now[0], now[1], before[1], normal);
        before[0] = now[0], before[1] = now[1];
    }
}

void addMedianFin(Part& part, const Kind& kind, const Fin& fin, float sign) {
    std::vector<std::array<Vec3, 2>> pairs;
    constexpr int kRays = 9;
    for (int i = 0; i <= kRays; ++i) {
        const float t = float(i) / kRays, u = mix(fin.from, fin.to, t);
        const Section s = sectionAt(kind.sections, u);
        const float base = sign * (sign > 0 ? s.up : s.down);
        const float shape = smoothstep(-0.04f, 0.3f, t) * mix(1.0f, 0.45f, smoothstep(0.35f, 1.0f, t));
        pairs.push_back({Vec3{0, base * 0.93f, zOf(u)},
                         {0, base + sign * fin.height * (0.08f + shape), zOf(u + fin.sweep * (0.3f + 0.7f * t))}});
    }
    addStrip(part, kind, pairs, {1, 0, 0});
}

void addTail(Part& part, const Kind& kind) {
    std::vector<std::array<Vec3, 2>> pairs;
    const Section root = sectionAt(kind.sections, kind.sections.back().at - 0.015f);
    constexpr int kRays = 12;
    for (int i = 0; i <= kRays; ++i) {
        const float t = 2 * float(i) / kRays - 1, reach = std::abs(t);
        const float edge =
            1 - kind.tailFork * (1 - std::pow(reach, 1.2f)) - (kind.tailFork < 0.03f ? 0.05f * reach * reach : 0);
        pairs.push_back({Vec3{0, root.up * 0.9f * t, zOf(root.at)}, {0, kind.tailSpan * t, zOf(edge)}});
    }
    addStrip(part, kind, pairs, {1, 0, 0});
}

void addPairedFins(Part& part, const Kind& kind) {
    for (const float side : {-1.0f, 1.0f}) {
        const float at = 0.24f;
        const Section s = sectionAt(kind.sections, at);
        const Vec3 root{side * s.side * 0.92f, -0.25f * s.down, zOf(at)};
        const Vec3 back = normalize(Vec3{side * 0.55f, -0.25f, -0.8f}), up = normalize(cross(back, {side, 0.6f, 0.4f}));
        std::vector<std::array<Vec3, 2>> pairs;
        for (int i = 0; i <= 5; ++i) {
            const float t = float(i) / 5, spread = (t - 0.5f) * 2;
            pairs.push_back({root + up * (0.016f * spread),
                             root + (back * (1 - 0.35f * spread * spread) + up * (0.42f * spread)) * kind.pectoral});
        }
        addStrip(part, kind, pairs, normalize(cross(back, up)) * side);
        const float low = 0.3f;  // pelvic fin
        const Section belly = sectionAt(kind.sections, low);
        const Vec3 hip{side * 0.3f * belly.side, -0.93f * belly.down, zOf(low)};
        addStrip(part, kind,
                 {{hip, hip + Vec3{side * 0.03f, -0.03f, -0.055f}},
                  {hip + Vec3{0, 0, -0.05f}, hip + Vec3{side * 0.03f, -0.02f, -0.10f} * (kind.pectoral / 0.13f)}},
                 normalize(Vec3{1, side * 0.5f, 0}));
    }
}

void addEyes(Part& part, const Kind& kind) {
    const Section s = sectionAt(kind.sections, kind.eyeAt);
    for (const float side : {-1.0f, 1.0f}) {
        const float height = kind.eyeUp / s.up;
        const Vec3 out = normalize(Vec3{side, 0.25f * height, 0.18f});
        const Vec3 at{side * s.side * std::sqrt(1 - height * height) * 0.9f, kind.eyeUp, zOf(kind.eyeAt)};
        const Vec3 x = normalize(cross(out, {0, 0, 1}));
        const Frame frame{at, x, out, cross(x, out)};
        const float r = kind.eye;
        part.color = {0.72f, 0.66f, 0.42f};
        addLathe(part, frame, {{r, -0.3f * r}, {r * 0.95f, 0.14f * r}, {r * 0.6f, 0.36f * r}}, 12);
        part.color = {0.012f, 0.012f, 0.015f};
        addLathe(part, frame, {{r * 0.6f, 0.36f * r}, {r * 0.3f, 0.46f * r}, {0, 0.5f * r}}, 12);
    }
}

}  // namespace

void addFish(Part& body, Part& fins, Part& eyes, std::string_view species) {
    const Kind& kind = kindOf(species);
    addBody(body, kind);
    addMedianFin(fins, kind, kind.dorsal, 1);
    addMedianFin(fins, kind, kind.anal, -1);
    addTail(fins, kind);
    addPairedFins(fins, kind);
    addEyes(eyes, kind);
}

Vec4 fishWeights(float z) {
    float w[4] = {0, 0, 0, 0};
    std::size_t i = 0;
    while (i < 3 && z < kFishJoints[i + 1]) ++i;
    if (i == 0) {
        const float t =
            smoothstep(0, 1, std::clamp((kFishJoints[0] - z) / (kFishJoints[0] - kFishJoints[1]), 0.0f, 1.0f));
        w[0] = 1 - t, w[1] = t;
    } else if (i == 3) {
        w[3] = 1;
    } else {
        const float t = smoothstep(0, 1, (kFishJoints[i] - z) / (kFishJoints[i] - kFishJoints[i + 1]));
        w[i] = 1 - t, w[i + 1] = t;
    }
    return {w[0], w[1], w[2], w[3]};
}

}  // namespace shoal::scene::shapes
