// Reads a scene's [water] tables.
#include <shoal/pipeline/water.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <shoal/io/image.h>

namespace shoal::pipeline {

namespace {

constexpr int kMostHeightmaps = 10000;  // pictures of a sequence

Error at(const scene::RawTable& table, const Error& error) {
    return {error.kind, table.place.describe() + ": " + table.name + ": " + error.message};
}

Result<void> bindComponents(const scene::Scene& scene, WaterSpec& spec) {
    const std::string prefix = "water.waves.components[";
    for (const scene::RawTable& table : scene.tables) {
        if (table.name.rfind(prefix, 0) != 0) continue;
        water::WaveComponentParams component;
        SHOAL_TRY(scene::bindTable(table, component));
        spec.setup.components.push_back(component);
    }
    return {};
}

// Heights are metres in EXR and HDR pictures; PNG and JPEG hold 0 to 1 as stored, the middle grey being the level.
Result<Image> readHeightmap(const std::filesystem::path& file) {
    SHOAL_TRY_ASSIGN(const Image picture, io::readImage(file));
    const auto format = io::imageFormatOf(file);
    const bool coded = format == io::ImageFormat::png || format == io::ImageFormat::jpeg;
    Image heights(picture.width, picture.height, 1);
    for (std::size_t i = 0; i < heights.pixels.size(); ++i) {
        const float x = picture.pixels[i * std::size_t(picture.channelCount)];
        const float stored = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
        heights.pixels[i] = coded ? stored - 0.5f : x;
    }
    return heights;
}

// `wave_####.exr` is the sequence of files that are there, from the lowest number up, without a gap.
Result<void> readHeightmaps(const scene::Scene& scene, const scene::RawTable& table, WaterSpec& spec) {
    if (spec.setup.waves.file.empty()) return at(table, badInput("file: found nothing, expected a picture of heights"));
    const std::filesystem::path given(spec.setup.waves.file);
    const std::filesystem::path path = given.is_absolute() ? given : scene.file.parent_path() / given;
    std::string name = path.filename().string();
    const std::size_t first = name.find('#');
    if (first == std::string::npos) {
        auto one = readHeightmap(path);
        if (!one) return at(table, one.error());
        spec.setup.heightmaps.push_back(std::move(*one));
        return {};
    }
    const std::size_t last = std::min(name.find_first_not_of('#', first), name.size());
    const auto numbered = [&](int number) {
        char digits[16];
        std::snprintf(digits, sizeof digits, "%0*d", int(std::min<std::size_t>(last - first, 9)), number);
        return path.parent_path() / (name.substr(0, first) + digits + name.substr(last));
    };
    int number = 0;
    while (number < kMostHeightmaps && !std::filesystem::exists(numbered(number))) ++number;
    for (; int(spec.setup.heightmaps.size()) < kMostHeightmaps && std::filesystem::exists(numbered(number)); ++number) {
        auto one = readHeightmap(numbered(number));
        if (!one) return at(table, one.error());
        spec.setup.heightmaps.push_back(std::move(*one));
    }
    if (spec.setup.heightmaps.empty()) return at(table, badInput("file: no picture of " + path.string() + " is there"));
    return {};
}

// Tables below [water] that nothing here reads.
Result<void> refuseUnknownTables(const scene::Scene& scene) {
    const std::vector<std::string> known = {"water.waves", "water.caustics", "water.shafts", "water.surface",
                                            "water.paper"};
    for (const scene::RawTable& table : scene.tables) {
        if (table.name.rfind("water.", 0) != 0 || table.name.rfind("water.waves.components[", 0) == 0) continue;
        if (std::find(known.begin(), known.end(), table.name) == known.end())
            return badInput(table.place.describe() + ": " + unknownWord("table", table.name, known));
    }
    return {};
}

}  // namespace

Result<std::optional<WaterSpec>> readWater(const scene::Scene& scene) {
    bool any = false;
    for (const scene::RawTable& table : scene.tables)
        any = any || table.name == "water" || table.name.rfind("water.", 0) == 0;
    if (!any) return std::optional<WaterSpec>();
    WaterSpec spec;
    SHOAL_TRY(refuseUnknownTables(scene));
    const auto bind = [&](const char* name, auto&... params) -> Result<void> {
        if (const scene::RawTable* table = scene.table(name)) return scene::bindTable(*table, params...);
        return {};
    };
    SHOAL_TRY(bind("water", spec.setup.body, spec.setup.optics));
    SHOAL_TRY(bind("water.waves", spec.setup.waves));
    SHOAL_TRY(bindComponents(scene, spec));
    SHOAL_TRY(bind("water.caustics", spec.params.photons, spec.params.lightViews, spec.setup.lightViews));
    SHOAL_TRY(bind("water.shafts", spec.params.shafts));
    SHOAL_TRY(bind("water.surface", spec.params.surface));
    SHOAL_TRY(bind("water.paper", spec.paper));
    if (spec.setup.body.areaMin.x >= spec.setup.body.areaMax.x ||
        spec.setup.body.areaMin.y >= spec.setup.body.areaMax.y)
        return badInput(scene.table("water")->place.describe() +
                        ": water.areaMin: found a corner beyond areaMax, expected one before it in x and z");
    if (spec.setup.waves.kind == "heightmap") SHOAL_TRY(readHeightmaps(scene, *scene.table("water.waves"), spec));
    return std::optional<WaterSpec>(std::move(spec));
}

Vec3 skyIrradiance(const scene::Content& content, float intensity) {
    if (!content.environment) return {};
    return light::evaluateIrradiance(light::projectSh(*content.environment), {0, 1, 0}) * intensity;
}

}  // namespace shoal::pipeline
