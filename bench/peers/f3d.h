// Debian's f3d as a peer: the same model from the same camera on the same Mesa, with its ambient occlusion,
// antialiasing and tone mapping. f3d needs a display: an Xvfb is started before anything is measured and stays up, so
// its start is not counted.
#pragma once

#include <memory>
#include <string>

#include "bench/harness.h"

namespace shoal::bench {

class F3d {
public:
    // An error where f3d or Xvfb is not installed.
    static Result<std::unique_ptr<F3d>> start(const Settings& settings, const std::string& model, int width,
                                              int height);
    ~F3d();
    F3d(const F3d&) = delete;
    F3d& operator=(const F3d&) = delete;

    // One whole process to a PNG.
    Ran draw(const std::map<std::string, std::string>& environment) const;

    // Pixels that both cover over pixels that either covers: both drew the same thing from the same place. Ours is
    // drawn without ground.
    Result<double> coverageOverlap() const;

private:
    F3d() = default;
    int xvfb_ = 0;
    std::string display_, picture_, model_;
    std::vector<std::string> command_;
    Settings settings_;
    int width_ = 0, height_ = 0;
};

}  // namespace shoal::bench
