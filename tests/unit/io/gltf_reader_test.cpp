// What the glTF reader makes of right files: one small file with one of everything, then single features.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include <shoal/core/pose.h>
#include <shoal/io/model.h>

#include "unit/io/gltf_builder.h"

namespace shoal {
namespace {

using test::GltfBuilder;
using test::skinnedQuad;
using test::smallPng;

Model read(const std::vector<std::byte>& bytes, io::ModelReadOptions options = {}) {
    Result<Model> model = io::readGltf(bytes, {}, "test.glb", options);
    EXPECT_TRUE(model.has_value()) << (model ? "" : model.error().message);
    return model ? *std::move(model) : Model{};
}

// A triangle in the plane z = 0 that looks along +z; parts that a test changes are given.
GltfBuilder triangle(const std::string& moreAttributes = "", const std::string& morePrimitive = "") {
    GltfBuilder b;
    const int positions = b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3);
    b.meshes = {fmt::format(R"({{"primitives":[{{"attributes":{{"POSITION":{}{}}}{}}}]}})", positions, moreAttributes,
                            morePrimitive)};
    b.nodes = {R"({"mesh":0})"};
    return b;
}

TEST(GltfReader, ReadsOneOfEverything) {
    const Model m = read(skinnedQuad(smallPng()).glb());
    ASSERT_EQ(m.nodes.size(), 4u);
    ASSERT_EQ(m.meshes.size(), 1u);
    ASSERT_EQ(m.meshes[0].primitives.size(), 1u);
    EXPECT_EQ(m.name, "test");
    const Primitive& p = m.meshes[0].primitives[0];
    EXPECT_EQ(p.positions[2], (Vec3{1, 2, 0}));
    EXPECT_EQ(p.normals[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(p.uv0[0], (Vec2{0, 1}));
    EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(p.joints[3].x, 1);
    EXPECT_EQ(p.weights[3], (Vec4{1, 0, 0, 0}));
    EXPECT_EQ(p.morphTargets.at(0).positions[3], (Vec3{0, 0, 1}));
    EXPECT_EQ(p.bounds.lo, (Vec3{-1, 0, 0}));
    EXPECT_EQ(m.meshes[0].morphWeights, std::vector<float>{0.5f});

    const Material& cloth = m.materials.at(0);
    EXPECT_EQ(cloth.name, "cloth");
    EXPECT_EQ(cloth.metallic, 0);
    EXPECT_EQ(cloth.roughness, 1);
    EXPECT_EQ(cloth.alphaMode, AlphaMode::mask);
    EXPECT_EQ(cloth.alphaCutoff, 0.25f);
    EXPECT_TRUE(cloth.doubleSided);
    EXPECT_EQ(cloth.normalScale, 0.5f);
    EXPECT_EQ(cloth.baseColorTexture.wrapU, Wrap::clamp);
    EXPECT_EQ(cloth.baseColorTexture.wrapV, Wrap::mirror);
    EXPECT_TRUE(cloth.baseColorTexture.nearest);
    ASSERT_EQ(m.images.size(), 1u);
    EXPECT_EQ(m.images[0].width, 2);
    EXPECT_EQ(m.images[0].pixels,
              (std::vector<std::uint8_t>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255}));
    ASSERT_EQ(m.cameras.size(), 1u);
    EXPECT_EQ(m.cameras[0].verticalFov, 0.7f);
    ASSERT_EQ(m.clips.size(), 1u);
    EXPECT_EQ(m.clips[0].name, "bend");
    EXPECT_EQ(m.clips[0].duration, 1);
    ASSERT_EQ(m.clips[0].channels.size(), 2u);
    EXPECT_EQ(m.clips[0].channels[1].interpolation, Interpolation::step);
    EXPECT_EQ(m.clips[0].channels[1].target, ChannelTarget::morphWeights);
}

TEST(GltfReader, BendsTheQuad) {
    const Model m = read(skinnedQuad(smallPng()).glb());
    Pose pose;
    poseModel(m, 0, 1, false, pose);  // the upper half turned by 90 degrees about z round (0, 1, 0), morphed by z + 1
    const Bounds bounds = posedBounds(m, pose);
    EXPECT_NEAR(bounds.lo.x, -1, 1e-5);
    EXPECT_NEAR(bounds.hi.y, 2, 1e-5);
    EXPECT_NEAR(bounds.hi.x, 1, 1e-5);
    EXPECT_NEAR(bounds.hi.z, 1, 1e-5);
}

// u runs along +x, and the picture's up is +y, so the bitangent cross(n, t) * w must be +y.
TEST(GltfReader, TangentsFollowThePicture) {
    const Model m = read(skinnedQuad(smallPng()).glb());
    const Primitive& p = m.meshes[0].primitives[0];
    ASSERT_EQ(p.tangents.size(), 4u);
    for (const Vec4& t : p.tangents) {
        EXPECT_NEAR(t.x, 1, 1e-5);
        EXPECT_NEAR(t.y, 0, 1e-5);
        EXPECT_EQ(t.w, 1);
    }
}

TEST(GltfReader, MirroredTextureTurnsTheHandedness) {
    GltfBuilder b = skinnedQuad(smallPng());
    const int uv = b.floats({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2", 4);
    b.meshes[0] = test::replaced(b.meshes[0], R"("TEXCOORD_0":2)", fmt::format(R"("TEXCOORD_0":{})", uv));
    const Model m = read(b.glb());
    const Vec4 t = m.meshes[0].primitives[0].tangents.at(0);
    EXPECT_NEAR(t.x, -1, 1e-5);
    EXPECT_EQ(t.w, -1);
}

TEST(GltfReader, MakesFlatNormals) {
    GltfBuilder b;
    const int positions = b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3", 4);
    const int indices = b.accessor<std::uint32_t>({0, 1, 2, 0, 3, 1}, 5125, "SCALAR", 6);
    b.meshes = {
        fmt::format(R"({{"primitives":[{{"attributes":{{"POSITION":{}}},"indices":{}}}]}})", positions, indices)};
    b.nodes = {R"({"mesh":0})"};
    const Model m = read(b.glb());
    const Primitive& p = m.meshes[0].primitives[0];
    ASSERT_EQ(p.vertexCount(), 6u);  // the shared edge is doubled
    EXPECT_EQ(p.normals[0], (Vec3{0, 0, 1}));
    EXPECT_EQ(p.normals[3], (Vec3{0, 1, 0}));
    EXPECT_EQ(p.triangleCount(), 2u);
}

TEST(GltfReader, UnrollsStripsAndFans) {
    for (const int mode : {5, 6}) {
        GltfBuilder b;
        const int positions = b.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}, "VEC3", 4);
        const int normals = b.floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 4);
        b.meshes = {fmt::format(R"({{"primitives":[{{"attributes":{{"POSITION":{},"NORMAL":{}}},"mode":{}}}]}})",
                                positions, normals, mode)};
        b.nodes = {R"({"mesh":0})"};
        const Primitive p = read(b.glb()).meshes.at(0).primitives.at(0);
        const std::uint32_t first = mode == 5 ? 2 : 0, second = mode == 5 ? 1 : 2;
        EXPECT_EQ(p.indices, (std::vector<std::uint32_t>{0, 1, 2, first, second, 3}));
    }
}

TEST(GltfReader, SkipsPointsAndLinesWithALine) {
    std::vector<std::string> lines;
    io::ModelReadOptions options;
    options.log = [&](LogLevel, std::string_view message) { lines.emplace_back(message); };
    const Model m = read(triangle("", R"(,"mode":1)").glb(), options);
    EXPECT_TRUE(m.meshes.at(0).primitives.empty());
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0], "test.glb: meshes[0].primitives[0]: lines are not drawn");
}

TEST(GltfReader, ReadsSparseAndQuantizedAccessors) {
    GltfBuilder b = triangle();
    const int at = b.view(std::vector<std::uint8_t>{2});
    const int values = b.view(std::vector<float>{0, 5, 0});
    b.accessors[0].pop_back();
    b.accessors[0] += fmt::format(
        R"(,"sparse":{{"count":1,"indices":{{"bufferView":{},"componentType":5121}},"values":{{"bufferView":{}}}}}}})",
        at, values);
    EXPECT_EQ(read(b.glb()).meshes[0].primitives[0].positions[2], (Vec3{0, 5, 0}));

    GltfBuilder q = triangle();
    q.accessors[0] = R"({"bufferView":1,"componentType":5122,"normalized":true,"type":"VEC3","count":3})";
    q.view(std::vector<std::int16_t>{32767, 0, 0, 0, -32768, 0, 0, 0, 16384, 0});
    const Primitive p = read(q.glb()).meshes[0].primitives[0];
    EXPECT_EQ(p.positions[0].x, 1);
    EXPECT_EQ(p.positions[1].y, -1);  // -32768 / 32767 stops at -1
    EXPECT_NEAR(p.positions[2].z, 16384 / 32767.0, 1e-6);
}

TEST(GltfReader, ReadsInterleavedViewsAndAllIndexTypes) {
    GltfBuilder b = triangle();
    b.views[0] = R"({"buffer":0,"byteOffset":0,"byteLength":72,"byteStride":24})";
    b.binary.clear();
    b.views.resize(1);
    const float values[] = {0, 0, 0, 9, 9, 9, 1, 0, 0, 9, 9, 9, 0, 1, 0, 9, 9, 9};
    b.binary.resize(sizeof values);
    std::memcpy(b.binary.data(), values, sizeof values);
    EXPECT_EQ(read(b.glb()).meshes[0].primitives[0].positions[1], (Vec3{1, 0, 0}));

    const auto indexed = [](auto type, int componentType) {
        GltfBuilder t = triangle("", R"(,"indices":1)");
        t.accessor<decltype(type)>({2, 1, 0}, componentType, "SCALAR", 3);
        return read(t.glb()).meshes[0].primitives[0].positions.at(0);
    };
    EXPECT_EQ(indexed(std::uint8_t(), 5121), (Vec3{0, 1, 0}));
    EXPECT_EQ(indexed(std::uint16_t(), 5123), (Vec3{0, 1, 0}));
    EXPECT_EQ(indexed(std::uint32_t(), 5125), (Vec3{0, 1, 0}));
}

TEST(GltfReader, NormalizesWeightsAndKeepsTheStrongestFour) {
    std::vector<std::string> lines;
    io::ModelReadOptions options;
    options.log = [&](LogLevel, std::string_view message) { lines.emplace_back(message); };
    GltfBuilder b = triangle(R"(,"JOINTS_0":1,"WEIGHTS_0":2,"JOINTS_1":3,"WEIGHTS_1":4)");
    b.accessor<std::uint8_t>({0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3}, 5121, "VEC4", 3);
    b.accessor<std::uint8_t>({255, 0, 0, 0, 51, 51, 51, 51, 0, 0, 0, 0}, 5121, "VEC4", 3, R"(,"normalized":true)");
    b.accessor<std::uint16_t>({4, 0, 0, 0, 4, 0, 0, 0, 4, 0, 0, 0}, 5123, "VEC4", 3);
    b.floats({1, 0, 0, 0, 0.4f, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 3);
    const Primitive p = read(b.glb(), options).meshes[0].primitives[0];
    // Flat normals give every corner its own vertex, in order.
    EXPECT_EQ(p.joints[0], (U16Vec4{0, 4, 0, 0}));
    EXPECT_EQ(p.weights[0], (Vec4{0.5f, 0.5f, 0, 0}));
    EXPECT_EQ(p.joints[1], (U16Vec4{4, 0, 1, 2}));
    EXPECT_NEAR(p.weights[1].x, 0.4, 1e-6);
    EXPECT_NEAR(p.weights[1].x + p.weights[1].y + p.weights[1].z + p.weights[1].w, 1, 1e-6);
    EXPECT_EQ(p.weights[2], (Vec4{1, 0, 0, 0}));  // all zero: the first joint
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(), [](auto& l) { return l.find("weights are all 0") != l.npos; }));
}

TEST(GltfReader, OrdersParentsBeforeChildren) {
    GltfBuilder b = triangle();
    b.nodes = {R"({"name":"leaf","mesh":0})", R"({"name":"middle","children":[0]})",
               R"({"name":"root","children":[1]})"};
    b.scenes = R"([{"nodes":[2]}])";
    const Model m = read(b.glb());
    EXPECT_EQ(m.nodes[0].name, "root");
    EXPECT_EQ(m.nodes[2].name, "leaf");
    EXPECT_EQ(m.nodes[2].parent, 1);
    EXPECT_EQ(m.nodes[2].mesh, 0);
}

TEST(GltfReader, ShowsOnlyTheDefaultScene) {
    GltfBuilder b = triangle();
    b.nodes = {R"({"mesh":0})", R"({"mesh":0,"name":"elsewhere"})"};
    b.scenes = R"([{"nodes":[1]},{"nodes":[0]}],"scene":1)";
    const Model m = read(b.glb());
    EXPECT_EQ(m.nodes[0].mesh, 0);
    EXPECT_EQ(m.nodes[1].mesh, -1);
    EXPECT_EQ(count(m).drawnTriangles, 1u);
}

TEST(GltfReader, TakesMatricesApart) {
    GltfBuilder b = triangle();
    // 90 degrees about z, scaled by 2, 3, 4, mirrored in the first axis, moved by 5, 6, 7.
    b.nodes = {R"({"mesh":0,"matrix":[0,-2,0,0, -3,0,0,0, 0,0,4,0, 5,6,7,1]})"};
    const Node n = read(b.glb()).nodes.at(0);
    EXPECT_EQ(n.translation, (Vec3{5, 6, 7}));
    const Mat4 back = compose(n.translation, n.rotation, n.scale);
    const float expected[] = {0, -2, 0, 0, -3, 0, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1};
    for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(back.m[i], expected[i], 1e-5) << i;
    EXPECT_LT(n.scale.x, 0);
}

TEST(GltfReader, MaterialExtensions) {
    GltfBuilder b = triangle("", R"(,"material":0)");
    const int picture = b.view(smallPng());
    b.images = {fmt::format(R"({{"bufferView":{}}})", picture), R"({"uri":"never_read.png"})"};
    b.textures = {R"({"source":0})", R"({"source":1})"};
    b.materials = {R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
                   R"({"offset":[0.5,0.25],"scale":[2,3],"rotation":1,"texCoord":1}}}},"emissiveFactor":[1,0.5,0],)"
                   R"("extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4},"KHR_materials_unlit":{},)"
                   R"("KHR_materials_transmission":{"transmissionFactor":0.75},"KHR_materials_ior":{"ior":1.33}}})"};
    const Model m = read(b.glb());
    const Material& material = m.materials.at(0);
    EXPECT_EQ(material.emission, (Vec3{4, 2, 0}));
    EXPECT_TRUE(material.unlit);
    EXPECT_EQ(material.transmission, 0.75f);
    EXPECT_EQ(material.ior, 1.33f);
    EXPECT_EQ(material.baseColorTexture.offset, (Vec2{0.5f, 0.25f}));
    EXPECT_EQ(material.baseColorTexture.scale, (Vec2{2, 3}));
    EXPECT_EQ(material.baseColorTexture.rotation, 1);
    EXPECT_EQ(material.baseColorTexture.uvSet, 1);
    EXPECT_EQ(m.images.size(), 1u);  // the image no material uses is not even looked for
}

TEST(GltfReader, SpecularGlossinessBecomesMetalRough) {
    const auto material = [](const std::string& factors) {
        GltfBuilder b = triangle("", R"(,"material":0)");
        b.materials = {R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{)" + factors + "}}}"};
        return read(b.glb()).materials.at(0);
    };
    const Material plastic =
        material(R"("diffuseFactor":[0.5,0.25,0.125,0.5],"specularFactor":[0.04,0.04,0.04],"glossinessFactor":0.25)");
    EXPECT_EQ(plastic.metallic, 0);
    EXPECT_EQ(plastic.roughness, 0.75f);
    EXPECT_NEAR(plastic.baseColor.x, 0.5, 1e-4);
    EXPECT_NEAR(plastic.baseColor.z, 0.125, 1e-4);
    EXPECT_EQ(plastic.baseColor.w, 0.5f);
    const Material gold = material(R"("diffuseFactor":[0,0,0,1],"specularFactor":[1,0.8,0.3])");
    EXPECT_NEAR(gold.metallic, 1, 1e-4);
    EXPECT_NEAR(gold.baseColor.y, 0.8, 1e-3);
}

TEST(GltfReader, LightsBecomeRadiometric) {
    GltfBuilder b = triangle();
    b.nodes[0] = R"({"mesh":0,"extensions":{"KHR_lights_punctual":{"light":0}}})";
    b.more =
        R"(,"extensionsRequired":["KHR_lights_punctual"],"extensions":{"KHR_lights_punctual":{"lights":[)"
        R"({"type":"spot","intensity":683,"color":[1,0.5,0.25],"range":7,"spot":{"outerConeAngle":0.5,"innerConeAngle":0.25}}]}})";
    const Model m = read(b.glb());
    ASSERT_EQ(m.lights.size(), 1u);
    EXPECT_EQ(m.nodes[0].light, 0);
    EXPECT_EQ(m.lights[0].kind, ModelLight::Kind::spot);
    EXPECT_EQ(m.lights[0].intensity, (Vec3{1, 0.5f, 0.25f}));
    EXPECT_EQ(m.lights[0].range, 7);
    EXPECT_EQ(m.lights[0].outerCone, 0.5f);
}

TEST(GltfReader, AnimationValues) {
    GltfBuilder b = triangle();
    const int times = b.floats({0, 1, 1, 2}, "SCALAR", 4);  // the second key at 1 s goes
    const int normalized = b.accessor<std::int16_t>({0, 0, 0, 32767, 0, 0, 32767, 0, 9, 9, 9, 9, 0, 32767, 0, 0}, 5122,
                                                    "VEC4", 4, R"(,"normalized":true)");
    const int two = b.floats({0, 1}, "SCALAR", 2);
    const int cubic = b.floats({0, 0, 0, 1, 2, 3, 0, 0, 0, 0, 0, 0, 4, 5, 6, 0, 0, 0}, "VEC3", 6);
    b.animations = {fmt::format(
        R"({{"channels":[{{"sampler":0,"target":{{"node":0,"path":"rotation"}}}},{{"sampler":1,"target":{{"node":0,"path":"translation"}}}},)"
        R"({{"sampler":1,"target":{{"path":"translation"}}}},{{"sampler":1,"target":{{"node":0,"path":"weights"}}}}],)"
        R"("samplers":[{{"input":{},"output":{}}},{{"input":{},"output":{},"interpolation":"CUBICSPLINE"}}]}})",
        times, normalized, two, cubic)};
    const Clip clip = read(b.glb()).clips.at(0);
    ASSERT_EQ(clip.channels.size(), 2u);  // no node; weights of a mesh without targets
    EXPECT_EQ(clip.channels[0].times, (std::vector<float>{0, 1, 2}));
    EXPECT_EQ(clip.channels[0].values, (std::vector<float>{0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0}));
    EXPECT_EQ(clip.channels[1].values.size(), 18u);
    EXPECT_EQ(clip.channels[1].interpolation, Interpolation::cubicSpline);
    EXPECT_EQ(clip.duration, 2);
}

TEST(GltfReader, OptionsTurnScaleAndFlip) {
    const std::vector<std::byte> file = skinnedQuad(smallPng()).glb();
    io::ModelReadOptions options;
    options.up = io::UpAxis::z;
    options.scale = 0.5f;
    const Model m = read(file, options);
    ASSERT_EQ(m.nodes.size(), 5u);
    EXPECT_EQ(m.nodes[0].name, "axes and unit");
    EXPECT_EQ(m.nodes[1].parent, 0);
    Pose pose;
    poseModel(m, -1, 0, false, pose);
    const Bounds bounds =
        posedBounds(m, pose);  // x -1..1, y 0..2, z 0..0.5 turned so that z is up: y from z, z from -y
    EXPECT_NEAR(bounds.hi.x, 0.5, 1e-5);
    EXPECT_NEAR(bounds.lo.z, -1, 1e-5);
    EXPECT_NEAR(bounds.hi.z, 0, 1e-5);
    EXPECT_NEAR(bounds.hi.y, 0.25, 1e-5);  // morphed by the default weight
    options = {};
    options.flipWinding = true;
    const Model flipped = read(file, options);
    EXPECT_EQ(flipped.meshes[0].primitives[0].normals[0], (Vec3{0, 0, -1}));
    EXPECT_EQ(flipped.meshes[0].primitives[0].indices[1], 2u);
}

TEST(GltfReader, ReadsTextWithDataUrisAndExternalFiles) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "shoal_gltf_reader";
    std::filesystem::create_directories(folder);
    // 0 0 0, 1 0 0, 0 1 0 as floats.
    const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    const auto json = [](const std::string& uri) {
        return R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":36,"uri":")" + uri +
               R"("}],"bufferViews":[{"buffer":0,"byteLength":36}],"accessors":[{"bufferView":0,"componentType":5126,)"
               R"("type":"VEC3","count":3}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]})";
    };
    std::ofstream(folder / "inside.gltf") << json("data:application/octet-stream;base64," + base64);
    std::ofstream(folder / "outside.gltf") << "\xEF\xBB\xBF" << json("a%20b.bin");
    const float values[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    std::ofstream(folder / "a b.bin", std::ios::binary).write(reinterpret_cast<const char*>(values), sizeof values);
    for (const char* file : {"inside.gltf", "outside.gltf"}) {
        const Result<Model> model = io::readModel(folder / file);
        ASSERT_TRUE(model.has_value()) << model.error().message;
        EXPECT_EQ(model->meshes[0].primitives[0].positions[2], (Vec3{0, 1, 0}));
        EXPECT_EQ(model->nodes[0].mesh, 0);  // no scenes at all: everything shows
    }
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace shoal
