// One shadow map of all that is worth looking at, whatever the eye sees: a draft of a scene at rest draws none at all.
#pragma once

#include <optional>

#include <shoal/frame/geometry.h>
#include <shoal/frame/lighting.h>
#include <shoal/frame/shadows.h>

namespace shoal::pipeline {

class DraftShadows {
public:
    // `area`: world; beyond it drafts have no shadows of the sun.
    static Result<DraftShadows> create(gl::Device& device, frame::ShadowSetup setup, const Bounds& area);
    // Draws the maps where something moved. `again`: the frame before was none of drafts.
    void draw(const frame::Context& context, const frame::ShadowParams& params, const frame::Lights& lights,
              frame::Geometry& geometry, bool again);
    frame::Shadows& shadows() { return *shadows_; }

private:
    std::optional<frame::Shadows> shadows_;
    Bounds area_;
    float time_ = 0;
};

}  // namespace shoal::pipeline
