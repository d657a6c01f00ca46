#include "pipeline/water_pass.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "frame/fullscreen.h"

namespace shoal::pipeline {

namespace {

constexpr int kDraftPhotons = 8;  // a draft has one in so many

void clear(const gl::Texture& texture) {
    const float zero[4] = {0, 0, 0, 0};
    glClearTexImage(texture.name(), 0, GL_RGBA, GL_FLOAT, zero);
}

}  // namespace

WaterPass::WaterPass(gl::Device& device, const WaterSpec& spec, Vec3 skyIrradiance, water::Water water)
    : device_(device), params_(spec.params), paperParams_(spec.paper), skyIrradiance_(skyIrradiance),
      water_(std::move(water)) {}

Result<std::unique_ptr<WaterPass>> WaterPass::create(gl::Device& device, WaterSpec spec, Vec3 skyIrradiance) {
    SHOAL_TRY_ASSIGN(water::Water water, water::Water::create(device, std::move(spec.setup)));
    std::unique_ptr<WaterPass> pass(new WaterPass(device, spec, skyIrradiance, std::move(water)));
    if (spec.params.photons.method == "paper") {
        SHOAL_TRY_ASSIGN(pass->paper_, water::PaperMethod::create(device));
    }
    return pass;
}

frame::Medium WaterPass::medium() const {
    const water::Body body = water_.body();
    return {body.params.level, body.optics.beamAttenuation()};
}

Result<void> WaterPass::resize(int width, int height) {
    if (direct_ && direct_.width() == width && direct_.height() == height) return {};
    direct_ = frame::makeTarget(device_, GL_RGBA16F, width, height, "water light");
    ambient_ = frame::makeTarget(device_, GL_RGBA16F, width, height, "water sky light");
    inscatter_ = frame::makeTarget(device_, GL_RGBA16F, width, height, "in-scatter");
    if (!direct_ || !ambient_ || !inscatter_) return internalError("no memory for water of this size");
    clear(direct_), clear(ambient_), clear(inscatter_);
    return {};
}

water::BodyLights WaterPass::bodyLights(const WaterScene& scene) const {
    return {scene.lights.sun, scene.lights.punctual, skyIrradiance_};
}

void WaterPass::drawDepths(const frame::Context& context, std::span<frame::NeededView> views,
                           frame::Geometry& geometry) {
    for (frame::NeededView& needed : views)
        if (!needed.unchanged || geometry.changed(needed.view)) geometry.drawDepth(context, needed);
}

void WaterPass::renderFrame(const frame::Context& context, const WaterScene& scene) {
    const water::BodyLights lights = bodyLights(scene);
    const Bounds bounds = scene.geometry.bounds();
    water::WaterParams params = params_;
    if (context.draft) params.photons.photons = std::max(1000, params.photons.photons / kDraftPhotons);
    water_.prepare(context, params, lights, bounds);
    if (paper_) {
        paper_->prepare(context, paperParams_, water_.body(), lights, bounds);
        drawDepths(context, paper_->neededViews(), scene.geometry);
    } else {
        drawDepths(context, water_.neededViews(), scene.geometry);
        water_.renderLight(context, params, lights);
    }
    water_.surface().prepare(context, params_.surface, water_.body(), bounds);
    const auto needed = water_.surface().neededViews();
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
    mirror.direct = frame::makeTarget(device_, GL_RGBA16F, view.width, view.height, "water light, mirrored");
    mirror.ambient = frame::makeTarget(device_, GL_RGBA16F, view.width, view.height, "water sky light, mirrored");
    if (!mirror.direct || !mirror.ambient) return internalError("no memory for a mirrored view");
    return {};
}

void WaterPass::drawMirror(const frame::Context& context, const WaterScene& scene,
                           const water::Surface::MirrorView& view, MirrorTargets& to) {
    const gl::PassScope pass(context.timer, "mirrored views");
    frame::Context mirrored = context;
    mirrored.timer = nullptr;  // one pass of the frame: its own are not the picture's
    mirrored.view = mirrored.previousView = view.view;
    mirrored.jitterPx = {};
    mirrored.clipPlane = view.clipPlane;
    frame::LightingParams params = scene.lightingParams;
    params.ambientOcclusion = false;  // costs a pass that nobody sees in the waves
    to.targets->beginSurfaces();
    scene.geometry.drawSurfaces(mirrored, to.targets->gbuffer());
    to.targets->finishSurfaces(mirrored);
    frame::LightOverrides overrides;
    if (!paper_) {
        resolve(mirrored, scene, *to.targets, to.direct, to.ambient);
        overrides = {to.direct, to.ambient};
    }
    scene.lighting.prepare(mirrored, params, scene.lights, *to.targets);
    scene.lighting.shade(mirrored, params, scene.shadows, overrides, *to.targets);
}

void WaterPass::resolve(const frame::Context& context, const WaterScene& scene, const frame::Targets& targets,
                        const gl::Texture& direct, const gl::Texture& ambient) {
    const frame::GBuffer& g = targets.gbuffer();
    water_.light(context, bodyLights(scene), {g.viewDepth, g.normal}, {direct, ambient});
}

frame::LightOverrides WaterPass::light(const frame::Context& context, const WaterScene& scene,
                                       const frame::Targets& targets) {
    if (paper_) {
        const frame::GBuffer& g = targets.gbuffer();
        const water::ReceiverInputs receivers{g.viewDepth, g.normal};
        paper_->render(context, paperParams_, water_.body(), bodyLights(scene), receivers, g.depth);
        paper_->compose(context, paperParams_, receivers, {direct_, ambient_}, inscatter_);
    } else {
        resolve(context, scene, targets, direct_, ambient_);
    }
    return {direct_, ambient_};
}

void WaterPass::draw(const frame::Context& context, const WaterScene& scene, const frame::Targets& targets) {
    const water::BodyLights lights = bodyLights(scene);
    const frame::GBuffer& g = targets.gbuffer();
    const bool scatters = paper_ || water_.scatters(params_);
    scene.shadows.bind();  // of spots in the water
    water_.surface().useMirrors(mirrors_);
    water_.scatter(context, params_, lights, g.viewDepth, g.depth, paper_ ? gl::TextureView() : inscatter_.view());
    {
        const gl::PassScope pass(context.timer, "copy opaque");
        targets.copyOpaque();
    }
    targets.forward().bind();
    scene.lighting.bind();
    scene.shadows.bind();
    water_.surface().compose(
        context, params_.surface, water_.body(), lights,
        {targets.opaqueCopy(), g.viewDepth, scatters ? inscatter_.view() : gl::TextureView(), mirrors_});
}

}  // namespace shoal::pipeline
