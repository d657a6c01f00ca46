// Where light goes under (and, mirrored, above) a water surface, seen from the light: for each light a few square
// cascades in light space, with the depth of what is lit.
//
// Light space of a light: a point P is slid along the light's MEAN refracted direction (through level water) onto the
// level plane; (x, z) there are its coordinates, in metres of the world. A parallel light slides along one direction, a
// lamp above the water along lines from its apparent place (its height times the index: paraxial). Cascades are squares
// there, snapped to their texels in the world: they do not move with the eye by less than a texel, and what falls on a
// texel does not depend on the eye.
#pragma once

#include <memory>
#include <span>

#include <shoal/core/result.h>
#include <shoal/frame/context.h>
#include <shoal/water/body.h>

namespace shoal::water {

struct LightViewSetup {
    int resolution = 512;  // texels a side of a cascade: depth and irradiance alike
    int maxSlots = 6;      // cascades of all lights together, reflected ones included
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, LightViewSetup>
void visit(P& p, V&& v) {
    v(p.resolution, Field{"resolution", "", 64, 8192, "texels a side of each map of light, a power of two"});
    v(p.maxSlots, Field{"maxSlots", "", 1, 8, "maps of all lights together"});
}

struct LightViewParams {
    float distance = 60;    // metres from the eye
    int cascades = 3;       // of the sun
    bool reflected = true;  // light thrown up by the surface
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, LightViewParams>
void visit(P& p, V&& v) {
    v(p.distance, Field{"distance", "m", 1, 2000, "how far from the eye light in water is traced"});
    v(p.cascades,
      Field{"cascades", "", 1, 4, "maps of the sun's light, each twice to four times as wide as the one before"});
    v(p.reflected, Field{"reflected", "", -1e30, 1e30, "whether the surface throws light up at hulls and ceilings"});
}

// One square map of one light.
struct LightSlot {
    int light = -1;             // -1: the sun, else index into BodyLights::punctual
    bool reflected = false;     // of the light that the surface reflects upwards
    int cascade = 0;            // 0 the finest of its light
    Vec2 origin;                // metres, light space: corner of texel (0, 0)
    float texel = 0;            // metres a side of a texel
    Vec4 source;                // w 0: unit vector towards the (apparent) light; w 1: its apparent place
    float top = 0, bottom = 0;  // heights that the depth maps reach between (world y)
    float discRadius = 0;       // metres that the light's size blurs by at the far end of the depth maps
    float margin = 0;           // metres beyond the square that light which ends in it may start
};

class LightViews {
public:
    static Result<LightViews> create(gl::Device& device, const LightViewSetup& setup);
    LightViews(LightViews&&) noexcept;
    LightViews& operator=(LightViews&&) noexcept;
    ~LightViews();

    // Chooses the slots for this eye. sceneBounds: world box of all that casts or receives.
    void prepare(const frame::Context& context, const LightViewParams& params, const Body& body,
                 const BodyLights& lights, const Bounds& sceneBounds);
    // Depth to draw after prepare: two layers (the second peeled) of what is below the water a slot (above it for
    // reflected ones), and one of what is above it, along the light's own direction. Purpose::photonDepth.
    std::span<frame::NeededView> neededViews();
    std::span<const LightSlot> slots() const;
    // Whether anything of the scene may stand between light and water (the air layers are drawn).
    bool airDrawn() const;
    // Binds SHOAL_BLOCK_LIGHT_SPACE and the depth textures that light_space.io.glsl names.
    void bind() const;

    struct State;

private:
    explicit LightViews(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::water
