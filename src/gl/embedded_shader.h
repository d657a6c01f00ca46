#pragma once

#include <span>

namespace shoal::gl {

/// One shader text inside the binary, as the build found it below src/ (cmake/ShoalShaders.cmake).
struct EmbeddedShader {
    const char* path;  ///< its name: the path below src/ without the `shaders` folder, "frame/shade.comp"
    const char* text;  ///< UTF-8, zero-terminated, includes not resolved
    unsigned size;     ///< bytes of `text` without the zero
};

}  // namespace shoal::gl

// The generated tables, one per module, each sorted by path; empty where a module has no shaders.
namespace shoal::gl {
std::span<const EmbeddedShader> embeddedShaders();
}
namespace shoal::frame {
std::span<const gl::EmbeddedShader> embeddedShaders();
}
namespace shoal::water {
std::span<const gl::EmbeddedShader> embeddedShaders();
}
namespace shoal::crowd {
std::span<const gl::EmbeddedShader> embeddedShaders();
}
namespace shoal::fluid {
std::span<const gl::EmbeddedShader> embeddedShaders();
}
namespace shoal::volume {
std::span<const gl::EmbeddedShader> embeddedShaders();
}
