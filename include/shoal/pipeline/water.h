// A scene's [water] tables, read and checked: what the pipeline and `shoal reference` make water of.
#pragma once

#include <optional>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/core/result.h>
#include <shoal/scene/content.h>
#include <shoal/scene/scene.h>
#include <shoal/water/body.h>
#include <shoal/water/light_views.h>
#include <shoal/water/paper.h>
#include <shoal/water/photons.h>
#include <shoal/water/shafts.h>
#include <shoal/water/surface.h>

namespace shoal::pipeline {

struct WaterSpec {
    water::BodyParams body;                              // [water]
    water::OpticsParams optics;                          // [water]
    water::WaveParams waves;                             // [water.waves], or waves = { ... }
    std::vector<water::WaveComponentParams> components;  // its components = [ { ... }, ... ]
    std::vector<Image> heightmaps;                       // of kind heightmap, metres; read
    water::PhotonParams photons;                         // [water.caustics]
    water::LightViewParams lightViews;                   // [water.caustics]
    water::ShaftParams shafts;                           // [water.shafts]
    water::SurfaceParams surface;                        // [water.surface]
    water::PaperParams paper;                            // [water.paper]
};

// Nothing where the scene has no [water] table. Errors name file, line and key.
Result<std::optional<WaterSpec>> readWater(const scene::Scene& scene);

// W/m2 that the content's environment puts on a level plane.
Vec3 skyIrradiance(const scene::Content& content, float intensity);

}  // namespace shoal::pipeline
