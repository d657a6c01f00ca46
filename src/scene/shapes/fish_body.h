// One fish as a mesh that bends: a skin over a chain of four joints.
#pragma once

#include <array>
#include <string_view>

#include "scene/shapes/builder.h"

namespace shoal::scene::shapes {

// A fish of length 1 along z, snout at z = 0.5, back up. Joints lie at kFishJoints; the first is where it swims.
inline constexpr std::array<float, 4> kFishJoints{0.12f, 0.0f, -0.18f, -0.34f};  // z

// Adds the body to one part and the fins to another; both get weights from fishWeights.
void addFish(Part& body, Part& fins, Part& eyes, std::string_view species);

// How much of each joint moves a vertex at z; at most two are not 0.
Vec4 fishWeights(float z);

}  // namespace shoal::scene::shapes
