#version 450 core
// Which share of level water's sun gets into the water, over wide cells: means of the uppermost slice. The smooth light
// that the sun's beam turns into is dimmer where a roof or a pier keeps the beam out.
#include "water/shaft_slices.io.glsl"

layout(local_size_x = SHOAL_SHAFT_OPEN_CELLS, local_size_y = SHOAL_SHAFT_OPEN_CELLS) in;
layout(binding = 0, r32f) uniform writeonly image2DArray openImage;

void main() {
    ivec3 cell = ivec3(gl_GlobalInvocationID);
    int slot = cell.z, slices = int(shaftBlock.grid.y), wide = int(shaftBlock.grid.x) / SHOAL_SHAFT_OPEN_CELLS;
    float sum = 0.0;
    for (int y = 0; y < wide; ++y)
        for (int x = 0; x < wide; ++x)
            sum += float(texelFetch(shaftSlices, ivec3(cell.xy * wide + ivec2(x, y) + 1, slot * slices), 0).x);
    imageStore(openImage, cell, vec4(sum * shaftBlock.units.y / float(wide * wide)));
}
