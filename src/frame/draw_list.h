// What is drawn: one Draw a primitive of an instance, sorted into batches that one multi-draw call each can draw.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include <shoal/core/math.h>
#include <shoal/gl/objects.h>

#include "frame/frustum.h"
#include "frame/gpu_material.h"

namespace shoal::frame {

// GL state that draws of one batch share.
struct BatchKey {
    SurfaceVariant variant = SurfaceVariant::flat;
    bool masked = false, doubleSided = false, mirrored = false;
    bool posed = false;  // vertices from the posed buffers
    int material = -1;   // whose textures are bound; -1: none needed
    auto operator<=>(const BatchKey&) const = default;
};

struct Draw {
    int instance = 0, node = 0;
    std::uint32_t firstIndex = 0, indexCount = 0, baseVertex = 0;
    std::uint32_t firstCoarse = 0, coarseCount = 0;  // of a draft; 0: none
    float coarseShare = 0;                           // how far off its vertices are, in sizes of the mesh
    int material = 0;
    int batch = 0, depthBatch = 0;
    Box box;  // world
    bool visible = true, castsShadow = true, transparent = false;
};

// As glMultiDrawElementsIndirect reads it.
struct DrawCommand {
    std::uint32_t count = 0, instanceCount = 1, firstIndex = 0;
    std::int32_t baseVertex = 0;
    std::uint32_t baseInstance = 0;  // index of the draw
};

// Batches met so far; their indices stay valid.
class BatchTable {
public:
    int index(const BatchKey& key);
    const BatchKey& at(int index) const { return keys_[std::size_t(index)]; }
    std::size_t size() const { return keys_.size(); }
    void clear() { keys_.clear(), index_.clear(); }

private:
    std::vector<BatchKey> keys_;
    std::map<BatchKey, int> index_;
};

// Consecutive commands with one batch.
struct DrawRun {
    int batch = 0;
    std::uint32_t first = 0, count = 0;  // commands
};

// The commands of one view, made on the CPU and uploaded into a ring that several views of a frame share.
class CommandList {
public:
    struct Item {
        std::uint32_t draw = 0;
        int batch = 0;
        float distance = 0;  // along the view axis to the nearest corner of the box
        bool coarse = false;
    };
    std::vector<Item>& items() { return items_; }  // cleared and filled by the caller
    enum class Order { batchesFrontToBack, backToFront };
    // Sorts the items, makes commands and runs, uploads. Offset of the first command in the buffer: byteOffset().
    void build(gl::Device& device, std::span<const Draw> draws, Order order);
    std::span<const DrawRun> runs() const { return runs_; }
    const std::vector<DrawCommand>& commands() const { return commands_; }
    const gl::Buffer& buffer() const { return buffer_; }
    std::size_t byteOffset() const { return offset_; }
    std::int64_t triangleCount() const { return triangles_; }

private:
    std::vector<Item> items_;
    std::vector<DrawCommand> commands_;
    std::vector<DrawRun> runs_;
    std::vector<float> nearest_;  // of each batch
    gl::Buffer buffer_;
    std::size_t offset_ = 0, next_ = 0;
    std::int64_t triangles_ = 0;
};

}  // namespace shoal::frame
