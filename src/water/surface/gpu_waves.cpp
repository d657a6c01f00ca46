#include <bit>
#include <cmath>
#include <utility>

#include <epoxy/gl.h>

#include <shoal/water/gpu_waves.h>

#include "water/bindings.shared.h"
#include "water/surface/water_block.h"
#include "water/waves.shared.h"

namespace shoal::water {
namespace {

// value = first + second, where first has 12 significant bits.
std::pair<float, float> inTwoParts(double value) {
    int exponent = 0;
    const double fraction = std::frexp(value, &exponent),
                 first = std::ldexp(std::round(fraction * 4096), exponent - 12);
    return {float(first), float(value - first)};
}

WaveBlock makeWaveBlock(const WaveField& field) {
    WaveBlock block{};
    const auto planes = field.planeWaves();
    const auto tiles = field.tiles();
    const int size = tiles.empty() ? 1 : tiles[0].size;
    block.counts = {float(planes.size()), float(tiles.size()), float(size), float(std::bit_width(unsigned(size)))};
    const WaveBounds bounds = field.bounds();
    block.bounds = {float(bounds.height), float(bounds.slope), float(bounds.wavelength), 0};
    const CircularWave& c = field.circularWave();
    block.circular = {c.amplitude, c.k, c.phase, 0};
    block.center = {c.centerX, c.centerZ, 0, 0};
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const PlaneWave& p = planes[i];
        const auto x = inTwoParts(double(p.kx) / (2 * kPiD)), z = inTwoParts(double(p.kz) / (2 * kPiD));
        block.planes[i] = {p.amplitude, p.kx, p.kz, p.phase};
        block.planeTurns[i] = {x.first, z.first, x.second, z.second};
    }
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const auto scale = inTwoParts(double(size) / double(tiles[i].periodM));
        block.tiles[i] = {scale.first, scale.second, tiles[i].periodM / float(size), tiles[i].periodM};
    }
    return block;
}

}  // namespace

struct GpuWaves::State {
    gl::Device* device = nullptr;
    gl::BlockBuffer<WaveBlock> block;
    gl::Texture tiles;
    std::vector<float> level0;
    std::uint64_t revision = 0;

    Result<void> fit(int size, int layers);
    void upload(const WaveField& field);
};

// A texture is bound even where there are no tiles: shaders name it.
Result<void> GpuWaves::State::fit(int size, int layers) {
    if (tiles && tiles.width() == size && tiles.view().layers == layers) return {};
    gl::TextureDesc desc;
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.format = GL_RGBA32F;
    desc.width = desc.height = size;
    desc.layers = layers;
    desc.levels = 0;
    desc.minFilter = GL_LINEAR_MIPMAP_LINEAR, desc.magFilter = GL_LINEAR;
    desc.wrap = GL_REPEAT;
    desc.label = "wave tiles";
    tiles = gl::Texture::create(*device, desc);
    if (!tiles) return internalError("no memory for wave tiles of " + std::to_string(size) + " texels a side");
    return {};
}

void GpuWaves::State::upload(const WaveField& field) {
    const auto from = field.tiles();
    for (std::size_t i = 0; i < from.size(); ++i) {
        // The mean square goes into the fourth channel: in the mips it tells how much the slopes vary.
        level0 = from[i].height;
        for (std::size_t t = 0; t < level0.size(); t += 4)
            level0[t + 3] = level0[t + 1] * level0[t + 1] + level0[t + 2] * level0[t + 2];
        tiles.upload(0, int(2 * i), GL_RGBA, GL_FLOAT, level0.data());
        tiles.upload(0, int(2 * i) + 1, GL_RGBA, GL_FLOAT, from[i].curvature.data());
    }
    if (!from.empty()) tiles.generateMipmaps();
}

GpuWaves::GpuWaves(std::unique_ptr<State> state) : state_(std::move(state)) {}
GpuWaves::GpuWaves(GpuWaves&&) noexcept = default;
GpuWaves& GpuWaves::operator=(GpuWaves&&) noexcept = default;
GpuWaves::~GpuWaves() = default;

Result<GpuWaves> GpuWaves::create(gl::Device& device) {
    registerWaterShaders();
    auto state = std::make_unique<State>();
    state->device = &device;
    state->block = gl::BlockBuffer<WaveBlock>::create(device, "waves");
    state->block.write(WaveBlock{});
    if (Result<void> ok = state->fit(1, 2); !ok) return ok.error();
    return GpuWaves(std::move(state));
}

Result<void> GpuWaves::update(const WaveField& field) {
    if (field.revision() == state_->revision) return {};
    const auto tiles = field.tiles();
    if (!tiles.empty())
        if (Result<void> ok = state_->fit(tiles[0].size, int(2 * tiles.size())); !ok) return ok;
    state_->block.write(makeWaveBlock(field));
    state_->upload(field);
    state_->revision = field.revision();
    return {};
}

void GpuWaves::bind() const {
    state_->block.bindUniform(SHOAL_BLOCK_WAVES);
    state_->tiles.bind(SHOAL_UNIT_WAVE_TILES);
}

}  // namespace shoal::water
