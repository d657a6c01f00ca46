#version 450 core
// Counts pixels by log2 luminance. Integer sums: the same bits whatever the order. Pixels without anything (a = 0) do
// not count.
#include "frame/exposure.io.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = SHOAL_UNIT_PASS) uniform sampler2D radianceTexture;
layout(location = 0) uniform int alphaIsWeight;   // 1: rgb is divided by a first

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy) * SHOAL_EXPOSURE_STRIDE + SHOAL_EXPOSURE_STRIDE / 2;
    if (any(greaterThanEqual(at, textureSize(radianceTexture, 0)))) return;
    vec4 texel = texelFetch(radianceTexture, at, 0);
    if (!(texel.a > 0.0)) return;
    float light = luminanceOf(texel.rgb) / (alphaIsWeight != 0 ? texel.a : 1.0);
    if (!(light > exp2(SHOAL_EXPOSURE_LOWEST))) return;
    float bin = (log2(light) - SHOAL_EXPOSURE_LOWEST) / SHOAL_EXPOSURE_STOPS_A_BIN;
    atomicAdd(exposureState.bins[clamp(int(bin), 0, SHOAL_EXPOSURE_BINS - 1)], 1u);
}
