#include "bench/water_stage.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <shoal/scene/content.h>
#include <shoal/scene/scene.h>

namespace shoal::bench {

Result<std::string> checksFolder() {
    if (const char* given = std::getenv("SHOAL_CHECKS")) return std::string(given);
    std::error_code error;
    const std::filesystem::path binary = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path folder = binary.parent_path().parent_path() / "share" / "shoal" / "checks";
    if (!error && std::filesystem::is_directory(folder, error)) return folder.string();
    return badInput(folder.string() + ": no such folder, expected the check scenes there (or name it in SHOAL_CHECKS)");
}

Result<WaterStage> WaterStage::create(const Settings& settings) {
    WaterStage stage;
    SHOAL_TRY_ASSIGN(stage.stage_, makeStage(settings.device));
    return stage;
}

Result<void> WaterStage::load(const std::string& scene, const Overrides& overrides,
                              const std::function<void(scene::Content&)>& change) {
    SHOAL_TRY_ASSIGN(const std::string folder, checksFolder());
    std::vector<scene::Override> parsed;
    for (const std::string& one : overrides) {
        SHOAL_TRY_ASSIGN(scene::Override override, scene::parseOverride(one));
        parsed.push_back(std::move(override));
    }
    SHOAL_TRY_ASSIGN(const scene::Scene read, scene::loadScene(folder + "/" + scene + ".toml", parsed));
    SHOAL_TRY_ASSIGN(scene::Content content, scene::loadContent(read));
    if (change) change(content);
    request_ = pipeline::requestFor(read.render);
    return stage_.pipeline->setScene(read, std::move(content));
}

Result<Image> WaterStage::draw(const std::string& aov) {
    stage_.pipeline->setAovs(std::vector<std::string>{aov});
    SHOAL_TRY(stage_.pipeline->render(request_));
    SHOAL_TRY_ASSIGN(std::vector<Layer> layers, stage_.pipeline->readAovs());
    return std::move(layers[0].image);
}

Result<Image> WaterStage::draw(const std::string& aov, const light::Camera& camera) {
    request_.camera = camera;
    auto image = draw(aov);
    request_.camera.reset();
    return image;
}

Result<water::WaveField> wavesOf(const scene::Scene& scene) {
    SHOAL_TRY_ASSIGN(std::optional<pipeline::WaterSpec> spec, pipeline::readWater(scene));
    if (!spec) return badInput(scene.file.string() + ": found no [water], expected a scene with water");
    SHOAL_TRY_ASSIGN(water::WaveField waves, water::WaveField::create(spec->setup.waves, spec->setup.components,
                                                                      std::move(spec->setup.heightmaps)));
    waves.setTime(double(scene.render.time));
    return waves;
}

std::string words(double x, double y, double z) {
    char text[96];
    std::snprintf(text, sizeof text, "[%.9g, %.9g, %.9g]", x, y, z);
    return text;
}

PictureError errorOf(const Image& picture, const Image& exact, bool matched) {
    double mean = 0, exactMean = 0;
    const double count = double(exact.width) * double(exact.height);
    for (int y = 0; y < exact.height; ++y)
        for (int x = 0; x < exact.width; ++x)
            mean += double(*picture.at(x, y)) / count, exactMean += double(*exact.at(x, y)) / count;
    const double scale = matched ? exactMean / mean : 1;
    double squares = 0, absolute = 0;
    for (int y = 0; y < exact.height; ++y)
        for (int x = 0; x < exact.width; ++x) {
            const double d = double(*picture.at(x, y)) * scale - double(*exact.at(x, y));
            squares += d * d / count, absolute += std::abs(d) / count;
        }
    return {mean, std::sqrt(squares) / exactMean, absolute / exactMean};
}

Image exactPatch(const water::WaveField& waves, double discHalfAngle) {
    const water::FloorBins bins{{-2, -2}, {2, 2}, 512, 512, true};
    return water::traceFloor(waves, water::kWaterIndex, 0, {0, 1, 0}, discHalfAngle, 2, bins, 12288, 1).irradiance;
}

double columnMean(const Image& image, int first, int end) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = first; x < end; ++x) sum += double(*image.at(x, y));
    return sum / (double(image.height) * double(end - first));
}

}  // namespace shoal::bench
