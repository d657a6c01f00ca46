#include <shoal/scene/shapes.h>

#include <map>

#include <shoal/scene/shape_kinds.h>

namespace shoal::scene {
namespace {

struct Kind {
    Result<Model> (*make)(std::span<const ShapeSetting>);
    std::vector<FieldRow> (*describe)();
};

template <class Shape, Result<Model> (*makeOne)(const Shape&)>
Kind kindOf() {
    return {[](std::span<const ShapeSetting> settings) -> Result<Model> {
                Shape shape;
                for (const ShapeSetting& setting : settings) SHOAL_TRY(setField(shape, setting.key, setting.value));
                return makeOne(shape);
            },
            [] { return describe(Shape{}); }};
}

const std::map<std::string, Kind, std::less<>>& kinds() {
    static const std::map<std::string, Kind, std::less<>> all{
        {"plane", kindOf<PlaneShape, makePlane>()},
        {"box", kindOf<BoxShape, makeBox>()},
        {"sphere", kindOf<SphereShape, makeSphere>()},
        {"cylinder", kindOf<CylinderShape, makeCylinder>()},
        {"terrain", kindOf<TerrainShape, makeTerrain>()},
        {"rocks", kindOf<RocksShape, makeRocks>()},
        {"tank", kindOf<TankShape, makeTank>()},
        {"pier", kindOf<PierShape, makePier>()},
        {"quay", kindOf<QuayShape, makeQuay>()},
        {"hall", kindOf<HallShape, makeHall>()},
        {"plaza", kindOf<PlazaShape, makePlaza>()},
        {"houses", kindOf<HousesShape, makeHouses>()},
        {"colonnade", kindOf<ColonnadeShape, makeColonnade>()},
        {"boat", kindOf<BoatShape, makeBoat>()},
        {"fish", kindOf<FishShape, makeFish>()},
        {"reef", kindOf<ReefShape, makeReef>()},
        {"ruin", kindOf<RuinShape, makeRuin>()},
        {"seabed", kindOf<SeabedShape, makeSeabed>()},
    };
    return all;
}

}  // namespace

const std::vector<std::string>& shapeNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> all;
        for (const auto& [name, kind] : kinds()) all.push_back(name);
        return all;
    }();
    return names;
}

Result<Model> makeShape(std::string_view kind, std::span<const ShapeSetting> settings) {
    const auto found = kinds().find(kind);
    if (found == kinds().end()) return badInput(unknownWord("shape", kind, shapeNames()));
    return found->second.make(settings);
}

std::vector<FieldRow> describeShape(std::string_view kind) {
    const auto found = kinds().find(kind);
    return found == kinds().end() ? std::vector<FieldRow>{} : found->second.describe();
}

}  // namespace shoal::scene
