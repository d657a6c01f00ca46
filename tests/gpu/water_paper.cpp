// The paper's own method: its formulas, its buffers, and what must not happen.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <cmath>
#include <optional>

#include <shoal/frame/geometry.h>
#include <shoal/frame/targets.h>
#include <shoal/water/gpu_waves.h>
#include <shoal/water/paper.h>

#include "support/frame_scene.h"
#include "support/gl_device.h"

namespace shoal::water {
namespace {

using test::box;

light::Camera orthographicDown(float height, float fromY) {
    light::Camera camera = light::cameraLookingAt({0, fromY, 0}, {0, fromY - 1, 0}, radians(50), {0, 0, -1});
    camera.projection = light::Camera::Projection::orthographic;
    camera.heightM = height, camera.farZ = 100;
    return camera;
}

// A scene of boxes under level or wavy water, drawn as the pipeline draws it.
class Stage {
public:
    Stage(gl::Device& device, std::vector<Primitive> primitives)
        : device_(device), geometry(*frame::Geometry::create(device)), paper(*PaperMethod::create(device)),
          gpuWaves(*GpuWaves::create(device)), waves(*WaveField::create(flat())) {
        if (!primitives.empty()) {
            const frame::ModelId id = *geometry.addModel(test::modelOf(std::move(primitives)));
            frame::InstanceDesc instance;
            instance.model = id;
            EXPECT_TRUE(geometry.addInstance(instance));
        }
        sun.toSun = {0, 1, 0};
        sun.irradiance = {2, 2, 2};
        lights.sun = &sun;
        params.filter = false;
        setWaves(flat());
    }

    static WaveParams flat() {
        WaveParams p;
        p.kind = "flat";
        return p;
    }
    void setWaves(const WaveParams& p) {
        waves = *WaveField::create(p);
        ASSERT_TRUE(gpuWaves.update(waves));
        body.waves = &waves;
        body.gpuWaves = &gpuWaves;
    }

    void draw(const light::Camera& camera, int width, int height) {
        gl::setKnownState();
        const light::View view = light::makeView(camera, width, height);
        const frame::Context context = test::contextOf(device_, view, ++frame_);
        if (!targets) targets.emplace(*frame::Targets::create(device_, width, height));
        ASSERT_TRUE(targets->resize(width, height));
        geometry.update(context);
        paper.prepare(context, params, body, lights, geometry.bounds());
        for (const frame::NeededView& needed : paper.neededViews()) geometry.drawDepth(context, needed);
        targets->beginSurfaces();
        geometry.drawSurfaces(context, targets->gbuffer());
        targets->finishSurfaces(context);
        const ReceiverInputs receivers{targets->gbuffer().viewDepth, targets->gbuffer().normal};
        paper.render(context, params, body, lights, receivers, targets->gbuffer().depth);
        makeOutputs(width, height);
        paper.compose(context, params, receivers, {direct.view(), ambient.view()}, inscatter.view());
    }

    static std::vector<float> pixels(const gl::TextureView& t) { return test::readFloats(t, GL_RGBA, 4); }
    static double sumOf(const gl::TextureView& t) {
        double sum = 0;
        const std::vector<float> p = pixels(t);
        for (std::size_t i = 0; i < p.size(); i += 4) sum += p[i];
        return sum;
    }
    static double meanOf(const gl::TextureView& t) { return sumOf(t) / (double(t.width) * t.height); }

private:
    void makeOutputs(int width, int height) {
        if (direct && direct.width() == width && direct.height() == height) return;
        for (gl::Texture* texture : {&direct, &ambient, &inscatter}) {
            gl::TextureDesc desc;
            desc.format = GL_RGBA16F;
            desc.width = width, desc.height = height;
            *texture = gl::Texture::create(device_, desc);
        }
    }
    gl::Device& device_;
    std::uint32_t frame_ = 0;

public:
    frame::Geometry geometry;
    PaperMethod paper;
    GpuWaves gpuWaves;
    WaveField waves;
    std::optional<frame::Targets> targets;
    gl::Texture direct, ambient, inscatter;
    light::Sun sun;
    Body body;
    BodyLights lights;
    PaperParams params;
};

Primitive floorAt(float y, float half = 5) { return box({-half, y - 0.2f, -half}, {half, y, half}); }

WaveParams choppy() {
    WaveParams p;
    p.kind = "turbulent";
    p.amplitude = 0.08f;
    return p;
}

class WaterPaper : public test::GlTest {};

TEST(WaterPaperFormulas, PointSizeIsThePapersAtBothPlanesAndBetween) {
    PaperParams params;
    const PointSizes sizes = pointSizes(params, 0.5f, 40);
    EXPECT_NEAR(sizes.at(0.5f), 20, 1e-4);
    EXPECT_NEAR(sizes.at(40), 5, 1e-4);
    // a = 20 - 40 * 15 / 39.5, b = 0.5 * 40 * 15 / 39.5
    EXPECT_NEAR(sizes.a, 4.810127, 1e-5);
    EXPECT_NEAR(sizes.b, 7.594937, 1e-5);
    EXPECT_NEAR(sizes.at(2), 8.607595, 1e-5);
}

TEST(WaterPaperFormulas, ConfigurationsAreThoseOfSection42) {
    ASSERT_EQ(paperConfigs().size(), 4u);
    EXPECT_EQ(findPaperConfig("paper-e"), nullptr);
    const PaperConfig& c = *findPaperConfig("paper-c");
    EXPECT_EQ(4 * c.params.causticGrid * c.params.causticGrid, 1000000);
    EXPECT_EQ(4 * c.params.godrayGrid * c.params.godrayGrid, 360000);
    const PaperConfig& d = *findPaperConfig("paper-d");
    EXPECT_EQ(std::lround(d.params.godrayScale * float(d.width)), 460);
    EXPECT_EQ(std::lround(d.params.godrayScale * float(d.height)), 272);
    EXPECT_EQ(d.params.lineWidthPx, 12);
}

// 1024 photons 8 to 11 m away, none on another: each lights a square of the size that the formula says.
TEST_F(WaterPaper, PointsCoverTheirSizeSquared) {
    Stage stage(device(), {floorAt(-4)});
    stage.params.causticGrid = 16;
    light::Camera camera = light::cameraLookingAt({0.123f, 4, 0.077f}, {0.123f, -4, 0.077f}, radians(70), {0, 0, -1});
    camera.nearZ = 1;
    stage.params.causticScale = 1;
    stage.draw(camera, 643, 611);
    double lit = 0, expected = 0;
    const std::vector<float> p = Stage::pixels(stage.paper.caustics());
    for (std::size_t i = 0; i < p.size(); i += 4) lit += p[i] > 0;
    // z_far is the floor's lower side, 8.2 m and a little ahead; photons lie as a grid over the floor.
    const PointSizes sizes = pointSizes(stage.params, 1, 8.3f);
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) {
            const float px = (float(x) + 0.5f) / 3.2f - 5, pz = (float(y) + 0.5f) / 3.2f - 5;
            const float size = sizes.at(length(Vec3{px, -4, pz} - camera.position()));
            expected += size * size;
        }
    EXPECT_NEAR(lit / expected, 1, 0.05);
}

// Level water: every pixel of a floor 8 m from the eye has the light's irradiance, dimmed once.
TEST_F(WaterPaper, AtGainOneAFloorEightMetresAwayHasItsIrradiance) {
    Stage stage(device(), {floorAt(-3, 20)});
    stage.params.smallestPointPx = stage.params.largestPointPx = 5;
    stage.draw(light::cameraLookingAt({0, 5, 0}, {0, -3, 0}, radians(30), {0, 0, -1}), 400, 400);
    EXPECT_NEAR(Stage::meanOf(stage.paper.caustics()), 2 * std::exp(-0.13 * 3), 0.03 * 2 * std::exp(-0.13 * 3));
    EXPECT_NEAR(Stage::meanOf(stage.direct), Stage::meanOf(stage.paper.caustics()), 0.01);
    EXPECT_EQ(Stage::pixels(stage.direct)[3], 1) << "takes the place of the frame's sun";
    EXPECT_EQ(Stage::sumOf(stage.ambient), 0);
}

TEST_F(WaterPaper, LightScalesWithIntensityAndGain) {
    Stage stage(device(), {floorAt(-3)});
    stage.setWaves(choppy());
    const light::Camera camera = light::cameraLookingAt({3, -1, 5}, {0, -2, 0}, radians(60));
    stage.draw(camera, 300, 200);
    const double caustics = Stage::sumOf(stage.paper.caustics()), godrays = Stage::sumOf(stage.paper.godrays());
    ASSERT_GT(caustics, 0);
    ASSERT_GT(godrays, 0);
    stage.params.intensity *= 2;
    stage.params.gain = 2;
    stage.draw(camera, 300, 200);
    EXPECT_NEAR(Stage::sumOf(stage.paper.caustics()) / caustics, 4, 0.02);
    EXPECT_NEAR(Stage::sumOf(stage.paper.godrays()) / godrays, 4, 0.02);
}

TEST_F(WaterPaper, BuffersFollowTheWindowAndNothingElseIsAllocated) {
    Stage stage(device(), {floorAt(-3)});
    const light::Camera camera = light::cameraLookingAt({3, -1, 5}, {0, -2, 0}, radians(60));
    const auto expectSizes = [&](int causticWidth, int causticHeight, int godrayWidth, int godrayHeight) {
        EXPECT_EQ(stage.paper.caustics().width, causticWidth);
        EXPECT_EQ(stage.paper.caustics().height, causticHeight);
        EXPECT_EQ(stage.paper.godrays().width, godrayWidth);
        EXPECT_EQ(stage.paper.godrays().height, godrayHeight);
    };
    stage.draw(camera, 800, 800);
    expectSizes(512, 512, 128, 128);
    const auto objects = device().liveObjectCount();
    const auto bytes = device().liveBytes();
    stage.draw(light::cameraLookingAt({2, -1, 4}, {0, -2, 1}, radians(60)), 800, 800);
    EXPECT_EQ(device().liveObjectCount(), objects);
    EXPECT_EQ(device().liveBytes(), bytes);
    stage.draw(camera, 1440, 850);
    expectSizes(922, 544, 230, 136);
    EXPECT_GT(Stage::sumOf(stage.paper.caustics()), 0);
    stage.draw(camera, 800, 800);
    expectSizes(512, 512, 128, 128);
    EXPECT_EQ(device().liveObjectCount(), objects);
    EXPECT_EQ(device().liveBytes(), bytes);
}

// Water for x < 0 alone, and a raft on a part of it; a pillar stands out of the water.
TEST_F(WaterPaper, NoLightWhereTheMaskHasNoWater) {
    Stage stage(device(), {floorAt(-2), box({-4, 0.2f, -4}, {-2, 0.4f, -2}), box({-1, -2, 1}, {-0.5f, 1, 1.5f})});
    stage.body.params.areaMax = {0, 1e9f};
    // Seen through a raft that the eye is under.
    stage.draw(orthographicDown(10, -0.1f), 256, 256);
    const gl::TextureView caustics = stage.paper.caustics();
    const std::vector<float> p = Stage::pixels(caustics);
    const auto at = [&](float x, float z) {  // rows bottom first; up in the picture is -z
        const int px = int((x / 10 + 0.5f) * float(caustics.width)), py = int((0.5f - z / 10) * float(caustics.height));
        return p[4 * (std::size_t(py) * std::size_t(caustics.width) + std::size_t(px))];
    };
    EXPECT_GT(at(-1, -1), 0.5f);
    EXPECT_GT(at(-4.5f, 2), 0.5f);
    EXPECT_EQ(at(2, 1), 0) << "no water above";
    EXPECT_EQ(at(-3, -3), 0) << "under the raft";
    const double masked = Stage::sumOf(caustics);
    stage.params.waterMask = false;
    stage.draw(orthographicDown(10, -0.1f), 256, 256);
    EXPECT_GT(Stage::sumOf(stage.paper.caustics()), 1.05 * masked) << "without the mask the raft lets light through";
    // From above: the pillar's head is out of the water.
    stage.draw(orthographicDown(10, 5), 256, 256);
    const std::vector<float> direct = Stage::pixels(stage.direct);
    const std::size_t head = 4 * (std::size_t((0.5 - 1.25 / 10) * 256) * 256 + std::size_t((0.5 - 0.75 / 10) * 256));
    EXPECT_EQ(direct[head + 3], 0);
    EXPECT_EQ(direct[head], 0);
}

// Seen from the side, orthographically: lines reach from the surface to a shelf 1 m down and no further.
TEST_F(WaterPaper, LinesEndWhereTheyMeetTheScene) {
    const auto rowMeans = [&](std::vector<Primitive> primitives) {
        Stage stage(device(), std::move(primitives));
        light::Camera camera = light::cameraLookingAt({0, -2, 20}, {0, -2, 0}, radians(50));
        camera.projection = light::Camera::Projection::orthographic;
        camera.heightM = 6, camera.farZ = 100;
        stage.params.godrayScale = 1;
        stage.body.params.areaMin = {-4.5f, -4.5f}, stage.body.params.areaMax = {4.5f, 4.5f};  // shelves are wider
        stage.draw(camera, 60, 60);
        std::vector<double> means(60, 0);
        const std::vector<float> p = Stage::pixels(stage.paper.godrays());
        for (int y = 0; y < 60; ++y)
            for (int x = 20; x < 40; ++x) means[std::size_t(y)] += p[4 * (std::size_t(y) * 60 + std::size_t(x))];
        return means;
    };
    const auto row = [](float y) { return std::size_t((y + 5) * 10); };  // 10 px a metre, bottom at -5
    const std::vector<double> open = rowMeans({floorAt(-4)}), shelf = rowMeans({floorAt(-4), floorAt(-1)});
    EXPECT_GT(open[row(-0.5f)], 0);
    EXPECT_GT(open[row(-3)], 0.3 * open[row(-0.5f)]);
    EXPECT_EQ(open[row(0.3f)], 0) << "above the water";
    EXPECT_EQ(open[row(-4.6f)], 0) << "in the ground";
    EXPECT_NEAR(shelf[row(-0.5f)] / open[row(-0.5f)], 1, 0.1);
    EXPECT_EQ(shelf[row(-2)], 0) << "under the shelf";
    // e^(-gamma d_surface): 2 m further down.
    EXPECT_NEAR(open[row(-2.5f)] / open[row(-0.5f)], std::exp(-0.13 * 2), 0.06);
}

TEST_F(WaterPaper, TheForwardLobePointsAwayFromTheSun) {
    Stage stage(device(), {floorAt(-6)});
    stage.sun.toSun = normalize(Vec3{1, 1, 0});
    const auto towards = [&](float x) {
        stage.draw(light::cameraLookingAt({0, -4, 0}, {x, -3, 0}, radians(40)), 200, 200);
        return Stage::sumOf(stage.paper.godrays());
    };
    const double intoSun = towards(1), withSun = towards(-1);
    EXPECT_GT(intoSun, 1.5 * withSun);
}

TEST_F(WaterPaper, TheFilterSmoothsAndKeepsTheMean) {
    Stage stage(device(), {floorAt(-3, 8)});
    stage.setWaves(choppy());
    const light::Camera camera = orthographicDown(8, 2);
    const auto meanAndSpread = [&] {
        const std::vector<float> p = Stage::pixels(stage.paper.caustics());
        double sum = 0, squares = 0;
        const double count = double(p.size()) / 4;
        for (std::size_t i = 0; i < p.size(); i += 4) sum += p[i], squares += double(p[i]) * p[i];
        return std::pair{sum / count, std::sqrt(std::max(0.0, squares / count - sum * sum / count / count))};
    };
    stage.draw(camera, 400, 400);
    const auto [mean, spread] = meanAndSpread();
    stage.params.filter = true;
    stage.draw(camera, 400, 400);
    const auto [filteredMean, filteredSpread] = meanAndSpread();
    ASSERT_GT(mean, 0);
    EXPECT_NEAR(filteredMean / mean, 1, 0.005);
    EXPECT_LT(filteredSpread, 0.98 * spread);
    EXPECT_GT(filteredSpread, 0.2 * spread) << "the pattern stays";
}

TEST_F(WaterPaper, LampsLightTooAndASpotKeepsToItsCone) {
    Stage stage(device(), {floorAt(-2, 8)});
    light::PunctualLight lamp;
    lamp.position = {0, 3, 0};
    lamp.intensity = {50, 50, 50};
    stage.lights.sun = nullptr;
    stage.lights.punctual = std::span(&lamp, 1);
    const light::Camera camera = orthographicDown(10, 4.5f);
    stage.draw(camera, 256, 256);
    const double whole = Stage::sumOf(stage.paper.caustics());
    EXPECT_GT(whole, 0);
    lamp.kind = light::PunctualLight::Kind::spot;
    lamp.direction = {0, -1, 0};
    lamp.outerCone = radians(15), lamp.innerCone = radians(12);
    stage.draw(camera, 256, 256);
    const gl::TextureView t = stage.paper.caustics();
    const std::vector<float> p = Stage::pixels(t);
    double inside = 0, outside = 0;
    for (int y = 0; y < t.height; ++y)
        for (int x = 0; x < t.width; ++x) {
            const double fromAxis = std::hypot(x + 0.5 - t.width / 2.0, y + 0.5 - t.height / 2.0) * 10 / t.height;
            (fromAxis < 1.6 ? inside : outside) += p[4 * (std::size_t(y) * std::size_t(t.width) + std::size_t(x))];
        }
    EXPECT_GT(inside, 0);
    EXPECT_EQ(outside, 0);
    EXPECT_LT(inside, whole);
}

TEST_F(WaterPaper, NothingOddBecomesNotANumber) {
    const auto expectSane = [](Stage& stage, const light::Camera& camera, const char* what) {
        stage.draw(camera, 160, 100);
        for (const gl::TextureView& t : {stage.direct.view(), stage.ambient.view(), stage.inscatter.view()})
            for (const float x : Stage::pixels(t)) ASSERT_TRUE(std::isfinite(x) && x >= 0) << what;
    };
    const light::Camera atSurface = light::cameraLookingAt({3, 0, 5}, {0, 0, 0}, radians(60));
    const light::Camera below = light::cameraLookingAt({3, -1, 5}, {0, -2, 0}, radians(60));
    Stage stage(device(), {floorAt(-3), box({-1, -3, -1}, {1, 0, 1})});
    stage.setWaves(choppy());
    expectSane(stage, atSurface, "camera on the surface");
    expectSane(stage, light::cameraLookingAt({0, 4, 0}, {0, 8, 0}, radians(60)), "looking up into the air");
    expectSane(stage, light::cameraLookingAt({0, -0.5f, 0}, {0, -1.5f, 0}, radians(60)), "inside a box");
    stage.sun.toSun = normalize(Vec3{1, 0.05f, 0});
    expectSane(stage, below, "low sun");
    stage.sun.toSun = {0, -1, 0};
    expectSane(stage, below, "sun below the horizon");
    EXPECT_EQ(Stage::sumOf(stage.paper.caustics()), 0);
    light::PunctualLight lamp;
    lamp.position = {0.3f, 0, 0.2f};
    stage.lights.sun = nullptr;
    stage.lights.punctual = std::span(&lamp, 1);
    expectSane(stage, below, "lamp on the surface");
    lamp.position.y = 0.001f;
    expectSane(stage, below, "lamp just above the surface");
    stage.lights = {};
    expectSane(stage, below, "no light");
    Stage empty(device(), {});
    expectSane(empty, below, "no geometry");
}

}  // namespace
}  // namespace shoal::water
