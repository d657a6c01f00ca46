// God rays: irradiance in slices of light space, marched along each pixel's path through the water.
#pragma once

#include <memory>

#include <shoal/core/params.h>
#include <shoal/frame/context.h>
#include <shoal/water/body.h>
#include <shoal/water/light_views.h>
#include <shoal/water/surface.h>

namespace shoal::water {

struct ShaftSetup {
    int resolution = 256;      // texels a side of a slice, at most: few photons fill fewer
    int slices = 10;           // of a slot, exponential in depth
    int viewResolution = 512;  // the LightViews' resolution
};

// The [water.shafts] table.
struct ShaftParams {
    bool enabled = true;
    int photons = 40000;
    int steps = 16;
    float resolutionScale = 0.25f;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, ShaftParams>
void visit(P& p, V&& v) {
    v(p.enabled, Field{"enabled", "", -1e30, 1e30, "whether water scatters light towards the eye"});
    v(p.photons, Field{"photons", "", 1000, 16000000, "light paths a frame"});
    v(p.steps, Field{"steps", "", 4, 256, "along each pixel's path"});
    v(p.resolutionScale, Field{"resolutionScale", "", 0.1, 1, "of the picture's size"});
}

// Host-owned, full size. RGBA16F: W/(m2 sr) in-scattered on the way to the eye (sun, lamps in and above the water, and
// the smooth light of the scattered sky), already dimmed along the path.
struct ShaftOutputs {
    gl::TextureView inscatter;
};

class Shafts {
public:
    static Result<Shafts> create(gl::Device& device, const ShaftSetup& setup);
    Shafts(Shafts&&) noexcept;
    Shafts& operator=(Shafts&&) noexcept;
    ~Shafts();

    // Traces the photons into the slices; once a frame, after the views of `views` are drawn. context: of the eye that
    // sees most of it (photons are weighed by how much of them turns to it). Slices are multiples of what level water
    // lets through, without attenuation; outside of all slots and below the last slice that is taken to go on.
    void render(const frame::Context& context, const ShaftParams& params, const Body& body, const BodyLights& lights,
                const LightViews& views);
    // Marches every pixel's path and brings the result to full size. Lighting::prepare() of this view and bind() must
    // have been called (its rays, the lamps in the water), and Shadows::bind() where such a spot casts shadows. `paths`
    // may be empty: straight paths below the level. Radiance is that in the water, at the path's start.
    void march(const frame::Context& context, const ShaftParams& params, const Body& body, const BodyLights& lights,
               const LightViews& views, const WaterPaths& paths, gl::TextureView viewDepth,
               const ShaftOutputs& outputs);
    frame::Stats stats() const;

    struct State;

private:
    explicit Shafts(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::water
