#include <shoal/frame/targets.h>

#include <epoxy/gl.h>

#include <string>

#include "frame/bindings.shared.h"
#include "frame/fullscreen.h"

namespace shoal::frame {
namespace {

constexpr int kProjectionLocation = 0;  // uniform of linearize_depth.comp

}  // namespace

Result<Targets> Targets::create(gl::Device& device, int width, int height) {
    registerFrameShaders();
    Targets targets;
    targets.device_ = &device;
    SHOAL_TRY_ASSIGN(targets.linearize_,
                     device.programs().get({{"frame/linearize_depth.comp"}, {}, "linearize depth"}));
    SHOAL_TRY(targets.resize(width, height));
    return targets;
}

Result<void> Targets::resize(int width, int height) {
    if (albedo_ && width == gbuffer_.width && height == gbuffer_.height) return {};
    const int largest = device_->capabilities().maxTextureSize;
    if (width < 1 || height < 1 || width > largest || height > largest)
        return badInput("picture size is " + std::to_string(width) + "x" + std::to_string(height) + ", expected 1 to " +
                        std::to_string(largest) + " a side");
    gl::Device& d = *device_;
    albedo_ = makeTarget(d, GL_RGBA8, width, height, "G-buffer albedo");
    normal_ = makeTarget(d, GL_RG16, width, height, "G-buffer normal");
    material_ = makeTarget(d, GL_RGBA8, width, height, "G-buffer material");
    emission_ = makeTarget(d, GL_R11F_G11F_B10F, width, height, "G-buffer emission");
    motion_ = makeTarget(d, GL_RG16F, width, height, "G-buffer motion");
    objectId_ = makeTarget(d, GL_R32UI, width, height, "G-buffer object id");
    depth_ = makeTarget(d, GL_DEPTH_COMPONENT32F, width, height, "G-buffer depth");
    viewDepth_ = makeTarget(d, GL_R32F, width, height, "view depth");
    radiance_ = makeTarget(d, GL_RGBA16F, width, height, "radiance");
    opaqueCopy_ = makeTarget(d, GL_RGBA16F, width, height, "opaque radiance", 0);

    const gl::Framebuffer::Attachment colors[] = {{albedo_.view()},   {normal_.view()}, {material_.view()},
                                                  {emission_.view()}, {motion_.view()}, {objectId_.view()}};
    SHOAL_TRY_ASSIGN(surfaces_, gl::Framebuffer::create(d, colors, {depth_.view()}, "G-buffer"));
    const gl::Framebuffer::Attachment radiance[] = {{radiance_.view()}};
    SHOAL_TRY_ASSIGN(forward_, gl::Framebuffer::create(d, radiance, {depth_.view()}, "forward"));

    gbuffer_.albedo = albedo_.view(), gbuffer_.normal = normal_.view(), gbuffer_.material = material_.view();
    gbuffer_.emission = emission_.view(), gbuffer_.motion = motion_.view(), gbuffer_.objectId = objectId_.view();
    gbuffer_.depth = depth_.view(), gbuffer_.viewDepth = viewDepth_.view();
    gbuffer_.framebuffer = surfaces_.name();
    gbuffer_.width = width, gbuffer_.height = height;
    return {};
}

void Targets::beginSurfaces() const {
    surfaces_.bind();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    const GLfloat zero[4] = {0, 0, 0, 0};
    const GLuint nobody[4] = {0, 0, 0, 0};
    constexpr int kFloatTargets = 5, kObjectId = 5;
    for (int i = 0; i < kFloatTargets; ++i) glClearNamedFramebufferfv(surfaces_.name(), GL_COLOR, i, zero);
    glClearNamedFramebufferuiv(surfaces_.name(), GL_COLOR, kObjectId, nobody);
    const GLfloat farAway = 0;  // reversed z
    glClearNamedFramebufferfv(surfaces_.name(), GL_DEPTH, 0, &farAway);
}

void Targets::copyOpaque() const {
    glCopyImageSubData(radiance_.name(), GL_TEXTURE_2D, 0, 0, 0, 0, opaqueCopy_.name(), GL_TEXTURE_2D, 0, 0, 0, 0,
                       gbuffer_.width, gbuffer_.height, 1);
    glGenerateTextureMipmap(opaqueCopy_.name());
}

void Targets::finishSurfaces(const Context& context) const {
    const gl::PassScope pass(context.timer, "linearize depth");
    const Mat4& p = context.view.clipFromView;
    gl::bindTexture(SHOAL_UNIT_PASS, depth_.view());
    glBindSampler(SHOAL_UNIT_PASS, 0);
    viewDepth_.bindImage(0, GL_WRITE_ONLY);
    linearize_->set(kProjectionLocation, Vec4{p(2, 2), p(2, 3), p(3, 2), p(3, 3)});
    linearize_->dispatch(gbuffer_.width, gbuffer_.height);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace shoal::frame
