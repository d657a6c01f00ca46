// Squares of light space that an eye needs. They follow what it sees in steps: their texels are powers of two of a
// metre, their sizes depend on distances and on the scene, not on where the eye stands. So a moving eye sees one and
// the same pattern of light.
#pragma once

#include <cmath>
#include <vector>

#include <shoal/light/lights.h>
#include <shoal/light/view.h>

namespace shoal::water {

struct Square {
    double x = 0, z = 0, side = 0;  // middle
};

// Grows with x in quarter octaves.
inline double steppedUp(double x) { return std::exp2(std::ceil(std::log2(x > 1e-3 ? x : 1e-3) * 4 - 1e-6) / 4); }

// One side of the surface for one light. Heights count along the light's way ("travel"): e = side * y.
struct Side {
    int light = -1;
    bool up = false;
    bool lamp = false;
    Vec3 toLight;   // unit, or the lamp's place
    Vec3 apparent;  // unit towards the apparent light, or its apparent place
    Vec2 mean;      // metres along x, z a metre of travel
    double cosMean = 1;
    double level = 0, top = 0, bottom = 0;
    double sign() const { return up ? 1 : -1; }
    double nearY() const { return up ? bottom : top; }
    double farY() const { return up ? top : bottom; }

    Vec2 slide(Vec3 p) const {
        if (!lamp) {
            const float travel = float(sign() * (double(p.y) - level));
            return {p.x - mean.x * travel, p.z - mean.y * travel};
        }
        const float scale = float((level - double(apparent.y)) / (double(p.y) - double(apparent.y)));
        return {apparent.x + (p.x - apparent.x) * scale, apparent.z + (p.z - apparent.z) * scale};
    }
};

// What the eye sees of the scene between two heights: its extent in light space and how far away it is.
struct Seen {
    double nearest = 1e30, farthest = 0;  // metres of view depth
    Vec2 lo{1e30f, 1e30f}, hi{-1e30f, -1e30f};
    bool any() const { return farthest > 0; }
};
Seen whatIsSeen(const light::View& eye, const Side& side, const Bounds& box, double distance);

// The finest first; the last holds all that is seen.
std::vector<Square> sunSquares(const light::View& eye, const Side& side, const Bounds& box, double distance,
                               int cascades);
// Where the lamp's light meets the level, as far as it matters.
Square lampSquare(const light::PunctualLight& light, double height, double distance);

}  // namespace shoal::water
