// The pure functions of light and tone give on the GPU what they give compiled by C++.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <cmath>
#include <cstring>
#include <vector>

#include <shoal/core/random.h>
#include <shoal/gl/program.h>

#include "frame/fullscreen.h"
#include "frame/glsl_compat.h"
#include "support/gl_device.h"
#include "support/shader_folder.h"

namespace shoal::frame::glsl {
#include "frame/brdf.lib.glsl"
#include "frame/tonemap.lib.glsl"
}  // namespace shoal::frame::glsl

namespace shoal::frame {
namespace {

constexpr int kCount = 4096;
constexpr int kAnswers = 10;  // vec4s a question

constexpr const char* kAskShader = R"(#version 450 core
#include "frame/brdf.lib.glsl"
#include "frame/tonemap.lib.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 3) readonly buffer Questions { vec4 questions[]; };
layout(std430, binding = 4) writeonly buffer Answers { vec4 answers[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 q = questions[i];
    vec3 d = normalize(q.xyz - 0.5);
    uint a = i * 10u;
    answers[a + 0u] = vec4(distributionGgx(q.x, q.y), visibilitySmith(q.x, q.z, q.y), pow5(q.w),
                           grazingReflectance(q.xyz * 0.04));
    answers[a + 1u] = vec4(fresnelSchlick(q.xyz, q.w, q.x), 0.0);
    answers[a + 2u] = vec4(splitSum(q.x, q.y), splitSum(q.z, q.w));
    answers[a + 3u] = vec4(specularAlbedo(q.xyz, q.w, splitSum(q.x, q.y)), specularOcclusion(q.x, q.y, q.z));
    answers[a + 4u] = vec4(interreflection(q.w, q.xyz), rangeWindow(q.x * 3.0, q.y * 4.0));
    answers[a + 5u] = vec4(spotCone(q.x, q.y * 5.0, -q.z), levelOfRoughness(q.x, 6.0),
                           roughnessOfLevel(q.y * 5.0, 6.0), 0.0);
    answers[a + 6u] = vec4(squareFromDirection(d), 0.0, 0.0);
    answers[a + 7u] = vec4(directionFromSquare(q.xy), 0.0);
    answers[a + 8u] = vec4(displayByAgx(exp2(q.xyz * 20.0 - 12.0)), agxContrast(q.w));
    answers[a + 9u] = vec4(applyLook(displayByPlain(q.xyz), q.w * 2.0, q.x * 2.0),
                           interleavedNoise(floor(q.xy * 2000.0)));
}
)";

std::vector<Vec4> answersOnCpu(Vec4 in) {
    using namespace glsl;
    const auto four = [](glsl::vec3 v, float w) { return Vec4{v.x, v.y, v.z, w}; };
    const glsl::vec3 c(in.x, in.y, in.z), d = glsl::normalize(c - 0.5f);
    const float w = in.w;
    const glsl::vec2 s0 = splitSum(c.x, c.y), s1 = splitSum(c.z, w), square = squareFromDirection(d);
    return {{distributionGgx(c.x, c.y), visibilitySmith(c.x, c.z, c.y), pow5(w), grazingReflectance(c * 0.04f)},
            four(fresnelSchlick(c, w, c.x), 0),
            {s0.x, s0.y, s1.x, s1.y},
            four(specularAlbedo(c, w, s0), specularOcclusion(c.x, c.y, c.z)),
            four(interreflection(w, c), rangeWindow(c.x * 3, c.y * 4)),
            {spotCone(c.x, c.y * 5, -c.z), levelOfRoughness(c.x, 6), roughnessOfLevel(c.y * 5, 6), 0},
            {square.x, square.y, 0, 0},
            four(directionFromSquare({c.x, c.y}), 0),
            four(displayByAgx(glsl::exp2(c * 20.0f - 12.0f)), agxContrast(w)),
            four(applyLook(displayByPlain(c), w * 2, c.x * 2),
                 interleavedNoise({std::floor(c.x * 2000), std::floor(c.y * 2000)}))};
}

class FrameLightFunctions : public test::GlTest {
protected:
    void SetUp() override {
        folder_.write("test/shaders/ask.comp", kAskShader);
        open(folder_.path());
        registerFrameShaders();
    }
    test::ShaderFolder folder_;
};

TEST_F(FrameLightFunctions, AreThoseOfTheCpu) {
    std::vector<Vec4> questions(kCount), answers(std::size_t(kCount) * kAnswers);
    for (std::uint32_t i = 0; i < kCount; ++i)
        questions[i] = {std::max(randomFloat(1, i), 1e-3f), std::max(randomFloat(2, i), 1e-3f), randomFloat(3, i),
                        randomFloat(4, i)};
    auto program = device().programs().get({{"test/ask.comp"}, {}, "ask"});
    ASSERT_TRUE(program) << program.error().message;
    const gl::Buffer in = gl::Buffer::of(device(), std::span<const Vec4>(questions), "questions");
    const gl::Buffer out = gl::Buffer::create(device(), answers.size() * sizeof(Vec4), "answers");
    in.bindStorage(3);
    out.bindStorage(4);
    (*program)->dispatch(kCount);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    out.read(0, std::as_writable_bytes(std::span(answers)));

    // Relative to the answer's size: drivers' pow and exp2 are good for some 2^-18.
    double worst[kAnswers] = {};
    for (int i = 0; i < kCount; ++i) {
        const std::vector<Vec4> expected = answersOnCpu(questions[std::size_t(i)]);
        for (int a = 0; a < kAnswers; ++a) {
            const float* e = &expected[std::size_t(a)].x;
            const float* g = &answers[std::size_t(i * kAnswers + a)].x;
            // The noise is a fraction of a number near 10^5, whose steps are 2^-7: it may wrap.
            for (int k = 0; k < (a == 9 ? 3 : 4); ++k)
                worst[a] =
                    std::max(worst[a], std::abs(double(e[k]) - double(g[k])) / std::max(1.0, std::abs(double(e[k]))));
        }
    }
    for (int a = 0; a < kAnswers; ++a) EXPECT_LT(worst[a], 1e-4) << "answer " << a;
}

}  // namespace
}  // namespace shoal::frame
