// The state that Shoal depends on or leaves dirty: what setKnownState() sets and StateGuard saves.
#pragma once

#include <epoxy/gl.h>

#include <array>

namespace shoal::gl {

struct Switch {
    GLenum name;
    bool on;  // in Shoal's known state
};

// Dither is off so that a picture has the same bits on every driver; sRGB conversion is off because shaders encode
// themselves.
inline constexpr std::array kSwitches{
    Switch{GL_COLOR_LOGIC_OP, false},
    Switch{GL_CULL_FACE, false},
    Switch{GL_DEPTH_CLAMP, false},
    Switch{GL_DEPTH_TEST, false},
    Switch{GL_DITHER, false},
    Switch{GL_FRAMEBUFFER_SRGB, false},
    Switch{GL_LINE_SMOOTH, false},
    Switch{GL_MULTISAMPLE, true},
    Switch{GL_POLYGON_OFFSET_FILL, false},
    Switch{GL_POLYGON_OFFSET_LINE, false},
    Switch{GL_POLYGON_OFFSET_POINT, false},
    Switch{GL_POLYGON_SMOOTH, false},
    Switch{GL_PRIMITIVE_RESTART, false},
    Switch{GL_PRIMITIVE_RESTART_FIXED_INDEX, false},
    Switch{GL_PROGRAM_POINT_SIZE, false},
    Switch{GL_RASTERIZER_DISCARD, false},
    Switch{GL_SAMPLE_ALPHA_TO_COVERAGE, false},
    Switch{GL_SAMPLE_ALPHA_TO_ONE, false},
    Switch{GL_SAMPLE_COVERAGE, false},
    Switch{GL_SAMPLE_MASK, false},
    Switch{GL_SAMPLE_SHADING, false},
    Switch{GL_STENCIL_TEST, false},
    Switch{GL_TEXTURE_CUBE_MAP_SEAMLESS, true},
};

// Limits of what Shoal's own shaders and passes use; a StateGuard saves this much of each.
inline constexpr GLuint kDrawBufferCount = 8;
inline constexpr GLuint kViewportCount = 16;
inline constexpr GLuint kClipDistanceCount = 8;
inline constexpr GLuint kTextureUnitCount = 32;
inline constexpr GLuint kImageUnitCount = 8;
inline constexpr GLuint kUniformBindingCount = 16;
inline constexpr GLuint kStorageBindingCount = 16;

}  // namespace shoal::gl
