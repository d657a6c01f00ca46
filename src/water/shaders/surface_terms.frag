#version 450 core
// What the AOVs "transmittance" and "waterDepth" show. Drawn with fullscreen.vert; textures as for
// surface_compose.frag.
#include "water/paths.io.glsl"
#include "water/surface.lib.glsl"
#include "water/surface.shared.h"
#include "water/waves.io.glsl"

layout(binding = SHOAL_UNIT_OPAQUE_DEPTH) uniform sampler2D opaqueDepth;
layout(binding = SHOAL_UNIT_PASS + 3) uniform sampler2D spreadTexture;

layout(location = 0) out vec4 outTransmittance;
layout(location = 1) out float outWaterDepth;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float surface = texelFetch(waterSurfaceDepth, at, 0).x, opaque = texelFetch(opaqueDepth, at, 0).x;
    PixelRay ray = rayOfPixel(gl_FragCoord.xy);
    float index = waterBlock.shape.y, index2 = index * index;
    float variance = 0.5 * texelFetch(spreadTexture, at, 0).x + surfaceBlock.look.x;
    vec3 normal = decodeNormal(texelFetch(waterSurfaceNormal, at, 0).xy);
    float c = clamp(abs(dot(normalize(ray.step), normal)), 1e-3, 1.0);
    float sine2 = (1.0 - c * c) * index2;
    float up = sine2 < 1.0 ? fresnelTransmittance(sqrt(1.0 - sine2), index) * index2 : 0.0;
    float passing = surface > 0.0 ? (1.0 - roughReflectance(c, index, variance)) / index2 : surface < 0.0 ? up : 1.0;
    float lengthM = texelFetch(waterPathTexture, at, 0).z;
    outTransmittance = vec4(exp(-waterBlock.beamAttenuation.rgb * lengthM) * passing, 1.0);

    vec3 p = ray.origin + ray.step * opaque;
    bool inside = all(greaterThan(p.xz, waterBlock.area.xy)) && all(lessThan(p.xz, waterBlock.area.zw));
    float height = waterBlock.shape.z > 0.0 ? waveHeightAt(p.xz) : 0.0;
    outWaterDepth = opaque > 0.0 && inside ? max(waterBlock.shape.x + height - p.y, 0.0) : 0.0;
}
