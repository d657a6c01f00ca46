#version 450 core
// Where the surface is seen: view depth with the side it is seen from, normal, and how much its slopes vary within the
// pixel. Variant CROSSING: surface_side.glsl.
#include "frame/gbuffer.lib.glsl"
#include "frame/view.shared.h"
#include "water/surface_side.glsl"

layout(location = 0) in vec3 vPosition;

layout(location = 0) out float outDepth;    // positive: seen from above
layout(location = 1) out vec2 outNormal;
layout(location = 2) out float outSpread;   // variance of slope, both axes together

const float kLeastFacing = 0.01;   // cosine between normal and the way to the eye
const float kLongestFootprint = 6.0;

void main() {
    vec3 along = dFdx(vPosition), across = dFdy(vPosition);
    // The pixel on the surface is long and narrow from afar: filtered by less than its length, or waves across would
    // blur with those along.
    float a = dot(along.xz, along.xz), b = dot(across.xz, across.xz), c = dot(along.xz, across.xz);
    float major = sqrt(0.5 * (a + b + sqrt((a - b) * (a - b) + 4.0 * c * c)));
    float minor = abs(along.x * across.z - along.z * across.x) / max(major, 1e-12);
    float footprint = max(sqrt(major * minor), major / kLongestFootprint);
    FilteredWave wave = waveSlopeFiltered(vPosition.xz, footprint);

    // What neighbouring pixels' normals differ by is spread within this one [Tokuyoshi & Kaplanyan 2019].
    vec2 slopeX = dFdx(wave.slope), slopeY = dFdy(wave.slope);
    outSpread = wave.slopeVariance + min(0.25 * (dot(slopeX, slopeX) + dot(slopeY, slopeY)), 0.05);

    // Seen from above, the normal is turned to the eye as far as needed; from below, away from it.
    vec3 normal = normalize(vec3(-wave.slope.x, 1.0, -wave.slope.y));
    vec3 toEye = eye.w > 0.5 ? worldFromView[2].xyz : normalize(eye.xyz - vPosition);
    // Which side is seen follows from where the ray begins: triangles seen edge on turn over as they are rasterised.
    // Only an eye beside the area may see either.
    vec4 near = viewFromClip * vec4(2.0 * gl_FragCoord.xy * size.zw - 1.0, 1.0, 1.0);
    vec3 begin = (worldFromView * vec4(near.xyz / near.w, 1.0)).xyz;
    bool beside = !inArea(begin.xz) && begin.y < waterBlock.shape.x + waterBlock.shape.w;
    bool above = beside ? gl_FrontFacing : !underWater(begin);
    float side = above ? 1.0 : -1.0;
    float facing = side * dot(normal, toEye);
    if (facing < kLeastFacing) normal = normalize(normal + side * toEye * (kLeastFacing - facing));
    outDepth = -side * (viewFromWorld * vec4(vPosition, 1.0)).z;
    outNormal = encodeNormal(normal);
}
