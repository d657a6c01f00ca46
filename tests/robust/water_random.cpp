// Random waves and random waters: each is refused with one line, or gives finite numbers everywhere.
#include <gtest/gtest.h>

#include <cmath>

#include <shoal/core/random.h>
#include <shoal/water/optics.h>
#include <shoal/water/waves.h>

namespace shoal::water {
namespace {

// A value of a field's own range, often one of its ends, in the logarithm where the range is wide.
class RandomFields {
public:
    explicit RandomFields(std::uint32_t seed) : seed_(seed) {}
    void operator()(float& to, const Field& f) { to = float(between(f)); }
    void operator()(Vec3& to, const Field& f) { to = {float(between(f)), float(between(f)), float(between(f))}; }
    void operator()(std::uint32_t& to, const Field&) { to = randomBits(seed_, ++asked_); }
    void operator()(std::string& to, const Field& f) {
        if (!f.choices.empty()) to = f.choices[randomBits(seed_, ++asked_) % f.choices.size()];
    }

private:
    double between(const Field& f) {
        const std::uint32_t how = randomBits(seed_, ++asked_) % 8;
        const double u = double(randomFloat(seed_, ++asked_));
        if (how == 0) return f.lowest;
        if (how == 1) return f.highest;
        if (how == 2 && f.lowest < 0 && f.highest >= 0) return f.lowest == -1 ? -1 : 0;
        const double least = std::max(f.lowest, 1e-4 * f.highest);
        if (how < 6 && least > 0) return least * std::pow(f.highest / least, u);
        return f.lowest + (f.highest - f.lowest) * u;
    }
    std::uint32_t seed_, asked_ = 0;
};

template <class Params>
Params randomParams(std::uint32_t seed) {
    Params p;
    RandomFields random(seed);
    visit(p, [&](auto& field, const Field& description) { random(field, description); });
    return p;
}

void expectOneLine(const Error& error) {
    EXPECT_FALSE(error.message.empty());
    EXPECT_EQ(error.message.find('\n'), std::string::npos) << error.message;
}

bool finite(const WaveSample& w) {
    return std::isfinite(w.h) && std::isfinite(w.hx) && std::isfinite(w.hz) && std::isfinite(w.hxx) &&
           std::isfinite(w.hxz) && std::isfinite(w.hzz);
}

TEST(RandomWater, WavesAreFiniteOrRefused) {
    int made = 0, refused = 0;
    for (std::uint32_t seed = 1; seed <= 150; ++seed) {
        WaveParams params = randomParams<WaveParams>(seed);
        std::vector<WaveComponentParams> components;
        for (std::uint32_t i = 0; i < randomBits(seed, 999) % 4; ++i) {
            components.push_back(randomParams<WaveComponentParams>(seed * 16 + i));
            if (seed % 2) components.back().amplitude = 1e-3f * randomFloat(seed, i);
        }
        std::vector<Image> maps;
        if (seed % 3) maps.assign(1 + seed % 2, Image(16, 16, 1));
        for (Image& map : maps)
            for (float& h : map.pixels) h = randomFloat(seed, std::uint32_t(&h - map.pixels.data())) * 1e-3f;
        auto field = WaveField::create(params, components, std::move(maps));
        if (!field) {
            ++refused;
            expectOneLine(field.error());
            continue;
        }
        ++made;
        const WaveBounds b = field->bounds();
        ASSERT_TRUE(std::isfinite(b.height) && std::isfinite(b.slope) && std::isfinite(b.wavelength)) << params.kind;
        for (const double time : {0.0, 1e6, -1e12, 3.3}) {
            field->setTime(time);
            for (const WaveTile& tile : field->tiles())
                for (const float value : tile.texels)
                    ASSERT_TRUE(std::isfinite(value)) << params.kind << " seed " << seed << " at " << time;
            for (std::uint32_t i = 0; i < 50; ++i) {
                const double reach = std::pow(10.0, double(i % 10) - 2);
                const double x = (2 * double(randomFloat(3, i)) - 1) * reach;
                const double z = (2 * double(randomFloat(4, i)) - 1) * reach;
                const WaveSample w = field->at(x, z);
                ASSERT_TRUE(finite(w)) << params.kind << " seed " << seed << " at " << x << ", " << z;
                EXPECT_LE(std::abs(w.h), b.height) << params.kind << " seed " << seed;
                EXPECT_LE(std::hypot(w.hx, w.hz), b.slope) << params.kind << " seed " << seed;
            }
        }
    }
    EXPECT_GT(made, 40);
    EXPECT_GT(refused, 20);
}

TEST(RandomWater, OpticsAreFiniteOrRefused) {
    int made = 0, refused = 0;
    for (std::uint32_t seed = 1; seed <= 2000; ++seed) {
        OpticsParams params = randomParams<OpticsParams>(seed);
        if (seed % 2) params.diffuseAttenuation = {-1, -1, -1};
        if (seed % 3) params.absorption = params.scattering = {-1, -1, -1};
        const auto optics = resolveOptics(params);
        if (!optics) {
            ++refused;
            expectOneLine(optics.error());
            continue;
        }
        ++made;
        for (const float cosTheta : {-1.0f, -0.5f, 0.0f, 0.9f, 0.99999f, 1.0f}) {
            const float p = phaseFunction(*optics, cosTheta);
            EXPECT_TRUE(std::isfinite(p) && p >= 0) << "seed " << seed << " at " << cosTheta << ": " << p;
        }
        const Vec3 beam = optics->beamAttenuation(), slanted = diffuseAttenuationAt(*optics, 0.67);
        for (const float v : {beam.x, beam.y, beam.z, slanted.x, slanted.y, slanted.z, optics->anisotropy})
            EXPECT_TRUE(std::isfinite(v)) << "seed " << seed;
        EXPECT_GE(std::min({beam.x, beam.y, beam.z, slanted.x, slanted.y, slanted.z}), 0.0f) << "seed " << seed;
        EXPECT_LE(optics->absorption.x, beam.x);
    }
    EXPECT_GT(made, 400);
    EXPECT_GT(refused, 100);
}

}  // namespace
}  // namespace shoal::water
