// Which blocks of the surface's grid a view needs (shaders/surface_grid.glsl).
#pragma once

#include <vector>

#include <shoal/light/view.h>
#include <shoal/water/body.h>

#include "water/surface.shared.h"

namespace shoal::water {

struct SurfaceGrid {
    float cell = 1;  // metres a side in the finest level, a power of two
    Vec2 middle;     // x and z of what all levels surround
    std::vector<GridBlock> blocks;
};

// Levels of 8 x 8 blocks around the eye (an orthographic one: around what it looks at), each twice as wide as the one
// it surrounds, to the horizon or the area's end; without what the view or the area leaves out.
void layOutGrid(const light::View& view, const Body& body, SurfaceGrid& grid);

}  // namespace shoal::water
