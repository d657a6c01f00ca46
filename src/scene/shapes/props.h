// Things that stand about in several shapes.
#pragma once

#include "scene/shapes/builder.h"
#include "scene/shapes/noise.h"

namespace shoal::scene::shapes {

// Materials by role; made on first use would reorder them, so every shape makes the ones it needs up front. -1: not
// made.
struct Palette {
    int wood = -1, stone = -1, concrete = -1, steel = -1, darkMetal = -1, paint = -1, leaf = -1, bark = -1, lamp = -1,
        glass = -1;
};

// A boulder of about `radius`, flattened below; moss greens its upper side.
Blob makeBoulder(std::uint32_t seed, int level, float moss);

void addCrate(ModelBuilder& builder, const Palette& palette, const Frame& base, Vec3 size, Dice& dice);
void addBarrel(ModelBuilder& builder, const Palette& palette, const Frame& base, float height, Dice& dice);
void addCardboardBox(ModelBuilder& builder, const Palette& palette, const Frame& base, Vec3 size, Dice& dice);
void addBollard(ModelBuilder& builder, const Palette& palette, const Frame& base);
void addBench(ModelBuilder& builder, const Palette& palette, const Frame& base, Dice& dice);  // faces +z
void addLamp(ModelBuilder& builder, const Palette& palette, const Frame& base, float height);
void addTree(ModelBuilder& builder, const Palette& palette, const Frame& base, float height, Dice& dice);
// A clump of leaves about a point: `count` leaves of leafSize within the ellipsoid `half`.
void addFoliage(Part& leaves, Vec3 center, Vec3 half, int count, float leafSize, Dice& dice);

// A colour of wood, light to dark, a little to grey.
Vec3 woodTint(Dice& dice, float spread);

}  // namespace shoal::scene::shapes
