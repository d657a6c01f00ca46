// What a wave field is made of, by kind: plane waves, a circular wave, periodic tiles.
// Deep-water dispersion omega^2 = g k [Lamb 1932]; the circular and the turbulent surface of Papadopoulos & Papaioannou
// 2010, section 4.1.
#include <atomic>
#include <cmath>
#include <cstdio>

#include <shoal/core/math.h>
#include <shoal/water/waves.h>

#include "water/waves/heightmap_tile.h"
#include "water/waves/ocean_tiles.h"
#include "water/waves/perlin_noise.h"
#include "water/waves/tile_source.h"

namespace shoal::water {
namespace {

constexpr double kSteepest = 4;  // slope a height field may have; the drawn surface and its refraction end there
constexpr std::size_t kMostPlanes = 64;

std::uint64_t nextRevision() {
    // Of all fields together: whoever holds a revision knows the field as well.
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

struct MovingPlane {
    double amplitude = 0, kx = 0, kz = 0, phase = 0, omega = 0;
    // As the GPU has it, in 32 bits: far from the origin the last bits of a wave number count.
    void round() {
        kx = 2 * kPiD * double(float(kx / (2 * kPiD)));
        kz = 2 * kPiD * double(float(kz / (2 * kPiD)));
    }
};

}  // namespace

struct WaveField::State {
    WaveParams params;
    double time = 0;
    std::uint64_t revision = 0;
    WaveBounds bounds;
    std::vector<MovingPlane> moving;
    std::vector<PlaneWave> planes;
    double circularOmega = 0;
    CircularWave circular;
    std::unique_ptr<TileSource> source;
    std::vector<WaveTile> tiles;

    void move();
    WaveBounds sum() const;
};

namespace {

Result<MovingPlane> movingPlane(const WaveComponentParams& c, double periodM, std::size_t index) {
    const std::string name = "waves.components[" + std::to_string(index) + "]";
    if (Result<void> ok = validate(c); !ok) return badInput(name + ": " + ok.error().message);
    if (c.amplitude < 0)
        return badInput(name + ".amplitude is " + number(double(c.amplitude)) +
                        ", expected 0 or more (phase turns a wave upside down)");
    MovingPlane w;
    w.amplitude = double(c.amplitude);
    w.phase = double(c.phase);
    if (c.wavelength > 0) {
        const double k = 2 * kPiD / double(c.wavelength), direction = double(c.directionDeg) * (kPiD / 180);
        w.kx = k * std::cos(direction), w.kz = k * std::sin(direction);
    } else {
        w.kx = 2 * kPiD / periodM * double(c.m), w.kz = 2 * kPiD / periodM * double(c.q);
    }
    w.round();
    const double k = std::hypot(w.kx, w.kz);
    if (!(k > 0)) return badInput(name + " has no wavelength: expected m and q, or wavelength");
    w.omega = std::sqrt(kGravity * k);
    return w;
}

Result<void> checkSteepness(const WaveBounds& bounds, const char* field) {
    if (bounds.slope <= kSteepest) return {};
    return badInput(std::string("waves.") + field + " makes slopes of up to " + number(bounds.slope) + ", expected " +
                    number(kSteepest) + " at most");
}

}  // namespace

void WaveField::State::move() {
    const double seconds = time * double(params.speed);
    const auto turned = [&](double phase, double omega) {
        return float(std::remainder(phase - omega * seconds, 2 * kPiD));
    };
    planes.clear();
    for (const MovingPlane& w : moving)
        planes.push_back(
            {float(w.amplitude), float(w.kx / (2 * kPiD)), float(w.kz / (2 * kPiD)), turned(w.phase, w.omega)});
    circular.phase = turned(0, circularOmega);
    const bool tilesMoved = source && source->fill(seconds, tiles);
    const bool moved = !moving.empty() || circular.amplitude != 0 || tilesMoved;
    if (moved || revision == 0) revision = nextRevision();
}

WaveBounds WaveField::State::sum() const {
    WaveBounds b;
    const auto add = [&](double height, double slope, double wavelength) {
        if (!(height > 0)) return;
        // The numbers handed out are rounded to 32 bits.
        b.height += height * (1 + 1e-6), b.slope += slope * (1 + 1e-6);
        if (wavelength > 0) b.wavelength = b.wavelength > 0 ? std::min(b.wavelength, wavelength) : wavelength;
    };
    for (const MovingPlane& w : moving) {
        const double k = std::hypot(w.kx, w.kz);
        add(w.amplitude, w.amplitude * k, 2 * kPiD / k);
    }
    if (circular.k > 0) {
        const double a = double(circular.amplitude), k = double(circular.k);
        add(a, a * k, 2 * kPiD / k);
    }
    if (source) {
        const WaveBounds s = source->bounds();
        add(s.height, s.slope, s.wavelength);
    }
    return b;
}

WaveField::WaveField(std::unique_ptr<State> state) : state_(std::move(state)) {}
WaveField::WaveField(WaveField&&) noexcept = default;
WaveField& WaveField::operator=(WaveField&&) noexcept = default;
WaveField::~WaveField() = default;

namespace {

Result<void> addComponents(WaveField::State& state, std::span<const WaveComponentParams> components) {
    if (components.empty()) return badInput("waves.components is empty, expected at least 1 for kind sum");
    if (components.size() > kMostPlanes)
        return badInput("waves.components has " + std::to_string(components.size()) + " waves, expected at most " +
                        std::to_string(kMostPlanes));
    for (std::size_t i = 0; i < components.size(); ++i) {
        Result<MovingPlane> w = movingPlane(components[i], double(state.params.periodM), i);
        if (!w) return w.error();
        state.moving.push_back(*w);
    }
    return {};
}

// The two surfaces of the paper: a cosine and a share of noise.
void addCosine(WaveField::State& state, bool circular) {
    const WaveParams& p = state.params;
    const double noise = double(p.noise < 0 ? (circular ? 0.15f : 0.6f) : p.noise);
    const double amplitude = double(p.amplitude) * (1 - noise), k = 2 * kPiD / double(p.wavelength);
    if (circular) {
        state.circular.amplitude = float(amplitude);
        state.circular.k = float(k);
        state.circularOmega = std::sqrt(kGravity * k);
    } else {
        state.moving.push_back({amplitude, k, 0, 0, std::sqrt(kGravity * k)});
        state.moving.back().round();
    }
    if (noise > 0 && p.amplitude > 0)
        state.source = makePerlinNoise({double(p.amplitude) * noise, double(p.wavelength) / 3, p.seed});
}

}  // namespace

Result<WaveField> WaveField::create(const WaveParams& params, std::span<const WaveComponentParams> components,
                                    std::vector<Image> heightmaps) {
    if (Result<void> ok = validate(params); !ok) return badInput("waves." + ok.error().message);
    auto state = std::make_unique<State>();
    state->params = params;
    const char* steepField = "amplitude";
    if (params.kind == "sum") {
        if (Result<void> ok = addComponents(*state, components); !ok) return ok.error();
        steepField = "components";
    } else if (params.kind == "circular" || params.kind == "turbulent") {
        addCosine(*state, params.kind == "circular");
    } else if (params.kind == "ocean") {
        if (params.gain > 0) state->source = makeOceanTiles(params);
        steepField = "gain";
    } else if (params.kind == "heightmap") {
        auto made = makeHeightmapTile(std::move(heightmaps), params.periodM, params.gain, params.fps);
        if (!made) return made.error();
        state->source = *std::move(made);
        steepField = "gain";
    }
    state->bounds = state->sum();
    if (Result<void> ok = checkSteepness(state->bounds, steepField); !ok) return ok.error();
    state->move();
    return WaveField(std::move(state));
}

void WaveField::setTime(double seconds) {
    if (seconds == state_->time || !std::isfinite(seconds)) return;
    const bool still = state_->params.speed == 0;
    state_->time = seconds;
    if (!still) state_->move();
}

double WaveField::time() const { return state_->time; }
WaveBounds WaveField::bounds() const { return state_->bounds; }
std::span<const PlaneWave> WaveField::planeWaves() const { return state_->planes; }
const CircularWave& WaveField::circularWave() const { return state_->circular; }
std::span<const WaveTile> WaveField::tiles() const { return state_->tiles; }
std::uint64_t WaveField::revision() const { return state_->revision; }

WaveSample WaveField::at(double x, double z) const {
    WaveSample w;
    for (const PlaneWave& p : state_->planes) {
        const double kx = 2 * kPiD * double(p.turnsX), kz = 2 * kPiD * double(p.turnsZ),
                     angle = kx * x + kz * z + double(p.phase);
        const double c = double(p.amplitude) * std::cos(angle), s = -double(p.amplitude) * std::sin(angle);
        w.h += c, w.hx += s * kx, w.hz += s * kz;
        w.hxx -= c * kx * kx, w.hxz -= c * kx * kz, w.hzz -= c * kz * kz;
    }
    if (const CircularWave& p = state_->circular; p.amplitude != 0) {
        // Of rho = sqrt(r^2 + 1 / k^2) in place of r: no cusp in the middle.
        const double k = double(p.k), dx = x - double(p.centerX), dz = z - double(p.centerZ);
        const double rho = std::sqrt(dx * dx + dz * dz + 1 / (k * k)), ex = dx / rho, ez = dz / rho;
        const double angle = k * rho + double(p.phase), c = double(p.amplitude) * std::cos(angle);
        const double first = -double(p.amplitude) * k * std::sin(angle), second = -k * k * c, across = first / rho;
        w.h += c, w.hx += first * ex, w.hz += first * ez;
        w.hxx += (second - across) * ex * ex + across, w.hxz += (second - across) * ex * ez;
        w.hzz += (second - across) * ez * ez + across;
    }
    for (const WaveTile& tile : state_->tiles) {
        const WaveSample s = sampleTile(tile, x, z);
        w.h += s.h, w.hx += s.hx, w.hz += s.hz;
        w.hxx += s.hxx, w.hxz += s.hxz, w.hzz += s.hzz;
    }
    return w;
}

}  // namespace shoal::water
