// A body of water and the light on it: what every pass of the water technique is given.
#pragma once

#include <span>

#include <shoal/core/math.h>
#include <shoal/light/lights.h>
#include <shoal/water/optics.h>
#include <shoal/water/waves.h>

namespace shoal::water {

class GpuWaves;

// The [water] table apart from optics.
struct BodyParams {
    float level = 0;
    Vec2 areaMin{-1e9f, -1e9f}, areaMax{1e9f, 1e9f};
    bool surfaceVisible = true;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, BodyParams>
void visit(P& p, V&& v) {
    v(p.level, Field{"level", "m", -10000, 10000, "mean height of the surface"});
    v(p.areaMin, Field{"areaMin", "m", -1e9, 1e9, "x and z where the water begins"});
    v(p.areaMax, Field{"areaMax", "m", -1e9, 1e9, "x and z where the water ends"});
    v(p.surfaceVisible,
      Field{"surfaceVisible", "", -1e30, 1e30, "whether the surface is drawn (it bends light anyway)"});
}

// Plain views; all outlive the call they are given to.
struct Body {
    BodyParams params;
    Optics optics;
    const WaveField* waves = nullptr;
    const GpuWaves* gpuWaves = nullptr;  // of the same field, updated
};

struct BodyLights {
    const light::Sun* sun = nullptr;                 // may be null
    std::span<const light::PunctualLight> punctual;  // above the water and in it
    Vec3 skyIrradiance;                              // W/m2 of the environment on a level plane in the air
};

}  // namespace shoal::water
