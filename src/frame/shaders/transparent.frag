#version 450 core
// Blended and transmitting surfaces, shaded as they are drawn, back to front; premultiplied. Variants: gbuffer.vert.
// Transmission after KHR_materials_transmission: an infinitely thin sheet that tints and blurs what lies behind it and
// does not bend it; reflection comes on top at full strength.
#include "frame/view.shared.h"
#include "frame/gbuffer.lib.glsl"
#include "frame/shadow.io.glsl"
#include "frame/shading.lib.glsl"
#if defined(BASE_TEXTURE) || defined(ALL_TEXTURES)
#include "frame/material.io.glsl"
#endif

layout(location = 0) in vec3 vNormal;
layout(location = 1) in vec4 vColor;
layout(location = 4) flat in uint vObjectId;
layout(location = 5) flat in vec4 vSurface;
layout(location = 6) flat in vec4 vEmission;
#if defined(BASE_TEXTURE) || defined(ALL_TEXTURES)
layout(location = 7) in vec4 vUv;
#endif
#ifdef ALL_TEXTURES
layout(location = 8) in vec4 vTangent;
#endif
layout(location = 9) in vec3 vPosition;
layout(location = 10) flat in vec4 vDetail;

layout(binding = SHOAL_UNIT_OPAQUE_COPY) uniform sampler2D opaqueCopy;

layout(location = 0) out vec4 outRadiance;

// Opaque radiance behind this pixel, blurred as much as a rough sheet of this index scatters it: none at index 1.
vec3 transmitted(float roughness, float ior) {
    float spread = roughness * clamp(2.0 * ior - 2.0, 0.0, 1.0);
    float level = log2(max(size.x, size.y)) * spread;
    return textureLod(opaqueCopy, gl_FragCoord.xy * size.zw, level).rgb;
}

void main() {
    vec4 color = vColor;
#if defined(BASE_TEXTURE) || defined(ALL_TEXTURES)
    color *= sampledBaseColor(vUv);
#endif
    float side = gl_FrontFacing ? 1.0 : -1.0;
    Surface s;
    s.position = vPosition;
    s.normal = normalize(vNormal) * side;
    s.baseColor = color.rgb;
    s.roughness = vSurface.x;
    s.metallic = vSurface.y;
    s.f0 = decodeF0(vSurface.z);
    s.occlusion = 1.0;
    vec3 emission = vEmission.rgb;
#ifdef ALL_TEXTURES
    s.normal = mappedNormal(s.normal, vec4(vTangent.xyz, vTangent.w * side), vUv);
    vec2 roughMetal = sampledRoughMetal(vUv);
    s.roughness *= roughMetal.x;
    s.metallic *= roughMetal.y;
    s.occlusion = sampledOcclusion(vUv);
    emission *= sampledEmission(vUv);
#endif
    if ((decodeFlags(vSurface.w) & 2u) != 0u) {   // kFlagUnlit
        outRadiance = vec4(color.rgb * color.a, color.a);
        return;
    }

    float viewDepth = -(viewFromWorld * vec4(vPosition, 1.0)).z;
    vec3 toEye = eye.w > 0.5 ? worldFromView[2].xyz : normalize(eye.xyz - vPosition);
    float transmission = vDetail.z * (1.0 - s.metallic);
    vec3 through = vec3(0.0);
    if (transmission > 0.0) {
        Lobes lobes = lobesOf(s, toEye);
        through = transmitted(s.roughness, vDetail.w) * lobes.diffuse * transmission;
        s.baseColor *= 1.0 - transmission;   // what passes does not scatter
    }
    vec3 radiance = shadeSurface(s, toEye, viewDepth, gl_FragCoord.xy, 1.0) + emission + through;
    outRadiance = vec4(radiance * color.a, color.a);
}
