// A stage for the water surface (a body of water, what stands in it, a sky of one brightness) and what is measured on
// it. No test framework: benchmarks use it too.
#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <epoxy/gl.h>

#include <shoal/frame/geometry.h>
#include <shoal/frame/lighting.h>
#include <shoal/frame/post.h>
#include <shoal/water/gpu_waves.h>
#include <shoal/water/surface.h>

namespace shoal::test {

struct WaterPicture {
    Image radiance;                       // 3 channels, row 0 on top
    Image surfaceDepth, path, viewDepth;  // 1, 4 and 1 channels
    Image transmittance, waterDepth;      // 3 and 1, when terms were wanted
};

class WaterStage {
public:
    // sky: radiance from everywhere above, W/(m2 sr).
    static Result<std::unique_ptr<WaterStage>> create(gl::Device& device, float sky) {
        std::unique_ptr<WaterStage> stage(new WaterStage(device));
        SHOAL_TRY_ASSIGN(stage->geometry, frame::Geometry::create(device));
        SHOAL_TRY_ASSIGN(stage->lighting_, frame::Lighting::create(device));
        frame::ShadowSetup tiny;  // there is no sun
        tiny.sunResolution = tiny.spotResolution = 64;
        SHOAL_TRY_ASSIGN(stage->shadows_, frame::Shadows::create(device, tiny));
        SHOAL_TRY_ASSIGN(stage->surface, water::Surface::create(device));
        SHOAL_TRY_ASSIGN(stage->gpuWaves_, water::GpuWaves::create(device));
        light::Environment environment;
        environment.radiance = Image(8, 4, 3);
        for (float& x : environment.radiance.pixels) x = sky;
        SHOAL_TRY(stage->lighting_->setEnvironment(environment));
        water::WaveParams flat;
        flat.kind = "flat";
        SHOAL_TRY(stage->setWaves(flat));
        water::OpticsParams clear;
        clear.medium = "clear";
        SHOAL_TRY_ASSIGN(stage->body.optics, water::resolveOptics(clear));
        return stage;
    }

    Result<void> setWaves(const water::WaveParams& params,
                          std::span<const water::WaveComponentParams> components = {}) {
        SHOAL_TRY_ASSIGN(waves, water::WaveField::create(params, components));
        return {};
    }

    // Draws the mirrored views, the scene and the water once.
    Result<WaterPicture> draw(const light::View& view, bool terms = false) {
        gl::setKnownState();
        frame::Context context;
        context.device = &device_;
        context.view = context.previousView = view;
        context.frameIndex = ++frameIndex_;
        SHOAL_TRY(gpuWaves_->update(*waves));
        body.waves = &*waves, body.gpuWaves = &*gpuWaves_;
        geometry->update(context);
        surface->prepare(context, params, body, geometry->bounds());
        std::vector<water::SurfaceInputs::Mirror> mirrors;
        const auto needed = surface->neededViews();
        for (std::size_t i = 0; i < needed.size(); ++i) {
            frame::Context mirrored = context;
            mirrored.view = mirrored.previousView = needed[i].view;
            mirrored.clipPlane = needed[i].clipPlane;
            SHOAL_TRY(drawOpaque(mirrored, mirrors_[i]));
            mirrors.push_back({needed[i].view, mirrors_[i]->radiance(), mirrors_[i]->gbuffer().viewDepth});
        }
        SHOAL_TRY(drawOpaque(context, targets_));
        surface->setTermsWanted(terms);
        lighting_->bind();
        surface->useMirrors(mirrors);
        surface->trace(context, params, body, targets_->gbuffer().viewDepth, targets_->gbuffer().depth);
        targets_->copyOpaque();
        targets_->forward().bind();
        surface->compose(context, params, body, lights,
                         {targets_->opaqueCopy(), targets_->gbuffer().viewDepth, {}, mirrors});
        return read(terms);
    }

    std::optional<frame::Geometry> geometry;
    std::optional<water::Surface> surface;
    std::optional<water::WaveField> waves;
    water::Body body;          // waves and gpuWaves are filled by draw()
    water::BodyLights lights;  // none: no veil, no glitter
    water::SurfaceParams params;

private:
    explicit WaterStage(gl::Device& device) : device_(device) {}

    Result<void> drawOpaque(const frame::Context& context, std::optional<frame::Targets>& targets) {
        const int width = context.view.width, height = context.view.height;
        if (targets) {
            SHOAL_TRY(targets->resize(width, height));
        } else {
            SHOAL_TRY_ASSIGN(targets, frame::Targets::create(device_, width, height));
        }
        frame::LightingParams lighting;
        lighting.ambientOcclusion = false;
        targets->beginSurfaces();
        geometry->drawSurfaces(context, targets->gbuffer());
        targets->finishSurfaces(context);
        lighting_->prepare(context, lighting, {}, *targets);
        lighting_->shade(context, lighting, *shadows_, {}, *targets);
        return {};
    }

    Result<WaterPicture> read(bool terms) {
        WaterPicture picture;
        SHOAL_TRY_ASSIGN(picture.radiance, frame::readImage(device_, targets_->radiance(), 3));
        SHOAL_TRY_ASSIGN(picture.surfaceDepth, frame::readImage(device_, surface->paths().surfaceDepth, 1));
        SHOAL_TRY_ASSIGN(picture.path, frame::readImage(device_, surface->paths().path, 4));
        SHOAL_TRY_ASSIGN(picture.viewDepth, frame::readImage(device_, targets_->gbuffer().viewDepth, 1));
        if (!terms) return picture;
        SHOAL_TRY_ASSIGN(picture.transmittance, frame::readImage(device_, surface->transmittance(), 3));
        SHOAL_TRY_ASSIGN(picture.waterDepth, frame::readImage(device_, surface->waterDepth(), 1));
        return picture;
    }

    gl::Device& device_;
    std::optional<frame::Lighting> lighting_;
    std::optional<frame::Shadows> shadows_;
    std::optional<water::GpuWaves> gpuWaves_;
    std::optional<frame::Targets> targets_, mirrors_[3];
    std::uint32_t frameIndex_ = 0;
};

// Snell's window seen from 2 m under level, clear water by an eye that looks straight up; sky of radiance 1.
struct SnellWindow {
    double radiusPx = 0;       // of the circle as large as all that is lit
    double exactRadiusPx = 0;  // 1.134542 f for n = 1.333
    double zenithFactor = 0;   // radiance at the zenith: n^2 T = 1.740688
    double darkOutside = 0;    // brightest radiance well outside: total reflection of black
};
inline Result<SnellWindow> measureSnellWindow(gl::Device& device, int width, int height) {
    SHOAL_TRY_ASSIGN(const std::unique_ptr<WaterStage> stage, WaterStage::create(device, 1));
    const float fov = radians(100);
    const light::View view =
        light::makeView(light::cameraLookingAt({0.3f, -2, 0.2f}, {0.3f, 0, 0.2f}, fov), width, height);
    SHOAL_TRY_ASSIGN(const WaterPicture picture, stage->draw(view));
    SnellWindow window;
    const double f = 0.5 * double(height) / std::tan(0.5 * double(fov)), index = double(stage->body.optics.index);
    window.exactRadiusPx = f * std::tan(std::asin(1 / index));
    double area = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double value = double(picture.radiance.at(x, y)[0]);
            if (value > 1e-3) area += 1;
            const double r = std::hypot(x + 0.5 - 0.5 * width, y + 0.5 - 0.5 * height);
            if (r > window.exactRadiusPx + 2) window.darkOutside = std::max(window.darkOutside, value);
        }
    window.radiusPx = std::sqrt(area / kPiD);
    window.zenithFactor = double(picture.radiance.at(width / 2, height / 2)[0]);
    return window;
}

}  // namespace shoal::test
