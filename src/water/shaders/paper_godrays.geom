#version 450 core
// Section 3.4: each grid point becomes four photons, each photon a line from the water surface to what it meets. Lines
// are quads, as wide as asked on the buffer.
#include "water/paper_trace.io.glsl"

layout(points) in;
layout(triangle_strip, max_vertices = 16) out;

layout(location = 0) in vec2 screen[];
layout(location = 0) out vec3 outFromEye;       // metres, world axes
layout(location = 1) out float outFromSurface;  // metres
layout(location = 2) flat out vec4 outRay;      // xyz: where it travels, unit; w: its light

void corner(vec4 place, vec2 side, vec3 fromEye, float fromSurface, vec4 ray) {
    gl_Position = vec4(place.xy + side * place.w, place.zw);
    // An orthographic eye sees along its axis everywhere.
    outFromEye = paper.eyeAxis.w > 0.0 ? dot(fromEye, paper.eyeAxis.xyz) * paper.eyeAxis.xyz : fromEye;
    outFromSurface = fromSurface;
    outRay = ray;
    EmitVertex();
}

void line(vec2 at) {
    Photon photon = tracePhoton(at);
    if (photon.light <= 0.0) return;
    // The part in front of the near plane.
    vec3 start = photon.surface - paper.eye.xyz;
    float startAhead = dot(start, paper.eyeAxis.xyz) - paper.eye.w;
    float rate = dot(photon.direction, paper.eyeAxis.xyz);
    float from = startAhead < 0.0 ? (rate > 0.0 ? -startAhead / rate : photon.reach) : 0.0;
    float to = rate < 0.0 ? min(photon.reach, -max(startAhead, 0.0) / rate) : photon.reach;
    if (from >= to) return;
    vec3 a = start + from * photon.direction, b = start + to * photon.direction;
    vec4 clipA = paper.clipFromWorld * vec4(a + paper.eye.xyz, 1.0);
    vec4 clipB = paper.clipFromWorld * vec4(b + paper.eye.xyz, 1.0);
    if (min(clipA.w, clipB.w) <= 0.0) return;
    vec2 along = (clipB.xy / clipB.w - clipA.xy / clipA.w) * paper.lines.zw;
    float pixels = length(along);
    along = pixels > 1e-4 ? along / pixels : vec2(0.0, 1.0);
    vec2 side = vec2(-along.y, along.x) * paper.lines.xy;
    vec4 ray = vec4(photon.direction, photon.light);
    corner(clipA, side, a, from, ray);
    corner(clipA, -side, a, from, ray);
    corner(clipB, side, b, to, ray);
    corner(clipB, -side, b, to, ray);
    EndPrimitive();
}

void main() {
    vec2 at = screen[0];
    float offset = paper.grids.y;
    line(at + vec2(-offset, -offset));
    line(at + vec2(offset, -offset));
    line(at + vec2(-offset, offset));
    line(at + vec2(offset, offset));
}
