// Bad input to `shoal render`: one clear line, the exit code of docs/conventions.md, no partial output, and an old
// output untouched.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <ostream>

#include "support/tool_contract.h"
#include "unit/io/gltf_builder.h"

namespace shoal::test {
namespace {

namespace fs = std::filesystem;

void writeBytes(const fs::path& file, const std::vector<std::byte>& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

// A sound model, for what is to be wrong with it.
GltfBuilder soundModel() { return skinnedQuad(smallPng()); }

struct BadInput {
    const char* name;
    int exitCode;
    // Writes what is needed into the folder and gives the words after `shoal render`; "-o out.png" is added.
    std::function<std::vector<std::string>(const fs::path& folder)> prepare;
    std::vector<std::string> mentions;
};
void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

std::vector<std::string> model(const fs::path& folder, const std::vector<std::byte>& bytes) {
    writeBytes(folder / "model.glb", bytes);
    return {"model.glb"};
}

std::vector<std::string> scene(const fs::path& folder, const std::string& text) {
    writeText(folder / "scene.toml", text);
    return {"scene.toml"};
}

const std::string kGoodScene = "[camera]\nposition = [3, 2, 5]\ntarget = [0, 0, 0]\n[[shape]]\nkind = \"sphere\"\n";

std::vector<BadInput> badModels() {
    return {
        {"MissingScene",
         3,
         [](const fs::path&) { return std::vector<std::string>{"absent.toml"}; },
         {"absent.toml", "no such file"}},
        {"MissingModel",
         3,
         [](const fs::path&) { return std::vector<std::string>{"absent.glb"}; },
         {"absent.glb", "no such file"}},
        {"FolderAsModel",
         3,
         [](const fs::path& folder) {
             fs::create_directory(folder / "folder.glb");
             return std::vector<std::string>{"folder.glb"};
         },
         {"folder.glb"}},
        {"EmptyModel", 3, [](const fs::path& folder) { return model(folder, {}); }, {"model.glb"}},
        {"TruncatedGlb",
         3,
         [](const fs::path& folder) {
             auto bytes = soundModel().glb();
             bytes.resize(bytes.size() / 2);
             return model(folder, bytes);
         },
         {"model.glb"}},
        {"TruncatedHeader",
         3,
         [](const fs::path& folder) {
             auto bytes = soundModel().glb();
             bytes.resize(10);
             return model(folder, bytes);
         },
         {"model.glb"}},
        {"AccessorOutOfRange",
         3,
         [](const fs::path& folder) {
             GltfBuilder b = soundModel();
             b.accessors[0] = replaced(b.accessors[0], R"("count":4)", R"("count":4000)");
             return model(folder, b.glb());
         },
         {"model.glb", "accessor"}},
        {"IndexOutOfRange",
         3,
         [](const fs::path& folder) {
             GltfBuilder b = soundModel();
             const int wrong = b.accessor<std::uint16_t>({0, 1, 2, 0, 2, 900}, 5123, "SCALAR", 6);
             b.meshes[0] = replaced(b.meshes[0], R"("indices":5)", "\"indices\":" + std::to_string(wrong));
             return model(folder, b.glb());
         },
         {"model.glb", "900"}},
        {"NanPositions",
         3,
         [](const fs::path& folder) {
             GltfBuilder b = soundModel();
             const float nan = std::nanf("");
             std::memcpy(b.binary.data() + 16, &nan, 4);
             return model(folder, b.glb());
         },
         {"model.glb"}},
        {"CycleInTheNodes",
         3,
         [](const fs::path& folder) {
             GltfBuilder b = soundModel();
             b.nodes[2] = replaced(b.nodes[2], R"("name":"spine")", R"("name":"spine","children":[1])");
             return model(folder, b.glb());
         },
         {"model.glb"}},
        {"NodeIsItsOwnChild",
         3,
         [](const fs::path& folder) {
             GltfBuilder b = soundModel();
             b.nodes[2] = replaced(b.nodes[2], R"("name":"spine")", R"("name":"spine","children":[2])");
             return model(folder, b.glb());
         },
         {"model.glb"}},
        {"TextureIsNoImage",
         3,
         [](const fs::path& folder) {
             GltfBuilder b = skinnedQuad(std::vector<std::uint8_t>(200, 'x'));
             return model(folder, b.glb());
         },
         {"model.glb", "image"}},
        {"TextureFileIsNoImage",
         3,
         [](const fs::path& folder) {
             GltfBuilder b = soundModel();
             b.images = {R"({"uri":"words.png"})"};
             writeText(folder / "words.png", "These are words, not a picture.\n");
             return model(folder, b.glb());
         },
         {"model.glb", "image"}},
        {"TextureFileMissing",
         3,
         [](const fs::path& folder) {
             GltfBuilder b = soundModel();
             b.images = {R"({"uri":"absent.png"})"};
             return model(folder, b.glb());
         },
         {"absent.png"}},
    };
}

std::vector<BadInput> badScenes() {
    return {
        {"NotToml", 3, [](const fs::path& folder) { return scene(folder, "[camera\n"); }, {"scene.toml:1"}},
        {"UnknownKey",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "radus = 2\n"); },
         {"scene.toml:6", "radus", "did you mean \"radius\""}},
        {"UnknownTable",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "[enviroment]\n"); },
         {"scene.toml:6", "did you mean \"environment\""}},
        {"UnknownKeyInLighting",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "[lighting]\nsunDisk = true\n"); },
         {"scene.toml:7", "did you mean \"sunDisc\""}},
        {"UnknownKeyInPost",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "[post]\nblom = 1\n"); },
         {"scene.toml:7", "did you mean \"bloom\""}},
        {"UnknownShape",
         3,
         [](const fs::path& folder) { return scene(folder, "[[shape]]\nkind = \"spere\"\n"); },
         {"scene.toml:2", "did you mean \"sphere\""}},
        {"ValueOutOfRange",
         3,
         [](const fs::path& folder) { return scene(folder, "[camera]\nfovDeg = 200\n"); },
         {"scene.toml:2", "fovDeg", "200", "1 .. 179"}},
        {"ShapeValueOutOfRange",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "radius = -1\n"); },
         {"scene.toml:6", "radius", "-1"}},
        {"PostValueOutOfRange",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "[post]\nbloom = 3\n"); },
         {"scene.toml:7", "bloom", "3"}},
        {"NotANumber",
         3,
         [](const fs::path& folder) { return scene(folder, "[camera]\nposition = [nan, 0, 1]\n"); },
         {"scene.toml:2", "position"}},
        {"WrongType",
         3,
         [](const fs::path& folder) { return scene(folder, "[camera]\nfovDeg = \"wide\"\n"); },
         {"scene.toml:2", "fovDeg"}},
        {"ZeroSizeInTheScene",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "[render]\nwidth = 0\n"); },
         {"scene.toml:7", "width"}},
        {"MissingModelOfAScene",
         3,
         [](const fs::path& folder) { return scene(folder, "[[model]]\nfile = \"absent.glb\"\n"); },
         {"scene.toml:", "absent.glb"}},
        {"MissingEnvironment",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "[environment]\nfile = \"absent.hdr\"\n"); },
         {"scene.toml:", "absent.hdr"}},
        {"MissingPoses",
         3,
         [](const fs::path& folder) {
             return scene(folder, "[camera]\nposes = \"absent.csv\"\n[[shape]]\nkind = \"box\"\n");
         },
         {"scene.toml:", "absent.csv"}},
        {"MissingClip",
         3,
         [](const fs::path& folder) {
             writeBytes(folder / "model.glb", soundModel().glb());
             return scene(folder, "[[model]]\nfile = \"model.glb\"\nclip = \"Bent\"\n");
         },
         {"scene.toml:", "Bent", "bend"}},
        {"TruncatedModelOfAScene",
         3,
         [](const fs::path& folder) {
             auto bytes = soundModel().glb();
             bytes.resize(bytes.size() / 2);
             writeBytes(folder / "model.glb", bytes);
             return scene(folder, "[[model]]\nfile = \"model.glb\"\n");
         },
         {"model.glb"}},
        {"NotBuiltYet",
         3,
         [](const fs::path& folder) { return scene(folder, kGoodScene + "[crowd]\ncount = 3\n"); },
         {"scene.toml:6", "crowd"}},
    };
}

std::vector<std::string> with(const fs::path& folder, std::vector<std::string> more) {
    more.insert(more.begin(), scene(folder, kGoodScene)[0]);
    return more;
}

std::vector<BadInput> badWords() {
    return {
        {"ZeroSize",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--size", "0x0"});
         },
         {"--size", "0x0"}},
        {"ZeroWidth",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--size", "0x90"});
         },
         {"--size", "0x90"}},
        {"HugeSize",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--size", "99999x99999"});
         },
         {"--size"}},
        {"SizeInWords",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--size", "large"});
         },
         {"--size", "large"}},
        {"FramesBackwards",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--frames", "5:2"});
         },
         {"--frames", "5:2"}},
        {"SetUnknownKey",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--set", "camera.fovDg=40"});
         },
         {"fovDg", "did you mean \"fovDeg\""}},
        {"SetUnknownKeyOfPost",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--set", "post.exposurEv=1"});
         },
         {"exposurEv", "did you mean \"exposureEv\""}},
        {"SetUnknownKeyOfAShape",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--set", "shape[0].radus=1"});
         },
         {"radus", "did you mean \"radius\""}},
        {"SetOutOfRange",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--set", "camera.fovDeg=400"});
         },
         {"fovDeg", "400"}},
        {"SetPostOutOfRange",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--set", "post.bloom=7"});
         },
         {"bloom", "7"}},
        {"SetShapeOutOfRange",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--set", "shape[0].radius=-7"});
         },
         {"radius", "-7"}},
        {"SetWithoutValue",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--set", "camera"});
         },
         {"--set", "key=value"}},
        {"SetNoSuchElement",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--set", "shape[7].radius=1"});
         },
         {"shape", "7"}},
        {"UnknownAov",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--aov", "dept"});
         },
         {"dept", "did you mean \"depth\""}},
        {"AovIntoPng",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--aov", "depth"});
         },
         {"--aov", ".exr"}},
        {"UnknownDevice",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--device", "cpuu"});
         },
         {"cpuu", "did you mean \"cpu\""}},
        {"SamplesOutOfRange",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--samples", "0"});
         },
         {"samples", "0"}},
        {"UnknownAntialiasing",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--antialiasing", "temporl"});
         },
         {"temporl", "temporal"}},
        {"QualityOutOfRange",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--quality", "500"});
         },
         {"--quality"}},
        {"UnknownOption",
         2,
         [](const fs::path& folder) {
             return with(folder, {"--sise", "8x8"});
         },
         {"--sise", "did you mean \"--size\""}},
    };
}

class ToolBadInput : public testing::TestWithParam<BadInput> {};

TEST_P(ToolBadInput, IsOneLineAndLeavesTheOldOutput) {
    const TestFolder folder;
    std::vector<std::string> words = GetParam().prepare(folder.path());
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"-o", "out.png"});
    writeText(folder / "out.png", "the old output");
    const auto before = contentOf(folder.path());
    expectRefusal(runTool(words, {.folder = folder.path(), .environment = {}}), GetParam().exitCode,
                  GetParam().mentions);
    EXPECT_EQ(contentOf(folder.path()), before) << "files changed";
}

std::string nameOf(const testing::TestParamInfo<BadInput>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Model, ToolBadInput, testing::ValuesIn(badModels()), nameOf);
INSTANTIATE_TEST_SUITE_P(Scene, ToolBadInput, testing::ValuesIn(badScenes()), nameOf);
INSTANTIATE_TEST_SUITE_P(Words, ToolBadInput, testing::ValuesIn(badWords()), nameOf);

// ---- what is wrong with the output ----

struct BadOutput {
    const char* name;
    int exitCode;
    std::vector<std::string> words;  // after `shoal render scene.toml`
    std::vector<std::string> mentions;
};
void PrintTo(const BadOutput& bad, std::ostream* out) { *out << bad.name; }

class ToolBadOutput : public testing::TestWithParam<BadOutput> {};

TEST_P(ToolBadOutput, IsOneLineAndLeavesNothing) {
    const TestFolder folder;
    scene(folder.path(), kGoodScene + "[render]\nwidth = 32\nheight = 18\nsamples = 1\n");
    writeText(folder / "file", "not a folder");
    fs::create_directory(folder / "folder.png");
    const auto before = contentOf(folder.path());
    std::vector<std::string> words = {"render", "scene.toml", "--quiet"};
    words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
    expectRefusal(runTool(words, {.folder = folder.path(), .environment = {}}), GetParam().exitCode,
                  GetParam().mentions);
    EXPECT_EQ(contentOf(folder.path()), before) << "files changed";
}

// /proc takes no new files, even from root.
INSTANTIATE_TEST_SUITE_P(
    All, ToolBadOutput,
    testing::Values(BadOutput{"UnwritableFolder", 3, {"-o", "/proc/out.png"}, {"/proc/out.png"}},
                    BadOutput{"UnwritableFolderExr", 3, {"-o", "/proc/out.exr"}, {"/proc/out.exr"}},
                    BadOutput{"UnwritableFolderFrames", 3, {"-o", "/proc/f.png", "--frames", "0:2"}, {"/proc/f"}},
                    BadOutput{"UnwritableFolderFilm", 3, {"-o", "/proc/out.mp4", "--frames", "0:2"}, {"/proc/out"}},
                    BadOutput{"FileAsFolder", 3, {"-o", "file/out.png"}, {"file"}},
                    BadOutput{"FolderAsFile", 3, {"-o", "folder.png"}, {"folder.png"}},
                    BadOutput{
                        "UnwritablePoses", 3, {"-o", "out.png", "--poses", "/proc/poses.csv"}, {"/proc/poses.csv"}},
                    BadOutput{"UnknownExtension", 2, {"-o", "out.gif"}, {".gif", ".png"}},
                    BadOutput{"NoExtension", 2, {"-o", "out"}, {"out", ".png"}},
                    BadOutput{"TransparentJpeg", 2, {"-o", "out.jpg", "--transparent"}, {"--transparent", ".png"}},
                    BadOutput{"NoOutput", 2, {}, {"-o"}}),
    [](const testing::TestParamInfo<BadOutput>& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace shoal::test
