// Once a frame: poses, moves, skins, and finds out what changed.
#include <algorithm>
#include <cmath>

#include <shoal/core/parallel.h>

#include "frame/geometry_state.h"

namespace shoal::frame {
namespace {

using State = Geometry::State;

constexpr std::size_t kInstancesPerTask = 4;

void setRows(vec4 (&rows)[3], const Mat4& m) {
    for (int r = 0; r < 3; ++r) rows[r] = {m(r, 0), m(r, 1), m(r, 2), m(r, 3)};
}

// Places an instance's matrices and weights in the pose rows.
void placePoseRows(GeometryInstance& instance, const GpuModel& model, std::uint32_t& next) {
    instance.skinRow.clear();
    instance.weightRow.assign(model.skeleton.nodes.size(), 0);
    if (instance.jobCount > 0) {
        for (const Skin& skin : model.skeleton.skins) {
            instance.skinRow.push_back(next);
            next += 3 * std::uint32_t(skin.joints.size());
        }
        for (std::size_t n = 0; n < model.skeleton.nodes.size(); ++n) {
            const int mesh = model.skeleton.nodes[n].mesh;
            if (mesh < 0) continue;
            std::size_t targets = 0;
            for (const GpuPrimitive& p : model.meshes[std::size_t(mesh)])
                targets = std::max<std::size_t>(targets, p.morphCount);
            instance.weightRow[n] = next;
            next += std::uint32_t((targets + 3) / 4);
        }
    }
    instance.poseRowEnd = next;
}

void writePoseRows(const GeometryInstance& instance, std::vector<Vec4>& rows) {
    for (std::size_t s = 0; s < instance.skinRow.size(); ++s) {
        Vec4* row = rows.data() + instance.skinRow[s];
        for (const Mat4& m : instance.pose.modelFromBind[s])
            for (int r = 0; r < 3; ++r) *row++ = {m(r, 0), m(r, 1), m(r, 2), m(r, 3)};
    }
    for (std::size_t n = 0; n < instance.pose.morphWeights.size(); ++n) {
        const std::vector<float>& weights = instance.pose.morphWeights[n];
        for (std::size_t k = 0; k < weights.size(); ++k) {
            Vec4& row = rows[instance.weightRow[n] + k / 4];
            (k % 4 == 0 ? row.x : k % 4 == 1 ? row.y : k % 4 == 2 ? row.z : row.w) = weights[k];
        }
    }
}

// How far morph targets can move the vertices of a primitive at these weights.
Bounds morphReach(const GpuPrimitive& p, const std::vector<float>& weights) {
    Vec3 lo{0, 0, 0}, hi{0, 0, 0};
    for (std::size_t k = 0; k < std::min(weights.size(), p.morphReach.size()); ++k) {
        const Vec3 a = p.morphReach[k].lo * weights[k], b = p.morphReach[k].hi * weights[k];
        // A vertex may have no offset, so the reach holds 0.
        lo += min(min(a, b), Vec3{0, 0, 0}), hi += max(max(a, b), Vec3{0, 0, 0});
    }
    return {lo, hi};
}

// World box of a posed or rigid primitive; conservative: each joint's box of vertices moves with the joint.
Box worldBox(const GeometryInstance& instance, const GpuPrimitive& p, const Node& node, int nodeIndex) {
    Bounds reach{{0, 0, 0}, {0, 0, 0}};
    if (p.morphCount > 0) reach = morphReach(p, instance.pose.morphWeights[std::size_t(nodeIndex)]);
    auto grown = [&](const Bounds& b) { return boxOf({b.lo + reach.lo, b.hi + reach.hi}); };
    const Mat4& world = instance.desc.worldFromModel;
    if (!p.skinned || node.skin < 0)
        return transformed(world * instance.pose.modelFromNode[std::size_t(nodeIndex)], grown(p.bounds));
    Bounds inModel;
    const std::vector<Mat4>& modelFromBind = instance.pose.modelFromBind[std::size_t(node.skin)];
    for (const JointBox& j : p.jointBoxes)
        inModel.add(boundsOf(transformed(modelFromBind[std::size_t(j.joint)], grown(j.box))));
    return transformed(world, boxOf(inModel));
}

void poseInstance(GeometryInstance& instance, const GpuModel& model, float time) {
    const float clipTime = instance.animated ? instance.desc.startTime + instance.desc.speed * time : 0;
    instance.poseChanged = !instance.posed || (instance.animated && clipTime != instance.posedTime);
    if (!instance.poseChanged) return;
    poseModel(model.skeleton, instance.desc.clip, clipTime, instance.desc.loop, instance.pose);
    instance.posedTime = clipTime;
    instance.posed = true;
}

int batchOf(State& s, const Draw& draw, bool posed, bool mirrored) {
    const GpuMaterial& m = s.materials.at(draw.material);
    return s.batches.index(
        {m.variant, m.masked, m.doubleSided, mirrored, posed, m.variant == SurfaceVariant::flat ? -1 : draw.material});
}

// Back faces are left out only where that changes no shadow: single walls and rooms keep the sun out from both sides.
int depthBatchOf(State& s, const Draw& draw, bool posed, bool mirrored, bool bothSides) {
    const GpuMaterial& m = s.materials.at(draw.material);
    return s.batches.index({SurfaceVariant::flat, m.maskedShadow, bothSides, bothSides ? false : mirrored, posed,
                            m.maskedShadow ? draw.material : -1});
}

// Records, boxes and batches of one instance's draws. What was current becomes previous.
void moveDraws(State& s, GeometryInstance& instance) {
    const GpuModel& model = s.models[std::size_t(instance.desc.model)];
    const Mat4& world = instance.desc.worldFromModel;
    Bounds bounds;
    for (std::uint32_t d = instance.firstDraw; d < instance.firstDraw + instance.drawCount; ++d) {
        Draw& draw = s.draws[d];
        DrawRecord& record = s.records[d];
        const GpuPrimitive& p = *s.drawPrimitives[d];
        const Node& node = model.skeleton.nodes[std::size_t(draw.node)];
        const bool skinned = p.skinned && node.skin >= 0;
        // glTF: a skinned mesh ignores its node's transform.
        const Mat4 matrix = skinned ? world : world * instance.pose.modelFromNode[std::size_t(draw.node)];
        if (instance.fresh)
            setRows(record.previousFromModel, matrix);
        else
            std::copy(std::begin(record.worldFromModel), std::end(record.worldFromModel),
                      std::begin(record.previousFromModel));
        setRows(record.worldFromModel, matrix);
        const bool mirrored = determinant3(matrix) < 0;
        record.flags = mirrored ? SHOAL_DRAW_MIRRORED : 0;
        draw.batch = batchOf(s, draw, s.drawJob[d] >= 0, mirrored);
        const bool bothSides = s.materials.at(draw.material).doubleSided || !shadowsByFrontFaces(p.shell, matrix);
        draw.depthBatch = depthBatchOf(s, draw, s.drawJob[d] >= 0, mirrored, bothSides);
        draw.box = worldBox(instance, p, node, draw.node);
        bounds.add(boundsOf(draw.box));
    }
    instance.bounds = bounds;
}

void bindVertexBuffers(gl::VertexArray& array, const gl::Buffer& positions, const gl::Buffer& previous,
                       const gl::Buffer& frames, const gl::Buffer& attributes, const gl::Buffer& uv1, const State& s) {
    int index = 0;
    array.setBuffer(index++, positions.view(), sizeof(Vec3));
    array.setBuffer(index++, frames.view(), sizeof(PackedFrame));
    array.setBuffer(index++, attributes.view(), sizeof(PackedAttribute));
    // Without second uvs the attribute reads some other stream; no material looks at it.
    array.setBuffer(index++, uv1 ? uv1.view() : attributes.view(), uv1 ? sizeof(Vec2) : sizeof(PackedAttribute));
    array.setBuffer(index++, previous.view(), sizeof(Vec3));
    array.setBuffer(index++, s.drawIndices.view(), sizeof(std::uint32_t), 1);
    array.setIndices(s.meshes.indices.buffer().view());
}

}  // namespace

void State::rebuild() {
    structureChanged = false;
    std::uint32_t poseRowCount = 0;
    for (GeometryInstance& instance : instances)
        placePoseRows(instance, models[std::size_t(instance.desc.model)], poseRowCount);
    poseRows.resize(poseRowCount);
    records.resize(draws.size());
    for (std::size_t d = 0; d < draws.size(); ++d) {
        Draw& draw = draws[d];
        const GeometryInstance& instance = instances[std::size_t(draw.instance)];
        const GpuMaterial& material = materials.at(draw.material);
        draw.transparent = material.transparent;
        draw.castsShadow = instance.desc.castsShadow && material.castsShadow;
        draw.visible = instance.desc.visible;
        records[d].material = std::uint32_t(draw.material);
        records[d].objectId = instance.desc.objectId;
        records[d].tint = instance.desc.tint;
        if (drawJob[d] < 0) continue;
        const Node& node = models[std::size_t(instance.desc.model)].skeleton.nodes[std::size_t(draw.node)];
        SkinJob& job = jobs[std::size_t(drawJob[d])];
        job.jointRow = node.skin >= 0 ? instance.skinRow[std::size_t(node.skin)] : 0;
        job.skinned = job.primitive->skinned && node.skin >= 0;
        job.weightRow = instance.weightRow[std::size_t(draw.node)];
    }
    skinner.rebuild(jobs, poseRowCount, meshes);
    for (std::size_t d = 0; d < draws.size(); ++d)
        if (drawJob[d] >= 0) draws[d].baseVertex = jobs[std::size_t(drawJob[d])].targetVertex;

    // The posed buffers are new: everything begins again without a frame before.
    for (GeometryInstance& instance : instances) instance.fresh = true;
    if (draws.empty()) return;
    ensureBytes(*device, recordBuffer, draws.size() * sizeof(DrawRecord), "draw records");
    if (ensureBytes(*device, drawIndices, draws.size() * sizeof(std::uint32_t), "draw indices")) {
        std::vector<std::uint32_t> counting(drawIndices.bytes() / sizeof(std::uint32_t));
        for (std::size_t i = 0; i < counting.size(); ++i) counting[i] = std::uint32_t(i);
        drawIndices.writeAll(std::span<const std::uint32_t>(counting));
    }
    bindVertexBuffers(staticVertices, meshes.positions.buffer(), meshes.positions.buffer(), meshes.frames.buffer(),
                      meshes.attributes.buffer(), meshes.uv1.buffer(), *this);
    if (skinner.vertexCount() == 0) return;
    for (int which = 0; which < 2; ++which)
        bindVertexBuffers(posedVertices[which], skinner.positions(which), skinner.positions(1 - which),
                          skinner.frames(), skinner.attributes(), skinner.uv1(), *this);
}

void State::update(const Context& context) {
    if (updatedFrame == context.frameIndex && !structureChanged) return;
    const gl::PassScope pass(context.timer, "pose and skin");
    updatedFrame = context.frameIndex;
    const bool rebuilt = structureChanged;
    if (rebuilt) rebuild();

    parallelFor(instances.size(), kInstancesPerTask, [&](std::size_t i) {
        GeometryInstance& instance = instances[i];
        instance.poseChanged = false;
        if (instance.desc.visible || !instance.posed)
            poseInstance(instance, models[std::size_t(instance.desc.model)], context.time);
        if (instance.poseChanged || rebuilt) writePoseRows(instance, poseRows);
    });

    changedBoxes.clear();
    std::uint32_t firstDirty = ~0u, endDirty = 0;
    bool anyActive = false;
    for (GeometryInstance& instance : instances) {
        if (instance.visibilityChanged) {
            changedBoxes.push_back(boxOf(instance.bounds));
            for (std::uint32_t d = 0; d < instance.drawCount; ++d)
                draws[instance.firstDraw + d].visible = instance.desc.visible;
            instance.visibilityChanged = false;
            if (instance.desc.visible) instance.fresh = true;  // what it was before it hid is no motion
        }
        const bool moved = instance.poseChanged || instance.transformChanged || instance.fresh;
        if (moved) instance.movingUpdates = 2;
        const bool active = instance.movingUpdates > 0;
        for (std::uint32_t j = 0; j < instance.jobCount; ++j) {
            jobs[instance.firstJob + j].active = active;
            jobs[instance.firstJob + j].fresh = instance.fresh;
        }
        anyActive |= active && instance.jobCount > 0;
        if (!active) continue;
        --instance.movingUpdates;
        if (moved && instance.desc.visible && !instance.bounds.empty()) changedBoxes.push_back(boxOf(instance.bounds));
        moveDraws(*this, instance);
        if (moved && instance.desc.visible && !instance.bounds.empty()) changedBoxes.push_back(boxOf(instance.bounds));
        firstDirty = std::min(firstDirty, instance.firstDraw);
        endDirty = std::max(endDirty, instance.firstDraw + instance.drawCount);
        instance.transformChanged = instance.fresh = false;
    }
    if (firstDirty < endDirty)
        recordBuffer.write(firstDirty * sizeof(DrawRecord), std::as_bytes(std::span<const DrawRecord>(records).subspan(
                                                                firstDirty, endDirty - firstDirty)));

    bounds = {};
    for (const GeometryInstance& instance : instances)
        if (instance.desc.visible) bounds.add(instance.bounds);
    stats.skinnedVertices = 0;
    for (const SkinJob& job : jobs)
        if (job.active) stats.skinnedVertices += job.primitive->vertexCount;
    if (anyActive) skinner.run(jobs, poseRows, meshes);
}

}  // namespace shoal::frame
