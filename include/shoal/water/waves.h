// The height field of a water surface: one description that surface, caustics, shafts and the reference all read.
// h(x, z, t) in metres above the mean level, without horizontal displacement.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/core/params.h>
#include <shoal/core/result.h>

namespace shoal::water {

// Height (m), slopes dh/dx, dh/dz and second derivatives (1/m) at a point.
struct WaveSample {
    double h = 0, hx = 0, hz = 0, hxx = 0, hxz = 0, hzz = 0;
};

// What bounds a field: never exceeded at any time.
struct WaveBounds {
    double height = 0;      // |h| <= height, metres
    double slope = 0;       // |grad h| <= slope
    double wavelength = 0;  // the shortest wave, metres; 0: flat
};

struct WaveParams {
    std::string kind = "ocean";
    float amplitude = 0.05f;           // circular, turbulent
    float wavelength = 1.2f;           // circular, turbulent
    float noise = -1;                  // circular, turbulent: share of Perlin noise; -1: the paper's
    float periodM = 4;                 // sum: components with m, q; heightmap: side of the picture
    float windSpeed = 5, windDeg = 0;  // ocean
    std::string spectrum = "jonswap";  // ocean
    float fetch = 30000, spread = 1;   // ocean
    float gain = 1;                    // ocean, heightmap
    float shortestM = 0.1f;            // ocean
    std::string file;                  // heightmap: one picture, or a pattern with #### for a sequence
    float fps = 30;                    // heightmap sequence
    float speed = 1;                   // of all of them: scene seconds to wave seconds; 0: still
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, WaveParams>
void visit(P& p, V&& v) {
    v(p.kind, Field{"kind",
                    "",
                    -1e30,
                    1e30,
                    "what makes the waves",
                    {"flat", "circular", "turbulent", "sum", "ocean", "heightmap"}});
    v(p.amplitude, Field{"amplitude", "m", 0, 100, "circular, turbulent: height of a crest above the level"});
    v(p.wavelength, Field{"wavelength", "m", 0.01, 10000, "circular, turbulent: from crest to crest"});
    v(p.noise, Field{"noise", "", -1, 1, "circular, turbulent: share of Perlin noise; -1: 0.15 and 0.6"});
    v(p.periodM, Field{"periodM", "m", 0.01, 100000,
                       "sum: period of components given by m and q; heightmap: side of the picture"});
    v(p.windSpeed, Field{"windSpeed", "m/s", 0.1, 60, "ocean: wind 10 m above the water"});
    v(p.windDeg, Field{"windDeg", "deg", -360, 360, "ocean: where the wind blows to, from +x towards +z"});
    v(p.spectrum, Field{"spectrum", "", -1e30, 1e30, "ocean: which waves the wind makes", {"jonswap", "phillips"}});
    v(p.fetch, Field{"fetch", "m", 10, 1e7, "ocean: length of water that the wind blew over"});
    v(p.spread, Field{"spread", "", 0, 10, "ocean: how much waves keep to the wind's direction; 0: all ways"});
    v(p.gain, Field{"gain", "", 0, 100, "ocean, heightmap: times the height"});
    v(p.shortestM, Field{"shortestM", "m", 0.01, 100, "ocean: waves shorter than this are left out"});
    v(p.file, Field{"file", "", -1e30, 1e30, "heightmap: picture of heights in metres, #### for a sequence"});
    v(p.fps, Field{"fps", "1/s", 0.01, 1000, "heightmap: pictures a second of a sequence"});
    v(p.speed, Field{"speed", "", -100, 100, "wave seconds a scene second; 0 stands still"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "ocean, noise: of the random phases"});
}

// One wave of kind sum: a cos(k . x - omega t + phase), omega^2 = g |k| (deep water). Either m and q (k = 2 pi /
// periodM (m, q)) or wavelength and direction. At time 0 this is a cos(k0 (m x + q z) + phase).
struct WaveComponentParams {
    float amplitude = 0, phase = 0;  // metres, radians
    float m = 0, q = 0;
    float wavelength = 0, directionDeg = 0;  // wavelength 0: m and q count
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, WaveComponentParams>
void visit(P& p, V&& v) {
    v(p.amplitude, Field{"amplitude", "m", -100, 100, "height of a crest above the level"});
    v(p.phase, Field{"phase", "", -1e6, 1e6, "radians: the wave is amplitude cos(k . x + phase) at time 0"});
    v(p.m, Field{"m", "", -1e6, 1e6, "waves along x in a period"});
    v(p.q, Field{"q", "", -1e6, 1e6, "waves along z in a period"});
    v(p.wavelength, Field{"wavelength", "m", 0, 1e6, "from crest to crest, in place of m and q"});
    v(p.directionDeg, Field{"directionDeg", "deg", -1e6, 1e6, "where it travels to, from +x towards +z"});
}

// What the GPU is given: plane waves, one circular wave, and periodic tiles. h is their sum. The same numbers serve
// WaveField::at, so that CPU and GPU agree.
// amplitude cos(2 pi (turnsX x + turnsZ z) + phase); turns are waves a metre: k / 2 pi.
struct PlaneWave {
    float amplitude, turnsX, turnsZ, phase;  // phase at the time set, radians
};
struct CircularWave {
    float amplitude = 0, k = 0, phase = 0, centerX = 0, centerZ = 0;  // a cos(k r + phase); smooth at r = 0
};
// Between texels the height is the bicubic Hermite surface of its corners: slopes are continuous, and slopes and second
// derivatives are those of the height.
struct WaveTile {
    float periodM = 1;
    int size = 0;  // texels a side, a power of two
    std::vector<float>
        texels;  // size^2 x (h, dh/dx, dh/dz, d2h/dxdz); texel (i, j) at x = i / size * periodM, z = j ...
};

class WaveField {
public:
    // heightmaps: of kind heightmap, one or a sequence, metres, channel 0, row 0 at z = -periodM / 2 (already read:
    // this module reads no files). Errors name the field: amplitude too steep for a height field (slope bound over 4),
    // a map with NaN, not square, not a power of two.
    static Result<WaveField> create(const WaveParams& params, std::span<const WaveComponentParams> components = {},
                                    std::vector<Image> heightmaps = {});
    WaveField(WaveField&&) noexcept;
    WaveField& operator=(WaveField&&) noexcept;
    ~WaveField();

    // Of the scene, finite (else nothing happens); makes the tiles of an ocean (some ms). Starts at 0.
    void setTime(double seconds);
    double time() const;
    WaveSample at(double x, double z) const;  // at the time set
    WaveBounds bounds() const;

    std::span<const PlaneWave> planeWaves() const;
    const CircularWave& circularWave() const;
    std::span<const WaveTile> tiles() const;  // at most 4
    std::uint64_t revision() const;           // changes whenever the numbers above do

    struct State;

private:
    explicit WaveField(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::water
