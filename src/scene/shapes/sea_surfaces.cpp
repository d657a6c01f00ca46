// Textures of what lives under water.
#include <string>

#include "scene/shapes/texels.h"

namespace shoal::scene::shapes {

Surface makePolyps(std::uint32_t seed) {
    return makeSurface(256, 0.22f, [&](float u, float v) {
        const Cell cup = cellNoise(u * 18, v * 18, seed, 18, 18);
        const float rim = 1 - smoothstep(0.12f, 0.42f, cup.distance),
                    mouth = 1 - smoothstep(0.05f, 0.16f, cup.distance);
        const float patch = fractal(u * 3, v * 3, 3, seed + 5, 3, 3);
        Texel t;
        t.albedo = Vec3{1, 1, 1} * std::clamp(0.66f + 0.3f * rim - 0.35f * mouth + 0.1f * patch, 0.08f, 1.0f);
        t.height = 0.0035f * rim - 0.002f * mouth + 0.001f * patch;
        t.roughness = 0.85f;
        return t;
    });
}

Surface makeMeanders(std::uint32_t seed) {
    return makeSurface(512, 0.6f, [&](float u, float v) {
        // Bands of equal phase of a strongly warped field wind like a brain coral's valleys.
        const float warpU = 0.16f * fractal(u * 7, v * 7, 2, seed, 7, 7),
                    warpV = 0.16f * fractal(u * 7, v * 7, 2, seed + 9, 7, 7);
        const float field = noise((u + warpU) * 8, (v + warpV) * 8, seed + 3, 8, 8);
        const float ridge = 0.5f + 0.5f * std::sin(field * 15);
        const float septa = 0.5f + 0.5f * std::sin(2 * kPi * 90 * (u + warpU) + 2 * kPi * 90 * (v - warpV));
        const float grain = noise(u * 90, v * 90, seed + 7, 90, 90);
        Texel t;
        t.albedo = lerp(Vec3{0.46f, 0.60f, 0.40f}, Vec3{1, 1, 1}, smoothstep(0.15f, 0.75f, ridge)) *
                   (0.92f + 0.06f * grain - 0.08f * septa * (1 - ridge));
        t.height = 0.007f * smoothstep(0.0f, 0.9f, ridge) + 0.0006f * septa + 0.0004f * grain;
        t.roughness = 0.8f;
        return t;
    });
}

Surface makeSilt(std::uint32_t seed) {
    return makeSurface(1024, 4.0f, [&](float u, float v) {
        // Ripples of waves: parallel crests that bend, fork where two trains cross, and die out in patches.
        const float bend = 0.30f * noise(u * 3, v * 3, seed, 3, 3) + 0.10f * noise(u * 8, v * 8, seed + 1, 8, 8);
        const float first = std::sin(2 * kPi * (v * 26 + bend * 5 + u * 2)),
                    second = std::sin(2 * kPi * (v * 23 + bend * 6 - u * 3));
        const float which = smoothstep(-0.25f, 0.25f, noise(u * 4, v * 4, seed + 2, 4, 4));
        const float wave = 0.5f + 0.5f * mix(first, second, which);
        const float strength = 0.45f + 0.55f * smoothstep(-0.4f, 0.3f, fractal(u * 4, v * 4, 3, seed + 3, 4, 4));
        const float ripple = wave * wave * strength;
        const float grain = noise(u * 400, v * 400, seed + 5, 400, 400),
                    patch = fractal(u * 5, v * 5, 4, seed + 8, 5, 5);
        const Cell bit = cellNoise(u * 70, v * 70, seed + 13, 70, 70);
        const float shell = (bit.id & 31) == 0 ? 1 - smoothstep(0.12f, 0.22f, bit.distance + 0.06f * grain) : 0;
        const Vec3 shellColor = lerp(Vec3{0.80f, 0.76f, 0.70f}, Vec3{0.22f, 0.20f, 0.18f}, float((bit.id >> 8) & 1));
        Texel t;
        t.albedo = lerp(Vec3{0.58f, 0.52f, 0.42f} * (0.84f + 0.14f * ripple + 0.08f * grain + 0.07f * patch),
                        shellColor, 0.8f * shell);
        t.height = 0.020f * ripple + 0.0010f * grain + 0.008f * patch + 0.004f * shell;
        t.roughness = 0.95f;
        return t;
    });
}

namespace {

// How a species is coloured at u (snout 0, tail 1) and h (belly -1, back 1).
struct Pattern {
    Vec3 color;
    float roughness = 0.38f;
};

Pattern sardine(float u, float h, float speck) {
    const float back = smoothstep(0.15f, 0.5f, h + 0.05f * speck);
    Pattern p{lerp(Vec3{0.66f, 0.70f, 0.72f}, Vec3{0.07f, 0.15f, 0.20f}, back), mix(0.28f, 0.42f, back)};
    p.color = lerp(p.color, {0.86f, 0.87f, 0.86f}, smoothstep(0.2f, 0.8f, -h));
    const float spots =
        smoothstep(0.75f, 0.9f, std::cos(2 * kPi * u * 12)) * (1 - smoothstep(0.05f, 0.12f, std::abs(h - 0.12f)));
    p.color = lerp(p.color, {0.03f, 0.05f, 0.07f}, 0.7f * spots * smoothstep(0.2f, 0.3f, u));
    return p;
}

Pattern fusilier(float u, float h, float speck) {
    const Vec3 blue{0.04f, 0.24f, 0.52f}, pale{0.62f, 0.76f, 0.80f}, yellow{0.85f, 0.62f, 0.05f};
    Pattern p{lerp(blue, pale, smoothstep(0.1f, -0.7f, h)), 0.34f};
    // Yellow from the nape to the tail, widening.
    const float edge = mix(0.95f, -0.2f, smoothstep(0.25f, 0.95f, u));
    p.color = lerp(p.color, yellow, smoothstep(edge - 0.06f, edge + 0.06f, h + 0.04f * speck));
    return p;
}

Pattern butterfly(float u, float h, float speck) {
    const Vec3 yellow{0.90f, 0.66f, 0.06f}, white{0.86f, 0.84f, 0.76f}, black{0.015f, 0.015f, 0.02f};
    Pattern p{lerp(white, yellow, smoothstep(-0.3f, 0.5f, h * 0.5f + (u - 0.4f) * 1.8f)), 0.42f};
    const float chevron = 0.5f + 0.5f * std::sin(2 * kPi * (u * 13 + std::abs(h) * 2.2f));
    p.color = lerp(p.color, p.color * 0.45f, 0.6f * smoothstep(0.75f, 0.95f, chevron) * smoothstep(0.2f, 0.3f, u));
    p.color = lerp(p.color, black, 1 - smoothstep(0.028f, 0.042f, std::abs(u - 0.13f - 0.02f * h + 0.003f * speck)));
    p.color = lerp(p.color, black, 1 - smoothstep(0.02f, 0.035f, std::abs(u - 0.80f)));
    return p;
}

Pattern sergeant(float u, float h, float speck) {
    const float bar = std::cos(2 * kPi * (u - 0.24f) / 0.135f);
    const float dark =
        smoothstep(-0.1f, 0.45f, bar + 0.12f * speck) * smoothstep(0.14f, 0.2f, u) * smoothstep(-0.95f, -0.4f, h);
    Pattern p{lerp(Vec3{0.70f, 0.76f, 0.74f}, Vec3{0.72f, 0.64f, 0.08f}, smoothstep(0.2f, 0.8f, h)), 0.40f};
    p.color = lerp(p.color, {0.02f, 0.03f, 0.05f}, 0.95f * dark);
    return p;
}

Pattern grouper(float u, float h, float speck) {
    Pattern p{lerp(Vec3{0.34f, 0.25f, 0.17f}, Vec3{0.58f, 0.47f, 0.34f}, smoothstep(0.4f, -0.6f, h)), 0.55f};
    const float bar = smoothstep(0.2f, 0.7f, std::cos(2 * kPi * (u + 0.05f * h) / 0.19f) + 0.5f * speck);
    p.color = p.color * (1 - 0.55f * bar * smoothstep(0.15f, 0.25f, u));
    return p;
}

Pattern patternOf(std::string_view species, float u, float h, float speck) {
    if (species == "fusilier") return fusilier(u, h, speck);
    if (species == "butterfly") return butterfly(u, h, speck);
    if (species == "sergeant") return sergeant(u, h, speck);
    if (species == "grouper") return grouper(u, h, speck);
    return sardine(u, h, speck);
}

}  // namespace

Surface makeFishSkin(std::string_view species, std::uint32_t seed) {
    return makeSurface(512, 1.0f, [&](float u, float v) {
        const float h = std::cos(2 * kPi * v), side = v < 0.5f ? v : 1 - v;
        const float speck = fractal(u * 10, side * 20, 3, seed);
        // Scales: rows of overlapping discs, each row shifted by half a scale; none on the head.
        const float row = side * 44, column = u * 64 + 0.5f * float(int(row) & 1);
        const float du = column - std::floor(column) - 0.2f, dv = row - std::floor(row) - 0.5f;
        const float disc = std::sqrt(du * du + dv * dv), body = smoothstep(0.19f, 0.24f, u);
        const float scale = body * smoothstep(0.35f, 0.75f, disc);
        const float gill = 1 - smoothstep(0.004f, 0.012f, std::abs(u - 0.205f - 0.035f * (1 - h * h)));
        const float mouth =
            (1 - smoothstep(0.003f, 0.010f, std::abs(h + 0.12f + 2.2f * u))) * (1 - smoothstep(0.03f, 0.055f, u));
        Pattern p = patternOf(species, u, h, speck);
        p.color = p.color * (1 - 0.20f * scale - 0.55f * gill * smoothstep(-0.9f, -0.6f, h) - 0.6f * mouth);
        Texel t;
        t.albedo = p.color * (1 + 0.05f * speck);
        t.height = 0.0016f * (1 - scale) * body - 0.004f * gill;
        t.roughness = std::clamp(p.roughness + 0.08f * scale, 0.1f, 1.0f);
        return t;
    });
}

}  // namespace shoal::scene::shapes
