// The method of [Papadopoulos & Papaioannou 2010], as printed: the baseline that Shoal's own method is measured
// against.
#pragma once

#include <memory>
#include <span>

#include <shoal/core/params.h>
#include <shoal/frame/context.h>
#include <shoal/water/body.h>
#include <shoal/water/photons.h>

namespace shoal::water {

// The [water.paper] table; section numbers are the paper's.
struct PaperParams {
    int causticGrid = 200, godrayGrid = 100;          // points a side before the x4 refinement (4.1)
    float causticScale = 0.64f, godrayScale = 0.16f;  // of the window's height: 512 and 128 of 800 (4.1)
    float smallestPointPx = 5, largestPointPx = 20;   // 4.1
    float lineWidthPx = 3;                            // at most 12
    float attenuation = 0.13f;                        // gamma, 1/m (4.1)
    float intensity = 9.2f;                           // W/sr (4.1)
    float anisotropy = 0.5f;                          // of the simplified Henyey-Greenstein function
    float gain = 1;                                   // one factor for its mixed units
    bool filter = true;                               // the low-pass filter with a rotating kernel (3.5)
    bool waterMask = true;                            // 3, step 2b
    int newtonSteps = 5;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, PaperParams>
void visit(P& p, V&& v) {
    v(p.causticGrid, Field{"causticGrid", "", 10, 4000, "photons a side for caustics, before each becomes four"});
    v(p.godrayGrid, Field{"godrayGrid", "", 10, 4000, "photons a side for god rays, before each becomes four"});
    v(p.causticScale, Field{"causticScale", "", 0.01, 1, "caustic buffer to the picture's height"});
    v(p.godrayScale, Field{"godrayScale", "", 0.01, 1, "god ray buffer to the picture's height"});
    v(p.smallestPointPx, Field{"smallestPointPx", "px", 1, 64, "size of points far away"});
    v(p.largestPointPx, Field{"largestPointPx", "px", 1, 64, "size of points at the near plane"});
    v(p.lineWidthPx, Field{"lineWidthPx", "px", 1, 12, "width of god rays"});
    v(p.attenuation, Field{"attenuation", "1/m", 0, 100, "gamma of both attenuations"});
    v(p.intensity, Field{"intensity", "W/sr", 0, 1e6, "of the light"});
    v(p.anisotropy, Field{"anisotropy", "", -0.99, 0.99, "of the simplified Henyey-Greenstein function"});
    v(p.gain, Field{"gain", "", 0, 1e6, "factor on both effects"});
    v(p.filter, Field{"filter", "", -1e30, 1e30, "the low-pass filter with a rotating kernel"});
    v(p.waterMask, Field{"waterMask", "", -1e30, 1e30, "photons that do not meet water are left out"});
    v(p.newtonSteps, Field{"newtonSteps", "", 1, 50, "of the image-space intersection"});
}

class PaperMethod {
public:
    static Result<PaperMethod> create(gl::Device& device);
    PaperMethod(PaperMethod&&) noexcept;
    PaperMethod& operator=(PaperMethod&&) noexcept;
    ~PaperMethod();

    // The light's view (3.1): follows the camera for the sun, stands still for a lamp.
    void prepare(const frame::Context& context, const PaperParams& params, const Body& body, const BodyLights& lights,
                 const Bounds& sceneBounds);
    std::span<frame::NeededView> neededViews();  // the shadow map; the water mask is its own
    // Points, lines, filters (3.3 to 3.5) in screen space.
    void render(const frame::Context& context, const PaperParams& params, const Body& body, const BodyLights& lights,
                const ReceiverInputs& receivers, gl::TextureView depth);
    // Brings the buffers to full size: `direct` as Photons::resolve fills it, `inscatter` as Shafts::march does.
    void compose(const frame::Context& context, const PaperParams& params, const ReceiverInputs& receivers,
                 const IrradianceOutputs& outputs, gl::TextureView inscatter);
    gl::TextureView caustics() const;  // RGBA16F, filtered
    gl::TextureView godrays() const;   // RGBA16F, filtered
    frame::Stats stats() const;

    struct State;

private:
    explicit PaperMethod(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::water
