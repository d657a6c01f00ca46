#include "water/shafts/shaft_block.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace shoal::water {
namespace {

constexpr float kFirstScale = 0.5f;     // metres: down to here slices lie about evenly, below exponentially
constexpr float kLeastDeepest = 8;      // metres
constexpr float kOpticalDepth = 7;      // of the clearest channel, below which no light is worth tracing
constexpr float kMostLight = 16;        // shaft_photons.comp
constexpr float kSpreadM = 1.5f;        // metres: smooth light evens out over this much at least
constexpr float kWidestRim = 1.0f / 8;  // of a square

// Slices of a slot keep a multiple of 8 texels a side, whichever number of photons is asked for.
struct Lattice {
    int side = 0, perTexel = 1;
};
Lattice latticeOf(int photons, int slots, int largest) {
    const double wanted = std::sqrt(double(photons) / std::max(slots, 1));
    Lattice l;
    l.side = std::clamp(int(wanted) / 8 * 8, 16, largest);
    l.perTexel = std::max(int(wanted / l.side), 1);
    return l;
}

// Seen from the water, an eye in the air stands higher: by the index, for what is straight below [Snell].
Vec3 apparentEye(const Body& body, Vec3 eye) {
    const float above = eye.y - body.params.level;
    if (above > 0) eye.y = body.params.level + above * body.optics.index;
    return eye;
}

}  // namespace

ShaftPlan makeShaftPlan(const ShaftSetup& setup, const ShaftParams& params, const Body& body,
                        std::span<const LightSlot> slots, const frame::Context& context) {
    const float level = body.params.level;
    ShaftPlan plan;
    ShaftBlock& block = plan.block;
    std::vector<std::size_t> sun, lamps;
    float deepest = kLeastDeepest;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (slots[i].reflected) continue;
        std::vector<std::size_t>& to = slots[i].light < 0 ? sun : lamps;
        const std::size_t most =
            slots[i].light < 0 ? SHOAL_SUN_SHAFT_SLOTS : SHOAL_MAX_SHAFT_SLOTS - SHOAL_SUN_SHAFT_SLOTS;
        if (to.size() == most) continue;
        to.push_back(i);
        deepest = std::max(deepest, level - slots[i].bottom);
    }
    const Vec3 beam = body.optics.beamAttenuation();
    const float clearest = std::min({beam.x, beam.y, beam.z});
    if (clearest > 0) deepest = std::min(deepest, std::max(kOpticalDepth / clearest, 1.0f));

    const Lattice lattice = latticeOf(params.photons, int(sun.size() + lamps.size()), setup.resolution);
    block.grid = {float(lattice.side), float(setup.slices), float(lattice.perTexel), float(lamps.size())};
    const std::uint32_t octaves = std::bit_cast<std::uint32_t>(1 + deepest / kFirstScale) - 0x3f800000u;
    const float rate = float(octaves) / float(setup.slices - 1);
    block.depths = {kFirstScale, rate, 1 / rate, deepest};
    // All photons of a slot in one texel, each as bright as it may be, and the rounding of each by a unit.
    const double photons = double(lattice.side) * lattice.side * lattice.perTexel * lattice.perTexel;
    const double units = (4294967295.0 - 4 * photons) / (double(lattice.side) * lattice.side * kMostLight);
    block.units = {float(std::floor(units * 0.999)), 0, 0, 0};
    block.units.y = 1 / block.units.x;
    const Vec3 eye = apparentEye(body, context.view.eye);
    block.eye = {eye.x, eye.y, eye.z, 0};

    for (Vec4& rim : block.rims) rim = {-1, 0, 0, 0};
    const auto place = [&](std::size_t i, std::size_t at) {
        const LightSlot& slot = slots[i];
        const double width = double(slot.texel) * setup.viewResolution, texel = width / lattice.side;
        block.slots[at] = {float(std::round(slot.origin.x / texel) * texel),
                           float(std::round(slot.origin.y / texel) * texel), float(1 / texel), float(i)};
        const float rim = std::min(slot.margin / float(texel), kWidestRim * float(lattice.side));
        block.rims[at] = {0.5f * float(lattice.side) - 1, rim / std::max(level - slot.bottom, 1.0f), 0, 0};
    };
    for (std::size_t i = 0; i < sun.size(); ++i) place(sun[i], i);
    // Of the slots placed, the finest whose cells are wide enough; else the widest.
    int widest = int(sun.size()) - 1, open = 0;
    while (open < widest && block.slots[open].z * kSpreadM > float(lattice.side) / SHOAL_SHAFT_OPEN_CELLS) ++open;
    block.small.y = float(open);
    for (std::size_t i = 0; i < lamps.size(); ++i) place(lamps[i], SHOAL_SUN_SHAFT_SLOTS + i);
    plan.side = lattice.side, plan.cells = lattice.side * lattice.perTexel, plan.sunSlots = int(sun.size()),
    plan.lampSlots = int(lamps.size());
    return plan;
}

}  // namespace shoal::water
