// The water surface as it is seen: from above, from below and across. It finds each pixel's path through the water, and
// composes reflection, refraction, absorption and in-scattered light.
#pragma once

#include <memory>
#include <span>

#include <shoal/core/params.h>
#include <shoal/frame/context.h>
#include <shoal/frame/targets.h>
#include <shoal/water/body.h>

namespace shoal::water {

// The [water.surface] table.
struct SurfaceParams {
    bool reflections = true;
    float reflectionScale = 0.5f;
    float roughness = 0;
    bool foam = false;
    float foamDepth = 0.4f;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, SurfaceParams>
void visit(P& p, V&& v) {
    v(p.reflections, Field{"reflections", "", -1e30, 1e30, "whether things are mirrored, not the sky alone"});
    v(p.reflectionScale, Field{"reflectionScale", "", 0.1, 1,
                               "size of the mirrored picture to the picture's; what lies in water has twice that"});
    v(p.roughness, Field{"roughness", "", 0, 0.5, "slope of ripples too small for the waves (rms)"});
    v(p.foam, Field{"foam", "", -1e30, 1e30, "a line of foam where the water is shallow"});
    v(p.foamDepth, Field{"foamDepth", "m", 0.01, 10, "depth of water where foam begins"});
}

// Each pixel's way through the water; owned by Surface, full size of the view. paths.io.glsl reads them:
// WaterPath waterPathOf(vec2 pixel) gives start, direction, length.
struct WaterPaths {
    // R32F: view-axis distance to the first water surface in front of opaque ones, 0: none. Positive: the eye's ray
    // enters the water there, negative: it leaves it.
    gl::TextureView surfaceDepth;
    gl::TextureView surfaceNormal;  // RG16 octahedral, world, upwards
    // RGBA16F: xy from the pixel to the place in the picture (of its size) where the opaque surface at the end of the
    // path is seen (not 0 where the ray is bent), z: metres in water, w: 1 where the path begins at the eye, down to -1
    // where a bent ray ends beyond the picture's border or behind something: xy and z are guesses there. w: -2 where
    // the view along bent rays shows what is met, and the picture was not searched: xy is 0.
    gl::TextureView path;
};

// What the pipeline drew for the surface; host-owned.
struct SurfaceInputs {
    gl::TextureView radiance;   // RGBA16F, of the opaque scene under and above the water, without the water's media
    gl::TextureView viewDepth;  // R32F
    gl::TextureView inscatter;  // RGBA16F, of Shafts; may be empty
    // Of each needed view (same order as neededViews()): lit radiance and view depth. Empty: sky only.
    struct Mirror {
        light::View view;
        gl::TextureView radiance, viewDepth;
    };
    std::span<const Mirror> mirrors;
};

class Surface {
public:
    static Result<Surface> create(gl::Device& device);
    Surface(Surface&&) noexcept;
    Surface& operator=(Surface&&) noexcept;
    ~Surface();

    // Chooses the views that reflection and the window upwards need: colour views, to be shaded like the picture and
    // clipped to clipPlane's positive side. At most 3.
    struct MirrorView {
        light::View view;
        Vec4 clipPlane;           // world: dot(clipPlane, (p, 1)) >= 0 is drawn
        bool underWater = false;  // shows what is under water (its light is the water's)
    };
    void prepare(const frame::Context& context, const SurfaceParams& params, const Body& body,
                 const Bounds& sceneBounds);
    std::span<const MirrorView> neededViews() const;
    // What was drawn of them (same order), before trace(): bent rays are followed in it. Without it, and where it is
    // empty, on the screen alone.
    void useMirrors(std::span<const SurfaceInputs::Mirror> mirrors);

    // Draws the surface of this sample and finds every pixel's path. viewDepth: of the opaque surfaces; depth: D32F of
    // the same, reversed z, only read. Lighting::prepare() of this context and Lighting::bind() must have been called
    // (the pixels' rays).
    void trace(const frame::Context& context, const SurfaceParams& params, const Body& body, gl::TextureView viewDepth,
               gl::TextureView depth);
    WaterPaths paths() const;

    // Draws the picture with water, every pixel of it, into the bound framebuffer (radiance; not inputs.radiance).
    // Lighting::bind() must have been called (sky, sun). Radiance is dimmed as the sharp beam is, by
    // Optics::beamAttenuation(). Fills transmittance() and waterDepth() too when terms are wanted.
    void compose(const frame::Context& context, const SurfaceParams& params, const Body& body, const BodyLights& lights,
                 const SurfaceInputs& inputs);
    void setTermsWanted(bool wanted);
    gl::TextureView transmittance() const;  // RGBA16F: fraction of the opaque surface's radiance that reaches the eye
    gl::TextureView waterDepth() const;  // R32F: metres of water above the first opaque surface, 0 where there is none
    frame::Stats stats() const;

    struct State;

private:
    explicit Surface(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::water
