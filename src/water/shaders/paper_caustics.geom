#version 450 core
// Section 3.3: each grid point becomes four photons, each photon a point where it meets the scene. Not a loop: 4.1
// found that one costs half of the speed.
#include "water/paper_trace.io.glsl"

layout(points) in;
layout(points, max_vertices = 4) out;

layout(location = 0) in vec2 screen[];
layout(location = 0) out vec3 outLight;

void point(vec2 at) {
    Photon photon = tracePhoton(at);
    if (photon.light <= 0.0 || !photon.meets) return;
    vec3 hit = photon.surface + photon.reach * photon.direction;
    vec3 away = hit - paper.eye.xyz;
    float fromEye = max(length(away), 1e-4);
    float sizePx = paper.points.x + paper.points.y / fromEye;
    vec4 place = paper.clipFromWorld * vec4(hit, 1.0);
    // A point is flat and what it lies on is not: tested as if it were its own size nearer.
    float sizeM = sizePx * paper.points.z * (paper.eyeAxis.w > 0.0 ? 1.0 : fromEye);
    vec3 towardsEye = paper.eyeAxis.w > 0.0 ? -paper.eyeAxis.xyz : -away / fromEye;
    vec4 nearer = paper.clipFromWorld * vec4(hit + towardsEye * min(sizeM, 0.5 * fromEye), 1.0);
    if (nearer.w > 0.0 && place.z < place.w) place.z = min(nearer.z / nearer.w, 1.0) * place.w;
    gl_Position = place;
    gl_PointSize = sizePx;
    outLight = paper.causticLight.rgb * (photon.light * exp(-paper.causticLight.w * photon.reach));
    EmitVertex();
    EndPrimitive();
}

void main() {
    vec2 at = screen[0];
    float offset = paper.grids.x;
    point(at + vec2(-offset, -offset));
    point(at + vec2(offset, -offset));
    point(at + vec2(-offset, offset));
    point(at + vec2(offset, offset));
}
