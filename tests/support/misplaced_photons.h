// Photons in a scene: where the GPU says they end against rays through the scene's own triangles. The test and the row
// water.misplaced_photons share it.
#pragma once

#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include <epoxy/gl.h>

#include <shoal/frame/geometry.h>
#include <shoal/gl/device.h>
#include <shoal/gl/objects.h>
#include <shoal/gl/program.h>
#include <shoal/gl/shaders.h>
#include <shoal/light/view.h>
#include <shoal/pipeline/water.h>
#include <shoal/scene/content.h>
#include <shoal/water/gpu_waves.h>
#include <shoal/water/light_views.h>
#include <shoal/water/photons.h>

#include "gl/embedded_shader.h"
#include "water/bindings.shared.h"
#include "water/reference/triangles.h"
#include "water/surface/water_block.h"

namespace shoal::test {

namespace misplaced {

inline constexpr int kSide = 400;      // photons a side
inline constexpr double kFarM = 0.02;  // along the photon's way: wrong beyond
inline constexpr const char* kProbe = R"(#version 450 core
#include "water/photon.io.glsl"
layout(local_size_x = 8, local_size_y = 8) in;
layout(std430, binding = SHOAL_STORAGE_WATER) writeonly buffer Ends { vec4 ends[]; };
layout(location = 0) uniform vec4 grid;   // corner x, z, cell, count
void main() {
    ivec2 id = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(id, ivec2(grid.w)))) return;
    Photon p = photonAt(grid.xy + (vec2(id) + 0.5) * grid.z, 0, grid.z, true);
    int layer;
    float travel = photonTravel(p, 0, layer);
    int at = 2 * (id.y * int(grid.w) + id.x);
    ends[at] = vec4(p.start, travel);
    ends[at + 1] = vec4(p.drift, p.flux * dot(p.open, vec4(0.25)), float(layer));
}
)";

inline Result<frame::Geometry> geometryOf(gl::Device& device, const scene::Content& content) {
    SHOAL_TRY_ASSIGN(frame::Geometry geometry, frame::Geometry::create(device));
    for (const scene::Instance& instance : content.instances) {
        frame::InstanceDesc desc;
        SHOAL_TRY_ASSIGN(desc.model, geometry.addModel(content.models[std::size_t(instance.model)]));
        desc.worldFromModel = scene::transformAt(instance, 0);
        SHOAL_TRY_ASSIGN([[maybe_unused]] const frame::InstanceId id, geometry.addInstance(desc));
    }
    return geometry;
}

// What the probe wrote of a photon.
struct End {
    Vec3 start;
    float travel = 0;  // metres of height
    Vec2 drift;        // metres along x, z a metre of height
    float flux = 0, layer = 0;
};
static_assert(sizeof(End) == 32);

// Ends more than 2 cm from the first triangle.
inline bool isWrong(const End& end, const water::Triangles& triangles) {
    const double along = std::sqrt(1 + double(dot(end.drift, end.drift)));
    const water::DVec3 direction = water::DVec3{end.drift.x, -1, end.drift.y} * (1 / along);
    const auto hit = triangles.first(water::widened(end.start), direction, 0, 1e30);
    return !hit || !(std::abs(double(end.travel) * along - hit->distance) <= kFarM);
}

}  // namespace misplaced

// Share of 160000 photons of the scene's sun that end more than 2 cm from where they should. `drawn`: whether the
// light's views of the scene are drawn (a control: without them all light falls through). GL state is the caller's.
inline Result<double> misplacedPhotons(gl::Device& device, const scene::Scene& scene, const scene::Content& content,
                                       bool drawn = true) {
    using namespace misplaced;
    static const gl::EmbeddedShader shaders[] = {
        {"water/misplaced_photons.comp", kProbe, unsigned(std::strlen(kProbe))}};
    gl::registerShaders(shaders);
    SHOAL_TRY_ASSIGN(std::optional<pipeline::WaterSpec> spec, pipeline::readWater(scene));
    if (!spec || !content.sun) return badInput("expected a scene with water and a sun");
    SHOAL_TRY_ASSIGN(const water::WaveField waves, water::WaveField::create(spec->setup.waves, spec->setup.components,
                                                                            std::move(spec->setup.heightmaps)));
    SHOAL_TRY_ASSIGN(water::GpuWaves gpuWaves, water::GpuWaves::create(device));
    SHOAL_TRY(gpuWaves.update(waves));
    const int resolution = spec->setup.lightViews.resolution;
    SHOAL_TRY_ASSIGN(water::LightViews views, water::LightViews::create(device, {resolution, 1}));
    water::Body body;
    body.params = spec->setup.body;
    SHOAL_TRY_ASSIGN(body.optics, water::resolveOptics(spec->setup.optics));
    body.waves = &waves, body.gpuWaves = &gpuWaves;
    water::BodyLights lights;
    lights.sun = &*content.sun;

    SHOAL_TRY_ASSIGN(frame::Geometry geometry, geometryOf(device, content));
    frame::Context context;
    context.device = &device;
    context.view = context.previousView =
        light::makeView(scene::cameraAt(scene, content, 0, 1), scene.render.width, scene.render.height);
    geometry.update(context);
    views.prepare(context, spec->params.lightViews, body, lights, geometry.bounds());
    if (views.slots().empty()) return internalError("no map of the sun's light");
    for (const frame::NeededView& view : views.neededViews())
        if (drawn) geometry.drawDepth(context, view);

    auto block = gl::BlockBuffer<water::WaterBlock>::create(device, "water");
    block.write(water::makeWaterBlock(body, lights));
    block.bindUniform(SHOAL_BLOCK_WATER);
    gpuWaves.bind();
    views.bind();
    std::vector<End> ends(std::size_t(kSide) * kSide);
    gl::Buffer buffer = gl::Buffer::create(device, ends.size() * sizeof(End), "ends of photons");
    buffer.bindStorage(SHOAL_STORAGE_WATER);
    SHOAL_TRY_ASSIGN(const gl::Program* probe,
                     device.programs().get({{"water/misplaced_photons.comp"}, {}, "misplaced photons"}));
    // From the middle of the square, so that all of it ends inside.
    const water::LightSlot& slot = views.slots()[0];
    const float side = float(resolution) * slot.texel - 2 * slot.margin;
    probe->set(0, Vec4{slot.origin.x + slot.margin, slot.origin.y + slot.margin, side / kSide, kSide});
    probe->dispatch(kSide, kSide);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    buffer.read(0, std::as_writable_bytes(std::span(ends)));

    SHOAL_TRY_ASSIGN(const water::Triangles triangles,
                     water::Triangles::create(pipeline::referenceScene(content, 0).triangles));
    int wrong = 0;
    for (const End& end : ends) wrong += isWrong(end, triangles);
    return double(wrong) / double(ends.size());
}

}  // namespace shoal::test
