#version 450 core
// The eye's depth at a buffer's size: the nearest pixel's.
layout(binding = 0) uniform sampler2D eyeDepth;
layout(location = 0) uniform vec2 pixelsPerPixel;

void main() { gl_FragDepth = texelFetch(eyeDepth, ivec2(gl_FragCoord.xy * pixelsPerPixel), 0).x; }
