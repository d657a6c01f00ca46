// The scene file: what there is to draw, as written by a person. TOML in, checked structs out; a technique's own table
// stays raw (key, value, line) and is bound by the pipeline.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <shoal/core/params.h>
#include <shoal/core/result.h>

namespace shoal::scene {

// Where in the file something stands; errors begin with it: "street.toml:12: camera.fovDeg: ...".
struct Place {
    std::string file;
    int line = 0;                  // 0: not from a file (a --set override, a default)
    std::string describe() const;  // "street.toml:12" or "--set"
};

// A table of a technique, not interpreted here. Nested tables are RawTables with dotted names ("water.caustics"); an
// array of tables gives one RawTable an element ("water.waves.components[0]").
struct RawEntry {
    std::string key;
    FieldValue value;
    Place place;
};
struct RawTable {
    std::string name;
    Place place;
    std::vector<RawEntry> entries;
};

struct CameraSpec {
    Vec3 position{6, 3, 9}, target{0, 1, 0}, up{0, 1, 0};
    float fovDeg = 50, rollDeg = 0, near = 0.05f;
    std::string projection = "perspective";
    float heightM = 10;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, CameraSpec>
void visit(P& p, V&& v) {
    v(p.position, Field{"position", "m", -1e6, 1e6, "where the eye is"});
    v(p.target, Field{"target", "m", -1e6, 1e6, "the point in the middle of the picture"});
    v(p.up, Field{"up", "", -1e6, 1e6, "direction that is up in the picture"});
    v(p.fovDeg, Field{"fovDeg", "deg", 1, 179, "vertical field of view"});
    v(p.rollDeg, Field{"rollDeg", "deg", -360, 360, "turns the camera about its axis, clockwise"});
    v(p.near, Field{"near", "m", 1e-4, 1000, "distance of the near plane"});
    v(p.projection, Field{"projection", "", -1e30, 1e30, "how depth is drawn", {"perspective", "orthographic"}});
    v(p.heightM, Field{"heightM", "m", 1e-4, 1e6, "metres from top to bottom of an orthographic picture"});
}

// Circles round a centre: startDeg counter-clockwise from +z seen from above.
struct OrbitSpec {
    Vec3 center{0, 1, 0};
    float radius = 10, elevationDeg = 15, startDeg = 0, degPerSecond = 20;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, OrbitSpec>
void visit(P& p, V&& v) {
    v(p.center, Field{"center", "m", -1e6, 1e6, "what the camera circles and looks at"});
    v(p.radius, Field{"radius", "m", 1e-3, 1e6, "distance from the centre"});
    v(p.elevationDeg, Field{"elevationDeg", "deg", -89, 89, "height above the horizon"});
    v(p.startDeg, Field{"startDeg", "deg", -1e6, 1e6, "where it starts, from +z towards +x"});
    v(p.degPerSecond, Field{"degPerSecond", "deg/s", -3600, 3600, "how fast it goes round"});
}

// A key of a camera path; between keys position, target and fov run along Catmull-Rom splines in time.
struct CameraKey {
    float time = 0;
    Vec3 position{0, 0, 0}, target{0, 0, -1};
    float fovDeg = 50;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, CameraKey>
void visit(P& p, V&& v) {
    v(p.time, Field{"time", "s", -1e6, 1e6, "when"});
    v(p.position, Field{"position", "m", -1e6, 1e6, "where the eye is then"});
    v(p.target, Field{"target", "m", -1e6, 1e6, "what it looks at then"});
    v(p.fovDeg, Field{"fovDeg", "deg", 1, 179, "vertical field of view then"});
}

struct IntrinsicsSpec {
    float fx = 0, fy = 0, cx = 0, cy = 0, width = 0, height = 0;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, IntrinsicsSpec>
void visit(P& p, V&& v) {
    v(p.fx, Field{"fx", "px", 1e-3, 1e6, "focal length across"});
    v(p.fy, Field{"fy", "px", 1e-3, 1e6, "focal length down"});
    v(p.cx, Field{"cx", "px", -1e6, 1e6, "principal point from the left edge"});
    v(p.cy, Field{"cy", "px", -1e6, 1e6, "principal point from the top edge"});
    v(p.width, Field{"width", "px", 1, 1e6, "width of the picture that the numbers are for"});
    v(p.height, Field{"height", "px", 1, 1e6, "height of the picture that the numbers are for"});
}

struct SunSpec {
    Vec3 toSun{-0.55f, 0.72f, 0.6f};
    Vec3 irradiance{-1, -1, -1};  // below 0: what the clear sky leaves of the sun, else 9.2
    float discDeg = 0.2667f;
    bool castsShadow = true;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, SunSpec>
void visit(P& p, V&& v) {
    v(p.toSun, Field{"toSun", "", -1e6, 1e6, "direction towards the sun (any length)"});
    v(p.irradiance,
      Field{"irradiance", "W/m2", -1, 1e6, "on a plane facing the sun, per channel; -1 takes it from the sky"});
    v(p.discDeg, Field{"discDeg", "deg", 0, 45, "half angle of the sun's disc, 0 a point"});
    v(p.castsShadow, Field{"castsShadow", "", -1e30, 1e30, "whether things shade each other from it"});
}

struct LightSpec {
    std::string kind = "point";
    Vec3 position{0, 3, 0}, target{0, 0, 0};
    Vec3 intensity{10, 10, 10};
    float range = 0, innerDeg = 20, outerDeg = 30, radius = 0.05f;
    bool castsShadow = true;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, LightSpec>
void visit(P& p, V&& v) {
    v(p.kind, Field{"kind", "", -1e30, 1e30, "what it is", {"point", "spot"}});
    v(p.position, Field{"position", "m", -1e6, 1e6, "where it is"});
    v(p.target, Field{"target", "m", -1e6, 1e6, "what a spot points at"});
    v(p.intensity, Field{"intensity", "W/sr", 0, 1e9, "per channel"});
    v(p.range, Field{"range", "m", 0, 1e6, "how far it reaches, 0 without end"});
    v(p.innerDeg, Field{"innerDeg", "deg", 0, 89, "half angle of a spot's bright cone"});
    v(p.outerDeg, Field{"outerDeg", "deg", 0.1, 89, "half angle where a spot ends"});
    v(p.radius, Field{"radius", "m", 0.001, 100, "size of the lamp"});
    v(p.castsShadow, Field{"castsShadow", "", -1e30, 1e30, "spots only: whether things shade each other from it"});
}

struct EnvironmentSpec {
    std::string kind = "clearSky";  // "clearSky", "file", "color", "none"
    std::string file;
    float rotationDeg = 0, intensity = 1, turbidity = 2.2f;
    Vec3 groundAlbedo{0.25f, 0.24f, 0.22f}, color{1, 1, 1};
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, EnvironmentSpec>
void visit(P& p, V&& v) {
    v(p.kind,
      Field{"kind", "", -1e30, 1e30, "where light from all around comes from", {"clearSky", "file", "color", "none"}});
    v(p.file, Field{"file", "", -1e30, 1e30, "lat-long picture (.hdr, .exr)"});
    v(p.rotationDeg, Field{"rotationDeg", "deg", -1e6, 1e6, "turns it counter-clockwise seen from above"});
    v(p.intensity, Field{"intensity", "", 0, 1e6, "times its radiance"});
    v(p.turbidity, Field{"turbidity", "", 1, 10, "haze of the clear sky"});
    v(p.groundAlbedo, Field{"groundAlbedo", "", 0, 1, "what the clear sky's ground reflects"});
    v(p.color, Field{"color", "W/(m2 sr)", 0, 1e6, "radiance of kind color"});
}

// Where something stands and how it is coloured; common to models and shapes.
struct PlacementSpec {
    std::string name;
    Vec3 position{0, 0, 0}, rotationDeg{0, 0, 0}, scale{1, 1, 1};
    Vec3 tint{1, 1, 1};
    bool castsShadow = true, visible = true;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, PlacementSpec>
void visit(P& p, V&& v) {
    v(p.name, Field{"name", "", -1e30, 1e30, "what it is called"});
    v(p.position, Field{"position", "m", -1e6, 1e6, "where its origin is"});
    v(p.rotationDeg, Field{"rotationDeg", "deg", -1e6, 1e6, "about x, then y, then z"});
    v(p.scale, Field{"scale", "", -1e6, 1e6, "size along x, y, z (one number: all three)"});
    v(p.tint, Field{"tint", "", 0, 10, "times its colours"});
    v(p.castsShadow, Field{"castsShadow", "", -1e30, 1e30, "whether it shades others"});
    v(p.visible, Field{"visible", "", -1e30, 1e30, "whether it is drawn"});
}

struct ModelSpec {
    std::string file, clip, up = "auto";
    float speed = 1, startTime = 0, unit = 0;
    bool loop = true;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, ModelSpec>
void visit(P& p, V&& v) {
    v(p.file, Field{"file", "", -1e30, 1e30, "model file, relative to the scene file"});
    v(p.clip, Field{"clip", "", -1e30, 1e30, "name of the animation clip that plays; none: it stands as stored"});
    v(p.up, Field{"up", "", -1e30, 1e30, "the file's up axis", {"auto", "y", "z"}});
    v(p.speed, Field{"speed", "", -100, 100, "clip seconds a second"});
    v(p.startTime, Field{"startTime", "s", -1e6, 1e6, "clip time at scene time 0"});
    v(p.unit, Field{"unit", "m", 0, 1e6, "metres one unit of the file stands for, 0: as the file says"});
    v(p.loop, Field{"loop", "", -1e30, 1e30, "whether the clip starts again at its end"});
}

// Many copies on a grid about the model's position: the n-th has startTime shifted by n * timeStep.
struct CopiesSpec {
    int countX = 1, countZ = 1;
    float spacingX = 1.5f, spacingZ = 1.5f, jitter = 0, timeStep = 0.137f, turnDeg = 0;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, CopiesSpec>
void visit(P& p, V&& v) {
    v(p.countX, Field{"countX", "", 1, 1000, "how many along x"});
    v(p.countZ, Field{"countZ", "", 1, 1000, "how many along z"});
    v(p.spacingX, Field{"spacingX", "m", 0, 1e4, "distance along x"});
    v(p.spacingZ, Field{"spacingZ", "m", 0, 1e4, "distance along z"});
    v(p.jitter, Field{"jitter", "m", 0, 1e4, "moves each at random by up to this"});
    v(p.timeStep, Field{"timeStep", "s", -1e4, 1e4, "how much later in the clip each next one is"});
    v(p.turnDeg, Field{"turnDeg", "deg", 0, 180, "turns each at random by up to this"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "of the random moves"});
}

// Walks along points at a steady speed, its +z forward.
struct WalkSpec {
    std::vector<Vec3> points;  // metres, at least 2
    float speed = 1.2f;        // m/s
    bool loop = false;         // back to the first point at the end (a closed way)
};

struct ModelEntry {
    Place place;
    std::string key;  // what --set calls it: "model[2]"
    ModelSpec model;
    PlacementSpec placement;
    CopiesSpec copies;
    std::optional<WalkSpec> walk;
    std::vector<std::string> hide;  // node names not drawn; `*` at the end matches any rest
};

struct ShapeEntry {
    Place place;
    std::string key;  // "shape[0]", or "model[1]" for a [[model]] with a shape
    std::string kind;
    PlacementSpec placement;
    std::vector<RawEntry> settings;  // what the shape itself takes (shapes.h)
};

struct RenderSpec {
    int width = 1280, height = 720;
    float fps = 30, duration = 10;
    float time = 0;
    std::string antialiasing = "supersample";
    int samples = 4;
    std::uint32_t seed = 1;
};
template <class P, class V>
requires std::is_same_v<std::remove_const_t<P>, RenderSpec>
void visit(P& p, V&& v) {
    v(p.width, Field{"width", "px", 1, 16384, "width of the picture"});
    v(p.height, Field{"height", "px", 1, 16384, "height of the picture"});
    v(p.fps, Field{"fps", "1/s", 0.01, 1000, "frames a second of films"});
    v(p.duration, Field{"duration", "s", 0, 1e6, "length of a film when no frame range is given"});
    v(p.time, Field{"time", "s", -1e6, 1e6, "scene time of a still"});
    v(p.antialiasing,
      Field{"antialiasing", "", -1e30, 1e30, "how edges are smoothed", {"none", "supersample", "temporal"}});
    v(p.samples, Field{"samples", "", 1, 1024, "samples a pixel of supersample"});
    v(p.seed, Field{"seed", "", 0, 4294967295.0, "of every random choice"});
}

enum class CameraKind { fixed, orbit, path, modelCamera, poses, fitted };

struct Scene {
    std::filesystem::path file;  // relative paths in it are relative to its folder
    CameraKind cameraKind = CameraKind::fitted;
    CameraSpec camera;
    OrbitSpec orbit;
    std::vector<CameraKey> cameraKeys;  // by time
    std::string cameraPosesFile;        // io/poses.h
    std::string cameraOfModel;          // "model name" or "model name/camera name"
    std::optional<IntrinsicsSpec> intrinsics;
    Place cameraPlace;
    bool sunGiven = false;
    SunSpec sun;
    bool sunOff = false;  // sun = "none"
    EnvironmentSpec environment;
    Place environmentPlace;
    std::vector<LightSpec> lights;
    std::vector<ModelEntry> models;
    std::vector<ShapeEntry> shapes;
    RenderSpec render;
    bool bareModel = false;        // ground = true (sceneForModel's default): loadContent adds one below everything
    std::vector<RawTable> tables;  // [shadows] [lighting] [post] and the techniques'
    const RawTable* table(std::string_view name) const;
};

// A `--set key=value`: "camera.fovDeg=40", "model[0].clip=Run", "post.exposureEv=1". One of camera.position takes the
// place of the file's orbit, path, poses or model camera, one of sun.toSun of the sun's angles.
struct Override {
    std::string key, value;
};
Result<Override> parseOverride(std::string_view words);

// Reads a scene file. Errors: one line with file, line, key, what was found and what was expected; those of overrides
// are usage errors.
Result<Scene> loadScene(const std::filesystem::path& file, std::span<const Override> overrides = {});
// The same from text; `file` names it in errors and gives the folder of relative paths.
Result<Scene> parseScene(std::string_view text, const std::filesystem::path& file,
                         std::span<const Override> overrides = {});
// A scene around one model file: fitted camera at a flattering angle, clear sky, a ground that takes shadow, its first
// clip playing.
Result<Scene> sceneForModel(const std::filesystem::path& modelFile, std::span<const Override> overrides = {});
// loadScene for .toml, sceneForModel for anything io::readModel takes; an error that lists both for any other.
Result<Scene> openScene(const std::filesystem::path& file, std::span<const Override> overrides = {});

// Binds a raw table to a technique's parameters; unknown keys are errors that name the nearest known. Several structs
// may share a table: each key goes to the one that has it.
template <class... Params>
Result<void> bindTable(const RawTable& table, Params&... params) {
    std::vector<std::string> known;
    (visit(params, [&](auto&, const Field& field) { known.push_back(field.name); }), ...);
    for (const RawEntry& entry : table.entries) {
        Result<void> set = badInput(unknownWord("key", entry.key, known));
        const auto tryOne = [&](auto& one) {
            bool has = false;
            visit(one, [&](auto&, const Field& field) { has = has || entry.key == field.name; });
            if (has) set = setField(one, entry.key, entry.value);
        };
        (tryOne(params), ...);
        if (!set)
            return Error{entry.place.line > 0 ? ErrorKind::badInput : ErrorKind::usage,
                         entry.place.describe() + ": " + table.name + "." + set.error().message};
    }
    return {};
}

}  // namespace shoal::scene
