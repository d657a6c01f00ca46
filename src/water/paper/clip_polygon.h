// What of a box an eye sees, as points.
#pragma once

#include <array>

#include <shoal/core/math.h>

namespace shoal::water {

struct VisiblePoints {
    std::array<Vec3, 160> points{};
    int count = 0;
};

// Corners of the body that a frustum and a box have in common; none where they do not touch. frustum: bit 0 of the
// index is right, bit 1 top, bit 2 far.
VisiblePoints visiblePoints(const std::array<Vec3, 8>& frustum, const Bounds& box);

}  // namespace shoal::water
