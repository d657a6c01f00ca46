#include "bench/method_pair.h"

#include <cmath>
#include <cstdio>

#include <epoxy/gl.h>

#include <shoal/scene/content.h>

namespace shoal::bench {

namespace {

bool begins(const std::string& text, const char* with) { return text.rfind(with, 0) == 0; }

MethodTimes timesOf(const std::vector<gl::PassTime>& passes) {
    MethodTimes times;
    for (const gl::PassTime& pass : passes) {
        const std::string& name = pass.name;
        double* part = nullptr;
        if (name == "light depth")
            times.lightDepth += pass.timeMs;
        else if (name == "mirrored views")
            times.mirrored += pass.timeMs;
        else if (name == "paper compose" || name == "caustic lookup" || name == "shaft upsample")
            part = &times.toPixels;
        else if (begins(name, "caustic ") || begins(name, "paper caustics") || name == "paper water mask")
            part = &times.caustics;
        else if (begins(name, "shaft ") || begins(name, "paper god rays"))
            part = &times.godrays;
        if (!part) continue;
        *part += pass.timeMs;
        times.passes[name] += pass.timeMs;
    }
    return times;
}

double median(const std::vector<MethodTimes>& times, double MethodTimes::*part) {
    std::vector<double> values;
    for (const MethodTimes& one : times) values.push_back(one.*part);
    return spreadOf(values).median;
}

}  // namespace

MethodTimes medianOf(const std::vector<MethodTimes>& times) {
    MethodTimes result;
    for (double MethodTimes::*part : {&MethodTimes::lightDepth, &MethodTimes::mirrored, &MethodTimes::caustics,
                                      &MethodTimes::godrays, &MethodTimes::toPixels})
        result.*part = median(times, part);
    std::map<std::string, std::vector<double>> byName;
    for (const MethodTimes& one : times)
        for (const auto& [name, timeMs] : one.passes) byName[name].push_back(timeMs);
    for (const auto& [name, values] : byName) result.passes[name] = spreadOf(values).median;
    return result;
}

std::string passText(const MethodTimes& times) {
    std::string text;
    for (const auto& [name, timeMs] : times.passes) {
        char one[80];
        std::snprintf(one, sizeof one, "%s%s %.1f", text.empty() ? "" : ", ", name.c_str(), timeMs);
        text += one;
    }
    return text;
}

Result<MethodPair> MethodPair::create(const Settings& settings) {
    MethodPair pair;
    gl::DeviceOptions options;
    options.device = settings.device;
    options.log = stderrSink();
    SHOAL_TRY_ASSIGN(pair.device_, gl::Device::create(options));
    for (auto& pipeline : pair.pipelines_) {
        SHOAL_TRY_ASSIGN(pipeline, pipeline::Pipeline::create(*pair.device_));
    }
    return pair;
}

Overrides shoalOverrides(int photons, int godrayPhotons) {
    return {"water.caustics.photons=" + std::to_string(photons),
            "water.shafts.photons=" + std::to_string(godrayPhotons)};
}

Overrides paperOverrides(int photons, int godrayPhotons) {
    const auto side = [](int count) { return std::to_string(std::lround(std::sqrt(count / 4.0))); };
    return {"water.caustics.method=paper", "water.paper.causticGrid=" + side(photons),
            "water.paper.godrayGrid=" + side(godrayPhotons)};
}

Result<void> MethodPair::load(const std::string& scene, const Overrides& shoal, const Overrides& paper) {
    SHOAL_TRY(loadOne(Method::shoal, scene, shoal));
    return loadOne(Method::paper, scene, paper);
}

Result<void> MethodPair::loadOne(Method method, const std::string& scene, const Overrides& overrides) {
    SHOAL_TRY_ASSIGN(const std::string folder, checksFolder());
    std::vector<scene::Override> parsed;
    for (const std::string& one : overrides) {
        SHOAL_TRY_ASSIGN(scene::Override override, scene::parseOverride(one));
        parsed.push_back(std::move(override));
    }
    SHOAL_TRY(pipeline(method).open(folder + "/" + scene + ".toml", parsed));
    pipeline::FrameRequest& request = requests_[index(method)];
    request = pipeline::requestFor(pipeline(method).scene().render);
    request.antialiasing = "none";
    if (sizes_[index(method)].x > 0) setSize(method, sizes_[index(method)].x, sizes_[index(method)].y);
    return {};
}

void MethodPair::setSize(int width, int height) {
    for (const Method method : {Method::shoal, Method::paper}) setSize(method, width, height);
}

void MethodPair::setSize(Method method, int width, int height) {
    pipeline::FrameRequest& request = requests_[index(method)];
    request.width = width, request.height = height;
    sizes_[index(method)] = {width, height};
}

pipeline::FrameRequest MethodPair::request(Method method, int frame) {
    pipeline::FrameRequest request = requests_[index(method)];
    const pipeline::Pipeline& p = pipeline(method);
    light::Camera camera =
        scene::cameraAt(p.scene(), p.content(), request.time, float(request.width) / float(request.height));
    camera.worldFromView(0, 3) += 0.011f * float(frame);
    request.camera = camera;
    request.time += float(frame) / 30;
    request.frameIndex = std::uint32_t(frame);
    return request;
}

Result<MethodTimes> MethodPair::timed(Method method, int frame) {
    pipeline::Pipeline& p = pipeline(method);
    p.setTiming(true);
    const auto drawn = p.render(request(method, frame));
    p.setTiming(false);
    SHOAL_TRY(drawn);
    if (!device_->software()) {  // timer queries come in some frames later
        glFinish();
        for (int i = 0; i < 6 && p.stats().passes.empty(); ++i) SHOAL_TRY(p.render(request(method, frame)));
    }
    return timesOf(p.stats().passes);
}

Result<double> MethodPair::wholeFrame(Method method, int frame) {
    Result<void> drawn;
    const double seconds = bench::timed([&] {
        drawn = pipeline(method).render(request(method, frame));
        if (!drawn) return;
        const auto picture = pipeline(method).readDisplay();
        if (!picture) drawn = picture.error();
    });
    SHOAL_TRY(drawn);
    return 1000 * seconds;
}

Result<MethodPair::Both> MethodPair::inTurns(int repetitions) {
    std::vector<MethodTimes> shoal, paper;
    constexpr int kWarmUp = 2;
    for (int i = 0; i < kWarmUp + repetitions; ++i) {
        SHOAL_TRY_ASSIGN(MethodTimes ours, timed(Method::shoal, i));
        SHOAL_TRY_ASSIGN(MethodTimes theirs, timed(Method::paper, i));
        if (i < kWarmUp) continue;
        shoal.push_back(std::move(ours));
        paper.push_back(std::move(theirs));
    }
    return Both{medianOf(shoal), medianOf(paper)};
}

Result<Image> MethodPair::draw(Method method, const std::string& aov) {
    pipeline::Pipeline& p = pipeline(method);
    p.setAovs(std::vector<std::string>{aov});
    const auto drawn = p.render(requests_[index(method)]);
    p.setAovs({});
    SHOAL_TRY(drawn);
    p.setAovs(std::vector<std::string>{aov});
    auto layers = p.readAovs();
    p.setAovs({});
    if (!layers) return layers.error();
    return std::move((*layers)[0].image);
}

}  // namespace shoal::bench
