// Water in the pipeline's frame: owns the technique's parts of one scene and calls them in their order.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <shoal/frame/geometry.h>
#include <shoal/frame/lighting.h>
#include <shoal/frame/shadows.h>
#include <shoal/frame/targets.h>
#include <shoal/pipeline/water.h>
#include <shoal/water/water.h>

namespace shoal::pipeline {

// What of the scene the water needs; outlives the call it is given to.
struct WaterScene {
    frame::Geometry& geometry;
    frame::Lighting& lighting;
    const frame::Shadows& shadows;
    const frame::LightingParams& lightingParams;
    frame::Lights lights;
};

class WaterPass {
public:
    static Result<std::unique_ptr<WaterPass>> create(gl::Device& device, WaterSpec spec, Vec3 skyIrradiance);

    // How water dims lamps in it: belongs into frame::Lights of every shading.
    frame::Medium medium() const;
    Result<void> resize(int width, int height);

    // Once a frame, after Geometry::update: waves at the frame's time, views from the lights, photons, mirrored views.
    void renderFrame(const frame::Context& context, const WaterScene& scene);
    // Once a sample, between the G-buffer and its shading: what water does to the light on surfaces.
    frame::LightOverrides light(const frame::Context& context, const WaterScene& scene, const frame::Targets& targets);
    // Once a sample, after the opaque surfaces are shaded: the water itself, into targets.radiance().
    void draw(const frame::Context& context, const WaterScene& scene, const frame::Targets& targets);

    // Of the last sample; transmittance and waterDepth only where terms were wanted.
    void setTermsWanted(bool wanted) { water_.surface().setTermsWanted(wanted); }
    gl::TextureView caustics() const { return direct_.view(); }
    gl::TextureView inscatter() const { return inscatter_.view(); }
    gl::TextureView transmittance() { return water_.surface().transmittance(); }
    gl::TextureView waterDepth() { return water_.surface().waterDepth(); }
    frame::Stats stats() const { return water_.stats(); }

private:
    struct MirrorTargets {
        std::optional<frame::Targets> targets;
        gl::Texture direct, ambient;
    };

    WaterPass(gl::Device& device, const WaterSpec& spec, Vec3 skyIrradiance, water::Water water);
    water::BodyLights bodyLights(const WaterScene& scene) const;
    void drawDepths(const frame::Context& context, std::span<frame::NeededView> views, frame::Geometry& geometry);
    void resolve(const frame::Context& context, const WaterScene& scene, const frame::Targets& targets,
                 const gl::Texture& direct, const gl::Texture& ambient);
    void drawMirror(const frame::Context& context, const WaterScene& scene, const water::Surface::MirrorView& view,
                    MirrorTargets& to);
    Result<void> resizeMirror(const light::View& view, MirrorTargets& mirror);

    gl::Device& device_;
    water::WaterParams params_;
    water::PaperParams paperParams_;
    Vec3 skyIrradiance_;
    water::Water water_;
    std::optional<water::PaperMethod> paper_;  // of method = "paper", in place of photons and shafts
    gl::Texture direct_, ambient_, inscatter_;
    std::vector<MirrorTargets> mirrorTargets_;
    std::vector<water::SurfaceInputs::Mirror> mirrors_;  // of this frame
};

}  // namespace shoal::pipeline
