#version 450 core
// Models into a depth-only view. Variant: MASKED.
#include "frame/view.shared.h"
#include "frame/geometry.shared.h"

layout(location = SHOAL_ATTRIBUTE_POSITION) in vec3 position;
layout(location = SHOAL_ATTRIBUTE_DRAW) in uint drawIndex;
#ifdef MASKED
layout(location = SHOAL_ATTRIBUTE_UV) in vec2 uv;
layout(location = SHOAL_ATTRIBUTE_COLOR) in vec4 color;
layout(location = SHOAL_ATTRIBUTE_UV1) in vec2 uv1;
layout(location = 0) out vec4 vUv;
layout(location = 1) out float vAlpha;
#endif

layout(std430, binding = SHOAL_STORAGE_INSTANCES) readonly buffer DrawRecords { DrawRecord draws[]; };
layout(std430, binding = SHOAL_STORAGE_MATERIALS) readonly buffer MaterialRecords { MaterialRecord materials[]; };

void main() {
    vec4 rowX = draws[drawIndex].worldFromModel[0], rowY = draws[drawIndex].worldFromModel[1];
    vec4 rowZ = draws[drawIndex].worldFromModel[2];
    vec4 p = vec4(position, 1.0);
    gl_Position = clipFromWorld * vec4(dot(rowX, p), dot(rowY, p), dot(rowZ, p), 1.0);
#ifdef MASKED
    vUv = vec4(uv, uv1);
    vAlpha = materials[draws[drawIndex].material].baseColor.a * color.a * draws[drawIndex].tint.a;
#endif
}
