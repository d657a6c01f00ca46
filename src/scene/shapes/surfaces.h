// Small tiling textures made by noise: colour, normal map, roughness.
#pragma once

#include <cstdint>
#include <string_view>

#include <shoal/core/image.h>
#include <shoal/core/math.h>

namespace shoal::scene::shapes {

struct Surface {
    ByteImage color;      // sRGB
    ByteImage normal;     // tangent space, +y up the picture (glTF)
    ByteImage roughness;  // glTF's metallic-roughness: G roughness, B metallic (0)
    float metres = 1;     // what one repetition covers
};

Surface makeWood(std::uint32_t seed);   // grain along u
Surface makeStone(std::uint32_t seed);  // hewn, pitted, light; the tint comes from vertex colours
Surface makeRock(std::uint32_t seed);   // grown: cracks and lichen
Surface makeConcrete(std::uint32_t seed);
Surface makeSand(std::uint32_t seed);       // with ripples
Surface makeGrit(std::uint32_t seed);       // pebbly ground: grass, soil and rock from afar
Surface makePlaster(std::uint32_t seed);    // rendered walls, light; the tint comes from vertex colours
Surface makeRoofTiles(std::uint32_t seed);  // rows of fired clay, u along the eaves, v down the slope
Surface makeRipples(std::uint32_t seed);    // small waves of calm water
Surface makePolyps(std::uint32_t seed);     // coral: rows of small cups; the tint comes from vertex colours
Surface makeMeanders(std::uint32_t seed);   // brain coral: winding ridges and valleys
Surface makeSilt(std::uint32_t seed);       // sand under water: ripples, grains, bits of shell
// Scales and the pattern of a species ("sardine", ...) round a fish: u from snout to tail, v once round from the back.
Surface makeFishSkin(std::string_view species, std::uint32_t seed);
// Glazed tiles with joints, `count` a side; tileSize in metres.
Surface makeTiles(std::uint32_t seed, float tileSize, int count);

}  // namespace shoal::scene::shapes
