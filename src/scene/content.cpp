// Reads a scene's files and makes its shapes, in parallel.
#include <shoal/scene/content.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <shoal/core/parallel.h>
#include <shoal/core/pose.h>
#include <shoal/core/random.h>
#include <shoal/io/image.h>
#include <shoal/io/model.h>
#include <shoal/io/poses.h>
#include <shoal/scene/shapes.h>

#include "scene/bind.h"
#include "scene/content_parts.h"

namespace shoal::scene {

namespace {

Error at(const Place& place, const Error& error) {
    return {error.kind, place.line > 0 ? place.describe() + ": " + error.message : error.message};
}

std::filesystem::path resolve(const Scene& scene, const std::string& file) {
    const std::filesystem::path path(file);
    return path.is_absolute() ? path : scene.file.parent_path() / path;
}

// One file or shape to make; several entries may share a file.
struct Job {
    const ModelEntry* model = nullptr;
    const ShapeEntry* shape = nullptr;
    std::string key;
};

io::ModelReadOptions readOptions(const ModelSpec& spec, const LogSink& log) {
    io::ModelReadOptions options;
    options.up = spec.up == "y" ? io::UpAxis::y : spec.up == "z" ? io::UpAxis::z : io::UpAxis::automatic;
    options.scale = spec.unit;
    options.log = log;
    return options;
}

// The place of the setting that a shape's error speaks of, else the shape's own.
Place placeOfSetting(const ShapeEntry& shape, const std::string& message) {
    for (const RawEntry& setting : shape.settings)
        if (message.rfind(setting.key + ":", 0) == 0 || message.find("." + setting.key + ":") != std::string::npos ||
            message.find("\"" + setting.key + "\"") != std::string::npos)
            return setting.place;
    return shape.place;
}

Result<Model> runJob(const Scene& scene, const Job& job, const LogSink& log) {
    if (job.model) {
        auto model = io::readModel(resolve(scene, job.model->model.file), readOptions(job.model->model, log));
        return model ? std::move(model) : at(job.model->place, model.error());
    }
    std::vector<ShapeSetting> settings;
    for (const RawEntry& setting : job.shape->settings) settings.push_back({setting.key, setting.value});
    auto model = makeShape(job.shape->kind, settings);
    if (model) return model;
    const std::string& message = model.error().message;
    return errorAt(placeOfSetting(*job.shape, message), "shape", message);  // a usage error where --set gave the value
}

Mat4 placementMatrix(const PlacementSpec& p) {
    const Vec3 angles{radians(p.rotationDeg.x), radians(p.rotationDeg.y), radians(p.rotationDeg.z)};
    return compose(p.position, eulerXyz(angles), p.scale);
}

Result<int> clipIndex(const ModelEntry& entry, const Model& model) {
    if (entry.model.clip.empty()) return -1;
    if (entry.model.clip == "*") return model.clips.empty() ? -1 : preferredClip(model);
    const int clip = findClip(model, entry.model.clip);
    if (clip >= 0) return clip;
    std::vector<std::string> names;
    for (const Clip& c : model.clips) names.push_back(c.name);
    return badInput(entry.place.describe() + ": model " + entry.model.file + ": " +
                    unknownWord("clip", entry.model.clip, names));
}

Result<void> addModelInstances(const ModelEntry& entry, int modelIndex, Content& content) {
    SHOAL_TRY_ASSIGN(const int clip, clipIndex(entry, content.models[std::size_t(modelIndex)]));
    const CopiesSpec& c = entry.copies;
    const auto shift = [&](std::uint32_t which, std::uint32_t n) { return 2 * randomFloat(c.seed, n, which) - 1; };
    for (int iz = 0; iz < c.countZ; ++iz) {
        for (int ix = 0; ix < c.countX; ++ix) {
            const auto n = std::uint32_t(iz * c.countX + ix);
            Instance instance;
            instance.name = entry.placement.name.empty() ? entry.model.file : entry.placement.name;
            instance.model = modelIndex;
            instance.clip = clip;
            instance.speed = entry.model.speed;
            instance.startTime = entry.model.startTime + float(n) * c.timeStep * (n > 0 ? 1.0f : 0.0f);
            instance.loop = entry.model.loop;
            instance.castsShadow = entry.placement.castsShadow;
            instance.visible = entry.placement.visible;
            instance.tint = entry.placement.tint;
            instance.hide = entry.hide;
            PlacementSpec placed = entry.placement;
            placed.position += Vec3{(float(ix) - 0.5f * float(c.countX - 1)) * c.spacingX + c.jitter * shift(0, n), 0,
                                    (float(iz) - 0.5f * float(c.countZ - 1)) * c.spacingZ + c.jitter * shift(1, n)};
            placed.rotationDeg.y += c.turnDeg * shift(2, n);
            instance.worldFromModel = placementMatrix(placed);
            instance.walk = entry.walk;
            content.instances.push_back(std::move(instance));
        }
    }
    return {};
}

void addShapeInstance(const ShapeEntry& entry, int modelIndex, Content& content) {
    Instance instance;
    instance.name = entry.placement.name.empty() ? entry.kind : entry.placement.name;
    instance.model = modelIndex;
    instance.clip = content.models[std::size_t(modelIndex)].clips.empty() ? -1 : 0;  // a shape that moves, does
    instance.castsShadow = entry.placement.castsShadow;
    instance.visible = entry.placement.visible;
    instance.tint = entry.placement.tint;
    instance.worldFromModel = placementMatrix(entry.placement);
    content.instances.push_back(std::move(instance));
}

std::vector<Job> collectJobs(const Scene& scene, std::map<std::string, int>& modelOfFile) {
    std::vector<Job> jobs;
    for (const ModelEntry& entry : scene.models) {
        const std::string key = entry.model.file + "|" + entry.model.up + "|" + std::to_string(entry.model.unit);
        if (modelOfFile.emplace(key, int(jobs.size())).second) jobs.push_back({&entry, nullptr, key});
    }
    for (const ShapeEntry& entry : scene.shapes) jobs.push_back({nullptr, &entry, {}});
    return jobs;
}

// A model's directional light is the sun of a scene that names none; a clear sky follows it.
void takeSun(const Scene& scene, const light::Sun& sun, Content& content) {
    if (scene.sunOff || scene.sunGiven) return;
    content.sun = sun;
    if (scene.environment.kind == "clearSky")
        content.environment =
            light::makeClearSky(sun.toSun, scene.environment.turbidity, scene.environment.groundAlbedo).environment;
}

// A light, camera or emitter that a model file brings along, in world space.
void addModelLights(const Scene& scene, Content& content) {
    for (const Instance& instance : content.instances) {
        const Model& model = content.models[std::size_t(instance.model)];
        if (model.lights.empty() || !instance.visible) continue;
        Pose pose;
        poseModel(model, instance.clip, instance.startTime, instance.loop, pose);
        for (std::size_t i = 0; i < model.nodes.size(); ++i) {
            if (model.nodes[i].light < 0) continue;
            const ModelLight& from = model.lights[std::size_t(model.nodes[i].light)];
            const Mat4 worldFromNode = instance.worldFromModel * pose.modelFromNode[i];
            const Vec3 towards = normalize(transformDirection(worldFromNode, {0, 0, -1}));
            if (from.kind == ModelLight::Kind::directional) {
                takeSun(scene, light::Sun{-towards, from.intensity, radians(scene.sun.discDeg), true}, content);
                continue;
            }
            light::PunctualLight to;
            to.kind = from.kind == ModelLight::Kind::spot ? light::PunctualLight::Kind::spot
                                                          : light::PunctualLight::Kind::point;
            to.position = transformPoint(worldFromNode, {0, 0, 0});
            to.direction = towards;
            to.intensity = from.intensity;
            to.range = from.range;
            to.innerCone = from.innerCone;
            to.outerCone = from.outerCone;
            to.castsShadow = to.kind == light::PunctualLight::Kind::spot;
            content.lights.push_back(to);
        }
    }
}

light::PunctualLight lightOf(const LightSpec& spec) {
    light::PunctualLight light;
    light.kind = spec.kind == "spot" ? light::PunctualLight::Kind::spot : light::PunctualLight::Kind::point;
    light.position = spec.position;
    light.direction = normalize(spec.target - spec.position);
    light.intensity = spec.intensity;
    light.range = spec.range;
    light.innerCone = radians(spec.innerDeg);
    light.outerCone = radians(spec.outerDeg);
    light.radius = spec.radius;
    light.castsShadow = spec.castsShadow && spec.kind == "spot";
    return light;
}

// Without [sun], a sky's sun stands where SunSpec's default says.
Result<void> makeLight(const Scene& scene, Content& content) {
    const EnvironmentSpec& spec = scene.environment;
    const bool sunFromSky = scene.sun.irradiance.x < 0 || scene.sun.irradiance.y < 0 || scene.sun.irradiance.z < 0;
    light::Sun sun;
    sun.toSun = normalize(scene.sun.toSun);
    sun.discHalfAngle = radians(scene.sun.discDeg);
    sun.castsShadow = scene.sun.castsShadow;
    if (!sunFromSky) sun.irradiance = scene.sun.irradiance;
    bool wantsSun = scene.sunGiven;
    if (spec.kind == "clearSky") {
        light::ClearSky sky = light::makeClearSky(sun.toSun, spec.turbidity, spec.groundAlbedo);
        if (sunFromSky) sun.irradiance = sky.sun.irradiance;
        content.environment = std::move(sky.environment);
        content.sunInBackground = !scene.sunOff;
        wantsSun = true;
    } else if (spec.kind == "file") {
        auto picture = io::readImage(resolve(scene, spec.file));
        if (!picture) return at(scene.environmentPlace, picture.error());
        if (picture->channelCount < 3 || picture->width != 2 * picture->height)
            return badInput(scene.environmentPlace.describe() + ": environment.file: " + spec.file + ": found " +
                            std::to_string(picture->width) + " x " + std::to_string(picture->height) + " with " +
                            std::to_string(picture->channelCount) +
                            " channels, expected a lat-long picture twice as wide as high, in colour");
        light::Environment environment;
        environment.radiance = toRgb(*std::move(picture));
        environment.rotation = radians(spec.rotationDeg);
        auto found = light::extractSun(environment);
        if (scene.sunGiven && !sunFromSky) {
            // The explicit sun stands in for the disc that was taken out.
        } else if (found) {
            const light::Sun written = sun;
            sun = *found;
            if (scene.sunGiven) sun.toSun = written.toSun;
            sun.castsShadow = written.castsShadow;
            wantsSun = true;
        }
        content.environment = std::move(environment);
        content.sunInBackground = found.has_value() && !scene.sunOff;
    } else if (spec.kind == "color") {
        light::Environment environment;
        environment.radiance = Image(8, 4, 3);
        for (std::size_t i = 0; i < environment.radiance.pixels.size(); i += 3) {
            environment.radiance.pixels[i] = spec.color.x;
            environment.radiance.pixels[i + 1] = spec.color.y;
            environment.radiance.pixels[i + 2] = spec.color.z;
        }
        content.environment = std::move(environment);
    }
    if (wantsSun && !scene.sunOff) content.sun = sun;
    for (const LightSpec& light : scene.lights) content.lights.push_back(lightOf(light));
    return {};
}

Result<void> readPoses(const Scene& scene, Content& content) {
    if (scene.cameraKind != CameraKind::poses) return {};
    auto poses = io::readPoses(resolve(scene, scene.cameraPosesFile), scene.render.fps);
    if (!poses) return at(scene.cameraPlace, poses.error());
    for (const io::CameraPose& pose : *poses)
        content.poses.push_back({pose.time, compose(pose.position, pose.worldFromCamera, {1, 1, 1})});
    return {};
}

}  // namespace

Mat4 transformAt(const Instance& instance, float time) {
    if (!instance.walk) return instance.worldFromModel;
    const WalkSpec& walk = *instance.walk;
    const std::size_t legCount = walk.points.size() - (walk.loop ? 0 : 1);
    float total = 0;
    for (std::size_t i = 0; i < legCount; ++i)
        total += length(walk.points[(i + 1) % walk.points.size()] - walk.points[i]);
    float left = std::max(0.0f, time) * walk.speed;
    if (walk.loop && total > 0) left = std::fmod(left, total);
    left = std::min(left, total);
    // The heading turns over the last and first 0.4 m of a leg, so that corners are walked and not snapped.
    const float turn = 0.4f;
    for (std::size_t i = 0; i < legCount; ++i) {
        const Vec3 from = walk.points[i], to = walk.points[(i + 1) % walk.points.size()];
        const float leg = length(to - from);
        if (left > leg && i + 1 < legCount) {
            left -= leg;
            continue;
        }
        const Vec3 forward = normalize(to - from);
        Vec3 heading = forward;
        const bool hasNext = walk.loop || i + 2 < walk.points.size(), hasPrevious = walk.loop || i > 0;
        if (hasNext && left > leg - turn) {
            const Vec3 next = normalize(walk.points[(i + 2) % walk.points.size()] - to);
            heading = lerp(forward, next, 0.5f * (left - (leg - turn)) / turn);
        } else if (hasPrevious && left < turn) {
            const Vec3 previous = normalize(from - walk.points[(i + walk.points.size() - 1) % walk.points.size()]);
            heading = lerp(forward, previous, 0.5f * (turn - left) / turn);
        }
        const float yaw = std::atan2(heading.x, heading.z);
        return translation(lerp(from, to, leg > 0 ? left / leg : 0)) * rotation(axisAngle({0, 1, 0}, yaw)) *
               instance.worldFromModel;
    }
    return instance.worldFromModel;
}

bool sameLights(const Scene& a, const Scene& b) {
    if (a.sunGiven != b.sunGiven || a.sunOff != b.sunOff || a.lights.size() != b.lights.size()) return false;
    const auto values = [](const auto& params) {
        std::string all;
        visit(params, [&](const auto& field, const Field&) { all += detail::showField(field) + "\n"; });
        return all;
    };
    if (values(a.sun) != values(b.sun) || values(a.environment) != values(b.environment)) return false;
    for (std::size_t i = 0; i < a.lights.size(); ++i)
        if (values(a.lights[i]) != values(b.lights[i])) return false;
    return true;
}

bool sameTables(const Scene& a, const Scene& b, std::string_view root) {
    const auto wordsOf = [&](const Scene& scene) {
        std::string all;
        for (const RawTable& table : scene.tables) {
            if (table.name.substr(0, table.name.find('.')) != root) continue;
            all += "[" + table.name + "]\n";
            for (const RawEntry& entry : table.entries) {
                all += entry.key + "=" + (entry.value.boolean ? "true" : "") + entry.value.text;
                for (const double number : entry.value.numbers) all += " " + detail::showField(float(number));
                all += "\n";
            }
        }
        return all;
    };
    return wordsOf(a) == wordsOf(b);
}

Result<void> reloadLights(const Scene& scene, Content& content) {
    Content lit;
    SHOAL_TRY(makeLight(scene, lit));
    std::swap(lit.models, content.models);
    std::swap(lit.instances, content.instances);
    addModelLights(scene, lit);
    std::swap(lit.models, content.models);
    std::swap(lit.instances, content.instances);
    content.environment = std::move(lit.environment);
    content.sun = lit.sun;
    content.sunInBackground = lit.sunInBackground;
    content.lights = std::move(lit.lights);
    return {};
}

Result<Content> loadContent(const Scene& scene, const LogSink& log) {
    Content content;
    std::map<std::string, int> modelOfFile;
    const std::vector<Job> jobs = collectJobs(scene, modelOfFile);
    std::vector<Result<Model>> made(jobs.size(), Result<Model>(badInput("not read")));
    Result<void> lit;
    // The sky is one more job beside the files: it takes about as long.
    parallelFor(jobs.size() + 1, 1, [&](std::size_t i) {
        if (i == 0)
            lit = makeLight(scene, content);
        else
            made[i - 1] = runJob(scene, jobs[i - 1], log);
    });
    SHOAL_TRY(lit);
    for (Result<Model>& model : made) {
        if (!model) return std::move(model).error();
        content.models.push_back(*std::move(model));
    }
    std::size_t shape = modelOfFile.size();
    for (const ModelEntry& entry : scene.models) {
        const std::string key = entry.model.file + "|" + entry.model.up + "|" + std::to_string(entry.model.unit);
        SHOAL_TRY(addModelInstances(entry, modelOfFile[key], content));
    }
    for (const ShapeEntry& entry : scene.shapes) addShapeInstance(entry, int(shape++), content);
    addModelLights(scene, content);
    SHOAL_TRY(readPoses(scene, content));
    measure(content);
    if (scene.bareModel) SHOAL_TRY(addGround(scene.environment, content));
    if (scene.cameraKind == CameraKind::modelCamera) SHOAL_TRY(checkModelCamera(scene, content));
    return content;
}

}  // namespace shoal::scene
