// A wave field on the GPU: the block and tiles that waves.io.glsl reads (waveAt, waveHeightAt).
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <shoal/core/result.h>
#include <shoal/gl/objects.h>
#include <shoal/water/waves.h>

namespace shoal::water {

// Defines (for gl::ProgramDesc) of a program that reads no other field than ones of this kind: leaves out what they
// lack. With them slopes of plane waves take half the time on llvmpipe. A program without them reads every field.
std::vector<std::pair<std::string, std::string>> waveDefines(const WaveField& field);

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
