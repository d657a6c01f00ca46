// What both water samples' hosts draw with: surfaces into albedo, normal and view depth, and the picture from those and
// the light that Shoal hands back.
#pragma once

// The GL loop's boxes: 36 vertices of a cube, moved and scaled.
inline const char* kCubeShader = R"(#version 450 core
layout(location = 0) uniform mat4 clipFromWorld;
layout(location = 1) uniform vec3 center;
layout(location = 2) uniform vec3 halfSize;
layout(location = 3) uniform vec3 boxColor;
layout(location = 4) uniform vec4 viewZ;
out vec3 normal;
out vec3 color;
out float viewDepth;
void main() {   // 36 vertices of a cube: face, corner
    int face = gl_VertexID / 6, corner = gl_VertexID % 6, axis = face / 2;
    float side = (face & 1) == 0 ? 1.0 : -1.0;
    vec2 uv = vec2(corner == 1 || corner == 2 || corner == 4, corner == 2 || corner == 4 || corner == 5) * 2.0 - 1.0;
    vec3 p = axis == 0   ? vec3(side, uv.x, uv.y * side)
             : axis == 1 ? vec3(uv.x, side, -uv.y * side)
                         : vec3(uv.x * side, uv.y, side);
    normal = vec3(axis == 0, axis == 1, axis == 2) * side;
    color = boxColor;
    vec4 world = vec4(center + halfSize * p, 1.0);
    viewDepth = dot(viewZ, world);
    gl_Position = clipFromWorld * world;
})";

// OpenSceneGraph's shapes.
inline const char* kSceneGraphShader = R"(#version 450 compatibility
out vec3 normal; out vec3 color; out float viewDepth;
uniform mat4 worldFromView;
void main() {
    normal = mat3(worldFromView) * (gl_NormalMatrix * gl_Normal);
    color = gl_Color.rgb;
    viewDepth = -(gl_ModelViewMatrix * gl_Vertex).z;
    gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;
})";

// Octahedral normals [Cigolle et al. 2014], as Shoal reads them.
inline const char* kSurfaceShader = R"(#version 450 core
in vec3 normal;   // world
in vec3 color;
in float viewDepth;   // metres along the view axis
layout(location = 0) out vec4 outAlbedo;
layout(location = 1) out vec2 outNormal;
layout(location = 2) out float outViewDepth;
void main() {
    vec3 n = normalize(normal);
    n /= abs(n.x) + abs(n.y) + abs(n.z);
    vec2 signs = vec2(n.x >= 0.0 ? 1.0 : -1.0, n.y >= 0.0 ? 1.0 : -1.0);
    outNormal = 0.5 + 0.5 * (n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * signs);
    outAlbedo = vec4(color, 1.0);
    outViewDepth = viewDepth;
})";

inline const char* kScreenShader = R"(#version 450 core
void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.5, 1.0); })";

inline const char* kComposeShader = R"(#version 450 core
uniform sampler2D albedo, viewDepth, direct, ambient, inscatter;
uniform vec3 attenuation;   // 1/m
uniform vec2 tangent;       // of half the field of view, across and up
layout(location = 0) out vec4 outColor;
void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float z = texelFetch(viewDepth, at, 0).x;
    vec2 ray = (gl_FragCoord.xy / vec2(textureSize(viewDepth, 0)) * 2.0 - 1.0) * tangent;
    vec3 irradiance = texelFetch(direct, at, 0).rgb / 3.14159265 + texelFetch(ambient, at, 0).rgb;
    vec3 dimming = z > 0.0 ? exp(-attenuation * z * length(vec3(ray, 1.0))) : vec3(0.0);
    vec3 radiance = texelFetch(albedo, at, 0).rgb * irradiance * dimming + texelFetch(inscatter, at, 0).rgb;
    outColor = vec4(pow(1.0 - exp(-1.2 * radiance), vec3(1.0 / 2.2)), 1.0);
})";
