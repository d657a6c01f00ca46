#include <bit>
#include <cmath>
#include <utility>

#include <epoxy/gl.h>

#include <shoal/core/parallel.h>
#include <shoal/water/gpu_waves.h>

#include "water/bindings.shared.h"
#include "water/surface/water_block.h"
#include "water/waves.shared.h"

namespace shoal::water {
namespace {

// The power of two whose multiples up to `greatest` (0 or more) have at most 12 bits.
double unitOf12Bits(double greatest) {
    int exponent = 0;
    std::frexp(greatest, &exponent);
    return std::ldexp(1.0, exponent - 12);
}

// value = first + second, where first is a multiple of `unit`.
std::pair<float, float> inTwoParts(double value, double unit) {
    const double first = unit * std::round(value / unit);
    return {float(first), float(value - first)};
}

float turns(double radians) { return float(radians / (2 * kPiD)); }

WaveBlock makeWaveBlock(const WaveField& field) {
    WaveBlock block{};
    const auto planes = field.planeWaves();
    const auto tiles = field.tiles();
    const int size = tiles.empty() ? 1 : tiles[0].size;
    block.counts = {float(planes.size()), float(tiles.size()), float(size), float(std::bit_width(unsigned(size)))};
    const WaveBounds bounds = field.bounds();
    block.bounds = {float(bounds.height), float(bounds.slope), float(bounds.wavelength), 0};
    const CircularWave& c = field.circularWave();
    block.circular = {c.amplitude, c.k, turns(double(c.phase)), turns(double(c.k))};
    double most = 1e-6;
    for (const PlaneWave& p : planes) most = std::max({most, std::abs(double(p.turnsX)), std::abs(double(p.turnsZ))});
    const double unit = unitOf12Bits(most);
    block.center = {c.centerX, c.centerZ, float(unit), float(1 / unit)};
    for (std::size_t i = 0; i < planes.size(); ++i) {
        const PlaneWave& p = planes[i];
        block.planes[i] = {p.amplitude, p.turnsX, p.turnsZ, turns(double(p.phase))};
    }
    for (std::size_t i = 0; i < tiles.size(); ++i) {
        const double perMetre = double(size) / double(tiles[i].periodM);
        const auto scale = inTwoParts(perMetre, unitOf12Bits(perMetre));
        block.tiles[i] = {scale.first, scale.second, tiles[i].periodM / float(size), tiles[i].periodM};
    }
    return block;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> waveDefines(const WaveField& field) {
    std::vector<std::pair<std::string, std::string>> defines;
    if (field.tiles().empty()) defines.emplace_back("SHOAL_WAVES_NO_TILES", "1");
    if (field.circularWave().amplitude == 0) defines.emplace_back("SHOAL_WAVES_NO_CIRCLE", "1");
    return defines;
}

struct GpuWaves::State {
    gl::Device* device = nullptr;
    gl::BlockBuffer<WaveBlock> block;
    gl::Texture tiles;
    std::vector<std::vector<float>> levels[SHOAL_MAX_WAVE_TILES];  // by tile: texels of every mip level, 4 floats each
    std::uint64_t revision = 0;

    Result<void> fit(int size, int layers);
    void upload(const WaveField& field);
};

namespace {

// The tile, then means of (h, hx, hz, hx^2 + hz^2) over squares of texels: from what is lost between the mean square
// and the square of the mean, shaders tell how much the slopes vary. On the CPU: drivers round their mip levels
// differently.
void makeLevels(const WaveTile& tile, std::vector<std::vector<float>>& levels) {
    levels.resize(std::size_t(std::bit_width(unsigned(tile.size))));
    levels[0] = tile.texels;
    for (std::size_t l = 1; l < levels.size(); ++l) {
        const std::size_t size = std::size_t(tile.size) >> l, from = 2 * size;
        levels[l].resize(size * size * 4);
        for (std::size_t j = 0; j < size; ++j)
            for (std::size_t i = 0; i < size; ++i) {
                const float* a = &levels[l - 1][(2 * j * from + 2 * i) * 4];
                const float* b = a + from * 4;
                float* to = &levels[l][(j * size + i) * 4];
                for (int c = 0; c < 3; ++c) to[c] = 0.25f * ((a[c] + a[c + 4]) + (b[c] + b[c + 4]));
                const auto square = [&](const float* v) { return l == 1 ? v[1] * v[1] + v[2] * v[2] : v[3]; };
                to[3] = 0.25f * ((square(a) + square(a + 4)) + (square(b) + square(b + 4)));
            }
    }
}

}  // namespace

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
    parallelFor(from.size(), 1, [&](std::size_t i) { makeLevels(from[i], levels[i]); });
    for (std::size_t i = 0; i < from.size(); ++i) {
        for (std::size_t l = 0; l < levels[i].size(); ++l)
            tiles.upload(int(l), int(i), GL_RGBA, GL_FLOAT, levels[i][l].data());
    }
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
    if (Result<void> ok = state->fit(1, 1); !ok) return ok.error();
    return GpuWaves(std::move(state));
}

Result<void> GpuWaves::update(const WaveField& field) {
    if (field.revision() == state_->revision) return {};
    const auto tiles = field.tiles();
    if (!tiles.empty())
        if (Result<void> ok = state_->fit(tiles[0].size, int(tiles.size())); !ok) return ok;
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
