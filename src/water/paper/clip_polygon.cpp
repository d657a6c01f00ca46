// [Sutherland & Hodgman 1974], faces of each body clipped by the other's planes.
#include "water/paper/clip_polygon.h"

#include <span>

namespace shoal::water {
namespace {

struct Plane {
    Vec3 normal;  // inwards
    float offset = 0;
    float height(Vec3 p) const { return dot(normal, p) + offset; }
};
using Corners = std::array<Vec3, 8>;
using Planes = std::array<Plane, 6>;

// Each plane of six may add a corner to a quad.
struct Polygon {
    std::array<Vec3, 12> points{};
    int count = 0;
    void add(Vec3 p) {
        if (count < int(points.size())) points[std::size_t(count++)] = p;
    }
};

constexpr int kFaces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};

Planes planesOf(const Corners& corners) {
    Vec3 center;
    for (const Vec3& corner : corners) center += corner / 8;
    Planes planes;
    for (std::size_t i = 0; i < 6; ++i) {
        const auto at = [&](int k) { return corners[std::size_t(kFaces[i][k])]; };
        // Diagonals: a frustum's near face may be too small for its edges to tell its plane.
        Vec3 normal = normalize(cross(at(2) - at(0), at(3) - at(1)));
        if (dot(normal, center - at(0)) < 0) normal = -normal;
        planes[i] = {normal, -dot(normal, at(0))};
    }
    return planes;
}

Polygon clipped(const Polygon& polygon, const Plane& plane) {
    Polygon out;
    for (int i = 0; i < polygon.count; ++i) {
        const Vec3 a = polygon.points[std::size_t(i)], b = polygon.points[std::size_t((i + 1) % polygon.count)];
        const float heightA = plane.height(a), heightB = plane.height(b);
        if (heightA >= 0) out.add(a);
        if ((heightA >= 0) != (heightB >= 0)) out.add(lerp(a, b, heightA / (heightA - heightB)));
    }
    return out;
}

void addFaces(VisiblePoints& points, const Corners& corners, const Planes& planes) {
    for (const auto& face : kFaces) {
        Polygon polygon;
        for (const int k : face) polygon.add(corners[std::size_t(k)]);
        for (const Plane& plane : planes) polygon = clipped(polygon, plane);
        for (int i = 0; i < polygon.count && points.count < int(points.points.size()); ++i)
            points.points[std::size_t(points.count++)] = polygon.points[std::size_t(i)];
    }
}

}  // namespace

VisiblePoints visiblePoints(const std::array<Vec3, 8>& frustum, const Bounds& box) {
    // A flat box would have no inside for the planes to look to.
    Bounds solid = box;
    const float least = 1e-4f * box.radius() + 1e-5f;
    solid.lo = solid.lo - Vec3{least, least, least};
    solid.hi = solid.hi + Vec3{least, least, least};
    Corners corners;
    for (int i = 0; i < 8; ++i)
        corners[std::size_t(i)] = {(i & 1) ? solid.hi.x : solid.lo.x, (i & 2) ? solid.hi.y : solid.lo.y,
                                   (i & 4) ? solid.hi.z : solid.lo.z};
    VisiblePoints points;
    addFaces(points, frustum, planesOf(corners));
    addFaces(points, corners, planesOf(frustum));
    return points;
}

}  // namespace shoal::water
