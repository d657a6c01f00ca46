// The views that a surface is mirrored and looked through with.
#pragma once

#include <vector>

#include <shoal/water/surface.h>

namespace shoal::water {

enum Mirror { kAirMirror = 0, kWaterMirror = 1, kBentView = 2 };  // what a view shows

struct ChosenView {
    Surface::MirrorView view;
    Mirror shows = kAirMirror;
};

// At most three. The eye above the water: what stands there, mirrored, and what lies in the water, along bent rays;
// below: what lies there, mirrored, and what stands above as the window upwards shows it; across: all but the window.
// Nothing that cannot be seen.
std::vector<ChosenView> chooseViews(const frame::Context& context, const SurfaceParams& params, const Body& body,
                                    const Bounds& sceneBounds);

}  // namespace shoal::water
