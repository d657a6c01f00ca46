#version 450 core
// Brings god rays to full size (section 3, step 7).
layout(local_size_x = 16, local_size_y = 8) in;
layout(binding = 0) uniform sampler2D godrays;
layout(binding = 0, rgba16f) uniform writeonly image2D inscatterImage;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(inscatterImage);
    if (any(greaterThanEqual(pixel, size))) return;
    imageStore(inscatterImage, pixel, vec4(textureLod(godrays, (vec2(pixel) + 0.5) / vec2(size), 0.0).rgb, 0.0));
}
