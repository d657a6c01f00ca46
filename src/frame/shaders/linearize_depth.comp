#version 450 core
// View depth in metres from the reversed-z depth buffer; 0 where nothing was drawn.
#include "frame/bindings.shared.h"
#include "frame/gbuffer.lib.glsl"

layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = SHOAL_UNIT_PASS) uniform sampler2D depthTexture;
layout(binding = 0, r32f) uniform writeonly image2D viewDepthImage;
layout(location = 0) uniform vec4 projection;   // elements of clipFromView, see viewDepthFromDepth

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(viewDepthImage)))) return;
    float depth = texelFetch(depthTexture, pixel, 0).x;
    float viewDepth = depth > 0.0 ? viewDepthFromDepth(depth, projection) : 0.0;
    imageStore(viewDepthImage, pixel, vec4(viewDepth));
}
