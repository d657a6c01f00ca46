// A wave field on the GPU: the block and tiles that waves.io.glsl reads (waveAt, waveHeightAt).
#pragma once

#include <memory>

#include <shoal/core/result.h>
#include <shoal/gl/objects.h>
#include <shoal/water/waves.h>

namespace shoal::water {

class GpuWaves {
public:
    static Result<GpuWaves> create(gl::Device& device);
    GpuWaves(GpuWaves&&) noexcept;
    GpuWaves& operator=(GpuWaves&&) noexcept;
    ~GpuWaves();

    // Uploads what changed since the last update. Allocates when the field's tiles change size.
    Result<void> update(const WaveField& field);
    // Binds the block SHOAL_BLOCK_WAVES and texture unit SHOAL_UNIT_WAVE_TILES.
    void bind() const;

    struct State;

private:
    explicit GpuWaves(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::water
