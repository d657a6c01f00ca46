// Each fault of a glTF file gives one line that names the file and the place in it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <shoal/io/model.h>

#include "unit/io/gltf_builder.h"

namespace shoal {
namespace {

using test::GltfBuilder;
using test::replaced;
using test::skinnedQuad;
using test::smallPng;

// The message of the error that reading must give.
std::string fault(const std::vector<std::byte>& bytes) {
    const Result<Model> model = io::readGltf(bytes, {}, "bad.glb");
    if (model) return "no error";
    EXPECT_EQ(model.error().kind, ErrorKind::badInput);
    EXPECT_EQ(model.error().message.find('\n'), std::string::npos);
    return model.error().message;
}

std::string faultOfText(const std::string& json) {
    const auto* first = reinterpret_cast<const std::byte*>(json.data());
    return fault({first, first + json.size()});
}

// skinnedQuad with `from` in its JSON replaced by `to`.
std::string faultWith(std::string_view from, std::string_view to) {
    const GltfBuilder b = skinnedQuad(smallPng());
    const std::string json = b.json();
    EXPECT_NE(json.find(from), std::string::npos) << from << " is not in " << json;
    return fault(test::makeGlb(replaced(json, from, to), b.binary));
}

// skinnedQuad with float `index` of accessor view `view` replaced.
std::string faultWithFloat(std::size_t view, std::size_t index, float value) {
    GltfBuilder b = skinnedQuad(smallPng());
    const std::string& text = b.views.at(view);
    const std::size_t offset = std::stoul(text.substr(text.find("byteOffset") + 12));
    std::memcpy(b.binary.data() + offset + index * 4, &value, 4);
    return fault(b.glb());
}

TEST(GltfBadInput, Container) {
    std::vector<std::byte> glb = skinnedQuad(smallPng()).glb();
    const std::size_t whole = glb.size();
    std::vector<std::byte> cut(glb.begin(), glb.begin() + std::ptrdiff_t(whole / 2));
    EXPECT_EQ(fault(cut),
              fmt::format("bad.glb: truncated: its header says {} bytes, the file has {}", whole, whole / 2));
    EXPECT_EQ(fault({glb.begin(), glb.begin() + 15}), "bad.glb: truncated: 15 bytes, too short for a .glb");
    EXPECT_EQ(fault({}), "bad.glb: empty file");
    std::vector<std::byte> wrong = glb;
    wrong[0] = std::byte('x');
    EXPECT_EQ(fault(wrong), "bad.glb: starts with \"xlTF\", expected \"glTF\" (binary) or \"{\" (JSON)");
    wrong = glb;
    wrong[4] = std::byte(1);
    EXPECT_EQ(fault(wrong), "bad.glb: binary glTF version 1, expected 2");
    wrong = glb;
    wrong[14] = std::byte(0xFF);  // the JSON chunk's length
    EXPECT_NE(fault(wrong).find("bad.glb: chunk 0 has "), std::string::npos) << fault(wrong);
    wrong = glb;
    wrong[16] = std::byte('B');
    EXPECT_NE(fault(wrong).find("expected JSON"), std::string::npos);
}

TEST(GltfBadInput, Json) {
    EXPECT_NE(faultOfText(R"({"asset":)").find("bad.glb: not valid JSON: line 1, column"), std::string::npos);
    EXPECT_EQ(faultOfText("{}"), "bad.glb: \"asset\" is missing");
    EXPECT_EQ(faultOfText(R"({"asset":{"version":"1.0"}})"), "bad.glb: asset: glTF version \"1.0\", expected 2.0");
    EXPECT_EQ(faultOfText(R"({"asset":{"version":"2.0"},"nodes":{}})"), "bad.glb: nodes: an object, expected an array");
    EXPECT_EQ(faultOfText(R"({"asset":{"version":"2.0"},"nodes":[3]})"),
              "bad.glb: nodes[0]: a number, expected an object");
    EXPECT_EQ(faultOfText(R"({"asset":{"version":"2.0"},"nodes":[{"scale":[1,2]}]})"),
              "bad.glb: nodes[0].scale: 2 numbers, expected 3");
    EXPECT_EQ(faultOfText(R"({"asset":{"version":"2.0"},"nodes":[{"scale":[1,2,1e40]}]})"),
              "bad.glb: nodes[0].scale[2]: 1e+40 is too large");
    // Nesting as deep as the file is long must not overflow the stack.
    std::string deep = R"({"asset":{"version":"2.0"},"extras":)";
    deep += std::string(300000, '[') + std::string(300000, ']') + "}";
    EXPECT_EQ(faultOfText(deep), "no error");
}

TEST(GltfBadInput, BuffersAndAccessors) {
    EXPECT_EQ(faultWith(R"({"bufferView":3,)", R"({"bufferView":77,)"),
              "bad.glb: accessors[3]: bufferView 77, but there are only 12");
    EXPECT_EQ(faultWith(R"("type":"VEC3","count":4)", R"("type":"VEC3","count":5)"),
              "bad.glb: accessors[0]: 5 elements of 12 bytes from byte 0, but bufferView 0 has 48 bytes");
    EXPECT_EQ(faultWith(R"("type":"VEC3","count":4)", R"("type":"VEC3","count":0)"),
              "bad.glb: accessors[0]: count 0, expected 1 to 2147483648");
    EXPECT_EQ(faultWith(R"("type":"VEC3","count":4)", R"("type":"VEC3","count":-4)"),
              "bad.glb: accessors[0].count: -4, expected a whole number from 0");
    EXPECT_EQ(faultWith(R"("type":"VEC3","count":4)", R"("type":"VEC2","count":4)"),
              "bad.glb: meshes[0].primitives[0].attributes.POSITION: accessor 0 is VEC2, expected VEC3");
    EXPECT_EQ(faultWith(R"("byteOffset":0,"byteLength":48)", R"("byteOffset":0,"byteLength":4800)"),
              fmt::format("bad.glb: bufferViews[0]: bytes 0 to 4800, but its buffer has {}",
                          skinnedQuad(smallPng()).binary.size()));
    EXPECT_EQ(faultWith(R"("byteOffset":0,"byteLength":48)", R"("byteOffset":0,"byteLength":0)"),
              "bad.glb: bufferViews[0]: byteLength 0, expected at least 1");
    EXPECT_EQ(
        faultWith(R"("byteOffset":0,)", R"("byteOffset":9007199254740990,)").find("bad.glb: bufferViews[0]: bytes "),
        0u);
    EXPECT_EQ(faultWith(R"("componentType":5126)", R"("componentType":5130)"),
              "bad.glb: accessors[0]: componentType 5130, expected 5120 to 5126");
    EXPECT_NE(faultWith(R"("buffers":[{"byteLength":)", R"("buffers":[{"byteLength":9)")
                  .find("bad.glb: buffers[0]: byteLength 9"),
              std::string::npos);
}

TEST(GltfBadInput, AbsurdCountsAreRefusedBeforeMemoryIsTaken) {
    // No buffer view: all zeros, which needs no bytes of the file.
    EXPECT_EQ(faultWith(R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4})",
                        R"({"componentType":5126,"type":"VEC3","count":2000000000})"),
              "bad.glb: accessors[0]: the file decodes to more than 65 MiB, too much for its size");
}

TEST(GltfBadInput, Mesh) {
    GltfBuilder b = skinnedQuad(smallPng());
    const int indices = b.accessor<std::uint16_t>({0, 1, 4}, 5123, "SCALAR", 3);
    b.meshes[0] = replaced(b.meshes[0], R"("indices":5)", fmt::format(R"("indices":{})", indices));
    EXPECT_EQ(fault(b.glb()), "bad.glb: meshes[0].primitives[0].indices: element 2 is vertex 4, but there are only 4");
    EXPECT_EQ(faultWithFloat(0, 4, std::numeric_limits<float>::quiet_NaN()),
              "bad.glb: meshes[0].primitives[0].attributes.POSITION: vertex 1 is (1, nan, 0), expected finite numbers");
    EXPECT_EQ(faultWithFloat(0, 0, std::numeric_limits<float>::infinity()),
              "bad.glb: meshes[0].primitives[0].attributes.POSITION: vertex 0 is (inf, 0, 0), expected finite numbers");
    EXPECT_EQ(faultWith(R"("NORMAL":1)", R"("NORMAL":10)"),
              "bad.glb: meshes[0].primitives[0].attributes.NORMAL: accessor 10 is SCALAR, expected VEC3");
    EXPECT_EQ(faultWith(R"("material":0)", R"("material":1)"),
              "bad.glb: meshes[0].primitives[0]: material 1, but there are only 1");
    EXPECT_EQ(faultWith(R"("indices":5)", R"("indices":5,"mode":9)"),
              "bad.glb: meshes[0].primitives[0]: mode 9, expected 0 to 6");
    EXPECT_EQ(faultWith(R"("weights":[0.5])", R"("weights":[0.5,1])"),
              "bad.glb: meshes[0].weights: 2 weights, but there are 1 morph targets");
    EXPECT_EQ(faultWith(R"(,"WEIGHTS_0":4)", ""),
              "bad.glb: meshes[0].primitives[0].attributes: JOINTS_0 without WEIGHTS_0");
}

TEST(GltfBadInput, NodeTree) {
    const std::string head = R"({"asset":{"version":"2.0"},"nodes":[)";
    EXPECT_EQ(faultOfText(head + R"({"children":[1]},{"children":[2]},{"children":[1]}]})"),
              "bad.glb: nodes[1]: is a child of nodes[0] and of nodes[2]");
    EXPECT_EQ(faultOfText(head + R"({},{"children":[2]},{"children":[1]}]})"),
              "bad.glb: nodes[1]: is its own ancestor or hangs from one that is (a cycle in the node tree)");
    EXPECT_EQ(faultOfText(head + R"({"children":[0]}]})"),
              "bad.glb: nodes[0]: is its own ancestor or hangs from one that is (a cycle in the node tree)");
    EXPECT_EQ(faultOfText(head + R"({"children":[5]}]})"),
              "bad.glb: nodes[0].children[0]: node 5, but there are only 1");
    EXPECT_EQ(faultOfText(head + R"({"rotation":[0,0,0,0]}]})"),
              "bad.glb: nodes[0]: rotation: a quaternion of length 0");
    // A chain of 200,000 nodes is no error, and no recursion either.
    std::string chain = head;
    for (int i = 1; i < 200000; ++i) chain += fmt::format(R"({{"children":[{}]}},)", i);
    EXPECT_EQ(faultOfText(chain + "{}]}"), "no error");
}

TEST(GltfBadInput, Skin) {
    EXPECT_EQ(faultWith(R"("joints":[1,2])", R"("joints":[1])"),
              "bad.glb: nodes[0]: skin 0 has 1 joints, but meshes[0].primitives[0] uses joint 1");
    EXPECT_EQ(faultWith(R"("joints":[1,2])", R"("joints":[1,9])"),
              "bad.glb: skins[0].joints[1]: node 9, but there are only 4");
    EXPECT_EQ(faultWith(R"("joints":[1,2])", R"("joints":[1,2,3])"),
              "bad.glb: skins[0].inverseBindMatrices: 2 matrices, but there are 3 joints");
    EXPECT_EQ(faultWith(R"("joints":[1,2])", R"("joints":[])"), "bad.glb: skins[0]: no joints");
    EXPECT_EQ(faultWithFloat(7, 3, std::numeric_limits<float>::quiet_NaN()),
              "bad.glb: skins[0].inverseBindMatrices: matrix 0 is not finite");
}

TEST(GltfBadInput, Images) {
    GltfBuilder b = skinnedQuad({'n', 'o', 't', ' ', 'a', ' ', 'p', 'n', 'g', '!', '!', '!'});
    EXPECT_EQ(fault(b.glb()).find("bad.glb: images[0]: "), 0u) << fault(b.glb());
    std::vector<std::uint8_t> cut(smallPng().begin(), smallPng().begin() + 50);
    EXPECT_EQ(fault(skinnedQuad(cut).glb()).find("bad.glb: images[0]: "), 0u) << fault(skinnedQuad(cut).glb());
    EXPECT_EQ(faultWith(R"({"bufferView":11,"mimeType":"image/png"})", R"({"uri":"a.png"})"),
              "bad.glb: images[0]: uri \"a.png\": there is no folder to look in");
    EXPECT_EQ(faultWith(R"({"bufferView":11,"mimeType":"image/png"})", R"({"uri":"data:image/png;base64,?"})")
                  .find("bad.glb: images[0]: uri: "),
              0u);
    EXPECT_EQ(faultWith(R"("source":0)", R"("source":2)"), "bad.glb: textures[0]: source 2, but there are only 1");
}

TEST(GltfBadInput, Animation) {
    EXPECT_EQ(faultWithFloat(8, 0, 3),
              "bad.glb: animations[0].samplers[0].input: key 1 is at 1 s, before the one at 3 s");
    EXPECT_EQ(faultWithFloat(8, 1, std::numeric_limits<float>::quiet_NaN()),
              "bad.glb: animations[0].samplers[0].input: key 1 is at nan s, expected a finite time");
    EXPECT_EQ(faultWithFloat(9, 3, 0), "bad.glb: animations[0].samplers[0].output: key 0 is a quaternion of length 0");
    EXPECT_EQ(faultWith(R"("path":"rotation")", R"("path":"translation")"),
              "bad.glb: animations[0].samplers[0].output: 4 numbers an element, expected 3");
    EXPECT_EQ(faultWith(R"("interpolation":"STEP")", R"("interpolation":"CUBICSPLINE")"),
              "bad.glb: animations[0].samplers[1].output: 2 numbers, but 2 keys need 6");
    EXPECT_EQ(faultWith(R"({"sampler":1,)", R"({"sampler":2,)"),
              "bad.glb: animations[0].channels[1]: sampler 2, but there are only 2");
}

TEST(GltfBadInput, RequiredExtensionsAreNamed) {
    for (const char* name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_texture_basisu",
                             "EXT_texture_webp", "ACME_unheard_of"}) {
        GltfBuilder b = skinnedQuad(smallPng());
        b.more = fmt::format(R"(,"extensionsUsed":["{0}"],"extensionsRequired":["{0}"])", name);
        const std::string message = fault(b.glb());
        EXPECT_EQ(message.find(fmt::format("bad.glb: extensionsRequired[0]: the file needs the extension {}", name)),
                  0u)
            << message;
        EXPECT_NE(message.find("not supported"), std::string::npos);
    }
    GltfBuilder fine = skinnedQuad(smallPng());
    fine.more = R"(,"extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
    EXPECT_EQ(fault(fine.glb()), "no error");
}

TEST(GltfBadInput, Files) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "shoal_gltf_bad_input";
    std::filesystem::create_directories(folder / "folder.glb");
    const auto message = [&](const char* name) {
        const Result<Model> model = io::readModel(folder / name);
        return model ? std::string("no error") : model.error().message;
    };
    EXPECT_NE(message("missing.glb").find("missing.glb"), std::string::npos);
    EXPECT_NE(message("folder.glb").find("folder.glb"), std::string::npos);
    EXPECT_NE(message("scene.xyz").find("unknown model format \".xyz\""), std::string::npos);
    std::ofstream(folder / "lost.gltf")
        << R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"lost.bin"}]})";
    EXPECT_NE(message("lost.gltf").find("buffers[0]: "), std::string::npos) << message("lost.gltf");
    EXPECT_NE(message("lost.gltf").find("lost.bin"), std::string::npos);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace shoal
