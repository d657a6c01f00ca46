// A scene's files read and its shapes made: plain data ready for a renderer, and where the camera is at a time.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <shoal/core/log.h>
#include <shoal/core/model.h>
#include <shoal/light/environment.h>
#include <shoal/light/lights.h>
#include <shoal/light/view.h>
#include <shoal/scene/scene.h>

namespace shoal::scene {

// One thing that stands somewhere.
struct Instance {
    std::string name;
    int model = -1;  // index into Content::models
    int clip = -1;
    float speed = 1, startTime = 0;
    bool loop = true, castsShadow = true, visible = true;
    Vec3 tint{1, 1, 1};
    Mat4 worldFromModel;  // without a walk
    std::optional<WalkSpec> walk;
    std::vector<std::string> hide;
};
// worldFromModel at `time` seconds: the walk's where there is one.
Mat4 transformAt(const Instance& instance, float time);

struct CameraPoseKey {
    float time = 0;
    Mat4 worldFromView;
};

struct Content {
    std::vector<Model> models;
    std::vector<Instance> instances;
    std::optional<light::Environment> environment;  // nothing: black
    std::optional<light::Sun> sun;
    bool sunInBackground = false;              // the sky was made without the disc: draw it
    std::vector<light::PunctualLight> lights;  // the scene's and the models' own
    std::vector<CameraPoseKey> poses;          // of CameraKind::poses
    Bounds bounds;                             // of all visible instances at time 0, world
    std::vector<Bounds> focusBoxes;            // one a mesh that is worth looking at
    Bounds focus;                              // the same without wide, empty things: ground, sea, sky dome
    bool hasGround = false;                    // a wide, thin mesh lies under all there is
};

// Reads and makes everything, in parallel. Errors name the scene's line and the file.
Result<Content> loadContent(const Scene& scene, const LogSink& log = {});

// Whether sun, environment and lamps of two scenes are the same.
bool sameLights(const Scene& a, const Scene& b);
// Whether the tables of a technique ("water", "water.waves", ...) say the same.
bool sameTables(const Scene& a, const Scene& b, std::string_view root);
// Makes the lights of a content anew by `scene`, which has the same models; nothing changes when it fails.
Result<void> reloadLights(const Scene& scene, Content& content);

// The camera at `time`. aspect = width / height (for fitting).
light::Camera cameraAt(const Scene& scene, const Content& content, float time, float aspect);

}  // namespace shoal::scene
