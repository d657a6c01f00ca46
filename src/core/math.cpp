// Matrices and rotations. Products and compositions are taken in single precision, as the GPU does them; the inverse
// and what divides by small numbers in double.
#include <shoal/core/assert.h>
#include <shoal/core/math.h>
#include <algorithm>
#include <cmath>
#include <utility>

namespace shoal {

namespace {

// Below this sine two directions count as parallel (2 seconds of arc).
constexpr float kParallelSine = 1e-5f;
// Above this cosine slerp's division by the sine loses more than the chord's error (0.8 degrees).
constexpr double kSlerpLinearCosine = 0.9999;
constexpr double kSingularDeterminant = 1e-30;

Vec3 column(const Mat4& a, int c) { return {a(0, c), a(1, c), a(2, c)}; }

Mat4 fromColumns(Vec3 x, Vec3 y, Vec3 z, Vec3 t) {
    return {{x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, t.x, t.y, t.z, 1}};
}

// Clip w is -z of the view, clip z is nearZ: their ratio is 1 at nearZ and 0 at infinity.
Mat4 pinhole(float scaleX, float scaleY, float nearZ) {
    return {{scaleX, 0, 0, 0, 0, scaleY, 0, 0, 0, 0, 0, -1, 0, 0, nearZ, 0}};
}

}  // namespace

Quat normalize(Quat q) {
    const double l = std::sqrt(double(q.x) * q.x + double(q.y) * q.y + double(q.z) * q.z + double(q.w) * q.w);
    if (!(l > 0)) return {};
    return {float(q.x / l), float(q.y / l), float(q.z / l), float(q.w / l)};
}

Quat operator*(Quat a, Quat b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

Vec3 rotate(Quat q, Vec3 v) {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = cross(u, v) * 2.0f;
    return v + t * q.w + cross(u, t);
}

Quat slerp(Quat a, Quat b, float t) {
    double cosine = double(a.x) * b.x + double(a.y) * b.y + double(a.z) * b.z + double(a.w) * b.w;
    const double sign = cosine < 0 ? -1 : 1;
    cosine *= sign;
    double fromA = 1.0 - t, fromB = t;
    if (cosine < kSlerpLinearCosine) {
        const double angle = std::acos(cosine), sine = std::sin(angle);
        fromA = std::sin(angle * (1.0 - t)) / sine;
        fromB = std::sin(angle * t) / sine;
    }
    fromB *= sign;
    return normalize(Quat{float(fromA * a.x + fromB * b.x), float(fromA * a.y + fromB * b.y),
                          float(fromA * a.z + fromB * b.z), float(fromA * a.w + fromB * b.w)});
}

Quat axisAngle(Vec3 axis, float angle) {
    const float s = std::sin(angle * 0.5f);
    return {axis.x * s, axis.y * s, axis.z * s, std::cos(angle * 0.5f)};
}

Quat eulerXyz(Vec3 angles) {
    return axisAngle({0, 0, 1}, angles.z) * axisAngle({0, 1, 0}, angles.y) * axisAngle({1, 0, 0}, angles.x);
}

// [Shepperd 1978]: the largest of the four components first, the others from it.
Quat quatOfAxes(const double (&axes)[3][3]) {
    const double trace = axes[0][0] + axes[1][1] + axes[2][2];
    const double terms[4] = {axes[0][0], axes[1][1], axes[2][2], trace};
    const int i = int(std::max_element(terms, terms + 4) - terms);
    double q[4];
    if (i == 3) {
        q[0] = axes[1][2] - axes[2][1], q[1] = axes[2][0] - axes[0][2], q[2] = axes[0][1] - axes[1][0];
        q[3] = 1 + trace;
    } else {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = 1 + axes[i][i] - axes[j][j] - axes[k][k];
        q[j] = axes[i][j] + axes[j][i], q[k] = axes[i][k] + axes[k][i];
        q[3] = axes[j][k] - axes[k][j];
    }
    const double l = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    if (!(l > 0)) return {};
    return {float(q[0] / l), float(q[1] / l), float(q[2] / l), float(q[3] / l)};
}

Mat4 operator*(const Mat4& a, const Mat4& b) {
    Mat4 product;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            product(r, c) = a(r, 0) * b(0, c) + a(r, 1) * b(1, c) + a(r, 2) * b(2, c) + a(r, 3) * b(3, c);
    return product;
}

Vec4 operator*(const Mat4& a, Vec4 v) {
    const auto row = [&](int r) { return a(r, 0) * v.x + a(r, 1) * v.y + a(r, 2) * v.z + a(r, 3) * v.w; };
    return {row(0), row(1), row(2), row(3)};
}

Vec3 transformPoint(const Mat4& a, Vec3 p) {
    const Vec4 v = a * Vec4{p.x, p.y, p.z, 1};
    return v.w == 1 ? Vec3{v.x, v.y, v.z} : Vec3{v.x / v.w, v.y / v.w, v.z / v.w};
}

Vec3 transformDirection(const Mat4& a, Vec3 d) { return column(a, 0) * d.x + column(a, 1) * d.y + column(a, 2) * d.z; }

Mat4 translation(Vec3 t) { return compose(t, {}, {1, 1, 1}); }
Quat quatOf(const Mat4& a) {
    double axes[3][3];
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) axes[c][r] = double(a(r, c));
    return quatOfAxes(axes);
}
Mat4 scaling(Vec3 s) { return compose({}, {}, s); }
Mat4 rotation(Quat q) { return compose({}, q, {1, 1, 1}); }

Mat4 compose(Vec3 t, Quat q, Vec3 s) {
    const float xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    const float xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    const float wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    const Vec3 x{1 - 2 * (yy + zz), 2 * (xy + wz), 2 * (xz - wy)};
    const Vec3 y{2 * (xy - wz), 1 - 2 * (xx + zz), 2 * (yz + wx)};
    const Vec3 z{2 * (xz + wy), 2 * (yz - wx), 1 - 2 * (xx + yy)};
    return fromColumns(x * s.x, y * s.y, z * s.z, t);
}

// Laplace expansion by the 2x2 minors of the upper and the lower two rows.
std::optional<Mat4> inverse(const Mat4& a) {
    const auto e = [&](int r, int c) { return double(a(r, c)); };
    const auto minor = [&](int r0, int r1, int c0, int c1) { return e(r0, c0) * e(r1, c1) - e(r1, c0) * e(r0, c1); };
    const double s0 = minor(0, 1, 0, 1), s1 = minor(0, 1, 0, 2), s2 = minor(0, 1, 0, 3);
    const double s3 = minor(0, 1, 1, 2), s4 = minor(0, 1, 1, 3), s5 = minor(0, 1, 2, 3);
    const double c0 = minor(2, 3, 0, 1), c1 = minor(2, 3, 0, 2), c2 = minor(2, 3, 0, 3);
    const double c3 = minor(2, 3, 1, 2), c4 = minor(2, 3, 1, 3), c5 = minor(2, 3, 2, 3);
    const double det = s0 * c5 - s1 * c4 + s2 * c3 + s3 * c2 - s4 * c1 + s5 * c0;
    if (!(std::abs(det) >= kSingularDeterminant) || !std::isfinite(det)) return std::nullopt;

    const double rows[4][4] = {
        {e(1, 1) * c5 - e(1, 2) * c4 + e(1, 3) * c3, -e(0, 1) * c5 + e(0, 2) * c4 - e(0, 3) * c3,
         e(3, 1) * s5 - e(3, 2) * s4 + e(3, 3) * s3, -e(2, 1) * s5 + e(2, 2) * s4 - e(2, 3) * s3},
        {-e(1, 0) * c5 + e(1, 2) * c2 - e(1, 3) * c1, e(0, 0) * c5 - e(0, 2) * c2 + e(0, 3) * c1,
         -e(3, 0) * s5 + e(3, 2) * s2 - e(3, 3) * s1, e(2, 0) * s5 - e(2, 2) * s2 + e(2, 3) * s1},
        {e(1, 0) * c4 - e(1, 1) * c2 + e(1, 3) * c0, -e(0, 0) * c4 + e(0, 1) * c2 - e(0, 3) * c0,
         e(3, 0) * s4 - e(3, 1) * s2 + e(3, 3) * s0, -e(2, 0) * s4 + e(2, 1) * s2 - e(2, 3) * s0},
        {-e(1, 0) * c3 + e(1, 1) * c1 - e(1, 2) * c0, e(0, 0) * c3 - e(0, 1) * c1 + e(0, 2) * c0,
         -e(3, 0) * s3 + e(3, 1) * s1 - e(3, 2) * s0, e(2, 0) * s3 - e(2, 1) * s1 + e(2, 2) * s0}};
    Mat4 result;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) result(r, c) = float(rows[r][c] / det);
    return result;
}

Mat4 transpose(const Mat4& a) {
    Mat4 t;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) t(r, c) = a(c, r);
    return t;
}

// The cofactor matrix is det * transpose(inverse). The sign of det is divided out again, so that a mirrored body's
// normals still point out of it.
Mat3 normalMatrix(const Mat4& a) {
    const float sign = determinant3(a) < 0 ? -1.0f : 1.0f;
    const Vec3 x = cross(column(a, 1), column(a, 2)) * sign;
    const Vec3 y = cross(column(a, 2), column(a, 0)) * sign;
    const Vec3 z = cross(column(a, 0), column(a, 1)) * sign;
    return {{x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z}};
}

float determinant3(const Mat4& a) { return dot(column(a, 0), cross(column(a, 1), column(a, 2))); }

Mat4 lookAt(Vec3 eye, Vec3 target, Vec3 up) {
    Vec3 back = normalize(eye - target);
    if (back == Vec3{}) back = {0, 0, 1};
    Vec3 right = cross(normalize(up), back);
    if (!(length(right) > kParallelSine)) right = cross(std::abs(back.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{0, 0, -1}, back);
    right = normalize(right);
    const Vec3 trueUp = cross(back, right);
    const Mat4 axes = fromColumns(right, trueUp, back, {});
    return transpose(axes) * translation(-eye);
}

Mat4 perspectiveReversed(float verticalFov, float aspect, float nearZ) {
    SHOAL_ASSERT(verticalFov > 0 && verticalFov < kPi);
    SHOAL_ASSERT_GT(aspect, 0);
    SHOAL_ASSERT_GT(nearZ, 0);
    const double f = 1.0 / std::tan(0.5 * double(verticalFov));
    return pinhole(float(f / aspect), float(f), nearZ);
}

Mat4 intrinsicsReversed(float fx, float fy, float cx, float cy, float widthPx, float heightPx, float nearZ) {
    SHOAL_ASSERT(fx > 0 && fy > 0);
    SHOAL_ASSERT(widthPx > 0 && heightPx > 0);
    SHOAL_ASSERT_GT(nearZ, 0);
    Mat4 clip = pinhole(2 * fx / widthPx, 2 * fy / heightPx, nearZ);
    clip(0, 2) = 1 - 2 * cx / widthPx;
    clip(1, 2) = 2 * cy / heightPx - 1;
    return clip;
}

Mat4 orthographicReversed(float left, float right, float bottom, float top, float nearZ, float farZ) {
    SHOAL_ASSERT_NE(left, right);
    SHOAL_ASSERT_NE(bottom, top);
    SHOAL_ASSERT_NE(nearZ, farZ);
    const double width = double(right) - left, height = double(top) - bottom, depth = double(farZ) - nearZ;
    Mat4 clip;
    clip(0, 0) = float(2 / width);
    clip(1, 1) = float(2 / height);
    clip(2, 2) = float(1 / depth);
    clip(0, 3) = float(-(double(right) + left) / width);
    clip(1, 3) = float(-(double(top) + bottom) / height);
    clip(2, 3) = float(farZ / depth);
    return clip;
}

// Column by column the smaller and the larger product [Arvo, Graphics Gems 1990].
Bounds transformBounds(const Mat4& a, const Bounds& b) {
    if (b.empty()) return {};
    const Vec3 t = column(a, 3);
    Bounds result{t, t};
    const float lo[3] = {b.lo.x, b.lo.y, b.lo.z}, hi[3] = {b.hi.x, b.hi.y, b.hi.z};
    for (int c = 0; c < 3; ++c) {
        const Vec3 p = column(a, c) * lo[c], q = column(a, c) * hi[c];
        result.lo += min(p, q);
        result.hi += max(p, q);
    }
    return result;
}

float srgbFromLinear(float linear) {
    if (linear <= 0.0031308f) return 12.92f * linear;
    return 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

float linearFromSrgb(float srgb) {
    if (srgb <= 0.04045f) return srgb / 12.92f;
    return std::pow((srgb + 0.055f) / 1.055f, 2.4f);
}

}  // namespace shoal
