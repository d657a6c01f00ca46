// Deferred light on surfaces and what is behind them. Reads the G-buffer, writes Targets::radiance().
#include <shoal/frame/lighting.h>

#include <epoxy/gl.h>

#include <algorithm>

#include "frame/ambient_occlusion.h"
#include "frame/bindings.shared.h"
#include "frame/environment_map.h"
#include "frame/fullscreen.h"
#include "frame/light_block.h"

namespace shoal::frame {
namespace {

constexpr std::size_t kFirstLights = 64;  // room made at creation; more lights grow it

// With fewer texels of the environment a pixel than this the background is interpolated smoothly.
constexpr float kTexelsPerPixelOfSmooth = 0.75f;

// What shade.frag is compiled for.
enum Variant { kNoSun = 1, kNoLocalLights = 2, kSunOverride = 4, kTerms = 8, kEnvironmentOverride = 16 };
constexpr int kShadeVariants = 32;

Result<const gl::Program*> shadeProgram(gl::Device& device, int variant) {
    static constexpr const char* kNames[] = {"NO_SUN", "NO_LOCAL_LIGHTS", "SUN_OVERRIDE", "TERMS",
                                             "ENVIRONMENT_OVERRIDE"};
    return fullscreenProgram(device, "frame/shade.frag", definesOf(variant, kNames));
}

}  // namespace

struct Lighting::State {
    explicit State(gl::Device& d) : device(d) {}

    gl::Device& device;
    Fullscreen fullscreen;
    const gl::Program* shade[kShadeVariants] = {};  // by a sum of Variant; rare ones are built when first asked for
    const gl::Program *background = nullptr, *smoothBackground = nullptr, *plainBackground = nullptr;
    AmbientOcclusion occlusion;
    EnvironmentMap environment;
    gl::BlockBuffer<LightBlock> block;
    gl::Buffer localLights;
    std::vector<LocalLight> localScratch;
    gl::Texture open;  // 1 x 1, for forward passes without occlusion
    bool occlusionOn = false;
    const gl::Program* behind = nullptr;  // the background's program, chosen by prepare()
    int variant = 0;                      // of what prepare() was given

    bool termsWanted = false;
    gl::Texture direct, shadow;
    gl::Framebuffer withTerms;
    std::uint32_t radianceName = 0;

    Result<void> makePrograms();
    Result<void> makeBuffers();
    void bindLight() const;
    void resizeTerms(const Targets& targets);
    const gl::Program& shadeVariant(int wanted);
};

Result<void> Lighting::State::makePrograms() {
    for (const int v : {0, int(kNoSun), int(kNoLocalLights), kNoSun | kNoLocalLights}) {
        SHOAL_TRY_ASSIGN(shade[v], shadeProgram(device, v));
    }
    SHOAL_TRY_ASSIGN(background, fullscreenProgram(device, "frame/background.frag"));
    SHOAL_TRY_ASSIGN(smoothBackground, fullscreenProgram(device, "frame/background.frag", {{"SMOOTH", "1"}}));
    SHOAL_TRY_ASSIGN(plainBackground, fullscreenProgram(device, "frame/background.frag", {{"COLOR", "1"}}));
    return {};
}

Result<void> Lighting::State::makeBuffers() {
    block = gl::BlockBuffer<LightBlock>::create(device, "light block");
    localLights = gl::Buffer::create(device, kFirstLights * sizeof(LocalLight), "local lights");
    open = makeTarget(device, GL_R8, 1, 1, "no occlusion");
    if (!localLights || !open) return internalError("no memory for lighting");
    const float one[4] = {1, 1, 1, 1};
    open.clear(GL_RED, GL_FLOAT, one);
    return {};
}

void Lighting::State::bindLight() const {
    block.bindUniform(SHOAL_BLOCK_LIGHT);
    localLights.bindStorage(SHOAL_STORAGE_LIGHTS);
    gl::bindTexture(SHOAL_UNIT_ENVIRONMENT, environment.sharp);
    gl::bindTexture(SHOAL_UNIT_SPECULAR, environment.prefiltered);
    gl::bindTexture(SHOAL_UNIT_AO, occlusionOn ? occlusion.result() : open.view());
    for (const int unit : {SHOAL_UNIT_ENVIRONMENT, SHOAL_UNIT_SPECULAR, SHOAL_UNIT_AO}) glBindSampler(GLuint(unit), 0);
}

void Lighting::State::resizeTerms(const Targets& targets) {
    const int width = targets.gbuffer().width, height = targets.gbuffer().height;
    if (withTerms && direct.width() == width && direct.height() == height && radianceName == targets.radiance().name)
        return;
    direct = makeTarget(device, GL_RGBA16F, width, height, "direct");
    shadow = makeTarget(device, GL_R8, width, height, "shadow");
    if (!direct || !shadow) return;
    const gl::Framebuffer::Attachment colors[] = {{targets.radiance()}, {direct.view()}, {shadow.view()}};
    auto framebuffer = gl::Framebuffer::create(device, colors, {targets.gbuffer().depth}, "radiance and terms");
    if (!framebuffer) {
        device.log(LogLevel::error, framebuffer.error().message);
        return;
    }
    withTerms = std::move(*framebuffer);
    radianceName = targets.radiance().name;
}

const gl::Program& Lighting::State::shadeVariant(int wanted) {
    if (!shade[wanted]) {
        auto made = shadeProgram(device, wanted);
        if (!made) device.log(LogLevel::error, made.error().message);
        shade[wanted] = made ? *made : shade[wanted & (kNoSun | kNoLocalLights)];
    }
    return *shade[wanted];
}

Lighting::Lighting(std::unique_ptr<State> state) : state_(std::move(state)) {}
Lighting::Lighting(Lighting&&) noexcept = default;
Lighting& Lighting::operator=(Lighting&&) noexcept = default;
Lighting::~Lighting() = default;

Result<Lighting> Lighting::create(gl::Device& device) {
    registerFrameShaders();
    auto state = std::make_unique<State>(device);
    state->fullscreen = Fullscreen::create(device);
    SHOAL_TRY(state->makePrograms());
    SHOAL_TRY(state->makeBuffers());
    SHOAL_TRY_ASSIGN(state->occlusion, AmbientOcclusion::create(device));
    light::Environment black;
    black.radiance = Image(2, 1, 3);
    SHOAL_TRY_ASSIGN(state->environment, uploadEnvironment(device, black));
    return Lighting(std::move(state));
}

Result<void> Lighting::setEnvironment(const light::Environment& environment) {
    SHOAL_TRY_ASSIGN(state_->environment, uploadEnvironment(state_->device, environment));
    return {};
}

void Lighting::prepare(const Context& context, const LightingParams& params, const Lights& lights,
                       const Targets& targets) {
    State& s = *state_;
    s.occlusionOn = params.ambientOcclusion;
    s.variant = (lights.sun ? 0 : kNoSun) | (lights.punctual.empty() ? kNoLocalLights : 0);
    const LightBlock block = makeLightBlock(context, params, lights, s.environment.shape);
    s.block.write(block);
    const bool magnified = block.backgroundLevel.z < kTexelsPerPixelOfSmooth;
    s.behind = params.background != "environment" ? s.plainBackground : magnified ? s.smoothBackground : s.background;
    makeLocalLights(lights.punctual, s.localScratch);
    const std::size_t bytes = s.localScratch.size() * sizeof(LocalLight);
    if (bytes > s.localLights.bytes()) s.localLights = gl::Buffer::create(s.device, bytes * 2, "local lights");
    if (bytes > 0 && s.localLights) s.localLights.writeAll(std::span<const LocalLight>(s.localScratch));
    if (!s.occlusionOn && !s.termsWanted) return;
    const GBuffer& g = targets.gbuffer();
    if (const auto ready = s.occlusion.resize(g.width, g.height, g.depth); !ready) {
        s.device.log(LogLevel::error, ready.error().message);
        s.occlusionOn = false;
        return;
    }
    if (s.occlusionOn)
        s.occlusion.compute(context, params, g, s.fullscreen);
    else
        s.occlusion.clear();
}

void Lighting::shade(const Context& context, const LightingParams&, const Shadows& shadows,
                     const LightOverrides& overrides, const Targets& targets) {
    State& s = *state_;
    SHOAL_ASSERT_MSG(s.behind, "prepare() comes before shade()");
    s.bindLight();
    shadows.bind();
    const GBuffer& g = targets.gbuffer();
    const gl::TextureView inputs[] = {g.albedo, g.normal, g.material, g.emission, g.viewDepth};
    for (int i = 0; i < 5; ++i) {
        gl::bindTexture(SHOAL_UNIT_PASS + i, inputs[i]);
        glBindSampler(GLuint(SHOAL_UNIT_PASS + i), 0);
    }
    int variant = s.variant;
    if (overrides.sunIrradiance) {
        gl::bindTexture(SHOAL_UNIT_SUN_IRRADIANCE, overrides.sunIrradiance);
        glBindSampler(SHOAL_UNIT_SUN_IRRADIANCE, 0);
        variant |= kSunOverride;
    }
    if (overrides.environmentIrradiance) {
        gl::bindTexture(SHOAL_UNIT_ENVIRONMENT_IRRADIANCE, overrides.environmentIrradiance);
        glBindSampler(SHOAL_UNIT_ENVIRONMENT_IRRADIANCE, 0);
        variant |= kEnvironmentOverride;
    }
    if (s.termsWanted) s.resizeTerms(targets);
    const bool terms = s.termsWanted && bool(s.withTerms);
    {
        const gl::PassScope pass(context.timer, "shade");
        if (terms) {
            s.withTerms.bind();
            const float none[4] = {0, 0, 0, 0}, lit[4] = {1, 1, 1, 1};
            glClearNamedFramebufferfv(s.withTerms.name(), GL_COLOR, 1, none);
            glClearNamedFramebufferfv(s.withTerms.name(), GL_COLOR, 2, lit);
        } else {
            targets.forward().bind();
        }
        s.fullscreen.draw(s.shadeVariant(variant | (terms ? kTerms : 0)), Where::surfaces);
    }
    const gl::PassScope pass(context.timer, "background");
    targets.forward().bind();
    s.fullscreen.draw(*s.behind, Where::background);
}

void Lighting::bind() const { state_->bindLight(); }

void Lighting::setTermsWanted(bool wanted) { state_->termsWanted = wanted; }
gl::TextureView Lighting::direct() const { return state_->direct.view(); }
gl::TextureView Lighting::shadow() const { return state_->shadow.view(); }
gl::TextureView Lighting::occlusion() const {
    const State& s = *state_;
    return s.occlusionOn || s.termsWanted ? s.occlusion.result() : s.open.view();
}

}  // namespace shoal::frame
