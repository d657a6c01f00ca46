#include "water/photons/split_photons.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "water/bindings.shared.h"
#include "water/light_space.shared.h"

namespace shoal::water {
namespace {

constexpr int kBlockTexels = 4;
constexpr double kUsual = 0.5;  // of the margin for the steepest waves, what most photons go aside
constexpr int kMostAside = 4;   // blocks
constexpr int kMostInAir = 8;   // blocks: where it takes more, all photons look themselves
constexpr std::array<std::uint32_t, 4> kNone{0, 1, 1, 0};  // work groups, photons listed

}  // namespace

Result<SplitPhotons> SplitPhotons::create(gl::Device& device, const PhotonSetup& setup) {
    SplitPhotons s;
    s.device_ = &device;
    s.blocks_ = (setup.resolution + kBlockTexels - 1) / kBlockTexels;
    const char* const variants[] = {"", "WIDEN_X", "WIDEN_Z"};
    for (std::size_t i = 0; i < std::size(variants); ++i) {
        std::vector<std::pair<std::string, std::string>> defines;
        if (*variants[i]) defines.push_back({variants[i], ""});
        SHOAL_TRY_ASSIGN(s.measure_[i],
                         device.programs().get({{"water/light_relief.comp"}, std::move(defines), "light relief"}));
    }
    const std::size_t blocks = std::size_t(setup.maxSlots) * std::size_t(s.blocks_) * std::size_t(s.blocks_);
    s.blockEnds_ = gl::Buffer::create(device, 2 * sizeof(Vec4) * blocks, "heights that light meets");
    s.relief_ = gl::Buffer::create(device, sizeof(Vec2) * blocks, "relief of what light meets");
    if (!s.blockEnds_ || !s.relief_) return internalError("no memory for the relief of what light meets");
    return s;
}

void SplitPhotons::measure(std::span<const Job> jobs, std::int64_t cells) {
    const std::size_t bytes = sizeof kNone + sizeof(std::uint32_t) * std::size_t(cells);
    if (list_.bytes() < bytes) list_ = gl::Buffer::create(*device_, bytes, "photons to be parted");
    std::array<GLint, 2 * SHOAL_MAX_LIGHT_SLOTS> widths{};
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const LightSlot& slot = jobs[i].slot;
        const double blockM = kBlockTexels * double(slot.texel);
        // Photons look at the middle of their way: half of it, of most, and what lies between blocks. In the air they
        // look at the level, from their cells' corners.
        const double aside = 0.5 * kUsual * double(slot.margin) / blockM;
        const double inAir = (0.5 * double(jobs[i].cellM) + jobs[i].airShiftM + double(slot.texel)) / blockM;
        widths[2 * i] = std::clamp(int(std::ceil(aside)), 1, kMostAside);
        widths[2 * i + 1] = inAir < kMostInAir ? int(std::ceil(inAir)) : -1;
    }
    blockEnds_.bindStorage(SHOAL_STORAGE_WATER + 1);
    relief_.bindStorage(SHOAL_STORAGE_WATER + 2);
    for (const gl::Program* program : measure_) {
        program->set(0, blocks_);
        glProgramUniform2iv(program->name(), 1, SHOAL_MAX_LIGHT_SLOTS, widths.data());
        program->dispatch(blocks_, blocks_, int(jobs.size()));
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
}

void SplitPhotons::begin() {
    list_.write(0, std::as_bytes(std::span(kNone)));
    list_.bindStorage(SHOAL_STORAGE_WATER + 1);
    relief_.bindStorage(SHOAL_STORAGE_WATER + 2);
}

void SplitPhotons::lay(const gl::Program& program) const {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, list_.name());
    program.use();
    glDispatchComputeIndirect(0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
}

}  // namespace shoal::water
