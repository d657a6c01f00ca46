// Fills the view block (shaders/view.shared.h).
#pragma once

#include <shoal/frame/context.h>

#include "frame/view.shared.h"

namespace shoal::frame {

// The block of one drawing of the frame: jitter, previous view, time.
ViewBlock makeViewBlock(const Context& context);
// The block of a view by itself (shadow maps): no jitter, nothing moved.
ViewBlock makeViewBlock(const light::View& view);

}  // namespace shoal::frame
