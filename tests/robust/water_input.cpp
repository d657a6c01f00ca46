// Water that cannot be is refused in one line; water that is merely odd gives a picture without a single NaN.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <ostream>

#include <shoal/io/image.h>

#include "support/tool_contract.h"

namespace shoal::test {
namespace {

// A floor, a ball and a table of water whose lines a case replaces.
std::string sceneWith(const std::string& water, const std::string& rest) {
    return "[render]\nwidth = 96\nheight = 64\nsamples = 1\n[camera]\nposition = [2, -0.6, 3]\ntarget = [0, -1.4, 0]\n"
           "[[shape]]\nkind = \"plane\"\nwidth = 20\ndepth = 20\nposition = [0, -2, 0]\n"
           "[[shape]]\nkind = \"sphere\"\nposition = [0, -1.6, 0]\n" +
           rest + "[water]\n" + water;
}

struct Case {
    const char* name;
    std::string water, rest;
    std::vector<std::string> mentions;  // of a refusal; empty: a picture is expected
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

const std::string kWaves = "waves = { kind = \"turbulent\", amplitude = 0.05 }\n";

std::vector<Case> refused() {
    return {
        {"TooSteep", "waves = { kind = \"circular\", amplitude = 50, wavelength = 0.5 }\n", "", {"amplitude"}},
        {"SumTooSteep",
         "waves = { kind = \"sum\", components = [ { amplitude = 9, wavelength = 1 } ] }\n",
         "",
         {"slopes"}},
        {"NegativeAmplitude", "waves = { kind = \"turbulent\", amplitude = -1 }\n", "", {"amplitude", "-1"}},
        {"NegativeAbsorption", kWaves + "absorption = [0.1, -0.5, 0.1]\n", "", {"absorption", "-0.5"}},
        {"NegativeScattering", kWaves + "scattering = [-0.2, 0.1, 0.1]\n", "", {"scattering"}},
        {"UnknownMedium", kWaves + "medium = \"jerlov-1B\"\n", "", {"medium", "jerlov-1B", "jerlov-IB"}},
        {"UnknownKey", kWaves + "levle = 1\n", "", {"levle", "level"}},
        {"UnknownWave", "waves = { kind = \"sinus\" }\n", "", {"sinus"}},
        {"UnknownTable", kWaves + "[water.caustic]\nphotons = 1\n", "", {"caustic", "water.caustics"}},
        {"NoPhotons", kWaves + "[water.caustics]\nphotons = 0\n", "", {"photons", "0"}},
        {"TooManyPhotons", kWaves + "[water.caustics]\nphotons = 1000000000\n", "", {"photons", "1000000000"}},
        {"EmptyArea", kWaves + "areaMin = [1, 1]\nareaMax = [1, 2]\n", "", {"areaMin"}},
        {"NoHeightmap", "waves = { kind = \"heightmap\" }\n", "", {"file"}},
        {"MissingHeightmap", "waves = { kind = \"heightmap\", file = \"absent.exr\" }\n", "", {"absent.exr"}},
        {"WrongHeightmapSize", "waves = { kind = \"heightmap\", file = \"odd.exr\" }\n", "", {"30"}},
        {"NanInHeightmap", "waves = { kind = \"heightmap\", file = \"nan.exr\" }\n", "", {"nan", "(5, 0)"}},
    };
}

std::vector<Case> odd() {
    return {
        {"FlatWater", "waves = { kind = \"flat\" }\n", "", {}},
        {"SunBelowTheHorizon", kWaves, "[sun]\ntoSun = [0.5, -0.2, 0]\n", {}},
        {"SunOnTheHorizon", kWaves, "[sun]\ntoSun = [1, 0, 0]\n", {}},
        {"NoSun", kWaves, "sun = \"none\"\n", {}},
        {"LampOnTheSurface", kWaves, "[[light]]\nposition = [0, 0, 0]\nintensity = [5, 5, 5]\n", {}},
        {"SpotJustAboveTheSurface",
         kWaves,
         "[[light]]\nkind = \"spot\"\nposition = [0, 0.001, 0]\ntarget = [0, -1, 0]\nintensity = [5, 5, 5]\n",
         {}},
        {"FloorAtTheSurface", kWaves, "[[shape]]\nkind = \"plane\"\n", {}},
        {"FewestPhotons", kWaves + "[water.caustics]\nphotons = 1000\n", "", {}},
        {"TinyArea", kWaves + "areaMin = [0, 0]\nareaMax = [0.001, 0.001]\n", "", {}},
        {"PaperWithoutSun", kWaves + "[water.caustics]\nmethod = \"paper\"\n", "sun = \"none\"\n", {}},
        {"PaperSunOnTheHorizon", kWaves + "[water.caustics]\nmethod = \"paper\"\n", "[sun]\ntoSun = [1, 0, 0]\n", {}},
        {"DeepBlack", kWaves + "absorption = [1000, 1000, 1000]\nscattering = [1000, 1000, 1000]\n", "", {}},
        {"IndexOfAir", kWaves + "index = 1.0001\n", "", {}},
    };
}

class WaterInput : public testing::TestWithParam<Case> {
protected:
    void SetUp() override {
        Image heights(30, 30, 1);
        ASSERT_TRUE(io::writeExr(folder / "odd.exr", heights));
        Image broken(32, 32, 1);
        broken.pixels[5] = std::numeric_limits<float>::quiet_NaN();
        ASSERT_TRUE(io::writeExr(folder / "nan.exr", broken));
    }
    ProgramRun render(std::vector<std::string> words) {
        const Case& one = GetParam();
        // Top-level keys come before the first table.
        const bool top = one.rest.rfind("sun =", 0) == 0;
        writeText(folder / "scene.toml", (top ? one.rest : "") + sceneWith(one.water, top ? "" : one.rest));
        words.insert(words.begin(), {SHOAL_TOOL, "render", "scene.toml", "--quiet", "--device", "cpu"});
        // LeakSanitizer (clang 14) itself crashes at the end of one case of the paper's method; the others look for
        // leaks.
        RunOptions options{.folder = folder.path(), .environment = {}};
        if (one.water.find("\"paper\"") != std::string::npos)
            options.environment = {{"ASAN_OPTIONS", "detect_leaks=0"}};
        return runProgram(words, options);
    }
    static void expectFinite(const std::filesystem::path& file) {
        const auto layers = io::readLayers(file);
        ASSERT_TRUE(layers) << layers.error().message;
        for (const Layer& layer : *layers) {
            std::size_t wrong = 0;
            for (const float x : layer.image.pixels) wrong += std::isfinite(x) ? 0 : 1;
            EXPECT_EQ(wrong, 0u) << "values of layer \"" << layer.name << "\" are not numbers";
        }
    }
    TestFolder folder;
};

using WaterRefused = WaterInput;
TEST_P(WaterRefused, InOneLine) { expectRefusal(render({"-o", "out.png"}), 3, GetParam().mentions); }
INSTANTIATE_TEST_SUITE_P(All, WaterRefused, testing::ValuesIn(refused()),
                         [](const auto& one) { return std::string(one.param.name); });

using WaterOdd = WaterInput;
TEST_P(WaterOdd, GivesAPictureOfNumbers) {
    const ProgramRun run = render({"-o", "out.exr", "--aov", "all"});
    ASSERT_EQ(run.exitCode, 0) << run.describe();
    expectFinite(folder / "out.exr");
}
INSTANTIATE_TEST_SUITE_P(All, WaterOdd, testing::ValuesIn(odd()),
                         [](const auto& one) { return std::string(one.param.name); });

// Every height of the eye round the surface, exactly on it too.
TEST(WaterEye, OnTheSurfaceSeesNumbers) {
    const TestFolder folder;
    writeText(folder / "scene.toml", sceneWith("waves = { kind = \"flat\" }\n", ""));
    for (const char* y : {"0", "0.000001", "-0.000001", "0.02", "-0.02"}) {
        const std::string eye = std::string("camera.position=[2, ") + y + ", 3]";
        const ProgramRun run = runProgram(
            {SHOAL_TOOL, "render", "scene.toml", "--quiet", "--device", "cpu", "--set", eye, "-o", "out.exr"},
            {.folder = folder.path(), .environment = {}});
        ASSERT_EQ(run.exitCode, 0) << run.describe();
        const auto image = io::readImage(folder / "out.exr");
        ASSERT_TRUE(image);
        for (const float x : image->pixels) ASSERT_TRUE(std::isfinite(x)) << "eye at " << y;
    }
}

// Nothing but water: no model, no shape.
TEST(WaterEye, WithoutAnyGeometryThereIsAPicture) {
    const TestFolder folder;
    writeText(folder / "scene.toml", "[camera]\nposition = [0, 3, 6]\ntarget = [0, 0, 0]\n[water]\n" + kWaves);
    const ProgramRun run = runProgram({SHOAL_TOOL, "render", "scene.toml", "--quiet", "--device", "cpu", "--size",
                                       "96x64", "-o", "out.exr", "--aov", "all"},
                                      {.folder = folder.path(), .environment = {}});
    ASSERT_EQ(run.exitCode, 0) << run.describe();
}

}  // namespace
}  // namespace shoal::test
