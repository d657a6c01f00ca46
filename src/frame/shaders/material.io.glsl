// A material's textures at a fragment. Variants as in gbuffer.vert.
#ifndef SHOAL_FRAME_MATERIAL_IO_GLSL
#define SHOAL_FRAME_MATERIAL_IO_GLSL

#include "frame/geometry.shared.h"

layout(std140, binding = SHOAL_BLOCK_PASS) uniform MaterialBlock { MaterialRecord material; };
layout(binding = SHOAL_UNIT_BASE_COLOR) uniform sampler2D materialBaseColor;
#ifdef ALL_TEXTURES
layout(binding = SHOAL_UNIT_METAL_ROUGH) uniform sampler2D materialMetalRough;
layout(binding = SHOAL_UNIT_NORMAL) uniform sampler2D materialNormal;
layout(binding = SHOAL_UNIT_OCCLUSION) uniform sampler2D materialOcclusion;
layout(binding = SHOAL_UNIT_EMISSION) uniform sampler2D materialEmission;
#endif

// KHR_texture_transform; uvs holds both sets.
vec2 materialUv(int slot, vec4 uvs) {
    vec4 rowU = material.uv[2 * slot], rowV = material.uv[2 * slot + 1];
    vec2 uv = rowU.w > 0.5 ? uvs.zw : uvs.xy;
    return vec2(dot(rowU.xy, uv) + rowU.z, dot(rowV.xy, uv) + rowV.z);
}

vec4 sampledBaseColor(vec4 uvs) { return texture(materialBaseColor, materialUv(SHOAL_TEXTURE_BASE_COLOR, uvs)); }

#ifdef ALL_TEXTURES
// World normal of the normal map on a surface with interpolated normal and tangent.
vec3 mappedNormal(vec3 normal, vec4 tangent, vec4 uvs) {
    vec2 xy = (texture(materialNormal, materialUv(SHOAL_TEXTURE_NORMAL, uvs)).xy * 2.0 - 1.0) * material.detail.x;
    // 8 bits have no exact zero: 128 / 255 is meant.
    xy -= (1.0 / 255.0) * material.detail.x;
    float z = sqrt(max(1.0 - dot(xy, xy), 1e-4));
    vec3 t = tangent.xyz - normal * dot(normal, tangent.xyz);
    float tLength = length(t);
    if (tLength < 1e-6) return normal;
    t /= tLength;
    vec3 b = cross(normal, t) * (tangent.w < 0.0 ? -1.0 : 1.0);
    return normalize(t * xy.x + b * xy.y + normal * z);
}
vec2 sampledRoughMetal(vec4 uvs) { return texture(materialMetalRough, materialUv(SHOAL_TEXTURE_METAL_ROUGH, uvs)).yz; }
float sampledOcclusion(vec4 uvs) {
    float sampled = texture(materialOcclusion, materialUv(SHOAL_TEXTURE_OCCLUSION, uvs)).x;
    return 1.0 + material.detail.y * (sampled - 1.0);
}
vec3 sampledEmission(vec4 uvs) { return texture(materialEmission, materialUv(SHOAL_TEXTURE_EMISSION, uvs)).xyz; }
#endif

#endif
