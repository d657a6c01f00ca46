// The lights that the water is lit by from above, as rays onto its surface.
#pragma once

#include <vector>

#include <shoal/water/body.h>

#include "water/reference/entry.h"
#include "water/reference/triangles.h"

namespace shoal::water {

struct LightSource {
    const light::PunctualLight* lamp = nullptr;  // null: the sun
    DVec3 travel{};                              // sun: unit, down
    double discHalfAngle = 0;                    // sun
    Vec3 irradiance{};                           // sun: on a plane facing it
    bool castsShadow = true;
};
// The sun above the horizon and the lamps that stand above the surface; those in the water are not among them.
std::vector<LightSource> lightsAbove(const Body& body, const BodyLights& lights);

// What reaches the surface above (x, z): the entry in world heights, and irradiance on a plane facing the ray times the
// share that enters, per area of the level plane. Flux 0 where nothing arrives: outside the water, in the shadow of
// waves or of what stands above the water.
struct LitEntry {
    DVec3 position, direction;  // world; direction in the water, unit, down; (0, 0, 0) where the surface faces away
    DVec3 flux;                 // W per m2 of the level plane, R G B
    bool isLit() const { return flux.x > 0 || flux.y > 0 || flux.z > 0; }
};
class SurfaceLight {
public:
    SurfaceLight(const Body& body, const LightSource& source, const Triangles& triangles);
    // column, row, seed: choose the point of the sun's disc (sampleDisc).
    LitEntry at(double x, double z, std::uint32_t column, std::uint32_t row, std::uint32_t seed) const;

private:
    const Body& body_;
    const LightSource& source_;
    const Triangles& triangles_;
    WaveBounds bounds_;
};

// Greatest slope of the waves over a rectangle of the level plane: the field's bound where that is moderate, else the
// greatest of 2^18 samples and a tenth more (bounds of many waves add up to slopes that never occur).
double greatestSlope(const WaveField& waves, Vec2 min, Vec2 max);

}  // namespace shoal::water
