#include <gtest/gtest.h>
#include <shoal/water/optics.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "water/optics/phase.h"

namespace shoal::water {
namespace {

Optics resolved(const OpticsParams& params) {
    const auto optics = resolveOptics(params);
    EXPECT_TRUE(optics) << (optics ? "" : optics.error().message);
    return optics ? *optics : Optics{};
}

std::string whyNot(const OpticsParams& params) {
    const auto optics = resolveOptics(params);
    return optics ? "" : optics.error().message;
}

// Over the sphere: both halves by midpoints in the logarithm of sin^2 of half the angle to their pole, near which the
// function is flat.
double overSphere(const Optics& optics, int cosinePower) {
    const int steps = 20000;
    const double low = std::log(1e-12), high = std::log(0.5), width = (high - low) / steps;
    double sum = 0;
    for (const double sign : {1.0, -1.0}) {
        const auto at = [&](double sine2) {
            const double cosine = sign * (1 - 2 * sine2);
            return double(phaseFunction(optics, float(cosine))) * std::pow(cosine, cosinePower);
        };
        for (int i = 0; i < steps; ++i) {
            const double sine2 = std::exp(low + width * (i + 0.5));
            sum += at(sine2) * sine2 * width;
        }
        sum += at(0) * 1e-12;
    }
    return 4 * kPiD * sum;
}

TEST(Fresnel, GivesThePublishedTransmittance) {
    const double table[][2] = {{0, .979627},  {10, .979616}, {20, .979445}, {30, .978564}, {40, .975498}, {45, .972102},
                               {50, .966332}, {60, .940309}, {70, .866525}, {80, .652083}, {85, .416477}};
    for (const auto& row : table)
        EXPECT_NEAR(fresnelTransmittance(std::cos(row[0] * kPiD / 180), 1.333), row[1], 6e-7) << row[0];
    EXPECT_EQ(fresnelTransmittance(0, 1.333), 0);
}

TEST(Fresnel, IsTheSameFromBothSidesAndTotalBeyondTheCriticalAngle) {
    for (double degrees = 0; degrees < 89; degrees += 3.7) {
        const double sine = std::sin(degrees * kPiD / 180), inside = std::sqrt(1 - sine * sine / (1.333 * 1.333));
        EXPECT_NEAR(fresnelTransmittance(std::cos(degrees * kPiD / 180), 1.333),
                    fresnelTransmittance(inside, 1 / 1.333), 1e-12);
    }
    const double critical = 48.606626 * kPiD / 180;
    EXPECT_GT(fresnelTransmittance(std::cos(critical - 1e-4), 1 / 1.333), 0.01);
    EXPECT_EQ(fresnelTransmittance(std::cos(critical + 1e-4), 1 / 1.333), 0);
}

TEST(Media, AbsorbNoMoreThanTheyAttenuate) {
    ASSERT_EQ(namedMedia().size(), 12u);
    for (const NamedMedium& m : namedMedia()) {
        OpticsParams params;
        params.medium = m.name;
        const Optics o = resolved(params);
        for (const auto& [a, kd] : {std::pair{o.absorption.x, o.diffuseAttenuation.x},
                                    {o.absorption.y, o.diffuseAttenuation.y},
                                    {o.absorption.z, o.diffuseAttenuation.z}}) {
            EXPECT_LE(a, kd) << m.name;
            // Kd between absorption and the loss of the beam: every photon that goes on forwards still counts.
            const Vec3 c = o.absorption + o.scattering;
            EXPECT_LE(kd, std::max({c.x, c.y, c.z}) * 3.5f) << m.name;
        }
        EXPECT_GT(std::string(m.source).size(), 10u);
    }
}

TEST(Media, TabulatedRedOfTwoTypesIsAboveKd) {
    // The published red of 3C and 5C, which is why ours differs (docs/decisions/0008-jerlov-outliers.md).
    for (const auto& [name, published] : {std::pair{"jerlov-3C", .508f}, {"jerlov-5C", 4.638f}})
        for (const NamedMedium& m : namedMedia())
            if (std::string(name) == m.name) {
                EXPECT_GT(published, m.diffuseAttenuation.x);
                EXPECT_NE(published, m.absorption.x);
                OpticsParams params;
                params.absorption = {published, -1, -1};
                params.diffuseAttenuation = m.diffuseAttenuation;
                EXPECT_NE(whyNot(params).find("diffuseAttenuation"), std::string::npos);
            }
}

TEST(Media, KdIsJerlovsTable) {
    const std::filesystem::path path = std::filesystem::path(SHOAL_DATA_DIR) / "water" / "jerlov1976_Kd.csv";
    std::ifstream file(path);
    if (!file) GTEST_SKIP() << "no " << path;
    std::map<int, std::vector<double>> rows;
    std::vector<std::string> names;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::istringstream cells(line);
        std::vector<std::string> words;
        for (std::string word; std::getline(cells, word, ',');) words.push_back(word);
        if (names.empty()) {
            names = words;
            continue;
        }
        for (std::size_t i = 1; i < words.size(); ++i) rows[std::stoi(words[0])].push_back(std::stod(words[i]));
    }
    ASSERT_EQ(names.size(), 11u);
    for (std::size_t type = 0; type < 10; ++type)
        for (const NamedMedium& m : namedMedia()) {
            if ("jerlov-" + names[type + 1] != m.name) continue;
            const auto at = [&](int low, int high, double t) {
                return rows[low][type] * (1 - t) + rows[high][type] * t;
            };
            const double red = at(625, 650, 0.6), green = at(525, 550, 0.8), blue = rows[450][type];
            // What is left of daylight from 1 to 50 m down.
            for (const double depth : {1.0, 5.0, 10.0, 50.0}) {
                EXPECT_NEAR(std::exp(-depth * double(m.diffuseAttenuation.x)) / std::exp(-depth * red), 1, 1e-4)
                    << m.name;
                EXPECT_NEAR(std::exp(-depth * double(m.diffuseAttenuation.y)) / std::exp(-depth * green), 1, 1e-4)
                    << m.name;
                EXPECT_NEAR(std::exp(-depth * double(m.diffuseAttenuation.z)) / std::exp(-depth * blue), 1, 1e-4)
                    << m.name;
            }
        }
}

TEST(Media, PureWaterIsPopeAndFrys) {
    std::ifstream file(std::filesystem::path(SHOAL_DATA_DIR) / "water" / "a_w.txt");
    if (!file) GTEST_SKIP() << "no ../shared/data/water/a_w.txt";
    const Vec3 a = namedMedia()[1].absorption;
    int found = 0;
    for (std::string line; std::getline(file, line);) {
        std::istringstream cells(line);
        double wavelength = 0, absorption = 0;
        if (!(cells >> wavelength >> absorption)) continue;
        for (const auto& [nm, ours] : {std::pair{640.0, a.x}, {545.0, a.y}, {450.0, a.z}})
            if (nm == wavelength) {
                EXPECT_NEAR(double(ours), absorption, 1e-4) << nm;
                ++found;
            }
    }
    EXPECT_EQ(found, 3);
}

TEST(Kd, OfGivenCoefficientsIsKirks) {
    OpticsParams params;
    params.absorption = {0.1f, 0.05f, 0}, params.scattering = {0.3f, 0, 0.2f};
    const Optics o = resolved(params);
    EXPECT_NEAR(o.diffuseAttenuation.x, std::sqrt(0.01 + 0.255 * 0.03), 1e-6);
    EXPECT_FLOAT_EQ(o.diffuseAttenuation.y, 0.05f);  // without scattering what is left is the beam
    EXPECT_EQ(o.diffuseAttenuation.z, 0);
    params.diffuseAttenuation = {0.2f, -1, -1};
    EXPECT_EQ(resolved(params).diffuseAttenuation.x, 0.2f);
    EXPECT_FLOAT_EQ(resolved(params).diffuseAttenuation.y, 0.05f);
}

TEST(Kd, GrowsWithTheAngleOfLight) {
    OpticsParams params;
    params.absorption = {0.1f, 0.1f, 0.1f}, params.scattering = {0, 0.3f, 2};
    const Optics o = resolved(params);
    EXPECT_EQ(diffuseAttenuationAt(o, 1), o.diffuseAttenuation);
    const double mu = 0.7602;
    const Vec3 slanted = diffuseAttenuationAt(o, mu);
    // Without scattering exp(-Kd D) is the beam's own exp(-a D / mu): no light is made up.
    EXPECT_FLOAT_EQ(slanted.x, float(0.1 / mu));
    EXPECT_GT(slanted.y, o.diffuseAttenuation.y);
    EXPECT_LT(slanted.y / o.diffuseAttenuation.y, slanted.x / o.diffuseAttenuation.x);
    EXPECT_LT(slanted.z / o.diffuseAttenuation.z, slanted.y / o.diffuseAttenuation.y);
    params.medium = "clear", params.absorption = params.scattering = {-1, -1, -1};
    EXPECT_EQ(diffuseAttenuationAt(resolved(params), 0.7), Vec3{});
}

TEST(Phase, IntegratesToOne) {
    OpticsParams params;
    for (const float forward : {-1.0f, 0.0f, 0.5f}) {
        params.forwardFraction = forward;
        params.phase = "henyey-greenstein";
        for (const float g : {-0.9f, 0.0f, 0.5f, 0.924f}) {
            params.anisotropy = g;
            if (forward > 0 && forward > g) continue;
            const Optics o = resolved(params);
            EXPECT_NEAR(overSphere(o, 0), 1, 1e-4) << "g " << g << " f " << forward;
            EXPECT_NEAR(overSphere(o, 1), double(o.anisotropy), 1e-4) << "g " << g << " f " << forward;
            // Beam and rest together go where the whole function went [Joseph et al. 1976].
            EXPECT_NEAR(o.forwardFraction + (1 - o.forwardFraction) * o.anisotropy, g, 1e-6);
        }
        params.phase = "fournier-forand";
        for (const float backscatter : {0.0001f, 0.001f, 0.0183f, 0.1f, 0.2f}) {
            params.backscatter = backscatter;
            const Optics o = resolved(params);
            EXPECT_NEAR(overSphere(o, 0), 1, 2e-3) << "B " << backscatter << " f " << forward;
            EXPECT_NEAR(overSphere(o, 1), double(o.anisotropy), 2e-3) << "B " << backscatter << " f " << forward;
        }
    }
}

TEST(Phase, FournierForandIsTheFamilyOfMobley) {
    // (n, mu, backscatter) [Mobley et al. 2002].
    const double table[][3] = {{1.021, 3.0742, .0001}, {1.040, 3.2010, .001}, {1.08, 3.483, .01}, {1.175, 4.065, .1}};
    for (const auto& row : table) {
        const FournierForand f = fournierForandOf(row[2]);
        EXPECT_NEAR(f.index, row[0], 0.003) << row[2];
        EXPECT_NEAR(f.slope, row[1], 0.015) << row[2];
        // The closed form counts what the function scatters backwards; the whole function integrates to 1.
        double back = 0;
        const int steps = 20000;
        for (int i = 0; i < steps; ++i) back += f.at(0.5 + (i + 0.5) * 0.5 / steps) * 4 * kPiD * 0.5 / steps;
        EXPECT_NEAR(back, row[2], 2e-3 * row[2]);
        EXPECT_NEAR(momentsOf(f, 0).total, 1, 1e-4);
    }
    // Particles as measured by Petzold: g 0.924 by their own integral, backscatter 0.0183.
    EXPECT_NEAR(momentsOf(fournierForandOf(0.0183), 0).meanCosine, 0.924, 0.01);
}

TEST(Phase, BeamTakesTheForwardShare) {
    OpticsParams params;
    params.absorption = {0.1f, 0.1f, 0.1f}, params.scattering = {1, 2, 3};
    params.phase = "fournier-forand", params.forwardFraction = 0.6f;
    const Optics o = resolved(params);
    EXPECT_NEAR(o.forwardFraction, 0.6f, 1e-3);
    EXPECT_NEAR(o.beamAttenuation().z, 0.1f + 3 * 0.4f, 4e-3);
    EXPECT_NEAR(o.beamScattering().y, 2 * 0.4f, 2e-3);
    // Beyond the peak the rest is the function itself.
    const FournierForand whole = fournierForandOf(0.0183);
    EXPECT_NEAR(double(phaseFunction(o, -0.5f)) * (1 - double(o.forwardFraction)), whole.at(0.75),
                1e-4 * whole.at(0.75));
    EXPECT_EQ(phaseFunction(o, 1), phaseFunction(o, 0.99999f));
}

TEST(Optics, ErrorsNameTheField) {
    OpticsParams params;
    params.absorption = {0.1f, -0.5f, 0.1f};
    EXPECT_EQ(whyNot(params), "water.absorption is -0.5 in green, expected 0 or more, or -1 for the medium's");
    params = {};
    params.medium = "mud";
    EXPECT_NE(whyNot(params).find("medium"), std::string::npos);
    params = {};
    params.forwardFraction = -0.2f;
    EXPECT_NE(whyNot(params).find("forwardFraction"), std::string::npos);
    params = {};
    params.diffuseAttenuation = {0.01f, -1, -1};  // red of type IB absorbs 0.309
    EXPECT_NE(whyNot(params).find("water.diffuseAttenuation is 0.01 in red, expected at least the absorption 0.309"),
              std::string::npos)
        << whyNot(params);
    params = {};
    params.anisotropy = -0.9f, params.forwardFraction = 0.5f;
    EXPECT_NE(whyNot(params).find("water.forwardFraction is 0.5, expected at most 0.0452261"), std::string::npos)
        << whyNot(params);
    params = {};
    params.index = NAN;
    EXPECT_NE(whyNot(params).find("index"), std::string::npos);
}

}  // namespace
}  // namespace shoal::water
