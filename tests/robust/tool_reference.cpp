// `shoal reference`: the answer it writes, and how it refuses.
#include <cmath>

#include <gtest/gtest.h>

#include <shoal/io/image.h>
#include <shoal/water/reference.h>

#include "support/tool_contract.h"

namespace shoal::test {
namespace {

// A level floor 3 m below level water, seen from straight above: right is +x, down is +z.
constexpr const char* kScene = R"(
[camera]
position = [0, 10, 0]
target = [0, 0, 0]
up = [0, 0, -1]
projection = "orthographic"
heightM = 2
[sun]
toSun = [-0.5, 0.8660254, 0]
irradiance = [10, 5, 2]
discDeg = 0
[environment]
kind = "none"
[render]
width = 8
height = 8
[[shape]]
kind = "plane"
width = 40
depth = 40
position = [0, -3, 0]
[water]
absorption = [0.1, 0.2, 0]
scattering = [0, 0, 0.05]
forwardFraction = 0
surfaceVisible = false
waves = { kind = "flat" }
)";

class ToolReference : public testing::Test {
protected:
    void SetUp() override { writeText(folder_ / "scene.toml", kScene); }
    ProgramRun reference(std::vector<std::string> words) {
        words.insert(words.begin(), "reference");
        return runTool(words, {.folder = folder_.path(), .environment = {}});
    }
    TestFolder folder_;
};

TEST_F(ToolReference, WritesTheAnswer) {
    const ProgramRun run = reference({"scene.toml", "-o", "out.exr", "--rays", "2000000", "--steps", "256"});
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    const auto layers = io::readLayers(folder_ / "out.exr");
    ASSERT_TRUE(layers) << layers.error().message;
    ASSERT_EQ(layers->size(), 2u);
    EXPECT_EQ((*layers)[0].name, "caustics");
    EXPECT_EQ((*layers)[1].name, "inscatter");
    const double irradiance[3] = {10, 5, 2}, attenuation[3] = {.1, .2, .05}, scattering[3] = {0, 0, .05};
    for (int channel = 0; channel < 3; ++channel) {
        double caustics = 0, inscatter = 0;
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                caustics += (*layers)[0].image.at(x, y)[channel] / 64;
                inscatter += (*layers)[1].image.at(x, y)[channel] / 64;
            }
        const double expected = irradiance[channel] *
                                water::analytic::flatIrradiance(water::kWaterIndex, attenuation[channel], kPiD / 6, 3);
        EXPECT_NEAR(caustics, expected, 1e-3 * expected) << channel;
        // From the level down: the eye is above the water.
        const water::analytic::ShaftMedium medium{attenuation[channel], scattering[channel], .924};
        const double shaft = irradiance[channel] * water::analytic::flatShaft(medium, kPiD / 6, {0, 0, 0, -1, 0, 3});
        EXPECT_NEAR(inscatter, shaft, 3e-3 * shaft) << channel;
    }
}

TEST_F(ToolReference, SameFileTwice) {
    for (const char* name : {"a.exr", "b.exr"}) {
        const ProgramRun run =
            reference({"scene.toml", "-o", name, "--rays", "100000", "--steps", "16", "--quiet", "--set",
                       "water.waves.kind=turbulent", "--threads", name[0] == 'a' ? "1" : "0"});
        ASSERT_EQ(run.exitCode, 0) << run.describe();
        EXPECT_EQ(run.out + run.err, "");
    }
    const auto a = io::readLayers(folder_ / "a.exr"), b = io::readLayers(folder_ / "b.exr");
    ASSERT_TRUE(a && b);
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ((*a)[i].image.pixels, (*b)[i].image.pixels);
}

TEST_F(ToolReference, Refuses) {
    expectRefusal(reference({"scene.toml", "-o", "out.png"}), 2, {"out.png", ".exr"});
    expectRefusal(reference({"scene.toml", "-o", "out.exr", "--aov", "caustic"}), 2, {"did you mean \"caustics\""});
    expectRefusal(reference({"scene.toml", "-o", "out.exr", "--rays", "0"}), 2, {"--rays"});
    expectRefusal(reference({"scene.toml", "-o", "out.exr", "--ray", "5"}), 2, {"did you mean \"--rays\""});
    expectRefusal(reference({"absent.toml", "-o", "out.exr"}), 3, {"absent.toml"});
    expectRefusal(reference({"scene.toml", "-o", "out.exr", "--set", "water.waves.kind=wavy"}), 2, {"kind"});
    writeText(folder_ / "dry.toml", "[[shape]]\nkind = \"plane\"\n");
    expectRefusal(reference({"dry.toml", "-o", "out.exr"}), 3, {"dry.toml", "[water]"});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.exr"));
}

}  // namespace
}  // namespace shoal::test
