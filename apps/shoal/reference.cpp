// shoal reference
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <optional>

#include <shoal/core/parallel.h>
#include <shoal/core/params.h>
#include <shoal/core/pose.h>
#include <shoal/io/image.h>
#include <shoal/pipeline/water.h>
#include <shoal/scene/content.h>
#include <shoal/water/reference.h>

#include "verbs.h"

namespace shoal::app {

namespace {

std::atomic<bool> referenceStopAsked = false;

void askReferenceToStop(int) {
    referenceStopAsked = true;
    std::signal(SIGINT, SIG_DFL);  // a second ^C stops at once
}

Result<std::vector<std::string>> referenceAovs(const std::string& words) {
    const std::vector<std::string> known = {"caustics", "inscatter"};
    std::vector<std::string> names;
    for (std::size_t begin = 0; begin <= words.size();) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const std::string name = words.substr(begin, end - begin);
        if (std::find(known.begin(), known.end(), name) == known.end())
            return usageError("--aov: " + unknownWord("AOV", name, known) + ", expected caustics, inscatter or both");
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
        begin = end + 1;
    }
    return names;
}

Result<std::vector<scene::Override>> overridesOf(const ReferenceVerbOptions& o) {
    SHOAL_TRY_ASSIGN(std::vector<scene::Override> overrides, parseOverrides(o.sets));
    if (!o.size.empty()) {
        SHOAL_TRY_ASSIGN(const IVec2 size, parseSize(o.size));
        overrides.push_back({"render.width", std::to_string(size.x)});
        overrides.push_back({"render.height", std::to_string(size.y)});
    }
    if (o.time) {
        char text[40];
        std::snprintf(text, sizeof text, "%.17g", *o.time);
        overrides.push_back({"render.time", text});
    }
    if (o.seed) overrides.push_back({"render.seed", std::to_string(*o.seed)});
    return overrides;
}

bool isHidden(const scene::Instance& instance, const std::string& node) {
    for (const std::string& pattern : instance.hide) {
        const bool open = !pattern.empty() && pattern.back() == '*';
        if (open ? node.compare(0, pattern.size() - 1, pattern, 0, pattern.size() - 1) == 0 : node == pattern)
            return true;
    }
    return false;
}

// What is opaque: the first surface that a picture's AOVs tell of. Cut-outs of masked materials are not cut out.
bool isOpaque(const Model& model, const Primitive& primitive) {
    if (primitive.material < 0) return true;
    const Material& material = model.materials[std::size_t(primitive.material)];
    return material.alphaMode != AlphaMode::blend && material.transmission <= 0;
}

void addTriangles(const scene::Instance& instance, const Model& model, float time, std::vector<Vec3>& triangles) {
    Pose pose;
    poseModel(model, instance.clip, instance.clip < 0 ? 0 : instance.startTime + instance.speed * time, instance.loop,
              pose);
    const Mat4 worldFromModel = scene::transformAt(instance, time);
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        const Node& node = model.nodes[n];
        if (node.mesh < 0 || isHidden(instance, node.name)) continue;
        for (const Primitive& primitive : model.meshes[std::size_t(node.mesh)].primitives) {
            if (!isOpaque(model, primitive)) continue;
            std::vector<Vec3> positions = posedPositions(model, pose, int(n), primitive);
            for (Vec3& p : positions) p = transformPoint(worldFromModel, p);
            for (const std::uint32_t index : primitive.indices) triangles.push_back(positions[index]);
        }
    }
}

Result<Image> drawReference(const std::string& aov, const water::ReferenceScene& triangles, const water::Body& body,
                            const water::BodyLights& lights, const light::View& view, water::ReferenceOptions options,
                            bool quiet) {
    std::optional<ProgressBar> bar;
    if (!quiet) bar.emplace(aov, "parts", stderr);
    options.progress = [&](std::uint64_t done, std::uint64_t total) {
        if (bar) bar->update(done, total);
        return !referenceStopAsked;
    };
    return aov == "caustics" ? water::referenceCaustics(triangles, body, lights, view, options)
                             : water::referenceInscatter(triangles, body, lights, view, options);
}

Result<void> run(const ReferenceVerbOptions& o) {
    const auto start = std::chrono::steady_clock::now();
    const ThreadLimit threads(o.threads);
    if (io::imageFormatOf(std::filesystem::path(o.output)) != io::ImageFormat::exr)
        return usageError("--output: found " + o.output + ", expected a file named .exr");
    SHOAL_TRY_ASSIGN(const std::vector<std::string> aovs, referenceAovs(o.aovs));
    SHOAL_TRY_ASSIGN(const std::vector<scene::Override> overrides, overridesOf(o));
    SHOAL_TRY_ASSIGN(const scene::Scene scene, scene::openScene(o.scene, overrides));
    SHOAL_TRY_ASSIGN(std::optional<pipeline::WaterSpec> spec, pipeline::readWater(scene));
    if (!spec)
        return badInput(o.scene + ": found no [water], expected a scene with water: nothing else has a reference yet");
    SHOAL_TRY_ASSIGN(water::WaveField waves, water::WaveField::create(spec->setup.waves, spec->setup.components,
                                                                      std::move(spec->setup.heightmaps)));
    waves.setTime(scene.render.time);
    water::Body body;
    body.params = spec->setup.body;
    SHOAL_TRY_ASSIGN(body.optics, water::resolveOptics(spec->setup.optics));
    body.waves = &waves;
    SHOAL_TRY_ASSIGN(const scene::Content content,
                     scene::loadContent(scene, o.quiet ? nullSink() : stderrSink(LogLevel::warning)));
    water::BodyLights lights;
    if (content.sun) lights.sun = &*content.sun;
    lights.punctual = content.lights;
    water::ReferenceScene triangles;
    for (const scene::Instance& instance : content.instances)
        if (instance.visible)
            addTriangles(instance, content.models[std::size_t(instance.model)], scene.render.time, triangles.triangles);
    const float aspect = float(scene.render.width) / float(scene.render.height);
    const light::View view = light::makeView(scene::cameraAt(scene, content, scene.render.time, aspect),
                                             scene.render.width, scene.render.height);

    std::signal(SIGINT, askReferenceToStop);
    water::ReferenceOptions options;
    options.rays = o.rays;
    options.subPixels = o.subPixels;
    options.steps = o.steps;
    options.seed = scene.render.seed;
    std::vector<Layer> layers;
    for (const std::string& aov : aovs) {
        SHOAL_TRY_ASSIGN(Image image, drawReference(aov, triangles, body, lights, view, options, o.quiet));
        layers.push_back({aov, std::move(image)});
    }
    io::ExrOptions exr;
    exr.halfColor = false;
    SHOAL_TRY(io::writeExr(o.output, layers, exr));
    if (o.quiet) return {};
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    std::printf("%s: %d x %d, %zu triangles, %lld rays a light, %.1f s\n", o.output.c_str(), view.width, view.height,
                triangles.triangles.size() / 3, static_cast<long long>(o.rays), seconds);
    return {};
}

}  // namespace

int reference(const ReferenceVerbOptions& options) {
    const Result<void> done = run(options);
    return done ? kDone : report(done.error());
}

}  // namespace shoal::app
