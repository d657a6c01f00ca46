// The wave fields whose caustics are known: level water, one sinusoid (S1), a periodic patch of six waves (P6).
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include <shoal/water/waves.h>

namespace shoal::test {

inline water::WaveField levelWater() {
    water::WaveParams params;
    params.kind = "flat";
    return water::WaveField::create(params).value();
}

// h = .05 cos(pi x), metres.
inline water::WaveField sinusoidS1() {
    water::WaveParams params;
    params.kind = "sum";
    params.periodM = 2;
    const water::WaveComponentParams wave{.amplitude = 0.05f, .m = 1};
    return water::WaveField::create(params, std::span(&wave, 1)).value();
}

// h = sum a cos(2 pi / 4 m (m x + q z) + p).
inline water::WaveField patchP6() {
    water::WaveParams params;
    params.kind = "sum";
    params.periodM = 4;
    const std::vector<water::WaveComponentParams> waves = {
        {.amplitude = .020f, .phase = 0, .m = 2, .q = 1},     {.amplitude = .015f, .phase = 1.3f, .m = -3, .q = 2},
        {.amplitude = .010f, .phase = 2.1f, .m = 5, .q = -1}, {.amplitude = .006f, .phase = 4.0f, .m = 3, .q = 7},
        {.amplitude = .004f, .phase = .7f, .m = -9, .q = 4},  {.amplitude = .0025f, .phase = 5.2f, .m = 12, .q = 9},
    };
    return water::WaveField::create(params, waves).value();
}

// Of light that travels towards +x, `zenith` radians from straight down.
inline Vec3 toSunAt(double zenith) { return {-float(std::sin(zenith)), float(std::cos(zenith)), 0}; }

}  // namespace shoal::test
