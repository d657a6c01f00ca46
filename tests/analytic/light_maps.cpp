// Sun extraction on real maps, where somebody looked at what is in them.
#include <gtest/gtest.h>
#include <shoal/io/image.h>
#include <shoal/light/environment.h>

#include <filesystem>

namespace shoal {
namespace {

light::Environment readMap(const char* name) {
    light::Environment environment;
    const std::filesystem::path path = std::filesystem::path(SHOAL_DATA_DIR) / "environments" / name;
    if (!std::filesystem::exists(path)) return environment;
    Result<Image> image = io::readImage(path);
    EXPECT_TRUE(image.has_value()) << (image ? "" : image.error().message);
    if (image) environment.radiance = std::move(*image);
    return environment;
}

TEST(LightMaps, SunsAreFoundWhereTheyAre) {
    // Texel of the disc's middle in the picture.
    const struct {
        const char* name;
        int x, y;
    } rows[] = {{"venice_sunset_1k.hdr", 614, 246}, {"blender_sunset.exr", 614, 246}, {"blender_forest.exr", 613, 200}};
    for (const auto& row : rows) {
        light::Environment map = readMap(row.name);
        if (map.radiance.empty()) GTEST_SKIP() << "no ../shared/data/environments/" << row.name;
        const Vec3 expected = light::directionOfTexel(map, row.x, row.y);
        const Vec3 facing = light::evaluateIrradiance(light::projectSh(map), expected);
        const std::optional<light::Sun> sun = light::extractSun(map);
        ASSERT_TRUE(sun.has_value()) << row.name;
        EXPECT_GT(dot(sun->toSun, expected), std::cos(radians(1.0f))) << row.name;
        // SH of order 2 keeps 17/16 of a small light facing it.
        const Vec3 left = light::evaluateIrradiance(light::projectSh(map), expected);
        EXPECT_NEAR((facing.x - left.x) / (sun->irradiance.x * 17 / 16), 1, 0.02) << row.name;
    }
}

TEST(LightMaps, NoSunIsMadeUp) {
    // Overcast; studio lamps; night with street lamps; a sun behind foliage; a dawn whose sun is behind haze 20 degrees
    // wide.
    for (const char* name : {"potsdamer_platz_1k.hdr", "studio_small_03_1k.hdr", "dikhololo_night_1k.hdr",
                             "blender_courtyard.exr", "kiara_1_dawn_1k.hdr"}) {
        light::Environment map = readMap(name);
        if (map.radiance.empty()) GTEST_SKIP() << "no ../shared/data/environments/" << name;
        EXPECT_FALSE(light::extractSun(map).has_value()) << name;
    }
}

}  // namespace
}  // namespace shoal
