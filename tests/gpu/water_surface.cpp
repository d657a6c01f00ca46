// Paths through the water and the waterline.
#include <gtest/gtest.h>

#include <cmath>

#include "frame/view_block.h"
#include "support/frame_scene.h"
#include "support/gl_device.h"
#include "support/water_surface_measure.h"
#include "water/surface.shared.h"
#include "water/surface/surface_grid.h"

namespace shoal::water {
namespace {

using WaterSurfaceGpu = test::GlTest;

std::vector<WaveComponentParams> threeWaves() {
    WaveComponentParams a, b, c;
    a.amplitude = 0.03f, a.m = 2, a.q = 1;
    b.amplitude = 0.02f, b.m = -3, b.q = 2, b.phase = 1.3f;
    c.amplitude = 0.006f, c.m = 7, c.q = 5, c.phase = 2;
    return {a, b, c};
}

WaveParams ofKind(const char* kind) {
    WaveParams params;
    params.kind = kind;
    return params;
}

void addBox(test::WaterStage& stage, Vec3 lo, Vec3 hi) {
    const auto id = stage.geometry->addModel(test::modelOf({test::box(lo, hi)}));
    ASSERT_TRUE(id) << id.error().message;
    frame::InstanceDesc desc;
    desc.model = *id;
    ASSERT_TRUE(stage.geometry->addInstance(desc));
}

// Of a pixel whose row counts from the top.
Vec3 rayOf(const light::View& view, int x, int y) {
    const Vec3 clip{2 * (float(x) + 0.5f) / float(view.width) - 1, 1 - 2 * (float(y) + 0.5f) / float(view.height), 1};
    return normalize(transformDirection(view.worldFromView, transformPoint(view.viewFromClip, clip)));
}

// The eye sinks through waves: in every column what begins in the air lies above what begins in the water, with
// nothing between, and the line is where the near plane meets the waves.
TEST_F(WaterSurfaceGpu, WaterlineIsOneLine) {
    auto stage = test::WaterStage::create(device(), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    ASSERT_TRUE((*stage)->setWaves(ofKind("sum"), threeWaves()));
    const int width = 200, height = 150;
    int crossings = 0, airOnly = 0, waterOnly = 0;
    for (const float y : {0.12f, 0.03f, 0.01f, 0.0f, -0.01f, -0.03f, -0.12f}) {
        const Vec3 eye{0.7f, y, 0.4f};
        light::Camera camera = light::cameraLookingAt(eye, eye + Vec3{0.3f, 0.02f, -1}, radians(60));
        camera.nearZ = 0.08f;
        const light::View view = light::makeView(camera, width, height);
        const auto picture = (*stage)->draw(view);
        ASSERT_TRUE(picture) << picture.error().message;
        for (int x = 0; x < width; ++x) {
            int changes = 0, line = -1;
            bool wet = false;
            for (int row = 0; row < height; ++row) {
                const float* path = picture->path.at(x, row);
                ASSERT_TRUE(std::isfinite(path[2]));
                const bool begins = path[3] > 0.5f;
                if (row > 0 && begins != wet) ++changes, line = row;
                if (row == 0 && begins) ++waterOnly;
                wet = begins;
                // Nobody's: neither in the water nor on its surface, yet below the horizon.
                if (rayOf(view, x, row).y < -0.01f) {
                    EXPECT_TRUE(begins || picture->surfaceDepth.at(x, row)[0] > 0) << x << " " << row << " eye " << y;
                }
                if (begins) {
                    EXPECT_GT(path[2], 0) << x << " " << row << " eye " << y;
                }
            }
            ASSERT_LE(changes, 1) << "column " << x << " eye " << y;
            if (changes == 0) {
                airOnly += !wet;
                continue;
            }
            ++crossings;
            ASSERT_TRUE(wet) << "water above air, column " << x << " eye " << y;
            // Height of the near plane's points over the waves, a pixel and a half above and below the line.
            const auto over = [&](double row) {
                const float v = float(1 - 2 * row / height), u = 2 * (float(x) + 0.5f) / float(width) - 1;
                const Vec3 p = transformPoint(view.worldFromView, transformPoint(view.viewFromClip, {u, v, 1}));
                return double(p.y) - (*stage)->waves->at(double(p.x), double(p.z)).h;
            };
            EXPECT_GT(over(line - 1.5), 0) << x << " eye " << y;
            EXPECT_LT(over(line + 1.5), 0) << x << " eye " << y;
        }
    }
    EXPECT_GT(crossings, 3 * width);
    EXPECT_GT(airOnly, 0);
    EXPECT_GT(waterOnly, 0);
}

// No hole in the surface: every ray downwards over water without end meets it, and where the heights say.
TEST_F(WaterSurfaceGpu, GridIsWatertightAndHigh) {
    auto stage = test::WaterStage::create(device(), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    ASSERT_TRUE((*stage)->setWaves(ofKind("sum"), threeWaves()));
    for (const Vec3 eye : {Vec3{0, 0.4f, 0}, Vec3{33.3f, 2, -71.7f}, Vec3{5, 60, 5}, Vec3{2000.5f, 1.1f, 900.3f}})
        for (const float pitch : {-0.1f, -0.6f, -1.4f}) {
            const Vec3 forward{std::cos(pitch) * 0.6f, std::sin(pitch), -std::cos(pitch) * 0.8f};
            const light::View view = light::makeView(light::cameraLookingAt(eye, eye + forward, radians(60)), 160, 120);
            const auto picture = (*stage)->draw(view);
            ASSERT_TRUE(picture) << picture.error().message;
            double worst = 0;
            for (int row = 0; row < 120; ++row)
                for (int x = 0; x < 160; ++x) {
                    const Vec3 d = rayOf(view, x, row);
                    if (d.y > -0.004f) continue;
                    const float depth = picture->surfaceDepth.at(x, row)[0];
                    ASSERT_GT(depth, 0) << x << " " << row << " eye " << eye.x << " " << eye.y << " pitch " << pitch;
                    const double along = double(depth) / double(dot(d, forward));
                    if (along > 4 * double(eye.y)) continue;  // farther away cells are too wide for the waves
                    const Vec3 p = eye + d * float(along);
                    const double h = (*stage)->waves->at(double(p.x), double(p.z)).h;
                    worst = std::max(worst, std::abs(double(p.y) - h));
                }
            if (eye.y < 3) {
                EXPECT_LT(worst, 0.02) << eye.x << " pitch " << pitch;
            }
        }
}

TEST_F(WaterSurfaceGpu, PathsOfAnEyeInTheWater) {
    auto stage = test::WaterStage::create(device(), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    addBox(**stage, {-30, -5, -30}, {30, -4, 30});
    const Vec3 eye{0, -1.5f, 0};
    const light::View view = light::makeView(light::cameraLookingAt(eye, {0, -1.7f, -1}, radians(80)), 120, 90);
    const auto picture = (*stage)->draw(view);
    ASSERT_TRUE(picture) << picture.error().message;
    for (int row = 0; row < 90; row += 4)
        for (int x = 0; x < 120; x += 5) {
            const Vec3 d = rayOf(view, x, row);
            const float* path = picture->path.at(x, row);
            EXPECT_EQ(path[3], 1) << x << " " << row;
            if (d.y > 0.05f) {
                EXPECT_LT(picture->surfaceDepth.at(x, row)[0], 0) << x << " " << row;
                EXPECT_NEAR(path[2] * d.y, 1.5f, 0.005f) << x << " " << row;
            } else if (d.y < -0.15f) {
                EXPECT_EQ(picture->surfaceDepth.at(x, row)[0], 0) << x << " " << row;
                EXPECT_NEAR(path[2] * -d.y, 2.5f, 0.005f) << x << " " << row;
            }
        }
}

// What the maps to be checked are drawn with: no surface, an eye that looks straight down.
TEST_F(WaterSurfaceGpu, PathsWithoutADrawnSurface) {
    auto stage = test::WaterStage::create(device(), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    addBox(**stage, {-30, -4, -30}, {30, -3, 30});
    (*stage)->body.params.surfaceVisible = false;
    (*stage)->body.params.areaMin = {-1, -1e9f};
    light::Camera camera = light::cameraLookingAt({0, 10, 0}, {0, 0, 0}, radians(50), {0, 0, -1});
    camera.projection = light::Camera::Projection::orthographic;
    camera.heightM = 4;
    const auto picture = (*stage)->draw(light::makeView(camera, 80, 60));
    ASSERT_TRUE(picture) << picture.error().message;
    for (int x = 0; x < 80; x += 3) {
        const double worldX = (x + 0.5 - 40) / 15;
        const float* path = picture->path.at(x, 30);
        EXPECT_NEAR(path[2], worldX > -1 ? 3 : 0, 0.003) << worldX;
        EXPECT_EQ(picture->surfaceDepth.at(x, 30)[0], 0);
        EXPECT_EQ(path[0], 0);
    }
}

// A dry eye beside a tank: rays enter through its side, unbent, and end at the other.
TEST_F(WaterSurfaceGpu, PathsThroughTheSideOfAnArea) {
    auto stage = test::WaterStage::create(device(), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    (*stage)->body.params.areaMin = {-6, -3.5f};
    (*stage)->body.params.areaMax = {6, 3.5f};
    const light::View view = light::makeView(light::cameraLookingAt({0, -1, 8}, {0, -1, 0}, radians(30)), 81, 61);
    const auto picture = (*stage)->draw(view);
    ASSERT_TRUE(picture) << picture.error().message;
    const float* path = picture->path.at(40, 30);
    EXPECT_NEAR(path[2], 7, 0.01);
    EXPECT_EQ(path[3], 0);
    // Over the rim: through the surface, which ends with the area.
    const light::View over = light::makeView(light::cameraLookingAt({0, 2, 8}, {0, 0, 0}, radians(60)), 81, 61);
    const auto above = (*stage)->draw(over);
    ASSERT_TRUE(above) << above.error().message;
    for (int row = 0; row < 61; ++row) {
        const Vec3 d = rayOf(over, 40, row);
        if (d.y >= -0.02f) continue;
        const float z = 8 + d.z * (-2 / d.y);
        if (std::abs(std::abs(z) - 3.5f) < 0.15f) continue;
        EXPECT_EQ(above->surfaceDepth.at(40, row)[0] > 0, std::abs(z) < 3.5f) << row << " z " << z;
    }
}

// A still surface stays where it is when the eye moves: the same place has the same height from near and far levels.
TEST_F(WaterSurfaceGpu, LevelsShareTheirEdges) {
    Body body;
    SurfaceGrid grid;
    const light::View view = light::makeView(light::cameraLookingAt({3.3f, 1.7f, -8.1f}, {3, 1.5f, -9}, 2.6f), 64, 64);
    auto field = WaveField::create(ofKind("sum"), threeWaves());
    ASSERT_TRUE(field) << field.error().message;
    body.waves = &*field;
    layOutGrid(view, body, grid);
    ASSERT_FALSE(grid.blocks.empty());
    EXPECT_EQ(std::exp2(std::round(std::log2(grid.cell))), grid.cell);
    for (const GridBlock& a : grid.blocks) {
        const float side = SHOAL_GRID_CELLS * a.place.z;
        // Whole blocks of its own level and of the next.
        EXPECT_EQ(std::fmod(a.place.x, float(SHOAL_GRID_CELLS)), 0);
        EXPECT_EQ(std::fmod(a.place.y, float(SHOAL_GRID_CELLS)), 0);
        const float x0 = a.place.x * a.place.z, z0 = a.place.y * a.place.z;
        for (const GridBlock& b : grid.blocks) {
            if (&a == &b) continue;
            const float other = SHOAL_GRID_CELLS * b.place.z;
            const float x1 = b.place.x * b.place.z, z1 = b.place.y * b.place.z;
            const bool overlap = x0 < x1 + other && x1 < x0 + side && z0 < z1 + other && z1 < z0 + side;
            ASSERT_FALSE(overlap) << "blocks overlap at " << x0 << " " << z0 << " and " << x1 << " " << z1;
        }
    }
}

// Eyes on the surface, no area, a picture of one pixel, waves as steep as they may be: numbers everywhere.
TEST_F(WaterSurfaceGpu, OddCasesGiveNumbers) {
    auto stage = test::WaterStage::create(device(), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    light::Sun sun;
    sun.toSun = {0, 1, 0};
    (*stage)->lights.sun = &sun;
    (*stage)->lights.skyIrradiance = {3, 3, 3};
    (*stage)->params.foam = true;
    (*stage)->params.roughness = 0.1f;
    OpticsParams murky;
    murky.medium = "jerlov-9C";
    (*stage)->body.optics = resolveOptics(murky).value();
    const auto expectNumbers = [&](const light::View& view, const std::string& what) {
        const auto picture = (*stage)->draw(view, true);
        ASSERT_TRUE(picture) << picture.error().message;
        for (const Image* image : {&picture->radiance, &picture->path, &picture->transmittance, &picture->waterDepth})
            for (const float x : image->pixels) ASSERT_TRUE(std::isfinite(x)) << what;
    };
    WaveComponentParams steep;
    steep.amplitude = 0.3f, steep.m = 3;
    for (const bool waves : {false, true}) {
        if (waves) {
            ASSERT_TRUE((*stage)->setWaves(ofKind("sum"), std::span(&steep, 1)));
        }
        const std::string kind = waves ? "waves, " : "level, ";
        for (const float y : {0.0f, 1e-4f, -1e-4f, 0.05f, 300.0f})
            for (const Vec3 to : {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0.3f, -1, 0}, Vec3{0.3f, 1, 0}})
                expectNumbers(light::makeView(light::cameraLookingAt({0, y, 0}, Vec3{0, y, 0} + to, 1), 33, 17),
                              kind + std::to_string(y));
    }
    expectNumbers(light::makeView(light::cameraLookingAt({0, 1, 0}, {0, 0, -1}, 1), 1, 1), "one pixel");
    expectNumbers(light::makeView(light::cameraLookingAt({0, 2, 0}, {0, 0, 0}, 1), 16, 16), "straight down");
    expectNumbers(light::makeView(light::cameraLookingAt({0, -2, 0}, {0, 0, 0}, 1), 16, 16), "straight up");
    (*stage)->body.params.areaMax = (*stage)->body.params.areaMin = {0, 0};
    expectNumbers(light::makeView(light::cameraLookingAt({0, 1, 3}, {0, 0, 0}, 1), 16, 16), "no area");
}

TEST_F(WaterSurfaceGpu, BlockLayout) {
    auto stage = test::WaterStage::create(device(), 1);
    ASSERT_TRUE(stage) << stage.error().message;
    const auto made = device().programs().get(
        {{"frame/fullscreen.vert", "water/surface_compose.frag"}, {}, "water/surface_compose.frag"});
    ASSERT_TRUE(made) << made.error().message;
    const GLuint program = (*made)->name();
    const std::pair<const char*, std::size_t> members[] = {
        {"SurfaceBlock.clipFromWorld[0]", offsetof(SurfaceBlock, clipFromWorld)},
        {"SurfaceBlock.depthRow[0]", offsetof(SurfaceBlock, depthRow)},
        {"SurfaceBlock.mirrorSize[0]", offsetof(SurfaceBlock, mirrorSize)},
        {"SurfaceBlock.bentEye", offsetof(SurfaceBlock, bentEye)},
        {"SurfaceBlock.grid", offsetof(SurfaceBlock, grid)},
        {"SurfaceBlock.look", offsetof(SurfaceBlock, look)}};
    for (const auto& [name, offset] : members) {
        const GLuint index = glGetProgramResourceIndex(program, GL_UNIFORM, name);
        ASSERT_NE(index, GL_INVALID_INDEX) << name;
        const GLenum property = GL_OFFSET;
        GLint value = -1;
        glGetProgramResourceiv(program, GL_UNIFORM, index, 1, &property, 1, nullptr, &value);
        EXPECT_EQ(value, GLint(offset)) << name;
    }
}

}  // namespace
}  // namespace shoal::water
