// Plane, box, sphere and cylinder.
#include <shoal/scene/shape_kinds.h>

#include "scene/shapes/builder.h"

namespace shoal::scene {
namespace {

using namespace shapes;

int addLook(ModelBuilder& builder, const ShapeSurface& look) {
    int index = 0;
    if (look.surface == "wood")
        index = builder.addMaterial("wood", look.color, makeWood(1));
    else if (look.surface == "stone")
        index = builder.addMaterial("stone", look.color, makeStone(1));
    else if (look.surface == "concrete")
        index = builder.addMaterial("concrete", look.color, makeConcrete(1));
    else if (look.surface == "sand")
        index = builder.addMaterial("sand", look.color, makeSand(1));
    else if (look.surface == "grit")
        index = builder.addMaterial("grit", look.color, makeGrit(1));
    else if (look.surface == "tiles")
        index = builder.addMaterial("tiles", look.color, makeTiles(1, 0.2f, 8));
    else if (look.surface == "roof")
        index = builder.addMaterial("roof", look.color, makeRoofTiles(1));
    else if (look.surface == "ripples")
        index = builder.addMaterial("ripples", look.color, makeRipples(1));
    else
        index = builder.addMaterial("plain", look.color, look.roughness, look.metallic);
    Material& material = builder.material(index);
    material.transmission = look.transmission;
    material.ior = look.ior;
    material.emission = look.emission;
    return index;
}

}  // namespace

Result<Model> makePlane(const PlaneShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("plane");
    addSheet(builder.part(addLook(builder, shape.look)), {}, shape.width / 2, shape.depth / 2);
    return builder.finish();
}

Result<Model> makeBox(const BoxShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("box");
    addStandingBox(builder.part(addLook(builder, shape.look)), {}, shape.size, shape.bevel);
    return builder.finish();
}

Result<Model> makeSphere(const SphereShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("sphere");
    addSphere(builder.part(addLook(builder, shape.look)), Frame{}.at({0, shape.radius, 0}), shape.radius,
              shape.segments);
    return builder.finish();
}

Result<Model> makeCylinder(const CylinderShape& shape) {
    SHOAL_TRY(validate(shape));
    ModelBuilder builder("cylinder");
    addCylinder(builder.part(addLook(builder, shape.look)), {}, shape.radius, shape.height, shape.bevel,
                shape.segments);
    return builder.finish();
}

}  // namespace shoal::scene
