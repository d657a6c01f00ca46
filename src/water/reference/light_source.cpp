#include "water/reference/light_source.h"

#include <algorithm>

#include <shoal/core/random.h>

namespace shoal::water {

std::vector<LightSource> lightsAbove(const Body& body, const BodyLights& lights) {
    std::vector<LightSource> sources;
    if (lights.sun && lights.sun->toSun.y > 0) {
        LightSource sun;
        sun.travel = -normalize(widened(lights.sun->toSun));
        sun.discHalfAngle = lights.sun->discHalfAngle;
        sun.irradiance = lights.sun->irradiance;
        sun.castsShadow = lights.sun->castsShadow;
        sources.push_back(sun);
    }
    for (const light::PunctualLight& lamp : lights.punctual) {
        const double surface = body.params.level + body.waves->at(lamp.position.x, lamp.position.z).h;
        if (lamp.position.y <= surface) continue;
        LightSource source;
        source.lamp = &lamp;
        sources.push_back(source);
    }
    return sources;
}

SurfaceLight::SurfaceLight(const Body& body, const LightSource& source, const Triangles& triangles)
    : body_(body), source_(source), triangles_(triangles), bounds_(body.waves->bounds()) {}

LitEntry SurfaceLight::at(double x, double z, std::uint32_t column, std::uint32_t row, std::uint32_t seed) const {
    LitEntry lit;
    const BodyParams& params = body_.params;
    if (x < params.areaMin.x || z < params.areaMin.y || x > params.areaMax.x || z > params.areaMax.y) return lit;
    const WaveSample wave = body_.waves->at(x, z);
    lit.position = {x, params.level + wave.h, z};
    DVec3 travel;
    Vec3 irradiance;
    double distance = 1e30, weight = 1;  // of the light
    if (source_.lamp) {
        const DVec3 fromLamp = lit.position - widened(source_.lamp->position);
        distance = length(fromLamp);
        travel = normalize(fromLamp);
        irradiance = irradianceAt(*source_.lamp, narrowed(lit.position));
    } else {
        const DiscSample disc = sampleDisc(source_.travel, source_.discHalfAngle, column, row, seed);
        travel = disc.travel, weight = disc.weight;
        irradiance = source_.irradiance;
    }
    if (travel.y >= 0) return lit;
    const Entry entry = enterWater(wave, x, z, travel, body_.optics.index);
    if (entry.incident <= 0 || entry.refracted.y >= 0) return lit;
    lit.direction = entry.refracted;
    if (shadedByWaves(*body_.waves, bounds_, entry.position, -travel, distance)) return lit;
    const double off = leave(lit.position);
    if (source_.castsShadow && triangles_.blocked(lit.position, -travel, off, distance - off)) return lit;
    lit.flux = widened(irradiance) * (weight * entry.incident * entry.transmitted);
    return lit;
}

double greatestSlope(const WaveField& waves, Vec2 min, Vec2 max) {
    const double bound = waves.bounds().slope;
    if (bound < 0.6) return bound;
    double greatest = 0;
    for (std::uint32_t i = 0; i < 1u << 18; ++i) {
        const Vec2 u = r2Point(i);
        const WaveSample wave = waves.at(double(min.x) + double(u.x) * (double(max.x) - double(min.x)),
                                         double(min.y) + double(u.y) * (double(max.y) - double(min.y)));
        greatest = std::max(greatest, std::hypot(wave.hx, wave.hz));
    }
    return std::min(bound, 1.1 * greatest);
}

}  // namespace shoal::water
