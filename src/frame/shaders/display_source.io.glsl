// The antialiased radiance that is about to be shown: rgb premultiplied by coverage, a coverage.
// Variant ACCUMULATED: from the sums of accumulate.frag; else from a plain radiance texture.
#ifndef SHOAL_FRAME_DISPLAY_SOURCE_IO_GLSL
#define SHOAL_FRAME_DISPLAY_SOURCE_IO_GLSL

#include "frame/bindings.shared.h"

#ifdef ACCUMULATED
layout(binding = SHOAL_UNIT_PASS + 0) uniform sampler2D weightedSum;
layout(binding = SHOAL_UNIT_PASS + 1) uniform sampler2D linearSum;
layout(location = 8) uniform float sampleCount;

vec4 displaySource(ivec2 at) {
    vec4 weighted = texelFetch(weightedSum, at, 0);
    float covered = texelFetch(linearSum, at, 0).a;
    // Samples that hit nothing weigh 1 and carry no light: without them the weighted mean is that of the covered part.
    float weight = max(weighted.a - (sampleCount - covered), 1e-6);
    float coverage = clamp(covered / sampleCount, 0.0, 1.0);
    return vec4(weighted.rgb * (coverage / weight), coverage);
}
#else
layout(binding = SHOAL_UNIT_PASS + 0) uniform sampler2D sourceTexture;

vec4 displaySource(ivec2 at) { return texelFetch(sourceTexture, at, 0); }
#endif

#endif
