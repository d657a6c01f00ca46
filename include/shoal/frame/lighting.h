// Light on surfaces: sun and local lights with shadows, image-based light, ambient occlusion; deferred for opaque
// surfaces, and a block and textures that forward passes read.
#pragma once

#include <memory>
#include <span>
#include <string>

#include <shoal/core/params.h>
#include <shoal/frame/shadows.h>
#include <shoal/frame/targets.h>
#include <shoal/light/environment.h>
#include <shoal/light/lights.h>

namespace shoal::frame {

struct LightingParams {
    float environmentIntensity = 1;  // times the environment's radiance
    bool ambientOcclusion = true;
    float occlusionRadius = 1.2f;            // metres
    float occlusionStrength = 1;             // 0..2
    std::string background = "environment";  // "environment", "color", "transparent"
    Vec3 backgroundColor{0.05f, 0.05f, 0.05f};
    float backgroundBlur = 0;  // 0 sharp .. 1 diffuse
    bool sunDisc = true;       // the sun itself in the environment behind everything, where there is one
};
template <class Params, class Visitor>
requires std::is_same_v<std::remove_const_t<Params>, LightingParams>
void visit(Params& p, Visitor&& v) {
    v(p.environmentIntensity, Field{"environmentIntensity", "", 0, 1000, "times the environment's radiance"});
    v(p.ambientOcclusion,
      Field{"ambientOcclusion", "", -1e30, 1e30, "darkens creases that see little of the surroundings"});
    v(p.occlusionRadius, Field{"occlusionRadius", "m", 0.01, 100, "how far ambient occlusion looks"});
    v(p.occlusionStrength, Field{"occlusionStrength", "", 0, 2, "how dark ambient occlusion gets: 1 as computed"});
    v(p.background,
      Field{"background", "", -1e30, 1e30, "what is behind everything", {"environment", "color", "transparent"}});
    v(p.backgroundColor,
      Field{"backgroundColor", "W/(m2 sr)", 0, 1e6, "radiance behind everything when background is color"});
    v(p.backgroundBlur,
      Field{"backgroundBlur", "", 0, 1, "blurs the environment seen behind everything, not its light"});
    v(p.sunDisc, Field{"sunDisc", "", -1e30, 1e30, "draws the sun's disc into the environment behind everything"});
}

// Water, fog in a hollow: a medium that fills everything below a level. Lamps in it are dimmed on their way to surfaces
// in it.
struct Medium {
    float level = -1e30f;  // world y
    Vec3 beamAttenuation;  // 1/m
};

// What is lit by. Pointers may be null.
struct Lights {
    const light::Sun* sun = nullptr;
    std::span<const light::PunctualLight> punctual;
    Medium medium = {};
};

// Terms that a technique puts in place of the frame's own (light is counted once), RGBA16F of the picture's size. Empty
// views: none. In both, rgb is added and a is the share of the frame's own that it takes the place of.
struct LightOverrides {
    // rgb: W/m2 on the surface's own plane, from no particular direction; a: of the sun and of lamps above
    // Medium::level.
    gl::TextureView sunIrradiance;
    // rgb: W/m2 / pi on the surface's own plane; a: of the environment, its reflection included.
    gl::TextureView environmentIrradiance;
};

class Lighting {
public:
    static Result<Lighting> create(gl::Device& device);
    Lighting(Lighting&&) noexcept;
    Lighting& operator=(Lighting&&) noexcept;
    ~Lighting();

    // Uploads the map and prefilters it (SH on the CPU; specular levels in C++). Slow (tens of ms): only when it
    // changes.
    Result<void> setEnvironment(const light::Environment& environment);

    // Fills the light block; computes ambient occlusion from the G-buffer.
    void prepare(const Context& context, const LightingParams& params, const Lights& lights, const Targets& targets);
    // Shades the opaque surfaces and the background into targets.radiance().
    void shade(const Context& context, const LightingParams& params, const Shadows& shadows,
               const LightOverrides& overrides, const Targets& targets);
    // Binds light block, environment and occlusion for forward passes (lighting.io.glsl names the slots).
    void bind() const;

    // Sun's direct radiance and sun visibility of the last shade: what the AOVs "direct" and "shadow" show. Written
    // only when asked for.
    void setTermsWanted(bool wanted);
    gl::TextureView direct() const;     // RGBA16F: radiance by sun and local lights, without environment and emission
    gl::TextureView shadow() const;     // R8: visible fraction of the sun, 1 lit
    gl::TextureView occlusion() const;  // R8: 1 open

    struct State;

private:
    explicit Lighting(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace shoal::frame
