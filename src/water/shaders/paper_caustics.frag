#version 450 core
// A photon's light on the pixels of its point; added up by blending.
layout(location = 0) in vec3 light;
layout(location = 0) out vec4 outLight;

void main() { outLight = vec4(light, 1.0); }
