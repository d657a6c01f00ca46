// One wave field of each kind, for tests.
#pragma once

#include <gtest/gtest.h>

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
    return fields;
}

}  // namespace shoal::test
