// Pixel transfer with tightly packed rows from and to client memory, whatever a host has set.
#pragma once

#include <epoxy/gl.h>

#include <array>

namespace shoal::gl {

inline constexpr std::array kPixelStoreNames{
    GL_PACK_SWAP_BYTES,   GL_PACK_LSB_FIRST,     GL_PACK_ROW_LENGTH,    GL_PACK_IMAGE_HEIGHT,
    GL_PACK_SKIP_ROWS,    GL_PACK_SKIP_PIXELS,   GL_PACK_SKIP_IMAGES,   GL_PACK_ALIGNMENT,
    GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST,   GL_UNPACK_ROW_LENGTH,  GL_UNPACK_IMAGE_HEIGHT,
    GL_UNPACK_SKIP_ROWS,  GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_ALIGNMENT};

inline bool isAlignment(GLenum name) { return name == GL_PACK_ALIGNMENT || name == GL_UNPACK_ALIGNMENT; }

// Everything 0, alignment 1, no pixel buffers bound.
inline void setTightPixelStore() {
    for (GLenum name : kPixelStoreNames) glPixelStorei(name, isAlignment(name) ? 1 : 0);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
}

struct PixelStoreState {
    std::array<GLint, kPixelStoreNames.size()> values{};
    GLint packBuffer = 0, unpackBuffer = 0;

    void save() {
        for (std::size_t i = 0; i < values.size(); ++i) glGetIntegerv(kPixelStoreNames[i], &values[i]);
        glGetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &packBuffer);
        glGetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpackBuffer);
    }
    void restore() const {
        for (std::size_t i = 0; i < values.size(); ++i) glPixelStorei(kPixelStoreNames[i], values[i]);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, GLuint(packBuffer));
        glBindBuffer(GL_PIXEL_UNPACK_BUFFER, GLuint(unpackBuffer));
    }
};

class PixelStoreScope {
public:
    PixelStoreScope() {
        saved_.save();
        setTightPixelStore();
    }
    ~PixelStoreScope() { saved_.restore(); }
    PixelStoreScope(const PixelStoreScope&) = delete;
    PixelStoreScope& operator=(const PixelStoreScope&) = delete;

private:
    PixelStoreState saved_;
};

}  // namespace shoal::gl
