#version 450 core
// Poses vertices: morph targets, then linear blend skinning [glTF 2.0, 3.7.3.3]. One work group a chunk.
#include "frame/skin.shared.h"
#include "frame/gbuffer.lib.glsl"

layout(local_size_x = SHOAL_SKIN_GROUP) in;

layout(std430, binding = SHOAL_SKIN_CHUNKS) readonly buffer Chunks { SkinChunk chunks[]; };
layout(std430, binding = SHOAL_SKIN_POSE) readonly buffer Pose { vec4 poseRows[]; };
layout(std430, binding = SHOAL_SKIN_POSITIONS_IN) readonly buffer PositionsIn { float positionsIn[]; };
layout(std430, binding = SHOAL_SKIN_FRAMES_IN) readonly buffer FramesIn { uvec2 framesIn[]; };
layout(std430, binding = SHOAL_SKIN_INFLUENCES) readonly buffer Influences { uvec4 influences[]; };
layout(std430, binding = SHOAL_SKIN_MORPHS) readonly buffer Morphs { float morphs[]; };
layout(std430, binding = SHOAL_SKIN_POSITIONS_OUT) writeonly buffer PositionsOut { float positionsOut[]; };
layout(std430, binding = SHOAL_SKIN_FRAMES_OUT) writeonly buffer FramesOut { uvec2 framesOut[]; };
layout(location = 0) uniform uint chunksARow;   // work groups along x; more chunks follow along y
layout(location = 1) uniform uint chunkCount;

vec3 unpackTangent(uint word) {
    ivec3 i = ivec3(int(word << 22), int(word << 12), int(word << 2)) >> 22;
    return max(vec3(i) / 511.0, vec3(-1.0));
}
uint packTangent(vec3 t, uint handedness) {
    uvec3 i = uvec3(ivec3(round(clamp(t, vec3(-1.0), vec3(1.0)) * 511.0))) & 0x3ffu;
    return i.x | i.y << 10 | i.z << 20 | (handedness & 0xc0000000u);
}

void main() {
    uint chunkIndex = gl_WorkGroupID.y * chunksARow + gl_WorkGroupID.x;
    if (chunkIndex >= chunkCount) return;
    SkinChunk chunk = chunks[chunkIndex];
    uint v = gl_LocalInvocationID.x;
    if (v >= chunk.vertexCount) return;

    uint source = chunk.sourceVertex + v;
    vec3 position = vec3(positionsIn[3u * source], positionsIn[3u * source + 1u], positionsIn[3u * source + 2u]);
    uvec2 frame = framesIn[source];
    vec3 normal = normalFromOctahedral(unpackSnorm2x16(frame.x));
    vec3 tangent = unpackTangent(frame.y);

    for (uint k = 0u; k < chunk.morphCount; ++k) {
        float weight = poseRows[chunk.weightRow + k / 4u][k % 4u];
        if (weight == 0.0) continue;
        uint m = 6u * (chunk.morphOffset + k * chunk.morphStride + v);
        position += weight * vec3(morphs[m], morphs[m + 1u], morphs[m + 2u]);
        normal += weight * vec3(morphs[m + 3u], morphs[m + 4u], morphs[m + 5u]);
    }

    if (chunk.influence != ~0u) {
        uvec4 stored = influences[chunk.influence + v];
        uvec4 joints = uvec4(stored.x & 0xffffu, stored.x >> 16, stored.y & 0xffffu, stored.y >> 16);
        vec4 weights = vec4(unpackUnorm2x16(stored.z), unpackUnorm2x16(stored.w));
        vec4 rowX = vec4(0.0), rowY = vec4(0.0), rowZ = vec4(0.0);
        for (int k = 0; k < 4; ++k) {
            uint row = chunk.jointRow + 3u * joints[k];
            rowX += weights[k] * poseRows[row];
            rowY += weights[k] * poseRows[row + 1u];
            rowZ += weights[k] * poseRows[row + 2u];
        }
        vec4 p = vec4(position, 1.0);
        position = vec3(dot(rowX, p), dot(rowY, p), dot(rowZ, p));
        normal = vec3(dot(cross(rowY.xyz, rowZ.xyz), normal), dot(cross(rowZ.xyz, rowX.xyz), normal),
                      dot(cross(rowX.xyz, rowY.xyz), normal));
        tangent = vec3(dot(rowX.xyz, tangent), dot(rowY.xyz, tangent), dot(rowZ.xyz, tangent));
    }

    uint target = chunk.targetVertex + v;
    positionsOut[3u * target] = position.x;
    positionsOut[3u * target + 1u] = position.y;
    positionsOut[3u * target + 2u] = position.z;
    normal = normalize(normal);
    float tangentLength = length(tangent);
    tangent = tangentLength > 0.0 ? tangent / tangentLength : vec3(1.0, 0.0, 0.0);
    framesOut[target] = uvec2(packSnorm2x16(octahedralFromNormal(normal)), packTangent(tangent, frame.y));
}
