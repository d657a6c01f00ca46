#include "frame/ambient_occlusion.h"

#include <epoxy/gl.h>

#include <cmath>

#include "frame/bindings.shared.h"

namespace shoal::frame {
namespace {

// Beyond radius * (1 - kFalloff) a sample's weight falls, to 0 at the radius.
constexpr float kFalloff = 0.6f;
// Two pixels are of one surface when their depths, slopes taken off, differ by less than this part of the depth.
constexpr float kDepthTolerance = 0.02f;

}  // namespace

Result<AmbientOcclusion> AmbientOcclusion::create(gl::Device& device) {
    AmbientOcclusion ao;
    ao.device_ = &device;
    SHOAL_TRY_ASSIGN(ao.horizons_, fullscreenProgram(device, "frame/ao.frag"));
    SHOAL_TRY_ASSIGN(ao.blur_, fullscreenProgram(device, "frame/ao_blur.frag"));
    SHOAL_TRY_ASSIGN(ao.upsample_, fullscreenProgram(device, "frame/ao_upsample.frag"));
    return ao;
}

Result<void> AmbientOcclusion::resize(int width, int height, gl::TextureView depth) {
    if (full_ && full_.width() == width && full_.height() == height && depthName_ == depth.name) return {};
    gl::Device& device = *device_;
    raw_ = makeTarget(device, GL_RG32F, (width + 1) / 2, (height + 1) / 2, "occlusion, raw");
    blurred_ = makeTarget(device, GL_RG32F, (width + 1) / 2, (height + 1) / 2, "occlusion, blurred");
    full_ = makeTarget(device, GL_R8, width, height, "occlusion");
    if (!raw_ || !blurred_ || !full_) return internalError("no memory for ambient occlusion");
    const gl::Framebuffer::Attachment raw[] = {{raw_.view()}}, blurred[] = {{blurred_.view()}},
                                      full[] = {{full_.view()}};
    SHOAL_TRY_ASSIGN(toRaw_, gl::Framebuffer::create(device, raw, {}, "occlusion, raw"));
    SHOAL_TRY_ASSIGN(toBlurred_, gl::Framebuffer::create(device, blurred, {}, "occlusion, blurred"));
    SHOAL_TRY_ASSIGN(toFull_, gl::Framebuffer::create(device, full, {depth}, "occlusion"));
    depthName_ = depth.name;
    return {};
}

void AmbientOcclusion::clear() {
    const float open[4] = {1, 1, 1, 1};
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    glClearNamedFramebufferfv(toFull_.name(), GL_COLOR, 0, open);
}

void AmbientOcclusion::compute(const Context& context, const LightingParams& params, const GBuffer& gbuffer,
                               const Fullscreen& fullscreen) {
    const light::View& view = context.view;
    const Mat4 clipFromView = light::jittered(view, context.jitterPx.x, context.jitterPx.y);
    const float width = float(gbuffer.width), height = float(gbuffer.height);
    // Normalised device x = (P00 x + P02 z) / -z in perspective, P00 x + P03 orthographic; x is solved for at depth 1.
    const auto axis = [&](int row, float pixels) {
        const float scale = clipFromView(row, row);
        const float shift = view.orthographic ? -clipFromView(row, 3) : clipFromView(row, 2);
        return Vec2{2 / (pixels * scale), (shift - 1) / scale};
    };
    const Vec2 x = axis(0, width), y = axis(1, height);
    const float radius = params.occlusionRadius;
    const float turn =
        std::fmod(float(context.sampleIndex) * 0.61803399f, 1.0f);  // golden ratio: even over any number of samples

    gl::bindTexture(SHOAL_UNIT_PASS + 1, gbuffer.normal);
    gl::bindTexture(SHOAL_UNIT_PASS + 4, gbuffer.viewDepth);
    {
        const gl::PassScope pass(context.timer, "occlusion");
        horizons_->set(0, Vec4{x.x, y.x, x.y, y.y});
        horizons_->set(1, Vec4{radius, 0.5f * height * clipFromView(1, 1), view.orthographic ? 1.0f : 0.0f, turn});
        horizons_->set(2, Vec4{-1 / (kFalloff * radius), 1 / kFalloff, width, height});
        horizons_->set(3, view.viewFromWorld);
        toRaw_.bind();
        fullscreen.draw(*horizons_);
    }
    {
        const gl::PassScope pass(context.timer, "occlusion blur");
        gl::bindTexture(SHOAL_UNIT_PASS, raw_);
        blur_->set(0, Vec4{kDepthTolerance, 0, 0, 0});
        toBlurred_.bind();
        fullscreen.draw(*blur_);
    }
    const gl::PassScope pass(context.timer, "occlusion upsample");
    gl::bindTexture(SHOAL_UNIT_PASS, blurred_);
    upsample_->set(0, Vec4{kDepthTolerance, params.occlusionStrength, 0, 0});
    clear();
    toFull_.bind();
    fullscreen.draw(*upsample_, Where::surfaces);
}

}  // namespace shoal::frame
