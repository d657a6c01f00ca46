#include <shoal/frame/geometry.h>

#include <epoxy/gl.h>

#include <cmath>

#include "frame/fullscreen.h"
#include "frame/geometry_state.h"

namespace shoal::frame {
namespace {

using State = Geometry::State;

enum VertexBuffer { kPositions, kFrames, kAttributes, kUv1, kPrevious, kDrawIndices };

gl::VertexArray makeVertexArray(gl::Device& device, const char* label) {
    const gl::VertexAttribute attributes[] = {
        {SHOAL_ATTRIBUTE_POSITION, kPositions, 3, GL_FLOAT, false, false, 0},
        {SHOAL_ATTRIBUTE_NORMAL, kFrames, 2, GL_SHORT, true, false, 0},
        {SHOAL_ATTRIBUTE_TANGENT, kFrames, 4, GL_INT_2_10_10_10_REV, true, false, 4},
        {SHOAL_ATTRIBUTE_UV, kAttributes, 2, GL_FLOAT, false, false, 0},
        {SHOAL_ATTRIBUTE_COLOR, kAttributes, 4, GL_UNSIGNED_BYTE, true, false, 8},
        {SHOAL_ATTRIBUTE_UV1, kUv1, 2, GL_FLOAT, false, false, 0},
        {SHOAL_ATTRIBUTE_PREVIOUS, kPrevious, 3, GL_FLOAT, false, false, 0},
        {SHOAL_ATTRIBUTE_DRAW, kDrawIndices, 1, GL_UNSIGNED_INT, false, true, 0},
    };
    return gl::VertexArray::create(device, attributes, label);
}

const char* variantDefine(int variant) { return variant == 1 ? "BASE_TEXTURE" : "ALL_TEXTURES"; }

Result<void> buildPrograms(State& s) {
    gl::ProgramCache& cache = s.device->programs();
    using Defines = std::vector<std::pair<std::string, std::string>>;
    for (int variant = 0; variant < kSurfaceVariantCount; ++variant) {
        Defines defines;
        if (variant > 0) defines.push_back({variantDefine(variant), "1"});
        SHOAL_TRY_ASSIGN(s.surface[variant][0],
                         cache.get({{"frame/gbuffer.vert", "frame/gbuffer.frag"}, defines, "surfaces"}));
        if (variant > 0) {  // flat masked materials take the base texture variant with a white texture
            defines.push_back({"MASKED", "1"});
            SHOAL_TRY_ASSIGN(s.surface[variant][1],
                             cache.get({{"frame/gbuffer.vert", "frame/gbuffer.frag"}, defines, "masked surfaces"}));
            defines.pop_back();
        }
        defines.push_back({"FORWARD", "1"});
        SHOAL_TRY_ASSIGN(
            s.transparent[variant],
            cache.get({{"frame/gbuffer.vert", "frame/transparent.frag"}, defines, "transparent surfaces"}));
    }
    for (const bool masked : {false, true}) {
        for (const bool peeled : {false, true}) {
            std::vector<std::pair<std::string, std::string>> defines;
            if (masked) defines.emplace_back("MASKED", "1");
            if (peeled) defines.emplace_back("PEEL", "1");
            SHOAL_TRY_ASSIGN(s.depthOnly[masked][peeled],
                             cache.get({{"frame/depth_only.vert", "frame/depth_only.frag"}, defines, "depth only"}));
        }
    }
    return {};
}

bool finite(const Mat4& m) {
    for (const float x : m.m)
        if (!std::isfinite(x)) return false;
    return true;
}

constexpr std::size_t kMostDraws = std::size_t(1) << 24;  // primitives of all instances; records take 128 bytes each

}  // namespace

void State::addDraws(int index) {
    GeometryInstance& instance = instances[std::size_t(index)];
    const GpuModel& model = models[std::size_t(instance.desc.model)];
    instance.firstDraw = std::uint32_t(draws.size());
    instance.firstJob = std::uint32_t(jobs.size());
    for (std::size_t n = 0; n < model.skeleton.nodes.size(); ++n) {
        const Node& node = model.skeleton.nodes[n];
        if (node.mesh < 0 || matchesAny(instance.desc.hiddenNodes, node.name)) continue;
        for (const GpuPrimitive& p : model.meshes[std::size_t(node.mesh)]) {
            if (p.indexCount == 0) continue;
            Draw draw;
            draw.instance = index;
            draw.node = int(n);
            draw.firstIndex = p.firstIndex, draw.indexCount = p.indexCount, draw.baseVertex = p.firstVertex;
            draw.firstCoarse = p.firstCoarse, draw.coarseCount = p.coarseCount;
            if (p.coarseCount > 0) draw.coarseShare = p.coarseCell / std::max(length(p.bounds.size()), 1e-20f);
            draw.material = p.material;
            hasTransparent |= materials.at(p.material).transparent;
            draws.push_back(draw);
            drawPrimitives.push_back(&p);
            // A skin asks for a node that has one; without it the bind pose is drawn where the node is.
            const bool posed = (p.skinned && node.skin >= 0) || p.morphCount > 0;
            drawJob.push_back(posed ? int(jobs.size()) : -1);
            if (posed) {
                SkinJob job;
                job.primitive = &p;
                jobs.push_back(job);
            }
        }
    }
    instance.drawCount = std::uint32_t(draws.size()) - instance.firstDraw;
    instance.jobCount = std::uint32_t(jobs.size()) - instance.firstJob;
    structureChanged = true;
}

Geometry::Geometry(std::unique_ptr<State> state) : state_(std::move(state)) {}
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;
Geometry::~Geometry() = default;

Result<Geometry> Geometry::create(gl::Device& device) {
    registerFrameShaders();
    SHOAL_TRY_ASSIGN(MaterialStore materials, MaterialStore::create(device));
    SHOAL_TRY_ASSIGN(Skinner skinner, Skinner::create(device));
    auto state = std::make_unique<State>(device, std::move(materials), std::move(skinner));
    SHOAL_TRY(buildPrograms(*state));
    state->staticVertices = makeVertexArray(device, "static vertices");
    state->posedVertices[0] = makeVertexArray(device, "posed vertices");
    state->posedVertices[1] = makeVertexArray(device, "posed vertices");
    state->viewBlock = gl::BlockBuffer<ViewBlock>::create(device, "view block");
    state->depthViewBlock = gl::BlockBuffer<ViewBlock>::create(device, "depth view block");
    return Geometry(std::move(state));
}

Result<ModelId> Geometry::addModel(const Model& model) {
    State& s = *state_;
    SHOAL_TRY_ASSIGN(const int firstMaterial, s.materials.add(model));
    SHOAL_TRY_ASSIGN(GpuModel gpu, s.meshes.add(*s.device, model, firstMaterial, s.materials));
    s.models.push_back(std::move(gpu));
    s.structureChanged = true;
    return int(s.models.size()) - 1;
}

Result<InstanceId> Geometry::addInstance(const InstanceDesc& desc) {
    State& s = *state_;
    SHOAL_ASSERT_MSG(desc.model >= 0 && std::size_t(desc.model) < s.models.size(), "instance of an unknown model");
    const GpuModel& model = s.models[std::size_t(desc.model)];
    if (!finite(desc.worldFromModel))
        return badInput("instance of " + model.skeleton.name + ": its transform is not finite");
    if (desc.clip >= int(model.skeleton.clips.size()))
        return badInput("instance of " + model.skeleton.name + ": clip is " + std::to_string(desc.clip) +
                        ", expected less than " + std::to_string(model.skeleton.clips.size()));
    std::size_t added = 0;
    for (const Node& node : model.skeleton.nodes)
        if (node.mesh >= 0) added += model.meshes[std::size_t(node.mesh)].size();
    if (s.draws.size() + added > kMostDraws)
        return badInput("instances have " + std::to_string(s.draws.size() + added) +
                        " primitives together, expected at most " + std::to_string(kMostDraws));
    GeometryInstance instance;
    instance.desc = desc;
    instance.animated = desc.clip >= 0;
    if (desc.objectId == 0) instance.desc.objectId = std::uint32_t(s.instances.size()) + 1;
    s.instances.push_back(std::move(instance));
    s.addDraws(int(s.instances.size()) - 1);
    return int(s.instances.size()) - 1;
}

void Geometry::setTransform(InstanceId id, const Mat4& worldFromModel) {
    SHOAL_ASSERT(id >= 0 && std::size_t(id) < state_->instances.size());
    GeometryInstance& instance = state_->instances[std::size_t(id)];
    if (instance.desc.worldFromModel == worldFromModel) return;
    instance.desc.worldFromModel = worldFromModel;
    instance.transformChanged = true;
}

void Geometry::setVisible(InstanceId id, bool visible) {
    SHOAL_ASSERT(id >= 0 && std::size_t(id) < state_->instances.size());
    GeometryInstance& instance = state_->instances[std::size_t(id)];
    if (instance.desc.visible == visible) return;
    instance.desc.visible = visible;
    instance.visibilityChanged = !instance.visibilityChanged;
}

void Geometry::setDraftsWanted(bool wanted) { state_->meshes.wantsCoarse = wanted; }

void Geometry::clear() {
    State& s = *state_;
    s.models.clear(), s.instances.clear(), s.draws.clear(), s.drawPrimitives.clear(), s.drawJob.clear();
    s.records.clear(), s.jobs.clear(), s.poseRows.clear(), s.batches.clear();
    s.changedBoxes.clear();
    s.meshes.clear();
    // The default material was uploaded before: its storage is there.
    if (const Result<void> cleared = s.materials.clear(); !cleared)
        s.device->log(LogLevel::error, cleared.error().message);
    s.bounds = {};
    s.hasTransparent = false;
    s.structureChanged = true;
    s.updatedFrame.reset();
}

void Geometry::update(const Context& context) { state_->update(context); }

bool Geometry::hasTransparent() const { return state_->hasTransparent; }
Bounds Geometry::bounds() const { return state_->bounds; }
Bounds Geometry::bounds(InstanceId id) const {
    SHOAL_ASSERT(id >= 0 && std::size_t(id) < state_->instances.size());
    return state_->instances[std::size_t(id)].bounds;
}
bool Geometry::changed(const light::View& view) const {
    const Frustum frustum(view.clipFromWorld());
    for (const Box& box : state_->changedBoxes)
        if (frustum.sees(box)) return true;
    return false;
}
const GeometryStats& Geometry::stats() const { return state_->stats; }

}  // namespace shoal::frame
