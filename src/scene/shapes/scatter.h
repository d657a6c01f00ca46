// Many things of a few kinds: the first of a kind brings the geometry, the others are instances of it.
#pragma once

#include <string>
#include <vector>

#include "scene/shapes/builder.h"
#include "scene/shapes/noise.h"

namespace shoal::scene::shapes {

// Any heading, tilted by up to `tilt` radians.
inline Quat uprightTurn(Dice& dice, float tilt) {
    return axisAngle({0, 1, 0}, dice.range(0, 2 * kPi)) *
           axisAngle(normalize(Vec3{dice.range(-1, 1), 0.001f, dice.range(-1, 1)}), dice.range(0, tilt));
}

// Nodes of a few prototypes: a prototype's first use carries its geometry.
class Scatter {
public:
    Scatter(ModelBuilder& builder, std::string name, std::size_t& nodeCount)
        : builder_(builder), name_(std::move(name)), nodeCount_(nodeCount) {}
    template <class Make>
    void place(std::size_t kind, Vec3 at, Quat turned, float scale, const Make& make) {
        if (made_.size() <= kind) made_.resize(kind + 1, ~std::size_t(0));
        if (made_[kind] != ~std::size_t(0)) {
            builder_.addInstance(name_, made_[kind], at, turned, scale);
        } else {
            builder_.beginNode(name_, at, turned, scale);
            made_[kind] = nodeCount_;
            make();
        }
        ++nodeCount_;
    }

private:
    ModelBuilder& builder_;
    std::string name_;
    std::size_t& nodeCount_;
    std::vector<std::size_t> made_;
};

}  // namespace shoal::scene::shapes
