#include <shoal/frame/shadows.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "frame/bindings.shared.h"
#include "frame/shadow.shared.h"
#include "frame/shadow_fit.h"

namespace shoal::frame {

static_assert(kMaxCascades == SHOAL_MAX_CASCADES);

struct Shadows::State {
    // One depth layer and what was last asked to be drawn into it.
    struct Slot {
        gl::Framebuffer framebuffer;
        Mat4 clipFromWorld;
        bool asked = false;
    };
    gl::Device* device = nullptr;
    ShadowSetup setup;
    gl::Texture sunDepth, spotDepth;
    gl::Sampler plain, compared;
    std::vector<Slot> sunSlots, spotSlots;
    gl::BlockBuffer<ShadowBlock> block;
    std::vector<NeededView> views;
};

namespace {

using State = Shadows::State;

Result<void> checkSetup(const gl::Device& device, const ShadowSetup& setup) {
    auto inRange = [](const char* field, int value, int lowest, int highest) -> Result<void> {
        if (value >= lowest && value <= highest) return {};
        return badInput(std::string("shadow setup: ") + field + " is " + std::to_string(value) + ", expected " +
                        std::to_string(lowest) + " to " + std::to_string(highest));
    };
    const int largest = device.capabilities().maxTextureSize;
    SHOAL_TRY(inRange("sunResolution", setup.sunResolution, 64, largest));
    SHOAL_TRY(inRange("spotResolution", setup.spotResolution, 64, largest));
    SHOAL_TRY(inRange("cascadeCount", setup.cascadeCount, 1, SHOAL_MAX_CASCADES));
    SHOAL_TRY(inRange("maxSpots", setup.maxSpots, 0, SHOAL_MAX_SPOT_SHADOWS));
    return {};
}

Result<void> makeSlots(gl::Device& device, const gl::Texture& depth, int count, const char* label,
                       std::vector<State::Slot>& slots) {
    for (int i = 0; i < count; ++i) {
        State::Slot slot;
        const gl::Framebuffer::Attachment attachment{depth.view(), 0, i};
        SHOAL_TRY_ASSIGN(slot.framebuffer, gl::Framebuffer::create(device, {}, attachment, label));
        slots.push_back(std::move(slot));
    }
    return {};
}

gl::Texture makeDepth(gl::Device& device, int resolution, int layers, const char* label) {
    gl::TextureDesc desc;
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.format = GL_DEPTH_COMPONENT32F;
    desc.width = desc.height = resolution;
    desc.layers = std::max(layers, 1);
    desc.label = label;
    gl::Texture texture = gl::Texture::create(device, desc);
    const float nothing = 0;  // reversed z: as far away as can be
    texture.clear(GL_DEPTH_COMPONENT, GL_FLOAT, &nothing);
    return texture;
}

// Beyond a map's edge is light: the border's depth is 0, behind everything.
gl::Sampler makeSampler(gl::Device& device, bool compare) {
    const gl::Enum filter = compare ? GL_LINEAR : GL_NEAREST;
    gl::Sampler sampler =
        gl::Sampler::create(device, filter, filter, GL_CLAMP_TO_BORDER, GL_CLAMP_TO_BORDER, 1, compare);
    const float border[4] = {0, 0, 0, 0};
    glSamplerParameterfv(sampler.name(), GL_TEXTURE_BORDER_COLOR, border);
    if (compare) glSamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
    return sampler;
}

NeededView neededView(State::Slot& slot, NeededView::Purpose purpose, const light::View& view, const gl::Texture& depth,
                      int layer) {
    NeededView needed;
    needed.purpose = purpose;
    needed.view = view;
    needed.depth = depth.view();
    needed.layer = layer;
    needed.framebuffer = slot.framebuffer.name();
    const Mat4 clipFromWorld = view.clipFromWorld();
    needed.unchanged = slot.asked && slot.clipFromWorld == clipFromWorld;
    slot.clipFromWorld = clipFromWorld;
    slot.asked = true;
    return needed;
}

// params.sunDistance, or as far as the scene reaches: all of it seen from outside, 150 m seen from within. In steps, so
// that a moving eye does not resize the cascades all the time.
float sunDistance(const Context& context, const ShadowParams& params, const Bounds& bounds) {
    if (params.sunDistance > 0) return params.sunDistance;
    constexpr float kFromWithin = 150, kFromOutside = 2.5f;
    const float away = length(bounds.center() - context.view.eye);
    const float wanted = std::min(away + bounds.radius(), std::max(kFromWithin, kFromOutside * away));
    return float(roundedUp(std::max(wanted, 4 * context.view.nearZ)));
}

void prepareSun(State& s, const Context& context, const ShadowParams& params, const light::Sun* sun,
                const Bounds& bounds, ShadowBlock& block) {
    const bool casts = sun && sun->castsShadow && !bounds.empty() && length(sun->toSun) > 0;
    int used = 0;
    if (casts) {
        const CascadeFitSetup setup{s.setup.sunResolution, s.setup.cascadeCount, sunDistance(context, params, bounds),
                                    params.splitBlend};
        const CascadeFit fit = fitCascades(context.view, sun->toSun, bounds, setup);
        constexpr float kNever = 1e30f;  // view depth of cascades that there are not
        float ends[kMaxCascades], fades[kMaxCascades];
        std::fill_n(ends, kMaxCascades, kNever);
        std::fill_n(fades, kMaxCascades, kNever);
        for (; used < fit.count; ++used) {
            const Cascade& c = fit.cascades[used];
            const float scale = 0.5f / c.halfExtent;
            block.cascadePlace[used] = {scale, 0.5f - c.center.x * scale, 0.5f - c.center.y * scale, c.metresPerTexel};
            ends[used] = c.endDepth, fades[used] = c.fadeDepth;
            s.views.push_back(
                neededView(s.sunSlots[std::size_t(used)], NeededView::Purpose::sunShadow, c.view, s.sunDepth, used));
        }
        block.sunFromWorld = fit.sunFromWorld;
        block.cascadeEnd = {ends[0], ends[1], ends[2], ends[3]};
        block.cascadeFade = {fades[0], fades[1], fades[2], fades[3]};
        block.sunShape = {fit.depthRangeM, std::tan(sun->discHalfAngle) * params.softness, params.normalBias,
                          float(fit.count)};
        block.sunMap = {float(s.setup.sunResolution), 1 / float(s.setup.sunResolution), 0, 0};
    }
    for (std::size_t i = std::size_t(used); i < s.sunSlots.size(); ++i) s.sunSlots[i].asked = false;
}

void prepareSpots(State& s, const ShadowParams& params, std::span<const light::PunctualLight> lights,
                  ShadowBlock& block) {
    std::size_t used = 0;
    for (const light::PunctualLight& light : lights) {
        if (used == s.spotSlots.size()) break;
        if (light.kind != light::PunctualLight::Kind::spot || !light.castsShadow) continue;
        const light::View view = spotView(light, s.setup.spotResolution);
        block.spotFromWorld[used] = view.clipFromWorld();
        const float tangent = 1 / view.clipFromView(1, 1);
        block.spotPlace[used] = {light.position.x, light.position.y, light.position.z,
                                 2 * tangent / float(view.height)};
        s.views.push_back(neededView(s.spotSlots[used], NeededView::Purpose::spotShadow, view, s.spotDepth, int(used)));
        ++used;
    }
    block.spotShape = {float(used), 1 / float(s.setup.spotResolution), params.normalBias, 0};
    for (std::size_t i = used; i < s.spotSlots.size(); ++i) s.spotSlots[i].asked = false;
}

}  // namespace

Shadows::Shadows(std::unique_ptr<State> state) : state_(std::move(state)) {}
Shadows::Shadows(Shadows&&) noexcept = default;
Shadows& Shadows::operator=(Shadows&&) noexcept = default;
Shadows::~Shadows() = default;

Result<Shadows> Shadows::create(gl::Device& device, const ShadowSetup& setup) {
    SHOAL_TRY(checkSetup(device, setup));
    auto state = std::make_unique<State>();
    state->device = &device;
    state->setup = setup;
    state->sunDepth = makeDepth(device, setup.sunResolution, setup.cascadeCount, "sun shadow depth");
    state->spotDepth =
        makeDepth(device, setup.maxSpots > 0 ? setup.spotResolution : 1, setup.maxSpots, "spot shadow depth");
    SHOAL_TRY(makeSlots(device, state->sunDepth, setup.cascadeCount, "sun shadow", state->sunSlots));
    SHOAL_TRY(makeSlots(device, state->spotDepth, setup.maxSpots, "spot shadow", state->spotSlots));
    state->plain = makeSampler(device, false);
    state->compared = makeSampler(device, true);
    state->block = gl::BlockBuffer<ShadowBlock>::create(device, "shadow block");
    state->block.write(ShadowBlock{});
    state->views.reserve(std::size_t(setup.cascadeCount + setup.maxSpots));
    return Shadows(std::move(state));
}

void Shadows::prepare(const Context& context, const ShadowParams& params, const light::Sun* sun,
                      std::span<const light::PunctualLight> lights, const Bounds& sceneBounds) {
    State& s = *state_;
    s.views.clear();
    ShadowBlock block{};
    prepareSun(s, context, params, sun, sceneBounds, block);
    prepareSpots(s, params, lights, block);
    s.block.write(block);
}

std::span<NeededView> Shadows::neededViews() { return state_->views; }

void Shadows::bind() const {
    const State& s = *state_;
    s.block.bindUniform(SHOAL_BLOCK_SHADOW);
    gl::bindTexture(SHOAL_UNIT_SUN_SHADOW, s.sunDepth.view());
    s.plain.bind(SHOAL_UNIT_SUN_SHADOW);
    gl::bindTexture(SHOAL_UNIT_SUN_SHADOW_CMP, s.sunDepth.view());
    s.compared.bind(SHOAL_UNIT_SUN_SHADOW_CMP);
    gl::bindTexture(SHOAL_UNIT_SPOT_SHADOW, s.spotDepth.view());
    s.compared.bind(SHOAL_UNIT_SPOT_SHADOW);
}

}  // namespace shoal::frame
