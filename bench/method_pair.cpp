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
    for (double MethodTimes::*part :
         {&MethodTimes::lightDepth, &MethodTimes::caustics, &MethodTimes::godrays, &MethodTimes::toPixels})
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

Result<void> MethodPair::load(const std::string& scene, int photons, int godrayPhotons, const Overrides& both,
                              const Overrides& paperOnly) {
    SHOAL_TRY_ASSIGN(const std::string folder, checksFolder());
    const auto side = [](int count) { return std::to_string(std::lround(std::sqrt(count / 4.0))); };
    for (const Method method : {Method::shoal, Method::paper}) {
        Overrides overrides = both;
        if (method == Method::paper) {
            overrides.push_back("water.caustics.method=paper");
            overrides.push_back("water.paper.causticGrid=" + side(photons));
            overrides.push_back("water.paper.godrayGrid=" + side(godrayPhotons));
            overrides.insert(overrides.end(), paperOnly.begin(), paperOnly.end());
        } else {
            overrides.push_back("water.caustics.photons=" + std::to_string(photons));
            overrides.push_back("water.shafts.photons=" + std::to_string(godrayPhotons));
        }
        std::vector<scene::Override> parsed;
        for (const std::string& one : overrides) {
            SHOAL_TRY_ASSIGN(scene::Override override, scene::parseOverride(one));
            parsed.push_back(std::move(override));
        }
        SHOAL_TRY(pipeline(method).open(folder + "/" + scene + ".toml", parsed));
    }
    request_ = pipeline::requestFor(pipeline(Method::shoal).scene().render);
    request_.antialiasing = "none";
    return {};
}

void MethodPair::setSize(int width, int height) { request_.width = width, request_.height = height; }

pipeline::FrameRequest MethodPair::request(int index) {
    pipeline::FrameRequest request = request_;
    const pipeline::Pipeline& any = pipeline(Method::shoal);
    light::Camera camera =
        scene::cameraAt(any.scene(), any.content(), request.time, float(request.width) / float(request.height));
    camera.worldFromView(0, 3) += 0.011f * float(index);
    request.camera = camera;
    request.time += float(index) / 30;
    request.frameIndex = std::uint32_t(index);
    return request;
}

Result<MethodTimes> MethodPair::timed(Method method, int index) {
    pipeline::Pipeline& p = pipeline(method);
    p.setTiming(true);
    const auto drawn = p.render(request(index));
    p.setTiming(false);
    SHOAL_TRY(drawn);
    if (!device_->software()) {  // timer queries come in some frames later
        glFinish();
        for (int i = 0; i < 6 && p.stats().passes.empty(); ++i) SHOAL_TRY(p.render(request(index)));
    }
    return timesOf(p.stats().passes);
}

Result<double> MethodPair::wholeFrame(Method method, int index) {
    Result<void> drawn;
    const double seconds = bench::timed([&] {
        drawn = pipeline(method).render(request(index));
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
    const auto drawn = p.render(request_);
    p.setAovs({});
    SHOAL_TRY(drawn);
    p.setAovs(std::vector<std::string>{aov});
    auto layers = p.readAovs();
    p.setAovs({});
    if (!layers) return layers.error();
    return std::move((*layers)[0].image);
}

}  // namespace shoal::bench
