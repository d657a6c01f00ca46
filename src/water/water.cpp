#include <shoal/water/water.h>

#include <algorithm>

#include "frame/bindings.shared.h"
#include "frame/light_block.h"

namespace shoal::water {

struct Water::State {
    gl::Device& device;
    BodyParams bodyParams;
    Optics optics;
    WaveField waves;
    GpuWaves gpuWaves;
    LightViews views;
    Photons photons;
    Shafts shafts;
    Surface surface;
    gl::BlockBuffer<frame::LightBlock> eyeBlock;  // pixel rays, where no frame::Lighting has bound them
};

Water::Water(std::unique_ptr<State> state) : state_(std::move(state)) {}
Water::Water(Water&&) noexcept = default;
Water& Water::operator=(Water&&) noexcept = default;
Water::~Water() = default;

Result<Water> Water::create(gl::Device& device, WaterSetup setup) {
    SHOAL_TRY_ASSIGN(const Optics optics, resolveOptics(setup.optics));
    SHOAL_TRY_ASSIGN(WaveField waves, WaveField::create(setup.waves, setup.components, std::move(setup.heightmaps)));
    SHOAL_TRY_ASSIGN(GpuWaves gpuWaves, GpuWaves::create(device));
    SHOAL_TRY_ASSIGN(LightViews views, LightViews::create(device, setup.lightViews));
    SHOAL_TRY_ASSIGN(Photons photons,
                     Photons::create(device, {setup.lightViews.resolution, setup.lightViews.maxSlots}));
    setup.shafts.viewResolution = setup.lightViews.resolution;
    SHOAL_TRY_ASSIGN(Shafts shafts, Shafts::create(device, setup.shafts));
    SHOAL_TRY_ASSIGN(Surface surface, Surface::create(device));
    SHOAL_TRY(gpuWaves.update(waves));
    auto eyeBlock = gl::BlockBuffer<frame::LightBlock>::create(device, "water eye");
    return Water(std::unique_ptr<State>(new State{device, setup.body, optics, std::move(waves), std::move(gpuWaves),
                                                  std::move(views), std::move(photons), std::move(shafts),
                                                  std::move(surface), std::move(eyeBlock)}));
}

Body Water::body() const {
    const State& s = *state_;
    return {s.bodyParams, s.optics, &s.waves, &s.gpuWaves};
}

WaveField& Water::waves() { return state_->waves; }
Surface& Water::surface() { return state_->surface; }
const Photons& Water::photons() const { return state_->photons; }

bool Water::scatters(const WaterParams& params) const {
    const Vec3 b = state_->optics.scattering;
    return params.shafts.enabled && std::max({b.x, b.y, b.z}) > 0;
}

void Water::prepare(const frame::Context& context, const WaterParams& params, const BodyLights& lights,
                    const Bounds& sceneBounds) {
    State& s = *state_;
    s.waves.setTime(double(context.time));
    if (const auto uploaded = s.gpuWaves.update(s.waves); !uploaded)
        s.device.log(LogLevel::error, uploaded.error().message);
    s.views.prepare(context, params.lightViews, body(), lights, sceneBounds);
}

std::span<frame::NeededView> Water::neededViews() { return state_->views.neededViews(); }

void Water::renderLight(const frame::Context& context, const WaterParams& params, const BodyLights& lights) {
    State& s = *state_;
    s.photons.render(context, params.photons, body(), lights, s.views);
    if (scatters(params)) s.shafts.render(context, params.shafts, body(), lights, s.views);
}

void Water::light(const frame::Context& context, const BodyLights& lights, const ReceiverInputs& receivers,
                  const IrradianceOutputs& outputs) {
    State& s = *state_;
    s.photons.resolve(context, body(), lights, s.views, receivers, outputs);
}

void Water::scatter(const frame::Context& context, const WaterParams& params, const BodyLights& lights,
                    gl::TextureView viewDepth, gl::TextureView depth, gl::TextureView inscatter) {
    State& s = *state_;
    s.eyeBlock.write(frame::makeLightBlock(context, {}, {}, {}));
    s.eyeBlock.bindUniform(SHOAL_BLOCK_LIGHT);
    s.surface.trace(context, params.surface, body(), viewDepth, depth);
    if (inscatter && scatters(params))
        s.shafts.march(context, params.shafts, body(), lights, s.views, s.surface.paths(), viewDepth, {inscatter});
}

frame::Stats Water::stats() const {
    frame::Stats all;
    for (const frame::Stats& part : {state_->photons.stats(), state_->shafts.stats(), state_->surface.stats()}) {
        all.passes.insert(all.passes.end(), part.passes.begin(), part.passes.end());
        all.bytes += part.bytes;
        all.counts.insert(all.counts.end(), part.counts.begin(), part.counts.end());
    }
    return all;
}

}  // namespace shoal::water
