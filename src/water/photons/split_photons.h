// Photons whose cells' corners meet different things: listed while photons are laid down (photon_deposit.comp), then
// parted into smaller ones (photon_split.comp), so that edges of shadows are as fine as the maps and not as photons
// are.
#pragma once

#include <span>

#include <shoal/gl/device.h>
#include <shoal/gl/objects.h>
#include <shoal/gl/program.h>
#include <shoal/water/photons.h>

namespace shoal::water {

class SplitPhotons {
public:
    static Result<SplitPhotons> create(gl::Device& device, const PhotonSetup& setup);

    // Where a slot's photons can be parted at all, and where something above the water can be in their way.
    struct Job {
        LightSlot slot;
        float cellM = 0;       // of the photons
        double airShiftM = 0;  // how far waves shift at most where light comes through the air
    };
    // Finds that out for all slots; none of them has more cells than `cells`. Bound before: light space.
    void measure(std::span<const Job> jobs, std::int64_t cells);
    // Empties the list and leaves bound what photon_deposit.comp reads and lists in.
    void begin();
    // Parts what was listed: `program` is photon_split.comp's, its uniforms set.
    void lay(const gl::Program& program) const;

    std::int64_t bytes() const { return std::int64_t(list_.bytes() + blockEnds_.bytes() + relief_.bytes()); }

private:
    gl::Device* device_ = nullptr;
    int blocks_ = 0;                      // of 4 x 4 texels, a side of a map
    const gl::Program* measure_[3] = {};  // blocks; with those beside, before and behind
    gl::Buffer list_, blockEnds_, relief_;
};

}  // namespace shoal::water
