#include <gtest/gtest.h>
#include <shoal/light/lights.h>
#include <shoal/light/media.h>

namespace shoal::light {
namespace {

TEST(Lights, PointFallsOffWithTheSquare) {
    PunctualLight light;
    light.position = {1, 2, 3};
    light.intensity = {8, 4, 2};
    const Vec3 e = irradianceAt(light, {1, 4, 3});
    EXPECT_FLOAT_EQ(e.x, 2);
    EXPECT_FLOAT_EQ(e.y, 1);
    EXPECT_FLOAT_EQ(e.z, 0.5f);
}

TEST(Lights, RadiusBoundsTheBrightness) {
    PunctualLight light;
    light.radius = 0.5f;
    EXPECT_FLOAT_EQ(irradianceAt(light, {0.1f, 0, 0}).x, 4);
    EXPECT_FLOAT_EQ(irradianceAt(light, light.position).x, 4);
}

TEST(Lights, RangeEndsTheLight) {
    PunctualLight light;
    light.range = 10;
    EXPECT_EQ(irradianceAt(light, {0, 0, 10}).x, 0);
    EXPECT_EQ(irradianceAt(light, {0, 0, 25}).x, 0);
    EXPECT_NEAR(irradianceAt(light, {0, 0, 5}).x, (1 - 1.0 / 16) / 25, 1e-6);
}

TEST(Lights, SpotShinesInsideItsCone) {
    PunctualLight light;
    light.kind = PunctualLight::Kind::spot;
    light.innerCone = radians(20);
    light.outerCone = radians(30);
    const auto at = [&](float degreesOff) {
        const float a = radians(degreesOff);
        return irradianceAt(light, {2 * std::sin(a), -2 * std::cos(a), 0}).x;
    };
    EXPECT_FLOAT_EQ(at(0), 0.25f);
    EXPECT_FLOAT_EQ(at(19.9f), 0.25f);
    EXPECT_GT(at(25), 0.0f);
    EXPECT_LT(at(25), 0.25f);
    EXPECT_EQ(at(30.1f), 0);
    EXPECT_EQ(at(180), 0);
}

// The definition of a phase function and of g, integrated over the sphere.
TEST(Media, HenyeyGreensteinIsNormalisedWithMeanCosineG) {
    for (const float g : {-0.7f, -0.2f, 0.0f, 0.5f, 0.9f}) {
        const int count = 200000;
        double sum = 0, mean = 0;
        for (int i = 0; i < count; ++i) {
            const double cosine = -1 + 2 * (i + 0.5) / count;
            const double weight = double(henyeyGreenstein(float(cosine), g)) * 2 * kPiD * 2 / count;
            sum += weight;
            mean += weight * cosine;
        }
        EXPECT_NEAR(sum, 1, 2e-4) << "g " << g;
        EXPECT_NEAR(mean, double(g), 2e-4) << "g " << g;
    }
}

TEST(Media, TransmittanceIsBeersLaw) {
    const Medium medium{{0.1f, 0.2f, 0}, {0.3f, 0, 0}, 0};
    const Vec3 t = transmittance(medium, 5);
    EXPECT_NEAR(t.x, std::exp(-2.0), 1e-6);
    EXPECT_NEAR(t.y, std::exp(-1.0), 1e-6);
    EXPECT_EQ(t.z, 1);
}

}  // namespace
}  // namespace shoal::light
