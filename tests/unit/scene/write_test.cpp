// Changed scenes as text: what is read back is what was asked for, and a person's own text stays where it can.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <shoal/scene/write.h>

namespace shoal::scene {
namespace {

constexpr const char* kText = R"(# A scene.
[camera]  # the eye
path = [
  { time = 0, position = [1, 2, 3], target = [0, 0, 0] },  # ] not the end
  { time = 1, position = [2, 2, 3], target = [0, 0, 0] },
]
fovDeg = 50   # wide

[water]
level = 0
waves = { kind = "turbulent", amplitude = 0.12 }

[[shape]]
kind = "box"
name = "a # b"

[[shape]]
kind = "plane"
)";

std::string changed(const std::vector<Override>& changes, std::string_view text = kText) {
    const auto made = changedSceneText(text, "/a/scene.toml", "/a/scene.toml", changes);
    EXPECT_TRUE(made) << made.error().message;
    return made ? *made : "";
}

TEST(SceneWrite, WithoutChangesTheTextIsTheSame) { EXPECT_EQ(changed({}), kText); }

TEST(SceneWrite, AValueIsChangedInItsPlace) {
    std::string expected = kText;
    expected.replace(expected.find("50   # wide"), 2, "35.5");
    EXPECT_EQ(changed({{"camera.fovDeg", "35.5"}}), expected);
}

TEST(SceneWrite, NewKeysGoIntoTheirTables) {
    const std::string text =
        changed({{"shape[0].width", "2"}, {"post.exposureEv", "1"}, {"shape[1].tint", "[1, 0.5, 0]"}});
    EXPECT_NE(text.find("name = \"a # b\"\nwidth = 2\n"), std::string::npos) << text;
    EXPECT_NE(text.find("kind = \"plane\"\ntint = [1, 0.5, 0]\n"), std::string::npos) << text;
    EXPECT_NE(text.find("[post]\nexposureEv = 1\n"), std::string::npos) << text;
    EXPECT_NE(text.find("# A scene."), std::string::npos) << text;
}

TEST(SceneWrite, AnInlineTableIsWrittenAnewAroundItsChange) {
    const std::string text = changed({{"water.waves.amplitude", "0.5"}});
    EXPECT_NE(text.find("waves = { kind = \"turbulent\", amplitude = 0.5 }"), std::string::npos) << text;
    EXPECT_NE(text.find("# wide"), std::string::npos) << text;
}

TEST(SceneWrite, AnEyeThatIsPlacedTakesThePathOut) {
    const std::string text = changed({{"camera.position", "[0, 0, 5]"}});
    EXPECT_EQ(text.find("path"), std::string::npos) << text;
    EXPECT_NE(text.find("# the eye"), std::string::npos) << text;
    const auto scene = parseScene(text, "/a/scene.toml");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->cameraKind, CameraKind::fixed);
    EXPECT_EQ(scene->camera.position, (Vec3{0, 0, 5}));
    EXPECT_EQ(scene->camera.fovDeg, 50);
}

TEST(SceneWrite, OverridesOfPathAndPlacedEyeAgree) {
    const std::vector<Override> changes = {{"camera.position", "[0, 0, 5]"}};
    const auto scene = parseScene(kText, "/a/scene.toml", changes);
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->cameraKind, CameraKind::fixed);
}

TEST(SceneWrite, HeadersOfTheCameraPathAreWrittenWhole) {
    const std::string text = changed({{"camera.position", "[0, 0, 5]"}},
                                     "[camera]\nfovDeg = 40\n[[camera.path]]\ntime = 0\nposition = [1, 1, 1]\n");
    const auto scene = parseScene(text, "/a/scene.toml");
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(scene->cameraKind, CameraKind::fixed);
    EXPECT_EQ(scene->camera.fovDeg, 40);
}

TEST(SceneWrite, WhatReadsBackIsTheSameForOddTexts) {
    const char* texts[] = {
        "environment = \"none\"\nrender.width = 64\nrender.height = 48\n[sun]\ntoSun = [0,\n 1,  # up\n 0]\n",
        "[render]\nwidth=64\r\nheight=48\r\n",
        "render = { width = 64, height = 48 }\n[[model]]\nfile = 'x.glb'\n[model.copies]\ncountX = 3\n",
        "[post]\ntoneCurve = \"\"\"\nplain\"\"\"\n",
        "",
    };
    for (const char* text : texts) {
        for (const Override& change : {Override{"render.width", "99"}, Override{"post.exposureEv", "-1.25"},
                                       Override{"render.antialiasing", "temporal"}}) {
            const std::vector<Override> changes = {change};
            const auto wanted = parseScene(text, "/a/s.toml", changes);
            const auto made = changedSceneText(text, "/a/s.toml", "/a/t.toml", changes);
            ASSERT_EQ(wanted.has_value(), made.has_value() && parseScene(*made, "/a/t.toml").has_value()) << text;
            if (!wanted) continue;
            const auto again = parseScene(*made, "/a/t.toml");
            const auto rows = [](const auto& params) {
                std::string all;
                for (const FieldRow& row : describe(params)) all += row.name + "=" + row.value + "\n";
                return all;
            };
            EXPECT_EQ(rows(wanted->render), rows(again->render)) << *made;
            EXPECT_EQ(rows(wanted->sun), rows(again->sun)) << *made;
            ASSERT_EQ(wanted->models.size(), again->models.size());
            for (std::size_t i = 0; i < wanted->models.size(); ++i)
                EXPECT_EQ(again->models[i].copies.countX, wanted->models[i].copies.countX);
            ASSERT_EQ(wanted->tables.size(), again->tables.size());
            for (std::size_t i = 0; i < wanted->tables.size(); ++i)
                ASSERT_EQ(wanted->tables[i].entries.size(), again->tables[i].entries.size());
        }
    }
}

TEST(SceneWrite, FilesAreFoundFromAnotherFolder) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "shoal_scene_write_test";
    std::filesystem::create_directories(folder / "models");
    std::filesystem::create_directories(folder / "out");
    std::ofstream(folder / "models/a.glb") << "x";
    const auto made = changedSceneText("[[model]]\nfile = \"models/a.glb\"  # stays\n[[model]]\nfile = \"gone.glb\"\n",
                                       folder / "s.toml", folder / "out/t.toml", {});
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(*made, "[[model]]\nfile = \"../models/a.glb\"  # stays\n[[model]]\nfile = \"gone.glb\"\n");
}

TEST(SceneWrite, ModelsGetASceneOfTheirOwn) {
    const std::vector<std::filesystem::path> files = {"/x/a \"b\".glb", "/x/c.obj"};
    const auto scene = parseScene(sceneTextForModels(files), "/x/s.toml");
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->models.size(), 2u);
    EXPECT_EQ(scene->models[0].model.file, "/x/a \"b\".glb");
    EXPECT_EQ(scene->models[1].model.clip, "*");
    EXPECT_TRUE(scene->bareModel);
}

}  // namespace
}  // namespace shoal::scene
