// Rows that are the time of whole frames in motion, with each pass beside.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <shoal/gl/device.h>
#include <shoal/pipeline/pipeline.h>

#include "bench/harness.h"

namespace shoal::bench {

// A device of the settings and a pipeline on it.
struct Stage {
    std::unique_ptr<gl::Device> device;
    std::unique_ptr<pipeline::Pipeline> pipeline;
};
Result<Stage> makeStage(const std::string& device);

// Where the eye is in the i-th frame; none: where the scene's own camera is at the frame's time.
using EyeAt = std::function<std::optional<light::Camera>(const pipeline::Pipeline& pipeline, int i)>;

// Median time of a frame of `file`, drawn as a film draws it: 1280x720, 30 frames a second, one sample, temporal
// antialiasing. `what` names the work in the row's method.
Result<std::vector<Row>> frameRow(const Settings& settings, const char* id, const std::string& file, const char* what,
                                  const EyeAt& eyeAt);

}  // namespace shoal::bench
