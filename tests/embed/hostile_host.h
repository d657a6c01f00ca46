// A host that leaves everything on that can be left on, and its own objects bound everywhere.
#pragma once

#include <epoxy/gl.h>

#include <vector>

namespace shoal::test {

class HostileHost {
public:
    HostileHost() {
        glCreateBuffers(1, &buffer_);
        glNamedBufferStorage(buffer_, 1 << 16, nullptr, GL_DYNAMIC_STORAGE_BIT);
        glCreateTextures(GL_TEXTURE_2D, 1, &texture_);
        glTextureStorage2D(texture_, 2, GL_RGBA8, 8, 8);
        glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube_);
        glTextureStorage2D(cube_, 1, GL_RGBA8, 8, 8);
        glCreateTextures(GL_TEXTURE_3D, 1, &volume_);
        glTextureStorage3D(volume_, 1, GL_R32F, 8, 8, 8);
        glCreateSamplers(1, &sampler_);
        glSamplerParameteri(sampler_, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        glSamplerParameteri(sampler_, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        glSamplerParameteri(sampler_, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
        glSamplerParameteri(sampler_, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glCreateFramebuffers(1, &framebuffer_);
        glNamedFramebufferTexture(framebuffer_, GL_COLOR_ATTACHMENT0, texture_, 0);
        glCreateVertexArrays(1, &vertexArray_);
        glVertexArrayElementBuffer(vertexArray_, buffer_);
        const char* text = "#version 450 core\nlayout(local_size_x = 1) in;\nvoid main() {}\n";
        program_ = glCreateShaderProgramv(GL_COMPUTE_SHADER, 1, &text);
        glCreateProgramPipelines(1, &pipeline_);
    }
    ~HostileHost() {
        // Mesa 22.3 keeps a pipeline bound that is deleted while a program is in use.
        glUseProgram(0);
        glBindProgramPipeline(0);
        glDeleteBuffers(1, &buffer_);
        for (GLuint name : {texture_, cube_, volume_}) glDeleteTextures(1, &name);
        glDeleteSamplers(1, &sampler_);
        glDeleteFramebuffers(1, &framebuffer_);
        glDeleteVertexArrays(1, &vertexArray_);
        glDeleteProgram(program_);
        glDeleteProgramPipelines(1, &pipeline_);
    }
    HostileHost(const HostileHost&) = delete;
    HostileHost& operator=(const HostileHost&) = delete;

    void mess() const {
        messSwitches();
        messFixedFunction();
        messBindings();
    }

private:
    static void messSwitches() {
        for (GLenum e : {GL_BLEND,
                         GL_COLOR_LOGIC_OP,
                         GL_CULL_FACE,
                         GL_DEPTH_CLAMP,
                         GL_DEPTH_TEST,
                         GL_DITHER,
                         GL_FRAMEBUFFER_SRGB,
                         GL_LINE_SMOOTH,
                         GL_POLYGON_OFFSET_FILL,
                         GL_POLYGON_OFFSET_LINE,
                         GL_POLYGON_OFFSET_POINT,
                         GL_POLYGON_SMOOTH,
                         GL_PRIMITIVE_RESTART,
                         GL_PRIMITIVE_RESTART_FIXED_INDEX,
                         GL_PROGRAM_POINT_SIZE,
                         GL_RASTERIZER_DISCARD,
                         GL_SAMPLE_ALPHA_TO_COVERAGE,
                         GL_SAMPLE_ALPHA_TO_ONE,
                         GL_SAMPLE_COVERAGE,
                         GL_SAMPLE_MASK,
                         GL_SAMPLE_SHADING,
                         GL_SCISSOR_TEST,
                         GL_STENCIL_TEST})
            glEnable(e);
        glDisable(GL_MULTISAMPLE);
        glDisable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
        for (GLuint i = 0; i < 8; i += 2) glEnable(GL_CLIP_DISTANCE0 + i);
    }

    static void messFixedFunction() {
        glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
        glFrontFace(GL_CW), glCullFace(GL_FRONT_AND_BACK);
        glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
        glPrimitiveRestartIndex(1);
        glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
        glPolygonOffset(-5, 7), glLineWidth(1), glPointSize(9);
        glDepthFunc(GL_NEVER), glDepthMask(GL_FALSE), glClearDepth(0.25);
        glStencilFuncSeparate(GL_FRONT, GL_NEVER, 3, 0x0F), glStencilFuncSeparate(GL_BACK, GL_LESS, 5, 0xF0);
        glStencilMaskSeparate(GL_FRONT, 0x11), glStencilMaskSeparate(GL_BACK, 0x22);
        glStencilOpSeparate(GL_FRONT, GL_INCR, GL_DECR, GL_INVERT),
            glStencilOpSeparate(GL_BACK, GL_ZERO, GL_REPLACE, GL_INCR_WRAP);
        glClearStencil(7);
        glLogicOp(GL_XOR);
        glClampColor(GL_CLAMP_READ_COLOR, GL_TRUE);
        glBlendColor(0.1f, 0.2f, 0.3f, 0.4f), glClearColor(0.5f, 0.6f, 0.7f, 0.8f);
        glSampleCoverage(0.25f, GL_TRUE), glSampleMaski(0, 0x5), glMinSampleShading(0.5f);
        for (GLuint i = 0; i < 8; ++i) {
            i % 2 ? glDisablei(GL_BLEND, i) : glEnablei(GL_BLEND, i);
            glBlendEquationSeparatei(i, i % 2 ? GL_MAX : GL_FUNC_REVERSE_SUBTRACT, GL_FUNC_SUBTRACT);
            glBlendFuncSeparatei(i, GL_DST_COLOR, GL_SRC_ALPHA, GL_CONSTANT_ALPHA, i % 3 ? GL_ONE : GL_ZERO);
            glColorMaski(i, GLboolean(i % 2), GL_FALSE, GL_TRUE, GLboolean(i % 3 == 0));
        }
        for (GLuint i = 0; i < 16; ++i) {
            glViewportIndexedf(i, float(i), 1, 2 + float(i), 3);
            glDepthRangeIndexed(i, 0.5, 0.5 + 0.01 * i);
            glScissorIndexed(i, GLint(i), 0, 1, 1);
            i % 3 ? glEnablei(GL_SCISSOR_TEST, i) : glDisablei(GL_SCISSOR_TEST, i);
        }
        glEnablei(GL_SCISSOR_TEST, 0);
        for (GLenum e : {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST})
            glPixelStorei(e, 1);
        for (GLenum e : {GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT})
            glPixelStorei(e, 37);
        for (GLenum e : {GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES, GL_UNPACK_SKIP_ROWS,
                         GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES})
            glPixelStorei(e, 3);
        glPixelStorei(GL_PACK_ALIGNMENT, 8), glPixelStorei(GL_UNPACK_ALIGNMENT, 2);
    }

    void messBindings() const {
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
        glBindVertexArray(vertexArray_);
        glUseProgram(program_);
        glBindProgramPipeline(pipeline_);
        for (GLenum e : {GL_ARRAY_BUFFER, GL_DRAW_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER, GL_PIXEL_PACK_BUFFER,
                         GL_PIXEL_UNPACK_BUFFER, GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER})
            glBindBuffer(e, buffer_);
        for (GLuint i = 0; i < 16; ++i) {
            glBindBufferRange(GL_UNIFORM_BUFFER, i, buffer_, 256 * GLintptr(i), 64);
            if (i % 2)
                glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffer_);
            else
                glBindBufferRange(GL_SHADER_STORAGE_BUFFER, i, buffer_, 256 * GLintptr(i), 128);
        }
        glBindBuffer(GL_UNIFORM_BUFFER, 0);
        for (GLuint i = 0; i < 32; ++i) {
            glActiveTexture(GL_TEXTURE0 + i);
            glBindTexture(GL_TEXTURE_2D, texture_);
            glBindTexture(GL_TEXTURE_3D, volume_);
            if (i % 2) glBindTexture(GL_TEXTURE_CUBE_MAP, cube_);
            glBindSampler(i, sampler_);
        }
        glActiveTexture(GL_TEXTURE5);
        for (GLuint i = 0; i < 8; ++i)
            i % 2 ? glBindImageTexture(i, texture_, 1, GL_FALSE, 0, GL_READ_ONLY, GL_RGBA8)
                  : glBindImageTexture(i, volume_, 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
    }

    GLuint buffer_ = 0, texture_ = 0, cube_ = 0, volume_ = 0, sampler_ = 0, framebuffer_ = 0, vertexArray_ = 0,
           program_ = 0, pipeline_ = 0;
};

}  // namespace shoal::test
