// Shoal's own method and the paper's on one scene in one process, in turns: the same eye, the same photons, passes
// timed by name.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "bench/harness.h"
#include "bench/water_stage.h"

namespace shoal::bench {

enum class Method { shoal, paper };

// Milliseconds of one frame.
struct MethodTimes {
    double lightDepth = 0;  // drawing the scene from the light: the same work for any method, quoted apart
    double mirrored = 0;    // what the surface mirrors and bends, drawn and lit: for the surface, quoted apart
    double caustics = 0;    // photons, intersection, deposits or points, filters
    double godrays = 0;     // photons, slices or lines, march, filters
    double toPixels = 0;    // both brought to the picture's size
    double work() const { return caustics + godrays + toPixels; }
    std::map<std::string, double> passes;
};
// Median of each part.
MethodTimes medianOf(const std::vector<MethodTimes>& times);
// "caustic photons 3.1, caustic maps 0.4": of the passes that belong to a method.
std::string passText(const MethodTimes& times);

// What sets a method and its photons.
Overrides shoalOverrides(int photons, int godrayPhotons);
Overrides paperOverrides(int photons, int godrayPhotons);  // numbers are rounded to 4 n^2

class MethodPair {
public:
    static Result<MethodPair> create(const Settings& settings);
    // Loads tests/scenes/<scene>.toml twice. Any two settings may stand beside each other, not the two methods alone.
    Result<void> load(const std::string& scene, const Overrides& shoal, const Overrides& paper);
    Result<void> loadOne(Method method, const std::string& scene, const Overrides& overrides);
    void setSize(int width, int height);  // of both; outlives a load
    void setSize(Method method, int width, int height);
    // Draws a frame and times its passes. The eye moves with the index, as in use: what follows the eye is drawn anew.
    Result<MethodTimes> timed(Method method, int index);
    // Wall clock of a whole frame with its picture read back, milliseconds.
    Result<double> wholeFrame(Method method, int index);
    // `repetitions` frames of each method in turns after a warm-up, medians.
    struct Both {
        MethodTimes shoal, paper;
    };
    Result<Both> inTurns(int repetitions);
    // An AOV of the scene's own view, row 0 on top.
    Result<Image> draw(Method method, const std::string& aov);
    gl::Device& device() { return *device_; }
    pipeline::Pipeline& pipeline(Method method) { return *pipelines_[index(method)]; }

private:
    static std::size_t index(Method method) { return method == Method::paper ? 1 : 0; }
    pipeline::FrameRequest request(Method method, int frame);
    std::unique_ptr<gl::Device> device_;
    std::unique_ptr<pipeline::Pipeline> pipelines_[2];
    pipeline::FrameRequest requests_[2];
    IVec2 sizes_[2];  // asked for; x 0: the scene's
};

}  // namespace shoal::bench
