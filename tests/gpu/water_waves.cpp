// The wave field on the GPU is WaveField::at; optics.lib.glsl is the optics of C++.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <shoal/core/random.h>
#include <shoal/gl/program.h>
#include <shoal/water/gpu_waves.h>
#include <shoal/water/optics.h>

#include "support/gl_device.h"
#include "support/shader_folder.h"
#include "support/water_fields.h"
#include "water/surface/water_block.h"

namespace shoal::water {
namespace {

constexpr int kCount = 4096;
const std::vector<std::pair<std::string, std::string>> kNoDefines;

constexpr const char* kAskWaves = R"(#version 450 core
#include "water/waves.io.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 8) readonly buffer Questions { vec4 questions[]; };
layout(std430, binding = 9) writeonly buffer Answers { vec4 answers[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec2 xz = questions[i].xy;
    Wave w = waveAt(xz);
    vec3 slopes = waveSlopeAt(xz);
    FilteredWave f = waveSlopeFiltered(xz, questions[i].z);
    answers[4u * i] = vec4(w.h, w.slope, w.curvature.x);
    answers[4u * i + 1u] = vec4(w.curvature.yz, slopes.xy);
    answers[4u * i + 2u] = vec4(slopes.z, waveHeightAt(xz), f.h, f.slopeVariance);
    answers[4u * i + 3u] = vec4(f.slope, 0.0, 0.0);
}
)";

constexpr const char* kAskOptics = R"(#version 450 core
#include "water/optics.lib.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = 8) readonly buffer Questions { vec4 questions[]; };
layout(std430, binding = 9) writeonly buffer Answers { vec4 answers[]; };
layout(location = 0) uniform vec4 phase;
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 q = questions[i];
    vec3 d = vec3(sqrt(1.0 - q.x * q.x), -q.x, 0.0);
    answers[4u * i] = vec4(fresnelTransmittance(q.x, 1.333), fresnelTransmittance(q.x, 1.0 / 1.333),
                           waterPhase(q.y, phase), 0.0);
    answers[4u * i + 1u] = vec4(refractedDirection(d, vec3(0.0, 1.0, 0.0), 1.333), 0.0);
}
)";

class WaterGpu : public test::GlTest {
protected:
    void SetUp() override {
        folder_.write("test/shaders/ask_waves.comp", kAskWaves);
        folder_.write("test/shaders/ask_optics.comp", kAskOptics);
        open(folder_.path());
        registerWaterShaders();
    }
    std::vector<Vec4> ask(const char* name, const std::vector<Vec4>& questions, Vec4 phase = {},
                          std::vector<std::pair<std::string, std::string>> defines = {}) {
        std::vector<Vec4> answers(questions.size() * 4);
        auto program = device().programs().get({{name}, std::move(defines), "ask"});
        EXPECT_TRUE(program) << program.error().message;
        if (!program) return answers;
        const gl::Buffer in = gl::Buffer::of(device(), std::span<const Vec4>(questions), "questions");
        const gl::Buffer out = gl::Buffer::create(device(), answers.size() * sizeof(Vec4), "answers");
        in.bindStorage(8);
        out.bindStorage(9);
        if (phase != Vec4{}) (*program)->set(0, phase);
        (*program)->dispatch(int(questions.size()));
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        out.read(0, std::as_writable_bytes(std::span(answers)));
        return answers;
    }
    test::ShaderFolder folder_;
};

std::vector<Vec4> placesWithin(float reach, float footprint) {
    std::vector<Vec4> places(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i)
        places[i] = {reach * (2 * randomFloat(5, i) - 1), reach * (2 * randomFloat(6, i) - 1), footprint, 0};
    return places;
}

// Differences over the largest value met. Curvature of tiles jumps by some percent where texels meet; a point that
// 32-bit arithmetic puts beyond such an edge is off by that.
struct Worst {
    double height = 0, slope = 0, curvature = 0, curvatureMostly = 0;  // mostly: of 999 in 1000
};

Worst compare(const WaveField& field, const std::vector<Vec4>& places, const std::vector<Vec4>& answers) {
    Worst off, largest;
    std::vector<double> curvatures;
    const auto meet = [](double& worst, double a, double b) { worst = std::max(worst, std::abs(a - b)); };
    for (std::size_t i = 0; i < places.size(); ++i) {
        const WaveSample w = field.at(double(places[i].x), double(places[i].y));
        const Vec4 *a = &answers[4 * i], *b = a + 1, *c = a + 2;
        meet(off.height, w.h, double(a->x)), meet(off.height, w.h, double(c->y));
        meet(off.slope, w.hx, double(a->y)), meet(off.slope, w.hz, double(a->z));
        meet(off.height, w.h, double(b->z));
        meet(off.slope, w.hx, double(b->w)), meet(off.slope, w.hz, double(c->x));
        double curvature = 0;
        meet(curvature, w.hxx, double(a->w)), meet(curvature, w.hxz, double(b->x)),
            meet(curvature, w.hzz, double(b->y));
        curvatures.push_back(curvature);
        meet(largest.height, w.h, 0), meet(largest.slope, w.hx, 0), meet(largest.slope, w.hz, 0);
        meet(largest.curvature, w.hxx, 0), meet(largest.curvature, w.hzz, 0);
    }
    std::sort(curvatures.begin(), curvatures.end());
    return {off.height / largest.height, off.slope / largest.slope, curvatures.back() / largest.curvature,
            curvatures[curvatures.size() * 999 / 1000] / largest.curvature};
}

TEST_F(WaterGpu, WavesAreThoseOfTheCpu) {
    for (test::NamedField& named : test::waveFields()) {
        auto made = GpuWaves::create(device());
        ASSERT_TRUE(made) << made.error().message;
        for (const double time : {0.0, 12.3}) {
            named.field.setTime(time);
            ASSERT_TRUE(made->update(named.field));
            made->bind();
            const std::vector<Vec4> places = placesWithin(named.reach, 0.0f);
            const std::vector<Vec4> answers =
                ask("test/ask_waves.comp", places, {}, time > 0 ? waveDefines(named.field) : kNoDefines);
            const Worst off = compare(named.field, places, answers);
            EXPECT_LT(off.height, 1e-5) << named.name;
            EXPECT_LT(off.slope, 1e-5) << named.name;
            EXPECT_LT(off.curvatureMostly, 3e-5) << named.name;
            EXPECT_LT(off.curvature, 0.03) << named.name;
        }
    }
}

// What is left out of a footprint is what the slopes vary by inside it: together they are the field's mean square.
TEST_F(WaterGpu, FilteredSlopesKeepTheMeanSquare) {
    for (test::NamedField& named : test::waveFields()) {
        auto made = GpuWaves::create(device());
        ASSERT_TRUE(made) << made.error().message;
        ASSERT_TRUE(made->update(named.field));
        made->bind();
        double meanSquare = 0;
        for (const float footprint : {0.0f, 0.05f, 0.5f, 5.0f, 500.0f}) {
            const std::vector<Vec4> places = placesWithin(40, footprint);
            const std::vector<Vec4> answers = ask("test/ask_waves.comp", places);
            double kept = 0, variance = 0;
            for (int i = 0; i < kCount; ++i) {
                const Vec4 &c = answers[std::size_t(4 * i + 2)], &d = answers[std::size_t(4 * i + 3)];
                kept += double(d.x * d.x + d.y * d.y) / kCount, variance += double(c.w) / kCount;
                ASSERT_GE(c.w, 0.0f);
            }
            if (footprint == 0) {
                meanSquare = kept + variance;
                EXPECT_LT(variance, 0.12 * meanSquare) << named.name;
            } else {
                EXPECT_NEAR((kept + variance) / meanSquare, 1, 0.08) << named.name << " over " << footprint << " m";
            }
            if (footprint == 500) {
                EXPECT_LT(kept, 0.01 * meanSquare) << named.name;
            }
        }
    }
}

TEST_F(WaterGpu, OpticsAreThoseOfTheCpu) {
    std::vector<Vec4> questions(kCount);
    for (std::uint32_t i = 0; i < kCount; ++i)
        questions[i] = {randomFloat(1, i), i % 4 ? 2 * randomFloat(2, i) - 1 : 1 - 1e-4f * randomFloat(3, i), 0, 0};
    for (const char* kind : {"henyey-greenstein", "fournier-forand"})
        for (const float forward : {-1.0f, 0.0f}) {
            OpticsParams params;
            params.phase = kind, params.forwardFraction = forward;
            const auto optics = resolveOptics(params);
            ASSERT_TRUE(optics) << optics.error().message;
            const std::vector<Vec4> answers = ask("test/ask_optics.comp", questions, phaseVector(*optics));
            double worst[4] = {};
            for (int i = 0; i < kCount; ++i) {
                const Vec4 q = questions[std::size_t(i)], *a = &answers[std::size_t(4 * i)];
                const double mu = double(q.x), sine2 = (1 - mu * mu) / (1.333 * 1.333);
                const double phase = double(phaseFunction(*optics, q.y));
                const auto meet = [](double& w, double x, double y) { w = std::max(w, std::abs(x - y)); };
                meet(worst[0], double(a[0].x), fresnelTransmittance(mu, 1.333));
                if (std::abs(mu - 0.6613) > 1e-3)  // the critical angle, where the curve is upright
                    meet(worst[1], double(a[0].y), fresnelTransmittance(mu, 1 / 1.333));
                meet(worst[2], double(a[0].z) / phase, 1);
                meet(worst[3], double(a[1].x), std::sqrt(sine2));
                meet(worst[3], double(a[1].y), -std::sqrt(1 - sine2));
            }
            EXPECT_LT(worst[0], 2e-6) << kind;
            EXPECT_LT(worst[1], 1e-4) << kind;
            EXPECT_LT(worst[2], 5e-4) << kind;
            EXPECT_LT(worst[3], 1e-6) << kind;
        }
}

TEST(WaterBlock, HoldsTheSunUnderWater) {
    OpticsParams params;
    params.absorption = {0.3f, 0.05f, 0.01f}, params.scattering = {0, 0, 0};
    Body body;
    body.optics = *resolveOptics(params);
    body.params.level = 2;
    light::Sun sun;
    const double zenith = kPiD / 3;
    sun.toSun = {float(std::sin(zenith)), float(std::cos(zenith)), 0};
    BodyLights lights;
    lights.sun = &sun;
    const WaterBlock block = makeWaterBlock(body, lights);
    EXPECT_EQ(block.shape.x, 2);
    EXPECT_EQ(block.shape.w, 0);
    EXPECT_NEAR(block.sunRefracted.y, -0.760207f, 1e-6f);
    EXPECT_NEAR(block.sunRefracted.x, -float(std::sin(zenith) / 1.333), 1e-6f);
    EXPECT_NEAR(block.sunRefracted.w, 0.940309f, 1e-6f);
    EXPECT_EQ(block.toSun.w, 1);
    EXPECT_FLOAT_EQ(block.beamAttenuation.w, 0.01f);
    // Nothing scatters: Kd at the sun's angle is the beam's own loss a metre of depth.
    EXPECT_NEAR(block.sunDiffuseAttenuation.x, 0.3f / 0.760207f, 1e-5f);
    EXPECT_FLOAT_EQ(block.diffuseAttenuation.x, 0.3f);

    sun.toSun = {0.6f, -0.8f, 0};
    const WaterBlock night = makeWaterBlock(body, lights);
    EXPECT_EQ(night.toSun.w, 0);
    EXPECT_EQ(night.sunIrradiance, Vec4{});
    EXPECT_EQ(night.sunRefracted.y, -1);
}

}  // namespace
}  // namespace shoal::water
