// shoal reference
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <optional>

#include <shoal/core/parallel.h>
#include <shoal/core/params.h>
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
    const water::ReferenceScene triangles = pipeline::referenceScene(content, scene.render.time);
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
