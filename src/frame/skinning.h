// Posed vertices of all animated instances: skinned and morphed once a frame, kept for the frame before too.
#pragma once

#include <span>
#include <vector>

#include <shoal/core/result.h>
#include <shoal/gl/objects.h>
#include <shoal/gl/program.h>

#include "frame/gpu_model.h"
#include "frame/skin.shared.h"

namespace shoal::frame {

// One primitive of one instance that is posed.
struct SkinJob {
    const GpuPrimitive* primitive = nullptr;
    std::uint32_t targetVertex = 0;             // first vertex in the posed buffers; set by rebuild
    std::uint32_t jointRow = 0, weightRow = 0;  // in the pose rows
    bool skinned = false;                       // else only morphed
    bool active = true;                         // to be posed in this run
    bool fresh = true;                          // has no frame before: its previous positions are written too
};

class Skinner {
public:
    static Result<Skinner> create(gl::Device& device);

    // Places all jobs one after another, allocates the posed buffers and copies what posing does not change (uvs,
    // colours).
    void rebuild(std::span<SkinJob> jobs, std::size_t poseRowCount, const MeshStore& store);
    // Writes the active jobs' posed vertices; what was current becomes previous. poseRows: as SkinJob says.
    void run(std::span<const SkinJob> jobs, std::span<const Vec4> poseRows, const MeshStore& store);

    std::size_t vertexCount() const { return vertexCount_; }
    int current() const { return current_; }
    const gl::Buffer& positions(int which) const { return positions_[which]; }
    const gl::Buffer& frames() const { return frames_; }
    const gl::Buffer& attributes() const { return attributes_; }
    const gl::Buffer& uv1() const { return uv1_; }

private:
    template <class Wanted>
    void gatherChunks(std::span<const SkinJob> jobs, const Wanted& wanted);
    void dispatch(int target, const MeshStore& store) const;
    gl::Device* device_ = nullptr;
    const gl::Program* program_ = nullptr;
    gl::Buffer positions_[2], frames_, attributes_, uv1_, pose_, chunkBuffer_;
    std::vector<SkinChunk> chunks_;
    std::vector<bool> activeBefore_;
    std::size_t vertexCount_ = 0;
    int current_ = 0;
};

}  // namespace shoal::frame
