// Scene files: TOML text to checked structs.
#include <shoal/scene/scene.h>

#include <algorithm>
#include <cmath>

#include <shoal/io/file.h>
#include <shoal/io/model.h>
#include <shoal/scene/shapes.h>

#include "scene/bind.h"

namespace shoal::scene {

const RawTable* Scene::table(std::string_view name) const {
    for (const RawTable& t : tables)
        if (t.name == name) return &t;
    return nullptr;
}

Result<Override> parseOverride(std::string_view words) {
    const std::size_t equals = words.find('=');
    if (equals == std::string_view::npos || equals == 0)
        return usageError("--set " + std::string(words) + ": expected key=value, such as camera.fovDeg=40");
    return Override{std::string(words.substr(0, equals)), std::string(words.substr(equals + 1))};
}

namespace {

// Tables that the pipeline binds.
const std::vector<std::string> kRawTables = {"shadows", "lighting", "post", "water", "crowd", "fluid", "volume"};

Result<void> parseCameraKeys(const Tree& tree, Scene& scene) {
    SHOAL_TRY(requireArray(tree, "camera.path"));
    for (std::size_t i = 0; i < tree.elements.size(); ++i) {
        CameraKey key;
        key.fovDeg = scene.camera.fovDeg;
        const std::string path = "camera.path[" + std::to_string(i) + "]";
        SHOAL_TRY(bindAll(tree.elements[i], path, key));
        if (!scene.cameraKeys.empty() && key.time <= scene.cameraKeys.back().time)
            return errorAt(tree.elements[i].place, path, "expected times that increase from key to key");
        scene.cameraKeys.push_back(key);
    }
    if (scene.cameraKeys.empty()) return errorAt(tree.place, "camera.path", "found no keys, expected at least one");
    return {};
}

Result<void> parseCamera(const Tree& tree, Scene& scene) {
    SHOAL_TRY(requireTable(tree, "camera"));
    scene.cameraPlace = tree.place;
    std::vector<std::string> known = {"orbit", "path", "poses", "model", "intrinsics", "fit"};
    SHOAL_TRY(bindFields(tree, "camera", scene.camera, known));
    SHOAL_TRY(refuseUnknown(tree, "camera", known));
    scene.cameraKind = tree.find("position") ? CameraKind::fixed : CameraKind::fitted;
    std::vector<std::string> kinds;
    if (const Tree* orbit = tree.find("orbit")) {
        kinds.push_back("orbit");
        scene.cameraKind = CameraKind::orbit;
        SHOAL_TRY(bindAll(*orbit, "camera.orbit", scene.orbit));
    }
    if (const Tree* path = tree.find("path")) {
        kinds.push_back("path");
        scene.cameraKind = CameraKind::path;
        SHOAL_TRY(parseCameraKeys(*path, scene));
    }
    if (const Tree* poses = tree.find("poses")) {
        kinds.push_back("poses");
        scene.cameraKind = CameraKind::poses;
        SHOAL_TRY_ASSIGN(scene.cameraPosesFile, textOf(*poses, "camera.poses"));
    }
    if (const Tree* model = tree.find("model")) {
        kinds.push_back("model");
        scene.cameraKind = CameraKind::modelCamera;
        SHOAL_TRY_ASSIGN(scene.cameraOfModel, textOf(*model, "camera.model"));
    }
    if (kinds.size() > 1)
        return errorAt(tree.place, "camera",
                       "found both " + kinds[0] + " and " + kinds[1] + ", expected one of orbit, path, poses, model");
    if (const Tree* intrinsics = tree.find("intrinsics")) {
        scene.intrinsics.emplace();
        SHOAL_TRY(bindAll(*intrinsics, "camera.intrinsics", *scene.intrinsics));
        if (auto valid = validate(*scene.intrinsics); !valid)
            return errorAt(intrinsics->place, "camera.intrinsics", valid.error().message);
    }
    if (length(scene.camera.target - scene.camera.position) == 0)
        return errorAt(tree.place, "camera", "target: found the same point as position, expected another");
    return {};
}

// `scale = 2` is short for `scale = [2, 2, 2]`.
Tree withFullScale(const Tree& tree) {
    Tree full = tree;
    if (Tree* scale = full.find("scale");
        scale && scale->kind == Tree::Kind::value && scale->value.kind == FieldValue::Kind::number) {
        scale->value.kind = FieldValue::Kind::numbers;
        scale->value.numbers.assign(3, scale->value.numbers[0]);
    }
    return full;
}

Result<void> checkScale(const Tree& tree, const std::string& path, Vec3 scale) {
    if (scale.x == 0 || scale.y == 0 || scale.z == 0)
        return errorAt(tree.place, path, "scale: found 0, expected a size other than 0 along every axis");
    return {};
}

Result<WalkSpec> parseWalk(const Tree& tree, const std::string& path) {
    SHOAL_TRY(requireTable(tree, path));
    SHOAL_TRY(refuseUnknown(tree, path, {"points", "speed", "loop"}));
    WalkSpec walk;
    if (const Tree* points = tree.find("points")) {
        if (points->kind != Tree::Kind::array)
            return errorAt(points->place, path + ".points",
                           std::string("found ") + describeKind(*points) + ", expected an array of points");
        for (std::size_t i = 0; i < points->elements.size(); ++i) {
            SHOAL_TRY_ASSIGN(const Vec3 point,
                             vec3Of(points->elements[i], path + ".points[" + std::to_string(i) + "]"));
            if (!walk.points.empty() && length(point - walk.points.back()) < 1e-4f)
                return errorAt(points->place, path + ".points[" + std::to_string(i) + "]",
                               "found the point before again, expected another");
            walk.points.push_back(point);
        }
    }
    if (walk.points.size() < 2)
        return errorAt(tree.place, path + ".points",
                       "found " + std::to_string(walk.points.size()) + " points, expected at least 2");
    if (const Tree* speed = tree.find("speed")) {
        if (speed->kind != Tree::Kind::value || speed->value.kind != FieldValue::Kind::number ||
            !(speed->value.numbers[0] >= 0) || speed->value.numbers[0] > 1000)
            return errorAt(speed->place, path + ".speed", "expected 0 .. 1000 m/s");
        walk.speed = float(speed->value.numbers[0]);
    }
    if (const Tree* loop = tree.find("loop")) {
        if (loop->kind != Tree::Kind::value || loop->value.kind != FieldValue::Kind::boolean)
            return errorAt(loop->place, path + ".loop",
                           std::string("found ") + describeKind(*loop) + ", expected true or false");
        walk.loop = loop->value.boolean;
    }
    return walk;
}

Result<ModelEntry> parseModel(const Tree& written, const std::string& path) {
    const Tree tree = withFullScale(written);
    ModelEntry entry;
    entry.place = tree.place;
    entry.key = path;
    SHOAL_TRY(requireTable(tree, path));
    std::vector<std::string> known = {"walk", "hide", "copies"};
    SHOAL_TRY(bindFields(tree, path, entry.model, known));
    SHOAL_TRY(bindFields(tree, path, entry.placement, known));
    SHOAL_TRY(refuseUnknown(tree, path, known));
    if (entry.model.file.empty())
        return errorAt(tree.place, path, "file: found none, expected the name of a model file");
    SHOAL_TRY(checkScale(tree, path, entry.placement.scale));
    if (const Tree* copies = tree.find("copies")) {
        SHOAL_TRY(bindAll(*copies, path + ".copies", entry.copies));
        if (entry.copies.countX * entry.copies.countZ > 100000)
            return errorAt(copies->place, path + ".copies", "found more than 100000 copies, expected fewer");
    }
    if (const Tree* walk = tree.find("walk")) {
        SHOAL_TRY_ASSIGN(entry.walk, parseWalk(*walk, path + ".walk"));
    }
    if (const Tree* hide = tree.find("hide")) {
        if (hide->kind != Tree::Kind::array && !(hide->kind == Tree::Kind::value && hide->value.numbers.empty() &&
                                                 hide->value.kind == FieldValue::Kind::numbers))
            return errorAt(hide->place, path + ".hide",
                           std::string("found ") + describeKind(*hide) + ", expected an array of node names");
        for (const Tree& name : hide->elements) {
            SHOAL_TRY_ASSIGN(std::string text, textOf(name, path + ".hide"));
            entry.hide.push_back(std::move(text));
        }
    }
    return entry;
}

Result<ShapeEntry> parseShape(const Tree& written, const std::string& path) {
    const Tree tree = withFullScale(written);
    ShapeEntry entry;
    entry.place = tree.place;
    entry.key = path;
    SHOAL_TRY(requireTable(tree, path));
    // `shape = "plane"` says the same as `kind = "plane"`.
    const std::string key = tree.find("shape") ? "shape" : "kind";
    if (key == "shape" && tree.find("kind"))
        return errorAt(tree.find("kind")->place, path, "found both kind and shape, expected one of them");
    const Tree* kind = tree.find(key);
    if (!kind) return errorAt(tree.place, path, "kind: found none, expected a shape such as \"plane\" or \"tank\"");
    SHOAL_TRY_ASSIGN(entry.kind, textOf(*kind, path + "." + key));
    std::vector<std::string> placementKeys = {key};
    SHOAL_TRY(bindFields(tree, path, entry.placement, placementKeys));
    SHOAL_TRY(checkScale(tree, path, entry.placement.scale));
    for (const auto& [name, member] : tree.members) {
        if (std::find(placementKeys.begin(), placementKeys.end(), name) != placementKeys.end()) continue;
        if (member.kind != Tree::Kind::value)
            return errorAt(member.place, path + "." + name,
                           std::string("found ") + describeKind(member) + ", expected a value");
        entry.settings.push_back({name, member.value, member.place});
    }
    const std::vector<std::string>& kinds = shapeNames();
    if (std::find(kinds.begin(), kinds.end(), entry.kind) == kinds.end())
        return errorAt(kind->place, path + "." + key, unknownWord("shape", entry.kind, kinds));
    return entry;
}

// A [[model]] with `shape` in place of `file`.
Result<ShapeEntry> parseModelShape(const Tree& tree, const std::string& path) {
    if (const Tree* file = tree.find("file"))
        return errorAt(file->place, path, "found both file and shape, expected one of them");
    return parseShape(tree, path);
}

Result<void> parseEnvironment(const Tree& tree, Scene& scene) {
    scene.environmentPlace = tree.place;
    if (tree.kind == Tree::Kind::value) {  // environment = "none" | "clearSky" | "file.hdr"
        SHOAL_TRY_ASSIGN(const std::string text, textOf(tree, "environment"));
        const bool isFile = text.find('.') != std::string::npos;
        FieldValue value;
        value.kind = FieldValue::Kind::text;
        value.text = text;
        if (isFile)
            scene.environment.kind = "file", scene.environment.file = text;
        else if (auto set = setField(scene.environment, "kind", value); !set)
            return errorAt(tree.place, "environment", set.error().message);
    } else {
        SHOAL_TRY(bindAll(tree, "environment", scene.environment));
        if (!scene.environment.file.empty() && !tree.find("kind")) scene.environment.kind = "file";
    }
    if (scene.environment.kind == "file" && scene.environment.file.empty())
        return errorAt(tree.place, "environment", "file: found none, expected the name of a .hdr or .exr picture");
    return {};
}

Result<void> parseSun(const Tree& tree, Scene& scene) {
    if (tree.kind == Tree::Kind::value) {
        SHOAL_TRY_ASSIGN(const std::string text, textOf(tree, "sun"));
        if (text != "none") return errorAt(tree.place, "sun", "found \"" + text + "\", expected a table or \"none\"");
        scene.sunOff = true;
        return {};
    }
    scene.sunGiven = true;
    std::vector<std::string> known = {"elevationDeg", "azimuthDeg"};
    SHOAL_TRY(requireTable(tree, "sun"));
    SHOAL_TRY(bindFields(tree, "sun", scene.sun, known));
    SHOAL_TRY(refuseUnknown(tree, "sun", known));
    const Tree* elevation = tree.find("elevationDeg");
    const Tree* azimuth = tree.find("azimuthDeg");
    const auto angle = [](const Tree* angleTree, const char* name, double lowest, double highest,
                          double& to) -> Result<void> {
        if (!angleTree) return {};
        if (angleTree->kind != Tree::Kind::value || angleTree->value.kind != FieldValue::Kind::number ||
            !(angleTree->value.numbers[0] >= lowest && angleTree->value.numbers[0] <= highest))
            return errorAt(angleTree->place, std::string("sun.") + name,
                           "expected " + std::to_string(int(lowest)) + " .. " + std::to_string(int(highest)) + " deg");
        to = angleTree->value.numbers[0];
        return {};
    };
    double elevationDeg = 45, azimuthDeg = 40;
    SHOAL_TRY(angle(elevation, "elevationDeg", -90, 90, elevationDeg));
    SHOAL_TRY(angle(azimuth, "azimuthDeg", -360, 360, azimuthDeg));
    if ((elevation || azimuth) && tree.find("toSun"))
        return errorAt(tree.place, "sun", "found toSun and an angle, expected toSun, or elevationDeg and azimuthDeg");
    if (elevation || azimuth) {
        const float e = radians(float(elevationDeg)), a = radians(float(azimuthDeg));
        scene.sun.toSun = {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
    }
    if (length(scene.sun.toSun) < 1e-12f)
        return errorAt(tree.place, "sun", "toSun: found no direction, expected one of any length above 0");
    scene.sun.toSun = normalize(scene.sun.toSun);
    return {};
}

Result<void> parseLights(const Tree& tree, Scene& scene) {
    SHOAL_TRY(requireArray(tree, "light"));
    for (std::size_t i = 0; i < tree.elements.size(); ++i) {
        const std::string path = "light[" + std::to_string(i) + "]";
        LightSpec light;
        SHOAL_TRY(bindAll(tree.elements[i], path, light));
        if (light.kind == "spot" && length(light.target - light.position) == 0)
            return errorAt(tree.elements[i].place, path,
                           "target: found the spot's own position, expected another point");
        if (light.innerDeg > light.outerDeg)
            return errorAt(tree.elements[i].place, path,
                           "innerDeg: found more than outerDeg, expected at most outerDeg");
        scene.lights.push_back(light);
    }
    return {};
}

Result<void> collectRaw(const Tree& tree, const std::string& name, Scene& scene) {
    SHOAL_TRY(requireTable(tree, name));
    const std::size_t index = scene.tables.size();
    scene.tables.push_back({name, tree.place, {}});
    for (const auto& [key, member] : tree.members) {
        if (member.kind == Tree::Kind::value) {
            scene.tables[index].entries.push_back({key, member.value, member.place});
        } else if (member.kind == Tree::Kind::table) {
            SHOAL_TRY(collectRaw(member, name + "." + key, scene));
        } else {
            for (std::size_t i = 0; i < member.elements.size(); ++i)
                SHOAL_TRY(collectRaw(member.elements[i], name + "." + key + "[" + std::to_string(i) + "]", scene));
        }
    }
    return {};
}

Result<Scene> sceneOfTree(const Tree& root, const std::filesystem::path& file) {
    Scene scene;
    scene.file = file;
    scene.cameraPlace = scene.environmentPlace = {file.string(), 1};
    std::vector<std::string> known = {"camera", "sun", "environment", "light", "model", "shape", "render", "ground"};
    known.insert(known.end(), kRawTables.begin(), kRawTables.end());
    SHOAL_TRY(refuseUnknown(root, "", known));
    if (const Tree* tree = root.find("camera")) SHOAL_TRY(parseCamera(*tree, scene));
    if (const Tree* tree = root.find("sun")) SHOAL_TRY(parseSun(*tree, scene));
    if (const Tree* tree = root.find("environment")) SHOAL_TRY(parseEnvironment(*tree, scene));
    if (const Tree* tree = root.find("light")) SHOAL_TRY(parseLights(*tree, scene));
    if (const Tree* tree = root.find("render")) SHOAL_TRY(bindAll(*tree, "render", scene.render));
    if (const Tree* tree = root.find("ground")) {
        if (tree->kind != Tree::Kind::value || tree->value.kind != FieldValue::Kind::boolean)
            return errorAt(tree->place, "ground",
                           std::string("found ") + describeKind(*tree) + ", expected true or false");
        scene.bareModel = tree->value.boolean;
    }
    if (const Tree* tree = root.find("model")) {
        SHOAL_TRY(requireArray(*tree, "model"));
        for (std::size_t i = 0; i < tree->elements.size(); ++i) {
            const std::string path = "model[" + std::to_string(i) + "]";
            if (tree->elements[i].find("shape")) {  // made on the spot instead of read
                SHOAL_TRY_ASSIGN(ShapeEntry entry, parseModelShape(tree->elements[i], path));
                scene.shapes.push_back(std::move(entry));
                continue;
            }
            SHOAL_TRY_ASSIGN(ModelEntry entry, parseModel(tree->elements[i], path));
            scene.models.push_back(std::move(entry));
        }
    }
    if (const Tree* tree = root.find("shape")) {
        SHOAL_TRY(requireArray(*tree, "shape"));
        for (std::size_t i = 0; i < tree->elements.size(); ++i) {
            SHOAL_TRY_ASSIGN(ShapeEntry entry, parseShape(tree->elements[i], "shape[" + std::to_string(i) + "]"));
            scene.shapes.push_back(std::move(entry));
        }
    }
    for (const std::string& name : kRawTables)
        if (const Tree* tree = root.find(name)) SHOAL_TRY(collectRaw(*tree, name, scene));
    return scene;
}

}  // namespace

Result<Scene> parseScene(std::string_view text, const std::filesystem::path& file,
                         std::span<const Override> overrides) {
    SHOAL_TRY_ASSIGN(Tree root, parseTree(text, file));
    SHOAL_TRY(applyOverrides(root, overrides));
    return sceneOfTree(root, file);
}

Result<Scene> loadScene(const std::filesystem::path& file, std::span<const Override> overrides) {
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, io::readFile(file));
    return parseScene({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, file, overrides);
}

Result<Scene> sceneForModel(const std::filesystem::path& modelFile, std::span<const Override> overrides) {
    Tree root, model, name;
    name.kind = Tree::Kind::value;
    name.value.kind = FieldValue::Kind::text;
    name.value.text = std::filesystem::absolute(modelFile).string();
    model.members.push_back({"file", name});
    name.value.text = "*";  // the first clip there is
    model.members.push_back({"clip", name});
    Tree models;
    models.kind = Tree::Kind::array;
    models.elements.push_back(model);
    root.members.push_back({"model", models});
    Tree ground;
    ground.kind = Tree::Kind::value;
    ground.value.kind = FieldValue::Kind::boolean;
    ground.value.boolean = true;
    root.members.push_back({"ground", ground});
    SHOAL_TRY(applyOverrides(root, overrides));
    return sceneOfTree(root, modelFile);
}

Result<Scene> openScene(const std::filesystem::path& file, std::span<const Override> overrides) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    if (extension == ".toml") return loadScene(file, overrides);
    if (io::isModelFile(file)) return sceneForModel(file, overrides);
    // A missing file is the better answer than its strange name.
    SHOAL_TRY(io::readFile(file));
    return badInput(file.string() + ": found a file called \"" + extension +
                    "\", expected a scene (.toml) or a model "
                    "(.glb, .gltf, .obj, .ply, .stl, .fbx, .dae, ...)");
}

}  // namespace shoal::scene
