// Random words for every field of every parameter struct: each is taken in range or refused with one line, never both,
// and no struct is left with a value that validate() would not have.
#include <gtest/gtest.h>

#include <cmath>

#include <shoal/core/random.h>
#include <shoal/frame/lighting.h>
#include <shoal/frame/post.h>
#include <shoal/frame/shadows.h>
#include <shoal/scene/scene.h>

namespace shoal {
namespace {

std::string randomWords(std::uint32_t seed) {
    static const char* const kWords[] = {
        "0",       "-1",    "1e30",   "1e39",      "-1e308",       "nan",         "inf",        "-inf",
        "true",    "false", "[1, 2]", "[1, 2, 3]", "[1, 2, 3, 4]", "[nan, 0, 0]", "[]",         "[[1]]",
        "\"agx\"", "agx",   "",       " ",         "0.5",          "3.0000001",   "4294967296", "-0",
        "1e-45",   "\"",    "0x10",   "automatic", "temporal",     "point",       "\xff"};
    if (randomBits(seed, 0) % 3 == 0) {
        const double magnitude = std::pow(10.0, double(randomBits(seed, 1) % 80) - 40);
        return std::to_string((randomFloat(seed, 2) - 0.5) * magnitude);
    }
    return kWords[randomBits(seed, 3) % std::size(kWords)];
}

template <class Params>
void tryAll(const char* what) {
    std::vector<std::string> names;
    const Params defaults;
    visit(defaults, [&](const auto&, const Field& field) { names.push_back(field.name); });
    int taken = 0, refused = 0;
    for (std::uint32_t seed = 0; seed < 3000; ++seed) {
        Params params;
        const std::string& name = names[seed % names.size()];
        const std::string words = randomWords(seed * 2654435761u);
        const auto value = parseFieldValue(words);
        const Result<void> set = value ? setField(params, name, *value) : Result<void>(value.error());
        if (set) {
            ++taken;
            const auto valid = validate(params);
            EXPECT_TRUE(valid) << what << "." << name << " = " << words << ": " << valid.error().message;
        } else {
            ++refused;
            EXPECT_EQ(set.error().message.find('\n'), std::string::npos) << set.error().message;
            EXPECT_FALSE(set.error().message.empty());
        }
    }
    EXPECT_GT(taken, 50) << what;
    EXPECT_GT(refused, 50) << what;
}

TEST(RandomParams, AreTakenInRangeOrRefused) {
    tryAll<frame::ShadowParams>("shadows");
    tryAll<frame::LightingParams>("lighting");
    tryAll<frame::PostParams>("post");
    tryAll<scene::CameraSpec>("camera");
    tryAll<scene::OrbitSpec>("orbit");
    tryAll<scene::CameraKey>("path");
    tryAll<scene::SunSpec>("sun");
    tryAll<scene::LightSpec>("light");
    tryAll<scene::EnvironmentSpec>("environment");
    tryAll<scene::PlacementSpec>("placement");
    tryAll<scene::ModelSpec>("model");
    tryAll<scene::CopiesSpec>("copies");
    tryAll<scene::RenderSpec>("render");
}

}  // namespace
}  // namespace shoal
