#include "scene/shapes/surfaces.h"

#include "scene/shapes/texels.h"

namespace shoal::scene::shapes {

Surface makeWood(std::uint32_t seed) {
    return makeSurface(512, 1.2f, [&](float u, float v) {
        const float sway = 0.6f * noise(u * 3, v * 4, seed, 3, 4);
        // Growth rings cut lengthwise: bands across v that wander along u.
        const float rings =
            0.5f + 0.5f * std::sin(2 * kPi * (v * 14 + sway + 0.35f * noise(u * 2, v * 14, seed + 1, 2, 14)));
        const float fibre = fractal(u * 6, v * 96, 2, seed + 2, 6, 96);
        const float crack = smoothstep(0.52f, 0.75f, noise(u * 5, v * 70, seed + 5, 5, 70));
        const float stain = fractal(u * 3, v * 5, 3, seed + 7, 3, 5);
        const float value = 0.42f + 0.24f * rings + 0.3f * fibre + 0.3f * stain;
        const Vec3 light{0.40f, 0.285f, 0.185f}, dark{0.13f, 0.085f, 0.052f};
        Texel t;
        t.albedo = lerp(dark, light, std::clamp(value, 0.0f, 1.2f)) * (1 - 0.75f * crack);
        t.height = 0.0006f * rings + 0.0007f * fibre - 0.0022f * crack;
        t.roughness = std::clamp(0.72f + 0.12f * fibre - 0.1f * stain + 0.2f * crack, 0.4f, 1.0f);
        return t;
    });
}

Surface makeStone(std::uint32_t seed) {
    return makeSurface(512, 1.6f, [&](float u, float v) {
        const float blotch = fractal(u * 3, v * 3, 4, seed, 3, 3);
        const float grain = noise(u * 128, v * 128, seed + 9, 128, 128);
        const float chisel = fractal(u * 12, v * 12, 3, seed + 11, 12, 12);
        const Cell pit = cellNoise(u * 24, v * 24, seed + 17, 24, 24);
        const float size =
            0.04f + 0.16f * unitOf(pit.id * 747796405u) * unitOf(pit.id * 747796405u);  // few large, many small
        const float hole = (pit.id & 7) < 3 ? 1 - smoothstep(0.3f * size, size, pit.distance + 0.05f * chisel) : 0;
        const float vein = 1 - smoothstep(0.0f, 0.05f, std::abs(fractal(u * 2, v * 2, 3, seed + 21, 2, 2) - 0.05f));
        const float value = 0.40f + 0.12f * blotch + 0.05f * grain + 0.06f * chisel - 0.12f * hole - 0.05f * vein;
        Texel t;
        t.albedo = Vec3{1.0f, 0.965f, 0.9f + 0.05f * blotch} * std::clamp(value, 0.05f, 0.9f);
        t.height = 0.006f * chisel + 0.0008f * grain - 0.005f * hole + 0.006f * blotch;
        t.roughness = std::clamp(0.8f + 0.1f * grain + 0.1f * hole, 0.5f, 1.0f);
        return t;
    });
}

Surface makeRock(std::uint32_t seed) {
    return makeSurface(512, 1.6f, [&](float u, float v) {
        const float warp = 0.35f * noise(u * 4, v * 4, seed + 2, 4, 4);
        const float blotch = fractal(u * 4, v * 4, 4, seed, 4, 4);
        const float fissure = std::abs(fractal(u * 5 + warp, v * 5 - warp, 4, seed + 31, 5, 5));
        const float crack = 1 - smoothstep(0.0f, 0.10f, fissure);
        const float grain = noise(u * 140, v * 140, seed + 9, 140, 140);
        const Cell spot = cellNoise(u * 16, v * 16, seed + 17, 16, 16);
        const float lichen =
            (spot.id & 7) < 2 ? (1 - smoothstep(0.15f, 0.3f, spot.distance + 0.12f * grain + 0.1f * blotch)) : 0;
        const float value = 0.36f + 0.13f * blotch + 0.05f * grain + 0.14f * std::min(fissure, 0.6f) - 0.05f * crack;
        Texel t;
        t.albedo =
            lerp(Vec3{1.0f, 0.96f, 0.90f} * std::clamp(value, 0.04f, 0.9f), Vec3{0.40f, 0.40f, 0.28f}, 0.55f * lichen);
        t.height = 0.03f * std::min(fissure, 0.5f) + 0.014f * blotch + 0.0014f * grain;
        t.roughness = 0.9f;
        return t;
    });
}

Surface makeConcrete(std::uint32_t seed) {
    return makeSurface(512, 3.0f, [&](float u, float v) {
        const float cloud = fractal(u * 3, v * 3, 4, seed, 3, 3);
        const float grain = noise(u * 170, v * 170, seed + 9, 170, 170);
        const Cell pore = cellNoise(u * 48, v * 48, seed + 17, 48, 48);
        const float hole = (pore.id & 15) < 3 ? 1 - smoothstep(0.05f, 0.14f, pore.distance) : 0;
        const float wander = fractal(u * 2, v * 2, 4, seed + 31, 2, 2);
        const float crack = (1 - smoothstep(0.0f, 0.008f, std::abs(wander))) * smoothstep(0.05f, 0.3f, cloud);
        const float stain = smoothstep(0.1f, 0.6f, fractal(u * 2, v * 2, 3, seed + 41, 2, 2));
        const float value = 0.36f + 0.06f * cloud + 0.025f * grain - 0.12f * hole - 0.16f * crack - 0.08f * stain;
        Texel t;
        t.albedo = Vec3{1.0f, 0.985f, 0.95f} * std::clamp(value, 0.05f, 0.9f);
        t.height = 0.003f * cloud + 0.0006f * grain - 0.004f * hole - 0.004f * crack;
        t.roughness = std::clamp(0.72f + 0.12f * cloud + 0.1f * grain - 0.22f * stain, 0.3f, 1.0f);
        return t;
    });
}

Surface makeSand(std::uint32_t seed) {
    return makeSurface(512, 2.4f, [&](float u, float v) {
        const float bend = 0.35f * noise(u * 3, v * 3, seed, 3, 3) + 0.12f * noise(u * 9, v * 9, seed + 1, 9, 9);
        const float phase = v * 14 + bend * 3;
        const float wave = std::sin(2 * kPi * phase);
        const float ripple =
            (0.5f + 0.5f * wave) * (0.5f + 0.5f * wave) * (0.7f + 0.5f * noise(u * 5, v * 5, seed + 3, 5, 5));
        const float grain = noise(u * 200, v * 200, seed + 5, 200, 200);
        const float patch = fractal(u * 4, v * 4, 4, seed + 8, 4, 4);
        const Cell pebble = cellNoise(u * 40, v * 40, seed + 13, 40, 40);
        const float stone = (pebble.id & 63) < 2 ? 1 - smoothstep(0.12f, 0.22f, pebble.distance) : 0;
        Texel t;
        t.albedo = lerp(Vec3{0.60f, 0.50f, 0.37f} * (0.92f + 0.10f * ripple + 0.10f * grain + 0.09f * patch),
                        Vec3{0.42f, 0.38f, 0.33f}, stone * 0.8f);
        t.height = 0.011f * ripple + 0.0012f * grain + 0.006f * patch + 0.004f * stone;
        t.roughness = 0.92f;
        return t;
    });
}

Surface makeGrit(std::uint32_t seed) {
    return makeSurface(512, 3.0f, [&](float u, float v) {
        const float patch = fractal(u * 4, v * 4, 4, seed, 4, 4);
        const float fine = noise(u * 150, v * 150, seed + 7, 150, 150);
        const Cell lump = cellNoise(u * 28, v * 28, seed + 3, 28, 28);
        const float bump = 1 - smoothstep(0.1f, 0.55f, lump.distance);
        const float value = 0.74f + 0.13f * patch + 0.12f * fine + 0.1f * (bump - 0.4f) * (unitOf(lump.id) - 0.2f);
        Texel t;
        t.albedo = Vec3{1, 1, 1} * std::clamp(value, 0.1f, 1.0f);
        t.height = 0.012f * bump * unitOf(lump.id) + 0.002f * fine + 0.012f * patch;
        t.roughness = 0.95f;
        return t;
    });
}

Surface makePlaster(std::uint32_t seed) {
    return makeSurface(512, 4.0f, [&](float u, float v) {
        const float cloud = fractal(u * 3, v * 3, 4, seed, 3, 3), grain = noise(u * 150, v * 150, seed + 9, 150, 150);
        // Streaks that rain leaves, long in v.
        const float streak = smoothstep(0.15f, 0.8f, fractal(u * 22, v * 2, 3, seed + 41, 22, 2));
        const float trowel = fractal(u * 14, v * 14, 3, seed + 31, 14, 14);
        Texel t;
        t.albedo = Vec3{1.0f, 0.99f, 0.97f} * (0.78f + 0.11f * cloud + 0.04f * grain - 0.10f * streak);
        t.height = 0.003f * trowel + 0.0009f * grain;
        t.roughness = 0.93f;
        return t;
    });
}

Surface makeRoofTiles(std::uint32_t seed) {
    constexpr float kMetres = 2.4f;
    constexpr int kColumns = 12, kRows = 8;
    return makeSurface(512, kMetres, [&](float u, float v) {
        const float row = v * kRows, column = u * kColumns;
        const float down = row - std::floor(row), across = 2 * (column - std::floor(column)) - 1;
        const std::uint32_t id = latticeHash(std::uint32_t(column), std::uint32_t(row), seed);
        const float arch = std::sqrt(std::max(0.0f, 1 - across * across));
        const float lichen = fractal(u * 4, v * 4, 4, seed + 3, 4, 4),
                    grain = noise(u * 120, v * 120, seed + 5, 120, 120);
        const float edge = smoothstep(0.0f, 0.12f, down) * (0.45f + 0.55f * smoothstep(0.0f, 0.5f, arch));
        const Vec3 clay = lerp(Vec3{0.42f, 0.16f, 0.075f}, Vec3{0.50f, 0.27f, 0.15f}, unitOf(id)) *
                          (0.75f + 0.4f * unitOf(latticeHash(id, 1, seed)) + 0.06f * grain);
        Texel t;
        t.albedo = lerp(clay, Vec3{0.27f, 0.25f, 0.19f}, 0.75f * smoothstep(0.1f, 0.75f, lichen)) * edge;
        t.height = 0.045f * arch + 0.02f * down + 0.001f * grain;
        t.roughness = 0.85f;
        return t;
    });
}

Surface makeRipples(std::uint32_t seed) {
    return makeSurface(512, 20.0f, [&](float u, float v) {
        const float bend = 0.5f * noise(u * 5, v * 5, seed + 7, 5, 5);
        const float swell = noise(u * 5 + 0.3f * bend, v * 9, seed, 5, 9);
        const float chop = noise(u * 14 + bend, v * 22, seed + 1, 14, 22),
                    fine = fractal(u * 40, v * 52, 2, seed + 2, 40, 52);
        // Gusts leave some patches smoother.
        const float calm = 0.55f + 0.45f * smoothstep(-0.4f, 0.5f, fractal(u * 3, v * 3, 2, seed + 4, 3, 3));
        Texel t;
        t.albedo = {1, 1, 1};
        t.height = 0.045f * swell + calm * (0.03f * (1 - 2 * std::abs(chop)) + 0.008f * fine);
        t.roughness = 0.07f;
        return t;
    });
}

Surface makeTiles(std::uint32_t seed, float tileSize, int count) {
    const int size = count >= 6 ? 512 : 256;
    const float joint = std::clamp(0.004f / tileSize, 0.02f, 0.06f);  // half its width, in tiles
    return makeSurface(size, tileSize * float(count), [&](float u, float v) {
        const float x = u * float(count), y = v * float(count);
        const float fx = x - std::floor(x), fy = y - std::floor(y);
        const std::uint32_t id = latticeHash(std::uint32_t(x), std::uint32_t(y), seed);
        const float edge = std::min(std::min(fx, 1 - fx), std::min(fy, 1 - fy));
        const float body = smoothstep(joint * 0.8f, joint * 1.6f, edge);
        const float glaze = fractal(u * 8, v * 8, 3, seed + 3, 8, 8), dirt = fractal(u * 5, v * 5, 4, seed + 5, 5, 5);
        const float shade = 0.86f + 0.12f * (unitOf(id) - 0.5f) + 0.03f * glaze;
        const float hue = unitOf(latticeHash(id, 1, seed)) - 0.5f;
        const Vec3 tile = Vec3{1 + 0.05f * hue, 1, 1 - 0.05f * hue} * shade,
                   grout = Vec3{0.42f, 0.42f, 0.40f} * (1 + 0.2f * dirt);
        // Each tile lies a little askew, which breaks up reflections as on a real wall.
        const float tiltX = (unitOf(latticeHash(id, 2, seed)) - 0.5f) * 0.02f,
                    tiltY = (unitOf(latticeHash(id, 3, seed)) - 0.5f) * 0.02f;
        Texel t;
        t.albedo = lerp(grout, tile, body);
        t.height = tileSize * ((fx - 0.5f) * tiltX + (fy - 0.5f) * tiltY) + 0.0025f * body + 0.0003f * glaze;
        t.roughness = mix(0.9f, 0.16f + 0.06f * std::abs(glaze), body);
        return t;
    });
}

}  // namespace shoal::scene::shapes
