// The slow, double-precision answer: light traced ray by ray through the same wave field onto triangles, and view rays
// integrated through the light in the water. No maps, no splats, no GL.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

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

// Irradiance (W/m2, 3 channels, row 0 on top) that refracted light of the sun and of lamps above the water puts on the
// first surface of each pixel, seen in a straight line (the water's surface does not bend the eye's rays): flux of the
// rays that land there over the area that the pixel covers. Triangles are two-sided and opaque, and cut the light above
// and below the surface (the sun's only where it casts shadow); waves shade each other. Lamps are points. Rays enter
// only where they can reach what is seen (slopes up to the field's bound; where that is above .6, up to 1.1 times the
// greatest of 2^18 samples). Sums are integers: the same for any number of threads. Errors: cancelled.
Result<Image> referenceCaustics(const ReferenceScene& scene, const Body& body, const BodyLights& lights,
                                const light::View& view, const ReferenceOptions& options);
// Radiance (W/(m2 sr)) scattered once towards the eye along each pixel's path in the water: from the eye, or from where
// a straight line crosses the level, to the first surface or the level, at most until 1e-4 of the light is left. Light
// of the sun (its disc as 16 directions) and of lamps above and in the water, cut by triangles and waves. Takes 30
// bytes a ray. Not in it: light of the sky, and light scattered twice. Errors: cancelled.
Result<Image> referenceInscatter(const ReferenceScene& scene, const Body& body, const BodyLights& lights,
                                 const light::View& view, const ReferenceOptions& options);

// Rays onto a level floor `depth` metres below the level into bins of a rectangle, one beam attenuation c: the exact
// answers' partner. Light that the surface reflects onto other waves is not followed.
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

// Closed forms (no sampling), which both the reference and the GPU are tested against. Metres, radians, 1/m; light of
// irradiance 1 on a plane facing it. Sources: Snell, Fresnel, and the change of variables from where a ray enters to
// where it lands; no paraxial approximation.
namespace analytic {

// Level water: irradiance at `depth` on a level floor, light at `zenithAngle` in the air (relative to E_perp: divide by
// its cosine for E / E0).
double flatIrradiance(double index, double attenuation, double zenithAngle, double depth);

// h(x) = amplitude cos(k x), light in the x-y plane travelling towards +x (zenithAngle 0: straight down). Waves must
// not shade each other: tan(pi / 2 - zenithAngle) > amplitude k. Defaults: amplitude .05 m, wavelength 2 m, index
// 1.333.
struct Sinusoid {
    double amplitude = 0.05, k = kPiD;
    double index = kWaterIndex;
    double attenuation = 0;  // c of the beam
    double zenithAngle = 0;
};
// The ray that enters at x, at the plane `depth` below the level.
struct SinusoidRay {
    double landing = 0;                     // X(x)
    double jacobian = 0;                    // dX/dx; its zeros are the folds
    double length = 0;                      // metres in the water
    double flux = 0;                        // what gets through a metre of x: incidence times Fresnel, not dimmed
    double directionX = 0, directionY = 0;  // in the water, unit, y below 0
};
SinusoidRay sinusoidRay(const Sinusoid& s, double depth, double x);
// All rays that land at X: one before the first focus, then odd numbers.
std::vector<SinusoidRay> sinusoidBranches(const Sinusoid& s, double depth, double landing);
// Irradiance on a level plane at a point: the sum over branches of flux exp(-c l) / |dX/dx|. Infinite on a fold.
double sinusoidIrradiance(const Sinusoid& s, double depth, double landing);
// Its mean over each of `count` equal bins of [min, max]: exact, folds included (each bin's preimages are intervals in
// x, where flux exp(-c l) is smooth).
std::vector<double> sinusoidBins(const Sinusoid& s, double depth, double min, double max, int count);
// Depth below the level where light first crosses under a crest (zenith light): n / ((n - 1) A k^2) - A.
double focusDepth(const Sinusoid& s);
// Landing points of all folds of one period of x, [0, 2 pi / k), reduced to (-pi / k, pi / k], ascending; empty before
// the focus.
std::vector<double> sinusoidFolds(const Sinusoid& s, double depth);

// 1/sr, [Henyey and Greenstein 1941]; cosTheta 1: straight on.
double henyeyGreenstein(double anisotropy, double cosTheta);

// What a shaft is made of: beam attenuation c, scattering b (1/m), Henyey-Greenstein g.
struct ShaftMedium {
    double attenuation = 0.13, scattering = 0.08, anisotropy = 0.924;
    double index = kWaterIndex;
};
// A straight view ray in the water: from depth `eyeDepth` at x `eyeX`, unit direction v (y up), `length` metres.
struct ShaftRay {
    double eyeDepth = 2, eyeX = 0;
    double vx = 1, vy = 0, vz = 0;
    double length = 10;
};
// Single scattering into the view ray, radiance for E_perp = 1, level water, light at zenithAngle travelling towards
// +x.
double flatShaft(const ShaftMedium& medium, double zenithAngle, const ShaftRay& ray);
// The same under a sinusoid (its attenuation and index are replaced by the medium's): midpoint rule with `steps` points
// over the exact field at every depth. footprint: metres in x that the field is averaged over, exactly; needed past the
// first focus, where the point value is singular. 0: the point value.
double sinusoidShaft(const ShaftMedium& medium, const Sinusoid& s, const ShaftRay& ray, int steps,
                     double footprint = 0);

}  // namespace analytic

}  // namespace shoal::water
