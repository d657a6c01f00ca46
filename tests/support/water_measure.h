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

namespace shoal::measure {

// S1 of docs/water: one sinusoid. P6: six waves of period 4 m.
inline water::WaveField flatWaves() {
    water::WaveParams params;
    params.kind = "flat";
    return *water::WaveField::create(params);
}
inline water::WaveField sinusoidWaves(float amplitude = 0.05f, float wavelength = 2) {
    water::WaveParams params;
    params.kind = "sum";
    const water::WaveComponentParams wave{.amplitude = amplitude, .wavelength = wavelength};
    return *water::WaveField::create(params, std::span(&wave, 1));
}
inline water::WaveField patchWaves() {
    water::WaveParams params;
    params.kind = "sum";
    params.periodM = 4;
    const float rows[6][4] = {{.020f, 2, 1, 0},    {.015f, -3, 2, 1.3f}, {.010f, 5, -1, 2.1f},
                              {.006f, 3, 7, 4.0f}, {.004f, -9, 4, .7f},  {.0025f, 12, 9, 5.2f}};
    std::vector<water::WaveComponentParams> waves;
    for (const auto& r : rows) waves.push_back({.amplitude = r[0], .phase = r[3], .m = r[1], .q = r[2]});
    return *water::WaveField::create(params, waves);
}

struct FloorSetup {
    const water::WaveField* waves = nullptr;
    float depth = 2;                          // of the floor below the level, metres
    float zenithDeg = 0;                      // of the sun; its light travels towards +x
    float discHalfAngle = 0;                  // radians
    float attenuation = 0;                    // c, 1/m
    int photons = 160000;
    Vec2 center{2, 2};                        // of what the eye sees, world x, z
    float sideM = 4;
    std::vector<light::PunctualLight> lamps;  // in place of the sun
    float ceiling = 0;                        // height of a level ceiling above the level, 0: none
};

inline Vec3 sunAt(float zenithDeg) {
    return {-std::sin(radians(zenithDeg)), std::cos(radians(zenithDeg)), 0};
}

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

        const float depth = kEyeY + setup.depth;
        viewDepth_.clear(GL_RED, GL_FLOAT, &depth);
        const std::uint16_t up[2] = {32768, 65535};
        normal_.clear(GL_RG, GL_UNSIGNED_SHORT, up);
    }

    // Deposits (and resolves) the photons.
    void trace() {
        water::PhotonParams params;
        params.photons = setup_.photons;
        photons_.render(context_, params, body_, lights_, views_);
    }
    void lookUp() {
        photons_.resolve(context_, body_, lights_, views_, {viewDepth_, normal_}, {direct_, ambient_});
    }

    // The map of a slot, R32F as it is: irradiance on a level plane over E_perp; row j at z = origin.y + (j + .5) texel.
    std::vector<float> map(int slot = 0, int layer = 0) const {
        const gl::TextureView maps = photons_.maps();
        std::vector<float> all(std::size_t(maps.width) * std::size_t(maps.height));
        glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
        glGetTextureSubImage(maps.name, 0, 0, 0, 2 * slot + layer, maps.width, maps.height, 1, GL_RED, GL_FLOAT,
                             GLsizei(all.size() * 4), all.data());
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
        const int i = std::clamp(int(std::floor(u)), 0, resolution_ - 2), j = std::clamp(int(std::floor(v)), 0, resolution_ - 2);
        const double fu = u - i, fv = v - j;
        const auto at = [&](int a, int b) { return double(map[std::size_t(j + b) * std::size_t(resolution_) + std::size_t(i + a)]); };
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

}  // namespace shoal::measure
