// The caustics formulas that web pages copy, re-implemented from their descriptions as plain passes at their own sizes:
// evanw/webgl-water (2011) and martinRenou/threejs-caustics (2020). Both bend a mesh of the water surface onto the
// floor and take for the light's concentration the ratio of a triangle's size before and after, with lengths of screen
// derivatives multiplied in place of an area. Departures, all in their favour: constant gains (0.2 and 0.15) are taken
// out, sums are 32-bit, the waves are ours and exact, the floor is level and met exactly (threejs-caustics marches a
// depth texture).
#pragma once

#include <vector>

#include <shoal/gl/device.h>
#include <shoal/gl/objects.h>
#include <shoal/gl/program.h>
#include <shoal/water/gpu_waves.h>

namespace shoal::bench {

struct WebFormula {
    const char* name;
    int meshSide;   // cells of the water's mesh
    int mapSide;    // texels of the caustic map
    bool additive;  // false: the triangle drawn last wins
};
inline constexpr WebFormula kWebglWater{"webgl-water", 200, 1024, false};
inline constexpr WebFormula kThreejsCaustics{"threejs-caustics", 512, 1536, true};

// A square of water over a level floor, light from the zenith.
struct WebPatch {
    float periodM = 4;  // side; waves repeat
    float depth = 2;    // metres from the mean level to the floor
    float index = 1.333f;
    float marginM = 0;  // mesh beyond the square, for light that comes in from there; time is quoted without
};

class WebCaustics {
public:
    static Result<WebCaustics> create(gl::Device& device, const WebFormula& formula, const WebPatch& patch);
    // One map; a frame's work.
    void render(const water::GpuWaves& waves) const;
    // Irradiance over the light's (1 is level water without its surface losses), averaged into `side` x `side` bins
    // that divide the map's side, row 0 at z = 0.
    std::vector<double> bins(int side) const;

private:
    WebFormula formula_;
    WebPatch patch_;
    const gl::Program* program_ = nullptr;
    gl::Buffer points_, indices_;
    gl::VertexArray mesh_;
    gl::Texture map_;
    gl::Framebuffer target_;
    int indexCount_ = 0;
};

}  // namespace shoal::bench
