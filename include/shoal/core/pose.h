// Poses an animated model at a time of a clip: node matrices, joint matrices, morph weights.
#pragma once

#include <string_view>
#include <vector>

#include <shoal/core/model.h>

namespace shoal {

struct Pose {
    std::vector<Mat4> modelFromNode;               // one a node
    std::vector<std::vector<Mat4>> modelFromBind;  // one list a skin: modelFromNode[joint] * jointFromMesh
    std::vector<std::vector<float>> morphWeights;  // one list a node (empty where its mesh has no targets)
};

// Index of the clip called `name` (exact, then ignoring case); -1 where there is none.
int findClip(const Model& model, std::string_view name);

// Poses `model` at `time` seconds of clip `clip` (-1: the nodes' own transforms). `loop` wraps time into the clip, else
// it is clamped. Reuses the storage of `pose`. Source: glTF 2.0 appendix C (interpolation).
void poseModel(const Model& model, int clip, float time, bool loop, Pose& pose);

// Positions of a primitive of node `node`'s mesh in model space: morphed, then skinned or moved with its node.
std::vector<Vec3> posedPositions(const Model& model, const Pose& pose, int node, const Primitive& primitive);

// Bounds of the posed model's vertices, in model space. Skinned primitives are skinned exactly (one pass over the
// vertices).
Bounds posedBounds(const Model& model, const Pose& pose);

}  // namespace shoal
