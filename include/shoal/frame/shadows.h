// Shadow maps of the sun (cascades) and of spots: which views they need, and what shading reads.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <shoal/core/params.h>
#include <shoal/frame/context.h>
#include <shoal/light/lights.h>

namespace shoal::frame {

struct ShadowSetup {
    int sunResolution = 2048;  // texels a side of each cascade
    int cascadeCount = 4;      // 1..4
    int spotResolution = 1024;
    int maxSpots = 8;  // spots with a shadow; further ones shine through
};

struct ShadowParams {
    float sunDistance =
        0;  // metres from the eye that cascades cover; beyond it there is light; 0: as far as the scene needs
    float splitBlend = 0.75f;  // 0: equal splits, 1: logarithmic
    float softness = 1;        // times the penumbra that the sun's disc makes
    float normalBias = 1.5f;   // texels along the normal
};
template <class Params, class Visitor>
requires std::is_same_v<std::remove_const_t<Params>, ShadowParams>
void visit(Params& p, Visitor&& v) {
    v(p.sunDistance,
      Field{"sunDistance", "m", 0, 10000, "how far from the eye the sun casts shadows; 0: as far as the scene needs"});
    v(p.splitBlend, Field{"splitBlend", "", 0, 1, "0 spaces the cascades evenly, 1 logarithmically"});
    v(p.softness, Field{"softness", "", 0, 20, "widens the penumbra: 1 is the sun's disc"});
    v(p.normalBias, Field{"normalBias", "texels", 0, 10, "moves the receiver along its normal"});
}

class Shadows {
public:
    static Result<Shadows> create(gl::Device& device, const ShadowSetup& setup);
    Shadows(Shadows&&) noexcept;
    Shadows& operator=(Shadows&&) noexcept;
    ~Shadows();

    // Fits the cascades to the view (snapped to texels, so that they do not swim), clipped to sceneBounds.
    void prepare(const Context& context, const ShadowParams& params, const light::Sun* sun,
                 std::span<const light::PunctualLight> lights, const Bounds& sceneBounds);
    // The views to draw after prepare. The same slot keeps the same depth storage.
    std::span<NeededView> neededViews();
    // Binds the shadow block and textures that shadows.io.glsl names.
    void bind() const;

    struct State;

private:
    explicit Shadows(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::frame
