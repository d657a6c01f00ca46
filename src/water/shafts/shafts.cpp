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
    const gl::Program* photons[2] = {};   // [Fournier-Forand]
    const gl::Program* march[2] = {};     // [paths given]
    const gl::Program* upsample[2] = {};  // [paths given]
    const gl::Program* blur[2] = {};      // [axis]
    gl::BlockBuffer<ShaftBlock> block;
    gl::BlockBuffer<WaterBlock> water;
    gl::Buffer slices;
    gl::Texture ratios, blurred;
    ShaftBlock current{};
    std::int64_t photonCount = 0;

    Result<void> makePrograms();
    bool reserveSlices(std::size_t texels);
    bool resizeTargets(int width, int height);
};

Result<void> Shafts::State::makePrograms() {
    const auto get = [&](const char* name, Defines defines) {
        gl::ProgramDesc desc{{name}, std::move(defines), name};
        for (const auto& define : desc.defines) desc.label += " " + define.first;
        return device.programs().get(desc);
    };
    for (int i = 0; i < 2; ++i) {
        Defines photonDefines = {{"NO_LAMPS", "1"}};
        if (i) photonDefines.emplace_back("FOURNIER_FORAND", "1");
        const Defines paths = i ? Defines{{"PATHS", "1"}} : Defines{};
        SHOAL_TRY_ASSIGN(photons[i], get("water/shaft_photons.comp", photonDefines));
        SHOAL_TRY_ASSIGN(march[i], get("water/shaft_march.comp", paths));
        SHOAL_TRY_ASSIGN(upsample[i], get("water/shaft_upsample.comp", paths));
        SHOAL_TRY_ASSIGN(blur[i], get("water/shaft_blur.comp", {{"AXIS", std::to_string(i)}}));
    }
    return {};
}

bool Shafts::State::reserveSlices(std::size_t texels) {
    const std::size_t bytes = texels * sizeof(std::uint32_t);
    if (slices && slices.bytes() >= bytes) return true;
    slices = gl::Buffer::create(device, bytes, "shaft slices");
    if (slices) return true;
    device.log(LogLevel::error, "water: no memory for the slices of light shafts");
    return false;
}

bool Shafts::State::resizeTargets(int width, int height) {
    if (ratios && ratios.width() == width && ratios.height() == height) return true;
    ratios = frame::makeTarget(device, GL_RGBA16F, width, height, "shafts, marched");
    blurred = frame::makeTarget(device, GL_RGBA16F, width, height, "shafts, blurred");
    if (ratios && blurred) return true;
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
    s.current = makeShaftBlock(s.setup, params, body, views.slots(), context);
    s.photonCount = 0;
    const int slots = int(s.current.grid.w), side = int(s.current.grid.x);
    if (!params.enabled || !scatters(body) || !lights.sun || slots == 0) return;
    SHOAL_ASSERT(body.gpuWaves);
    const gl::PassScope pass(context.timer, "shaft photons");
    if (!s.reserveSlices(sliceTexels(side, s.setup.slices) * std::size_t(slots))) {
        s.current.grid.w = 0;
        return;
    }
    s.slices.clear(0);
    s.block.write(s.current);
    s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
    s.water.write(makeWaterBlock(body, lights));
    s.water.bindUniform(SHOAL_BLOCK_WATER);
    body.gpuWaves->bind();
    views.bind();
    s.slices.bindStorage(SHOAL_STORAGE_WATER);
    const int cells = side * int(s.current.grid.z);
    s.photonCount = std::int64_t(cells) * cells * slots;
    s.photons[body.optics.phase == Optics::Phase::fournierForand]->dispatch(cells, cells, slots);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
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
    if (!s.resizeTargets(width, height) || !s.reserveSlices(1)) return;

    const double sample = double(context.sampleIndex);
    s.current.march = {float(std::clamp(params.steps, 1, 1024)), 1 / scale, float(std::fmod(sample * 0.6180339887, 1)),
                       float(std::fmod(sample * 512 * 17, 65536))};
    s.current.small = {marchedOffset(1 / scale), 0, 0, 0};
    s.block.write(s.current);
    s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
    s.water.write(makeWaterBlock(body, lights));
    s.water.bindUniform(SHOAL_BLOCK_WATER);
    s.slices.bindStorage(SHOAL_STORAGE_WATER);
    bindInput(SHOAL_UNIT_PASS, viewDepth);
    const bool bent = bool(paths.path);
    if (bent) {
        bindInput(SHOAL_UNIT_WATER_SURFACE, paths.surfaceDepth);
        bindInput(SHOAL_UNIT_WATER_NORMAL, paths.surfaceNormal);
        bindInput(SHOAL_UNIT_WATER_PATH, paths.path);
    }
    {
        const gl::PassScope pass(context.timer, "shaft march");
        s.ratios.bindImage(0, GL_WRITE_ONLY);
        s.march[bent]->dispatch(width, height);
        glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    }
    {
        const gl::PassScope pass(context.timer, "shaft blur");
        for (int axis = 0; axis < 2; ++axis) {
            bindInput(SHOAL_UNIT_PASS + 1, axis ? s.blurred : s.ratios);
            (axis ? s.ratios : s.blurred).bindImage(0, GL_WRITE_ONLY);
            s.blur[axis]->dispatch(width, height);
            glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
        }
    }
    const gl::PassScope pass(context.timer, "shaft upsample");
    bindInput(SHOAL_UNIT_PASS + 1, s.ratios);
    gl::bindImage(0, outputs.inscatter, GL_WRITE_ONLY);
    s.upsample[bent]->dispatch(fullWidth, fullHeight);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

frame::Stats Shafts::stats() const {
    const State& s = *state_;
    frame::Stats stats;
    const auto textureBytes = [](const gl::Texture& t) { return std::int64_t(t.width()) * t.height() * 8; };
    stats.bytes = std::int64_t(s.slices.bytes()) + textureBytes(s.ratios) + textureBytes(s.blurred);
    stats.counts = {{"shaft photons", s.photonCount}};
    return stats;
}

}  // namespace shoal::water
