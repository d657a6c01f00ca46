// Scene files: what is bound, and that every mistake gets one line with file, line, key, found and expected.
#include <algorithm>

#include <gtest/gtest.h>

#include <shoal/scene/scene.h>

namespace shoal::scene {
namespace {

Result<Scene> parse(std::string_view text, std::vector<Override> overrides = {}) {
    return parseScene(text, "folder/test.toml", overrides);
}

std::string errorOf(std::string_view text, std::vector<Override> overrides = {}) {
    auto scene = parse(text, std::move(overrides));
    if (scene) return "no error";
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos) << scene.error().message;
    return scene.error().message;
}

TEST(SceneFile, BindsWhatItSays) {
    auto scene = parse(R"(
[camera]
position = [6, 2.5, 9]
target   = [0, -1, 0]
fovDeg   = 60
[sun]
toSun = [0.3, 1, 0.2]
irradiance = [9.2, 9.2, 9.2]
[[model]]
file = "ruin.glb"
scale = 2
hide = ["sword", "shield*"]
[[model]]
file = "walker.glb"
clip = "Walk"
copies = { countX = 3, countZ = 2, timeStep = 0.25 }
walk = { points = [[0, 0, 0], [5, 0, 0]], speed = 1.5 }
[[light]]
kind = "spot"
position = [0, 4, 0]
target = [0, 0, 0.5]
[[shape]]
kind = "plane"
position = [0, -1, 0]
[render]
samples = 4
[post]
exposureEv = 1.5
[water]
level = 0
waves = { kind = "sum", components = [ { amplitude = 0.1, q = 2 }, { amplitude = 0.2 } ] }
)");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->cameraKind, CameraKind::fixed);
    EXPECT_EQ(scene->camera.fovDeg, 60);
    EXPECT_EQ(scene->camera.position, (Vec3{6, 2.5f, 9}));
    EXPECT_NEAR(length(scene->sun.toSun), 1, 1e-6);
    EXPECT_EQ(scene->sun.irradiance, (Vec3{9.2f, 9.2f, 9.2f}));
    ASSERT_EQ(scene->models.size(), 2u);
    EXPECT_EQ(scene->models[0].placement.scale, (Vec3{2, 2, 2}));
    EXPECT_EQ(scene->models[0].hide, (std::vector<std::string>{"sword", "shield*"}));
    EXPECT_EQ(scene->models[0].place.line, 9);
    EXPECT_EQ(scene->models[1].copies.countX, 3);
    ASSERT_TRUE(scene->models[1].walk);
    EXPECT_EQ(scene->models[1].walk->points[1], (Vec3{5, 0, 0}));
    ASSERT_EQ(scene->lights.size(), 1u);
    EXPECT_EQ(scene->shapes.at(0).kind, "plane");
    EXPECT_EQ(scene->render.samples, 4);
    ASSERT_TRUE(scene->table("water"));
    EXPECT_EQ(scene->table("water")->entries.at(0).key, "level");
    ASSERT_TRUE(scene->table("water.waves.components[1]"));
    EXPECT_EQ(scene->table("water.waves.components[1]")->entries.at(0).value.numbers.at(0), 0.2);
    EXPECT_EQ(scene->table("post")->entries.at(0).place.line, 28);
}

TEST(SceneFile, AShapeGoesByItsKindOrByShape) {
    auto scene = parse(R"(
environment = "none"
sun = "none"
[[shape]]
kind = "box"
[[shape]]
shape = "plane"
width = 6
[[model]]
file = "ruin.glb"
[[model]]
shape = "sphere"
radius = 2
position = [0, 1, 0]
)");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->environment.kind, "none");
    EXPECT_TRUE(scene->sunOff);
    EXPECT_EQ(scene->models.size(), 1u);
    ASSERT_EQ(scene->shapes.size(), 3u);
    const auto entry = [&](std::string_view kind) -> const ShapeEntry& {
        return *std::find_if(scene->shapes.begin(), scene->shapes.end(), [&](const auto& s) { return s.kind == kind; });
    };
    EXPECT_EQ(entry("plane").settings.at(0).key, "width");
    EXPECT_EQ(entry("plane").settings.size(), 1u);
    EXPECT_EQ(entry("sphere").placement.position, (Vec3{0, 1, 0}));
    EXPECT_EQ(entry("sphere").settings.size(), 1u);
}

TEST(SceneFile, WaterTablesArriveRaw) {
    auto scene = parse(R"(
[water]
level = 0.5
surfaceVisible = false
absorption = [0.3, 0.05, 0.01]
waves = { kind = "sum", periodM = 4, components = [ { amplitude = 0.02, m = 2, q = 1, phase = 0 },
                                                    { amplitude = 0.015, m = -3, q = 2, phase = 1.3 } ] }
[water.caustics]
photons = 640000
method = "paper"
)");
    ASSERT_TRUE(scene) << scene.error().message;
    const auto entry = [&](const char* table, const char* key) -> const RawEntry& {
        static const RawEntry none;
        const RawTable* found = scene->table(table);
        EXPECT_TRUE(found) << table;
        if (found)
            for (const RawEntry& e : found->entries)
                if (e.key == key) return e;
        ADD_FAILURE() << table << " has no " << key;
        return none;
    };
    EXPECT_EQ(entry("water", "absorption").value.numbers, (std::vector<double>{0.3, 0.05, 0.01}));
    EXPECT_EQ(entry("water", "surfaceVisible").value.kind, FieldValue::Kind::boolean);
    EXPECT_EQ(entry("water.waves", "kind").value.text, "sum");
    EXPECT_EQ(entry("water.waves", "periodM").value.numbers.at(0), 4);
    EXPECT_EQ(entry("water.waves.components[0]", "amplitude").value.numbers.at(0), 0.02);
    EXPECT_EQ(entry("water.waves.components[1]", "m").value.numbers.at(0), -3);
    EXPECT_EQ(entry("water.waves.components[1]", "phase").place.line, 7);
    EXPECT_EQ(entry("water.caustics", "method").value.text, "paper");
    EXPECT_FALSE(scene->table("water.waves.components[2]"));
    EXPECT_EQ(scene->table("water")->entries.size(), 3u);  // nested tables are not entries too
}

struct Mistake {
    const char* text;
    const char* line;  // how the message begins
    const char* contains;
};

TEST(SceneFile, NamesEveryMistake) {
    const Mistake mistakes[] = {
        {"[camera]\nfovDg = 60\n", "folder/test.toml:2: ", "\"fovDeg\""},
        {"[camra]\n", "folder/test.toml:1: ", "\"camera\""},
        {"[camera]\nfovDeg = 400\n", "folder/test.toml:2: camera.fovDeg: ", "400"},
        {"[camera]\nfovDeg = nan\n", "folder/test.toml:2: camera.fovDeg: ", "nan"},
        {"[camera]\nposition = [1, 2]\n", "folder/test.toml:2: camera.position: ", "expected"},
        {"[camera]\nposition = \"up\"\n", "folder/test.toml:2: camera.position: ", "expected"},
        {"[camera]\nprojection = \"ortographic\"\n", "folder/test.toml:2: camera.projection: ", "orthographic"},
        {"[camera]\nposition = [1, 1, 1]\ntarget = [1, 1, 1]\n", "folder/test.toml:1: camera.target: ", "another"},
        {"[camera]\norbit = {}\nposes = \"a.csv\"\n", "folder/test.toml:1: camera: ", "one of"},
        {"[camera]\npath = [{ time = 1 }, { time = 1 }]\n", "folder/test.toml:2: camera.path[1]: ", "increase"},
        {"[camera]\nintrinsics = { fx = 500, fy = 500 }\n", "folder/test.toml:2: camera.intrinsics.", "expected"},
        {"[sun]\ntoSun = [0, 0, 0]\n", "folder/test.toml:1: sun.toSun: ", "direction"},
        {"[sun]\nelevationDeg = 120\n", "folder/test.toml:2: sun.elevationDeg: ", "90"},
        {"[[model]]\nscale = 1\n", "folder/test.toml:1: model[0].file: ", "expected"},
        {"[[model]]\nfile = \"a.glb\"\nscale = 0\n", "folder/test.toml:1: model[0].scale: ", "0"},
        {"[[model]]\nfile = \"a.glb\"\nwalk = { points = [[0, 0, 0]] }\n",
         "folder/test.toml:3: model[0].walk.points: ", "at least 2"},
        {"[[model]]\nfile = \"a.glb\"\ncopies = { countX = 1000, countZ = 1000 }\n",
         "folder/test.toml:3: model[0].copies: ", "100000"},
        {"model = 3\n", "folder/test.toml:1: model: ", "array of tables"},
        {"[[shape]]\nkind = \"plain\"\n", "folder/test.toml:2: shape[0].kind: ", "\"plane\""},
        {"[[shape]]\nsize = 3\n", "folder/test.toml:1: shape[0].kind: ", "expected"},
        {"[[shape]]\nshape = \"plain\"\n", "folder/test.toml:2: shape[0].shape: ", "\"plane\""},
        {"[[shape]]\nshape = \"plane\"\nkind = \"box\"\n", "folder/test.toml:3: shape[0]: ", "one of them"},
        {"[[model]]\nshape = \"plane\"\nfile = \"a.glb\"\n", "folder/test.toml:3: model[0]: ", "one of them"},
        {"[[model]]\nshape = \"sphr\"\n", "folder/test.toml:2: model[0].shape: ", "\"sphere\""},
        {"[[light]]\nkind = \"spot\"\nposition = [0, 0, 0]\n", "folder/test.toml:1: light[0].target: ", "another"},
        {"[environment]\nkind = \"file\"\n", "folder/test.toml:1: environment.file: ", "expected"},
        {"environment = \"clearsky\"\n", "folder/test.toml:1: environment", "clearSky"},
        {"[render]\nwidth = 0\n", "folder/test.toml:2: render.width: ", "0"},
        {"[render]\nsamples = 2.5\n", "folder/test.toml:2: render.samples: ", "2.5"},
        {"[camera\n", "folder/test.toml:1: ", "TOML"},
        {"[camera]\nposition = 2020-01-01\n", "folder/test.toml:2: ", "date"},
    };
    for (const Mistake& mistake : mistakes) {
        const std::string message = errorOf(mistake.text);
        EXPECT_EQ(message.rfind(mistake.line, 0), 0u) << mistake.text << "\n-> " << message;
        EXPECT_NE(message.find(mistake.contains), std::string::npos) << mistake.text << "\n-> " << message;
    }
}

TEST(SceneFile, OverridesReachEveryValue) {
    auto scene = parse("[[model]]\nfile = \"a.glb\"\n", {{"camera.position", "[1, 2, 3]"},
                                                         {"model[0].clip", "Run"},
                                                         {"post.exposureEv", "2"},
                                                         {"environment", "none"}});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->camera.position, (Vec3{1, 2, 3}));
    EXPECT_EQ(scene->models[0].model.clip, "Run");
    EXPECT_EQ(scene->environment.kind, "none");
    EXPECT_EQ(scene->table("post")->entries.at(0).value.numbers.at(0), 2);
}

TEST(SceneFile, MistakesInOverridesAreUsageErrors) {
    for (const Override& wrong :
         {Override{"camera.fovDg", "3"}, Override{"camera.fovDeg", "many"}, Override{"model[3].clip", "Run"},
          Override{"camera..x", "1"}, Override{"camera[", "1"}, Override{"camera.fovDeg.x", "1"}}) {
        auto scene = parse("[camera]\nfovDeg = 50\n", {wrong});
        ASSERT_FALSE(scene) << wrong.key;
        EXPECT_EQ(scene.error().kind, ErrorKind::usage) << scene.error().message;
        EXPECT_NE(scene.error().message.find("--set"), std::string::npos) << scene.error().message;
    }
    EXPECT_FALSE(parseOverride("camera.fovDeg"));
}

TEST(SceneFile, MissingFilesAndStrangeOnesAreToldApart) {
    auto missing = openScene("/nonexistent/x.toml");
    ASSERT_FALSE(missing);
    EXPECT_NE(missing.error().message.find("/nonexistent/x.toml"), std::string::npos);
    auto strange = openScene(SHOAL_SOURCE_DIR "/LICENSE");
    ASSERT_FALSE(strange);
    EXPECT_NE(strange.error().message.find("expected a scene"), std::string::npos) << strange.error().message;
}

}  // namespace
}  // namespace shoal::scene
