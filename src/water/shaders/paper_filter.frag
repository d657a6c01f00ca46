#version 450 core
// Section 3.5: a low-pass filter of several taps with a kernel that is turned from pixel to pixel. Weights are even and
// sum to 1: the mean stays.
layout(binding = 0) uniform sampler2D source;
layout(location = 0) out vec4 outLight;

const float kRadiusPx = 2.5;
// Vogel's spiral over the unit disc, 8 points.
const vec2 kTaps[8] = vec2[](vec2(0.25, 0.0), vec2(-0.319, 0.2922), vec2(0.0489, -0.5568), vec2(0.4024, 0.5253),
                             vec2(-0.7385, -0.1308), vec2(0.6996, -0.4460), vec2(-0.2339, 0.8706),
                             vec2(-0.4464, -0.8602));

void main() {
    ivec2 last = textureSize(source, 0) - 1;
    // Interleaved gradient noise [Jimenez 2014]: neighbours are turned by different angles.
    float angle = 6.2831853 * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
    mat2 turn = kRadiusPx * mat2(cos(angle), sin(angle), -sin(angle), cos(angle));
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 8; ++i) {
        ivec2 at = ivec2(floor(gl_FragCoord.xy + turn * kTaps[i]));
        sum += texelFetch(source, clamp(at, ivec2(0), last), 0);
    }
    outLight = sum * 0.125;
}
