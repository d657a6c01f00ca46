#include "bench/peers/f3d.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include <shoal/io/image.h>
#include <shoal/scene/content.h>

extern char** environ;

namespace shoal::bench {

namespace {

std::string words(Vec3 v) {
    char text[100];
    std::snprintf(text, sizeof text, "%.7g,%.7g,%.7g", v.x, v.y, v.z);
    return text;
}

// Starts an Xvfb on a free display and waits until it answers.
Result<int> startXvfb(std::string& display) {
    for (int number = 90; number < 120; ++number) {
        const std::string socket = "/tmp/.X11-unix/X" + std::to_string(number);
        if (std::filesystem::exists(socket)) continue;
        display = ":" + std::to_string(number);
        char* arguments[] = {const_cast<char*>("Xvfb"),         display.data(),
                             const_cast<char*>("-screen"),      const_cast<char*>("0"),
                             const_cast<char*>("1600x1200x24"), const_cast<char*>("-nolisten"),
                             const_cast<char*>("tcp"),          nullptr};
        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", 1, 0);
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", 1, 0);
        pid_t child = 0;
        const int failed = ::posix_spawnp(&child, "Xvfb", &actions, nullptr, arguments, environ);
        posix_spawn_file_actions_destroy(&actions);
        if (failed) return badInput("Xvfb could not be started");
        for (int wait = 0; wait < 100; ++wait) {
            if (std::filesystem::exists(socket)) return int(child);
            ::usleep(50000);
        }
        ::kill(child, SIGTERM);
        ::waitpid(child, nullptr, 0);
    }
    return badInput("no Xvfb answered on displays :90 to :119");
}

}  // namespace

Result<std::unique_ptr<F3d>> F3d::start(const Settings& settings, const std::string& model, int width, int height) {
    if (!haveProgram("f3d")) return badInput("f3d is not installed");
    if (!haveProgram("Xvfb")) return badInput("Xvfb is not installed");
    // The camera that shoal fits to the bare model.
    SHOAL_TRY_ASSIGN(const scene::Scene scene, scene::sceneForModel(model));
    SHOAL_TRY_ASSIGN(const scene::Content content, scene::loadContent(scene));
    const light::Camera camera = scene::cameraAt(scene, content, 0, float(width) / float(height));
    const Vec3 eye = camera.position();
    const Vec3 target = eye + transformDirection(camera.worldFromView, {0, 0, -10});

    std::unique_ptr<F3d> f3d(new F3d);
    SHOAL_TRY_ASSIGN(f3d->xvfb_, startXvfb(f3d->display_));
    f3d->settings_ = settings;
    f3d->model_ = model;
    f3d->width_ = width;
    f3d->height_ = height;
    f3d->picture_ = settings.scratchDir + "/f3d.png";
    f3d->command_ = {"f3d",
                     model,
                     "--dry-run",
                     "--quiet",
                     "--output",
                     f3d->picture_,
                     "--no-background",
                     "--resolution=" + std::to_string(width) + "," + std::to_string(height),
                     "--ssao",
                     "--fxaa",
                     "--tone-mapping",
                     "--camera-position=" + words(eye),
                     "--camera-focal-point=" + words(target),
                     "--camera-view-up=0,1,0",
                     "--camera-view-angle=" + std::to_string(degrees(camera.verticalFov))};
    return f3d;
}

F3d::~F3d() {
    if (xvfb_ <= 0) return;
    ::kill(xvfb_, SIGTERM);
    ::waitpid(xvfb_, nullptr, 0);
}

Ran F3d::draw(const std::map<std::string, std::string>& environment) const {
    std::map<std::string, std::string> withDisplay = environment;
    withDisplay["DISPLAY"] = display_;
    return runProgram(command_, withDisplay);
}

Result<double> F3d::coverageOverlap() const {
    const std::string ours = settings_.scratchDir + "/ours_coverage.exr";
    const Ran ran = runProgram({settings_.tool, "render", model_, "-o", ours, "--quiet", "--device", settings_.device,
                                "--size", std::to_string(width_) + "x" + std::to_string(height_), "--aov", "objectId"});
    if (ran.exitCode != 0) return internalError("shoal render failed");
    SHOAL_TRY_ASSIGN(const std::vector<Layer> layers, io::readLayers(ours));
    SHOAL_TRY_ASSIGN(const ByteImage theirs, io::readByteImage(picture_));
    const Image* ids = nullptr;
    for (const Layer& layer : layers)
        if (layer.name == "objectId") ids = &layer.image;
    if (!ids || theirs.width != ids->width || theirs.height != ids->height)
        return internalError("the pictures' sizes differ");
    std::size_t both = 0, either = 0;
    for (std::size_t i = 0; i < ids->pixels.size(); ++i) {
        const bool a = ids->pixels[i] == 1;  // the model; the ground is number 2
        const bool b = theirs.pixels[i * 4 + 3] > 127;
        both += a && b;
        either += a || b;
    }
    return either ? double(both) / double(either) : 0.0;
}

}  // namespace shoal::bench
