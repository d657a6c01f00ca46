// A scene's [water] tables, read and checked: what the pipeline and `shoal reference` make water of.
#pragma once

#include <optional>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/core/result.h>
#include <shoal/scene/content.h>
#include <shoal/scene/scene.h>
#include <shoal/water/paper.h>
#include <shoal/water/reference.h>
#include <shoal/water/water.h>

namespace shoal::pipeline {

struct WaterSpec {
    // [water] (body, optics), waves = { ..., components = [ { ... }, ... ] }, heightmaps read, [water.caustics]
    // resolution.
    water::WaterSetup setup;
    water::WaterParams params;  // [water.caustics] (photons, lightViews), [water.shafts], [water.surface]
    water::PaperParams paper;   // [water.paper]
};

// Nothing where the scene has no [water] table. Errors name file, line and key.
Result<std::optional<WaterSpec>> readWater(const scene::Scene& scene);

// W/m2 that the content's environment puts on a level plane.
Vec3 skyIrradiance(const scene::Content& content, float intensity);

// Triangles of the visible opaque surfaces at `time` seconds, for water/reference.h. Masked materials are not cut out.
water::ReferenceScene referenceScene(const scene::Content& content, float time);

}  // namespace shoal::pipeline
