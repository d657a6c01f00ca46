// Light scattered in the lens: a pyramid of blurred pictures (shaders/bloom_*.frag).
#pragma once

#include <functional>
#include <vector>

#include <shoal/core/result.h>

#include "frame/fullscreen.h"

namespace shoal::frame {

class Bloom {
public:
    static Result<Bloom> create(gl::Device& device);
    // Allocates at first use and when the size changes.
    Result<void> resize(int width, int height);
    // `first` has its source and uniforms bound; it is drawn into the half-size level.
    void compute(const gl::Program& first, int width, int height, const Fullscreen& fullscreen);
    gl::TextureView result() const { return levels_.front().view(); }  // half size, linear filter

private:
    gl::Device* device_ = nullptr;
    const gl::Program *down_ = nullptr, *up_ = nullptr;
    std::vector<gl::Texture> levels_;
    std::vector<gl::Framebuffer> targets_;
    int width_ = 0, height_ = 0;
};

}  // namespace shoal::frame
