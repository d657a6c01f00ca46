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

// What photons are traced from.
enum PhotonKind { kOpenSun, kShadedSun, kLamp };

// Whether crests can shade the waves behind them: the sun stands lower than the steepest slope.
bool shadedAbove(const Body& body, const light::Sun& sun) {
    const Vec3 toSun = normalize(sun.toSun);
    return toSun.y <= float(body.waves ? body.waves->bounds().slope : 0) * std::hypot(toSun.x, toSun.z);
}

// 0: there are none, 1: some, 2: some in the water that cast shadows.
int lampsOf(const Body& body, const BodyLights& lights) {
    int found = lights.punctual.empty() ? 0 : 1;
    for (const light::PunctualLight& lamp : lights.punctual)
        if (lamp.position.y < body.params.level && lamp.kind == light::PunctualLight::Kind::spot && lamp.castsShadow)
            found = 2;
    return found;
}

// A small pixel's middle falls on the corner of four full pixels where it is an even number of them wide: the upper
// right one is marched.
float marchedOffset(float pixels) {
    const float whole = std::round(pixels);
    return std::abs(pixels - whole) < 1e-3f && std::fmod(whole, 2.0f) == 0 ? 0.5f : 0.0f;
}

// Cells of slot i along an axis that touch the water's area.
struct CellRange {
    int first = 0, end = 0;
    int count() const { return end - first; }
};
CellRange cellsOf(const ShaftPlan& plan, float origin, int i, float areaMin, float areaMax) {
    const double cellM = double(plan.side) / (double(plan.block.slots[i].z) * plan.cells), most = plan.cells;
    const auto at = [&](float x) { return (double(x) - double(origin)) / cellM; };
    CellRange range;
    range.first = int(std::clamp(std::floor(at(areaMin)), 0.0, most));
    range.end = std::max(int(std::clamp(std::ceil(at(areaMax)), 0.0, most)), range.first);
    return range;
}

}  // namespace

struct Shafts::State {
    State(gl::Device& d, const ShaftSetup& s) : device(d), setup(s) {}

    gl::Device& device;
    ShaftSetup setup;
    // [Fournier-Forand][the sun; the sun where waves or things above the water may shade it; a lamp][kinds of waves
    // that are left out]
    const gl::Program* photons[2][3][4] = {};
    const gl::Program* march[2][2][3] = {};  // [Fournier-Forand][paths given][lamps: none, some, some with shadows]
    const gl::Program* upsample[2] = {};     // [paths given]
    const gl::Program* blur[2] = {};         // [axis]
    const gl::Program* openCells = nullptr;
    gl::BlockBuffer<ShaftBlock> block;
    gl::BlockBuffer<WaterBlock> water;
    gl::Texture slices;            // R32UI array, see shaft_slices.io.glsl
    gl::Texture open;              // R32F array, a layer a slot of the sun (shaft_open.comp)
    gl::Texture sources, blurred;  // RGBA32F, small
    ShaftPlan plan;
    std::int64_t photonCount = 0;

    bool failed = false;  // a program did not build; `problem` says why
    std::string problem;

    const gl::Program* get(const gl::Program*& kept, const char* name, const Defines& defines);
    const gl::Program* photonProgram(bool fournierForand, int kind, const Defines& waves);
    const gl::Program* marchProgram(bool fournierForand, bool bent, int lamps);
    Result<void> makePrograms();
    bool reserveSlices(int side, int layers);
    bool resizeTargets(int width, int height);
};

const gl::Program* Shafts::State::get(const gl::Program*& kept, const char* name, const Defines& defines) {
    if (kept || failed) return kept;
    gl::ProgramDesc desc{{name}, defines, name};
    for (const auto& define : defines) desc.label += " " + define.first;
    const auto made = device.programs().get(desc);
    if (made) return kept = *made;
    failed = true;
    problem = made.error().message;
    device.log(LogLevel::error, "water: " + problem);
    return nullptr;
}

const gl::Program* Shafts::State::photonProgram(bool fournierForand, int kind, const Defines& waves) {
    Defines defines = waves;
    std::size_t lacks = 0;
    for (const auto& define : waves) lacks |= define.first == "SHOAL_WAVES_NO_TILES" ? 1 : 2;
    if (fournierForand) defines.emplace_back("FOURNIER_FORAND", "1");
    if (kind < kLamp) defines.emplace_back("NO_LAMPS", "1");
    if (kind == kOpenSun) defines.emplace_back("NO_WAVE_SHADOWS", "1"), defines.emplace_back("NO_AIR", "1");
    return get(photons[fournierForand][kind][lacks], "water/shaft_photons.comp", defines);
}

const gl::Program* Shafts::State::marchProgram(bool fournierForand, bool bent, int lamps) {
    Defines defines;
    if (fournierForand) defines.emplace_back("FOURNIER_FORAND", "1");
    if (bent) defines.emplace_back("PATHS", "1");
    if (lamps > 0) defines.emplace_back("LAMPS", "1");
    if (lamps > 1) defines.emplace_back("LAMP_SHADOWS", "1");
    return get(march[fournierForand][bent][lamps], "water/shaft_march.comp", defines);
}

// Those that the usual scene needs; others are built when first asked for.
Result<void> Shafts::State::makePrograms() {
    for (int i = 0; i < 2; ++i) {
        get(upsample[i], "water/shaft_upsample.comp", i ? Defines{{"PATHS", "1"}} : Defines{});
        get(blur[i], "water/shaft_blur.comp", {{"AXIS", std::to_string(i)}});
        photonProgram(false, i, {});
        marchProgram(false, i, 0);
    }
    get(openCells, "water/shaft_open.comp", {});
    if (failed) return internalError(problem);
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
    gl::TextureDesc desc;
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.format = GL_R32F;
    desc.width = desc.height = SHOAL_SHAFT_OPEN_CELLS;
    desc.layers = SHOAL_SUN_SHAFT_SLOTS;
    desc.label = "shafts, share of the sun";
    state->open = gl::Texture::create(device, desc);
    if (!state->open) return internalError("no memory for light shafts");
    state->block = gl::BlockBuffer<ShaftBlock>::create(device, "shafts");
    state->water = gl::BlockBuffer<WaterBlock>::create(device, "shafts' water");
    return Shafts(std::move(state));
}

void Shafts::render(const frame::Context& context, const ShaftParams& params, const Body& body,
                    const BodyLights& lights, const LightViews& views) {
    State& s = *state_;
    s.plan = makeShaftPlan(s.setup, params, body, views.slots(), context);
    s.photonCount = 0;
    const int sunSlots = lights.sun ? s.plan.sunSlots : 0, lampSlots = s.plan.lampSlots;
    if (!params.enabled || !scatters(body) || sunSlots + lampSlots == 0) return;
    SHOAL_ASSERT(body.gpuWaves);
    const gl::PassScope pass(context.timer, "shaft photons");
    const bool fournierForand = body.optics.phase == Optics::Phase::fournierForand;
    const bool shaded = sunSlots > 0 && (shadedAbove(body, *lights.sun) || views.airDrawn());
    const Defines waves = body.waves ? waveDefines(*body.waves) : Defines{};
    const gl::Program* fromSun =
        sunSlots ? s.photonProgram(fournierForand, shaded ? kShadedSun : kOpenSun, waves) : nullptr;
    const gl::Program* fromLamps = lampSlots ? s.photonProgram(fournierForand, kLamp, waves) : nullptr;
    const int used = lampSlots ? SHOAL_SUN_SHAFT_SLOTS + lampSlots : sunSlots;
    if (s.failed || !s.reserveSlices(s.plan.side, used * s.setup.slices)) {
        for (Vec4& rim : s.plan.block.rims) rim.x = -1;
        s.plan.block.grid.w = 0;
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
    const auto trace = [&](const gl::Program& program, int first, int count) {
        for (int i = first; i < first + count; ++i) {
            program.set(0, i);
            program.set(1, int(s.plan.block.slots[i].w));
            const CellRange x =
                cellsOf(s.plan, s.plan.block.slots[i].x, i, body.params.areaMin.x, body.params.areaMax.x);
            const CellRange z =
                cellsOf(s.plan, s.plan.block.slots[i].y, i, body.params.areaMin.y, body.params.areaMax.y);
            if (x.count() == 0 || z.count() == 0) continue;
            glProgramUniform4i(program.name(), 2, x.first, z.first, x.end, z.end);
            program.dispatch(x.count(), z.count());
            s.photonCount += std::int64_t(x.count()) * z.count();
        }
    };
    if (fromSun) trace(*fromSun, 0, sunSlots);
    if (fromLamps) trace(*fromLamps, SHOAL_SUN_SHAFT_SLOTS, lampSlots);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    if (sunSlots == 0) return;
    bindInput(SHOAL_UNIT_SHAFT_SLICES, s.slices);
    gl::bindImage(0, s.open, GL_WRITE_ONLY);
    s.openCells->dispatch(SHOAL_SHAFT_OPEN_CELLS, SHOAL_SHAFT_OPEN_CELLS, sunSlots);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void Shafts::march(const frame::Context& context, const ShaftParams& params, const Body& body, const BodyLights& lights,
                   const LightViews& views, const WaterPaths& paths, gl::TextureView viewDepth,
                   const ShaftOutputs& outputs) {
    State& s = *state_;
    if (!params.enabled || !scatters(body)) {
        const float nothing[4] = {0, 0, 0, 0};
        glClearTexImage(outputs.inscatter.name, 0, GL_RGBA, GL_FLOAT, nothing);
        return;
    }
    const float scale = std::clamp(params.resolutionScale, 0.1f, 1.0f);
    const int fullWidth = outputs.inscatter.width, fullHeight = outputs.inscatter.height;
    const int width = std::max(int(std::ceil(float(fullWidth) * scale)), 1),
              height = std::max(int(std::ceil(float(fullHeight) * scale)), 1);
    const bool bent = bool(paths.path);
    const gl::Program* program =
        s.marchProgram(body.optics.phase == Optics::Phase::fournierForand, bent, lampsOf(body, lights));
    if (!program || !s.resizeTargets(width, height) || !s.reserveSlices(std::max(s.plan.side, 1), 1)) return;

    const double sample = double(context.sampleIndex);
    s.plan.block.march = {float(std::clamp((params.steps + 3) / 4, 1, 256)), 1 / scale,
                          float(std::fmod(sample * 0.6180339887, 1)), float(std::fmod(sample * 512 * 17, 65536))};
    s.plan.block.small.x = marchedOffset(1 / scale);
    s.block.write(s.plan.block);
    s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
    s.water.write(makeWaterBlock(body, lights));
    s.water.bindUniform(SHOAL_BLOCK_WATER);
    bindInput(SHOAL_UNIT_SHAFT_SLICES, s.slices);
    views.bind();
    bindInput(SHOAL_UNIT_PASS, viewDepth);
    bindInput(SHOAL_UNIT_PASS + 1, s.open);
    if (bent) {
        bindInput(SHOAL_UNIT_WATER_SURFACE, paths.surfaceDepth);
        bindInput(SHOAL_UNIT_WATER_NORMAL, paths.surfaceNormal);
        bindInput(SHOAL_UNIT_WATER_PATH, paths.path);
    }
    {
        const gl::PassScope pass(context.timer, "shaft march");
        s.sources.bindImage(0, GL_WRITE_ONLY);
        program->dispatch(width, height);
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
    s.upsample[bent]->dispatch((fullWidth + 1) / 2, (fullHeight + 1) / 2);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

frame::Stats Shafts::stats() const {
    const State& s = *state_;
    frame::Stats stats;
    const auto texels = [](const gl::Texture& t) { return std::int64_t(t.width()) * t.height() * t.view().layers; };
    stats.bytes = 4 * (texels(s.slices) + texels(s.open)) + 16 * (texels(s.sources) + texels(s.blurred));
    stats.counts = {{"shaft photons", s.photonCount}};
    return stats;
}

}  // namespace shoal::water
