// The environment on the GPU: the sharp lat-long map and a map prefiltered by roughness.
#pragma once

#include <vector>

#include <shoal/core/result.h>
#include <shoal/gl/objects.h>
#include <shoal/light/environment.h>

#include "frame/light_block.h"

namespace shoal::frame {

// Radiance on the square of brdf.lib.glsl (squareFromDirection), a roughness (roughnessOfLevel) a level, each level
// half as wide as the one before. Texel (x, y) of a level of n texels a side stands at square ((x, y) / (n - 1)):
// border texels lie on the fold, so that bilinear look-ups have no seam. World directions: the map's rotation is in it.
struct PrefilteredLevel {
    int size = 0;
    std::vector<Vec3> radiance;  // size * size, row by row
};
std::vector<PrefilteredLevel> prefilterEnvironment(const light::Environment& environment);

struct EnvironmentMap {
    gl::Texture sharp;        // RGBA16F, lat-long, mip-mapped, repeats sideways
    gl::Texture prefiltered;  // RGBA16F
    EnvironmentShape shape;
};
Result<EnvironmentMap> uploadEnvironment(gl::Device& device, const light::Environment& environment);

}  // namespace shoal::frame
