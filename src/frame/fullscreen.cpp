#include "frame/fullscreen.h"

#include <epoxy/gl.h>

#include <shoal/gl/shaders.h>

#include "gl/embedded_shader.h"

namespace shoal::frame {

Fullscreen Fullscreen::create(gl::Device& device) {
    Fullscreen f;
    f.nothing_ = gl::VertexArray::create(device, {}, "full screen");
    return f;
}

void Fullscreen::draw(const gl::Program& program, Where where, bool blend) const {
    if (!blend) glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_FALSE);
    if (where == Where::everywhere) {
        glDisable(GL_DEPTH_TEST);
    } else {
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(where == Where::surfaces ? GL_LESS : GL_EQUAL);
    }
    nothing_.bind();
    program.use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

std::vector<std::pair<std::string, std::string>> definesOf(int variant, std::span<const char* const> names) {
    std::vector<std::pair<std::string, std::string>> defines;
    for (std::size_t bit = 0; bit < names.size(); ++bit)
        if (variant >> bit & 1) defines.emplace_back(names[bit], "1");
    return defines;
}

Result<const gl::Program*> fullscreenProgram(gl::Device& device, const std::string& fragment,
                                             std::vector<std::pair<std::string, std::string>> defines) {
    gl::ProgramDesc desc{{"frame/fullscreen.vert", fragment}, std::move(defines), fragment};
    for (const auto& define : desc.defines) desc.label += " " + define.first;
    return device.programs().get(desc);
}

gl::Texture makeTarget(gl::Device& device, gl::Enum format, int width, int height, const char* label, int levels) {
    gl::TextureDesc desc;
    desc.format = format;
    desc.width = width, desc.height = height;
    desc.levels = levels;
    if (levels != 1) desc.minFilter = GL_LINEAR_MIPMAP_LINEAR, desc.magFilter = GL_LINEAR;
    desc.label = label;
    return gl::Texture::create(device, desc);
}

void registerFrameShaders() { gl::registerShaders(embeddedShaders()); }

}  // namespace shoal::frame
