#include <shoal/gl/device.h>

#include "gl/pixel_store.h"
#include "gl/state_list.h"

namespace shoal::gl {
namespace {

void setRaster() {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDepthRange(0.0, 1.0);
    glFrontFace(GL_CCW);
    glCullFace(GL_BACK);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glPolygonOffset(0, 0);
    glLineWidth(1);
    glPointSize(1);
    glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    glPrimitiveRestartIndex(0xFFFFFFFFu);
    for (GLuint i = 0; i < kClipDistanceCount; ++i) glDisable(GL_CLIP_DISTANCE0 + i);
}

void setPerSample() {
    glDepthFunc(GL_GREATER);  // reversed z
    glDepthMask(GL_TRUE);
    glStencilFunc(GL_ALWAYS, 0, 0xFFFFFFFFu);
    glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    glStencilMask(0xFFFFFFFFu);
    glBlendColor(0, 0, 0, 0);
    glBlendEquation(GL_FUNC_ADD);  // these three set every draw buffer
    glBlendFunc(GL_ONE, GL_ZERO);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);  // every viewport
    glLogicOp(GL_COPY);
    glSampleCoverage(1, GL_FALSE);
    glSampleMaski(0, 0xFFFFFFFFu);
    glMinSampleShading(0);
    glClampColor(GL_CLAMP_READ_COLOR, GL_FIXED_ONLY);
    glClearColor(0, 0, 0, 0);
    glClearDepth(0);  // reversed z: 0 is far
    glClearStencil(0);
}

}  // namespace

void setKnownState() {
    for (const Switch& s : kSwitches) s.on ? glEnable(s.name) : glDisable(s.name);
    setRaster();
    setPerSample();
    setTightPixelStore();
    glBindSamplers(0, GLsizei(kTextureUnitCount), nullptr);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, 0);
    glBindVertexArray(0);
    glUseProgram(0);
    glBindProgramPipeline(0);
    glActiveTexture(GL_TEXTURE0);
}

}  // namespace shoal::gl
