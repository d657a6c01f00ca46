// On which side of the surface a pixel begins.
// Variant CROSSING: the eye is so near to the surface that pixels begin on both sides of it.
#ifndef SHOAL_WATER_SURFACE_SIDE_GLSL
#define SHOAL_WATER_SURFACE_SIDE_GLSL

#include "water/surface_grid.glsl"

// Height of the drawn grid's finest level: what the near plane cuts, cell by cell.
float gridHeightAt(vec2 xz) {
    float cell = surfaceBlock.grid.x;
    vec2 at = xz / cell, corner = floor(at), f = at - corner;
    vec2 third = f.x >= f.y ? vec2(1, 0) : vec2(0, 1);
    float low = min(f.x, f.y), high = max(f.x, f.y);
    return gridPoint(corner, cell, false).y * (1.0 - high) + gridPoint(corner + third, cell, false).y * (high - low) +
           gridPoint(corner + vec2(1.0), cell, false).y * low;
}

bool inArea(vec2 xz) {
    return all(greaterThan(xz, waterBlock.area.xy)) && all(lessThan(xz, waterBlock.area.zw));
}

// Whether a point of the near plane is in the water.
bool underWater(vec3 p) {
    float level = waterBlock.shape.x;
#ifdef CROSSING
    // A loop, for llvmpipe skips nothing else: pixels whose answer is plain pay nothing.
    int count = abs(p.y - level) <= waterBlock.shape.w ? 1 : 0;
    for (int i = 0; i < count; ++i) level = gridHeightAt(p.xz);
#endif
    return p.y < level && inArea(p.xz);
}

#endif
