// Every model of the data set: the counts its table gives, and bounds that a walking figure can have.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>

#include <shoal/core/pose.h>
#include <shoal/io/model.h>

namespace shoal {
namespace {

struct Expected {
    const char* file;
    std::size_t drawn, unique, vertices, joints;
    std::size_t clips, materials, images, nodes;  // nodes 0: the table does not say
    float height;                                 // of the walking figure, file units; 0: not a figure
    std::size_t morphTargets = 0;
};

constexpr Expected kModels[] = {
    {"characters/CesiumMan.glb", 4672, 4672, 3273, 19, 1, 1, 1, 0, 1.5f},
    {"characters/RobotExpressive.glb", 3237, 3237, 7214, 43, 14, 3, 0, 0, 4.4f, 9},
    {"characters/kaykit/Knight.glb", 6952, 6952, 7024, 41, 76, 1, 1, 0, 2.4f},
    {"characters/kaykit/Mage.glb", 5683, 5683, 5279, 41, 76, 1, 1, 0, 2.6f},
    {"characters/kaykit/Rogue.glb", 6377, 6377, 5901, 41, 76, 1, 1, 0, 2.2f},
    {"characters/modular_women/Adventurer.gltf", 6812, 6812, 13715, 62, 24, 9, 0, 0, 1.77f},
    {"characters/modular_women/SciFi.gltf", 8038, 8038, 16140, 62, 24, 9, 0, 0, 1.79f},
    {"characters/modular_women/Soldier.gltf", 7900, 7900, 15864, 62, 24, 6, 0, 0, 1.77f},
    {"characters/modular_women/Witch.gltf", 6872, 6872, 13884, 62, 24, 6, 0, 0, 1.99f},
    {"characters/uacp/Casual2_Female.gltf", 6752, 6752, 6434, 23, 17, 6, 0, 0, 3.1f},
    {"characters/uacp/Casual2_Male.gltf", 3216, 3216, 4596, 23, 17, 6, 0, 0, 3.1f},
    {"characters/uacp/Casual_Female.gltf", 6624, 6624, 6393, 23, 17, 6, 0, 0, 3.1f},
    {"characters/uacp/Casual_Male.gltf", 6492, 6492, 6339, 23, 17, 6, 0, 0, 3.2f},
    {"characters/uacp/OldClassy_Female.gltf", 7008, 7008, 6938, 23, 17, 8, 0, 0, 3.6f},
    {"characters/uacp/Suit_Female.gltf", 6810, 6810, 6544, 23, 17, 7, 0, 0, 3.1f},
    {"characters/uacp/Suit_Male.gltf", 6518, 6518, 6389, 23, 17, 7, 0, 0, 3.2f},
    {"characters/uacp/Worker_Female.gltf", 5856, 5856, 6332, 23, 17, 7, 0, 0, 3.3f},
    {"characters/uacp/Worker_Male.gltf", 2524, 2524, 4620, 23, 17, 6, 0, 0, 3.2f},
    {"characters/valid/Asian_F_1_Casual.glb", 58724, 58724, 31836, 114, 3, 1, 2, 0, 1.67f},
    {"characters/valid/Hispanic_M_2_Casual.glb", 58724, 58724, 31897, 114, 3, 1, 2, 0, 1.75f},
    {"characters/valid/White_M_1_Casual.glb", 58724, 58724, 31897, 84, 3, 1, 2, 0, 1.78f},
    {"scenes/harbour.glb", 278885, 139517, 154800, 0, 0, 67, 1, 262, 0},
    {"scenes/sunken_ruin.glb", 328349, 197294, 146865, 0, 0, 54, 1, 285, 0},
    {"scenes/town_street.glb", 201590, 51434, 85488, 0, 0, 14, 0, 106, 0},
    {"scenes/village_square.glb", 156675, 82220, 135472, 0, 0, 26, 0, 98, 0},
    {"scenes/props/Clownfish.glb", 1530, 1530, 2329, 6, 6, 4, 0, 0, 0},
    {"scenes/props/CruiseShip.glb", 858, 858, 1599, 0, 0, 4, 0, 0, 0},
    {"scenes/props/Dock_Long.glb", 1688, 1688, 3296, 0, 0, 3, 0, 0, 0},
    {"scenes/props/Sail_ship.glb", 3938, 3938, 7442, 0, 0, 5, 0, 0, 0},
    {"scenes/props/Shark.glb", 1310, 1310, 1870, 6, 6, 4, 0, 0, 0},
    {"scenes/props/Viking_boat.glb", 1640, 1640, 3264, 0, 0, 5, 0, 0, 0},
};

// What Model promises, for every model.
void expectPromises(const Model& m) {
    for (std::size_t i = 0; i < m.nodes.size(); ++i) {
        ASSERT_LT(m.nodes[i].parent, int(i));
        ASSERT_LT(m.nodes[i].mesh, int(m.meshes.size()));
        ASSERT_LT(m.nodes[i].skin, int(m.skins.size()));
    }
    for (const ModelMesh& mesh : m.meshes)
        for (const Primitive& p : mesh.primitives) {
            const std::size_t n = p.vertexCount();
            ASSERT_EQ(p.normals.size(), n);
            for (const Vec3 normal : p.normals) ASSERT_NEAR(length(normal), 1, 1e-4);
            const bool mapped = p.material >= 0 && m.materials[std::size_t(p.material)].normalTexture.image >= 0;
            ASSERT_EQ(p.tangents.size(), mapped ? n : 0);
            for (std::size_t i = 0; i < p.tangents.size(); ++i) {
                const Vec3 t{p.tangents[i].x, p.tangents[i].y, p.tangents[i].z};
                ASSERT_NEAR(length(t), 1, 1e-4);
                ASSERT_NEAR(dot(t, p.normals[i]), 0, 1e-4);
                ASSERT_EQ(std::abs(p.tangents[i].w), 1);
            }
            for (const Vec4 w : p.weights) ASSERT_NEAR(w.x + w.y + w.z + w.w, 1, 1e-5);
            for (const std::uint32_t index : p.indices) ASSERT_LT(index, n);
        }
    for (const Clip& clip : m.clips)
        for (const Channel& channel : clip.channels) {
            for (std::size_t i = 1; i < channel.times.size(); ++i) ASSERT_LT(channel.times[i - 1], channel.times[i]);
            ASSERT_LE(channel.times.back(), clip.duration);
        }
}

int walkOf(const Model& model) {
    for (const char* name : {"Walk", "Walking", "Walking_A", "Anim_0"})
        if (const int clip = findClip(model, name); clip >= 0) return clip;
    return -1;
}

class ModelData : public testing::TestWithParam<Expected> {};

TEST_P(ModelData, IsAsItsTableSays) {
    const Expected& expected = GetParam();
    const std::filesystem::path path = std::filesystem::path(SHOAL_DATA_DIR) / expected.file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const Result<Model> model = io::readModel(path);
    ASSERT_TRUE(model.has_value()) << model.error().message;
    const ModelCounts counts = count(*model);
    EXPECT_EQ(counts.drawnTriangles, expected.drawn);
    EXPECT_EQ(counts.uniqueTriangles, expected.unique);
    EXPECT_EQ(counts.vertices, expected.vertices);
    EXPECT_EQ(counts.joints, expected.joints);
    EXPECT_EQ(counts.morphTargetSlots, expected.morphTargets);
    EXPECT_EQ(model->clips.size(), expected.clips);
    EXPECT_EQ(model->materials.size(), expected.materials);
    EXPECT_EQ(model->images.size(), expected.images);
    if (expected.nodes) {
        EXPECT_EQ(model->nodes.size(), expected.nodes);
    }
    expectPromises(*model);
    if (expected.height == 0) return;

    const int walk = walkOf(*model);
    ASSERT_GE(walk, 0);
    Pose pose;
    poseModel(*model, walk, model->clips[std::size_t(walk)].duration / 2, true, pose);
    const Bounds bounds = posedBounds(*model, pose);
    // A figure bobs by a few percent while walking; weapons of the kaykit figures reach below their feet.
    const bool armed = std::string(expected.file).find("kaykit") != std::string::npos;
    EXPECT_NEAR(bounds.hi.y, expected.height, 0.05f * expected.height);
    EXPECT_NEAR(bounds.lo.y, 0, (armed ? 0.15f : 0.04f) * expected.height);
    EXPECT_NEAR(bounds.center().x, 0, 0.25f * expected.height);
}

INSTANTIATE_TEST_SUITE_P(All, ModelData, testing::ValuesIn(kModels),
                         [](const auto& info) { return std::filesystem::path(info.param.file).stem().string(); });

// The table above misses no model.
TEST(ModelDataSet, TableHasEveryFile) {
    std::size_t found = 0;
    for (const char* folder : {"characters", "scenes"}) {
        const std::filesystem::path path = std::filesystem::path(SHOAL_DATA_DIR) / folder;
        if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
        for (const auto& entry : std::filesystem::recursive_directory_iterator(path))
            found += entry.path().extension() == ".glb" || entry.path().extension() == ".gltf";
    }
    EXPECT_EQ(found, std::size(kModels));
}

}  // namespace
}  // namespace shoal
