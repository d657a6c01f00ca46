// The eye of a View in double precision: rays through its picture, and back.
#pragma once

#include <optional>

#include <shoal/light/view.h>

#include "water/reference/vector.h"

namespace shoal::water {

class EyeRays {
public:
    explicit EyeRays(const light::View& view);

    // Picture coordinates in pixels: x to the right, y down from the top edge.
    struct Ray {
        DVec3 origin;            // on the near plane
        DVec3 direction;         // unit
        double axial = 1;        // metres of view depth a metre along it
        double originDepth = 0;  // view depth of the origin
    };
    Ray through(double x, double y) const;

    // Area that a pixel covers on a surface of normal `normal` at `distance` metres along a ray.
    double pixelArea(const Ray& ray, double distance, DVec3 normal) const;

    struct Place {
        double x = 0, y = 0;  // pixels
        DVec3 toEye;          // unit
        double distance = 0;  // metres from the point to the near plane, along it
    };
    // Where a point is in the picture; nothing outside it or before the near plane.
    std::optional<Place> project(DVec3 point) const;

private:
    DVec3 right_, up_, back_, eye_;               // of the view, in the world
    double scaleX_, scaleY_, offsetX_, offsetY_;  // picture = (offset + scale * view x / depth), in ndc
    double nearZ_;
    int width_, height_;
    bool orthographic_;
};

}  // namespace shoal::water
