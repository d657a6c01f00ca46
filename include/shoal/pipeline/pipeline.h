// The whole frame: reads a scene's content onto a device, orders the passes, composites. The only place that knows
// every technique.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <shoal/core/image.h>
#include <shoal/core/progress.h>
#include <shoal/core/result.h>
#include <shoal/frame/context.h>
#include <shoal/gl/device.h>
#include <shoal/light/view.h>
#include <shoal/scene/content.h>
#include <shoal/scene/scene.h>

namespace shoal::pipeline {

// What one picture is asked for.
struct FrameRequest {
    int width = 1280, height = 720;            // pixels, 1..16384
    float time = 0;                            // seconds of scene time
    float timeStep = 1.0f / 30;                // to the frame before (motion)
    std::uint32_t frameIndex = 0;              // 0 begins a sequence: history and automatic exposure start anew
    std::string antialiasing = "supersample";  // "none", "supersample", "temporal"
    int samples = 4;                           // of supersample, 1..1024
    // Supersample in several calls: this one draws samples [sampleBegin, sampleEnd); sampleEnd 0: to the last. A call
    // with sampleBegin > 0 goes on where the call before ended and must differ from it in nothing else; after the last
    // one the picture has the bits of a single call.
    int sampleBegin = 0, sampleEnd = 0;
    bool draft = false;      // quicker: leaves out detail of a pixel or two (setDraftsWanted comes first)
    std::uint32_t seed = 1;  // shifts where samples fall in the pixel and the noise of ambient occlusion
    std::optional<light::Camera> camera = {};  // instead of the scene's
};

// What a scene's [render] asks for.
FrameRequest requestFor(const scene::RenderSpec& spec);

// Every AOV there is, in the order of the help: name, channels, unit and sentence.
struct AovInfo {
    const char* name;
    const char* channels;  // "RGB", "XYZ", "Z", ...
    const char* unit;
    const char* sentence;
};
std::span<const AovInfo> aovs();
// "depth,normal" to names; "all" for every one; an unknown name is a usage error with the nearest known.
Result<std::vector<std::string>> parseAovList(std::string_view words);

class Pipeline {
public:
    static Result<std::unique_ptr<Pipeline>> create(gl::Device& device);
    ~Pipeline();

    // Takes over a scene: uploads models, prefilters the environment, binds [shadows], [lighting], [post]. Replaces the
    // scene before; that one stays when this fails.
    Result<void> setScene(const scene::Scene& scene, scene::Content content);
    // Takes over what differs in lights, camera, [render], [shadows], [lighting], [post] and the techniques' tables;
    // the models, shapes and camera poses stay, so they must be the same. Much faster than setScene. The scene before
    // stays when this fails.
    Result<void> updateScene(const scene::Scene& scene);
    // Opens a scene or model file, reads its content and sets it.
    Result<void> open(const std::filesystem::path& file, std::span<const scene::Override> overrides = {});
    const scene::Scene& scene() const;
    const scene::Content& content() const;

    // Draws one frame; an error for a request out of range. The result stays in display() and radiance() until the next
    // one.
    Result<void> render(const FrameRequest& request);

    gl::TextureView display() const;   // RGBA8, sRGB encoded, a = coverage
    gl::TextureView radiance() const;  // linear, antialiased
    Result<ByteImage> readDisplay();   // row 0 on top
    Result<Image> readRadiance();      // RGBA
    // The AOVs named, of the last frame, sampled at pixel centres (radiance: antialiased). Ask with setAovs before
    // render.
    void setAovs(std::span<const std::string> names);
    Result<std::vector<Layer>> readAovs();
    // Copies the display texture to a framebuffer of the host (0: the window), scaled to (width, height).
    void blit(std::uint32_t framebuffer, int width, int height);

    light::View view() const;  // of the last frame, without jitter
    void setTiming(bool on);
    // Scenes set from now on keep what drafts are drawn from.
    void setDraftsWanted(bool wanted);
    frame::Stats stats() const;  // passes of the last frame, bytes held, triangles, draws

private:
    struct State;
    explicit Pipeline(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

// How a file of frames is written.
struct OutputOptions {
    int firstFrame = 0, endFrame = 1;  // half open; time = frame / fps + startTime
    bool isStill = true;               // one picture without a frame number
    float fps = 30;
    float startTime = 0;
    bool transparent = false;  // PNG with alpha
    int jpegQuality = 92;
    std::vector<std::string> aovs;  // EXR layers
    std::string posesFile;          // "": none; else the camera pose of every frame (CSV)
    ProgressCallback progress;
};
// Renders to .png, .jpg, .exr (a still or numbered frames) or .mp4. Nothing is left half written. Returns the files
// written.
Result<std::vector<std::string>> renderToFile(Pipeline& pipeline, FrameRequest request, const std::string& output,
                                              const OutputOptions& options);

}  // namespace shoal::pipeline
