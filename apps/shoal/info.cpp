// shoal info
#include <cstdio>
#include <filesystem>
#include <set>

#include <shoal/core/pose.h>
#include <shoal/gl/device.h>
#include <shoal/io/asset.h>
#include <shoal/io/file.h>
#include <shoal/io/image.h>
#include <shoal/io/model.h>
#include <shoal/io/poses.h>
#include <shoal/scene/scene.h>

#include "verbs.h"

namespace shoal::app {

namespace {

template <class Named>
std::string namesOf(const std::vector<Named>& things, std::size_t most = 12) {
    std::string names;
    for (std::size_t i = 0; i < things.size() && i < most; ++i) names += (i ? ", " : "") + things[i].name;
    if (things.size() > most) names += ", ... (" + std::to_string(things.size()) + " in all)";
    return names;
}

Result<void> modelInfo(const std::string& file) {
    SHOAL_TRY_ASSIGN(const Model model, io::readModel(file));
    const ModelCounts c = count(model);
    Pose pose;
    poseModel(model, -1, 0, false, pose);
    const Vec3 size = posedBounds(model, pose).size();
    std::printf("%s: model\n", file.c_str());
    std::printf("  triangles   %zu drawn, %zu unique\n", c.drawnTriangles, c.uniqueTriangles);
    std::printf("  vertices    %zu\n  nodes       %zu\n  meshes      %zu\n", c.vertices, model.nodes.size(),
                model.meshes.size());
    std::printf("  materials   %zu: %s\n  textures    %zu\n", model.materials.size(), namesOf(model.materials).c_str(),
                model.images.size());
    std::printf("  joints      %zu\n  clips       %zu%s%s\n", c.joints, model.clips.size(),
                model.clips.empty() ? "" : ": ", namesOf(model.clips, 100).c_str());
    std::printf("  morphs      %zu\n  cameras     %zu\n  lights      %zu\n", c.morphTargetSlots, model.cameras.size(),
                model.lights.size());
    std::printf("  size        %.3f x %.3f x %.3f m (as stored)\n", size.x, size.y, size.z);
    return {};
}

Result<void> pictureInfo(const std::string& file) {
    SHOAL_TRY_ASSIGN(const io::ImageInfo picture, io::readImageInfo(file));
    std::printf("%s: picture, %d x %d, %d channels, %s\n", file.c_str(), picture.width, picture.height,
                picture.channelCount, picture.details.c_str());
    if (picture.format != io::ImageFormat::exr) return {};
    SHOAL_TRY_ASSIGN(const std::vector<Layer> layers, io::readLayers(file));
    for (const Layer& layer : layers) {
        std::string channels;
        for (const std::string& name : layer.image.channelNames) channels += " " + name;
        std::printf("  layer %-12s%s\n", layer.name.empty() ? "(main)" : layer.name.c_str(), channels.c_str());
    }
    return {};
}

Result<void> sceneInfo(const std::string& file) {
    SHOAL_TRY_ASSIGN(const scene::Scene scene, scene::loadScene(file));
    constexpr const char* kCameraKinds[] = {
        "fixed", "orbit", "path", "a model's own", "poses from a file", "fitted to the scene"};
    std::printf("%s: scene\n  camera      %s\n", file.c_str(), kCameraKinds[int(scene.cameraKind)]);
    std::printf("  environment %s%s%s\n", scene.environment.kind.c_str(), scene.environment.file.empty() ? "" : " ",
                scene.environment.file.c_str());
    std::printf("  lights      %zu\n", scene.lights.size());
    for (const scene::ModelEntry& model : scene.models)
        std::printf("  model       %s%s%s, %d\n", model.model.file.c_str(), model.model.clip.empty() ? "" : " playing ",
                    model.model.clip.c_str(), model.copies.countX * model.copies.countZ);
    for (const scene::ShapeEntry& shape : scene.shapes) std::printf("  shape       %s\n", shape.kind.c_str());
    std::printf("  picture     %d x %d, %s, %g s at %g fps\n", scene.render.width, scene.render.height,
                scene.render.antialiasing.c_str(), scene.render.duration, scene.render.fps);
    return {};
}

Result<void> assetInfo(const std::string& file) {
    SHOAL_TRY_ASSIGN(const Asset asset, io::readAsset(file));
    std::printf("%s: baked %s, version %u, hash %016llx\n", file.c_str(), asset.kind.c_str(), asset.formatVersion,
                static_cast<unsigned long long>(asset.contentHash()));
    for (const auto& [key, value] : asset.parameters) std::printf("  %s = %s\n", key.c_str(), value.c_str());
    for (const auto& [name, array] : asset.arrays)
        std::printf("  %s: %s, %zu bytes\n", name.c_str(), array.type.c_str(), array.bytes.size());
    return {};
}

Result<void> posesInfo(const std::string& file) {
    SHOAL_TRY_ASSIGN(const auto poses, io::readPoses(file));
    std::printf("%s: %zu camera poses from %g s to %g s\n", file.c_str(), poses.size(), poses.front().time,
                poses.back().time);
    return {};
}

Result<void> fileInfo(const std::string& file) {
    const std::string extension = io::lowerExtension(file);
    if (extension == ".toml") return sceneInfo(file);
    if (extension == ".csv") return posesInfo(file);
    if (extension == ".shoal") return assetInfo(file);
    if (io::isModelFile(file)) return modelInfo(file);
    return pictureInfo(file);
}

int listDevices() {
    bool usable = false;
    for (const gl::DeviceInfo& device : gl::listDevices()) {
        if (device.problem.empty()) {
            std::printf("%-6s %s, OpenGL %s, %s\n", device.name.c_str(), device.renderer.c_str(),
                        device.version.c_str(), device.software ? "software (CPU)" : "hardware");
            usable = true;
        } else {
            std::printf("%-6s not usable: %s\n", device.name.c_str(), device.problem.c_str());
        }
    }
    if (usable) return kDone;
    return report(
        noDevice("nothing here can draw: expected an EGL device with OpenGL 4.5 (Debian: libegl1 libgl1-mesa-dri)"));
}

}  // namespace

int info(const InfoOptions& options) {
    if (options.devices) return listDevices();
    if (options.keys) return printKeys();
    if (options.files.empty())
        return report(usageError("info: found no file, expected at least one (or --devices, --keys)"));
    for (const std::string& file : options.files)
        if (const Result<void> told = fileInfo(file); !told) return report(told.error());
    return kDone;
}

}  // namespace shoal::app
