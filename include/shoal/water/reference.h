// The slow, double-precision answer: light traced ray by ray through the same wave field onto triangles, and view rays
// integrated through the light in the water. No maps, no splats, no GL.
#pragma once

#include <cstdint>
#include <span>

#include <shoal/core/image.h>
#include <shoal/core/model.h>
#include <shoal/core/progress.h>
#include <shoal/core/result.h>
#include <shoal/light/view.h>
#include <shoal/water/body.h>

namespace shoal::water {

// World-space triangles, three vertices each.
struct ReferenceScene {
    std::vector<Vec3> triangles;
};

struct ReferenceOptions {
    std::int64_t rays = 64'000'000;  // from each light, stratified
    int subPixels = 1;               // in-scatter: view rays a pixel's side
    int steps = 512;                 // in-scatter: points along a view ray
    std::uint32_t seed = 1;
    ProgressCallback progress;
};

// Irradiance (W/m2, 3 channels, row 0 on top) that refracted light puts on the first opaque surface of each pixel: rays
// binned over the area that the pixel sees.
Result<Image> referenceCaustics(const ReferenceScene& scene, const Body& body, const BodyLights& lights,
                                const light::View& view, const ReferenceOptions& options);
// In-scattered radiance (W/(m2 sr)) along each pixel's path, the eye under water or above it with the surface unseen.
Result<Image> referenceInscatter(const ReferenceScene& scene, const Body& body, const BodyLights& lights,
                                 const light::View& view, const ReferenceOptions& options);

// Rays onto a level floor at `floorY` into bins of a rectangle, c per channel as in Optics: the exact answers' partner.
struct FloorBins {
    Vec2 min, max;  // world x, z
    int countX = 512, countZ = 512;
    bool periodic = false;  // what leaves on one side comes in on the other
};
struct FloorResult {
    Image irradiance;  // countX x countZ, 1 channel, relative to E_perp; row 0 at min z
    double received = 0, reflected = 0, absorbed = 0, incoming = 0;  // mean flux per area of the level plane / E_perp
};
FloorResult traceFloor(const WaveField& waves, double index, double attenuation, Vec3 toSun, double discHalfAngle,
                       double depth, const FloorBins& bins, int raysPerSide, std::uint32_t seed);

}  // namespace shoal::water
