// Pictures into the window.
#include <algorithm>

#include <epoxy/gl.h>

#include "view/layout.h"

namespace shoal::viewer {

namespace {

// Part [from, to) of the viewport's width of a texture of any size, scaled to fill its part of the viewport.
void blitPart(const gl::TextureView& texture, const Area& viewport, int windowHeight, float from, float to) {
    if (!texture) return;
    GLuint source = 0;
    glCreateFramebuffers(1, &source);
    glNamedFramebufferTexture(source, GL_COLOR_ATTACHMENT0, texture.name, 0);
    const int x0 = int(from * float(viewport.width)), x1 = int(to * float(viewport.width));
    const float perPixel = float(texture.width) / float(viewport.width);
    const int sx0 = int(float(x0) * perPixel), sx1 = std::max(sx0 + 1, int(float(x1) * perPixel));
    const int bottom = windowHeight - viewport.y - viewport.height;
    const bool same = texture.width == viewport.width && texture.height == viewport.height;
    if (x1 > x0)
        glBlitNamedFramebuffer(source, 0, sx0, 0, std::min(sx1, texture.width), texture.height, viewport.x + x0, bottom,
                               viewport.x + x1, bottom + viewport.height, GL_COLOR_BUFFER_BIT,
                               same ? GL_NEAREST : GL_LINEAR);
    glDeleteFramebuffers(1, &source);
}

}  // namespace

void blitPictures(Viewer& v) {
    const int height = v.window.height();
    const float split = v.comparison && v.comparison->picture.hasPicture() ? v.comparison->divider : 1;
    if (v.picture.hasPicture()) {
        const gl::TextureView shown =
            v.inspector.active() && v.inspector.texture() ? v.inspector.texture() : v.picture.pipeline().display();
        blitPart(shown, v.viewport, height, 0, split);
    }
    if (split < 1) blitPart(v.comparison->picture.pipeline().display(), v.viewport, height, split, 1);
}

ByteImage readWindow(const gl::Window& window) {
    ByteImage picture(window.width(), window.height());
    std::vector<std::uint8_t> rows(picture.pixels.size());
    glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
    glReadBuffer(GL_BACK);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glReadPixels(0, 0, picture.width, picture.height, GL_RGBA, GL_UNSIGNED_BYTE, rows.data());
    const auto rowBytes = std::ptrdiff_t(picture.width) * 4;
    for (int y = 0; y < picture.height; ++y)
        std::copy_n(rows.begin() + rowBytes * y, rowBytes,
                    picture.pixels.begin() + rowBytes * (picture.height - 1 - y));
    return picture;
}

}  // namespace shoal::viewer
