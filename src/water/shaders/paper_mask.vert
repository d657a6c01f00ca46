#version 450 core
// The level water surface in the light's view (section 3, step 2b): a strip of two triangles.
#include "water/paper.shared.h"

void main() {
    vec2 corner = mix(paper.maskArea.xy, paper.maskArea.zw, vec2(gl_VertexID & 1, gl_VertexID >> 1));
    gl_Position = paper.lightClipFromWorld * vec4(corner.x, paper.water.x, corner.y, 1.0);
}
