// Plain aggregates for points, directions, colours and matrices, and the few operations a host needs on them.
// Right-handed, y up, metres, radians. Matrices are column-major and named targetFromSource.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

namespace shoal {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr double kPiD = 3.14159265358979323846;

constexpr float radians(float degrees) { return degrees * (kPi / 180.0f); }
constexpr float degrees(float radians) { return radians * (180.0f / kPi); }

struct Vec2 {
    float x = 0, y = 0;
    bool operator==(const Vec2&) const = default;
};
struct Vec3 {
    float x = 0, y = 0, z = 0;
    bool operator==(const Vec3&) const = default;
};
struct Vec4 {
    float x = 0, y = 0, z = 0, w = 0;
    bool operator==(const Vec4&) const = default;
};
struct IVec2 {
    int x = 0, y = 0;
    bool operator==(const IVec2&) const = default;
};
struct IVec3 {
    int x = 0, y = 0, z = 0;
    bool operator==(const IVec3&) const = default;
};
struct U16Vec4 {
    std::uint16_t x = 0, y = 0, z = 0, w = 0;
    bool operator==(const U16Vec4&) const = default;
};
// Rotation x, y, z (vector part), w (scalar part), unit length.
struct Quat {
    float x = 0, y = 0, z = 0, w = 1;
    bool operator==(const Quat&) const = default;
};
// Column-major: element (row, column) is m[column * 3 + row].
struct Mat3 {
    std::array<float, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};
    bool operator==(const Mat3&) const = default;
};
// Column-major: element (row, column) is m[column * 4 + row]. Identity by default.
struct Mat4 {
    std::array<float, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    float operator()(int row, int column) const { return m[column * 4 + row]; }
    float& operator()(int row, int column) { return m[column * 4 + row]; }
    bool operator==(const Mat4&) const = default;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(Vec2 a, float s) { return {a.x * s, a.y * s}; }
constexpr Vec2 operator*(float s, Vec2 a) { return a * s; }
constexpr float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
inline float length(Vec2 a) { return std::sqrt(dot(a, a)); }

constexpr Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
constexpr Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr Vec3 operator*(float s, Vec3 a) { return a * s; }
constexpr Vec3 operator/(Vec3 a, float s) { return a * (1.0f / s); }
constexpr Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
constexpr Vec3& operator-=(Vec3& a, Vec3 b) { return a = a - b; }
constexpr Vec3& operator*=(Vec3& a, float s) { return a = a * s; }
constexpr float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
// Unit vector along a; (0, 0, 0) for a zero vector.
inline Vec3 normalize(Vec3 a) {
    const float l = length(a);
    return l > 0 ? a / l : Vec3{};
}
constexpr Vec3 lerp(Vec3 a, Vec3 b, float t) { return a + (b - a) * t; }
constexpr Vec3 min(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
constexpr Vec3 max(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

constexpr Vec4 operator+(Vec4 a, Vec4 b) { return {a.x + b.x, a.y + b.y, a.z + b.z, a.w + b.w}; }
constexpr Vec4 operator*(Vec4 a, float s) { return {a.x * s, a.y * s, a.z * s, a.w * s}; }
constexpr float dot(Vec4 a, Vec4 b) { return a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w; }

Quat normalize(Quat q);
Quat operator*(Quat a, Quat b);
Vec3 rotate(Quat q, Vec3 v);
// Shortest-arc spherical interpolation, t in [0, 1].
Quat slerp(Quat a, Quat b, float t);
// Right-handed rotation by `angle` radians about the unit vector `axis`.
Quat axisAngle(Vec3 axis, float angle);
// Rotations about x, then y, then z, in radians (applied z * y * x).
Quat eulerXyz(Vec3 angles);
// The rotation that takes x, y and z to axes[0], axes[1] and axes[2]: unit, perpendicular, right-handed.
Quat quatOfAxes(const double (&axes)[3][3]);

Mat4 operator*(const Mat4& a, const Mat4& b);
Vec4 operator*(const Mat4& a, Vec4 v);
Vec3 transformPoint(const Mat4& a, Vec3 p);      // divides by w
Vec3 transformDirection(const Mat4& a, Vec3 d);  // linear part only, not normalised
Mat4 translation(Vec3 t);
Mat4 scaling(Vec3 s);
Mat4 rotation(Quat q);
Mat4 compose(Vec3 translation, Quat rotation, Vec3 scale);  // T * R * S
Quat quatOf(const Mat4& a);                                 // of the linear part, a rotation
// The inverse, computed in double precision; nothing for a singular matrix (|det| below 1e-30).
std::optional<Mat4> inverse(const Mat4& a);
Mat4 transpose(const Mat4& a);
// Cofactor matrix of the linear part times the sign of its determinant: transforms normals (length not kept), right for
// non-uniform scale and mirrors.
Mat3 normalMatrix(const Mat4& a);
float determinant3(const Mat4& a);  // of the linear part; negative for a mirror

// viewFromWorld of an eye at `eye` looking at `target`; falls back to another up when up is parallel to the direction.
Mat4 lookAt(Vec3 eye, Vec3 target, Vec3 up);
// clipFromView, reversed z in [0, 1] (1 at the near plane, 0 at infinity): OpenGL with clip control ZERO_TO_ONE.
Mat4 perspectiveReversed(float verticalFov, float aspect, float nearZ);
// The same from a pinhole camera's intrinsics in pixels; the principal point counts from the image's top left corner.
Mat4 intrinsicsReversed(float fx, float fy, float cx, float cy, float widthPx, float heightPx, float nearZ);
// clipFromView of an orthographic camera, reversed z: 1 at nearZ, 0 at farZ.
Mat4 orthographicReversed(float left, float right, float bottom, float top, float nearZ, float farZ);

// An axis-aligned box; empty (lo > hi) by default.
struct Bounds {
    Vec3 lo{1e30f, 1e30f, 1e30f};
    Vec3 hi{-1e30f, -1e30f, -1e30f};
    bool empty() const { return lo.x > hi.x || lo.y > hi.y || lo.z > hi.z; }
    void add(Vec3 p) { lo = min(lo, p), hi = max(hi, p); }
    void add(const Bounds& b) { lo = min(lo, b.lo), hi = max(hi, b.hi); }
    Vec3 center() const { return (lo + hi) * 0.5f; }
    Vec3 size() const { return empty() ? Vec3{} : hi - lo; }
    float radius() const { return length(size()) * 0.5f; }
};
Bounds transformBounds(const Mat4& a, const Bounds& b);

constexpr float luminance(Vec3 rgb) { return 0.2126f * rgb.x + 0.7152f * rgb.y + 0.0722f * rgb.z; }
// sRGB transfer function (IEC 61966-2-1) and its inverse, one channel.
float srgbFromLinear(float linear);
float linearFromSrgb(float srgb);

}  // namespace shoal
