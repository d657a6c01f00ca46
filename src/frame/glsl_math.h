// The pure shader functions (*.lib.glsl) of geometry and shadows as C++ functions.
#pragma once

#include "frame/glsl_compat.h"

namespace shoal::frame::glsl {

#include "frame/gbuffer.lib.glsl"
#include "frame/shadow.lib.glsl"

}  // namespace shoal::frame::glsl
