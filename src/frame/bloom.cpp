#include "frame/bloom.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "frame/bindings.shared.h"

namespace shoal::frame {
namespace {

constexpr int kLargestLevelCount = 7;
constexpr int kSmallestSide = 6;       // texels of the last level's shorter side
constexpr float kCoarserShare = 0.6f;  // of each level's result that comes from the coarser ones: how wide the glow is

}  // namespace

Result<Bloom> Bloom::create(gl::Device& device) {
    Bloom bloom;
    bloom.device_ = &device;
    SHOAL_TRY_ASSIGN(bloom.down_, fullscreenProgram(device, "frame/bloom_down.frag"));
    SHOAL_TRY_ASSIGN(bloom.up_, fullscreenProgram(device, "frame/bloom_up.frag"));
    return bloom;
}

Result<void> Bloom::resize(int width, int height) {
    if (width == width_ && height == height_) return {};
    levels_.clear(), targets_.clear();
    int w = width, h = height;
    for (int i = 0; i < kLargestLevelCount; ++i) {
        w = (w + 1) / 2, h = (h + 1) / 2;
        if (i > 0 && std::min(w, h) < kSmallestSide) break;
        gl::TextureDesc desc;
        desc.format = GL_RGBA16F;
        desc.width = w, desc.height = h;
        desc.minFilter = desc.magFilter = GL_LINEAR;
        desc.label = "bloom";
        gl::Texture level = gl::Texture::create(*device_, desc);
        if (!level) return internalError("no memory for bloom");
        const gl::Framebuffer::Attachment color[] = {{level.view()}};
        SHOAL_TRY_ASSIGN(gl::Framebuffer target, gl::Framebuffer::create(*device_, color, {}, "bloom"));
        levels_.push_back(std::move(level));
        targets_.push_back(std::move(target));
    }
    width_ = width, height_ = height;
    return {};
}

void Bloom::compute(const gl::Program& first, int width, int height, const Fullscreen& fullscreen) {
    first.set(0, Vec4{float(width - 1), float(height - 1), 0, 0});
    targets_[0].bind();
    fullscreen.draw(first);
    for (std::size_t i = 1; i < levels_.size(); ++i) {
        gl::bindTexture(SHOAL_UNIT_PASS, levels_[i - 1]);
        targets_[i].bind();
        fullscreen.draw(*down_);
    }
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_CONSTANT_ALPHA, GL_ONE_MINUS_CONSTANT_ALPHA);
    glBlendColor(0, 0, 0, kCoarserShare);
    for (std::size_t i = levels_.size() - 1; i > 0; --i) {
        gl::bindTexture(SHOAL_UNIT_PASS, levels_[i]);
        targets_[i - 1].bind();
        fullscreen.draw(*up_, Where::everywhere, true);
    }
    glDisable(GL_BLEND);
}

}  // namespace shoal::frame
