#include <shoal/io/asset.h>

#include <cstring>

#include <gtest/gtest.h>

#include <shoal/core/hash.h>
#include <shoal/io/file.h>

#include "support/test_folder.h"

namespace shoal::io {
namespace {

using test::TestFolder;

Asset sample() {
    Asset asset;
    asset.kind = "volume-light";
    asset.formatVersion = 3;
    asset.parameters = {{"seed", "7"}, {"file", "head \xc3\xa4.nrrd"}, {"empty", ""}};
    Asset::Array floats{"f32", {2, 3}, std::vector<std::byte>(24)};
    for (std::size_t i = 0; i < floats.bytes.size(); ++i) floats.bytes[i] = std::byte(i * 11);
    asset.arrays = {
        {"irradiance", floats}, {"blocks", {"bc7", {4, 4}, std::vector<std::byte>(16)}}, {"none", {"u8", {0, 5}, {}}}};
    return asset;
}

void expectEqual(const Asset& a, const Asset& b) {
    EXPECT_EQ(a.kind, b.kind);
    EXPECT_EQ(a.formatVersion, b.formatVersion);
    EXPECT_EQ(a.parameters, b.parameters);
    ASSERT_EQ(a.arrays.size(), b.arrays.size());
    for (const auto& [name, array] : a.arrays) {
        ASSERT_TRUE(b.arrays.contains(name));
        EXPECT_EQ(array.type, b.arrays.at(name).type);
        EXPECT_EQ(array.shape, b.arrays.at(name).shape);
        EXPECT_EQ(array.bytes, b.arrays.at(name).bytes);
    }
}

TEST(AssetFile, ReadsBackWhatWasWritten) {
    const TestFolder folder;
    ASSERT_TRUE(writeAsset(folder / "a.bake", sample()));
    const auto back = readAsset(folder / "a.bake");
    ASSERT_TRUE(back) << back.error().message;
    expectEqual(*back, sample());
    ASSERT_TRUE(writeAsset(folder / "b.bake", sample()));
    EXPECT_EQ(*readFile(folder / "a.bake"), *readFile(folder / "b.bake"));
    ASSERT_TRUE(writeAsset(folder / "e.bake", Asset{}));
    const auto empty = readAsset(folder / "e.bake");
    ASSERT_TRUE(empty) << empty.error().message;
    expectEqual(*empty, Asset{});
}

TEST(AssetFile, FindsEveryFlippedBitAndEveryCut) {
    const TestFolder folder;
    ASSERT_TRUE(writeAsset(folder / "a.bake", sample()));
    const auto bytes = readFile(folder / "a.bake");
    ASSERT_TRUE(bytes);
    for (std::size_t size = 0; size < bytes->size(); ++size)
        EXPECT_FALSE(readAsset(std::span(*bytes).first(size), "a")) << size;
    for (std::size_t bit = 0; bit < bytes->size() * 8; ++bit) {
        std::vector<std::byte> damaged = *bytes;
        damaged[bit / 8] ^= std::byte(1u << (bit % 8));
        EXPECT_FALSE(readAsset(damaged, "a")) << bit;
    }
    std::vector<std::byte> longer = *bytes;
    longer.push_back(std::byte(0));
    EXPECT_NE(readAsset(longer, "a").error().message.find("follow the last chunk"), std::string::npos);
}

TEST(AssetFile, SaysWhatIsWrong) {
    const TestFolder folder;
    ASSERT_TRUE(writeFileAtomically(folder / "t.txt", "some text that is no asset"));
    EXPECT_NE(readAsset(folder / "t.txt").error().message.find("not an asset"), std::string::npos);
    EXPECT_NE(readAsset(folder / "missing").error().message.find("no such file"), std::string::npos);
    ASSERT_TRUE(writeAsset(folder / "a.bake", sample()));
    auto bytes = readFile(folder / "a.bake");
    bytes->at(8) = std::byte(9);
    EXPECT_NE(readAsset(*bytes, "a").error().message.find("version 9"), std::string::npos);
}

// A chunk whose own hash is right can still lie about its array.
TEST(AssetFile, ChecksShapesBehindValidHashes) {
    const TestFolder folder;
    Asset asset;
    asset.arrays = {{"a", {"f32", {4}, std::vector<std::byte>(16)}}};
    ASSERT_TRUE(writeAsset(folder / "a.bake", asset));
    auto bytes = readFile(folder / "a.bake");
    // From the end: hash 8, data 16, size 8, extent 8.
    const std::size_t extentAt = bytes->size() - 8 - 16 - 8 - 8;
    const std::size_t payloadSize = 4 + 1 + 4 + 3 + 4 + 8 + 8 + 16, payloadAt = bytes->size() - 8 - payloadSize;
    for (const std::uint64_t extent : {std::uint64_t(5), std::uint64_t(1) << 62, ~std::uint64_t(0)}) {
        std::memcpy(bytes->data() + extentAt, &extent, 8);
        const std::uint64_t hash = fnv1a(std::span(*bytes).subspan(payloadAt, payloadSize));
        std::memcpy(bytes->data() + bytes->size() - 8, &hash, 8);
        const auto back = readAsset(*bytes, "a");
        ASSERT_FALSE(back);
        EXPECT_NE(back.error().message.find("array \"a\""), std::string::npos) << back.error().message;
    }
}

}  // namespace
}  // namespace shoal::io
