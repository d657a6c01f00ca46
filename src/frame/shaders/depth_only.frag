#version 450 core
// Depth comes from the rasteriser; only a masked material looks at its alpha. Variant PEEL: what lies behind another
// layer [Everitt 2001].
#include "frame/bindings.shared.h"
#ifdef MASKED
#include "frame/material.io.glsl"
layout(location = 0) in vec4 vUv;
layout(location = 1) in float vAlpha;
#endif

#ifdef PEEL
layout(binding = SHOAL_UNIT_PASS + 0) uniform sampler2DArray peelDepth;
layout(location = 0) uniform vec2 peel;   // layer, gap
#endif

void main() {
#ifdef PEEL
    if (gl_FragCoord.z >= texelFetch(peelDepth, ivec3(gl_FragCoord.xy, peel.x), 0).x - peel.y) discard;
#endif
#ifdef MASKED
    if (sampledBaseColor(vUv).a * vAlpha < material.emission.w) discard;
#endif
}
