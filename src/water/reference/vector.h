// Points and directions in double precision, for the reference only.
#pragma once

#include <cmath>

#include <shoal/core/math.h>

namespace shoal::water {

struct DVec3 {
    double x = 0, y = 0, z = 0;
};

inline DVec3 operator+(DVec3 a, DVec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline DVec3 operator-(DVec3 a, DVec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline DVec3 operator-(DVec3 a) { return {-a.x, -a.y, -a.z}; }
inline DVec3 operator*(DVec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
inline double dot(DVec3 a, DVec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline DVec3 cross(DVec3 a, DVec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline double length(DVec3 a) { return std::sqrt(dot(a, a)); }
inline DVec3 normalize(DVec3 a) {
    const double l = length(a);
    return l > 0 ? a * (1 / l) : DVec3{};
}
inline DVec3 widened(Vec3 a) { return {a.x, a.y, a.z}; }
inline Vec3 narrowed(DVec3 a) { return {float(a.x), float(a.y), float(a.z)}; }

}  // namespace shoal::water
