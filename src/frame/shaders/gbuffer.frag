#version 450 core
// Opaque and masked surfaces into the G-buffer (frame::GBuffer says what each target holds). Variants: gbuffer.vert,
// and MASKED.
#include "frame/view.shared.h"
#include "frame/gbuffer.lib.glsl"
#if defined(BASE_TEXTURE) || defined(ALL_TEXTURES)
#include "frame/material.io.glsl"
#endif

layout(location = 0) in vec3 vNormal;
layout(location = 1) in vec4 vColor;
layout(location = 2) in vec4 vMotion;
layout(location = 3) in float vPreviousW;
layout(location = 4) flat in uint vObjectId;
layout(location = 5) flat in vec4 vSurface;
layout(location = 6) flat in vec4 vEmission;
#if defined(BASE_TEXTURE) || defined(ALL_TEXTURES)
layout(location = 7) in vec4 vUv;
#endif
#ifdef ALL_TEXTURES
layout(location = 8) in vec4 vTangent;
#endif

layout(location = 0) out vec4 outAlbedo;
layout(location = 1) out vec2 outNormal;
layout(location = 2) out vec4 outMaterial;
layout(location = 3) out vec3 outEmission;
layout(location = 4) out vec2 outMotion;
layout(location = 5) out uint outObjectId;

void main() {
    vec4 color = vColor;
#if defined(BASE_TEXTURE) || defined(ALL_TEXTURES)
    color *= sampledBaseColor(vUv);
#endif
#ifdef MASKED
    if (color.a < vEmission.w) discard;
#endif
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 n = normalize(vNormal) * side;
    vec4 surface = vSurface;
    vec3 emission = vEmission.rgb;
    float occlusion = 1.0;
#ifdef ALL_TEXTURES
    n = mappedNormal(n, vec4(vTangent.xyz, vTangent.w * side), vUv);
    surface.xy *= sampledRoughMetal(vUv);
    occlusion = sampledOcclusion(vUv);
    emission *= sampledEmission(vUv);
#endif
    // Flags: bit 1 is kFlagUnlit, whose colour is its radiance.
    if ((decodeFlags(surface.w) & 2u) != 0u) emission = color.rgb;

    outAlbedo = vec4(encodeAlbedo(color.rgb), occlusion);
    outNormal = encodeNormal(n);
    outMaterial = surface;
    outEmission = emission;
    outMotion = (vMotion.xy * gl_FragCoord.w - vMotion.zw / vPreviousW) * 0.5 * size.xy;
    outObjectId = vObjectId;
}
