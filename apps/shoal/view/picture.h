// One scene on screen: loads it beside the loop, draws it coarse while it changes and in full when it rests.
#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>

#include <shoal/pipeline/pipeline.h>

namespace shoal::viewer {

// Finds the size at which a frame takes no longer than it may.
class ScaleController {
public:
    explicit ScaleController(double targetMs = 1000.0 / 32) : targetMs_(targetMs) {}
    float scale() const;
    void addFrame(double ms);  // of a frame drawn at scale()

private:
    double targetMs_;
    int step_ = 0;
    double average_ = 0;
    int sinceChange_ = 0;
};

class Picture {
public:
    static Result<Picture> create(gl::Device& device);

    // Reads a scene's files on another thread and shows it when they are there; what is shown now stays until then, and
    // for good where that fails.
    void load(const scene::Scene& scene);
    // Takes over what needs no reading, at once.
    Result<void> update(const scene::Scene& scene);
    bool loading() const { return loading_.valid(); }
    // Takes a scene that has been read; nothing while there is none. true: a new scene is shown.
    Result<bool> takeLoaded();
    void waitForLoading();
    bool hasScene() const { return hasScene_; }
    const scene::Scene& scene() const { return pipeline_->scene(); }
    const scene::Content& content() const { return pipeline_->content(); }

    // What is to be seen; any difference to what was asked before begins a new picture.
    struct Wanted {
        int width = 0, height = 0;  // of the viewport, pixels
        float time = 0;
        std::optional<light::Camera> camera;
        bool moving = false;  // drawn coarse, to be replaced soon
        float scale = 1;      // of a coarse picture
        std::vector<std::string> aovs;
    };
    // Draws the next part of it: a coarse picture, or one more sample of the full one. Does nothing when it is
    // complete.
    Result<void> draw(const Wanted& wanted);
    // Draws all that is missing.
    Result<void> finish(const Wanted& wanted);
    void begin() { sampleCount_ = 0, complete_ = false; }

    bool complete() const { return complete_; }
    int samplesDrawn() const { return sampleCount_; }
    int samplesWanted() const { return samplesWanted_; }
    float shownScale() const { return shownScale_; }
    bool hasPicture() const { return hasPicture_; }
    int revision() const { return revision_; }  // counts what was drawn
    pipeline::Pipeline& pipeline() { return *pipeline_; }

private:
    struct Read {
        scene::Scene scene;
        Result<scene::Content> content;
    };
    std::unique_ptr<pipeline::Pipeline> pipeline_;
    std::future<Read> loading_;
    std::optional<scene::Scene> next_;  // asked for while another is being read
    bool hasScene_ = false, hasPicture_ = false, complete_ = false;
    int sampleCount_ = 0, samplesWanted_ = 0, revision_ = 0;
    float shownScale_ = 1;
    Wanted last_;
};

}  // namespace shoal::viewer
