// Owns the G-buffer and the radiance buffer of one picture size.
#pragma once

#include <memory>

#include <shoal/core/result.h>
#include <shoal/frame/context.h>
#include <shoal/gl/program.h>

namespace shoal::frame {

class Targets {
public:
    static Result<Targets> create(gl::Device& device, int width, int height);
    Result<void> resize(int width, int height);  // allocates; no-op for the same size

    const GBuffer& gbuffer() const { return gbuffer_; }
    // RGBA16F: linear radiance, a = coverage (1 where a surface or an opaque background is).
    gl::TextureView radiance() const { return radiance_.view(); }
    // Radiance (colour 0) with the G-buffer's depth (tested, written): for sky, transparent surfaces.
    const gl::Framebuffer& forward() const { return forward_; }
    // Opaque radiance before transparent surfaces, with mips: what refraction sees.
    gl::TextureView opaqueCopy() const { return opaqueCopy_.view(); }

    // Clears the G-buffer and binds it.
    void beginSurfaces() const;
    // Copies the radiance of opaque surfaces to opaqueCopy() and makes its mips.
    void copyOpaque() const;
    // Fills gbuffer().viewDepth from the depth buffer.
    void finishSurfaces(const Context& context) const;

private:
    gl::Device* device_ = nullptr;
    GBuffer gbuffer_;
    gl::Texture albedo_, normal_, material_, emission_, motion_, objectId_, depth_, viewDepth_, radiance_, opaqueCopy_;
    gl::Framebuffer surfaces_, forward_;
    const gl::Program* linearize_ = nullptr;
};

}  // namespace shoal::frame
