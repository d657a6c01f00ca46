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

// Content::bounds, focus and focusBoxes: of all there is, and of what is worth looking at.
void measure(Content& content);

// A wide plane under a bare model takes its shadow. It reflects as much as the sky's own ground, so the two meet
// without a line. Models that are places (a street, a harbour) bring their own ground.
Result<void> addGround(const EnvironmentSpec& environment, Content& content);

}  // namespace shoal::scene
