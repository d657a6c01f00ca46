// Corals and sponges, one growth form a function. Each stands on y = 0 of its frame and is about `size` metres wide.
#pragma once

#include <vector>

#include "scene/shapes/builder.h"
#include "scene/shapes/noise.h"

namespace shoal::scene::shapes {

// Materials by role.
struct SeaPalette {
    int polyps = -1, meanders = -1, smooth = -1, rock = -1, blades = -1;  // smooth and blades have no texture
};

// A round pipe along points, thinning from radius to radius, with a rounded end; colours run from root to tip.
struct Tube {
    std::vector<Vec3> points;
    std::vector<float> radii;
    Vec3 root{1, 1, 1}, tip{1, 1, 1};
    int around = 7;
};
void addTube(Part& part, const Frame& frame, const Tube& tube);

void addBranchingCoral(Part& part, const Frame& base, float size, Vec3 color, Dice& dice);  // staghorn
void addTableCoral(Part& part, const Frame& base, float size, Vec3 color, Dice& dice);
void addBrainCoral(Part& part, const Frame& base, float size, Vec3 color, Dice& dice);
void addTubeSponge(Part& part, const Frame& base, float size, Vec3 color, Dice& dice);
void addBarrelSponge(Part& part, const Frame& base, float size, Vec3 color, Dice& dice);
void addSeaFan(Part& part, const Frame& base, float size, Vec3 color, Dice& dice);     // in the frame's xy plane
void addLeafCoral(Part& part, const Frame& base, float size, Vec3 color, Dice& dice);  // overlapping scrolls
void addSeagrass(Part& part, const Frame& base, float size, Dice& dice);

// A boulder overgrown with crusts of algae.
Blob makeReefRock(std::uint32_t seed, int level);

}  // namespace shoal::scene::shapes
