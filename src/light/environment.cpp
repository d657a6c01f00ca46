// Lat-long environment maps: look-up, and projection on spherical harmonics.
//   [Ramamoorthi & Hanrahan 2001] An Efficient Representation for Irradiance Environment Maps, SIGGRAPH.
// Departs in one point: texels are patches of constant radiance, and the harmonics are integrated over them in closed
// form (they are products of a polynomial in sin and cos of the polar angle and one of the azimuth), so a constant map
// has no quadrature error.
#include <shoal/light/environment.h>

#include <vector>

#include <shoal/core/assert.h>
#include <shoal/core/parallel.h>

namespace shoal::light {
namespace {

// Normalisation of the harmonics of l = 0, 1, 2: x, y, z; xy, yz, xz; 3z2 - 1; x2 - y2.
constexpr double kY0 = 0.28209479177387814;
constexpr double kY1 = 0.48860251190291992;
constexpr double kY2 = 1.0925484305920792;
constexpr double kY20 = 0.31539156525252005;
constexpr double kY22 = 0.54627421529603959;

// Integrals over one column of texels of 1, a, b, b2, a*b with a = sin, b = -cos of the world azimuth: x = a
// sin(polar), z = b sin(polar).
struct ColumnIntegrals {
    double one, a, b, bb, ab;
};
// Integrals over one row of texels of sin(polar) times 1, c, c2, s, s c, s2 with c, s = cos, sin of the polar angle.
struct RowIntegrals {
    double one, c, cc, s, sc, ss;
};

std::vector<ColumnIntegrals> columnIntegrals(int width, double rotation) {
    std::vector<ColumnIntegrals> columns(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
        const double from = (double(x) / width - 0.5) * 2 * kPiD - rotation, to = from + 2 * kPiD / width;
        const double one = 2 * kPiD / width;
        columns[std::size_t(x)] = {one, std::cos(from) - std::cos(to), std::sin(from) - std::sin(to),
                                   one / 2 + (std::sin(2 * to) - std::sin(2 * from)) / 4,
                                   (std::cos(2 * to) - std::cos(2 * from)) / 4};
    }
    return columns;
}

RowIntegrals rowIntegrals(int y, int height) {
    const double from = kPiD * y / height, to = kPiD * (y + 1) / height;
    const double c0 = std::cos(from), c1 = std::cos(to), s0 = std::sin(from), s1 = std::sin(to);
    return {c0 - c1,
            (c0 * c0 - c1 * c1) / 2,
            (c0 * c0 * c0 - c1 * c1 * c1) / 3,
            (to - from) / 2 - (s1 * c1 - s0 * c0) / 2,
            (s1 * s1 * s1 - s0 * s0 * s0) / 3,
            (c0 - c0 * c0 * c0 / 3) - (c1 - c1 * c1 * c1 / 3)};
}

struct Sums {
    std::array<std::array<double, 3>, 9> c{};
};

Sums projectRow(const Image& map, int y, const std::vector<ColumnIntegrals>& columns) {
    double one[3]{}, a[3]{}, b[3]{}, bb[3]{}, ab[3]{};
    for (int x = 0; x < map.width; ++x) {
        const float* texel = map.at(x, y);
        const ColumnIntegrals& column = columns[std::size_t(x)];
        for (int k = 0; k < 3; ++k) {
            one[k] += texel[k] * column.one;
            a[k] += texel[k] * column.a;
            b[k] += texel[k] * column.b;
            bb[k] += texel[k] * column.bb;
            ab[k] += texel[k] * column.ab;
        }
    }
    const RowIntegrals row = rowIntegrals(y, map.height);
    Sums out;
    for (std::size_t k = 0; k < 3; ++k) {
        const double aa = one[k] - bb[k];
        out.c[0][k] = kY0 * row.one * one[k];
        out.c[1][k] = kY1 * row.c * one[k];
        out.c[2][k] = kY1 * row.s * b[k];
        out.c[3][k] = kY1 * row.s * a[k];
        out.c[4][k] = kY2 * row.sc * a[k];
        out.c[5][k] = kY2 * row.sc * b[k];
        out.c[6][k] = kY20 * (3 * row.ss * bb[k] - row.one * one[k]);
        out.c[7][k] = kY2 * row.ss * ab[k];
        out.c[8][k] = kY22 * (row.ss * aa - row.cc * one[k]);
    }
    return out;
}

}  // namespace

Vec3 directionOfTexel(const Environment& environment, int x, int y) {
    const double azimuth = ((x + 0.5) / environment.radiance.width - 0.5) * 2 * kPiD - double(environment.rotation);
    const double polar = (y + 0.5) / environment.radiance.height * kPiD;
    const double s = std::sin(polar);
    return {float(s * std::sin(azimuth)), float(std::cos(polar)), float(-s * std::cos(azimuth))};
}

Vec3 lookUp(const Environment& environment, Vec3 direction) {
    const Image& map = environment.radiance;
    if (map.empty()) return {};
    SHOAL_ASSERT_GE(map.channelCount, 3);
    const Vec3 d = normalize(direction);
    const float turns = (std::atan2(d.x, -d.z) + environment.rotation) / (2 * kPi) + 0.5f;
    const float u = (turns - std::floor(turns)) * float(map.width) - 0.5f;
    const float v = std::clamp(std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi * float(map.height) - 0.5f, 0.0f,
                               float(map.height - 1));
    const float left = std::floor(u), top = std::floor(v);
    const int x0 = (int(left) + map.width) % map.width, x1 = (x0 + 1) % map.width;
    const int y0 = int(top), y1 = std::min(y0 + 1, map.height - 1);
    const auto texel = [&](int x, int y) { return Vec3{map.at(x, y)[0], map.at(x, y)[1], map.at(x, y)[2]}; };
    return lerp(lerp(texel(x0, y0), texel(x1, y0), u - left), lerp(texel(x0, y1), texel(x1, y1), u - left), v - top);
}

Sh9 projectSh(const Environment& environment) {
    const Image& map = environment.radiance;
    Sh9 sh;
    if (map.empty()) return sh;
    SHOAL_ASSERT_GE(map.channelCount, 3);
    const std::vector<ColumnIntegrals> columns = columnIntegrals(map.width, double(environment.rotation));
    const auto add = [](Sums a, const Sums& b) {
        for (std::size_t i = 0; i < 9; ++i)
            for (std::size_t k = 0; k < 3; ++k) a.c[i][k] += b.c[i][k];
        return a;
    };
    const auto projectRows = [&](std::size_t begin, std::size_t end) {
        Sums sums;
        for (std::size_t y = begin; y < end; ++y) sums = add(sums, projectRow(map, int(y), columns));
        return sums;
    };
    const Sums sums = parallelReduce(std::size_t(map.height), 16, Sums{}, projectRows, add);
    for (std::size_t i = 0; i < 9; ++i) sh.c[i] = {float(sums.c[i][0]), float(sums.c[i][1]), float(sums.c[i][2])};
    return sh;
}

Vec3 evaluateIrradiance(const Sh9& sh, Vec3 n) {
    // The clamped cosine's coefficients, [Ramamoorthi & Hanrahan 2001] eq. 8.
    constexpr float kA0 = kPi, kA1 = 2 * kPi / 3, kA2 = kPi / 4;
    const Vec3 e = sh.c[0] * (kA0 * float(kY0)) + (sh.c[1] * n.y + sh.c[2] * n.z + sh.c[3] * n.x) * (kA1 * float(kY1)) +
                   (sh.c[4] * (n.x * n.y) + sh.c[5] * (n.y * n.z) + sh.c[7] * (n.x * n.z)) * (kA2 * float(kY2)) +
                   sh.c[6] * (kA2 * float(kY20) * (3 * n.z * n.z - 1)) +
                   sh.c[8] * (kA2 * float(kY22) * (n.x * n.x - n.y * n.y));
    return max(e, Vec3{0, 0, 0});
}

}  // namespace shoal::light
