// Pieces of loadContent and cameraAt that stand in other files.
#pragma once

#include <shoal/scene/content.h>

namespace shoal::scene {

// The clip a person would want to see first of a bare model: a walk, else an idle, else the first.
int preferredClip(const Model& model);

// First three channels.
Image toRgb(Image picture);

// Whether the camera that `scene.cameraOfModel` names exists.
Result<void> checkModelCamera(const Scene& scene, const Content& content);

}  // namespace shoal::scene
