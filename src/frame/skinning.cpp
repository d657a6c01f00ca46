#include "frame/skinning.h"

#include <epoxy/gl.h>

#include <algorithm>

namespace shoal::frame {
namespace {

constexpr std::uint32_t kLargestGroupCount = 65535;  // along one axis, what GL guarantees
constexpr int kChunksARowLocation = 0, kChunkCountLocation = 1;

void appendChunks(const SkinJob& job, std::vector<SkinChunk>& chunks) {
    const GpuPrimitive& p = *job.primitive;
    for (std::uint32_t first = 0; first < p.vertexCount; first += SHOAL_SKIN_GROUP) {
        SkinChunk c{};
        c.vertexCount = std::min<std::uint32_t>(SHOAL_SKIN_GROUP, p.vertexCount - first);
        c.sourceVertex = p.firstVertex + first;
        c.targetVertex = job.targetVertex + first;
        c.influence = job.skinned ? p.firstInfluence + first : ~0u;
        c.jointRow = job.jointRow;
        c.weightRow = job.weightRow;
        c.morphCount = p.morphCount;
        c.morphOffset = p.firstMorph + first;
        c.morphStride = p.vertexCount;
        chunks.push_back(c);
    }
}

void copyRange(const gl::Buffer& from, const gl::Buffer& to, std::size_t firstFrom, std::size_t firstTo,
               std::size_t count, std::size_t stride) {
    glCopyNamedBufferSubData(from.name(), to.name(), GLintptr(firstFrom * stride), GLintptr(firstTo * stride),
                             GLsizeiptr(count * stride));
}

// A buffer that no model has filled still needs a name to bind.
void bindStorage(const gl::Buffer& buffer, const gl::Buffer& otherwise, int binding) {
    (buffer ? buffer : otherwise).bindStorage(binding);
}

}  // namespace

Result<Skinner> Skinner::create(gl::Device& device) {
    Skinner skinner;
    skinner.device_ = &device;
    SHOAL_TRY_ASSIGN(skinner.program_, device.programs().get({{"frame/skin.comp"}, {}, "skin"}));
    return skinner;
}

void Skinner::rebuild(std::span<SkinJob> jobs, std::size_t poseRowCount, const MeshStore& store) {
    vertexCount_ = 0;
    std::size_t chunkCount = 0;
    for (SkinJob& job : jobs) {
        job.targetVertex = std::uint32_t(vertexCount_);
        vertexCount_ += job.primitive->vertexCount;
        chunkCount += (job.primitive->vertexCount + SHOAL_SKIN_GROUP - 1) / SHOAL_SKIN_GROUP;
    }
    activeBefore_.clear();
    if (vertexCount_ == 0) return;
    ensureBytes(*device_, positions_[0], vertexCount_ * sizeof(Vec3), "posed positions");
    ensureBytes(*device_, positions_[1], vertexCount_ * sizeof(Vec3), "posed positions");
    ensureBytes(*device_, frames_, vertexCount_ * sizeof(PackedFrame), "posed normals and tangents");
    ensureBytes(*device_, attributes_, vertexCount_ * sizeof(PackedAttribute), "posed uvs and colours");
    if (store.hasUv1) ensureBytes(*device_, uv1_, vertexCount_ * sizeof(Vec2), "posed second uvs");
    ensureBytes(*device_, pose_, poseRowCount * sizeof(Vec4), "pose");
    ensureBytes(*device_, chunkBuffer_, chunkCount * sizeof(SkinChunk), "skinning chunks");
    chunks_.reserve(chunkCount);
    for (const SkinJob& job : jobs) {
        const GpuPrimitive& p = *job.primitive;
        copyRange(store.attributes.buffer(), attributes_, p.firstVertex, job.targetVertex, p.vertexCount,
                  sizeof(PackedAttribute));
        if (store.hasUv1)
            copyRange(store.uv1.buffer(), uv1_, p.firstVertex, job.targetVertex, p.vertexCount, sizeof(Vec2));
    }
}

template <class Wanted>
void Skinner::gatherChunks(std::span<const SkinJob> jobs, const Wanted& wanted) {
    chunks_.clear();
    for (const SkinJob& job : jobs)
        if (wanted(job)) appendChunks(job, chunks_);
    if (!chunks_.empty()) chunkBuffer_.write(0, std::as_bytes(std::span<const SkinChunk>(chunks_)));
}

void Skinner::run(std::span<const SkinJob> jobs, std::span<const Vec4> poseRows, const MeshStore& store) {
    if (vertexCount_ == 0) return;
    current_ = 1 - current_;
    bool sameJobs = activeBefore_.size() == jobs.size(), anyFresh = false;
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        sameJobs = sameJobs && activeBefore_[i] == jobs[i].active;
        anyFresh |= jobs[i].active && jobs[i].fresh;
    }
    if (!sameJobs) {
        gatherChunks(jobs, [](const SkinJob& job) { return job.active; });
        activeBefore_.resize(jobs.size());
        for (std::size_t i = 0; i < jobs.size(); ++i) activeBefore_[i] = jobs[i].active;
    }
    if (chunks_.empty()) return;
    pose_.write(0, std::as_bytes(poseRows));
    dispatch(current_, store);
    if (anyFresh) {
        gatherChunks(jobs, [](const SkinJob& job) { return job.active && job.fresh; });
        dispatch(1 - current_, store);
        activeBefore_.clear();  // the chunks are others now
    }
    glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void Skinner::dispatch(int target, const MeshStore& store) const {
    chunkBuffer_.bindStorage(SHOAL_SKIN_CHUNKS);
    pose_.bindStorage(SHOAL_SKIN_POSE);
    store.positions.buffer().bindStorage(SHOAL_SKIN_POSITIONS_IN);
    store.frames.buffer().bindStorage(SHOAL_SKIN_FRAMES_IN);
    bindStorage(store.influences.buffer(), pose_, SHOAL_SKIN_INFLUENCES);
    bindStorage(store.morphs.buffer(), pose_, SHOAL_SKIN_MORPHS);
    positions_[target].bindStorage(SHOAL_SKIN_POSITIONS_OUT);
    frames_.bindStorage(SHOAL_SKIN_FRAMES_OUT);
    const std::uint32_t count = std::uint32_t(chunks_.size()), aRow = std::min(count, kLargestGroupCount);
    program_->set(kChunksARowLocation, aRow);
    program_->set(kChunkCountLocation, count);
    program_->dispatch(int(aRow) * program_->localSize(0), int((count + aRow - 1) / aRow));
}

}  // namespace shoal::frame
