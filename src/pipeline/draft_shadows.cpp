#include "pipeline/draft_shadows.h"

#include <algorithm>
#include <cmath>

namespace shoal::pipeline {

namespace {

// An eye far enough away that all other eyes are nearer to what they see: the one cascade, which is chosen by the
// distance along the view, then holds for them too.
constexpr float kFarAway = 40;  // radii of the area

light::View viewOfAll(const Bounds& area) {
    const float radius = std::max(area.radius(), 1e-3f);
    const Vec3 eye = area.center() + normalize(Vec3{0.3f, 0.5f, 1}) * (kFarAway * radius);
    return light::makeView(light::cameraLookingAt(eye, area.center(), 2.2f * std::asin(1 / kFarAway)), 64, 64);
}

}  // namespace

Result<DraftShadows> DraftShadows::create(gl::Device& device, frame::ShadowSetup setup, const Bounds& area) {
    DraftShadows made;
    setup.cascadeCount = 1;
    SHOAL_TRY_ASSIGN(made.shadows_, frame::Shadows::create(device, setup));
    made.area_ = area;
    return made;
}

void DraftShadows::draw(const frame::Context& context, const frame::ShadowParams& params, const frame::Lights& lights,
                        frame::Geometry& geometry, bool again) {
    frame::Context ofAll = context;
    ofAll.view = ofAll.previousView = viewOfAll(area_);
    frame::ShadowParams whole = params;
    whole.sunDistance = std::min(2 * kFarAway * std::max(area_.radius(), 1e-3f), 10000.0f);
    shadows_->prepare(ofAll, whole, lights.sun, lights.punctual, area_);
    const bool stale = again && time_ != context.time;
    time_ = context.time;
    for (frame::NeededView& needed : shadows_->neededViews())
        if (!needed.unchanged || stale || geometry.changed(needed.view)) geometry.drawDepth(context, needed);
}

}  // namespace shoal::pipeline
