// Whole frames of light in water against the double-precision tracer and exact sums: what the closed forms of the other
// tests leave out.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <shoal/pipeline/pipeline.h>
#include <shoal/pipeline/water.h>

#include "support/pipeline_test.h"

namespace shoal::pipeline {
namespace {

class WaterTraced : public test::PipelineTest {
protected:
    // One AOV of a scene file's text, row 0 on top.
    Image draw(const std::string& text, const std::string& aov) {
        setScene(text);
        pipeline_->setAovs(std::vector<std::string>{aov});
        const auto drawn = pipeline_->render(requestFor(pipeline_->scene().render));
        EXPECT_TRUE(drawn) << drawn.error().message;
        auto layers = pipeline_->readAovs();
        EXPECT_TRUE(layers);
        return std::move(layers->front().image);
    }
    // The same of the scene drawn last by the tracer.
    Image inscatter(std::int64_t rays, int steps) { return traced(water::referenceInscatter, rays, steps); }
    Image caustics(std::int64_t rays) { return traced(water::referenceCaustics, rays, 1); }

private:
    template <class Trace>
    Image traced(const Trace& trace, std::int64_t rays, int steps) {
        const scene::Scene& scene = pipeline_->scene();
        const scene::Content& content = pipeline_->content();
        auto spec = readWater(scene);
        EXPECT_TRUE(spec && *spec);
        const water::WaveField waves =
            water::WaveField::create((*spec)->setup.waves, (*spec)->setup.components).value();
        water::Body body;
        body.params = (*spec)->setup.body;
        body.optics = water::resolveOptics((*spec)->setup.optics).value();
        body.waves = &waves;
        water::BodyLights lights;
        if (content.sun) lights.sun = &*content.sun;
        lights.punctual = content.lights;
        water::ReferenceOptions options;
        options.rays = rays, options.steps = steps;
        return trace(referenceScene(content, 0), body, lights, pipeline_->view(), options).value();
    }
};

// Root mean square difference of channel 1 over the mean of `exact`, and the ratio of the means.
struct Difference {
    double rmse = 0, mean = 0;
};
Difference differenceOf(const Image& found, const Image& exact) {
    double squares = 0, sum = 0, exactSum = 0;
    for (int y = 0; y < exact.height; ++y)
        for (int x = 0; x < exact.width; ++x) {
            const double a = double(found.at(x, y)[1]), b = double(exact.at(x, y)[1]);
            squares += (a - b) * (a - b), sum += a, exactSum += b;
        }
    const double count = double(exact.width) * exact.height;
    return {std::sqrt(squares / count) / (exactSum / count), sum / exactSum};
}

// An eye that looks towards the sun under level water: what light a pixel gets depends on the phase function alone.
std::string murkyScene(const std::string& phase) {
    return "environment = \"none\"\n"
           "[render]\nwidth = 96\nheight = 64\nantialiasing = \"none\"\n"
           "[camera]\nposition = [0, -5, 0]\ntarget = [2, -3.8, 0.4]\nfovDeg = 60\n"
           "[sun]\ntoSun = [0.6, 1, 0]\nirradiance = [1, 1, 1]\ndiscDeg = 0\n"
           "[[shape]]\nkind = \"plane\"\nwidth = 60\ndepth = 60\nposition = [0, -8, 0]\n"
           "[[shape]]\nkind = \"box\"\nsize = [0.2, 12, 60]\nposition = [9, -9, 0]\n"
           "[water]\nsurfaceVisible = false\nabsorption = [0.1, 0.1, 0.1]\nscattering = [0.1, 0.1, 0.1]\n"
           "diffuseAttenuation = [10, 10, 10]\nforwardFraction = 0.5\nwaves = { kind = \"flat\" }\n" +
           phase + "[water.shafts]\nresolutionScale = 1\nsteps = 64\n";
}

TEST_F(WaterTraced, FournierForandScattersAsTraced) {
    const std::string fournierForand = "phase = \"fournier-forand\"\nbackscatter = 0.03\n";
    const Image found = draw(murkyScene(fournierForand), "inscatter");
    const Image exact = inscatter(200'000, 256);
    const Difference d = differenceOf(found, exact);
    RecordProperty("rmse", std::to_string(d.rmse));
    EXPECT_LT(d.rmse, 0.03);  // measured .022
    EXPECT_NEAR(d.mean, 1, 0.015);
    // The control: Henyey-Greenstein's light, as much in all, is another.
    const Image other = draw(murkyScene("phase = \"henyey-greenstein\"\nanisotropy = 0.9\n"), "inscatter");
    EXPECT_GT(differenceOf(other, exact).rmse, 0.15);
}

// A spot in the water, seen from aside, and a plate that stands half in its cone.
std::string spotScene(bool castsShadow) {
    return std::string(
               "environment = \"none\"\n"
               "[render]\nwidth = 160\nheight = 96\nantialiasing = \"none\"\n"
               "[camera]\nposition = [0, -4, 6]\ntarget = [0, -4, 0]\nfovDeg = 50\n"
               "[[shape]]\nkind = \"box\"\nsize = [60, 60, 0.2]\nposition = [0, -40, -4]\n"
               "[[shape]]\nkind = \"box\"\nsize = [0.1, 1.5, 2.4]\nposition = [-3, -3.8, 0]\n"
               "[[light]]\nkind = \"spot\"\nposition = [-7, -4, 0]\ntarget = [3, -4, 0]\n"
               "intensity = [60, 60, 60]\ninnerDeg = 12\nouterDeg = 16\nradius = 0.02\ncastsShadow = ") +
           (castsShadow ? "true" : "false") +
           "\n[water]\nlevel = 0\nsurfaceVisible = false\nabsorption = [0.1, 0.1, 0.1]\nscattering = [0.1, 0.1, 0.1]\n"
           "diffuseAttenuation = [10, 10, 10]\nanisotropy = 0.5\nforwardFraction = 0\nwaves = { kind = \"flat\" }\n"
           "[water.shafts]\nresolutionScale = 1\nsteps = 64\n";
}

TEST_F(WaterTraced, SpotsInTheWaterAreCutByWhatStandsInThem) {
    const Image found = draw(spotScene(true), "inscatter");
    const Image exact = inscatter(1000, 512);
    const Difference d = differenceOf(found, exact);
    RecordProperty("rmse", std::to_string(d.rmse));
    EXPECT_LT(d.rmse, 0.12);  // measured .087, all of it at edges
    EXPECT_NEAR(d.mean, 1, 0.03);
    // The control: a spot without shadows lights the water behind the plate too.
    const Difference open = differenceOf(draw(spotScene(false), "inscatter"), exact);
    EXPECT_GT(open.rmse, 0.3);
    EXPECT_GT(open.mean, 1.2);
}

constexpr double kSlope = 0.4;  // of the ceiling: metres up a metre along x
constexpr double kCeiling = 2.5;
std::string ceilingScene(double degrees) {
    return "environment = \"none\"\n"
           "[render]\nwidth = 256\nheight = 64\nantialiasing = \"none\"\n"
           "[camera]\nprojection = \"orthographic\"\nposition = [0, -1, 0]\ntarget = [0, 2, 0]\nup = [0, 0, -1]\n"
           "heightM = 1\n"
           "[sun]\ntoSun = [1, 0.5, 0]\nirradiance = [1, 1, 1]\ndiscDeg = 0\n"
           "[[shape]]\nkind = \"plane\"\nwidth = 7\ndepth = 7\nposition = [0, 2.5, 0]\nrotationDeg = [180, 0, " +
           std::to_string(degrees) +
           "]\n"
           "[water]\nsurfaceVisible = false\nmedium = \"clear\"\n"
           "[water.caustics]\nphotons = 640000\n"
           "[water.waves]\nkind = \"sum\"\nspeed = 0\nperiodM = 1\n"
           "components = [ { amplitude = 0.0006, m = 1, q = 0, phase = 0 } ]\n";
}

// Irradiance that h = .0006 cos(2 pi x) throws up at the slanted plane y = 2.5 + slope x, by pixels of 1/64 m from
// x = -2 on: rays by their hundred thousands, each of which lands where plane and ray meet.
std::vector<double> reflectedOnto(double slope, int pixels) {
    std::vector<double> bins(std::size_t(pixels), 0.0);
    const double norm = std::sqrt(1.25), sunX = 1 / norm, sunY = 0.5 / norm, width = 4.0 / pixels;
    constexpr int kRays = 2'000'000;
    constexpr double kFrom = -5, kTo = 20, kStep = (kTo - kFrom) / kRays;
    for (int i = 0; i < kRays; ++i) {
        const double x = kFrom + (i + 0.5) * kStep, h = 0.0006 * std::cos(2 * kPiD * x),
                     hx = -0.0006 * 2 * kPiD * std::sin(2 * kPiD * x), slant = std::sqrt(1 + hx * hx);
        const double cosIn = (sunY - sunX * hx) / slant;
        if (cosIn <= 0) continue;
        const double nx = -hx / slant, ny = 1 / slant;
        const double rx = -sunX + 2 * cosIn * nx, ry = -sunY + 2 * cosIn * ny;
        const double flux = cosIn * slant * (1 - water::fresnelTransmittance(cosIn, water::kWaterIndex));
        // h + t ry = 2.5 + slope (x + t rx)
        const double t = (kCeiling + slope * x - h) / (ry - slope * rx), at = (x + t * rx + 2) / width;
        if (at < 0 || at >= pixels) continue;
        bins[std::size_t(at)] += flux * kStep / (width * std::sqrt(1 + slope * slope));
    }
    return bins;
}

TEST_F(WaterTraced, ReflectedLightOnASlantedCeiling) {
    const Image found = draw(ceilingScene(std::atan(kSlope) * 180 / kPiD), "caustics");
    // What the eye sees where: image right may be either way along x.
    const bool mirrored = pipeline_->view().worldFromView(0, 0) < 0;
    const auto errorFrom = [&](const std::vector<double>& exact) {
        double squares = 0, sum = 0, exactSum = 0;
        for (int x = 0; x < found.width; ++x) {
            double column = 0;
            for (int y = 0; y < found.height; ++y) column += double(found.at(x, y)[1]) / found.height;
            const double e = exact[std::size_t(mirrored ? found.width - 1 - x : x)];
            squares += (column - e) * (column - e), sum += column, exactSum += e;
        }
        return std::pair{std::sqrt(squares / found.width) / (exactSum / found.width), sum / exactSum};
    };
    const auto [rmse, mean] = errorFrom(reflectedOnto(kSlope, found.width));
    RecordProperty("rmse", std::to_string(rmse));
    EXPECT_LT(rmse, 0.05);  // measured .044
    EXPECT_NEAR(mean, 1, 0.01);
    // The controls: a level ceiling and one that slants the other way get other light.
    EXPECT_GT(errorFrom(reflectedOnto(0, found.width)).first, 0.2);
    EXPECT_GT(errorFrom(reflectedOnto(-0.1, found.width)).first, 0.2);
}

// A floor seen from above, bent light on it, and a ball of 1.2 m that floats two metres over it.
std::string shadowScene(int photons) {
    return "environment = \"none\"\n"
           "[render]\nwidth = 64\nheight = 64\nantialiasing = \"none\"\n"
           "[camera]\nprojection = \"orthographic\"\nposition = [0.4, -2.9, 0.2]\ntarget = [0.4, -4, 0.2]\n"
           "up = [0, 0, -1]\nheightM = 4\n"
           "[sun]\ntoSun = [0.2, 1, 0.1]\nirradiance = [1, 1, 1]\n"
           "[[shape]]\nkind = \"plane\"\nwidth = 30\ndepth = 30\nposition = [0, -4, 0]\n"
           "[[shape]]\nkind = \"sphere\"\nradius = 0.6\nposition = [0.8, -2.0, 0.4]\n"
           "[water]\nsurfaceVisible = false\nmedium = \"clear\"\n"
           "[water.waves]\nkind = \"sum\"\nspeed = 0\nperiodM = 4\n"
           "components = [ { amplitude = 0.08, m = 1, q = 1, phase = 0.7 }, { amplitude = 0.05, m = 2, q = -1, phase = "
           "2 } ]\n"
           "[water.caustics]\nphotons = " +
           std::to_string(photons) + "\n";
}

TEST_F(WaterTraced, EdgesOfShadowsAreFinerThanPhotons) {
    const Image few = draw(shadowScene(6000), "caustics"), many = draw(shadowScene(1'000'000), "caustics");
    const Difference d = differenceOf(few, many), traced = differenceOf(few, caustics(8'000'000));
    RecordProperty("rmse", std::to_string(d.rmse));
    EXPECT_LT(d.rmse, 0.025);      // measured .018; .052 where photons are not parted
    EXPECT_LT(traced.rmse, 0.05);  // .044, most of it the tracer's noise; .061 where they are not
    EXPECT_NEAR(traced.mean, 1, 0.005);
}

// Murky water seen from within, a board of 60 m x 60 m three metres above it with its middle at x.
std::string roofScene(double roofX) {
    return R"(environment = "none"
[render]
width = 64
height = 36
antialiasing = "none"
[camera]
position = [0, -2, 0]
target = [10, -2, 0]
fovDeg = 40
[sun]
toSun = [0, 1, 0]
irradiance = [1, 1, 1]
[[shape]]
shape = "plane"
width = 200
depth = 200
position = [0, -8, 0]
[[shape]]
shape = "box"
size = [60, 0.2, 60]
position = [)" +
           std::to_string(roofX) + R"(, 3, 0]
[water]
surfaceVisible = false
absorption = [0.05, 0.05, 0.05]
scattering = [0.4, 0.4, 0.4]
forwardFraction = 0
waves = { kind = "flat" }
)";
}

// Smooth light in water is sunlight that the water has spread: under a roof there is none of it either.
TEST_F(WaterTraced, SmoothLightIsDarkUnderARoof) {
    const auto meanOf = [](const Image& image) {
        double sum = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) sum += double(image.at(x, y)[1]);
        return sum / (double(image.width) * image.height);
    };
    const double open = meanOf(draw(roofScene(1000), "inscatter"));
    ASSERT_GT(open, 0);
    EXPECT_LT(meanOf(draw(roofScene(0), "inscatter")), 0.02 * open);
    // The control: a roof beside the picture leaves nearly all of it.
    EXPECT_GT(meanOf(draw(roofScene(-60), "inscatter")), 0.7 * open);
}

}  // namespace
}  // namespace shoal::pipeline
