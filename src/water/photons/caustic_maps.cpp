// [Papadopoulos & Papaioannou 2010] draw photons as points of a fixed size; here each is laid over its own footprint
// (photon_deposit.comp) in maps that stand still in the world.
#include "water/photons/caustic_maps.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "water/bindings.shared.h"
#include "water/light_space.shared.h"

namespace shoal::water {
namespace {

constexpr int kMipLevels = 3;  // squares begin at multiples of 8 texels
constexpr int kSharpLevels = 6;
constexpr std::size_t kMostPasses = 3 + kSharpLevels + kMipLevels;  // of one slot after the deposit
// Radius of the light's disc at the far end of the slot, texels of the maps: smaller ones are not seen beside a texel.
constexpr double kSeenDisc = 0.6;
// Others are about as many sums in radius, or their blur depends on where sums begin (on P6 a radius of .9 sums leaves
// 12 % of error, 1.8 sums 2 %, 2.7 sums 1 %). Where photons are kSparse texels apart or more, 2 x 2 sums a texel will
// do: their footprints are the larger error. Up to kWidestRow rows are blurred, then columns; wider ones go by mips.
constexpr double kDiscSums = 2.7, kSparse = 2, kWidestRow = 4.5;
// Texels a side of maps that may have 3 x 3 and 2 x 2 sums a texel.
constexpr int kFinestMap = 512, kLargestFineMap = 1024;

// Texels in height of a map with its mips in a row above it.
int shelved(int side) { return side + side / 2; }

int levelsFor(double radius) {
    return std::clamp(1 + int(std::floor(std::log2(std::max(radius, 1.0)))), 1, kSharpLevels);
}

using Defines = std::vector<std::pair<std::string, std::string>>;

}  // namespace

// The passes after the deposit, in order: each covers `width` x `height` threads of one layer or two.
class CausticMaps::Passes {
public:
    explicit Passes(CausticMaps& maps) : maps_(maps) {}

    void add(const gl::Program& program, int width, int height, std::function<void()> bind) {
        const auto groups = [&](int count, int axis) {
            return std::uint32_t((count + program.localSize(axis) - 1) / program.localSize(axis));
        };
        passes_[count_] = {&program, std::move(bind)};
        words_[3 * count_] = groups(width, 0), words_[3 * count_ + 1] = groups(height, 1), words_[3 * count_ + 2] = 2;
        ++count_;
    }
    void run(int flags, int slot) {
        maps_.commands_.writeAll(std::span<const std::uint32_t>(words_));
        maps_.sums_.bindStorage(SHOAL_STORAGE_WATER);
        maps_.commands_.bindStorage(SHOAL_STORAGE_WATER + 1);
        maps_.secondUsed_.bindStorage(SHOAL_STORAGE_WATER + 2);
        glProgramUniform3i(maps_.layers_->name(), 0, flags, int(count_), slot);
        maps_.layers_->dispatch(1);
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, maps_.commands_.name());
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
    CausticMaps& maps_;
    std::size_t count_ = 0;
    std::array<Pass, kMostPasses> passes_;
    std::array<std::uint32_t, 3 * kMostPasses> words_{};
};

Result<CausticMaps> CausticMaps::create(gl::Device& device, const PhotonSetup& setup) {
    CausticMaps m;
    m.setup_ = setup;
    const auto get = [&](const char* file, Defines defines, const char* label) {
        return device.programs().get({{file}, std::move(defines), label});
    };
    const Defines variants[] = {{{"NO_LAMPS", ""}, {"NO_WAVE_SHADOWS", ""}, {"NO_AIR", ""}},
                                {{"NO_LAMPS", ""}, {"NO_WAVE_SHADOWS", ""}},
                                {{"NO_LAMPS", ""}},
                                {}};
    for (std::size_t i = 0; i < std::size(variants); ++i) {
        SHOAL_TRY_ASSIGN(m.deposit_[i], get("water/photon_deposit.comp", variants[i], "photon deposit"));
        SHOAL_TRY_ASSIGN(m.depositSplit_[i], get("water/photon_split.comp", variants[i], "photon split"));
    }
    SHOAL_TRY_ASSIGN(m.split_, SplitPhotons::create(device, setup));
    for (int i = 0; i < 2; ++i) {
        const Defines sharp = i ? Defines{{"SHARP", ""}} : Defines{}, along = i ? Defines{{"ALONG_Z", ""}} : Defines{};
        SHOAL_TRY_ASSIGN(m.resolve_[i], get("water/caustic_resolve.comp", sharp, "caustic resolve"));
        SHOAL_TRY_ASSIGN(m.mips_[i], get("water/caustic_mips.comp", sharp, "caustic mips"));
        SHOAL_TRY_ASSIGN(m.blur_[i], get("water/caustic_blur.comp", along, "caustic blur"));
    }
    SHOAL_TRY_ASSIGN(m.disc_, get("water/caustic_disc.comp", {}, "caustic disc"));
    SHOAL_TRY_ASSIGN(m.round_, get("water/caustic_round.comp", {}, "caustic round"));
    SHOAL_TRY_ASSIGN(m.layers_, get("water/caustic_layers.comp", {}, "caustic layers"));
    SHOAL_TRY_ASSIGN(m.spread_, get("water/caustic_spread.comp", {}, "caustic spread"));

    m.mipLevels_ = setup.resolution % (1 << (kMipLevels - 1)) == 0 ? kMipLevels : 1;
    m.mostFine_ = setup.resolution <= kFinestMap ? 3 : setup.resolution <= kLargestFineMap ? 2 : 1;
    gl::TextureDesc desc;
    desc.target = GL_TEXTURE_2D_ARRAY;
    desc.format = GL_RG32F;
    desc.width = setup.resolution, desc.height = shelved(setup.resolution);
    desc.layers = 2 * setup.maxSlots;
    desc.label = "caustic maps";
    m.maps_ = gl::Texture::create(device, desc);
    desc.format = GL_R32F;
    desc.height = shelved(setup.resolution);
    desc.layers = 2;
    desc.label = "caustics before blur";
    m.sharp_ = gl::Texture::create(device, desc);
    const auto words = [](int count) { return std::size_t(count) * sizeof(std::uint32_t); };
    m.sums_ = gl::Buffer::create(device, words(m.sumsFor(m.mostFine_).words), "photon deposits");
    m.commands_ = gl::Buffer::create(device, words(3 * kMostPasses), "caustic work groups");
    m.secondUsed_ = gl::Buffer::create(device, words(SHOAL_MAX_LIGHT_SLOTS), "layers that hold light");
    if (!m.maps_ || !m.sharp_ || !m.sums_ || !m.commands_ || !m.secondUsed_)
        return internalError("no memory for caustic maps");
    m.secondUsed_.clear(0);
    return m;
}

int CausticMaps::fineFor(double disc, double cellTexels) const {
    if (disc < kSeenDisc) return 1;
    return std::clamp(int(std::lround(kDiscSums / disc)), 1, cellTexels < kSparse ? mostFine_ : std::min(mostFine_, 2));
}

CausticMaps::Sums CausticMaps::sumsFor(int fine) const {
    Sums sums;
    sums.fine = fine, sums.side = setup_.resolution * fine;
    sums.flags = 2 * sums.side * sums.side;
    sums.words = sums.flags + 1;
    for (int i = 0; i < 2; ++i) {
        // Cells of the world's own grid: one more than fit where the square does not begin at one.
        sums.sides[i] = sums.side / (i == 0 ? 8 : 64) + 1;
        sums.first[i] = sums.words;
        sums.words += 2 * sums.sides[i] * sums.sides[i];
    }
    return sums;
}

void CausticMaps::prepare(const frame::Context& context, std::span<const PhotonJob> jobs, int photons) {
    const gl::PassScope pass(context.timer, "caustic photons");
    std::array<SplitPhotons::Job, SHOAL_MAX_LIGHT_SLOTS> parts;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const PhotonJob& job = jobs[i];
        const EmissionLattice lattice = emissionLattice(job.slot, setup_.resolution, job.photons, job.body);
        parts[i] = {job.slot, lattice.cellM, job.airShiftM};
    }
    // A lattice has one cell more a side where its square begins within one.
    const auto side = std::int64_t(std::ceil(std::sqrt(double(photons)))) + 2;
    split_.measure(std::span(parts).first(jobs.size()), side * side);
}

std::int64_t CausticMaps::make(const frame::Context& context, const PhotonJob& job) {
    const double disc = double(job.slot.discRadius) / double(job.slot.texel);
    const EmissionLattice lattice = emissionLattice(job.slot, setup_.resolution, job.photons, job.body);
    const Sums sums = sumsFor(fineFor(disc, double(lattice.cellM) / double(job.slot.texel)));
    deposit(context, job, sums, lattice);
    resolve(context, job, sums, disc);
    return std::int64_t(lattice.countX) * lattice.countZ;
}

void CausticMaps::deposit(const frame::Context& context, const PhotonJob& job, const Sums& sums,
                          const EmissionLattice& lattice) {
    const gl::PassScope pass(context.timer, "caustic photons");
    const LightSlot& slot = job.slot;
    const double texelsPerM = sums.fine / double(slot.texel), cellTexels = double(lattice.cellM) * texelsPerM;
    // All of the slot's flux in one texel still fits, with room for the rounding of each photon.
    const double most = std::max(double(lattice.countX) * double(lattice.countZ), 1.0) *
                        (cellTexels * cellTexels * job.mostFlux * job.mostLeft);
    const double units = std::exp2(std::floor(std::log2(0.98 * 4294967296.0 / most)));

    const GLuint zero = 0;
    glClearNamedBufferSubData(sums_.name(), GL_R32UI, 0, GLsizeiptr(sizeof(GLuint)) * sums.words, GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &zero);
    const auto corner = [&](float origin) { return int(std::floor(double(origin) * texelsPerM + 0.5)); };
    const int cornerX = corner(slot.origin.x), cornerZ = corner(slot.origin.y);
    const gl::Program &whole = *deposit_[std::size_t(job.variant)], &split = *depositSplit_[std::size_t(job.variant)];
    for (const gl::Program* p : {&whole, &split}) {
        p->set(0, job.index);
        p->set(1, Vec4{float(lattice.firstX), float(lattice.firstZ), float(lattice.countX), float(lattice.countZ)});
        p->set(2, Vec4{lattice.cellM, float(texelsPerM), float(units * cellTexels * cellTexels), float(sums.side)});
        p->set(3, Vec4{float(cornerX), float(cornerZ), float(job.mostFlux), float(job.mostLeft)});
    }
    for (const gl::Program* p : {&whole, &split, spread_})
        glProgramUniform4i(p->name(), 4, sums.first[0], sums.sides[0], sums.first[1], sums.sides[1]);
    glProgramUniform3i(spread_->name(), 0, sums.side, cornerX & 63, cornerZ & 63);
    if (lattice.countX > 0 && lattice.countZ > 0) {
        split_.begin();
        sums_.bindStorage(SHOAL_STORAGE_WATER);
        whole.dispatch(lattice.countX, lattice.countZ);
        split_.lay(split);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    for (const gl::Program* p : {resolve_[0], resolve_[1], blur_[0], round_}) p->set(1, float(1 / units));
}

void CausticMaps::resolve(const frame::Context& context, const PhotonJob& job, const Sums& sums, double disc) {
    const gl::PassScope pass(context.timer, "caustic maps");
    Passes passes(*this);
    // The first: left out where there are no coarse sums (caustic_layers.comp).
    passes.add(*spread_, sums.side, sums.side, [] {});
    if (disc >= kSeenDisc) {
        blur(passes, job.index, sums, disc);
        addMips(passes, false, 2 * job.index, setup_.resolution, mipLevels_);
    } else {
        passes.add(*resolve_[0], (sums.side + 3) / 4, (sums.side + 3) / 4, [&] {
            gl::bindImage(0, maps_, GL_WRITE_ONLY);
            glProgramUniform4i(resolve_[0]->name(), 0, sums.side, job.index, mipLevels_, 0);
        });
    }
    passes.run(sums.flags, job.index);
}

void CausticMaps::blur(Passes& passes, int index, const Sums& sums, double disc) {
    const int resolution = setup_.resolution;
    if (sums.fine > 1) {
        passes.add(*round_, resolution, resolution, [this, resolution, index, sums] {
            gl::bindImage(0, maps_, GL_WRITE_ONLY);
            glProgramUniform3i(round_->name(), 0, resolution, sums.fine, index);
        });
        return;
    }
    if (disc <= kWidestRow) {
        const auto place = [this, resolution, index](int i) {
            glProgramUniform2i(blur_[i]->name(), 0, resolution, index);
        };
        passes.add(*blur_[0], resolution, resolution, [this, place] {
            gl::bindImage(0, sharp_, GL_WRITE_ONLY);
            place(0);
        });
        passes.add(*blur_[1], resolution, resolution, [this, place] {
            gl::bindTexture(0, sharp_);
            glBindSampler(0, 0);
            gl::bindImage(0, maps_, GL_WRITE_ONLY);
            place(1);
        });
        return;
    }
    // So wide a disc has sums of a texel.
    passes.add(*resolve_[1], resolution, resolution, [this, resolution, index] {
        gl::bindImage(0, sharp_, GL_WRITE_ONLY);
        glProgramUniform4i(resolve_[1]->name(), 0, resolution, index, 1, 0);
    });
    const int levels = levelsFor(disc);
    addMips(passes, true, 0, resolution, levels);
    passes.add(*disc_, resolution, resolution, [this, resolution, index, levels] {
        gl::bindTexture(0, sharp_);
        glBindSampler(0, 0);
        gl::bindImage(0, maps_, GL_WRITE_ONLY);
        glProgramUniform3i(disc_->name(), 0, resolution, index, levels);
    });
}

void CausticMaps::addMips(Passes& passes, bool sharp, int firstLayer, int side, int levels) {
    for (int level = 1; level < levels; ++level)
        passes.add(*mips_[sharp], side >> level, side >> level, [this, sharp, firstLayer, side, level] {
            gl::bindImage(0, sharp ? sharp_ : maps_, GL_READ_WRITE);
            glProgramUniform4i(mips_[sharp]->name(), 0, firstLayer, side, side >> level, 0);
        });
}

std::int64_t CausticMaps::bytes() const {
    std::int64_t bytes = std::int64_t(sums_.bytes()) + split_.bytes();
    for (const gl::Texture* texture : {&maps_, &sharp_, &maps_})  // two numbers a texel of the maps
        bytes += std::int64_t(sizeof(float)) * texture->width() * texture->height() * texture->view().layers;
    return bytes;
}

}  // namespace shoal::water
