// What frame::Geometry holds; geometry*.cpp share it.
#pragma once

#include <optional>
#include <vector>

#include <shoal/frame/geometry.h>
#include <shoal/gl/program.h>

#include "frame/draw_list.h"
#include "frame/geometry.shared.h"
#include "frame/gpu_material.h"
#include "frame/gpu_model.h"
#include "frame/skinning.h"
#include "frame/view_block.h"

namespace shoal::frame {

struct GeometryInstance {
    InstanceDesc desc;
    bool animated = false;  // has a clip
    Pose pose;
    float posedTime = 0;            // clip seconds of `pose`
    bool posed = false;             // `pose` holds something
    bool poseChanged = false;       // in this update
    bool transformChanged = false;  // since the last update
    bool visibilityChanged = false;
    bool fresh = true;      // has no frame before
    int movingUpdates = 0;  // updates left that must write its records (the frame after a move, too)
    std::uint32_t firstDraw = 0, drawCount = 0;
    std::uint32_t firstJob = 0, jobCount = 0;
    std::vector<std::uint32_t> skinRow;    // first pose row of each skin
    std::vector<std::uint32_t> weightRow;  // first pose row of each node's morph weights
    std::uint32_t poseRowEnd = 0;
    Bounds bounds;  // world, of its draws
};

// What a draft's level of detail goes by.
struct DraftView {
    float pixelsPerMetre = 0;  // at a distance of 1 m; 0: no draft
    bool orthographic = false;
};

struct Geometry::State {
    State(gl::Device& d, MaterialStore materialStore, Skinner skinning)
        : device(&d), materials(std::move(materialStore)), skinner(std::move(skinning)) {}

    gl::Device* device;
    MaterialStore materials;
    MeshStore meshes;
    Skinner skinner;

    // Programs by variant (and masked, for the G-buffer).
    const gl::Program* surface[kSurfaceVariantCount][2] = {};
    const gl::Program* depthOnly[2][2] = {};  // masked, peeled
    const gl::Program* transparent[kSurfaceVariantCount] = {};

    std::vector<GpuModel> models;
    std::vector<GeometryInstance> instances;
    std::vector<Draw> draws;
    std::vector<const GpuPrimitive*> drawPrimitives;  // of each draw
    std::vector<int> drawJob;                         // of each draw, -1: not posed
    std::vector<DrawRecord> records;                  // of each draw
    std::vector<SkinJob> jobs;
    std::vector<Vec4> poseRows;
    BatchTable batches;
    bool structureChanged = true;  // instances or models came or went
    bool hasTransparent = false;

    gl::VertexArray staticVertices, posedVertices[2];
    gl::Buffer recordBuffer, drawIndices;
    gl::BlockBuffer<ViewBlock> viewBlock, depthViewBlock;
    CommandList commands;

    std::optional<std::uint32_t> updatedFrame;
    std::vector<Box> changedBoxes;  // world, of what moved in the last update
    Bounds bounds;
    GeometryStats stats;

    // geometry.cpp
    void addDraws(int instance);
    // geometry_update.cpp
    void rebuild();
    void update(const Context& context);
    // geometry_draw.cpp
    void collect(const Mat4& clipFromWorld, const Mat4& viewFromWorld, bool depth, bool transparentOnes,
                 float leastSize, DraftView draft = {});
    void bindShared() const;
};

}  // namespace shoal::frame
