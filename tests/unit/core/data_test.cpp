// Particles::find, Asset::contentHash, FNV-1a and ModelCounts.
#include <shoal/core/data.h>
#include <shoal/core/hash.h>
#include <shoal/core/model.h>
#include <span>
#include <string_view>

#include <gtest/gtest.h>

namespace shoal {
namespace {

std::uint64_t hashOf(std::string_view text) { return fnv1a(std::as_bytes(std::span(text))); }

// Test vectors of draft-eastlake-fnv.
TEST(Fnv, KnownAnswers) {
    EXPECT_EQ(hashOf(""), 0xcbf29ce484222325ull);
    EXPECT_EQ(hashOf("a"), 0xaf63dc4c8601ec8cull);
    EXPECT_EQ(hashOf("foobar"), 0x85944171f73967e8ull);
}

TEST(Fnv, GoesOnFromAStart) {
    const std::string_view foo = "foo", bar = "bar";
    EXPECT_EQ(fnv1a(std::as_bytes(std::span(bar)), fnv1a(std::as_bytes(std::span(foo)))), hashOf("foobar"));
}

TEST(Particles, FindsAnAttributeByName) {
    Particles p;
    p.attributes = {{"velocity", 3, {}}, {"density", 1, {}}};
    ASSERT_NE(p.find("density"), nullptr);
    EXPECT_EQ(p.find("density"), &p.attributes[1]);
    EXPECT_EQ(p.find("Density"), nullptr);
}

Asset someAsset() {
    Asset asset;
    asset.kind = "volume-light";
    asset.parameters = {{"seed", "7"}, {"directions", "64"}};
    asset.arrays["light"] = {"u8", {2, 2}, {std::byte{1}, std::byte{2}, std::byte{3}, std::byte{4}}};
    asset.arrays["empty"] = {"f32", {0}, {}};
    return asset;
}

TEST(Asset, HashIsTheSameForTheSameContent) { EXPECT_EQ(someAsset().contentHash(), someAsset().contentHash()); }

TEST(Asset, HashChangesWithEveryPart) {
    std::vector<Asset> changed(9, someAsset());
    changed[0].kind = "volume-lighT";
    changed[1].formatVersion = 2;
    changed[2].parameters["seed"] = "8";
    changed[3].parameters["more"] = "";
    changed[4].arrays["light"].type = "u16";
    changed[5].arrays["light"].shape = {4};
    changed[6].arrays["light"].bytes[3] = std::byte{5};
    changed[7].arrays.erase("empty");
    changed[8].parameters = {{"seed", "7directions"}, {"", "64"}};
    for (std::size_t i = 0; i < changed.size(); ++i)
        EXPECT_NE(changed[i].contentHash(), someAsset().contentHash()) << "change " << i;
}

TEST(Asset, HashTellsWhereOneTextEndsAndTheNextBegins) {
    Asset a, b;
    a.parameters = {{"ab", "c"}};
    b.parameters = {{"a", "bc"}};
    EXPECT_NE(a.contentHash(), b.contentHash());
}

TEST(ModelCounts, CountsUniqueAndDrawnTriangles) {
    Model model;
    Primitive quad;
    quad.positions.resize(4);
    quad.indices = {0, 1, 2, 0, 2, 3};
    quad.morphTargets.resize(3);
    Primitive triangle;
    triangle.positions.resize(3);
    triangle.indices = {0, 1, 2};
    model.meshes = {ModelMesh{"quads", {quad, triangle}, {}}, ModelMesh{"triangle", {triangle}, {}}};
    model.nodes.resize(4);  // one without a mesh
    model.nodes[0].mesh = 0;
    model.nodes[1].mesh = 0;
    model.nodes[2].mesh = 1;
    model.skins.resize(2);
    model.skins[0].joints = {0, 1, 2};
    model.skins[1].joints = {0};
    const ModelCounts counts = count(model);
    EXPECT_EQ(counts.uniqueTriangles, 4u);
    EXPECT_EQ(counts.drawnTriangles, 7u);
    EXPECT_EQ(counts.vertices, 10u);
    EXPECT_EQ(counts.joints, 3u);
    EXPECT_EQ(counts.morphTargetSlots, 3u);
}

}  // namespace
}  // namespace shoal
