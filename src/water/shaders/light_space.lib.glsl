// Light space (light_views.h): pure functions, compiled by C++ too.
#ifndef SHOAL_WATER_LIGHT_SPACE_LIB_GLSL
#define SHOAL_WATER_LIGHT_SPACE_LIB_GLSL

// C++ defines it as `inline`.
#ifndef SHOAL_FUNCTION
#define SHOAL_FUNCTION
#endif

// How far light space shrinks at height y under a lamp at apparent height lampY: 1 at the level.
SHOAL_FUNCTION float lampScale(float y, float level, float lampY) {
    float below = y - lampY;
    return (level - lampY) / (abs(below) < 1e-4 ? 1e-4 : below);
}

// Light-space x, z of a world point. source, mean: of LightSlotRecord. Below (reflected: above) the surface; for lamps
// the point must not lie beyond the lamp's apparent place.
SHOAL_FUNCTION vec2 slideToLevel(vec3 p, float level, vec4 source, vec4 mean) {
    float travel = mean.w * (p.y - level);
    float scale = source.w > 0.5 ? lampScale(p.y, level, source.y) : 1.0;
    float centreX = source.w > 0.5 ? source.x : 0.0;
    float centreZ = source.w > 0.5 ? source.z : 0.0;
    return vec2(centreX + (p.x - centreX) * scale - mean.x * travel,
                centreZ + (p.z - centreZ) * scale - mean.y * travel);
}

// World y of a depth map's value.
SHOAL_FUNCTION float heightOfDepth(float depth, vec4 height) {
    return (height.x * depth + height.y) / (height.z * depth + height.w);
}

#endif
