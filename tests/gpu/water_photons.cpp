// Photons among boxes: where the GPU says they end against rays through the same boxes.
#include <gtest/gtest.h>

#include <epoxy/gl.h>

#include <shoal/frame/geometry.h>
#include <shoal/gl/program.h>
#include <shoal/water/gpu_waves.h>
#include <shoal/water/light_views.h>
#include <shoal/water/photons.h>

#include "support/frame_scene.h"
#include "support/gl_device.h"
#include "support/known_waves.h"
#include "support/shader_folder.h"

#include "water/bindings.shared.h"
#include "water/surface/water_block.h"

namespace shoal::test {
namespace {

constexpr int kSide = 400;  // photons a side
constexpr float kDepth = 2;

constexpr const char* kProbe = R"(#version 450 core
#include "water/photon.io.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = SHOAL_STORAGE_WATER) writeonly buffer Ends { vec4 ends[]; };
layout(location = 0) uniform vec4 grid;   // corner x, z, cell, count
void main() {
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, ivec2(grid.w)))) return;
    Photon p = photonAt(grid.xy + (vec2(id) + 0.5) * grid.z, 0);
    int layer;
    float travel = photonTravel(p, 0, layer);
    int at = 2 * (id.y * int(grid.w) + id.x);
    ends[at] = vec4(p.start, travel);
    ends[at + 1] = vec4(p.drift, p.flux, float(layer));
}
)";

struct BoxPlace {
    Vec3 size, at;  // at: middle of its bottom
    float turnDeg;
};
// The boxes of tests/scenes/water_boxes.toml.
const BoxPlace kBoxes[] = {
    {{0.5f, 0.8f, 0.7f}, {-1.2f, -2, 0.9f}, 0},     {{0.9f, 1.4f, 0.5f}, {0.4f, -2, -1.0f}, 17},
    {{0.35f, 0.5f, 0.35f}, {1.3f, -2, 0.8f}, 34},   {{0.6f, 0.3f, 1.0f}, {-0.4f, -1.4f, 0.3f}, 51},
    {{0.25f, 1.0f, 0.25f}, {-1.3f, -2, -1.2f}, 68}, {{0.3f, 0.9f, 0.3f}, {0.6f, -2, 0.2f}, 85},
};
Mat4 placeOf(const BoxPlace& b) { return translation(b.at) * rotation(axisAngle({0, 1, 0}, radians(b.turnDeg))); }

// Metres of travel down to the first of the boxes and the floor.
double exactTravel(Vec3 start, Vec2 drift) {
    double first = double(start.y) + double(kDepth);
    for (const BoxPlace& b : kBoxes) {
        const Mat4 modelFromWorld = *inverse(placeOf(b));
        const Vec3 o = transformPoint(modelFromWorld, start);
        const Vec3 d = transformDirection(modelFromWorld, {drift.x, -1, drift.y});
        const double lo[3] = {-0.5 * double(b.size.x), 0, -0.5 * double(b.size.z)};
        const double hi[3] = {0.5 * double(b.size.x), double(b.size.y), 0.5 * double(b.size.z)};
        const double origin[3] = {double(o.x), double(o.y), double(o.z)};
        const double way[3] = {double(d.x), double(d.y), double(d.z)};
        double t0 = 0, t1 = 1e9;
        for (int k = 0; k < 3; ++k) {
            const double a = (lo[k] - origin[k]) / way[k], c = (hi[k] - origin[k]) / way[k];
            t0 = std::max(t0, std::min(a, c)), t1 = std::min(t1, std::max(a, c));
        }
        if (t0 < t1) first = std::min(first, t0);
    }
    return first;
}

class WaterPhotonsTraced : public GlTest {
protected:
    void SetUp() override {
        folder_.write("water/shaders/probe.comp", kProbe);
        open(folder_.path());
        if (!HasFatalFailure()) gl::setKnownState();
    }
    ShaderFolder folder_;
};

// Share of photons that end more than 2 cm from where they should, sun at a zenith angle.
double misplaced(gl::Device& device, frame::Geometry& geometry, float zenithDeg) {
    const water::WaveField waves = patchP6();
    auto gpuWaves = *water::GpuWaves::create(device);
    EXPECT_TRUE(gpuWaves.update(waves));
    auto views = *water::LightViews::create(device, {512, 1});
    auto photons = *water::Photons::create(device, {512, 1});  // makes the shaders known
    water::Body body;
    body.waves = &waves, body.gpuWaves = &gpuWaves;
    light::Sun sun;
    sun.toSun = {-std::sin(radians(zenithDeg)), std::cos(radians(zenithDeg)), 0};
    water::BodyLights lights;
    lights.sun = &sun;
    light::Camera camera = light::cameraLookingAt({0, 6, 0}, {0, 0, 0}, 1, {0, 0, -1});
    camera.projection = light::Camera::Projection::orthographic;
    camera.heightM = 4;
    const frame::Context context = contextOf(device, light::makeView(camera, 512, 512));
    geometry.update(context);
    views.prepare(context, {}, body, lights, geometry.bounds());
    for (const frame::NeededView& view : views.neededViews()) geometry.drawDepth(context, view);

    auto block = gl::BlockBuffer<water::WaterBlock>::create(device, "water");
    block.write(water::makeWaterBlock(body, lights));
    block.bindUniform(SHOAL_BLOCK_WATER);
    gpuWaves.bind();
    views.bind();
    gl::Buffer ends = gl::Buffer::create(device, kSide * kSide * 2 * sizeof(Vec4), "ends");
    ends.bindStorage(SHOAL_STORAGE_WATER);
    const gl::Program& probe = **device.programs().get({{"water/probe.comp"}, {}, "probe"});
    const water::LightSlot& slot = views.slots()[0];
    // From the middle of the square, so that all of it ends inside.
    const float side = 512 * slot.texel - 2 * slot.margin;
    probe.set(0, Vec4{slot.origin.x + slot.margin, slot.origin.y + slot.margin, side / kSide, kSide});
    probe.dispatch(kSide, kSide);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<Vec4> read(kSide * kSide * 2);
    ends.read(0, std::as_writable_bytes(std::span(read)));

    int wrong = 0;
    for (std::size_t i = 0; i < read.size(); i += 2) {
        const Vec2 drift{read[i + 1].x, read[i + 1].y};
        const double exact = exactTravel({read[i].x, read[i].y, read[i].z}, drift);
        const double along = std::sqrt(1 + double(dot(drift, drift)));
        wrong += !(std::abs(double(read[i].w) - exact) * along <= 0.02);
    }
    return double(wrong) / (kSide * kSide);
}

TEST_F(WaterPhotonsTraced, FewEndInTheWrongPlace) {
    std::vector<Primitive> primitives;
    frame::Geometry geometry = *frame::Geometry::create(device());
    const auto add = [&](Primitive primitive, const Mat4& place) {
        const auto model = geometry.addModel(modelOf({std::move(primitive)}));
        ASSERT_TRUE(model);
        frame::InstanceDesc desc;
        desc.model = *model;
        desc.worldFromModel = place;
        ASSERT_TRUE(geometry.addInstance(desc));
    };
    add(quad({-30, -kDepth, 30}, {60, 0, 0}, {0, 0, -60}), Mat4{});
    for (const BoxPlace& b : kBoxes)
        add(box({-0.5f * b.size.x, 0, -0.5f * b.size.z}, {0.5f * b.size.x, b.size.y, 0.5f * b.size.z}), placeOf(b));
    for (const float zenith : {0.0f, 20.0f, 40.0f}) {
        const double share = misplaced(device(), geometry, zenith);
        RecordProperty("misplaced_" + std::to_string(int(zenith)), std::to_string(share));
        EXPECT_LT(share, 0.01) << zenith << " deg";
    }
}

}  // namespace
}  // namespace shoal::test
