// The procedural shapes as structs: what each kind takes, with a function that makes it. makeShape (shapes.h) is the
// same by name. All stand on y = 0 with their middle at the origin unless a sentence says otherwise; metres; colours
// linear. Models keep the promises of core/model.h: unit normals, tangents where a material has a normal map,
// counter-clockwise triangles. Same parameters, same bits, on any number of threads. Errors name the first field out of
// range.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>

#include <shoal/core/math.h>
#include <shoal/core/model.h>
#include <shoal/core/params.h>
#include <shoal/core/result.h>

namespace shoal::scene {

// What the simple shapes are made of.
struct ShapeSurface {
    std::string surface = "plain";  // textures: tiling, in metres, whatever the shape's size
    Vec3 color{0.8f, 0.8f, 0.8f};
    float roughness = 0.5f, metallic = 0;  // of "plain"; the others bring their own
    float transmission = 0, ior = 1.5f;
    Vec3 emission{0, 0, 0};
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, ShapeSurface>
void visit(P& p, V&& v) {
    v(p.surface, Field{"surface",
                       "",
                       -1e30,
                       1e30,
                       "what it is made of",
                       {"plain", "wood", "stone", "concrete", "sand", "grit", "tiles", "roof", "ripples"}});
    v(p.color, Field{"color", "", 0, 1, "linear base colour; tints a textured surface"});
    v(p.roughness, Field{"roughness", "", 0, 1, "of a plain surface: 0 mirror, 1 matt"});
    v(p.metallic, Field{"metallic", "", 0, 1, "of a plain surface: 1 is metal"});
    v(p.transmission, Field{"transmission", "", 0, 1, "part of the light that goes through, as in glass"});
    v(p.ior, Field{"ior", "", 1, 3, "refractive index"});
    v(p.emission, Field{"emission", "W/(m2 sr)", 0, 1e6, "radiance it sends out"});
}

struct PlaneShape {
    float width = 20, depth = 20;
    ShapeSurface look;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, PlaneShape>
void visit(P& p, V&& v) {
    v(p.width, Field{"width", "m", 0.001, 1e5, "along x"});
    v(p.depth, Field{"depth", "m", 0.001, 1e5, "along z"});
    visit(p.look, v);
}
Result<Model> makePlane(const PlaneShape& shape);

struct BoxShape {
    Vec3 size{1, 1, 1};
    float bevel = 0.02f;
    ShapeSurface look;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, BoxShape>
void visit(P& p, V&& v) {
    v(p.size, Field{"size", "m", 0.001, 1e5, "width, height and depth"});
    v(p.bevel, Field{"bevel", "m", 0, 1e4, "how far edges are rounded"});
    visit(p.look, v);
}
Result<Model> makeBox(const BoxShape& shape);

struct SphereShape {
    float radius = 0.5f;
    int segments = 64;
    ShapeSurface look;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, SphereShape>
void visit(P& p, V&& v) {
    v(p.radius, Field{"radius", "m", 0.001, 1e5, "of the sphere, which lies on y = 0"});
    v(p.segments, Field{"segments", "", 8, 512, "facets around"});
    visit(p.look, v);
}
Result<Model> makeSphere(const SphereShape& shape);

struct CylinderShape {
    float radius = 0.5f, height = 1, bevel = 0.02f;
    int segments = 64;
    ShapeSurface look;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, CylinderShape>
void visit(P& p, V&& v) {
    v(p.radius, Field{"radius", "m", 0.001, 1e5, "of the cylinder"});
    v(p.height, Field{"height", "m", 0.001, 1e5, "along y"});
    v(p.bevel, Field{"bevel", "m", 0, 1e4, "how far the rims are rounded"});
    v(p.segments, Field{"segments", "", 3, 512, "facets around"});
    visit(p.look, v);
}
Result<Model> makeCylinder(const CylinderShape& shape);

// Land: hills, or an island with a beach whose waterline is y = 0 and a sea floor around it.
struct TerrainShape {
    float size = 120, height = 14, roughness = 0.5f;
    bool island = true;
    float seaDepth = 6, grassLine = 1.6f;
    int cells = 256, rocks = 60, bushes = 160, trees = 0;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, TerrainShape>
void visit(P& p, V&& v) {
    v(p.size, Field{"size", "m", 1, 1e5, "along x and z"});
    v(p.height, Field{"height", "m", 0, 1e4, "of the highest ground above y = 0"});
    v(p.roughness, Field{"roughness", "", 0, 1, "0 rolling, 1 rugged"});
    v(p.island, Field{"island", "", 0, 1, "falls off into a sea whose surface would be y = 0"});
    v(p.seaDepth, Field{"seaDepth", "m", 0, 1e4, "of the sea floor round an island"});
    v(p.grassLine,
      Field{"grassLine", "m", -1e4, 1e4, "height where sand gives way to grass; hills without island: no sand"});
    v(p.cells, Field{"cells", "", 8, 1024, "grid cells along a side"});
    v(p.rocks, Field{"rocks", "", 0, 2000, "boulders scattered on it"});
    v(p.bushes, Field{"bushes", "", 0, 5000, "shrubs on the grass"});
    v(p.trees, Field{"trees", "", 0, 5000, "trees in groves on the grass"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "another land"});
}
Result<Model> makeTerrain(const TerrainShape& shape);

struct RocksShape {
    int count = 24;
    Vec2 area{12, 12};
    float smallest = 0.2f, largest = 1.2f;
    Vec3 color{0.42f, 0.40f, 0.37f};
    float moss = 0.4f;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, RocksShape>
void visit(P& p, V&& v) {
    v(p.count, Field{"count", "", 1, 5000, "how many"});
    v(p.area, Field{"area", "m", 0, 1e5, "they lie within, along x and z"});
    v(p.smallest, Field{"smallest", "m", 0.001, 1e4, "radius of the smallest"});
    v(p.largest, Field{"largest", "m", 0.001, 1e4, "radius of the largest"});
    v(p.color, Field{"color", "", 0, 1, "linear base colour"});
    v(p.moss, Field{"moss", "", 0, 1, "green on their upper sides"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other rocks"});
}
Result<Model> makeRocks(const RocksShape& shape);

// An open tank for water: the inside is width x depth, its floor y = 0.
struct TankShape {
    float width = 4, depth = 3, height = 2, thickness = 0.12f, tileSize = 0.15f;
    std::string walls = "tiles";
    Vec3 color{0.32f, 0.55f, 0.62f};
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, TankShape>
void visit(P& p, V&& v) {
    v(p.width, Field{"width", "m", 0.1, 1000, "inside, along x"});
    v(p.depth, Field{"depth", "m", 0.1, 1000, "inside, along z"});
    v(p.height, Field{"height", "m", 0.05, 1000, "of the walls above the floor"});
    v(p.thickness, Field{"thickness", "m", 0.005, 10, "of the walls"});
    v(p.tileSize, Field{"tileSize", "m", 0.01, 10, "of one tile"});
    v(p.walls, Field{"walls", "", -1e30, 1e30, "what the walls are", {"tiles", "glass"}});
    v(p.color, Field{"color", "", 0, 1, "linear colour of the tiles"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other shades of tiles"});
}
Result<Model> makeTank(const TankShape& shape);

// A wooden pier on piles, from z = 0 out to z = -length. Its deck is deckHeight above y = 0, where the water would be.
struct PierShape {
    float length = 18, width = 2.6f, deckHeight = 1.2f, waterDepth = 4;
    bool railing = true;
    int props = 6;
    Vec3 color{1, 1, 0.97f};
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, PierShape>
void visit(P& p, V&& v) {
    v(p.length, Field{"length", "m", 1, 1000, "from z = 0 towards -z"});
    v(p.width, Field{"width", "m", 0.5, 100, "along x"});
    v(p.deckHeight, Field{"deckHeight", "m", 0.2, 100, "of the deck's upper side above y = 0"});
    v(p.waterDepth, Field{"waterDepth", "m", 0, 1000, "how far the piles reach below y = 0"});
    v(p.railing, Field{"railing", "", 0, 1, "posts and rails along one side"});
    v(p.props, Field{"props", "", 0, 200, "crates and barrels on the deck"});
    v(p.color, Field{"color", "", 0, 1, "tint of the wood"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other planks"});
}
Result<Model> makePier(const PierShape& shape);

// A stone quay along x: the wall faces +z at z = 0, land reaches to z = -width, water would be y = 0.
struct QuayShape {
    float length = 24, width = 8, height = 1.4f, waterDepth = 4, blockHeight = 0.45f;
    int bollards = 4, props = 8;
    bool stairs = true;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, QuayShape>
void visit(P& p, V&& v) {
    v(p.length, Field{"length", "m", 2, 1000, "along x"});
    v(p.width, Field{"width", "m", 1, 500, "of the paved land, towards -z"});
    v(p.height, Field{"height", "m", 0.2, 100, "of the pavement above y = 0"});
    v(p.waterDepth, Field{"waterDepth", "m", 0, 200, "how far the wall goes down"});
    v(p.blockHeight, Field{"blockHeight", "m", 0.1, 10, "of a course of stones"});
    v(p.bollards, Field{"bollards", "", 0, 200, "along the edge"});
    v(p.props, Field{"props", "", 0, 200, "crates and barrels"});
    v(p.stairs, Field{"stairs", "", 0, 1, "steps down to the water"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other stones"});
}
Result<Model> makeQuay(const QuayShape& shape);

// A storage hall: steel frames along z, concrete floor, rows of shelves, windows and roof lights that let the sun in.
struct HallShape {
    float length = 36, width = 18, height = 7;
    int bays = 6, shelfRows = 4;
    float fill = 0.75f;
    bool shelves = true, roof = true, frontWall = true;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, HallShape>
void visit(P& p, V&& v) {
    v(p.length, Field{"length", "m", 4, 500, "along z"});
    v(p.width, Field{"width", "m", 4, 200, "along x"});
    v(p.height, Field{"height", "m", 3, 50, "of the walls"});
    v(p.bays, Field{"bays", "", 1, 100, "between the frames"});
    v(p.shelfRows, Field{"shelfRows", "", 0, 40, "rows of shelves across the width"});
    v(p.fill, Field{"fill", "", 0, 1, "part of the shelf places with goods"});
    v(p.shelves, Field{"shelves", "", 0, 1, "shelves and goods at all"});
    v(p.roof, Field{"roof", "", 0, 1, "roof with lights; without it the hall is open above"});
    v(p.frontWall, Field{"frontWall", "", 0, 1, "the gable at +z, with its gate"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other goods"});
}
Result<Model> makeHall(const HallShape& shape);

// A boat along z, bow towards -z, afloat in water of level y = 0.
struct BoatShape {
    float length = 4.4f, beam = 1.7f, freeboard = 0.5f, draught = 0.25f;
    bool mast = false;
    Vec3 color{0.06f, 0.22f, 0.30f};
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, BoatShape>
void visit(P& p, V&& v) {
    v(p.length, Field{"length", "m", 1, 30, "from transom to stem"});
    v(p.beam, Field{"beam", "m", 0.5, 10, "at its widest"});
    v(p.freeboard, Field{"freeboard", "m", 0.2, 5, "of the rim above y = 0 amidships"});
    v(p.draught, Field{"draught", "m", 0.05, 5, "of the keel below y = 0"});
    v(p.mast, Field{"mast", "", 0, 1, "a mast with the sail stowed on its boom"});
    v(p.color, Field{"color", "", 0, 1, "linear colour of the hull"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other planks"});
}
Result<Model> makeBoat(const BoatShape& shape);

// A covered walk: columns along x at z = 0 that carry a beam; roof and wall reach to z = -depth.
struct ColonnadeShape {
    float length = 15, depth = 3, height = 3.2f, spacing = 2.5f;
    bool wall = true, roof = true;
    Vec3 color{0.74f, 0.42f, 0.27f};
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, ColonnadeShape>
void visit(P& p, V&& v) {
    v(p.length, Field{"length", "m", 1, 500, "along x"});
    v(p.depth, Field{"depth", "m", 0.5, 50, "of the walk, towards -z"});
    v(p.height, Field{"height", "m", 1, 30, "of the columns"});
    v(p.spacing, Field{"spacing", "m", 0.5, 20, "from column to column, about"});
    v(p.wall, Field{"wall", "", 0, 1, "a wall behind"});
    v(p.roof, Field{"roof", "", 0, 1, "a lean-to roof of tiles"});
    v(p.color, Field{"color", "", 0, 1, "linear colour of the wall"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other stones"});
}
Result<Model> makeColonnade(const ColonnadeShape& shape);

// A row of plastered town houses along x: the fronts face +z at z = 0, the houses reach to z = -depth.
struct HousesShape {
    float length = 40, depth = 9, houseWidth = 8;
    int floors = 3;
    bool shops = true, tower = false;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, HousesShape>
void visit(P& p, V&& v) {
    v(p.length, Field{"length", "m", 3, 1000, "of the row, along x"});
    v(p.depth, Field{"depth", "m", 3, 50, "of the houses, towards -z"});
    v(p.houseWidth, Field{"houseWidth", "m", 3, 50, "of a house, about"});
    v(p.floors, Field{"floors", "", 1, 8, "of the highest houses"});
    v(p.shops, Field{"shops", "", 0, 1, "shops with awnings on ground floors"});
    v(p.tower, Field{"tower", "", 0, 1, "a bell tower behind the row"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other houses"});
}
Result<Model> makeHouses(const HousesShape& shape);

// A paved square with low walls, benches, lamps and trees in planters, and something in its middle.
struct PlazaShape {
    float size = 30, slabSize = 0.6f;
    std::string pattern = "rings", center = "fountain";
    int benches = 8, lamps = 8, trees = 8;
    bool walls = true;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, PlazaShape>
void visit(P& p, V&& v) {
    v(p.size, Field{"size", "m", 8, 300, "along x and z"});
    v(p.slabSize, Field{"slabSize", "m", 0.2, 5, "of a paving slab"});
    v(p.pattern,
      Field{"pattern", "", -1e30, 1e30, "how the slabs are coloured", {"rings", "checker", "bands", "plain"}});
    v(p.center, Field{"center", "", -1e30, 1e30, "what stands in the middle", {"fountain", "statue", "none"}});
    v(p.benches, Field{"benches", "", 0, 100, "round the middle"});
    v(p.lamps, Field{"lamps", "", 0, 100, "near the edge"});
    v(p.trees, Field{"trees", "", 0, 100, "in planters"});
    v(p.walls, Field{"walls", "", 0, 1, "low walls round the square with openings"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "other slabs and trees"});
}
Result<Model> makePlaza(const PlazaShape& shape);

// A shoal of fish that swims counter-clockwise (seen from above) round the origin; y = 0 is its middle. A clip of one
// lap.
struct FishShape {
    std::string species = "sardine";
    int count = 60;
    float length = 0.22f, variation = 0.15f, radius = 3, speed = 0.7f, wander = 1;
    Vec3 spread{1.4f, 0.9f, 3.5f};
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, FishShape>
void visit(P& p, V&& v) {
    v(p.species,
      Field{"species", "", -1e30, 1e30, "what fish", {"sardine", "fusilier", "butterfly", "sergeant", "grouper"}});
    v(p.count, Field{"count", "", 1, 2000, "how many"});
    v(p.length, Field{"length", "m", 0.01, 20, "of a fish"});
    v(p.variation, Field{"variation", "", 0, 0.9, "how much their lengths differ"});
    v(p.radius, Field{"radius", "m", 0.1, 1000, "of their way round"});
    v(p.speed, Field{"speed", "m/s", 0.001, 100, "how fast they swim"});
    v(p.wander, Field{"wander", "", 0, 1, "how far their way differs from a level circle"});
    v(p.spread, Field{"spread", "m", 0, 1000, "of the shoal: across its way, up, along its way"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "another shoal"});
}
Result<Model> makeFish(const FishShape& shape);

// A coral reef on sand at y = 0: boulders overgrown with corals, sponges and fans.
struct ReefShape {
    Vec2 area{9, 6};
    float height = 1.8f;
    int rocks = 36, corals = 150;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, ReefShape>
void visit(P& p, V&& v) {
    v(p.area, Field{"area", "m", 0.5, 1000, "it covers, along x and z"});
    v(p.height, Field{"height", "m", 0, 100, "of the rocks in its middle, about"});
    v(p.rocks, Field{"rocks", "", 1, 2000, "boulders it is piled of"});
    v(p.corals, Field{"corals", "", 0, 5000, "corals, sponges and fans on them"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "another reef"});
}
Result<Model> makeReef(const ReefShape& shape);

// A wide floor of rippled sand about y = 0, with stones and tufts of seagrass near its middle.
struct SeabedShape {
    float size = 200, relief = 0.9f, slope = 0.05f, flat = 6, scatter = 16;
    int cells = 180, stones = 70, grass = 50;
    Vec3 color{1, 1, 1};
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, SeabedShape>
void visit(P& p, V&& v) {
    v(p.size, Field{"size", "m", 1, 1e5, "along x and z"});
    v(p.relief, Field{"relief", "m", 0, 100, "height of its banks"});
    v(p.slope, Field{"slope", "", 0, 2, "how steeply it falls towards -z"});
    v(p.flat, Field{"flat", "m", 0, 1e4, "radius about the origin without banks"});
    v(p.scatter, Field{"scatter", "m", 0, 1e4, "radius that stones and grass lie within"});
    v(p.cells, Field{"cells", "", 8, 1024, "grid cells along a side, small in the middle"});
    v(p.stones, Field{"stones", "", 0, 5000, "how many"});
    v(p.grass, Field{"grass", "", 0, 5000, "tufts of seagrass"});
    v(p.color, Field{"color", "", 0, 1, "tint of the sand"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "another floor"});
}
Result<Model> makeSeabed(const SeabedShape& shape);

// What is left of a temple on y = 0: steps, columns along x on both sides of which some broke and fell, walls, an arch.
struct RuinShape {
    float length = 13, width = 6.5f, columnHeight = 4, decay = 0.5f, overgrowth = 0.6f;
    int columns = 5;
    bool arch = true, wall = true;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, RuinShape>
void visit(P& p, V&& v) {
    v(p.length, Field{"length", "m", 3, 200, "along x"});
    v(p.width, Field{"width", "m", 2, 200, "along z"});
    v(p.columnHeight, Field{"columnHeight", "m", 0.5, 30, "of a whole column"});
    v(p.decay, Field{"decay", "", 0, 1, "how much of it fell"});
    v(p.overgrowth, Field{"overgrowth", "", 0, 1, "algae on its stones"});
    v(p.columns, Field{"columns", "", 2, 100, "along each side"});
    v(p.arch, Field{"arch", "", 0, 1, "a free-standing arch before its +x end"});
    v(p.wall, Field{"wall", "", 0, 1, "a wall with a window at its -x end"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "another ruin"});
}
Result<Model> makeRuin(const RuinShape& shape);

}  // namespace shoal::scene
