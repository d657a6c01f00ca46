#include "view/picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace shoal::viewer {

namespace {

// Few steps, so that targets are seldom made anew.
constexpr std::array kScales = {1.0f, 0.75f, 0.6f, 0.5f, 0.4f, 0.333f, 0.25f, 0.2f};

bool sameCamera(const std::optional<light::Camera>& a, const std::optional<light::Camera>& b) {
    if (a.has_value() != b.has_value()) return false;
    if (!a) return true;
    return a->worldFromView == b->worldFromView && a->verticalFov == b->verticalFov && a->heightM == b->heightM &&
           a->nearZ == b->nearZ && a->projection == b->projection &&
           a->intrinsics.has_value() == b->intrinsics.has_value();
}

bool sameWanted(const Picture::Wanted& a, const Picture::Wanted& b) {
    return a.width == b.width && a.height == b.height && a.time == b.time && sameCamera(a.camera, b.camera) &&
           a.moving == b.moving && (!a.moving || a.scale == b.scale) && a.aovs == b.aovs;
}

}  // namespace

float ScaleController::scale() const { return kScales[std::size_t(step_)]; }

void ScaleController::addFrame(double ms) {
    average_ = sinceChange_ == 0 ? ms : 0.6 * average_ + 0.4 * ms;
    ++sinceChange_;
    const int last = int(kScales.size()) - 1;
    if (average_ > targetMs_ && step_ < last) {
        // As if all the time went into pixels: at most two steps at once, for it does not.
        const double wanted = kScales[std::size_t(step_)] * std::sqrt(targetMs_ / average_);
        int step = step_ + 1;
        while (step < last && step < step_ + 2 && double(kScales[std::size_t(step)]) > wanted) ++step;
        step_ = step;
        sinceChange_ = 0;
    } else if (step_ > 0 && sinceChange_ > 8) {
        const double ratio = double(kScales[std::size_t(step_ - 1)] / kScales[std::size_t(step_)]);
        if (average_ * ratio * ratio < 0.85 * targetMs_) {
            --step_;
            sinceChange_ = 0;
        }
    }
}

Result<Picture> Picture::create(gl::Device& device) {
    Picture picture;
    SHOAL_TRY_ASSIGN(picture.pipeline_, pipeline::Pipeline::create(device));
    picture.pipeline_->setDraftsWanted(true);
    return picture;
}

void Picture::load(const scene::Scene& scene) {
    if (loading_.valid()) {
        next_ = scene;
        return;
    }
    loading_ = std::async(std::launch::async, [scene] { return Read{scene, scene::loadContent(scene, stderrSink())}; });
}

Result<void> Picture::update(const scene::Scene& scene) {
    if (next_) {
        next_ = scene;
        return {};
    }
    if (!hasScene_ || loading_.valid()) {
        load(scene);
        return {};
    }
    SHOAL_TRY(pipeline_->updateScene(scene));
    begin();
    return {};
}

Result<bool> Picture::takeLoaded() {
    if (!loading_.valid() || loading_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    Read read = loading_.get();
    if (next_) {
        const scene::Scene scene = *std::move(next_);
        next_.reset();
        load(scene);
        return false;
    }
    if (!read.content) return std::move(read.content).error();
    SHOAL_TRY(pipeline_->setScene(read.scene, *std::move(read.content)));
    hasScene_ = true;
    begin();
    return true;
}

void Picture::waitForLoading() {
    if (loading_.valid()) loading_.wait();
}

Result<void> Picture::draw(const Wanted& wanted) {
    if (!hasScene_ || wanted.width < 1 || wanted.height < 1) return {};
    if (!sameWanted(wanted, last_)) begin();
    last_ = wanted;
    if (complete_) return {};
    pipeline::FrameRequest request = pipeline::requestFor(scene().render);
    request.time = wanted.time;
    request.camera = wanted.camera;
    const float scale = wanted.moving ? wanted.scale : 1;
    request.width = std::clamp(int(std::lround(float(wanted.width) * scale)), 1, 16384);
    request.height = std::clamp(int(std::lround(float(wanted.height) * scale)), 1, 16384);
    const bool progressive = request.antialiasing == "supersample" && request.samples > 1;
    if (wanted.moving) {
        request.antialiasing = "none";
        request.draft = true;
        samplesWanted_ = 1;
    } else if (progressive) {
        samplesWanted_ = request.samples;
        request.sampleBegin = sampleCount_;
        request.sampleEnd = sampleCount_ + 1;
    } else {
        samplesWanted_ = 1;
    }
    const bool last = sampleCount_ + 1 >= samplesWanted_;
    pipeline_->setAovs(last ? std::span<const std::string>(wanted.aovs) : std::span<const std::string>());
    const Result<void> drawn = pipeline_->render(request);
    if (!drawn) {
        complete_ = true;  // the same error every frame helps nobody
        return drawn;
    }
    ++sampleCount_;
    complete_ = last;
    shownScale_ = scale;
    hasPicture_ = true;
    ++revision_;
    return {};
}

Result<void> Picture::finish(const Wanted& wanted) {
    Wanted still = wanted;
    still.moving = false;
    do {
        SHOAL_TRY(draw(still));
    } while (!complete_);
    return {};
}

}  // namespace shoal::viewer
