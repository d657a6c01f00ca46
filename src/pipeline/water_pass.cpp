#include "pipeline/water_pass.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace shoal::pipeline {

namespace {

gl::Texture colorTarget(gl::Device& device, int width, int height, const char* label) {
    return gl::Texture::create(device, {.format = GL_RGBA16F, .width = width, .height = height, .label = label});
}

void clear(const gl::Texture& texture) {
    const float zero[4] = {0, 0, 0, 0};
    glClearTexImage(texture.name(), 0, GL_RGBA, GL_FLOAT, zero);
}

}  // namespace

WaterPass::WaterPass(gl::Device& device, WaterSpec spec, Vec3 skyIrradiance, water::WaveField waves,
                     water::Optics optics, water::GpuWaves gpuWaves, water::LightViews views, water::Photons photons,
                     water::Shafts shafts, water::Surface surface)
    : device_(device), spec_(std::move(spec)), skyIrradiance_(skyIrradiance), waves_(std::move(waves)), optics_(optics),
      gpuWaves_(std::move(gpuWaves)), views_(std::move(views)), photons_(std::move(photons)),
      shafts_(std::move(shafts)), surface_(std::move(surface)) {}

Result<std::unique_ptr<WaterPass>> WaterPass::create(gl::Device& device, WaterSpec spec, Vec3 skyIrradiance) {
    SHOAL_TRY_ASSIGN(const water::Optics optics, water::resolveOptics(spec.optics));
    SHOAL_TRY_ASSIGN(water::WaveField waves,
                     water::WaveField::create(spec.waves, spec.components, std::move(spec.heightmaps)));
    SHOAL_TRY_ASSIGN(water::GpuWaves gpuWaves, water::GpuWaves::create(device));
    SHOAL_TRY_ASSIGN(water::LightViews views, water::LightViews::create(device, {}));
    SHOAL_TRY_ASSIGN(water::Photons photons, water::Photons::create(device, {}));
    SHOAL_TRY_ASSIGN(water::Shafts shafts, water::Shafts::create(device, {}));
    SHOAL_TRY_ASSIGN(water::Surface surface, water::Surface::create(device));
    std::optional<water::PaperMethod> paper;
    if (spec.photons.method == "paper") {
        SHOAL_TRY_ASSIGN(paper, water::PaperMethod::create(device));
    }
    std::unique_ptr<WaterPass> pass(new WaterPass(device, std::move(spec), skyIrradiance, std::move(waves), optics,
                                                  std::move(gpuWaves), std::move(views), std::move(photons),
                                                  std::move(shafts), std::move(surface)));
    pass->paper_ = std::move(paper);
    return pass;
}

frame::Medium WaterPass::medium() const { return {spec_.body.level, optics_.beamAttenuation()}; }

bool WaterPass::shafts() const {
    const Vec3 b = optics_.scattering;
    return spec_.shafts.enabled && std::max({b.x, b.y, b.z}) > 0;
}

Result<void> WaterPass::resize(int width, int height) {
    if (direct_ && direct_.width() == width && direct_.height() == height) return {};
    direct_ = colorTarget(device_, width, height, "water light");
    ambient_ = colorTarget(device_, width, height, "water sky light");
    inscatter_ = colorTarget(device_, width, height, "in-scatter");
    if (!direct_ || !ambient_ || !inscatter_) return internalError("no memory for water of this size");
    clear(direct_), clear(ambient_), clear(inscatter_);
    return {};
}

water::Body WaterPass::body() const { return {spec_.body, optics_, &waves_, &gpuWaves_}; }

water::BodyLights WaterPass::bodyLights(const WaterScene& scene) const {
    return {scene.lights.sun, scene.lights.punctual, skyIrradiance_};
}

void WaterPass::drawDepths(const frame::Context& context, std::span<frame::NeededView> views,
                           frame::Geometry& geometry) {
    for (frame::NeededView& needed : views)
        if (!needed.unchanged || geometry.changed(needed.view)) geometry.drawDepth(context, needed);
}

void WaterPass::renderFrame(const frame::Context& context, const WaterScene& scene) {
    waves_.setTime(context.time);
    if (const auto uploaded = gpuWaves_.update(waves_); !uploaded)
        device_.log(LogLevel::error, uploaded.error().message);
    const water::Body body = this->body();
    const water::BodyLights lights = bodyLights(scene);
    const Bounds bounds = scene.geometry.bounds();
    if (paper()) {
        paper_->prepare(context, spec_.paper, body, lights, bounds);
        drawDepths(context, paper_->neededViews(), scene.geometry);
    } else {
        views_.prepare(context, spec_.lightViews, body, lights, bounds);
        drawDepths(context, views_.neededViews(), scene.geometry);
        if (spec_.photons.method == "shoal") photons_.render(context, spec_.photons, body, lights, views_);
        if (shafts()) shafts_.render(context, spec_.shafts, body, lights, views_);
    }
    surface_.prepare(context, spec_.surface, body, bounds);
    const auto needed = surface_.neededViews();
    mirrorTargets_.resize(std::max(mirrorTargets_.size(), needed.size()));
    mirrors_.clear();
    for (std::size_t i = 0; i < needed.size(); ++i) {
        MirrorTargets& to = mirrorTargets_[i];
        if (const auto sized = resizeMirror(needed[i].view, to); !sized) {
            device_.log(LogLevel::error, sized.error().message);
            mirrors_.push_back({needed[i].view, {}, {}});
            continue;
        }
        drawMirror(context, scene, needed[i], to);
        mirrors_.push_back({needed[i].view, to.targets->radiance(), to.targets->gbuffer().viewDepth});
    }
}

Result<void> WaterPass::resizeMirror(const light::View& view, MirrorTargets& mirror) {
    if (!mirror.targets) {
        SHOAL_TRY_ASSIGN(mirror.targets, frame::Targets::create(device_, view.width, view.height));
    } else {
        SHOAL_TRY(mirror.targets->resize(view.width, view.height));
    }
    if (mirror.direct && mirror.direct.width() == view.width && mirror.direct.height() == view.height) return {};
    mirror.direct = colorTarget(device_, view.width, view.height, "water light, mirrored");
    mirror.ambient = colorTarget(device_, view.width, view.height, "water sky light, mirrored");
    if (!mirror.direct || !mirror.ambient) return internalError("no memory for a mirrored view");
    return {};
}

void WaterPass::drawMirror(const frame::Context& context, const WaterScene& scene,
                           const water::Surface::MirrorView& view, MirrorTargets& to) {
    frame::Context mirrored = context;
    mirrored.view = mirrored.previousView = view.view;
    mirrored.jitterPx = {};
    mirrored.clipPlane = view.clipPlane;
    frame::LightingParams params = scene.lightingParams;
    params.ambientOcclusion = false;  // costs a pass that nobody sees in the waves
    to.targets->beginSurfaces();
    scene.geometry.drawSurfaces(mirrored, to.targets->gbuffer());
    to.targets->finishSurfaces(mirrored);
    frame::LightOverrides overrides;
    if (!paper()) {
        resolve(mirrored, scene, *to.targets, to.direct, to.ambient);
        overrides = {to.direct, to.ambient};
    }
    scene.lighting.prepare(mirrored, params, scene.lights, *to.targets);
    scene.lighting.shade(mirrored, params, scene.shadows, overrides, *to.targets);
}

void WaterPass::resolve(const frame::Context& context, const WaterScene& scene, const frame::Targets& targets,
                        const gl::Texture& direct, const gl::Texture& ambient) {
    const frame::GBuffer& g = targets.gbuffer();
    photons_.resolve(context, body(), bodyLights(scene), views_, {g.viewDepth, g.normal}, {direct, ambient});
}

frame::LightOverrides WaterPass::light(const frame::Context& context, const WaterScene& scene,
                                       const frame::Targets& targets) {
    if (paper()) {
        const frame::GBuffer& g = targets.gbuffer();
        const water::ReceiverInputs receivers{g.viewDepth, g.normal};
        paper_->render(context, spec_.paper, body(), bodyLights(scene), receivers, g.depth);
        paper_->compose(context, spec_.paper, receivers, {direct_, ambient_}, inscatter_);
    } else {
        resolve(context, scene, targets, direct_, ambient_);
    }
    return {direct_, ambient_};
}

void WaterPass::draw(const frame::Context& context, const WaterScene& scene, const frame::Targets& targets) {
    const water::Body body = this->body();
    const water::BodyLights lights = bodyLights(scene);
    const frame::GBuffer& g = targets.gbuffer();
    surface_.trace(context, spec_.surface, body, g.viewDepth, g.depth);
    const bool scatters = paper() || shafts();
    if (!paper() && scatters)
        shafts_.march(context, spec_.shafts, body, lights, views_, surface_.paths(), g.viewDepth, {inscatter_});
    {
        const gl::PassScope pass(context.timer, "copy opaque");
        targets.copyOpaque();
    }
    targets.forward().bind();
    scene.lighting.bind();
    scene.shadows.bind();
    surface_.compose(context, spec_.surface, body, lights,
                     {targets.opaqueCopy(), g.viewDepth, scatters ? inscatter_.view() : gl::TextureView(), mirrors_});
}

}  // namespace shoal::pipeline
