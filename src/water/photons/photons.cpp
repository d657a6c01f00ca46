// Photons of every slot into maps (caustic_maps.h), and the lookup of those for each pixel of a view.
#include <shoal/water/photons.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include <shoal/water/gpu_waves.h>

#include "frame/fullscreen.h"
#include "water/bindings.shared.h"
#include "water/caustic.shared.h"
#include "water/light_space.shared.h"
#include "water/photons/caustic_maps.h"
#include "water/surface/water_block.h"

namespace shoal::water {

struct Photons::State {
    gl::Device* device = nullptr;
    PhotonSetup setup;
    std::optional<CausticMaps> maps;
    // Looking up: all pixels, listed tiles deep down, those near the waterline; the sun alone or lamps too; without
    // normals, with.
    const gl::Program* lookup[3][2][2] = {};
    const gl::Program* lookupFew[2] = {};  // the first of them for one or two slots of the sun
    const gl::Program* listTiles = nullptr;
    gl::Buffer tiles, tileFlags;
    gl::BlockBuffer<WaterBlock> waterBlock;
    gl::BlockBuffer<CausticBlock> causticBlock;
    gl::BlockBuffer<LightSpaceBlock> noSlots;  // of method none: light goes on as through level water
    std::vector<PhotonJob> jobs;               // of this frame
    bool sunHasSlot = false, traced = false;
    std::int64_t photonCount = 0;
};

namespace {

using State = Photons::State;

constexpr double kReflectedShare = 0.125;
constexpr int kFewestPhotons = 64;  // of a slot
constexpr float kBlends = 2;        // maps that a lookup blends at most

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

Result<void> makePrograms(gl::Device& device, State& s) {
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
    return std::max(int(double(photons) * share), kFewestPhotons);
}

// Metres that waves shift at most where the slot's light comes through the air.
double airShift(const LightSlot& slot, int resolution, const Body& body, const BodyLights& lights) {
    const double wave = body.waves ? double(body.waves->bounds().height) : 0;
    if (slot.light < 0) {
        const Vec3 toSun = normalize(lights.sun->toSun);
        return wave * double(std::hypot(toSun.x, toSun.z)) / std::max(double(toSun.y), 1e-6);
    }
    const double height = double(lights.punctual[std::size_t(slot.light)].position.y) - double(body.params.level);
    return wave * double(slot.texel) * resolution / std::max(height, 1e-3);
}

PhotonVariant variantOf(const LightSlot& slot, const Body& body, const BodyLights& lights, bool air) {
    if (slot.light >= 0) return PhotonVariant::lamp;
    const Vec3 toSun = normalize(lights.sun->toSun);
    const double rise = double(toSun.y) / std::max(double(std::hypot(toSun.x, toSun.z)), 1e-6);
    const double slope = body.waves ? body.waves->bounds().slope : 0;
    if (slope > rise) return PhotonVariant::lowSun;
    return air ? PhotonVariant::air : PhotonVariant::plain;
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
    SHOAL_TRY_ASSIGN(s.maps, CausticMaps::create(device, setup));
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
    s.jobs.clear();
    for (int i = 0; i < int(slots.size()) && i < s.setup.maxSlots; ++i) {
        const LightSlot& slot = slots[std::size_t(i)];
        s.sunHasSlot = s.sunHasSlot || (slot.light < 0 && !slot.reflected);
        PhotonJob job{i, slot, photonsOf(slot, slots, params.photons), variantOf(slot, body, lights, air), body.params};
        if (slot.light < 0) job.mostFlux = std::min(job.mostFlux, std::sqrt(1 + slope * slope));
        job.mostLeft = mostLeft(slot, body);
        job.airShiftM = airShift(slot, s.setup.resolution, body, lights);
        s.jobs.push_back(job);
    }
    s.maps->prepare(context, s.jobs, std::max(params.photons, kFewestPhotons));
    for (const PhotonJob& job : s.jobs) s.photonCount += s.maps->make(context, job);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void Photons::resolve(const frame::Context& context, const Body& body, const BodyLights& lights,
                      const LightViews& views, const ReceiverInputs& inputs, const IrradianceOutputs& outputs) {
    State& s = *state_;
    const gl::PassScope pass(context.timer, "caustic lookup");
    s.waterBlock.write(makeWaterBlock(body, lights));
    s.waterBlock.bindUniform(SHOAL_BLOCK_WATER);
    CausticBlock block = viewRays(context);
    block.maps = {float(s.maps->mipLevels()), s.sunHasSlot ? 1.0f : 0.0f, kBlends, 0};
    s.causticBlock.write(block);
    s.causticBlock.bindUniform(SHOAL_BLOCK_WATER_PASS);
    body.gpuWaves->bind();
    views.bind();
    if (!s.traced) s.noSlots.bindUniform(SHOAL_BLOCK_LIGHT_SPACE);
    gl::bindTexture(SHOAL_UNIT_CAUSTIC_MAPS, s.maps->maps());
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
    s.maps->secondUsed().bindStorage(SHOAL_STORAGE_WATER + 2);
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

gl::TextureView Photons::maps() const { return state_->maps->maps().view(); }

frame::Stats Photons::stats() const {
    const State& s = *state_;
    frame::Stats stats;
    stats.bytes = s.maps->bytes();
    stats.counts = {{"photons", s.photonCount}};
    return stats;
}

}  // namespace shoal::water
