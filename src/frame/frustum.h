// Which boxes a view can see.
#pragma once

#include <array>
#include <cmath>

#include <shoal/core/math.h>

namespace shoal::frame {

// A box by centre and half size; cheaper to cull and to transform than by corners.
struct Box {
    Vec3 center, half;
};
inline Box boxOf(const Bounds& b) { return b.empty() ? Box{} : Box{(b.lo + b.hi) * 0.5f, (b.hi - b.lo) * 0.5f}; }
inline Bounds boundsOf(const Box& b) { return {b.center - b.half, b.center + b.half}; }

// The axis-aligned box around a transformed box.
inline Box transformed(const Mat4& m, const Box& b) {
    Box to;
    to.center = {m(0, 0) * b.center.x + m(0, 1) * b.center.y + m(0, 2) * b.center.z + m(0, 3),
                 m(1, 0) * b.center.x + m(1, 1) * b.center.y + m(1, 2) * b.center.z + m(1, 3),
                 m(2, 0) * b.center.x + m(2, 1) * b.center.y + m(2, 2) * b.center.z + m(2, 3)};
    to.half = {std::abs(m(0, 0)) * b.half.x + std::abs(m(0, 1)) * b.half.y + std::abs(m(0, 2)) * b.half.z,
               std::abs(m(1, 0)) * b.half.x + std::abs(m(1, 1)) * b.half.y + std::abs(m(1, 2)) * b.half.z,
               std::abs(m(2, 0)) * b.half.x + std::abs(m(2, 1)) * b.half.y + std::abs(m(2, 2)) * b.half.z};
    return to;
}

// The planes of a reversed-z clip space with z in [0, w]: sides, near (z <= w) and far (z >= 0; at infinity it cuts
// nothing).
class Frustum {
public:
    explicit Frustum(const Mat4& clipFromWorld) {
        const Mat4& m = clipFromWorld;
        auto row = [&](int r) { return Vec4{m(r, 0), m(r, 1), m(r, 2), m(r, 3)}; };
        const Vec4 x = row(0), y = row(1), z = row(2), w = row(3);
        planes_ = {w + x, w + x * -1, w + y, w + y * -1, w + z * -1, z};
    }
    bool sees(const Box& b) const {
        for (const Vec4& p : planes_) {
            const float reach = std::abs(p.x) * b.half.x + std::abs(p.y) * b.half.y + std::abs(p.z) * b.half.z;
            if (p.x * b.center.x + p.y * b.center.y + p.z * b.center.z + p.w < -reach) return false;
        }
        return true;
    }

private:
    std::array<Vec4, 6> planes_;
};

}  // namespace shoal::frame
