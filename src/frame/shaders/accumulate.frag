#version 450 core
// One sample of a supersampled picture, added to two sums: the linear radiance, and the radiance weighted so that no
// sample outshines the others by more than the display can show [Karis 2014, "High Quality Temporal Supersampling"]:
// edges of bright things stay smooth. a: coverage, and the sum of weights.
#include "frame/bindings.shared.h"
#include "frame/exposure.io.glsl"

layout(binding = SHOAL_UNIT_PASS) uniform sampler2D radianceTexture;

layout(location = 0) out vec4 outLinear;
layout(location = 1) out vec4 outWeighted;

void main() {
    vec4 radiance = texelFetch(radianceTexture, ivec2(gl_FragCoord.xy), 0);
    float weight = displayWeight(radiance.rgb);
    outLinear = radiance;
    outWeighted = vec4(radiance.rgb * weight, weight);
}
