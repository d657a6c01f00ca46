// Rays against triangles. Hits are single precision; everything round them is not.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include <shoal/core/result.h>

#include "water/reference/vector.h"

namespace shoal::water {

struct TriangleHit {
    double distance = 0;
    DVec3 normal;  // unit, of the plane of the triangle, to either side
};

class Triangles {
public:
    // Three vertices a triangle; those with a vertex that is not finite are left out. None at all is fine.
    static Result<Triangles> create(std::span<const Vec3> vertices);
    Triangles(Triangles&&) noexcept;
    ~Triangles();

    // The first triangle along a unit direction, farther than `near` and nearer than `far` metres.
    std::optional<TriangleHit> first(DVec3 from, DVec3 direction, double near, double far) const;
    bool blocked(DVec3 from, DVec3 direction, double near, double far) const;

private:
    struct State;
    explicit Triangles(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// Metres to leave a surface by before looking for the next one: single precision's error at a place, tenfold.
inline double leave(DVec3 place) {
    return 1e-5 + 2e-6 * std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
}

}  // namespace shoal::water
