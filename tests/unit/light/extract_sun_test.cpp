#include <gtest/gtest.h>
#include <shoal/light/environment.h>

namespace shoal::light {
namespace {

Environment skyWith(int height, float level) {
    Environment e;
    e.radiance = Image(2 * height, height, 3);
    std::fill(e.radiance.pixels.begin(), e.radiance.pixels.end(), level);
    return e;
}

// Brightest in its middle, by a hundredth, so that it is clear where extraction starts.
void addDisc(Environment& e, Vec3 toSun, float radius, Vec3 radiance) {
    for (int y = 0; y < e.radiance.height; ++y)
        for (int x = 0; x < e.radiance.width; ++x) {
            const float away = length(directionOfTexel(e, x, y) - toSun) / radius;
            if (away > 1) continue;
            float* p = e.radiance.at(x, y);
            const float value = 1.01f - 0.01f * away;
            p[0] = radiance.x * value, p[1] = radiance.y * value, p[2] = radiance.z * value;
        }
}

// A lamp of 7 degrees by 1.
void addTube(Environment& e, Vec3 middle, float radiance) {
    const Vec3 along = normalize(cross(middle, Vec3{0, 1, 0})), across = cross(middle, along);
    for (int y = 0; y < e.radiance.height; ++y)
        for (int x = 0; x < e.radiance.width; ++x) {
            const Vec3 d = directionOfTexel(e, x, y);
            const float a = std::abs(dot(d, along)), b = std::abs(dot(d, across));
            if (dot(d, middle) < 0 || a > 0.062f || b > 0.009f) continue;
            for (int k = 0; k < 3; ++k) e.radiance.at(x, y)[k] = radiance * (1.01f - 0.01f * a / 0.062f);
        }
}

// Irradiance of the whole map on a plane facing d (negative half included: what leaves is what counts).
std::array<double, 3> vectorIrradiance(const Environment& e, Vec3 d) {
    std::array<double, 3> sum{};
    for (int y = 0; y < e.radiance.height; ++y) {
        const double c0 = std::cos(kPiD * y / e.radiance.height), c1 = std::cos(kPiD * (y + 1) / e.radiance.height);
        for (int x = 0; x < e.radiance.width; ++x)
            for (std::size_t k = 0; k < 3; ++k)
                sum[k] += double(e.radiance.at(x, y)[k]) * double(dot(d, directionOfTexel(e, x, y))) * (c0 - c1) * 2 *
                          kPiD / e.radiance.width;
    }
    return sum;
}

TEST(ExtractSun, WhatLeavesTheMapIsTheSun) {
    for (const int height : {64, 256}) {
        Environment e = skyWith(height, 0.5f);
        e.rotation = 0.8f;
        const Vec3 toSun = normalize(Vec3{0.5f, 0.4f, -0.7f});
        addDisc(e, toSun, std::max(0.02f, 1.0f * kPi / float(height)), {5000, 4000, 3000});
        const Environment before = e;
        const std::optional<Sun> sun = extractSun(e);
        ASSERT_TRUE(sun.has_value());
        EXPECT_GT(dot(sun->toSun, toSun), std::cos(0.7f * kPi / float(height)));
        const auto had = vectorIrradiance(before, sun->toSun), has = vectorIrradiance(e, sun->toSun);
        const double expected[3] = {had[0] - has[0], had[1] - has[1], had[2] - has[2]};
        EXPECT_NEAR(sun->irradiance.x, expected[0], 1e-4 * expected[0]);
        EXPECT_NEAR(sun->irradiance.y, expected[1], 1e-4 * expected[1]);
        EXPECT_NEAR(sun->irradiance.z, expected[2], 1e-4 * expected[2]);
        for (const float v : e.radiance.pixels) EXPECT_FLOAT_EQ(v, 0.5f);  // the surroundings again
        EXPECT_FALSE(extractSun(e).has_value());
    }
}

TEST(ExtractSun, FindsASunAcrossTheSeamAndAtThePole) {
    for (const Vec3 toSun : {Vec3{0, 0.1f, 1}, Vec3{0, 1, 0}}) {
        Environment e = skyWith(128, 1);
        addDisc(e, normalize(toSun), 0.03f, {9000, 9000, 9000});
        const std::optional<Sun> sun = extractSun(e);
        ASSERT_TRUE(sun.has_value());
        EXPECT_GT(dot(sun->toSun, normalize(toSun)), 0.9998f);
    }
}

TEST(ExtractSun, LeavesMapsWithoutASunAlone) {
    const Vec3 up = normalize(Vec3{0.2f, 0.7f, 0.1f});
    Environment even = skyWith(128, 1), dark = skyWith(128, 0), cloud = skyWith(256, 0.2f), lamp = skyWith(128, 0.1f);
    Environment street = skyWith(256, 1), tube = skyWith(512, 1);
    addDisc(cloud, up, 0.4f, {1, 1, 1});
    addDisc(cloud, up, 0.04f, {18.5f, 18.5f, 18.5f});  // compact, much of the light, but no sun
    addDisc(lamp, up, 0.12f, {3000, 3000, 3000});      // as bright as one, but 7 degrees wide
    addDisc(street, up, 0.008f, {30, 30, 30});         // compact, but too little light
    addTube(tube, up, 1000);                           // bright and thin, but long
    for (Environment* e : {&even, &dark, &cloud, &lamp, &street, &tube}) {
        const std::vector<float> before = e->radiance.pixels;
        EXPECT_FALSE(extractSun(*e).has_value());
        EXPECT_EQ(before, e->radiance.pixels);
    }
    Environment none;
    EXPECT_FALSE(extractSun(none).has_value());
}

}  // namespace
}  // namespace shoal::light
