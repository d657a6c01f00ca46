#version 450 core
// The water surface's grid: one block an instance.
#include "frame/view.shared.h"
#include "water/surface_grid.glsl"

layout(std430, binding = SHOAL_STORAGE_WATER) readonly buffer GridBlocks { GridBlock gridBlocks[]; };

layout(location = 0) out vec3 vPosition;

void main() {
    vec4 place = gridBlocks[gl_InstanceID].place;
    int side = SHOAL_GRID_CELLS + 1;
    vec2 own = vec2(gl_VertexID % side, gl_VertexID / side);
    vec2 index = place.xy + own;
    // Bits of w: on which sides the block ends the outermost level (-x, +x, -z, +z).
    int rim = int(place.w);
    bool onRim = (own.x == 0.0 && (rim & 1) != 0) || (own.x == float(SHOAL_GRID_CELLS) && (rim & 2) != 0) ||
                 (own.y == 0.0 && (rim & 4) != 0) || (own.y == float(SHOAL_GRID_CELLS) && (rim & 8) != 0);
    vPosition = gridPoint(index, place.z, onRim);
    gl_Position = clipFromWorld * vec4(vPosition, 1.0);
}
