// The grid that the surface is drawn as: nested levels, each cell twice as wide as in the level before, laid out in the
// world, so that nothing swims as the eye moves. Where a level ends its odd points have moved onto the even ones, which
// the next level has too [Strugar 2009]: no cracks. Waves that cells cannot show fade with them.
#ifndef SHOAL_WATER_SURFACE_GRID_GLSL
#define SHOAL_WATER_SURFACE_GRID_GLSL

#include "water/surface.shared.h"
#include "water/water.shared.h"
#include "water/waves.io.glsl"

const float kFadeRange = float(SHOAL_GRID_FADE_TO - SHOAL_GRID_FADE_FROM);
const float kHorizon = 1000.0;   // times its distance: where the grid's rim is moved

// World position of grid point `index` of a level; onRim: of the outermost level's edge.
vec3 gridPoint(vec2 index, float cell, bool onRim) {
    vec2 xz = index * cell, middle = surfaceBlock.grid.yz;
    vec2 away = abs(xz - middle);
    float fade = clamp((max(away.x, away.y) / cell - float(SHOAL_GRID_FADE_FROM)) / kFadeRange, 0.0, 1.0);
    xz -= mod(index, 2.0) * cell * fade;
    if (onRim) xz = middle + (xz - middle) * kHorizon;
    xz = clamp(xz, waterBlock.area.xy, waterBlock.area.zw);
    float h = onRim ? 0.0 : waveSlopeFiltered(xz, cell * (1.0 + fade)).h;
    return vec3(xz.x, waterBlock.shape.x + h, xz.y);
}

#endif
