#include <shoal/water/shafts.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include <shoal/water/gpu_waves.h>

#include "frame/bindings.shared.h"
#include "frame/fullscreen.h"
#include "water/bindings.shared.h"
#include "water/shafts/shaft_block.h"
#include "water/surface/water_block.h"

namespace shoal::water {
namespace {

using Defines = std::vector<std::pair<std::string, std::string>>;

bool scatters(const Body& body) {
    const Vec3 b = body.optics.beamScattering();
    return std::max({b.x, b.y, b.z}) > 0;
}

void bindInput(int unit, const gl::TextureView& texture) {
    gl::bindTexture(unit, texture);
    glBindSampler(GLuint(unit), 0);
}

// Whether crests can shade the waves behind them: the sun stands lower than the steepest slope.
bool shadedAbove(const Body& body, const light::Sun& sun) {
    const Vec3 toSun = normalize(sun.toSun);
    return toSun.y <= float(body.waves ? body.waves->bounds().slope : 0) * std::hypot(toSun.x, toSun.z);
}

// A small pixel's middle falls on the corner of four full pixels where it is an even number of them wide: the upper
// right one is marched.
float marchedOffset(float pixels) {
    const float whole = std::round(pixels);
    return std::abs(pixels - whole) < 1e-3f && std::fmod(whole, 2.0f) == 0 ? 0.5f : 0.0f;
}

}  // namespace

struct Shafts::State {
    State(gl::Device& d, const ShaftSetup& s) : device(d), setup(s) {}

    gl::Device& device;
    ShaftSetup setup;
    const gl::Program* photons[2][2] = {};  // [Fournier-Forand][waves may shade each other, or things above the water]
    const gl::Program* march[2][2] = {};    // [Fournier-Forand][paths given]
    const gl::Program* upsample[2] = {};    // [paths given]
    const gl::Program* blur[2] = {};        // [axis]
    gl::BlockBuffer<ShaftBlock> block;
    gl::BlockBuffer<WaterBlock> water;
    gl::Texture slices;            // R32UI array, see shaft_slices.io.glsl
    gl::Texture sources, blurred;  // RGBA32F, small
    ShaftPlan plan;
    std::int64_t photonCount = 0;

    Result<void> makePrograms();
    bool reserveSlices(int side, int layers);
    bool resizeTargets(int width, int height);
};

Result<void> Shafts::State::makePrograms() {
    const auto get = [&](const char* name, Defines defines) {
        gl::ProgramDesc desc{{name}, std::move(defines), name};
        for (const auto& define : desc.defines) desc.label += " " + define.first;
        return device.programs().get(desc);
    };
    for (int i = 0; i < 2; ++i) {
        const Defines paths = i ? Defines{{"PATHS", "1"}} : Defines{};
        SHOAL_TRY_ASSIGN(upsample[i], get("water/shaft_upsample.comp", paths));
        SHOAL_TRY_ASSIGN(blur[i], get("water/shaft_blur.comp", {{"AXIS", std::to_string(i)}}));
        for (int phase = 0; phase < 2; ++phase) {
            Defines marchDefines = paths, trace = {{"NO_LAMPS", "1"}};
            if (phase) marchDefines.emplace_back("FOURNIER_FORAND", "1"), trace.emplace_back("FOURNIER_FORAND", "1");
            if (!i) trace.emplace_back("NO_WAVE_SHADOWS", "1"), trace.emplace_back("NO_AIR", "1");
            SHOAL_TRY_ASSIGN(march[phase][i], get("water/shaft_march.comp", marchDefines));
            SHOAL_TRY_ASSIGN(photons[phase][i], get("water/shaft_photons.comp", trace));
        }
    }
    return {};
}

bool Shafts::State::reserveSlices(int side, int layers) {
    const gl::TextureView have = slices.view();
    if (slices && have.width == side + 2 && have.layers >= layers) return true;
    gl::TextureDesc desc;
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.format = GL_R32UI;
    desc.width = desc.height = side + 2;
    desc.layers = layers;
    desc.label = "shaft slices";
    slices = gl::Texture::create(device, desc);
    if (slices) return true;
    device.log(LogLevel::error, "water: no memory for the slices of light shafts");
    return false;
}

bool Shafts::State::resizeTargets(int width, int height) {
    if (sources && sources.width() == width && sources.height() == height) return true;
    sources = frame::makeTarget(device, GL_RGBA32F, width, height, "shafts, marched");
    blurred = frame::makeTarget(device, GL_RGBA32F, width, height, "shafts, blurred");
    if (sources && blurred) return true;
    device.log(LogLevel::error, "water: no memory for marching light shafts");
    return false;
}

Shafts::Shafts(std::unique_ptr<State> state) : state_(std::move(state)) {}
Shafts::Shafts(Shafts&&) noexcept = default;
Shafts& Shafts::operator=(Shafts&&) noexcept = default;
Shafts::~Shafts() = default;

Result<Shafts> Shafts::create(gl::Device& device, const ShaftSetup& setup) {
    if (setup.resolution < 16 || setup.resolution > 1024 || setup.slices < 2 || setup.slices > 64)
        return badInput("shafts: " + std::to_string(setup.slices) + " slices of " + std::to_string(setup.resolution) +
                        " texels a side, expected 2 to 64 of 16 to 1024");
    frame::registerFrameShaders();
    registerWaterShaders();
    auto state = std::make_unique<State>(device, setup);
    SHOAL_TRY(state->makePrograms());
    state->block = gl::BlockBuffer<ShaftBlock>::create(device, "shafts");
    state->water = gl::BlockBuffer<WaterBlock>::create(device, "shafts' water");
    return Shafts(std::move(state));
}

void Shafts::render(const frame::Context& context, const ShaftParams& params, const Body& body,
                    const BodyLights& lights, const LightViews& views) {
    State& s = *state_;
    s.plan = makeShaftPlan(s.setup, params, body, views.slots(), context);
    s.photonCount = 0;
    const int slots = s.plan.sunSlots;
    if (!params.enabled || !scatters(body) || !lights.sun || slots == 0) return;
    SHOAL_ASSERT(body.gpuWaves);
    const gl::PassScope pass(context.timer, "shaft photons");
    if (!s.reserveSlices(s.plan.side, slots * s.setup.slices)) {
        for (Vec4& rim : s.plan.block.rims) rim.x = -1;
        return;
    }
    const GLuint nothing = 0;
    s.slices.clear(GL_RED_INTEGER, GL_UNSIGNED_INT, &nothing);
    s.block.write(s.plan.block);
    s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
    s.water.write(makeWaterBlock(body, lights));
    s.water.bindUniform(SHOAL_BLOCK_WATER);
    body.gpuWaves->bind();
    views.bind();
    gl::bindImage(0, s.slices, GL_READ_WRITE);
    s.photonCount = std::int64_t(s.plan.cells) * s.plan.cells * slots;
    const bool fournierForand = body.optics.phase == Optics::Phase::fournierForand;
    const gl::Program& program = *s.photons[fournierForand][shadedAbove(body, *lights.sun) || views.airDrawn()];
    program.set(0, 0);
    program.dispatch(s.plan.cells, s.plan.cells, slots);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void Shafts::march(const frame::Context& context, const ShaftParams& params, const Body& body, const BodyLights& lights,
                   const LightViews& views, const WaterPaths& paths, gl::TextureView viewDepth,
                   const ShaftOutputs& outputs) {
    State& s = *state_;
    (void)views;
    if (!params.enabled || !scatters(body)) {
        const float nothing[4] = {0, 0, 0, 0};
        glClearTexImage(outputs.inscatter.name, 0, GL_RGBA, GL_FLOAT, nothing);
        return;
    }
    const float scale = std::clamp(params.resolutionScale, 0.1f, 1.0f);
    const int fullWidth = outputs.inscatter.width, fullHeight = outputs.inscatter.height;
    const int width = std::max(int(std::ceil(float(fullWidth) * scale)), 1),
              height = std::max(int(std::ceil(float(fullHeight) * scale)), 1);
    if (!s.resizeTargets(width, height) || !s.reserveSlices(std::max(s.plan.side, 1), 1)) return;

    const double sample = double(context.sampleIndex);
    s.plan.block.march = {float(std::clamp((params.steps + 3) / 4, 1, 256)), 1 / scale,
                          float(std::fmod(sample * 0.6180339887, 1)), float(std::fmod(sample * 512 * 17, 65536))};
    s.plan.block.small = {marchedOffset(1 / scale), 0, 0, 0};
    s.block.write(s.plan.block);
    s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
    s.water.write(makeWaterBlock(body, lights));
    s.water.bindUniform(SHOAL_BLOCK_WATER);
    bindInput(SHOAL_UNIT_SHAFT_SLICES, s.slices);
    bindInput(SHOAL_UNIT_PASS, viewDepth);
    const bool bent = bool(paths.path);
    if (bent) {
        bindInput(SHOAL_UNIT_WATER_SURFACE, paths.surfaceDepth);
        bindInput(SHOAL_UNIT_WATER_NORMAL, paths.surfaceNormal);
        bindInput(SHOAL_UNIT_WATER_PATH, paths.path);
    }
    {
        const gl::PassScope pass(context.timer, "shaft march");
        s.sources.bindImage(0, GL_WRITE_ONLY);
        s.march[body.optics.phase == Optics::Phase::fournierForand][bent]->dispatch(width, height);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    {
        const gl::PassScope pass(context.timer, "shaft blur");
        for (int axis = 0; axis < 2; ++axis) {
            bindInput(SHOAL_UNIT_PASS + 1, axis ? s.blurred : s.sources);
            (axis ? s.sources : s.blurred).bindImage(0, GL_WRITE_ONLY);
            s.blur[axis]->dispatch(width, height);
            glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
        }
    }
    const gl::PassScope pass(context.timer, "shaft upsample");
    bindInput(SHOAL_UNIT_PASS + 1, s.sources);
    gl::bindImage(0, outputs.inscatter, GL_WRITE_ONLY);
    s.upsample[bent]->dispatch(fullWidth, fullHeight);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

frame::Stats Shafts::stats() const {
    const State& s = *state_;
    frame::Stats stats;
    const auto texels = [](const gl::Texture& t) { return std::int64_t(t.width()) * t.height() * t.view().layers; };
    stats.bytes = 4 * texels(s.slices) + 16 * (texels(s.sources) + texels(s.blurred));
    stats.counts = {{"shaft photons", s.photonCount}};
    return stats;
}

}  // namespace shoal::water
