// Shadow filters without textures, compiled by C++ too. Sources: [Fernando 2005] Percentage-Closer Soft Shadows; [Vogel
// 1979] for the disc; the tent of 4 bilinear comparisons follows I. Castano, "Shadow mapping summary" (2013).
#ifndef SHOAL_FRAME_SHADOW_LIB_GLSL
#define SHOAL_FRAME_SHADOW_LIB_GLSL

#ifndef SHOAL_FUNCTION
#define SHOAL_FUNCTION
#endif

// Point `index` of `count` spread evenly over the unit disc.
SHOAL_FUNCTION vec2 discPoint(int index, int count) {
    const float goldenAngle = 2.39996323f;
    float r = sqrt((float(index) + 0.5f) / float(count));
    float angle = float(index) * goldenAngle;
    return vec2(r * cos(angle), r * sin(angle));
}

// Depth that a plane with unit normal n (in the sun's axes: x, y lateral, z to the sun) gains per lateral metre,
// metres. Slopes beyond 12 (85 degrees) are cut: there the sun only grazes.
SHOAL_FUNCTION vec2 receiverSlope(vec3 n) {
    const float steepest = 12.0f;
    float z = max(n.z, 1e-3f);
    vec2 slope = vec2(-n.x / z, -n.y / z);
    float steepness = sqrt(slope.x * slope.x + slope.y * slope.y);
    return steepness > steepest ? slope * (steepest / steepness) : slope;
}

// One axis of the 3-texel tent: where two bilinear fetches go relative to the nearest texel corner, and their weights
// (sum 4). f in [0, 1): the position behind that corner. Returns (offset 0, offset 1, weight 0, weight 1), offsets in
// texels.
SHOAL_FUNCTION vec4 tentAxis(float f) {
    float w0 = 3.0f - 2.0f * f;
    float w1 = 1.0f + 2.0f * f;
    return vec4((2.0f - f) / w0 - 1.0f, f / w1 + 1.0f, w0, w1);
}

#endif
