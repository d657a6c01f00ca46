// [Papadopoulos & Papaioannou 2010] trace photons through the water's surface into the picture as points of a fixed
// size; here each is laid over its own footprint (photon_deposit.comp) in maps that stand still in the world.
#include <shoal/water/photons.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include <shoal/gl/program.h>
#include <shoal/water/gpu_waves.h>

#include "frame/fullscreen.h"
#include "water/bindings.shared.h"
#include "water/caustic.shared.h"
#include "water/photons/emission.h"
#include "water/surface/water_block.h"

namespace shoal::water {

struct Photons::State {
    // What photon.io.glsl leaves out.
    enum Variant { kPlain, kAir, kLowSun, kLamp, kVariants };
    gl::Device* device = nullptr;
    PhotonSetup setup;
    const gl::Program* deposit[kVariants] = {};
    const gl::Program *resolve = nullptr, *mips = nullptr;
    const gl::Program* lookup[2] = {};  // without normals, with
    gl::Buffer deposits;                // of one slot at a time
    gl::Texture maps;
    int mipLevels = 1;
    gl::BlockBuffer<WaterBlock> waterBlock;
    gl::BlockBuffer<CausticBlock> causticBlock;
    bool sunHasSlot = false;
    std::int64_t photonCount = 0;
};

namespace {

using State = Photons::State;

constexpr int kMostMipLevels = 4;  // squares begin at multiples of 8 texels
constexpr double kReflectedShare = 0.25;

Result<void> makePrograms(gl::Device& device, State& s) {
    const std::vector<std::pair<std::string, std::string>> variants[State::kVariants] = {
        {{"NO_LAMPS", ""}, {"NO_WAVE_SHADOWS", ""}, {"NO_AIR", ""}},
        {{"NO_LAMPS", ""}, {"NO_WAVE_SHADOWS", ""}},
        {{"NO_LAMPS", ""}},
        {},
    };
    for (int i = 0; i < State::kVariants; ++i) {
        SHOAL_TRY_ASSIGN(s.deposit[i],
                         device.programs().get({{"water/photon_deposit.comp"}, variants[i], "photon deposit"}));
    }
    SHOAL_TRY_ASSIGN(s.resolve, device.programs().get({{"water/caustic_resolve.comp"}, {}, "caustic resolve"}));
    SHOAL_TRY_ASSIGN(s.mips, device.programs().get({{"water/caustic_mips.comp"}, {}, "caustic mips"}));
    SHOAL_TRY_ASSIGN(s.lookup[0],
                     device.programs().get({{"water/caustic_lookup.comp"}, {{"NO_NORMALS", ""}}, "caustic lookup"}));
    SHOAL_TRY_ASSIGN(s.lookup[1], device.programs().get({{"water/caustic_lookup.comp"}, {}, "caustic lookup"}));
    return {};
}

// Photons of a slot: a light's photons are shared by its cascades; what the surface reflects is fainter.
int photonsOf(const LightSlot& slot, std::span<const LightSlot> slots, int photons) {
    int sharing = 0;
    for (const LightSlot& other : slots)
        if (other.light == slot.light && other.reflected == slot.reflected) ++sharing;
    return std::max(int(double(photons) * (slot.reflected ? kReflectedShare : 1) / std::max(sharing, 1)), 64);
}

State::Variant variantOf(const LightSlot& slot, const Body& body, const BodyLights& lights, bool air) {
    if (slot.light >= 0) return State::kLamp;
    const Vec3 toSun = normalize(lights.sun->toSun);
    const double rise = double(toSun.y) / std::max(double(std::hypot(toSun.x, toSun.z)), 1e-6);
    const double slope = body.waves ? body.waves->bounds().slope : 0;
    if (slope > rise) return State::kLowSun;
    return air ? State::kAir : State::kPlain;
}

void depositSlot(State& s, const frame::Context& context, int index, const LightSlot& slot, int photons,
                 State::Variant variant, double slope, int fine) {
    const gl::PassScope pass(context.timer, "caustic photons");
    const EmissionLattice lattice = emissionLattice(slot, s.setup.resolution, photons);
    const double texelsPerM = fine / double(slot.texel), cellTexels = double(lattice.cellM) * texelsPerM;
    const int side = s.setup.resolution * fine;
    const double mostFlux = slot.light >= 0 ? 4 : std::min(4.0, std::sqrt(1 + slope * slope));
    // All of the slot's flux in one texel still fits, with room for the rounding of each photon.
    const double most = double(lattice.countX) * double(lattice.countZ) * (cellTexels * cellTexels * mostFlux);
    const double units = std::exp2(std::floor(std::log2(0.98 * 4294967296.0 / most)));

    const GLuint zero = 0;
    glClearNamedBufferSubData(s.deposits.name(), GL_R32UI, 0,
                              GLsizeiptr(sizeof(GLuint)) * (2 * GLsizeiptr(side) * side + 1), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &zero);
    const gl::Program& program = *s.deposit[variant];
    program.set(0, index);
    program.set(1, Vec4{float(lattice.firstX), float(lattice.firstZ), float(lattice.countX), float(lattice.countZ)});
    program.set(2, Vec4{lattice.cellM, float(texelsPerM), float(units * cellTexels * cellTexels), float(side)});
    const auto corner = [&](float origin) { return float(std::floor(double(origin) * texelsPerM + 0.5)); };
    program.set(3, Vec3{corner(slot.origin.x), corner(slot.origin.y), float(mostFlux)});
    s.deposits.bindStorage(SHOAL_STORAGE_WATER);
    program.dispatch(lattice.countX, lattice.countZ);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    s.photonCount += std::int64_t(lattice.countX) * lattice.countZ;

    s.resolve->set(1, float(1 / (units * fine * fine)));
    glProgramUniform4i(s.resolve->name(), 0, s.setup.resolution, fine, 2 * index, 0);
}

void resolveSlot(State& s, const frame::Context& context, int index) {
    const gl::PassScope pass(context.timer, "caustic maps");
    gl::bindImage(0, s.maps, GL_WRITE_ONLY);
    s.resolve->dispatch(s.setup.resolution, s.setup.resolution, 2);
    for (int level = 1; level < s.mipLevels; ++level) {
        glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        gl::bindImage(0, s.maps, GL_READ_ONLY, level - 1);
        gl::bindImage(1, s.maps, GL_WRITE_ONLY, level);
        s.mips->set(0, 2 * index);
        s.mips->set(1, s.setup.resolution >> level);
        s.mips->dispatch(s.setup.resolution >> level, s.setup.resolution >> level, 2);
    }
}

Vec4 with(Vec3 v) { return {v.x, v.y, v.z, 0}; }

// The view's rays as affine functions of the pixel.
CausticBlock viewRays(const frame::Context& context) {
    const light::View& view = context.view;
    const Mat4 clipFromView = light::jittered(view, context.jitterPx.x, context.jitterPx.y);
    const Mat4 viewFromClip = inverse(clipFromView).value_or(view.viewFromClip);
    const auto nearAt = [&](float x, float y) { return transformPoint(viewFromClip, {x, y, 1}); };
    const auto pointAt = [&](float x, float y) {
        const Vec3 p = nearAt(x, y);
        return view.orthographic ? transformDirection(view.worldFromView, {p.x, p.y, 0})
                                 : transformDirection(view.worldFromView, p * (-1 / p.z));
    };
    const Vec3 at0 = pointAt(-1, -1);
    const Vec3 dx = (pointAt(1, -1) - at0) / float(view.width), dy = (pointAt(-1, 1) - at0) / float(view.height);
    CausticBlock block{};
    const float pixelM = length(dy);
    block.origin = with(view.eye), block.ray = with(at0), block.rayX = with(dx), block.rayY = with(dy);
    block.size = {float(view.width), float(view.height), pixelM, 0};
    if (view.orthographic) {
        block.origin = with(view.eye + at0), block.originX = with(dx), block.originY = with(dy);
        block.ray = with(transformDirection(view.worldFromView, {0, 0, -1}));
        block.rayX = block.rayY = {};
        block.size.z = 0, block.size.w = pixelM;
    }
    return block;
}

}  // namespace

Photons::Photons(std::unique_ptr<State> state) : state_(std::move(state)) {}
Photons::Photons(Photons&&) noexcept = default;
Photons& Photons::operator=(Photons&&) noexcept = default;
Photons::~Photons() = default;

Result<Photons> Photons::create(gl::Device& device, const PhotonSetup& setup) {
    frame::registerFrameShaders();
    registerWaterShaders();
    auto state = std::make_unique<State>();
    State& s = *state;
    s.device = &device;
    s.setup = setup;
    SHOAL_TRY(makePrograms(device, s));
    while (s.mipLevels < kMostMipLevels && setup.resolution % (1 << s.mipLevels) == 0) ++s.mipLevels;
    gl::TextureDesc desc;
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.format = GL_R32F;
    desc.width = desc.height = setup.resolution;
    desc.layers = 2 * setup.maxSlots;
    desc.levels = s.mipLevels;
    desc.minFilter = GL_NEAREST_MIPMAP_NEAREST;
    desc.label = "caustic maps";
    s.maps = gl::Texture::create(device, desc);
    const std::size_t texels = std::size_t(setup.resolution) * std::size_t(setup.resolution);
    s.deposits = gl::Buffer::create(device, (2 * texels + 1) * sizeof(std::uint32_t), "photon deposits");
    if (!s.maps || !s.deposits) return internalError("no memory for caustic maps");
    s.waterBlock = gl::BlockBuffer<WaterBlock>::create(device, "water");
    s.causticBlock = gl::BlockBuffer<CausticBlock>::create(device, "caustics");
    return Photons(std::move(state));
}

void Photons::render(const frame::Context& context, const PhotonParams& params, const Body& body,
                     const BodyLights& lights, const LightViews& views) {
    State& s = *state_;
    s.waterBlock.write(makeWaterBlock(body, lights));
    s.waterBlock.bindUniform(SHOAL_BLOCK_WATER);
    body.gpuWaves->bind();
    views.bind();
    const std::span<const LightSlot> slots = views.slots();
    s.sunHasSlot = false;
    s.photonCount = 0;
    const double slope = body.waves ? body.waves->bounds().slope : 0;
    const bool air = views.airDrawn();
    for (int i = 0; i < int(slots.size()) && i < s.setup.maxSlots; ++i) {
        const LightSlot& slot = slots[std::size_t(i)];
        s.sunHasSlot = s.sunHasSlot || (slot.light < 0 && !slot.reflected);
        depositSlot(s, context, i, slot, photonsOf(slot, slots, params.photons), variantOf(slot, body, lights, air),
                    slope, 1);
        resolveSlot(s, context, i);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void Photons::resolve(const frame::Context& context, const Body& body, const BodyLights& lights,
                      const LightViews& views, const ReceiverInputs& inputs, const IrradianceOutputs& outputs) {
    State& s = *state_;
    const gl::PassScope pass(context.timer, "caustic lookup");
    s.waterBlock.write(makeWaterBlock(body, lights));
    s.waterBlock.bindUniform(SHOAL_BLOCK_WATER);
    CausticBlock block = viewRays(context);
    block.maps = {float(s.mipLevels), s.sunHasSlot ? 1.0f : 0.0f, 0, 0};
    s.causticBlock.write(block);
    s.causticBlock.bindUniform(SHOAL_BLOCK_WATER_PASS);
    body.gpuWaves->bind();
    views.bind();
    gl::bindTexture(SHOAL_UNIT_CAUSTIC_MAPS, s.maps);
    gl::bindTexture(0, inputs.viewDepth);
    const bool normals = bool(inputs.normal);
    if (normals) gl::bindTexture(1, inputs.normal);
    for (const int unit : {0, 1, SHOAL_UNIT_CAUSTIC_MAPS}) glBindSampler(GLuint(unit), 0);
    gl::bindImage(0, outputs.direct, GL_WRITE_ONLY);
    gl::bindImage(1, outputs.ambient ? outputs.ambient : outputs.direct, GL_WRITE_ONLY);
    const gl::Program& program = *s.lookup[normals];
    program.set(0, outputs.ambient ? 1 : 0);
    program.dispatch(context.view.width, context.view.height);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

gl::TextureView Photons::maps() const { return state_->maps.view(); }

frame::Stats Photons::stats() const {
    const State& s = *state_;
    frame::Stats stats;
    std::int64_t texels = 0;
    for (int level = 0; level < s.mipLevels; ++level) {
        const std::int64_t side = s.setup.resolution >> level;
        texels += side * side;
    }
    stats.bytes = std::int64_t(s.deposits.bytes()) + texels * 2 * s.setup.maxSlots * 4;
    stats.counts = {{"photons", s.photonCount}};
    return stats;
}

}  // namespace shoal::water
