// How a module makes its embedded shaders known: shoal::gl cannot name the modules above it, and a static library
// drops initialisers that nobody calls, so each module's create() function says it.
#pragma once

#include <span>

namespace shoal::gl {

struct EmbeddedShader;  // src/gl/embedded_shader.h

// Adds a module's table (it must live as long as the process). Adding the same table again does nothing. From any
// thread.
void registerShaders(std::span<const EmbeddedShader> shaders);

}  // namespace shoal::gl
