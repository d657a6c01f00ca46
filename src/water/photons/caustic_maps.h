// Makes the maps of caustics: a slot's photons laid down as sums of integers, blurred by the light's disc, with mips.
#pragma once

#include <span>

#include <shoal/gl/device.h>
#include <shoal/gl/objects.h>
#include <shoal/gl/program.h>
#include <shoal/water/photons.h>

#include "water/photons/emission.h"
#include "water/photons/split_photons.h"

namespace shoal::water {

// What photon.io.glsl leaves out.
enum class PhotonVariant { plain, air, lowSun, lamp, count };

// A slot's photons and the bounds that keep their sums from running over.
struct PhotonJob {
    int index = 0;  // of the slot
    LightSlot slot;
    int photons = 0;
    PhotonVariant variant = PhotonVariant::lamp;
    BodyParams body;
    double mostFlux = 4;   // of a photon, in units of the slot's irradiance a m2 of level plane
    double mostLeft = 1;   // of a photon, over what level water leaves of one
    double airShiftM = 0;  // how far waves shift at most where its light comes through the air
};

class CausticMaps {
public:
    static Result<CausticMaps> create(gl::Device& device, const PhotonSetup& setup);

    // Of all slots of a frame, before make; none has more than `photons`. Bound before: light space.
    void prepare(const frame::Context& context, std::span<const PhotonJob> jobs, int photons);
    // Bound before: blocks of the water, its waves and light space. Returns how many photons there were.
    std::int64_t make(const frame::Context& context, const PhotonJob& job);

    const gl::Texture& maps() const { return maps_; }             // Photons::maps()
    int mipLevels() const { return mipLevels_; }                  // of them
    const gl::Buffer& secondUsed() const { return secondUsed_; }  // a word a slot: not 0 where its second layer is lit
    std::int64_t bytes() const;

private:
    // Sums a texel of the maps: `fine` x `fine`; two layers, a word that says whether the second layer and whether
    // the coarse sums hold anything, then those: for footprints too large for texels.
    struct Sums {
        int fine = 1, side = 0;
        int flags = 0, first[2] = {}, sides[2] = {}, words = 0;
    };
    Sums sumsFor(int fine) const;
    int fineFor(double disc, double cellTexels) const;
    void deposit(const frame::Context& context, const PhotonJob& job, const Sums& sums, const EmissionLattice& lattice);
    void resolve(const frame::Context& context, const PhotonJob& job, const Sums& sums, double disc);

    class Passes;
    void blur(Passes& passes, int index, const Sums& sums, double disc);
    void addMips(Passes& passes, bool sharp, int firstLayer, int side, int levels);

    PhotonSetup setup_;
    const gl::Program* deposit_[std::size_t(PhotonVariant::count)] = {};
    const gl::Program* depositSplit_[std::size_t(PhotonVariant::count)] = {};
    SplitPhotons split_;
    const gl::Program *resolve_[2] = {}, *mips_[2] = {};  // into maps, into the sharp map
    const gl::Program* blur_[2] = {};                     // along x, along z
    const gl::Program *round_ = nullptr, *disc_ = nullptr, *layers_ = nullptr, *spread_ = nullptr;
    gl::Buffer sums_;      // of one slot at a time
    gl::Buffer commands_;  // work groups of the passes after the deposit, for one layer or two
    gl::Buffer secondUsed_;
    gl::Texture sharp_;  // two layers on their way to the maps
    gl::Texture maps_;
    int mostFine_ = 1, mipLevels_ = 1;
};

}  // namespace shoal::water
