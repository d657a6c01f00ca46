#include <algorithm>
#include <vector>

#include <shoal/gl/device.h>

#include "gl/pixel_store.h"
#include "gl/state_list.h"

namespace shoal::gl {
namespace {

GLint getInt(GLenum name) {
    GLint value = 0;
    glGetIntegerv(name, &value);
    return value;
}

GLint getInt(GLenum name, GLuint index) {
    GLint value = 0;
    glGetIntegeri_v(name, index, &value);
    return value;
}

GLfloat getFloat(GLenum name) {
    GLfloat value = 0;
    glGetFloatv(name, &value);
    return value;
}

void setSwitch(GLenum name, bool on) { on ? glEnable(name) : glDisable(name); }

GLuint atMost(GLuint wanted, GLenum limit) { return std::min(wanted, GLuint(std::max(getInt(limit), 0))); }

// Switches, and what setRaster() of state.cpp sets.
struct RasterState {
    std::array<bool, kSwitches.size()> switches{};
    std::array<bool, kClipDistanceCount> clipDistances{};
    GLint clipOrigin = 0, clipDepth = 0, frontFace = 0, cullFace = 0, provoking = 0, restartIndex = 0;
    GLint polygonMode[2] = {};
    GLfloat offsetFactor = 0, offsetUnits = 0, lineWidth = 1, pointSize = 1;
    struct Viewport {
        GLfloat box[4];
        GLdouble depth[2];
        GLint scissor[4];
        bool scissorOn;
    };
    std::vector<Viewport> viewports;

    void save() {
        for (std::size_t i = 0; i < kSwitches.size(); ++i) switches[i] = glIsEnabled(kSwitches[i].name);
        for (GLuint i = 0; i < kClipDistanceCount; ++i) clipDistances[i] = glIsEnabled(GL_CLIP_DISTANCE0 + i);
        clipOrigin = getInt(GL_CLIP_ORIGIN), clipDepth = getInt(GL_CLIP_DEPTH_MODE);
        frontFace = getInt(GL_FRONT_FACE), cullFace = getInt(GL_CULL_FACE_MODE);
        provoking = getInt(GL_PROVOKING_VERTEX), restartIndex = getInt(GL_PRIMITIVE_RESTART_INDEX);
        glGetIntegerv(GL_POLYGON_MODE, polygonMode);
        offsetFactor = getFloat(GL_POLYGON_OFFSET_FACTOR), offsetUnits = getFloat(GL_POLYGON_OFFSET_UNITS);
        lineWidth = getFloat(GL_LINE_WIDTH), pointSize = getFloat(GL_POINT_SIZE);
        viewports.resize(atMost(kViewportCount, GL_MAX_VIEWPORTS));
        for (GLuint i = 0; i < viewports.size(); ++i) {
            glGetFloati_v(GL_VIEWPORT, i, viewports[i].box);
            glGetDoublei_v(GL_DEPTH_RANGE, i, viewports[i].depth);
            glGetIntegeri_v(GL_SCISSOR_BOX, i, viewports[i].scissor);
            viewports[i].scissorOn = glIsEnabledi(GL_SCISSOR_TEST, i);
        }
    }

    void restore() const {
        for (std::size_t i = 0; i < kSwitches.size(); ++i) setSwitch(kSwitches[i].name, switches[i]);
        for (GLuint i = 0; i < kClipDistanceCount; ++i) setSwitch(GL_CLIP_DISTANCE0 + i, clipDistances[i]);
        glClipControl(GLenum(clipOrigin), GLenum(clipDepth));
        glFrontFace(GLenum(frontFace)), glCullFace(GLenum(cullFace));
        glProvokingVertex(GLenum(provoking)), glPrimitiveRestartIndex(GLuint(restartIndex));
        glPolygonMode(GL_FRONT_AND_BACK, GLenum(polygonMode[0]));
        glPolygonOffset(offsetFactor, offsetUnits), glLineWidth(lineWidth), glPointSize(pointSize);
        for (GLuint i = 0; i < viewports.size(); ++i) {
            const Viewport& v = viewports[i];
            glViewportIndexedfv(i, v.box);
            glDepthRangeIndexed(i, v.depth[0], v.depth[1]);
            glScissorIndexedv(i, v.scissor);
            v.scissorOn ? glEnablei(GL_SCISSOR_TEST, i) : glDisablei(GL_SCISSOR_TEST, i);
        }
    }
};

// Depth, stencil, blending, masks, clear values: what setPerSample() of state.cpp sets.
struct SampleState {
    struct Face {
        GLint func, ref, valueMask, writeMask, fail, depthFail, depthPass;
    };
    struct DrawBuffer {
        bool blend;
        GLint equationRgb, equationAlpha, sourceRgb, sourceAlpha, targetRgb, targetAlpha;
        GLboolean mask[4];
    };
    GLint depthFunc = 0, logicOp = 0, clampRead = 0, clearStencil = 0, sampleMask = 0;
    GLboolean depthMask = GL_TRUE, coverageInvert = GL_FALSE;
    Face front{}, back{};
    GLfloat blendColor[4] = {}, clearColor[4] = {}, coverage = 1, minShading = 0;
    GLdouble clearDepth = 1;
    std::vector<DrawBuffer> drawBuffers;

    void save() {
        depthFunc = getInt(GL_DEPTH_FUNC), logicOp = getInt(GL_LOGIC_OP_MODE);
        clampRead = getInt(GL_CLAMP_READ_COLOR), clearStencil = getInt(GL_STENCIL_CLEAR_VALUE);
        sampleMask = getInt(GL_SAMPLE_MASK_VALUE, 0);
        glGetBooleanv(GL_DEPTH_WRITEMASK, &depthMask);
        glGetBooleanv(GL_SAMPLE_COVERAGE_INVERT, &coverageInvert);
        front = {getInt(GL_STENCIL_FUNC),           getInt(GL_STENCIL_REF),  getInt(GL_STENCIL_VALUE_MASK),
                 getInt(GL_STENCIL_WRITEMASK),      getInt(GL_STENCIL_FAIL), getInt(GL_STENCIL_PASS_DEPTH_FAIL),
                 getInt(GL_STENCIL_PASS_DEPTH_PASS)};
        back = {getInt(GL_STENCIL_BACK_FUNC),           getInt(GL_STENCIL_BACK_REF),
                getInt(GL_STENCIL_BACK_VALUE_MASK),     getInt(GL_STENCIL_BACK_WRITEMASK),
                getInt(GL_STENCIL_BACK_FAIL),           getInt(GL_STENCIL_BACK_PASS_DEPTH_FAIL),
                getInt(GL_STENCIL_BACK_PASS_DEPTH_PASS)};
        glGetFloatv(GL_BLEND_COLOR, blendColor);
        glGetFloatv(GL_COLOR_CLEAR_VALUE, clearColor);
        coverage = getFloat(GL_SAMPLE_COVERAGE_VALUE), minShading = getFloat(GL_MIN_SAMPLE_SHADING_VALUE);
        glGetDoublev(GL_DEPTH_CLEAR_VALUE, &clearDepth);
        drawBuffers.resize(atMost(kDrawBufferCount, GL_MAX_DRAW_BUFFERS));
        for (GLuint i = 0; i < drawBuffers.size(); ++i) saveDrawBuffer(i);
    }

    void saveDrawBuffer(GLuint i) {
        DrawBuffer& d = drawBuffers[i];
        d.blend = glIsEnabledi(GL_BLEND, i);
        d.equationRgb = getInt(GL_BLEND_EQUATION_RGB, i), d.equationAlpha = getInt(GL_BLEND_EQUATION_ALPHA, i);
        d.sourceRgb = getInt(GL_BLEND_SRC_RGB, i), d.sourceAlpha = getInt(GL_BLEND_SRC_ALPHA, i);
        d.targetRgb = getInt(GL_BLEND_DST_RGB, i), d.targetAlpha = getInt(GL_BLEND_DST_ALPHA, i);
        glGetBooleani_v(GL_COLOR_WRITEMASK, i, d.mask);
    }

    static void restoreFace(GLenum side, const Face& f) {
        glStencilFuncSeparate(side, GLenum(f.func), f.ref, GLuint(f.valueMask));
        glStencilMaskSeparate(side, GLuint(f.writeMask));
        glStencilOpSeparate(side, GLenum(f.fail), GLenum(f.depthFail), GLenum(f.depthPass));
    }

    void restore() const {
        glDepthFunc(GLenum(depthFunc)), glDepthMask(depthMask), glLogicOp(GLenum(logicOp));
        glClampColor(GL_CLAMP_READ_COLOR, GLenum(clampRead));
        restoreFace(GL_FRONT, front), restoreFace(GL_BACK, back);
        glBlendColor(blendColor[0], blendColor[1], blendColor[2], blendColor[3]);
        glClearColor(clearColor[0], clearColor[1], clearColor[2], clearColor[3]);
        glClearDepth(clearDepth), glClearStencil(clearStencil);
        glSampleCoverage(coverage, coverageInvert), glSampleMaski(0, GLbitfield(sampleMask)),
            glMinSampleShading(minShading);
        for (GLuint i = 0; i < drawBuffers.size(); ++i) {
            const DrawBuffer& d = drawBuffers[i];
            d.blend ? glEnablei(GL_BLEND, i) : glDisablei(GL_BLEND, i);
            glBlendEquationSeparatei(i, GLenum(d.equationRgb), GLenum(d.equationAlpha));
            glBlendFuncSeparatei(i, GLenum(d.sourceRgb), GLenum(d.targetRgb), GLenum(d.sourceAlpha),
                                 GLenum(d.targetAlpha));
            glColorMaski(i, d.mask[0], d.mask[1], d.mask[2], d.mask[3]);
        }
    }
};

// Indexed buffer bindings of one kind, and its plain binding, which binding an index changes as well.
struct BufferBindings {
    GLenum target, binding, start, size;
    GLint plain = 0;
    struct Range {
        GLint name;
        GLint64 start, size;
    };
    std::vector<Range> ranges;

    void save(GLuint count) {
        plain = getInt(binding);
        ranges.resize(count);
        for (GLuint i = 0; i < count; ++i) {
            ranges[i].name = getInt(binding, i);
            glGetInteger64i_v(start, i, &ranges[i].start);
            glGetInteger64i_v(size, i, &ranges[i].size);
        }
    }
    void restore() const {
        for (GLuint i = 0; i < ranges.size(); ++i) {
            const Range& r = ranges[i];
            // Size 0 says that the whole buffer was bound.
            if (r.name && r.size > 0)
                glBindBufferRange(target, i, GLuint(r.name), GLintptr(r.start), GLsizeiptr(r.size));
            else
                glBindBufferBase(target, i, GLuint(r.name));
        }
        glBindBuffer(target, GLuint(plain));
    }
};

struct TextureTarget {
    GLenum target, binding;
};
constexpr std::array kTextureTargets{
    TextureTarget{GL_TEXTURE_1D, GL_TEXTURE_BINDING_1D},
    TextureTarget{GL_TEXTURE_2D, GL_TEXTURE_BINDING_2D},
    TextureTarget{GL_TEXTURE_3D, GL_TEXTURE_BINDING_3D},
    TextureTarget{GL_TEXTURE_1D_ARRAY, GL_TEXTURE_BINDING_1D_ARRAY},
    TextureTarget{GL_TEXTURE_2D_ARRAY, GL_TEXTURE_BINDING_2D_ARRAY},
    TextureTarget{GL_TEXTURE_RECTANGLE, GL_TEXTURE_BINDING_RECTANGLE},
    TextureTarget{GL_TEXTURE_CUBE_MAP, GL_TEXTURE_BINDING_CUBE_MAP},
    TextureTarget{GL_TEXTURE_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP_ARRAY},
    TextureTarget{GL_TEXTURE_BUFFER, GL_TEXTURE_BINDING_BUFFER},
    TextureTarget{GL_TEXTURE_2D_MULTISAMPLE, GL_TEXTURE_BINDING_2D_MULTISAMPLE},
    TextureTarget{GL_TEXTURE_2D_MULTISAMPLE_ARRAY, GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY},
};

struct TextureBindings {
    struct Unit {
        std::array<GLint, kTextureTargets.size()> textures;
        GLint sampler;
    };
    struct Image {
        GLint name, level, layered, layer, access, format;
    };
    GLint active = GL_TEXTURE0;
    std::vector<Unit> units;
    std::vector<Image> images;

    void save() {
        active = getInt(GL_ACTIVE_TEXTURE);
        units.resize(atMost(kTextureUnitCount, GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS));
        for (GLuint i = 0; i < units.size(); ++i) {
            glActiveTexture(GL_TEXTURE0 + i);
            for (std::size_t t = 0; t < kTextureTargets.size(); ++t)
                units[i].textures[t] = getInt(kTextureTargets[t].binding);
            units[i].sampler = getInt(GL_SAMPLER_BINDING);
        }
        glActiveTexture(GLenum(active));
        images.resize(atMost(kImageUnitCount, GL_MAX_IMAGE_UNITS));
        for (GLuint i = 0; i < images.size(); ++i)
            images[i] = {getInt(GL_IMAGE_BINDING_NAME, i),    getInt(GL_IMAGE_BINDING_LEVEL, i),
                         getInt(GL_IMAGE_BINDING_LAYERED, i), getInt(GL_IMAGE_BINDING_LAYER, i),
                         getInt(GL_IMAGE_BINDING_ACCESS, i),  getInt(GL_IMAGE_BINDING_FORMAT, i)};
    }
    void restore() const {
        for (GLuint i = 0; i < units.size(); ++i) {
            glActiveTexture(GL_TEXTURE0 + i);
            for (std::size_t t = 0; t < kTextureTargets.size(); ++t)
                glBindTexture(kTextureTargets[t].target, GLuint(units[i].textures[t]));
            glBindSampler(i, GLuint(units[i].sampler));
        }
        glActiveTexture(GLenum(active));
        for (GLuint i = 0; i < images.size(); ++i) {
            const Image& m = images[i];
            glBindImageTexture(i, GLuint(m.name), m.level, m.layered ? GL_TRUE : GL_FALSE, m.layer, GLenum(m.access),
                               GLenum(m.format));
        }
    }
};

struct ObjectBindings {
    GLint drawFramebuffer = 0, readFramebuffer = 0, vertexArray = 0, program = 0, pipeline = 0;
    GLint drawIndirect = 0, dispatchIndirect = 0;

    void save() {
        drawFramebuffer = getInt(GL_DRAW_FRAMEBUFFER_BINDING), readFramebuffer = getInt(GL_READ_FRAMEBUFFER_BINDING);
        vertexArray = getInt(GL_VERTEX_ARRAY_BINDING), program = getInt(GL_CURRENT_PROGRAM);
        pipeline = getInt(GL_PROGRAM_PIPELINE_BINDING);
        drawIndirect = getInt(GL_DRAW_INDIRECT_BUFFER_BINDING),
        dispatchIndirect = getInt(GL_DISPATCH_INDIRECT_BUFFER_BINDING);
    }
    void restore() const {
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, GLuint(drawFramebuffer));
        glBindFramebuffer(GL_READ_FRAMEBUFFER, GLuint(readFramebuffer));
        glBindVertexArray(GLuint(vertexArray));
        glUseProgram(GLuint(program));
        glBindProgramPipeline(GLuint(pipeline));
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, GLuint(drawIndirect));
        glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, GLuint(dispatchIndirect));
    }
};

}  // namespace

struct StateGuard::Saved {
    RasterState raster;
    SampleState sample;
    PixelStoreState pixels;
    TextureBindings textures;
    ObjectBindings objects;
    BufferBindings uniforms{
        GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE, 0, {}};
    BufferBindings storage{GL_SHADER_STORAGE_BUFFER,
                           GL_SHADER_STORAGE_BUFFER_BINDING,
                           GL_SHADER_STORAGE_BUFFER_START,
                           GL_SHADER_STORAGE_BUFFER_SIZE,
                           0,
                           {}};
};

StateGuard::StateGuard() : saved_(std::make_unique<Saved>()) {
    saved_->raster.save();
    saved_->sample.save();
    saved_->pixels.save();
    saved_->textures.save();
    saved_->objects.save();
    saved_->uniforms.save(atMost(kUniformBindingCount, GL_MAX_UNIFORM_BUFFER_BINDINGS));
    saved_->storage.save(atMost(kStorageBindingCount, GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS));
}

StateGuard::~StateGuard() {
    saved_->uniforms.restore();
    saved_->storage.restore();
    saved_->objects.restore();
    saved_->textures.restore();
    saved_->pixels.restore();
    saved_->sample.restore();
    saved_->raster.restore();
}

}  // namespace shoal::gl
