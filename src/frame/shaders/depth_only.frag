#version 450 core
// Depth comes from the rasteriser; only a masked material looks at its alpha.
#ifdef MASKED
#include "frame/material.io.glsl"
layout(location = 0) in vec4 vUv;
layout(location = 1) in float vAlpha;
#endif

void main() {
#ifdef MASKED
    if (sampledBaseColor(vUv).a * vAlpha < material.emission.w) discard;
#endif
}
