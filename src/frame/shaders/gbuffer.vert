#version 450 core
// Models into the G-buffer, and into the forward pass of transparent surfaces. Variants: ALL_TEXTURES (normal map and
// the rest), BASE_TEXTURE (base colour only), neither: flat colours, all of the material travels from here.
#include "frame/view.shared.h"
#include "frame/geometry.shared.h"
#include "frame/gbuffer.lib.glsl"

layout(location = SHOAL_ATTRIBUTE_POSITION) in vec3 position;
layout(location = SHOAL_ATTRIBUTE_NORMAL) in vec2 normal;
layout(location = SHOAL_ATTRIBUTE_TANGENT) in vec4 tangent;
layout(location = SHOAL_ATTRIBUTE_UV) in vec2 uv;
layout(location = SHOAL_ATTRIBUTE_COLOR) in vec4 color;
layout(location = SHOAL_ATTRIBUTE_UV1) in vec2 uv1;
layout(location = SHOAL_ATTRIBUTE_PREVIOUS) in vec3 previousPosition;
layout(location = SHOAL_ATTRIBUTE_DRAW) in uint drawIndex;

layout(std430, binding = SHOAL_STORAGE_INSTANCES) readonly buffer DrawRecords { DrawRecord draws[]; };
layout(std430, binding = SHOAL_STORAGE_MATERIALS) readonly buffer MaterialRecords { MaterialRecord materials[]; };

layout(location = 0) out vec3 vNormal;
layout(location = 1) out vec4 vColor;             // linear: material, vertex and instance colour
layout(location = 2) out vec4 vMotion;            // clip xy now, clip xy before (both without jitter)
layout(location = 3) out float vPreviousW;
layout(location = 4) flat out uint vObjectId;
layout(location = 5) flat out vec4 vSurface;      // MaterialRecord::surface
layout(location = 6) flat out vec4 vEmission;     // MaterialRecord::emission
#if defined(BASE_TEXTURE) || defined(ALL_TEXTURES)
layout(location = 7) out vec4 vUv;                // uv set 0, uv set 1
#endif
#ifdef ALL_TEXTURES
layout(location = 8) out vec4 vTangent;
#endif
#ifdef FORWARD
layout(location = 9) out vec3 vPosition;
layout(location = 10) flat out vec4 vDetail;      // MaterialRecord::detail
#endif

vec3 transformed(vec4 rows[3], vec3 p) {
    vec4 h = vec4(p, 1.0);
    return vec3(dot(rows[0], h), dot(rows[1], h), dot(rows[2], h));
}

void main() {
    DrawRecord draw = draws[drawIndex];
    vec3 world = transformed(draw.worldFromModel, position);
    vec3 previousWorld = transformed(draw.previousFromModel, previousPosition);
    gl_Position = clipFromWorld * vec4(world, 1.0);
    gl_ClipDistance[0] = dot(clipPlane, vec4(world, 1.0));
    vec4 steady = steadyClipFromWorld * vec4(world, 1.0);
    vec4 before = previousClipFromWorld * vec4(previousWorld, 1.0);
    vMotion = vec4(steady.xy, before.xy);
    vPreviousW = before.w;

    // Cofactors of the linear part carry normals; a mirror flips their sign.
    vec3 rowX = draw.worldFromModel[0].xyz, rowY = draw.worldFromModel[1].xyz, rowZ = draw.worldFromModel[2].xyz;
    vec3 n = normalFromOctahedral(normal);
    float mirror = (draw.flags & SHOAL_DRAW_MIRRORED) != 0u ? -1.0 : 1.0;
    vNormal = normalize(vec3(dot(cross(rowY, rowZ), n), dot(cross(rowZ, rowX), n), dot(cross(rowX, rowY), n))) * mirror;

    vObjectId = draw.objectId;
    vColor = materials[draw.material].baseColor * vec4(color.rgb * color.rgb, color.a) * draw.tint;
    vSurface = materials[draw.material].surface;
    vEmission = materials[draw.material].emission;
#if defined(BASE_TEXTURE) || defined(ALL_TEXTURES)
    vUv = vec4(uv, uv1);
#endif
#ifdef ALL_TEXTURES
    vTangent = vec4(dot(rowX, tangent.xyz), dot(rowY, tangent.xyz), dot(rowZ, tangent.xyz), tangent.w * mirror);
#endif
#ifdef FORWARD
    vPosition = world;
    vDetail = materials[draw.material].detail;
#endif
}
