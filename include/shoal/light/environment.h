// Light from all around: a lat-long radiance map and what is precomputed from it on the CPU.
#pragma once

#include <array>
#include <optional>

#include <shoal/core/image.h>
#include <shoal/core/math.h>
#include <shoal/light/lights.h>

namespace shoal::light {

// Real spherical harmonics up to l = 2, order (0,0) (1,-1) (1,0) (1,1) (2,-2) (2,-1) (2,0) (2,1) (2,2), per channel.
struct Sh9 {
    std::array<Vec3, 9> c{};
};

// Lat-long convention: direction (x, y, z) of a map without rotation is at u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) /
// pi, v = 0 the top row. So the middle of the picture is -z, and +x is right of it. `rotation` (radians about +y,
// counter-clockwise from above) turns the map.
struct Environment {
    Image radiance;  // 3 channels, W/(m2 sr), width = 2 * height; the sun's disc taken out when an explicit sun stands
                     // for it
    float rotation = 0;
};

Vec3 directionOfTexel(const Environment& environment, int x, int y);  // world, unit, texel centre
Vec3 lookUp(const Environment& environment, Vec3 direction);          // bilinear

// Projects the map on SH (solid-angle weighted, double sums, same bits for any thread count).
Sh9 projectSh(const Environment& environment);
// Irradiance / pi for normal n is evaluateIrradiance(sh, n) / pi [Ramamoorthi & Hanrahan 2001]; never negative.
Vec3 evaluateIrradiance(const Sh9& sh, Vec3 normal);

// Takes the sun's disc out of the map (texels around the brightest spot that stand out from their surroundings are
// replaced by the surroundings) and returns it as a Sun with the same irradiance; nothing where no texel stands out.
std::optional<Sun> extractSun(Environment& environment);

// A clear sky's lat-long map (no sun disc), W/(m2 sr), and the sun behind the same air.
// Single and multiple scattering in a Rayleigh + Mie + ozone atmosphere [Bruneton & Neyret 2008; Hillaire 2020],
// integrated on the CPU.
struct ClearSky {
    Environment environment;
    Sun sun;  // irradiance after the air's extinction
};
// toSun: unit, y up (below the horizon: night, sun irradiance 0). turbidity in [1, 10] scales the Mie part (2: clear).
// groundAlbedo: what the lower half reflects. irradianceScale: 1 gives W/m2 per channel scaled so that the
// extraterrestrial sun is `sunAboveAir`.
ClearSky makeClearSky(Vec3 toSun, float turbidity, Vec3 groundAlbedo, int height = 128, float sunAboveAir = 10.0f);

}  // namespace shoal::light
