#version 450 core
layout(location = 0) out float outWater;

void main() { outWater = 1.0; }
