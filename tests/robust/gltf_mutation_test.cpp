// Damaged .glb files: none crashes, hangs or takes more memory than its size allows; an error is one line that names
// it.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>

#include <shoal/core/pose.h>
#include <shoal/io/file.h>
#include <shoal/io/model.h>

#include "support/mutate.h"
#include "unit/io/gltf_builder.h"

namespace shoal {
namespace {

// Changes one digit, brace or letter of the JSON text in place, so that the container stays whole: what random bytes
// rarely do.
std::vector<std::byte> mutateJson(const std::vector<std::byte>& glb, std::uint32_t seed) {
    std::vector<std::byte> out = glb;
    std::mt19937 random(seed);
    std::uint32_t length = 0;
    std::memcpy(&length, out.data() + 12, 4);
    static constexpr char kDigits[] = "0123456789-.e";
    for (std::uint32_t change = 0, changes = 1 + random() % 3; change < changes; ++change) {
        std::size_t at = random() % length;
        const bool digit = random() % 8 != 0;
        for (std::size_t step = 0; digit && step < length; ++step, at = (at + 1) % length)
            if (out[20 + at] >= std::byte('0') && out[20 + at] <= std::byte('9')) break;
        out[20 + at] = digit ? std::byte(kDigits[random() % (sizeof kDigits - 1)]) : std::byte(random() % 95 + 32);
    }
    return out;
}

// Reads it and, where that works, uses every index of the result. Returns whether it was read.
bool survives(const std::vector<std::byte>& bytes) {
    const Result<Model> model = io::readGltf(bytes, {}, "damaged.glb");
    if (!model) {
        EXPECT_EQ(model.error().kind, ErrorKind::badInput) << model.error().message;
        EXPECT_EQ(model.error().message.rfind("damaged.glb: ", 0), 0u) << model.error().message;
        EXPECT_EQ(model.error().message.find('\n'), std::string::npos) << model.error().message;
        EXPECT_LT(model.error().message.size(), 400u) << model.error().message;
        return false;
    }
    Pose pose;
    for (int clip = -1; clip < int(model->clips.size()); ++clip) poseModel(*model, clip, 0.3f, true, pose);
    const Bounds bounds = posedBounds(*model, pose);
    EXPECT_LE(count(*model).uniqueTriangles, std::size_t(1) << 31);
    return bounds.empty() || bounds.lo.x <= bounds.hi.x || bounds.lo.x != bounds.lo.x;
}

TEST(GltfMutation, TenThousandDamagedFiles) {
    const std::vector<std::byte> good = test::skinnedQuad(test::smallPng()).glb();
    ASSERT_TRUE(survives(good));
    int readable = 0;
    for (std::uint32_t seed = 0; seed < 10000; ++seed) {
        SCOPED_TRACE(seed);
        readable += survives(seed % 2 ? mutateJson(good, seed) : test::mutate(good, seed));
        if (HasFatalFailure() || HasNonfatalFailure()) return;
    }
    // Both ways are taken: damage is found, and small damage is survived.
    EXPECT_GT(readable, 500);
    EXPECT_LT(readable, 9500);
}

TEST(GltfMutation, DamagedCharacter) {
    const std::filesystem::path path = std::filesystem::path(SHOAL_DATA_DIR) / "characters/CesiumMan.glb";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    const Result<std::vector<std::byte>> good = io::readFile(path);
    ASSERT_TRUE(good.has_value());
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        survives(seed % 2 ? mutateJson(*good, seed) : test::mutate(*good, seed));
        if (HasFatalFailure() || HasNonfatalFailure()) return;
    }
}

TEST(GltfMutation, EveryTruncation) {
    const std::vector<std::byte> good = test::skinnedQuad(test::smallPng()).glb();
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(survives({good.begin(), good.begin() + std::ptrdiff_t(size)})) << size;
}

}  // namespace
}  // namespace shoal
