// Caustics on a level floor, measured: waves, one light and a floor that need no scene. Tests and benchmarks share it.
#pragma once

#include <epoxy/gl.h>

#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <shoal/gl/device.h>
#include <shoal/gl/objects.h>
#include <shoal/water/gpu_waves.h>
#include <shoal/water/light_views.h>
#include <shoal/water/photons.h>
#include <shoal/water/reference.h>

#include "support/known_waves.h"

namespace shoal::test {

struct FloorSetup {
    const water::WaveField* waves = nullptr;
    float depth = 2;          // of the floor below the level, metres
    float zenithDeg = 0;      // of the sun; its light travels towards +x
    float discHalfAngle = 0;  // radians
    float attenuation = 0;    // c, 1/m
    int photons = 160000;
    Vec2 center{2, 2};  // of what the eye sees, world x, z
    float sideM = 4;
    std::vector<light::PunctualLight> lamps;  // in place of the sun
    float ceiling = 0;                        // height of a level ceiling above the level, 0: none
};

inline Vec3 sunAt(float zenithDeg) { return {-std::sin(radians(zenithDeg)), std::cos(radians(zenithDeg)), 0}; }

// One picture's worth of passes on a level floor that an orthographic eye looks straight down on.
class FloorRig {
public:
    static constexpr float kEyeY = 40;

    explicit FloorRig(gl::Device& device, int resolution = 512, int maxSlots = 2)
        : device_(device), resolution_(resolution), waves_(*water::GpuWaves::create(device)),
          views_(*water::LightViews::create(device, {resolution, maxSlots})),
          photons_(*water::Photons::create(device, {resolution, maxSlots})) {
        for (gl::Texture* t : {&viewDepth_, &normal_, &direct_, &ambient_}) {
            gl::TextureDesc desc;
            desc.format = t == &viewDepth_ ? GL_R32F : t == &normal_ ? GL_RG16 : GL_RGBA16F;
            desc.width = desc.height = resolution;
            *t = gl::Texture::create(device, desc);
        }
    }

    void prepare(const FloorSetup& setup) {
        setup_ = setup;
        body_ = {};
        body_.params.level = 0;
        body_.optics.index = float(water::kWaterIndex);
        body_.optics.absorption = {setup.attenuation, setup.attenuation, setup.attenuation};
        body_.waves = setup.waves;
        body_.gpuWaves = &waves_;
        (void)waves_.update(*setup.waves);
        sun_.toSun = sunAt(setup.zenithDeg);
        sun_.irradiance = {1, 1, 1};
        sun_.discHalfAngle = setup.discHalfAngle;
        lights_ = {};
        if (setup_.lamps.empty()) lights_.sun = &sun_;
        lights_.punctual = setup_.lamps;

        light::Camera camera;
        camera.projection = light::Camera::Projection::orthographic;
        camera.worldFromView = Mat4{};  // x right, -z up, looking down
        camera.worldFromView(1, 1) = 0, camera.worldFromView(2, 1) = -1;
        camera.worldFromView(1, 2) = 1, camera.worldFromView(2, 2) = 0;
        camera.worldFromView(0, 3) = setup.center.x, camera.worldFromView(1, 3) = kEyeY;
        camera.worldFromView(2, 3) = setup.center.y;
        camera.heightM = setup.sideM;
        camera.nearZ = 0.1f, camera.farZ = 1000;
        context_ = {};
        context_.device = &device_;
        context_.view = context_.previousView = light::makeView(camera, resolution_, resolution_);

        Bounds scene;
        scene.add(Vec3{-500, -setup.depth, -500});
        scene.add(Vec3{500, setup.ceiling > 0 ? setup.ceiling : -setup.depth, 500});
        water::LightViewParams params;
        params.reflected = setup.ceiling > 0;
        views_.prepare(context_, params, body_, lights_, scene);
        for (const frame::NeededView& view : views_.neededViews()) clearTo(view, heightIn(view));

        // The eye sees the floor; where there is a ceiling, that one from above, as if it were lit from below.
        const float depth = setup.ceiling > 0 ? kEyeY - setup.ceiling : kEyeY + setup.depth;
        viewDepth_.clear(GL_RED, GL_FLOAT, &depth);
        const std::uint16_t up[2] = {32768, 65535}, down[2] = {32768, 0};
        normal_.clear(GL_RG, GL_UNSIGNED_SHORT, setup.ceiling > 0 ? down : up);
    }

    // Deposits (and resolves) the photons.
    void trace() {
        water::PhotonParams params;
        params.photons = setup_.photons;
        photons_.render(context_, params, body_, lights_, views_);
    }
    void lookUp() { photons_.resolve(context_, body_, lights_, views_, {viewDepth_, normal_}, {direct_, ambient_}); }

    // The map of a slot, irradiance on a level plane over E_perp, times what level water leaves down to the floor; row
    // j at z = origin.y + (j + .5) texel.
    std::vector<float> map(int slot = 0, int layer = 0) const {
        const gl::TextureView maps = photons_.maps();
        std::vector<float> all(std::size_t(maps.width) * std::size_t(maps.width));
        glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
        glGetTextureSubImage(maps.name, 0, 0, 0, 2 * slot + layer, maps.width, maps.width, 1, GL_RED, GL_FLOAT,
                             GLsizei(all.size() * 4), all.data());
        const water::LightSlot& s = this->slot(slot);
        if (s.reflected || s.light >= 0) return all;
        const double left = std::exp(-double(setup_.attenuation) * double(setup_.depth) / double(s.source.y));
        for (float& value : all) value = float(double(value) * left);
        return all;
    }
    // What the lookup gives for the floor, red; row 0 at the least z.
    std::vector<float> irradiance() const {
        const std::size_t count = std::size_t(resolution_) * std::size_t(resolution_);
        std::vector<float> rgba(4 * count), red(count);
        glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
        direct_.read(GL_RGBA, GL_FLOAT, std::as_writable_bytes(std::span(rgba)));
        for (int j = 0; j < resolution_; ++j)
            for (int i = 0; i < resolution_; ++i)
                red[std::size_t(resolution_ - 1 - j) * std::size_t(resolution_) + std::size_t(i)] =
                    rgba[4 * (std::size_t(j) * std::size_t(resolution_) + std::size_t(i))];
        return red;
    }

    // Level floor: a map's value at world x, z on it, bilinear.
    double mapAt(const std::vector<float>& map, double x, double z) const {
        const water::LightSlot& slot = views_.slots()[0];
        const double w = double(slot.source.y), depth = double(setup_.depth);
        // Slid along the mean direction (minus `source`) up to the level.
        const double sx = x + double(slot.source.x) / w * depth, sz = z + double(slot.source.z) / w * depth;
        const double u = (sx - double(slot.origin.x)) / double(slot.texel) - .5;
        const double v = (sz - double(slot.origin.y)) / double(slot.texel) - .5;
        const int i = std::clamp(int(std::floor(u)), 0, resolution_ - 2),
                  j = std::clamp(int(std::floor(v)), 0, resolution_ - 2);
        const double fu = u - i, fv = v - j;
        const auto at = [&](int a, int b) {
            return double(map[std::size_t(j + b) * std::size_t(resolution_) + std::size_t(i + a)]);
        };
        return (at(0, 0) * (1 - fu) + at(1, 0) * fu) * (1 - fv) + (at(0, 1) * (1 - fu) + at(1, 1) * fu) * fv;
    }

    water::LightViews& views() { return views_; }
    const water::LightSlot& slot(int i = 0) const { return views_.slots()[std::size_t(i)]; }
    water::Photons& photons() { return photons_; }
    const frame::Context& context() const { return context_; }
    const water::Body& body() const { return body_; }
    int resolution() const { return resolution_; }

private:
    static void clearTo(const frame::NeededView& view, std::optional<float> y) {
        float depth = 0;
        if (y) {
            const Vec3 clip = transformPoint(view.view.clipFromWorld(), {view.view.eye.x, *y, view.view.eye.z});
            depth = clip.z;
        }
        glClearNamedFramebufferfv(view.framebuffer, GL_DEPTH, 0, &depth);
    }
    // Height of what is level in a needed view: the floor for light that goes down, the ceiling for what comes up.
    std::optional<float> heightIn(const frame::NeededView& view) const {
        if (view.peel) return std::nullopt;
        const bool up = view.view.viewFromWorld(2, 1) < 0;
        const bool air = !up && view.view.eye.y > 0.5f * setup_.ceiling && setup_.ceiling > 0;
        if (air) return std::nullopt;
        return up ? setup_.ceiling : -setup_.depth;
    }

    gl::Device& device_;
    int resolution_;
    water::GpuWaves waves_;
    water::LightViews views_;
    water::Photons photons_;
    gl::Texture viewDepth_, normal_, direct_, ambient_;
    FloorSetup setup_;
    water::Body body_;
    water::BodyLights lights_;
    light::Sun sun_;
    frame::Context context_;
};

// Mean of a map along z within `half` metres of the middle: waves along x alone.
inline std::vector<double> profileAlongX(const FloorRig& rig, const std::vector<float>& map) {
    const int n = rig.resolution();
    std::vector<double> profile(std::size_t(n), 0);
    for (int j = n / 4; j < 3 * n / 4; ++j)
        for (int i = 0; i < n; ++i)
            profile[std::size_t(i)] += double(map[std::size_t(j) * std::size_t(n) + std::size_t(i)]);
    for (double& p : profile) p /= n / 2;
    return profile;
}

// Largest relative error of level water's irradiance over the middle of the map.
inline double flatError(FloorRig& rig, double zenithDeg, double attenuation) {
    const water::WaveField waves = levelWater();
    FloorSetup setup;
    setup.waves = &waves, setup.depth = 4;
    setup.zenithDeg = float(zenithDeg), setup.attenuation = float(attenuation);
    rig.prepare(setup);
    rig.trace();
    const double exact =
        water::analytic::flatIrradiance(water::kWaterIndex, attenuation, zenithDeg * kPiD / 180, setup.depth);
    double worst = 0;
    const std::vector<float> map = rig.map();
    for (int j = 8; j < rig.resolution() - 8; ++j)
        for (int i = 8; i < rig.resolution() - 8; ++i) {
            const double x = double(rig.slot().texel) * (i - rig.resolution() / 2) + 2,
                         z = double(rig.slot().texel) * (j - rig.resolution() / 2) + 2;
            worst = std::max(worst, std::abs(rig.mapAt(map, x, z) / exact - 1));
        }
    return worst;
}

// Largest relative error of S1 at landing points `at`, zenith or oblique light.
inline double sinusoidError(FloorRig& rig, double depth, int photons, std::span<const double> at, double zenithDeg = 0,
                            double attenuation = 0) {
    const water::WaveField waves = sinusoidS1();
    FloorSetup setup;
    setup.waves = &waves, setup.depth = float(depth), setup.photons = photons, setup.center = {0, 0};
    setup.zenithDeg = float(zenithDeg), setup.attenuation = float(attenuation);
    rig.prepare(setup);
    rig.trace();
    const std::vector<float> map = rig.map();
    const water::analytic::Sinusoid exact{.attenuation = attenuation, .zenithAngle = zenithDeg * kPiD / 180};
    double worst = 0;
    for (const double x : at) {
        const double value = rig.mapAt(map, x, 0.3);
        worst = std::max(worst, std::abs(value / water::analytic::sinusoidIrradiance(exact, depth, x) - 1));
    }
    return worst;
}

// Depth below the level where the irradiance under a crest of S1 (mean over two texels) is largest, over the exact one.
inline double focusDepthRatio(FloorRig& rig) {
    const water::WaveField waves = sinusoidS1();
    double best = 0, bestDepth = 0, exactBest = 0, exactDepth = 0;
    for (double depth = 7.8; depth < 9.4; depth += 0.04) {
        FloorSetup setup;
        setup.waves = &waves, setup.depth = float(depth), setup.center = {0, 0}, setup.photons = 40000;
        rig.prepare(setup);
        rig.trace();
        const std::vector<double> profile = profileAlongX(rig, rig.map());
        const std::size_t middle = profile.size() / 2;
        const double value = profile[middle - 1] + profile[middle];
        if (value > best) best = value, bestDepth = depth;
        const double texel = double(rig.slot().texel);
        const double exact = water::analytic::sinusoidBins({}, depth, -texel, texel, 1)[0];
        if (exact > exactBest) exactBest = exact, exactDepth = depth;
    }
    return bestDepth / exactDepth;
}

// Where a profile outside of a fold falls below half of its peak there, in bins from `from` on.
inline double foldEdge(std::span<const double> profile, int from, int to) {
    int peak = from;
    for (int i = from; i < to; ++i)
        if (profile[std::size_t(i)] > profile[std::size_t(peak)]) peak = i;
    const double half = 0.5 * profile[std::size_t(peak)];
    for (int i = peak; i < to; ++i) {
        const double a = profile[std::size_t(i)], b = profile[std::size_t(i + 1)];
        if (b < half) return i + (a - half) / (a - b);
    }
    return to;
}

// How far the fold of S1 at D = 12 (X = .0838) lies from the exact one, texels.
inline double foldError(FloorRig& rig) {
    const water::WaveField waves = sinusoidS1();
    FloorSetup setup;
    setup.waves = &waves, setup.depth = 12, setup.center = {0, 0};
    rig.prepare(setup);
    rig.trace();
    const int n = rig.resolution();
    const std::vector<double> profile = profileAlongX(rig, rig.map());
    const std::vector<double> exact = water::analytic::sinusoidBins({}, 12, -2, 2, n);
    return std::abs(foldEdge(profile, n / 2, n / 2 + 64) - foldEdge(exact, n / 2, n / 2 + 64));
}

// P6 at a depth under zenith light, the mean over each texel (1/128 m) of a window of 1 m x 1 m at the origin: rays,
// and the same after the sun's disc. Rays are binned eight times as fine, so that the disc is not convolved with
// texels.
struct PatchReference {
    static constexpr int kSide = 128, kFiner = 8, kRimTexels = 2;
    std::vector<float> sharp, blurred;
};
inline PatchReference patchReference(double depth, double discHalfAngle, int raysPerSide) {
    const water::WaveField waves = patchP6();
    constexpr int kFine = (PatchReference::kSide + 2 * PatchReference::kRimTexels) * PatchReference::kFiner;
    constexpr float kRim = float(PatchReference::kRimTexels) / 128;
    const water::FloorBins bins{.min = {-kRim, -kRim}, .max = {1 + kRim, 1 + kRim}, .countX = kFine, .countZ = kFine};
    const Image fine =
        water::traceFloor(waves, water::kWaterIndex, 0, {0, 1, 0}, 0, depth, bins, raysPerSide, 1).irradiance;
    // Radius in fine bins of the disc's light on the floor, and the bins within it.
    const double radius = depth * std::tan(discHalfAngle) / water::kWaterIndex * 128 * PatchReference::kFiner;
    std::vector<IVec2> disc;
    for (int y = -int(radius); y <= int(radius); ++y)
        for (int x = -int(radius); x <= int(radius); ++x)
            if (std::hypot(x, y) <= radius) disc.push_back({x, y});
    PatchReference reference;
    for (int j = 0; j < PatchReference::kSide; ++j)
        for (int i = 0; i < PatchReference::kSide; ++i) {
            double sharp = 0, blurred = 0;
            for (int b = 0; b < PatchReference::kFiner; ++b)
                for (int a = 0; a < PatchReference::kFiner; ++a) {
                    const int x = (i + PatchReference::kRimTexels) * PatchReference::kFiner + a;
                    const int y = (j + PatchReference::kRimTexels) * PatchReference::kFiner + b;
                    sharp += double(*fine.at(x, y));
                    for (const IVec2 d : disc) blurred += double(*fine.at(x + d.x, y + d.y));
                }
            constexpr double kCount = double(PatchReference::kFiner) * PatchReference::kFiner;
            reference.sharp.push_back(float(sharp / kCount));
            reference.blurred.push_back(float(blurred / kCount / double(disc.size())));
        }
    return reference;
}
// The same window of a map whose square begins at the origin.
inline std::vector<float> patchWindow(const FloorRig& rig) {
    const std::vector<float> map = rig.map();
    std::vector<float> window;
    for (int j = 0; j < PatchReference::kSide; ++j)
        for (int i = 0; i < PatchReference::kSide; ++i)
            window.push_back(map[std::size_t(j) * std::size_t(rig.resolution()) + std::size_t(i)]);
    return window;
}

// Root of the mean square difference, and mean difference, over the mean of `b`.
struct MapError {
    double rmse = 0, mae = 0, mean = 0, referenceMean = 0;
};
template <class A, class B>
MapError compareMaps(const A& a, const B& b) {
    MapError e;
    double squares = 0, sums = 0;
    const std::size_t n = a.size();
    for (std::size_t i = 0; i < n; ++i) {
        const double d = double(a[i]) - double(b[i]);
        squares += d * d, sums += std::abs(d), e.mean += double(a[i]), e.referenceMean += double(b[i]);
    }
    e.mean /= double(n), e.referenceMean /= double(n);
    e.rmse = std::sqrt(squares / double(n)) / e.referenceMean;
    e.mae = sums / double(n) / e.referenceMean;
    return e;
}

}  // namespace shoal::test
