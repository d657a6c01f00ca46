// What the G-buffer's numbers mean: encoders and decoders, compiled by C++ too.
// Sources: [Cigolle et al. 2014] A Survey of Efficient Representations for Independent Unit Vectors.
#ifndef SHOAL_FRAME_GBUFFER_LIB_GLSL
#define SHOAL_FRAME_GBUFFER_LIB_GLSL

// C++ defines it as `inline`.
#ifndef SHOAL_FUNCTION
#define SHOAL_FUNCTION
#endif

SHOAL_FUNCTION float signNotZero(float x) { return x >= 0.0f ? 1.0f : -1.0f; }

// Unit vector to [-1, 1]^2 and back; largest error at 16 bits a component 0.0037 degrees.
SHOAL_FUNCTION vec2 octahedralFromNormal(vec3 n) {
    float scale = 1.0f / (abs(n.x) + abs(n.y) + abs(n.z));
    float x = n.x * scale;
    float y = n.y * scale;
    if (n.z >= 0.0f) return vec2(x, y);
    return vec2((1.0f - abs(y)) * signNotZero(x), (1.0f - abs(x)) * signNotZero(y));
}
SHOAL_FUNCTION vec3 normalFromOctahedral(vec2 e) {
    float z = 1.0f - abs(e.x) - abs(e.y);
    float fold = max(-z, 0.0f);
    return normalize(vec3(e.x - signNotZero(e.x) * fold, e.y - signNotZero(e.y) * fold, z));
}

// GBuffer::normal, [0, 1]^2.
SHOAL_FUNCTION vec2 encodeNormal(vec3 n) { return octahedralFromNormal(n) * 0.5f + vec2(0.5f, 0.5f); }
SHOAL_FUNCTION vec3 decodeNormal(vec2 stored) { return normalFromOctahedral(stored * 2.0f - vec2(1.0f, 1.0f)); }

// GBuffer::albedo: the square root keeps the steps of 8 bits even to the eye.
SHOAL_FUNCTION vec3 encodeAlbedo(vec3 linearColor) {
    return vec3(sqrt(max(linearColor.x, 0.0f)), sqrt(max(linearColor.y, 0.0f)), sqrt(max(linearColor.z, 0.0f)));
}
SHOAL_FUNCTION vec3 decodeAlbedo(vec3 stored) { return stored * stored; }

// GBuffer::material. Flags travel as an integer / 255; the half guards against rounding.
SHOAL_FUNCTION float encodeFlags(uint flags) { return float(flags) / 255.0f; }
SHOAL_FUNCTION uint decodeFlags(float stored) { return uint(stored * 255.0f + 0.5f); }
// Reflectance of a dielectric at normal incidence is stored / 0.16, so that 8 bits reach from 0 to an index of 2.33.
SHOAL_FUNCTION float encodeF0(float f0) { return f0 / 0.16f; }
SHOAL_FUNCTION float decodeF0(float stored) { return stored * 0.16f; }

// View distance (metres along the axis, positive in front) from own depth, given four elements of clipFromView:
// (zz, zw, wz, ww) with clip.z = zz * z + zw, clip.w = wz * z + ww. Right for perspective and orthographic eyes.
SHOAL_FUNCTION float viewDepthFromDepth(float depth, vec4 projection) {
    return (projection.y - depth * projection.w) / (projection.x - depth * projection.z);
}

#endif
