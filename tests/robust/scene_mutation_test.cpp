// 10,000 mutated scene files: none crashes, hangs or is taken for good with a value out of range.
#include <gtest/gtest.h>

#include <string>

#include <shoal/core/random.h>
#include <shoal/scene/content.h>
#include <shoal/scene/scene.h>

namespace shoal::scene {
namespace {

constexpr std::string_view kSeedScene = R"([camera]
position = [6, 2.5, 9]
target = [0, -1, 0]
fovDeg = 60
path = [ { time = 0, position = [0, 1, 5], target = [0, 0, 0], fovDeg = 40 }, { time = 2.5, position = [3, 1, 5] } ]
[sun]
elevationDeg = 40
azimuthDeg = 120
irradiance = [9.2, 9.2, 9.2]
[environment]
kind = "clearSky"
turbidity = 2.5
[[model]]
file = "nothing.glb"
clip = "Walk"
scale = [1, 2, 1]
hide = ["a", "b*"]
copies = { countX = 3, countZ = 4, jitter = 0.5 }
walk = { points = [[0, 0, 0], [5, 0, 1]], speed = 1.2, loop = true }
[[shape]]
kind = "plane"
position = [0, 0, 0]
[[light]]
kind = "spot"
position = [0, 4, 0]
target = [0, 0, 1]
intensity = [10, 9, 8]
[render]
width = 640
height = 360
samples = 4
[post]
toneCurve = "agx"
[water]
waves = { kind = "sum", components = [ { amplitude = 0.1 }, { amplitude = 0.2 } ] }
)";

std::string mutated(std::uint32_t seed) {
    std::string text(kSeedScene);
    const int changes = 1 + int(randomBits(seed, 0) % 8);
    for (int i = 0; i < changes; ++i) {
        const auto random = [&](std::uint32_t which) { return randomBits(seed, std::uint32_t(i) + 1, which); };
        if (text.empty()) text = "x";
        const std::size_t at = random(0) % text.size();
        static const char* const kTokens[] = {"nan",      "-inf", "1e999",      "[[", "]]", "{",
                                              "}",        "\"",   "\n",         "=",  "-1", "99999999999999999999",
                                              "\xff\xfe", "'''",  "[camera]\n", "0x", "."};
        switch (random(1) % 6) {
            case 0:
                text[at] = char(random(2) & 0xff);
                break;
            case 1:
                text.erase(at, 1 + random(2) % 20);
                break;
            case 2:
                text.insert(at, kTokens[random(2) % std::size(kTokens)]);
                break;
            case 3:
                text.insert(at, text.substr(random(2) % text.size(), random(3) % 60));
                break;
            case 4:
                text.resize(at);
                break;
            default: {
                const std::size_t digit = text.find_first_of("0123456789", at);
                if (digit != std::string::npos) text[digit] = char('0' + random(2) % 10);
            }
        }
    }
    return text;
}

TEST(MutatedScenes, NeverCrash) {
    int good = 0, bad = 0;
    for (std::uint32_t seed = 0; seed < 10000; ++seed) {
        auto scene = parseScene(mutated(seed), "mutated.toml");
        if (!scene) {
            ++bad;
            EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << seed << ": " << scene.error().message;
            EXPECT_EQ(scene.error().message.rfind("mutated.toml", 0), 0u) << seed << ": " << scene.error().message;
            continue;
        }
        ++good;
        EXPECT_TRUE(validate(scene->camera)) << seed;
        EXPECT_TRUE(validate(scene->render)) << seed;
        const light::Camera camera = cameraAt(*scene, Content{}, 1.0f, 1.5f);
        for (const float m : camera.worldFromView.m) EXPECT_TRUE(std::isfinite(m)) << seed;
    }
    // Both happen, or the mutations test nothing.
    EXPECT_GT(good, 100);
    EXPECT_GT(bad, 1000);
}

TEST(MutatedScenes, DeepNestingIsRefused) {
    std::string deep = "water = ";
    for (int i = 0; i < 100000; ++i) deep += "[";
    EXPECT_FALSE(parseScene(deep, "deep.toml"));
    std::string dotted = "water";
    for (int i = 0; i < 20000; ++i) dotted += ".a";
    EXPECT_FALSE(parseScene(dotted + " = 1", "dotted.toml"));
    EXPECT_FALSE(parseScene("[" + dotted + "]", "dotted.toml"));
    EXPECT_FALSE(parseScene("water = { a" + dotted.substr(5) + " = 1 }", "dotted.toml"));
    std::string quoted = "water";
    for (int i = 0; i < 1000000; ++i) quoted += ". \"a\" ";
    EXPECT_FALSE(parseScene(quoted + " = 1", "quoted.toml"));
    EXPECT_TRUE(parseScene("# ................................................................................\n" +
                               std::string("[camera]\nposition = [1.0, 2.0, 3.0]\n"),
                           "prose.toml"));
}

}  // namespace
}  // namespace shoal::scene
