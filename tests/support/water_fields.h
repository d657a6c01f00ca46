// One wave field of each kind, for tests.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include <shoal/water/waves.h>

namespace shoal::test {

struct NamedField {
    const char* name;
    float reach;  // metres from the origin within which 32-bit arithmetic is asked to agree
    water::WaveField field;
};

// The reference patch: six plane waves of a period of 4 m.
inline std::vector<water::WaveComponentParams> sixWaves() {
    const float table[6][4] = {{.020f, 2, 1, 0},    {.015f, -3, 2, 1.3f}, {.010f, 5, -1, 2.1f},
                               {.006f, 3, 7, 4.0f}, {.004f, -9, 4, .7f},  {.0025f, 12, 9, 5.2f}};
    std::vector<water::WaveComponentParams> waves;
    for (const auto& row : table) {
        water::WaveComponentParams c;
        c.amplitude = row[0], c.m = row[1], c.q = row[2], c.phase = row[3];
        waves.push_back(c);
    }
    return waves;
}

// A periodic map of heights of some centimetres, in metres.
inline Image bumpyMap(int size, int kind) {
    Image map(size, size, 1);
    const float turn = 6.2831853f / float(size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            map.at(x, y)[0] =
                0.03f * std::sin(turn * float(kind * x + y)) + 0.01f * std::cos(turn * float(3 * x - 2 * y));
    return map;
}

inline std::vector<NamedField> waveFields() {
    std::vector<NamedField> fields;
    const auto add = [&](const char* name, float reach, const water::WaveParams& params,
                         std::span<const water::WaveComponentParams> components = {}, std::vector<Image> maps = {}) {
        auto made = water::WaveField::create(params, components, std::move(maps));
        EXPECT_TRUE(made) << name << ": " << (made ? "" : made.error().message);
        if (made) fields.push_back({name, reach, *std::move(made)});
    };
    water::WaveParams p;
    p.kind = "sum";
    add("sum", 100, p, sixWaves());
    p.kind = "circular";
    add("circular", 12, p);
    p.kind = "turbulent";
    add("turbulent", 100, p);
    p.kind = "ocean";
    add("ocean", 100, p);
    p.spectrum = "phillips", p.windSpeed = 12;
    add("phillips", 100, p);
    p.kind = "heightmap", p.periodM = 3.7f;
    add("heightmap", 100, p, {}, {bumpyMap(64, 1)});
    add("sequence", 100, p, {}, {bumpyMap(32, 1), bumpyMap(32, 2), bumpyMap(32, 3)});
    return fields;
}

}  // namespace shoal::test
