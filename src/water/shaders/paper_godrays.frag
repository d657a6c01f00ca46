#version 450 core
// Section 3.4: I Mie(theta) e^(-gamma d_viewer) e^(-gamma d_surface); added up by blending.
#include "water/paper.shared.h"

layout(location = 0) in vec3 fromEye;
layout(location = 1) in float fromSurface;
layout(location = 2) flat in vec4 ray;
layout(location = 0) out vec4 outLight;

// "A simplified version of the Henyey-Greenstein phase function" (4.1): the one of [Hoffman & Preetham 2002], 1/sr.
float mie(float cosTheta) {
    float g = paper.godrayLight.w;
    float q = 1.0 + g * g - 2.0 * g * cosTheta;
    return (1.0 - g) * (1.0 - g) / (12.5663706 * q * sqrt(q));
}

void main() {
    float distance = max(length(fromEye), 1e-4);
    // Between the ways light goes before and after: towards the eye and straight on is 1.
    float cosTheta = dot(ray.xyz, -fromEye) / distance;
    float dimmed = exp(-paper.causticLight.w * (distance + fromSurface));
    outLight = vec4(paper.godrayLight.rgb * (ray.w * mie(cosTheta) * dimmed), 1.0);
}
