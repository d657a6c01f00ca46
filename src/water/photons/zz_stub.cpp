#include <epoxy/gl.h>
#include <shoal/water/photons.h>
namespace shoal::water {
struct Photons::State {};
Photons::Photons(std::unique_ptr<State> s) : state_(std::move(s)) {}
Photons::Photons(Photons&&) noexcept = default;
Photons& Photons::operator=(Photons&&) noexcept = default;
Photons::~Photons() = default;
Result<Photons> Photons::create(gl::Device&, const PhotonSetup&) { return Photons(std::make_unique<State>()); }
void Photons::render(const frame::Context&, const PhotonParams&, const Body&, const BodyLights&, const LightViews&) {}
void Photons::resolve(const frame::Context&, const Body&, const BodyLights&, const LightViews&, const ReceiverInputs&,
                      const IrradianceOutputs& o) {
    const float zero[4] = {0, 0, 0, 0};
    glClearTexImage(o.direct.name, 0, GL_RGBA, GL_FLOAT, zero);
    glClearTexImage(o.ambient.name, 0, GL_RGBA, GL_FLOAT, zero);
}
frame::Stats Photons::stats() const { return {}; }
}  // namespace shoal::water
