#version 450 core
// The next mip level of both layers of one slot.
layout(local_size_x = 16, local_size_y = 8) in;

layout(binding = 0, r32f) uniform readonly image2DArray fine;
layout(binding = 1, r32f) uniform writeonly image2DArray coarse;
layout(location = 0) uniform int firstLayer;
layout(location = 1) uniform int side;   // of the coarse level

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, ivec2(side)))) return;
    ivec3 at = ivec3(2 * id.xy, firstLayer + id.z);
    float sum = imageLoad(fine, at).x + imageLoad(fine, at + ivec3(1, 0, 0)).x + imageLoad(fine, at + ivec3(0, 1, 0)).x +
                imageLoad(fine, at + ivec3(1, 1, 0)).x;
    imageStore(coarse, ivec3(id.xy, at.z), vec4(0.25 * sum));
}
