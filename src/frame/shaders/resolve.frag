#version 450 core
// The mean of the samples of a supersampled picture.
#include "frame/bindings.shared.h"

layout(binding = SHOAL_UNIT_PASS) uniform sampler2D sumTexture;
layout(location = 0) uniform float sampleCount;
layout(location = 0) out vec4 outRadiance;

void main() { outRadiance = texelFetch(sumTexture, ivec2(gl_FragCoord.xy), 0) / sampleCount; }
