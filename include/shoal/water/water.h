// Everything that puts light into water, in one place: for a host that renders its own scene and wants caustics, god
// rays and the colour of water in it. One header, host textures in and out.
//   once        auto water = Water::create(device, setup);
//   each frame  water->prepare(context, params, lights, sceneBounds);
//               draw depth into every one of water->neededViews();
//               water->renderLight(context, params, lights);
//   each view   water->light(context, lights, {viewDepth, normal}, {direct, ambient});
//               radiance = emitted + albedo / pi * (own sun (1 - direct.a) + direct.rgb + ...)
//               water->scatter(context, params, lights, viewDepth, depth, inscatter);
//               picture = radiance * exp(-beamAttenuation * metres in water) + inscatter
// or, for the surface too, water->surface() (surface.h): its compose() does that last line and reflection, refraction.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <shoal/water/gpu_waves.h>
#include <shoal/water/light_views.h>
#include <shoal/water/photons.h>
#include <shoal/water/shafts.h>
#include <shoal/water/surface.h>

namespace shoal::water {

struct WaterSetup {
    BodyParams body;
    OpticsParams optics;
    WaveParams waves;
    std::vector<WaveComponentParams> components;  // waves of kind sum
    std::vector<Image> heightmaps;                // waves of kind heightmap
    LightViewSetup lightViews;                    // its resolution counts for PhotonSetup too
    ShaftSetup shafts;
};

struct WaterParams {
    LightViewParams lightViews;
    PhotonParams photons;
    ShaftParams shafts;
    SurfaceParams surface;
};

class Water {
public:
    static Result<Water> create(gl::Device& device, WaterSetup setup);
    Water(Water&&) noexcept;
    Water& operator=(Water&&) noexcept;
    ~Water();

    // Waves at context.time; which views from the lights this frame needs.
    void prepare(const frame::Context& context, const WaterParams& params, const BodyLights& lights,
                 const Bounds& sceneBounds);
    // To draw before renderLight: depth of all that casts or receives light, or what a view's `unchanged` spares. A
    // view with `peel` may be left cleared by a host that cannot peel: light then stops at the first surface it meets.
    std::span<frame::NeededView> neededViews();
    // Photons into maps and slices.
    void renderLight(const frame::Context& context, const WaterParams& params, const BodyLights& lights);

    // What the water does to the light on the surfaces of a view (Photons::resolve).
    void light(const frame::Context& context, const BodyLights& lights, const ReceiverInputs& receivers,
               const IrradianceOutputs& outputs);
    // Finds the water's surface and every pixel's way through the water (surface().paths()), and fills `inscatter`
    // (RGBA16F, empty: paths only) with what is scattered towards the eye on it. Spots in the water with castsShadow
    // need the frame::Shadows that was prepared with the same lamps to be bound.
    void scatter(const frame::Context& context, const WaterParams& params, const BodyLights& lights,
                 gl::TextureView viewDepth, gl::TextureView depth, gl::TextureView inscatter);

    Body body() const;
    WaveField& waves();
    Surface& surface();
    const Photons& photons() const;
    bool scatters(const WaterParams& params) const;  // whether there is anything in-scattered
    frame::Stats stats() const;

    struct State;

private:
    explicit Water(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::water
