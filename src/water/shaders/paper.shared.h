// What the passes of the paper's method read (std140). Filled in src/water/paper/paper_block.cpp.
#ifndef SHOAL_WATER_PAPER_SHARED_H
#define SHOAL_WATER_PAPER_SHARED_H

#ifdef __cplusplus
#include <shoal/core/math.h>
namespace shoal::water {
using vec4 = Vec4;
using mat4 = Mat4;
#define SHOAL_PAPER_BLOCK_BEGIN struct PaperBlock
#else
#include "water/bindings.shared.h"
#define SHOAL_PAPER_BLOCK_BEGIN layout(std140, binding = SHOAL_BLOCK_WATER_PASS) uniform PaperBlock
#endif

SHOAL_PAPER_BLOCK_BEGIN {
    mat4 clipFromWorld;       // the eye's, jittered as its depth is
    mat4 lightFromWorld;      // rigid
    mat4 worldFromLight;      // rigid
    mat4 lightClipFromWorld;  // for the water mask
    vec4 lightPlane;          // light space to its screen: scale of x, y and offset; lamps: scale of x / -z, y / -z
    vec4 lightDepth;    // sun: z = x depth + y; lamps: z = x / depth; z, w: least cosine of a lamp's cone, 1 / width
    vec4 lightAxis;     // xyz: where a spot shines, world
    vec4 ray;           // xyz: where the sun's light travels, world; lamps: their place
    vec4 water;         // x: level m, y: index of refraction, z: texels a side of the shadow map, w: 1 with a mask
    vec4 eye;           // xyz world, w: near plane m
    vec4 eyeAxis;       // xyz: where it looks; w: 1 orthographic
    vec4 causticLight;  // rgb: what a point adds to a pixel; w: gamma 1/m
    vec4 godrayLight;   // rgb: what a line adds to a pixel; w: anisotropy g
    vec4 points;        // a px, b px m (section 3.3), metres a pixel covers 1 m away (orthographic: anywhere), unused
    vec4 lines;         // width in the buffer's normalised coordinates x, y; size of the buffer px x, y
    vec4 grids;         // offset of the four photons from a grid point: x caustics, y god rays
    vec4 maskArea;      // x, z of the water in the light's view: least and greatest
    vec4 area;          // least x, z and greatest x, z of the water
    vec4 origin[3];     // world place of a pixel at view depth d: origin + d ray, each [0] + px [1] + py [2]
    vec4 pixelRay[3];
}
#ifndef __cplusplus
paper
#endif
    ;

#ifdef __cplusplus
}  // namespace shoal::water
#endif
#undef SHOAL_PAPER_BLOCK_BEGIN

#endif
