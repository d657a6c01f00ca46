// Light space on the GPU: slots, and the depth of what light meets. LightViews::bind() binds what it reads.
//   vec2 s = lightSpaceOf(P, slot)          light-space x, z of a world point (m)
//   vec2 t = lightTexelOf(s, slot)          the same in texels, [0, resolution] within the slot's square
//   float l = levelPath(P, slot)            metres that the slot's light goes through level water to a world point
//   float y = litHeight(ivec2 t, slot, layer)   height of what is lit there; kNothingLit where there is nothing
#ifndef SHOAL_WATER_LIGHT_SPACE_IO_GLSL
#define SHOAL_WATER_LIGHT_SPACE_IO_GLSL

#include "water/light_space.shared.h"
#include "water/light_space.lib.glsl"

// Two layers a slot (2 slot + layer), one a slot. Reversed: 0 nothing, 1 nearest to the light.
layout(binding = SHOAL_UNIT_LIT_DEPTH) uniform sampler2DArray litDepth;
layout(binding = SHOAL_UNIT_AIR_DEPTH) uniform sampler2DArray airDepth;

const float kNothingLit = 1e30;

vec2 lightSpaceOf(vec3 p, int slot) {
    return slideToLevel(p, lightSpace.slots[slot].reach.z, lightSpace.slots[slot].source, lightSpace.slots[slot].mean);
}

vec2 lightTexelOf(vec2 s, int slot) { return (s - lightSpace.slots[slot].place.xy) * lightSpace.slots[slot].place.w; }

// 0 above the level, and for light that the surface throws up.
float levelPath(vec3 p, int slot) {
    vec4 mean = lightSpace.slots[slot].mean;
    float slant = 1.0 / mean.z;
#ifndef NO_LAMPS
    vec4 source = lightSpace.slots[slot].source;
    vec3 way = source.xyz - p;
    if (source.w > 0.5) slant = length(way) / max(abs(way.y), 1e-3);
#endif
    return mean.w < 0.0 ? max(lightSpace.slots[slot].reach.z - p.y, 0.0) * slant : 0.0;
}

// Texels outside the square count as nothing.
float litHeight(ivec2 texel, int slot, int layer) {
    int size = int(lightSpace.counts.y);
    vec4 rows = lightSpace.slots[slot].rows;
    bool inside = all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, ivec2(size)));
    ivec3 at = ivec3(clamp(texel, ivec2(0), ivec2(size - 1)), 2 * slot + layer);
    at.y = int(rows.x) * at.y + int(rows.y);
    float depth = texelFetch(litDepth, at, 0).x;
    return depth > 0.0 && inside ? heightOfDepth(depth, lightSpace.slots[slot].height) : kNothingLit;
}

// Where a world point of the surface lies in the air layer, texels: slid along the light's way in the air.
vec2 airTexelOf(vec3 p, int slot) {
    vec4 toLight = lightSpace.slots[slot].toLight;
    float above = p.y - lightSpace.slots[slot].reach.z;
    vec2 s = p.xz - toLight.xz * (above / (abs(toLight.y) < 1e-4 ? 1e-4 : toLight.y));
    if (toLight.w > 0.5) s = toLight.xz + (p.xz - toLight.xz) * lampScale(p.y, p.y - above, toLight.y);
    return lightTexelOf(s, slot);
}

// 1 where light reaches the surface at p, 0 where something above the water is in its way.
float airVisibility(vec3 p, int slot) {
    const float kGapM = 0.01;  // what is this little above the surface is the waterline itself
    int size = int(lightSpace.counts.y);
    // The four texels around: light must not slip in between a hull's side and the texels that show the hull.
    ivec2 low = clamp(ivec2(floor(airTexelOf(p, slot) - 0.5)), ivec2(0), ivec2(size - 2));
    // Seen from above, whichever way light goes on: rows run against z.
    vec2 middle = vec2(low.x + 1, size - 1 - low.y) / float(size);
    vec4 around = textureGather(airDepth, vec3(middle, float(slot)));
    float depth = max(max(around.x, around.y), max(around.z, around.w));
    bool blocked = depth > 0.0 && heightOfDepth(depth, lightSpace.slots[slot].airHeight) > p.y + kGapM;
    return blocked ? 0.0 : 1.0;
}

#endif
