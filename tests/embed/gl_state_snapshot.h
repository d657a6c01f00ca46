// Everything a host could notice about a context's state, as text: read here by hand and not through Shoal's lists, so
// that a thing that a StateGuard forgets is seen.
#pragma once

#include <epoxy/gl.h>

#include <map>
#include <sstream>
#include <string>

namespace shoal::test {

using Snapshot = std::map<std::string, std::string>;

namespace snapshot_detail {

template <class T, class Get>
void put(Snapshot& out, const std::string& name, int valueCount, Get get) {
    T values[16] = {};
    get(values);
    std::ostringstream text;
    for (int i = 0; i < valueCount; ++i) text << +values[i] << ' ';
    out[name] = text.str();
}

inline void ints(Snapshot& out, const char* name, GLenum e, int count = 1) {
    put<GLint>(out, name, count, [&](GLint* v) { glGetIntegerv(e, v); });
}
inline void floats(Snapshot& out, const char* name, GLenum e, int count = 1) {
    put<GLfloat>(out, name, count, [&](GLfloat* v) { glGetFloatv(e, v); });
}
inline std::string at(const char* name, GLuint i) { return std::string(name) + "[" + std::to_string(i) + "]"; }
inline void indexed(Snapshot& out, const char* name, GLenum e, GLuint i, int count = 1) {
    put<GLint>(out, at(name, i), count, [&](GLint* v) { glGetIntegeri_v(e, i, v); });
}

inline void switches(Snapshot& out) {
#define SHOAL_SWITCH(e) out[#e] = glIsEnabled(e) ? "on" : "off"
    SHOAL_SWITCH(GL_BLEND);
    SHOAL_SWITCH(GL_COLOR_LOGIC_OP);
    SHOAL_SWITCH(GL_CULL_FACE);
    SHOAL_SWITCH(GL_DEPTH_CLAMP);
    SHOAL_SWITCH(GL_DEPTH_TEST);
    SHOAL_SWITCH(GL_DITHER);
    SHOAL_SWITCH(GL_FRAMEBUFFER_SRGB);
    SHOAL_SWITCH(GL_LINE_SMOOTH);
    SHOAL_SWITCH(GL_MULTISAMPLE);
    SHOAL_SWITCH(GL_POLYGON_OFFSET_FILL);
    SHOAL_SWITCH(GL_POLYGON_OFFSET_LINE);
    SHOAL_SWITCH(GL_POLYGON_OFFSET_POINT);
    SHOAL_SWITCH(GL_POLYGON_SMOOTH);
    SHOAL_SWITCH(GL_PRIMITIVE_RESTART);
    SHOAL_SWITCH(GL_PRIMITIVE_RESTART_FIXED_INDEX);
    SHOAL_SWITCH(GL_PROGRAM_POINT_SIZE);
    SHOAL_SWITCH(GL_RASTERIZER_DISCARD);
    SHOAL_SWITCH(GL_SAMPLE_ALPHA_TO_COVERAGE);
    SHOAL_SWITCH(GL_SAMPLE_ALPHA_TO_ONE);
    SHOAL_SWITCH(GL_SAMPLE_COVERAGE);
    SHOAL_SWITCH(GL_SAMPLE_MASK);
    SHOAL_SWITCH(GL_SAMPLE_SHADING);
    SHOAL_SWITCH(GL_SCISSOR_TEST);
    SHOAL_SWITCH(GL_STENCIL_TEST);
    SHOAL_SWITCH(GL_TEXTURE_CUBE_MAP_SEAMLESS);
#undef SHOAL_SWITCH
    for (GLuint i = 0; i < 8; ++i) out[at("GL_CLIP_DISTANCE", i)] = glIsEnabled(GL_CLIP_DISTANCE0 + i) ? "on" : "off";
}

inline void fixedFunction(Snapshot& out) {
    for (GLenum e : {GL_CLIP_ORIGIN,
                     GL_CLIP_DEPTH_MODE,
                     GL_FRONT_FACE,
                     GL_CULL_FACE_MODE,
                     GL_PROVOKING_VERTEX,
                     GL_PRIMITIVE_RESTART_INDEX,
                     GL_DEPTH_FUNC,
                     GL_DEPTH_WRITEMASK,
                     GL_LOGIC_OP_MODE,
                     GL_CLAMP_READ_COLOR,
                     GL_STENCIL_CLEAR_VALUE,
                     GL_STENCIL_FUNC,
                     GL_STENCIL_REF,
                     GL_STENCIL_VALUE_MASK,
                     GL_STENCIL_WRITEMASK,
                     GL_STENCIL_FAIL,
                     GL_STENCIL_PASS_DEPTH_FAIL,
                     GL_STENCIL_PASS_DEPTH_PASS,
                     GL_STENCIL_BACK_FUNC,
                     GL_STENCIL_BACK_REF,
                     GL_STENCIL_BACK_VALUE_MASK,
                     GL_STENCIL_BACK_WRITEMASK,
                     GL_STENCIL_BACK_FAIL,
                     GL_STENCIL_BACK_PASS_DEPTH_FAIL,
                     GL_STENCIL_BACK_PASS_DEPTH_PASS,
                     GL_SAMPLE_COVERAGE_INVERT,
                     GL_PATCH_VERTICES,
                     GL_POINT_SPRITE_COORD_ORIGIN})
        ints(out, std::to_string(e).c_str(), e);
    ints(out, "polygon mode", GL_POLYGON_MODE);
    for (GLenum e :
         {GL_POLYGON_OFFSET_FACTOR, GL_POLYGON_OFFSET_UNITS, GL_LINE_WIDTH, GL_POINT_SIZE, GL_SAMPLE_COVERAGE_VALUE,
          GL_MIN_SAMPLE_SHADING_VALUE, GL_DEPTH_CLEAR_VALUE, GL_POINT_FADE_THRESHOLD_SIZE})
        floats(out, std::to_string(e).c_str(), e);
    floats(out, "blend color", GL_BLEND_COLOR, 4);
    floats(out, "clear color", GL_COLOR_CLEAR_VALUE, 4);
    indexed(out, "sample mask", GL_SAMPLE_MASK_VALUE, 0);
    for (GLuint i = 0; i < 16; ++i) {
        put<GLfloat>(out, at("viewport", i), 4, [&](GLfloat* v) { glGetFloati_v(GL_VIEWPORT, i, v); });
        put<GLdouble>(out, at("depth range", i), 2, [&](GLdouble* v) { glGetDoublei_v(GL_DEPTH_RANGE, i, v); });
        indexed(out, "scissor box", GL_SCISSOR_BOX, i, 4);
        out[at("scissor", i)] = glIsEnabledi(GL_SCISSOR_TEST, i) ? "on" : "off";
    }
    for (GLuint i = 0; i < 8; ++i) {
        out[at("blend", i)] = glIsEnabledi(GL_BLEND, i) ? "on" : "off";
        for (GLenum e : {GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA, GL_BLEND_SRC_RGB, GL_BLEND_SRC_ALPHA,
                         GL_BLEND_DST_RGB, GL_BLEND_DST_ALPHA})
            indexed(out, ("blend " + std::to_string(e)).c_str(), e, i);
        put<GLboolean>(out, at("color mask", i), 4, [&](GLboolean* v) { glGetBooleani_v(GL_COLOR_WRITEMASK, i, v); });
    }
    for (GLenum e : {GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_PACK_ROW_LENGTH, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_ROWS,
                     GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_IMAGES, GL_PACK_ALIGNMENT, GL_UNPACK_SWAP_BYTES,
                     GL_UNPACK_LSB_FIRST, GL_UNPACK_ROW_LENGTH, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_ROWS,
                     GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT})
        ints(out, std::to_string(e).c_str(), e);
}

inline void bindings(Snapshot& out) {
    for (GLenum e : {GL_DRAW_FRAMEBUFFER_BINDING,
                     GL_READ_FRAMEBUFFER_BINDING,
                     GL_RENDERBUFFER_BINDING,
                     GL_VERTEX_ARRAY_BINDING,
                     GL_CURRENT_PROGRAM,
                     GL_PROGRAM_PIPELINE_BINDING,
                     GL_ARRAY_BUFFER_BINDING,
                     GL_ELEMENT_ARRAY_BUFFER_BINDING,
                     GL_DRAW_INDIRECT_BUFFER_BINDING,
                     GL_DISPATCH_INDIRECT_BUFFER_BINDING,
                     GL_PIXEL_PACK_BUFFER_BINDING,
                     GL_PIXEL_UNPACK_BUFFER_BINDING,
                     GL_UNIFORM_BUFFER_BINDING,
                     GL_SHADER_STORAGE_BUFFER_BINDING,
                     GL_ATOMIC_COUNTER_BUFFER_BINDING,
                     GL_COPY_READ_BUFFER_BINDING,
                     GL_COPY_WRITE_BUFFER_BINDING,
                     GL_TEXTURE_BUFFER_BINDING,
                     GL_QUERY_BUFFER_BINDING,
                     GL_TRANSFORM_FEEDBACK_BUFFER_BINDING,
                     GL_TRANSFORM_FEEDBACK_BINDING,
                     GL_ACTIVE_TEXTURE,
                     GL_DRAW_BUFFER,
                     GL_READ_BUFFER,
                     GL_DEBUG_GROUP_STACK_DEPTH})
        ints(out, ("binding " + std::to_string(e)).c_str(), e);
    for (GLuint i = 0; i < 16; ++i)
        for (auto [name, start, size] :
             {std::tuple{GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE},
              std::tuple{GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
                         GL_SHADER_STORAGE_BUFFER_SIZE}}) {
            const std::string what = "buffer range " + std::to_string(name);
            indexed(out, what.c_str(), name, i);
            for (GLenum e : {start, size})
                put<GLint64>(out, at((what + " " + std::to_string(e)).c_str(), i), 1,
                             [&](GLint64* v) { glGetInteger64i_v(e, i, v); });
        }
    for (GLuint i = 0; i < 8; ++i)
        for (GLenum e : {GL_IMAGE_BINDING_NAME, GL_IMAGE_BINDING_LEVEL, GL_IMAGE_BINDING_LAYERED,
                         GL_IMAGE_BINDING_LAYER, GL_IMAGE_BINDING_ACCESS, GL_IMAGE_BINDING_FORMAT})
            indexed(out, ("image " + std::to_string(e)).c_str(), e, i);
    GLint active = 0;
    glGetIntegerv(GL_ACTIVE_TEXTURE, &active);
    for (GLuint i = 0; i < 32; ++i) {
        glActiveTexture(GL_TEXTURE0 + i);
        for (GLenum e :
             {GL_TEXTURE_BINDING_1D, GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_3D, GL_TEXTURE_BINDING_1D_ARRAY,
              GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_RECTANGLE, GL_TEXTURE_BINDING_CUBE_MAP,
              GL_TEXTURE_BINDING_CUBE_MAP_ARRAY, GL_TEXTURE_BINDING_BUFFER, GL_TEXTURE_BINDING_2D_MULTISAMPLE,
              GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY, GL_SAMPLER_BINDING})
            ints(out, at(("unit " + std::to_string(e)).c_str(), i).c_str(), e);
    }
    glActiveTexture(GLenum(active));
}

}  // namespace snapshot_detail

inline Snapshot takeSnapshot() {
    Snapshot out;
    snapshot_detail::switches(out);
    snapshot_detail::fixedFunction(out);
    snapshot_detail::bindings(out);
    return out;
}

// The names of what differs, with both values.
inline std::string difference(const Snapshot& a, const Snapshot& b) {
    std::string out;
    for (const auto& [name, value] : a)
        if (b.at(name) != value) out += name + ": " + value + "-> " + b.at(name) + "\n";
    return out;
}

}  // namespace shoal::test
