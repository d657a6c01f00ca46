#version 450 core
// A point of the photon grid, in the light's screen space; the geometry shader makes four photons of it.
layout(location = 0) in vec2 screen;
layout(location = 0) out vec2 outScreen;

void main() { outScreen = screen; }
