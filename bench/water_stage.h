// A check scene of tests/scenes on a device, for the rows of water: load it with overrides, read what it draws.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/gl/device.h>
#include <shoal/pipeline/pipeline.h>
#include <shoal/pipeline/water.h>

#include "bench/frame_row.h"
#include "bench/harness.h"

namespace shoal::bench {

using Overrides = std::vector<std::string>;  // "water.caustics.photons=160000"

// Folder of the check scenes: share/shoal/checks beside the binary's folder, or SHOAL_CHECKS.
Result<std::string> checksFolder();

class WaterStage {
public:
    static Result<WaterStage> create(const Settings& settings);
    // Loads tests/scenes/<scene>.toml; `change` may alter what its files hold.
    Result<void> load(const std::string& scene, const Overrides& overrides = {},
                      const std::function<void(scene::Content&)>& change = {});
    // Draws a frame as the scene's [render] says and reads one AOV, row 0 on top.
    Result<Image> draw(const std::string& aov);
    // The same seen by another camera.
    Result<Image> draw(const std::string& aov, const light::Camera& camera);
    pipeline::Pipeline& pipeline() { return *stage_.pipeline; }
    gl::Device& device() { return *stage_.device; }
    pipeline::FrameRequest request() const { return request_; }

private:
    Stage stage_;
    pipeline::FrameRequest request_;
};

// The wave field that a scene's [water] asks for, at the scene's time.
Result<water::WaveField> wavesOf(const scene::Scene& scene);

// "[1, 2, 3]" for an override.
std::string words(double x, double y, double z);

// Channel 0 of a picture against an exact one of its size; errors relative to the exact mean.
struct PictureError {
    double mean = 0, rmse = 0, mae = 0;
};
// `matched`: after the picture is scaled to the exact mean.
PictureError errorOf(const Image& picture, const Image& exact, bool matched = false);

// Exact irradiance of water_patch.toml (P6, 2 m down, a pixel a bin) by 151 M rays; the sun's half angle in radians.
Image exactPatch(const water::WaveField& waves, double discHalfAngle);

// Mean over all rows and the columns [first, end) of channel 0.
double columnMean(const Image& image, int first, int end);

}  // namespace shoal::bench
