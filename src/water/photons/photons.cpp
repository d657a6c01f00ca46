// [Papadopoulos & Papaioannou 2010] trace photons through the water's surface into the picture as points of a fixed
// size; here each is laid over its own footprint (photon_deposit.comp) in maps that stand still in the world.
#include <shoal/water/photons.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include <shoal/gl/program.h>
#include <shoal/water/gpu_waves.h>

#include "frame/fullscreen.h"
#include "water/bindings.shared.h"
#include "water/caustic.shared.h"
#include "water/light_space.shared.h"
#include "water/photons/emission.h"
#include "water/surface/water_block.h"

namespace shoal::water {

struct Photons::State {
    // What photon.io.glsl leaves out.
    enum Variant { kPlain, kAir, kLowSun, kLamp, kVariants };
    gl::Device* device = nullptr;
    PhotonSetup setup;
    const gl::Program* deposit[kVariants] = {};
    const gl::Program *resolve[2] = {}, *mips[2] = {};  // into maps, into the sharp map
    const gl::Program *disc = nullptr, *layers = nullptr;
    // Looking up: all pixels, listed tiles deep down, those near the waterline; the sun alone or lamps too; without
    // normals, with.
    const gl::Program* lookup[3][2][2] = {};
    const gl::Program* lookupFew[2] = {};  // the first of them for one or two slots of the sun
    const gl::Program* listTiles = nullptr;
    gl::Buffer tiles, tileFlags, secondUsed;
    gl::Buffer deposits;  // of one slot at a time
    gl::Buffer commands;  // work groups of the passes after the deposit, for one layer or two
    gl::Texture sharp;    // its two layers before the light's disc blurs them
    gl::Texture maps;
    int mostFine = 1;  // deposit texels a side of a texel of the maps
    int mipLevels = 1;
    gl::BlockBuffer<WaterBlock> waterBlock;
    gl::BlockBuffer<CausticBlock> causticBlock;
    gl::BlockBuffer<LightSpaceBlock> noSlots;  // of method none: light goes on as through level water
    bool sunHasSlot = false, traced = false;
    std::int64_t photonCount = 0;
};

namespace {

using State = Photons::State;

constexpr int kMipLevels = 3;  // squares begin at multiples of 8 texels
constexpr int kSharpLevels = 6;
constexpr std::size_t kMostPasses = 2 + kSharpLevels + kMipLevels;  // of one slot after the deposit
// Texels a side of maps that may be deposited three times and twice as fine.
constexpr int kFinestMap = 512, kLargestFineMap = 1024;
// Radius of the light's disc at the slot's bottom, texels: smaller ones are not seen, and up to the second one the map
// that they blur must be finer where the sun's one map is all there is (convolving 512^2 bins by .9 texels leaves 11 %
// error, 1024^2 bins 2.5 %, 1536^2 bins 1.7 %). Where maps follow each other their steps are larger than that.
constexpr double kSeenDisc = 0.6, kWideDisc = 2;
constexpr double kReflectedShare = 0.125;
constexpr float kFewTexels = 1.5f;
constexpr float kBlends = 2;  // maps that a lookup blends at most

// A photon counts for no more than this times what level water leaves of one at the same place: only waves under a low
// sun exceed it, where e^-6 of the light is left.
constexpr double kMostLeft = 32;

// The most that a photon of a slot may be dimmed less than light in level water: one that goes straight down, from a
// trough, where level water's light goes aslant.
double mostLeft(const LightSlot& slot, const Body& body) {
    const Vec3 beam = body.optics.beamAttenuation();
    const double least = double(std::min({beam.x, beam.y, beam.z}));
    if (slot.reflected || least <= 0) return 1;
    if (slot.light >= 0) return kMostLeft;
    const double wave = body.waves ? double(body.waves->bounds().height) : 0;
    const double depth = std::max(double(body.params.level) - double(slot.bottom), 0.0);
    return std::min(std::exp(least * (depth * (1 / double(slot.source.y) - 1) + wave)), kMostLeft);
}

// Texels in height of a map with its mips in a row above it.
int shelved(int side) { return side + side / 2; }

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
    SHOAL_TRY_ASSIGN(s.disc, device.programs().get({{"water/caustic_disc.comp"}, {}, "caustic disc"}));
    SHOAL_TRY_ASSIGN(s.layers, device.programs().get({{"water/caustic_layers.comp"}, {}, "caustic layers"}));
    for (int sharp = 0; sharp < 2; ++sharp) {
        std::vector<std::pair<std::string, std::string>> defines;
        if (sharp) defines.push_back({"SHARP", ""});
        SHOAL_TRY_ASSIGN(s.resolve[sharp],
                         device.programs().get({{"water/caustic_resolve.comp"}, defines, "caustic resolve"}));
        SHOAL_TRY_ASSIGN(s.mips[sharp], device.programs().get({{"water/caustic_mips.comp"}, defines, "caustic mips"}));
    }
    const auto lookup = [&](std::vector<std::pair<std::string, std::string>> defines) {
        return device.programs().get({{"water/caustic_lookup.comp"}, std::move(defines), "caustic lookup"});
    };
    for (int i = 0; i < 12; ++i) {
        std::vector<std::pair<std::string, std::string>> defines;
        if (i >= 4) defines.push_back({"TILES", ""});
        if (i >= 8) defines.push_back({"WATERLINE", ""});
        if (!(i & 2)) defines.push_back({"NO_LAMPS", ""});
        if (!(i & 1)) defines.push_back({"NO_NORMALS", ""});
        SHOAL_TRY_ASSIGN(s.lookup[i >> 2][i >> 1 & 1][i & 1], lookup(defines));
    }
    for (int normals = 0; normals < 2; ++normals) {
        std::vector<std::pair<std::string, std::string>> defines = {{"NO_LAMPS", ""}, {"FEW_SLOTS", ""}};
        if (!normals) defines.push_back({"NO_NORMALS", ""});
        SHOAL_TRY_ASSIGN(s.lookupFew[normals], lookup(defines));
    }
    SHOAL_TRY_ASSIGN(s.listTiles, device.programs().get({{"water/caustic_tiles.comp"}, {}, "caustic tiles"}));
    return {};
}

int cascadesOf(const LightSlot& slot, std::span<const LightSlot> slots) {
    return int(std::count_if(slots.begin(), slots.end(), [&](const LightSlot& other) {
        return other.light == slot.light && other.reflected == slot.reflected;
    }));
}

// A light's photons are shared by its cascades; what the surface reflects is fainter.
int photonsOf(const LightSlot& slot, std::span<const LightSlot> slots, int photons) {
    const double share = (slot.reflected ? kReflectedShare : 1) / cascadesOf(slot, slots);
    return std::max(int(double(photons) * share), 64);
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
                 State::Variant variant, double slope, double left, int fine) {
    const gl::PassScope pass(context.timer, "caustic photons");
    const EmissionLattice lattice = emissionLattice(slot, s.setup.resolution, photons);
    const double texelsPerM = fine / double(slot.texel), cellTexels = double(lattice.cellM) * texelsPerM;
    const int side = s.setup.resolution * fine;
    const double mostFlux = slot.light >= 0 ? 4 : std::min(4.0, std::sqrt(1 + slope * slope));
    // All of the slot's flux in one texel still fits, with room for the rounding of each photon.
    const double most = double(lattice.countX) * double(lattice.countZ) * (cellTexels * cellTexels * mostFlux * left);
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
    program.set(3, Vec4{corner(slot.origin.x), corner(slot.origin.y), float(mostFlux), float(left)});
    s.deposits.bindStorage(SHOAL_STORAGE_WATER);
    program.dispatch(lattice.countX, lattice.countZ);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    s.photonCount += std::int64_t(lattice.countX) * lattice.countZ;

    for (const gl::Program* resolve : s.resolve) resolve->set(1, float(1 / units));
}

// The passes after the deposit, in order: each covers `side` texels a side of one layer or two.
class LayerPasses {
public:
    LayerPasses(State& s, int deposits, int slot) : state_(s), flag_(2 * deposits * deposits), slot_(slot) {}

    void add(const gl::Program& program, int side, std::function<void()> bind) {
        const auto groups = [&](int axis) {
            return std::uint32_t((side + program.localSize(axis) - 1) / program.localSize(axis));
        };
        passes_[count_] = {&program, std::move(bind)};
        words_[3 * count_] = groups(0), words_[3 * count_ + 1] = groups(1), words_[3 * count_ + 2] = 2;
        ++count_;
    }
    void run() {
        state_.commands.writeAll(std::span<const std::uint32_t>(words_));
        state_.deposits.bindStorage(SHOAL_STORAGE_WATER);
        state_.commands.bindStorage(SHOAL_STORAGE_WATER + 1);
        state_.secondUsed.bindStorage(SHOAL_STORAGE_WATER + 2);
        glProgramUniform3i(state_.layers->name(), 0, flag_, int(count_), slot_);
        state_.layers->dispatch(1);
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, state_.commands.name());
        for (std::size_t i = 0; i < count_; ++i) {
            glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                            GL_SHADER_STORAGE_BARRIER_BIT);
            passes_[i].bind();
            passes_[i].program->use();
            glDispatchComputeIndirect(GLintptr(3 * sizeof(std::uint32_t) * i));
        }
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    }

private:
    struct Pass {
        const gl::Program* program = nullptr;
        std::function<void()> bind;
    };
    State& state_;
    int flag_, slot_;
    std::size_t count_ = 0;
    std::array<Pass, kMostPasses> passes_;
    std::array<std::uint32_t, 3 * kMostPasses> words_{};
};

void addMips(State& s, LayerPasses& passes, bool sharp, int firstLayer, int side, int levels) {
    for (int level = 1; level < levels; ++level)
        passes.add(*s.mips[sharp], side >> level, [&s, sharp, firstLayer, side, level] {
            gl::bindImage(0, sharp ? s.sharp : s.maps, GL_READ_WRITE);
            glProgramUniform4i(s.mips[sharp]->name(), 0, firstLayer, side, side >> level, 0);
        });
}

int levelsFor(double radius) {
    return std::clamp(1 + int(std::floor(std::log2(std::max(radius, 1.0)))), 1, kSharpLevels);
}

void resolveSlot(State& s, const frame::Context& context, int index, double disc, int fine, bool alone) {
    const gl::PassScope pass(context.timer, "caustic maps");
    const int resolution = s.setup.resolution, side = resolution * fine;
    const bool blurs = disc >= kSeenDisc;
    LayerPasses passes(s, side, index);
    passes.add(*s.resolve[blurs], blurs ? side : (side + 3) / 4, [&] {
        gl::bindImage(0, blurs ? s.sharp : s.maps, GL_WRITE_ONLY);
        glProgramUniform4i(s.resolve[blurs]->name(), 0, side, index, s.mipLevels, 0);
    });
    if (blurs) {
        const int levels = levelsFor(disc * fine);
        addMips(s, passes, true, 0, side, levels);
        passes.add(*s.disc, resolution, [&s, resolution, fine, index, levels, alone] {
            gl::bindTexture(0, s.sharp);
            glBindSampler(0, 0);
            gl::bindImage(0, s.maps, GL_WRITE_ONLY);
            // Where maps follow each other, half as many texels a radius will do: a quarter of the time.
            s.disc->set(1, alone ? kFewTexels : 0.5f * kFewTexels);
            glProgramUniform4i(s.disc->name(), 0, resolution, fine, index, levels);
        });
    }
    if (blurs) addMips(s, passes, false, 2 * index, resolution, s.mipLevels);
    passes.run();
}

// Lists and flags of tiles; grown for larger pictures.
void makeTileBuffers(State& s, std::size_t tiles, std::size_t header) {
    const std::size_t list = header + tiles * sizeof(std::uint32_t), flags = 2 * tiles * sizeof(std::uint32_t);
    if (s.tiles.bytes() < list) s.tiles = gl::Buffer::create(*s.device, list, "caustic tiles");
    if (s.tileFlags.bytes() >= flags) return;
    s.tileFlags = gl::Buffer::create(*s.device, flags, "caustic tile flags");
    s.tileFlags.clear(0);
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
    s.mipLevels = setup.resolution % (1 << (kMipLevels - 1)) == 0 ? kMipLevels : 1;
    gl::TextureDesc desc;
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.format = GL_RG32F;
    desc.width = setup.resolution, desc.height = shelved(setup.resolution);
    desc.layers = 2 * setup.maxSlots;
    desc.label = "caustic maps";
    s.maps = gl::Texture::create(device, desc);
    s.mostFine = setup.resolution <= kFinestMap ? 3 : setup.resolution <= kLargestFineMap ? 2 : 1;
    const std::size_t side = std::size_t(setup.resolution) * std::size_t(s.mostFine);
    desc.format = GL_R32F;
    desc.width = int(side), desc.height = shelved(int(side));
    desc.layers = 2;
    desc.label = "caustics before blur";
    s.sharp = gl::Texture::create(device, desc);
    s.deposits = gl::Buffer::create(device, (2 * side * side + 1) * sizeof(std::uint32_t), "photon deposits");
    s.commands = gl::Buffer::create(device, 3 * kMostPasses * sizeof(std::uint32_t), "caustic work groups");
    s.secondUsed = gl::Buffer::create(device, SHOAL_MAX_LIGHT_SLOTS * sizeof(std::uint32_t), "layers that hold light");
    s.secondUsed.clear(0);
    if (!s.maps || !s.sharp || !s.deposits || !s.commands) return internalError("no memory for caustic maps");
    s.waterBlock = gl::BlockBuffer<WaterBlock>::create(device, "water");
    s.causticBlock = gl::BlockBuffer<CausticBlock>::create(device, "caustics");
    s.noSlots = gl::BlockBuffer<LightSpaceBlock>::create(device, "no light space");
    s.noSlots.write({});
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
    s.traced = params.method != "none";
    if (!s.traced) return;
    const double slope = body.waves ? body.waves->bounds().slope : 0;
    const bool air = views.airDrawn();
    for (int i = 0; i < int(slots.size()) && i < s.setup.maxSlots; ++i) {
        const LightSlot& slot = slots[std::size_t(i)];
        s.sunHasSlot = s.sunHasSlot || (slot.light < 0 && !slot.reflected);
        const double disc = double(slot.discRadius) / double(slot.texel);
        const bool alone = slot.light < 0 && !slot.reflected && cascadesOf(slot, slots) == 1;
        const int fine = alone && disc >= kSeenDisc && disc < kWideDisc ? s.mostFine : 1;
        depositSlot(s, context, i, slot, photonsOf(slot, slots, params.photons), variantOf(slot, body, lights, air),
                    slope, mostLeft(slot, body), fine);
        resolveSlot(s, context, i, disc, fine, alone);
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
    block.maps = {float(s.mipLevels), s.sunHasSlot ? 1.0f : 0.0f, kBlends, 0};
    s.causticBlock.write(block);
    s.causticBlock.bindUniform(SHOAL_BLOCK_WATER_PASS);
    body.gpuWaves->bind();
    views.bind();
    if (!s.traced) s.noSlots.bindUniform(SHOAL_BLOCK_LIGHT_SPACE);
    gl::bindTexture(SHOAL_UNIT_CAUSTIC_MAPS, s.maps);
    gl::bindTexture(0, inputs.viewDepth);
    const bool normals = bool(inputs.normal);
    if (normals) gl::bindTexture(1, inputs.normal);
    for (const int unit : {0, 1, SHOAL_UNIT_CAUSTIC_MAPS}) glBindSampler(GLuint(unit), 0);
    gl::bindImage(0, outputs.direct, GL_WRITE_ONLY);
    gl::bindImage(1, outputs.ambient ? outputs.ambient : outputs.direct, GL_WRITE_ONLY);
    const bool lamps =
        std::any_of(views.slots().begin(), views.slots().end(), [](const LightSlot& slot) { return slot.light >= 0; });
    const bool few = !lamps && std::count_if(views.slots().begin(), views.slots().end(),
                                             [](const LightSlot& slot) { return !slot.reflected; }) <= 2;
    const gl::Program& all = few ? *s.lookupFew[normals] : *s.lookup[0][lamps][normals];
    const int tilesX = (context.view.width + all.localSize(0) - 1) / all.localSize(0);
    const int tilesY = (context.view.height + all.localSize(1) - 1) / all.localSize(1);
    const std::uint32_t none[8] = {0, 1, 1, 0, 0, 1, 1, 0};
    makeTileBuffers(s, std::size_t(tilesX) * std::size_t(tilesY), sizeof none);
    s.tiles.write(0, std::as_bytes(std::span(none)));
    s.tiles.bindStorage(SHOAL_STORAGE_WATER);
    s.tileFlags.bindStorage(SHOAL_STORAGE_WATER + 1);
    s.secondUsed.bindStorage(SHOAL_STORAGE_WATER + 2);
    all.set(0, outputs.ambient ? 1 : 0);
    all.dispatch(context.view.width, context.view.height);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glProgramUniform2i(s.listTiles->name(), 0, tilesX, tilesY);
    s.listTiles->dispatch(tilesX * tilesY);
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, s.tiles.name());
    for (const int list : {2, 1}) {
        const gl::Program& listed = *s.lookup[list][lamps][normals];
        listed.set(0, outputs.ambient ? 1 : 0);
        listed.use();
        glDispatchComputeIndirect(list == 2 ? 0 : 4 * sizeof(std::uint32_t));
    }
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
}

gl::TextureView Photons::maps() const { return state_->maps.view(); }

frame::Stats Photons::stats() const {
    const State& s = *state_;
    frame::Stats stats;
    stats.bytes = std::int64_t(s.deposits.bytes());
    for (const gl::Texture* texture : {&s.maps, &s.sharp, &s.maps})  // two numbers a texel of the maps
        stats.bytes += std::int64_t(sizeof(float)) * texture->width() * texture->height() * texture->view().layers;
    stats.counts = {{"photons", s.photonCount}};
    return stats;
}

}  // namespace shoal::water
