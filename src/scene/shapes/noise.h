// Deterministic noise for textures and terrain; every function is pure.
#pragma once

#include <cmath>
#include <cstdint>

#include <shoal/core/math.h>
#include <shoal/core/random.h>

namespace shoal::scene::shapes {

// A lattice point's hash: few operations, good enough for what is looked at.
inline std::uint32_t latticeHash(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ seed * 0xcb1ab31fu;
    h ^= h >> 15, h *= 0x2c1b3c6du;
    h ^= h >> 12, h *= 0x297a2d39u;
    return h ^ h >> 15;
}
inline float unitOf(std::uint32_t bits) { return float(bits >> 8) * (1.0f / 16777216.0f); }
inline float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }
inline float mix(float a, float b, float t) { return a + (b - a) * t; }
inline float smoothstep(float from, float to, float x) {
    const float t = std::clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3 - 2 * t);
}
inline int wrapped(int i, int period) {
    if (i >= 0 && i < period) return i;  // nearly always; division is what noise would otherwise spend its time on
    const int r = i % period;
    return r < 0 ? r + period : r;
}

// std::floor without a call.
inline float floorOf(float x) {
    const float t = float(int(x));
    return t > x ? t - 1 : t;
}

// Gradient noise [Perlin 2002] in about [-1, 1]; repeats every `period` lattice cells.
inline float noise(float x, float y, std::uint32_t seed, int periodX = 1 << 20, int periodY = 1 << 20) {
    const float fx = floorOf(x), fy = floorOf(y);
    const int x0 = wrapped(int(fx), periodX), y0 = wrapped(int(fy), periodY);
    const int x1 = wrapped(x0 + 1, periodX), y1 = wrapped(y0 + 1, periodY);
    const float tx = x - fx, ty = y - fy;
    const auto gradient = [&](int ix, int iy, float dx, float dy) {
        const std::uint32_t h = latticeHash(std::uint32_t(ix), std::uint32_t(iy), seed);
        const float along = (h & 1) ? dx : -dx, across = (h & 2) ? dy : -dy;
        return (h & 4) ? along + 0.5f * across : 0.5f * along + across;
    };
    const float a = gradient(x0, y0, tx, ty), b = gradient(x1, y0, tx - 1, ty);
    const float c = gradient(x0, y1, tx, ty - 1), d = gradient(x1, y1, tx - 1, ty - 1);
    return mix(mix(a, b, fade(tx)), mix(c, d, fade(tx)), fade(ty));
}

// Octaves of it, each twice as fine and half as strong.
inline float fractal(float x, float y, int octaves, std::uint32_t seed, int periodX = 1 << 20, int periodY = 1 << 20) {
    float sum = 0, strength = 1;
    for (int i = 0; i < octaves; ++i) {
        sum += strength * noise(x, y, seed + std::uint32_t(i), periodX, periodY);
        x *= 2, y *= 2, strength *= 0.5f;
        periodX = std::min(periodX * 2, 1 << 20), periodY = std::min(periodY * 2, 1 << 20);
    }
    return sum;
}

inline float noise3(Vec3 p, std::uint32_t seed) {
    const float fx = floorOf(p.x), fy = floorOf(p.y), fz = floorOf(p.z);
    const float tx = p.x - fx, ty = p.y - fy, tz = p.z - fz;
    const auto gradient = [&](int dx, int dy, int dz) {
        const std::uint32_t h = latticeHash(std::uint32_t(int(fx) + dx), std::uint32_t(int(fy) + dy),
                                            seed + 0x9e3779b9u * std::uint32_t(int(fz) + dz));
        const float x = tx - float(dx), y = ty - float(dy), z = tz - float(dz);
        return ((h & 1) ? x : -x) * ((h & 8) ? 1.0f : 0.6f) + ((h & 2) ? y : -y) * ((h & 16) ? 1.0f : 0.6f) +
               ((h & 4) ? z : -z) * ((h & 32) ? 1.0f : 0.6f);
    };
    const auto plane = [&](int dz) {
        return mix(mix(gradient(0, 0, dz), gradient(1, 0, dz), fade(tx)),
                   mix(gradient(0, 1, dz), gradient(1, 1, dz), fade(tx)), fade(ty));
    };
    return mix(plane(0), plane(1), fade(tz));
}

inline float fractal3(Vec3 p, int octaves, std::uint32_t seed) {
    float sum = 0, strength = 1;
    for (int i = 0; i < octaves; ++i, p = p * 2.03f, strength *= 0.5f)
        sum += strength * noise3(p, seed + std::uint32_t(i));
    return sum;
}

// Cellular noise: distance to the nearest of one point a cell, and that cell's hash.
struct Cell {
    float distance;
    std::uint32_t id;
};
inline Cell cellNoise(float x, float y, std::uint32_t seed, int periodX, int periodY) {
    const int cx = int(floorOf(x)), cy = int(floorOf(y));
    Cell best{1e9f, 0};
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const std::uint32_t h =
                latticeHash(std::uint32_t(wrapped(cx + dx, periodX)), std::uint32_t(wrapped(cy + dy, periodY)), seed);
            const float px = float(cx + dx) + float(h & 0xffff) / 65536.0f,
                        py = float(cy + dy) + float(h >> 16) / 65536.0f;
            const float d = (px - x) * (px - x) + (py - y) * (py - y);
            if (d < best.distance) best = {d, h};
        }
    best.distance = std::sqrt(best.distance);
    return best;
}

// Numbers in a row from one seed.
class Dice {
public:
    explicit Dice(std::uint32_t seed) : seed_(seed) {}
    float unit() { return randomFloat(seed_, next_++); }
    float range(float lowest, float highest) { return lowest + (highest - lowest) * unit(); }
    int below(int count) { return std::min(int(unit() * float(count)), count - 1); }
    bool chance(float probability) { return unit() < probability; }

private:
    std::uint32_t seed_, next_ = 0;
};

}  // namespace shoal::scene::shapes
