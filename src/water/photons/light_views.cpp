#include <shoal/water/light_views.h>

#include <epoxy/gl.h>

#include <string>

#include "water/bindings.shared.h"
#include "water/photons/slot_fit.h"
#include "water/surface/water_block.h"

namespace shoal::water {

struct LightViews::State {
    // A layer of depth and what was last asked to be drawn into it.
    struct Layer {
        gl::Framebuffer framebuffer;
        Mat4 clipFromWorld;
        bool asked = false;
    };
    gl::Device* device = nullptr;
    LightViewSetup setup;
    gl::Texture litDepth, airDepth;
    gl::Sampler plain;
    std::vector<Layer> litLayers, airLayers;
    gl::BlockBuffer<LightSpaceBlock> block;
    std::vector<LightSlot> slots;
    std::vector<frame::NeededView> views;
    bool airDrawn = false;
};

namespace {

using State = LightViews::State;

constexpr float kTravelSteps = 4, kTravelPasses = 2;  // of photonTravel (photon.io.glsl)

gl::Texture makeDepth(gl::Device& device, int resolution, int layers, const char* label) {
    gl::TextureDesc desc;
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.format = GL_DEPTH_COMPONENT32F;
    desc.width = desc.height = resolution;
    desc.layers = layers;
    desc.label = label;
    gl::Texture texture = gl::Texture::create(device, desc);
    if (!texture) return texture;
    const float nothing = 0;
    texture.clear(GL_DEPTH_COMPONENT, GL_FLOAT, &nothing);
    return texture;
}

Result<void> makeLayers(gl::Device& device, const gl::Texture& depth, int count, const char* label,
                        std::vector<State::Layer>& layers) {
    for (int i = 0; i < count; ++i) {
        State::Layer layer;
        const gl::Framebuffer::Attachment attachment{depth.view(), 0, i};
        SHOAL_TRY_ASSIGN(layer.framebuffer, gl::Framebuffer::create(device, {}, attachment, label));
        layers.push_back(std::move(layer));
    }
    return {};
}

void ask(State& s, std::vector<State::Layer>& layers, const gl::Texture& depth, int layer, const light::View& view,
         int peelLayer, float peelGap) {
    State::Layer& l = layers[std::size_t(layer)];
    frame::NeededView needed;
    needed.purpose = frame::NeededView::Purpose::photonDepth;
    needed.view = view;
    needed.depth = depth.view();
    needed.layer = layer;
    needed.framebuffer = l.framebuffer.name();
    if (peelLayer >= 0) {
        needed.peel = depth.view();
        needed.peelLayer = peelLayer;
        needed.peelGap = peelGap;
    }
    const Mat4 clipFromWorld = view.clipFromWorld();
    needed.unchanged = l.asked && l.clipFromWorld == clipFromWorld;
    l.clipFromWorld = clipFromWorld;
    l.asked = true;
    s.views.push_back(needed);
}

// What finer slots of the group look up: coarser photons that can only land there are left out.
void fillInner(std::span<const SlotFit> fits, int resolution, LightSpaceBlock& block) {
    for (std::size_t i = 1; i < fits.size(); ++i) {
        const LightSlot& finer = fits[i - 1].slot;
        if (fits[i].record.rows.z != fits[i - 1].record.rows.z) continue;
        const float side = finer.texel * float(resolution);
        // Lookups blend up to the rim, and mips and blur reach a few texels of the coarser map further in.
        const float rim = 12 * fits[i].slot.texel + 0.125f * side;
        block.slots[i].inner = {finer.origin.x + rim, finer.origin.y + rim, finer.origin.x + side - rim,
                                finer.origin.y + side - rim};
    }
}

}  // namespace

LightViews::LightViews(std::unique_ptr<State> state) : state_(std::move(state)) {}
LightViews::LightViews(LightViews&&) noexcept = default;
LightViews& LightViews::operator=(LightViews&&) noexcept = default;
LightViews::~LightViews() = default;

Result<LightViews> LightViews::create(gl::Device& device, const LightViewSetup& setup) {
    const auto inRange = [](const char* field, int value, int lowest, int highest) -> Result<void> {
        if (value >= lowest && value <= highest) return {};
        return badInput(std::string("light view setup: ") + field + " is " + std::to_string(value) + ", expected " +
                        std::to_string(lowest) + " to " + std::to_string(highest));
    };
    SHOAL_TRY(inRange("resolution", setup.resolution, 64, std::min(4096, device.capabilities().maxTextureSize)));
    SHOAL_TRY(inRange("maxSlots", setup.maxSlots, 1, SHOAL_MAX_LIGHT_SLOTS));
    registerWaterShaders();
    auto state = std::make_unique<State>();
    state->device = &device;
    state->setup = setup;
    state->litDepth = makeDepth(device, setup.resolution, 2 * setup.maxSlots, "light depth in water");
    state->airDepth = makeDepth(device, setup.resolution, setup.maxSlots, "light depth above water");
    if (!state->litDepth || !state->airDepth) return internalError("no memory for the depth that light sees");
    SHOAL_TRY(makeLayers(device, state->litDepth, 2 * setup.maxSlots, "light depth in water", state->litLayers));
    SHOAL_TRY(makeLayers(device, state->airDepth, setup.maxSlots, "light depth above water", state->airLayers));
    state->plain = gl::Sampler::create(device, GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    state->block = gl::BlockBuffer<LightSpaceBlock>::create(device, "light space");
    state->block.write(LightSpaceBlock{});
    state->slots.reserve(std::size_t(setup.maxSlots));
    state->views.reserve(std::size_t(3 * setup.maxSlots));
    return LightViews(std::move(state));
}

void LightViews::prepare(const frame::Context& context, const LightViewParams& params, const Body& body,
                         const BodyLights& lights, const Bounds& sceneBounds) {
    State& s = *state_;
    const std::vector<SlotFit> fits = fitSlots(context.view, s.setup, params, body, lights, sceneBounds);
    s.slots.clear();
    s.views.clear();
    s.airDrawn = false;
    LightSpaceBlock block{};
    block.counts = {float(fits.size()), float(s.setup.resolution), kTravelSteps, kTravelPasses};
    for (std::size_t i = 0; i < fits.size(); ++i) {
        const SlotFit& fit = fits[i];
        const int index = int(i);
        s.slots.push_back(fit.slot);
        block.slots[i] = fit.record;
        ask(s, s.litLayers, s.litDepth, 2 * index, fit.lit, -1, 0);
        ask(s, s.litLayers, s.litDepth, 2 * index + 1, fit.lit, 2 * index, fit.peelGap);
        s.airDrawn = s.airDrawn || fit.airDrawn;
        if (fit.airDrawn) ask(s, s.airLayers, s.airDepth, index, fit.air, -1, 0);
    }
    fillInner(fits, s.setup.resolution, block);
    for (std::size_t i = fits.size(), end = i; i-- > 0;) {
        if (i + 1 < fits.size() && fits[i].record.rows.z != fits[i + 1].record.rows.z) end = i + 1;
        block.slots[i].rows.z = float(end);
    }
    for (std::size_t i = 2 * fits.size(); i < s.litLayers.size(); ++i) s.litLayers[i].asked = false;
    for (std::size_t i = 0; i < s.airLayers.size(); ++i)
        if (i >= fits.size() || !fits[i].airDrawn) s.airLayers[i].asked = false;
    s.block.write(block);
}

std::span<frame::NeededView> LightViews::neededViews() { return state_->views; }
std::span<const LightSlot> LightViews::slots() const { return state_->slots; }

bool LightViews::airDrawn() const { return state_->airDrawn; }

void LightViews::bind() const {
    const State& s = *state_;
    s.block.bindUniform(SHOAL_BLOCK_LIGHT_SPACE);
    gl::bindTexture(SHOAL_UNIT_LIT_DEPTH, s.litDepth.view());
    s.plain.bind(SHOAL_UNIT_LIT_DEPTH);
    gl::bindTexture(SHOAL_UNIT_AIR_DEPTH, s.airDepth.view());
    s.plain.bind(SHOAL_UNIT_AIR_DEPTH);
}

}  // namespace shoal::water
