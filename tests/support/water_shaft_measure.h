// God rays measured against closed forms: used by tests and by the rows water.godray_... of the benchmarks. Everything
// is drawn as the pipeline draws it, but for the surfaces: what the eye sees is put into the view depth by hand.
#pragma once

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <shoal/core/parallel.h>
#include <shoal/frame/geometry.h>
#include <shoal/frame/lighting.h>
#include <shoal/frame/post.h>
#include <shoal/frame/targets.h>
#include <shoal/water/gpu_waves.h>
#include <shoal/water/reference.h>
#include <shoal/water/shafts.h>

#include "support/frame_scene.h"
#include "support/known_waves.h"

namespace shoal::test {

// Water that scatters by Henyey-Greenstein alone, all of it in the pattern, without smooth light.
inline water::Optics shaftOptics(double attenuation = 0.13, double scattering = 0.08, double anisotropy = 0.924) {
    water::OpticsParams p;
    const float a = float(attenuation - scattering), b = float(scattering);
    p.absorption = {a, a, a}, p.scattering = {b, b, b};
    p.diffuseAttenuation = {10, 10, 10};
    p.anisotropy = float(anisotropy);
    p.forwardFraction = 0;
    return water::resolveOptics(p).value();
}

// Metres from the eye along a pixel's ray to what it shows; 0: nothing.
using DistanceOfRay = std::function<double(Vec3 direction)>;

inline DistanceOfRay distanceToFloor(Vec3 eye, double floorY) {
    return [=](Vec3 d) { return d.y < 0 ? (floorY - double(eye.y)) / double(d.y) : 0; };
}

class ShaftScene {
public:
    ShaftScene(gl::Device& device, int width, int height, water::WaveField field, const water::ShaftSetup& setup = {})
        : waves(std::move(field)), gpuWaves(*water::GpuWaves::create(device)),
          views(*water::LightViews::create(device, {})), shafts(*water::Shafts::create(device, setup)),
          lighting(*frame::Lighting::create(device)), targets(*frame::Targets::create(device, width, height)),
          geometry(*frame::Geometry::create(device)), device_(device) {
        gl::TextureDesc depth;
        depth.format = GL_R32F, depth.width = width, depth.height = height;
        viewDepth_ = gl::Texture::create(device, depth);
        depth.format = GL_RGBA16F;
        inscatter_ = gl::Texture::create(device, depth);
        sun.toSun = {0, 1, 0}, sun.irradiance = {1, 1, 1};
        optics = shaftOptics();
        look({0, -2, 0}, {1, -2, 0});
        bounds = {{-20, -10, -20}, {20, 0, 20}};
    }

    void look(Vec3 eye, Vec3 target, float fovDeg = 60) {
        context.device = &device_;
        const light::Camera camera = light::cameraLookingAt(eye, target, radians(fovDeg));
        context.view = context.previousView = light::makeView(camera, viewDepth_.width(), viewDepth_.height());
    }
    void add(const Primitive& p) {
        const auto model = geometry.addModel(modelOf({p}));
        frame::InstanceDesc desc;
        desc.model = *model;
        (void)geometry.addInstance(desc);
    }
    // Unit direction and metres a metre of view depth of pixel (x, y), rows from the top.
    Vec3 rayOf(int x, int y) const { return normalize(rayPerDepth(x, y)); }

    // What each pixel shows.
    void setDistances(const DistanceOfRay& distance) {
        const int w = viewDepth_.width(), h = viewDepth_.height();
        std::vector<float> values(std::size_t(w) * std::size_t(h));
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                const Vec3 ray = rayPerDepth(x, y);
                values[std::size_t(h - 1 - y) * std::size_t(w) + std::size_t(x)] =
                    float(distance(normalize(ray)) / double(length(ray)));
            }
        viewDepth_.upload(0, 0, GL_RED, GL_FLOAT, values.data());
    }

    void prepare() {
        ++context.frameIndex;
        body.optics = optics, body.waves = &waves, body.gpuWaves = &gpuWaves;
        (void)gpuWaves.update(waves);
        lights.sun = sunShines ? &sun : nullptr;
        lights.punctual = lamps;
        gl::setKnownState();
        geometry.update(context);
        lighting.prepare(context, lightingParams, {lights.sun, lamps, {}}, targets);
        lighting.bind();
        views.prepare(context, viewParams, body, lights, bounds);
        for (frame::NeededView& needed : views.neededViews()) geometry.drawDepth(context, needed);
    }
    void render() { shafts.render(context, params, body, lights, views); }
    void march() {
        lighting.bind();
        shafts.march(context, params, body, lights, views, {}, viewDepth_, {inscatter_});
    }
    Image picture() {
        prepare();
        render();
        march();
        return *frame::readImage(device_, inscatter_, 3);
    }

    water::WaveField waves;
    water::GpuWaves gpuWaves;
    water::LightViews views;
    water::Shafts shafts;
    frame::Lighting lighting;
    frame::Targets targets;
    frame::Geometry geometry;
    frame::Context context;
    frame::LightingParams lightingParams{
        .ambientOcclusion = false, .background = "color", .backgroundColor = {0, 0, 0}};
    light::Sun sun;
    bool sunShines = true;
    std::vector<light::PunctualLight> lamps;
    water::Optics optics;
    water::Body body;
    water::BodyLights lights;
    water::LightViewParams viewParams;
    water::ShaftParams params;
    Bounds bounds;

private:
    Vec3 rayPerDepth(int x, int y) const {
        const light::View& v = context.view;
        const float nx = (float(x) + 0.5f) / float(v.width) * 2 - 1, ny = 1 - (float(y) + 0.5f) / float(v.height) * 2;
        const Vec3 p = transformPoint(v.viewFromClip, {nx, ny, 1});
        return transformDirection(v.worldFromView, p * (-1 / p.z));
    }

    gl::Device& device_;
    gl::Texture viewDepth_, inscatter_;
};

// Largest relative error over a picture of level water, its eye 2 m deep: paths of 10 m looking level, of 4 m up and of
// 10 m down (30 degrees each), the sun in the zenith and 30 degrees off.
inline double flatShaftError(gl::Device& device, bool print = false) {
    ShaftScene scene(device, 96, 64, levelWater());
    double worst = 0;
    for (const double zenith : {0.0, 30.0})
        for (const auto& [up, distance] : {std::pair{0.0, 10.0}, {0.5, 4.0}, {-0.5, 10.0}}) {
            scene.sun.toSun = toSunAt(zenith * kPiD / 180);
            scene.look({0, -2, 0}, {float(std::sqrt(1 - up * up)), float(up) - 2, 0}, 20);
            scene.setDistances([metres = distance](Vec3) { return metres; });
            const Image picture = scene.picture();
            double here = 0;
            for (int y = 0; y < picture.height; ++y)
                for (int x = 0; x < picture.width; ++x) {
                    const Vec3 d = scene.rayOf(x, y);
                    water::analytic::ShaftRay ray{2, 0, double(d.x), double(d.y), double(d.z), distance};
                    if (d.y > 0) ray.length = std::min(ray.length, 2 / double(d.y));
                    const double expected = water::analytic::flatShaft({}, zenith * kPiD / 180, ray);
                    here = std::max(here, std::abs(double(picture.at(x, y)[1]) / expected - 1));
                }
            if (print) std::printf("flat, sun %.0f, v_y %.1f: %.5f\n", zenith, up, here);
            worst = std::max(worst, here);
        }
    return worst;
}

struct WavyShaftError {
    double rmse = 0;      // relative, of pixels away from edges
    double edgeRmse = 0;  // of pixels within 4 pixels of an edge of what is seen
    double mean = 0;      // of all: picture over truth, less 1
    double contrast = 0;  // of the truth: standard deviation of its ratio to level water's
};

// S1 seen from 3 m below along its crests, over a floor at 6 m, with a post 3 m away whose edges cut the paths (it
// stands in the picture alone: it takes no light away).
inline WavyShaftError wavyShaftError(gl::Device& device, float resolutionScale = 0.25f, int photons = 40000,
                                     double zenith = 0, bool print = false, const water::ShaftSetup& setup = {},
                                     Image* drawn = nullptr, Image* truth = nullptr) {
    constexpr int kWidth = 320, kHeight = 180, kStride = 6, kSteps = 160;
    ShaftScene scene(device, kWidth, kHeight, sinusoidS1(), setup);
    const Vec3 eye{0.1f, -3, 0};
    scene.look(eye, eye + Vec3{0.05f, -0.1f, -1}, 40);
    scene.sun.toSun = toSunAt(zenith);
    scene.bounds = {{-15, -6, -15}, {15, 0, 15}};
    scene.params.resolutionScale = resolutionScale;
    scene.params.photons = photons;
    const DistanceOfRay floor = distanceToFloor(eye, -6);
    const auto isPost = [](Vec3 d) { return std::abs(double(d.x) / double(d.z) + 0.2) < 0.06; };
    const auto distance = [&](Vec3 d) {
        const double post = isPost(d) ? -3 / double(d.z) : 1e9, bottom = floor(d);
        const double top = d.y > 0 ? 2.94 / double(d.y) : 1e9;  // below the troughs
        return std::min({post, bottom > 0 ? bottom : 1e9, top, 12.0});
    };
    scene.setDistances(distance);
    const Image picture = scene.picture();
    if (drawn) *drawn = picture;
    if (truth) *truth = Image(kWidth, kHeight, 1);

    struct Sum {
        double squares = 0, ratio = 0, waves = 0, waves2 = 0;
        int count = 0;
    };
    std::vector<Sum> interior(kHeight), edge(kHeight);
    water::analytic::Sinusoid s;
    s.zenithAngle = zenith;
    const auto row = [&](std::size_t i) {
        const int y = int(i);
        for (int x = 0; y % kStride == 0 && x < kWidth; x += kStride) {
            const Vec3 d = scene.rayOf(x, y);
            water::analytic::ShaftRay ray{-double(eye.y), double(eye.x), double(d.x),
                                          double(d.y),    double(d.z),   distance(d)};
            const double expected = water::analytic::sinusoidShaft({}, s, ray, kSteps);
            const double found = double(picture.at(x, y)[1]);
            bool nearEdge = false;
            for (const int dx : {-4, 4}) {
                const int there = std::clamp(x + dx, 0, kWidth - 1);
                nearEdge |= isPost(scene.rayOf(there, y)) != isPost(d);
            }
            Sum& sum = nearEdge ? edge[std::size_t(y)] : interior[std::size_t(y)];
            sum.squares += (found / expected - 1) * (found / expected - 1), sum.ratio += found / expected - 1;
            ++sum.count;
            const double wavy = expected / water::analytic::flatShaft({}, zenith, ray);
            sum.waves += wavy, sum.waves2 += wavy * wavy;
            if (truth)
                for (int j = 0; j < kStride && y + j < kHeight; ++j)
                    for (int i = 0; i < kStride && x + i < kWidth; ++i) truth->at(x + i, y + j)[0] = float(expected);
        }
    };
    parallelFor(kHeight, 4, row);
    const auto total = [](const std::vector<Sum>& rows) {
        Sum all;
        for (const Sum& r : rows) {
            all.squares += r.squares, all.ratio += r.ratio, all.count += r.count;
            all.waves += r.waves, all.waves2 += r.waves2;
        }
        return all;
    };
    const Sum in = total(interior), at = total(edge);
    WavyShaftError error;
    error.rmse = std::sqrt(in.squares / in.count), error.edgeRmse = std::sqrt(at.squares / at.count);
    const double count = in.count + at.count, waves = (in.waves + at.waves) / count;
    error.mean = (in.ratio + at.ratio) / count;
    error.contrast = std::sqrt((in.waves2 + at.waves2) / count - waves * waves);
    if (print)
        std::printf(
            "wavy, scale %.2f, %d photons, zenith %.2f: rmse %.4f, edges %.4f (%d pixels), mean %+.4f, contrast %.3f\n",
            double(resolutionScale), photons, zenith, error.rmse, error.edgeRmse, at.count, error.mean, error.contrast);
    return error;
}

// Mean over a picture of S1's shafts seen across the waves (it averages them), by the given numbers.
inline double meanShaft(gl::Device& device, const water::ShaftSetup& setup, const water::ShaftParams& params) {
    ShaftScene scene(device, 96, 64, sinusoidS1(), setup);
    scene.params = params;
    scene.setDistances([](Vec3) { return 8.0; });
    const Image picture = scene.picture();
    double sum = 0;
    for (std::size_t i = 1; i < picture.pixels.size(); i += 3) sum += double(picture.pixels[i]);
    return sum / double(picture.pixels.size() / 3);
}

// How far that mean moves, relative, when photons, slices' size and number, steps and the small picture's size do.
inline double shaftInvariance(gl::Device& device, bool print = false) {
    const double usual = meanShaft(device, {}, {});
    double worst = 0;
    const auto add = [&](const char* what, const water::ShaftSetup& setup, const water::ShaftParams& params) {
        const double away = std::abs(meanShaft(device, setup, params) / usual - 1);
        if (print) std::printf("invariance, %s: %.5f\n", what, away);
        worst = std::max(worst, away);
    };
    add("4 times the photons", {}, {.photons = 160000});
    add("a quarter of the photons", {}, {.photons = 10000});
    add("1 M photons", {}, {.photons = 1000000});
    add("half the slices' size", {.resolution = 64}, {});
    add("twice the slices", {.slices = 32}, {});
    add("twice the steps", {}, {.steps = 64});
    add("half the steps", {}, {.steps = 16});
    add("full size", {}, {.resolutionScale = 1});
    add("quarter size", {}, {.resolutionScale = 0.25f});
    return worst;
}

}  // namespace shoal::test
