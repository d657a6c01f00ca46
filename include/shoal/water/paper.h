// The method of [Papadopoulos & Papaioannou 2010], as printed: the baseline that Shoal's own method is measured
// against. Photons on a grid in the light's screen space are refracted and met with the shadow map in image space [Shah
// & Konttinen 2007], drawn as points (caustics) and lines (god rays) in the eye's screen space, added up and filtered.
//
// Where the paper leaves something open or cannot be followed:
// 1. The phase function's angle is taken so that its forward lobe points away from the sun (read literally, section 3.4
//    points it at the sun).
// 2. The paper adds watts per steradian to pixels. Here one global gain stands for its mixed units: a photon carries
// its
//    share of the light's power, and at gain 1 a point of the smallest size 8 m from the eye (a line 8 m away) puts the
//    right irradiance (radiance) on its pixels. Nearer and farther ones do not: that is the method.
// 3. Targets are RGBA16F (the paper: "high-accuracy"), and Newton's method takes 5 steps.
// 4. Lines are quads at most 12 px wide: wide lines are not portable.
// 5. Shoal's eyes see to infinity: z_far is the farthest corner of the scene, or PaperParams::distance where that is
//    nearer.
// One light is traced (4.1): the sun, or where there is none above the horizon the first lamp above the water.
// Reflection and refraction passes (section 3, step 4) are those of Surface, the same for both methods; so is
// composition, where caustics light the albedo (the paper adds them to the picture).
#pragma once

#include <memory>
#include <span>
#include <string_view>

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
    float intensity = 9.2f;                           // W/sr (4.1); 9.2 is the scene's light as it is
    float anisotropy = 0.5f;                          // of the simplified Henyey-Greenstein function
    float gain = 1;                                   // one factor for its mixed units
    bool filter = true;                               // the low-pass filter with a rotating kernel (3.5)
    bool waterMask = true;                            // 3, step 2b
    float distance = 60;                              // metres, the farthest z_far
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
    v(p.intensity,
      Field{"intensity", "W/sr", 0, 1e6, "of the light: 9.2 leaves the scene's as it is, others scale it"});
    v(p.anisotropy, Field{"anisotropy", "", -0.99, 0.99, "of the simplified Henyey-Greenstein function"});
    v(p.gain, Field{"gain", "", 0, 1e6, "factor on both effects"});
    v(p.filter, Field{"filter", "", -1e30, 1e30, "the low-pass filter with a rotating kernel"});
    v(p.waterMask, Field{"waterMask", "", -1e30, 1e30, "photons that do not meet water are left out"});
    v(p.distance,
      Field{"distance", "m", 1, 2000, "the eye's far plane in the method's formulas, where the scene is larger"});
    v(p.newtonSteps, Field{"newtonSteps", "", 1, 50, "of the image-space intersection"});
}

// The configurations of section 4.2, to be run by name.
struct PaperConfig {
    const char* name;   // "paper-a"
    int width, height;  // pixels of the window
    PaperParams params;
    const char* framesPerSecond;  // as printed, on a GeForce GTX 260
    const char* note;             // what the paper leaves open
};
std::span<const PaperConfig> paperConfigs();
const PaperConfig* findPaperConfig(std::string_view name);  // null for an unknown name

// Metres to pixels of section 3.3: size of a point `distance` metres from the eye is a + b / distance.
struct PointSizes {
    float a = 0, b = 0;
    float at(float distance) const { return a + b / distance; }
};
PointSizes pointSizes(const PaperParams& params, float nearZ, float farZ);

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
    // Water mask, points, lines, filters (2b, 3.3 to 3.5) in screen space; once a frame, after the view is drawn.
    // depth: of the eye's picture, reversed. Buffers follow the picture's size; nothing else is allocated after the
    // first frame.
    void render(const frame::Context& context, const PaperParams& params, const Body& body, const BodyLights& lights,
                const ReceiverInputs& receivers, gl::TextureView depth);
    // Brings the buffers to full size: `direct` as Photons::resolve fills it, `inscatter` as Shafts::march does (the
    // two may be empty). `ambient` is set to 0: the method has no light of the sky.
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
