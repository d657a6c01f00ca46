// What can be written beside the picture, and how it is read from the frame's buffers.
#pragma once

#include <shoal/frame/lighting.h>
#include <shoal/frame/post.h>
#include <shoal/frame/targets.h>
#include <shoal/pipeline/pipeline.h>

namespace shoal::pipeline {

class WaterPass;

struct AovSources {
    gl::Device& device;
    const frame::Targets& targets;
    const frame::Lighting& lighting;
    const frame::Post& post;
    WaterPass* water;  // null: the scene has none
};

// The AOV called `name` as a layer; `name` is one of aovs().
Result<Layer> readAov(const AovSources& sources, const std::string& name);

}  // namespace shoal::pipeline
