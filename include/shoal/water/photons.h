// Caustics: photons traced from the light through the wave field to what they hit, their flux deposited over their
// footprints into world-anchored maps, and looked up for every pixel. Shoal's own method.
#pragma once

#include <memory>

#include <shoal/core/params.h>
#include <shoal/frame/context.h>
#include <shoal/water/body.h>
#include <shoal/water/light_views.h>

namespace shoal::water {

struct PhotonSetup {
    int resolution = 512;  // the LightViews' resolution
    int maxSlots = 6;
};

// The [water.caustics] table (beside LightViewParams).
struct PhotonParams {
    std::string method = "shoal";  // "shoal", "paper", "none"
    int photons = 160000;          // a light and frame
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, PhotonParams>
void visit(P& p, V&& v) {
    v(p.method,
      Field{"method", "", -1e30, 1e30, "how light on surfaces under water is found", {"shoal", "paper", "none"}});
    v(p.photons, Field{"photons", "", 1000, 16000000, "light paths a frame"});
}

// What a pixel's surface is; host-owned, only read.
struct ReceiverInputs {
    gl::TextureView viewDepth;  // R32F, metres along the view axis, 0: nothing
    gl::TextureView normal;     // octahedral world normal in [0, 1], or empty: taken from the depth
};
// Host-owned, of the receivers' size, RGBA16F.
struct IrradianceOutputs {
    // rgb: W/m2 on the surface's own plane by the sun and lamps above the water, through (or reflected up by) the
    // surface; a: how much of the host's own direct light of those lights it replaces (1 under water, 0 above).
    gl::TextureView direct;
    // rgb: W/m2 / pi of the sky and of scattered sunlight under water; a: how much of the host's own sky light it
    // replaces. May be empty.
    gl::TextureView ambient;
};

class Photons {
public:
    static Result<Photons> create(gl::Device& device, const PhotonSetup& setup);
    Photons(Photons&&) noexcept;
    Photons& operator=(Photons&&) noexcept;
    ~Photons();

    // Traces the photons of every slot into the maps. After the views of `views` are drawn, once a frame.
    void render(const frame::Context& context, const PhotonParams& params, const Body& body, const BodyLights& lights,
                const LightViews& views);
    // Looks the maps up for a view; once a sample. Only what lies within `context.view`.
    void resolve(const frame::Context& context, const Body& body, const BodyLights& lights, const LightViews& views,
                 const ReceiverInputs& inputs, const IrradianceOutputs& outputs);

    // RG32F array, two layers a slot (2 slot + layer). r: irradiance on a level plane in units of the light's
    // irradiance on a plane facing it (lamps: of that right below them on the level), over what level water leaves of
    // the channel that is dimmed least there. g: world y of what has it (not kept for a second layer that is dark). A
    // map is as wide as high; above it, in rows from its width on, lie its mips from left to right.
    gl::TextureView maps() const;
    frame::Stats stats() const;

    struct State;

private:
    explicit Photons(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::water
