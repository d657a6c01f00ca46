// Screen-space ambient occlusion: half resolution, blurred, brought back to full resolution (shaders/ao*.frag).
#pragma once

#include <shoal/core/result.h>
#include <shoal/frame/lighting.h>

#include "frame/fullscreen.h"

namespace shoal::frame {

class AmbientOcclusion {
public:
    static Result<AmbientOcclusion> create(gl::Device& device);
    Result<void> resize(int width, int height, gl::TextureView depth);  // depth: the G-buffer's, which picks the pixels
    void compute(const Context& context, const LightingParams& params, const GBuffer& gbuffer,
                 const Fullscreen& fullscreen);
    void clear();  // to open everywhere
    // R8, full size, 1 open and where there is no surface.
    gl::TextureView result() const { return full_.view(); }

private:
    gl::Device* device_ = nullptr;
    const gl::Program *horizons_ = nullptr, *blur_ = nullptr, *upsample_ = nullptr;
    gl::Texture raw_, blurred_, full_;
    gl::Framebuffer toRaw_, toBlurred_, toFull_;
    std::uint32_t depthName_ = 0;
};

}  // namespace shoal::frame
