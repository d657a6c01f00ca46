#version 450 core
// The next mip level of both layers of one slot. Levels lie in one image: 0 below, the others in a row above it.
layout(local_size_x = 16, local_size_y = 8) in;

// Variant SHARP: irradiance alone; else heights go with it, the middle's.
#ifdef SHARP
layout(binding = 0, r32f) uniform image2DArray maps;
#else
layout(binding = 0, rg32f) uniform image2DArray maps;
#endif
layout(location = 0) uniform ivec4 place;   // first layer; texels a side of level 0, of the coarse level

ivec2 shelfOf(int side) { return side == place.y ? ivec2(0) : ivec2(place.y - 2 * side, place.y); }

void main() {
    ivec3 id = ivec3(gl_GlobalInvocationID);
    if (any(greaterThanEqual(id.xy, place.zz))) return;
    ivec3 at = ivec3(shelfOf(2 * place.z) + 2 * id.xy, place.x + id.z);
    vec2 last = imageLoad(maps, at + ivec3(1, 1, 0)).xy;
    float sum = imageLoad(maps, at).x + imageLoad(maps, at + ivec3(1, 0, 0)).x +
                imageLoad(maps, at + ivec3(0, 1, 0)).x + last.x;
    imageStore(maps, ivec3(shelfOf(place.z) + id.xy, at.z), vec4(0.25 * sum, last.y, 0.0, 0.0));
}
