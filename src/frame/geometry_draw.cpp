// Draws into views: surfaces, depth alone, transparent surfaces.
#include <epoxy/gl.h>

#include <algorithm>

#include "frame/geometry_state.h"

namespace shoal::frame {
namespace {

using State = Geometry::State;

// Casters smaller than this many texels in a shadow map leave no shadow.
constexpr float kLeastCasterTexels = 0.75f;
// Drafts leave out what is smaller, and take coarse triangles where those are off by less.
constexpr float kLeastDraftPx = 1, kMostCoarsePx = 2.5f;

void setRaster(bool depthWrite, bool blend) {
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);  // reversed z
    glDepthMask(depthWrite ? GL_TRUE : GL_FALSE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    if (blend)
        glEnable(GL_BLEND), glBlendEquation(GL_FUNC_ADD), glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    else
        glDisable(GL_BLEND);
}

void setCulling(const BatchKey& key) {
    glFrontFace(key.mirrored ? GL_CW : GL_CCW);
    if (key.doubleSided) {
        glDisable(GL_CULL_FACE);
    } else {
        glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
    }
}

void drawRun(const CommandList& commands, const DrawRun& run) {
    const std::size_t offset = commands.byteOffset() + run.first * sizeof(DrawCommand);
    glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                                GLsizei(run.count), 0);
}

}  // namespace

void State::collect(const Mat4& clipFromWorld, const Mat4& viewFromWorld, bool depth, bool transparentOnes,
                    float leastSize, DraftView draft) {
    const Frustum frustum(clipFromWorld);
    const Vec3 axis{-viewFromWorld(2, 0), -viewFromWorld(2, 1), -viewFromWorld(2, 2)};
    const float origin = -viewFromWorld(2, 3);
    std::vector<CommandList::Item>& items = commands.items();
    items.clear();
    for (std::size_t d = 0; d < draws.size(); ++d) {
        const Draw& draw = draws[d];
        if (!draw.visible || (depth ? !draw.castsShadow : draw.transparent != transparentOnes)) continue;
        if (std::max({draw.box.half.x, draw.box.half.y, draw.box.half.z}) < 0.5f * leastSize) continue;
        if (!frustum.sees(draw.box)) continue;
        const Vec3 h = draw.box.half;
        const float reach = std::abs(axis.x) * h.x + std::abs(axis.y) * h.y + std::abs(axis.z) * h.z;
        const float center = dot(axis, draw.box.center) + origin;
        bool coarse = false;
        if (draft.pixelsPerMetre > 0) {
            const float perMetre =
                draft.orthographic ? draft.pixelsPerMetre : draft.pixelsPerMetre / std::max(center - reach, 1e-3f);
            const float sizePx = 2 * length(h) * perMetre;
            if (sizePx < kLeastDraftPx) continue;
            coarse = draw.coarseCount > 0 && draw.coarseShare * sizePx < kMostCoarsePx;
        }
        items.push_back({std::uint32_t(d), depth ? draw.depthBatch : draw.batch,
                         transparentOnes ? center : center - reach, coarse});
    }
    commands.build(*device, draws,
                   transparentOnes ? CommandList::Order::backToFront : CommandList::Order::batchesFrontToBack);
}

void State::bindShared() const {
    recordBuffer.bindStorage(SHOAL_STORAGE_INSTANCES);
    materials.bindRecords();
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.buffer().name());
}

void Geometry::drawSurfaces(const Context& context, const GBuffer& target) {
    State& s = *state_;
    const gl::PassScope pass(context.timer, "draw surfaces");
    const ViewBlock block = makeViewBlock(context);
    DraftView draft;
    if (context.draft)
        draft = {0.5f * context.view.clipFromView(1, 1) * float(context.view.height), context.view.orthographic};
    s.collect(block.clipFromWorld, block.viewFromWorld, false, false, 0, draft);
    s.stats.drawnTriangles = s.commands.triangleCount();
    s.stats.draws = std::int64_t(s.commands.commands().size());
    s.stats.instances = std::int64_t(s.instances.size());
    if (s.commands.runs().empty()) return;

    s.viewBlock.write(block);
    s.viewBlock.bindUniform(SHOAL_BLOCK_VIEW);
    s.bindShared();
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    glViewport(0, 0, target.width, target.height);
    setRaster(true, false);
    const bool clipped = context.clipPlane != Vec4{0, 0, 0, 1};
    if (clipped) glEnable(GL_CLIP_DISTANCE0);
    for (const DrawRun& run : s.commands.runs()) {
        const BatchKey& key = s.batches.at(run.batch);
        s.surface[int(key.variant)][key.masked ? 1 : 0]->use();
        (key.posed ? s.posedVertices[s.skinner.current()] : s.staticVertices).bind();
        if (key.material >= 0) s.materials.bind(key.material);
        setCulling(key);
        drawRun(s.commands, run);
    }
    if (clipped) glDisable(GL_CLIP_DISTANCE0);
}

void Geometry::drawDepth(const Context& context, const NeededView& view) {
    State& s = *state_;
    const gl::PassScope pass(context.timer, view.purpose == NeededView::Purpose::sunShadow    ? "sun shadow"
                                            : view.purpose == NeededView::Purpose::spotShadow ? "spot shadow"
                                                                                              : "light depth");
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, view.framebuffer);
    glViewport(0, 0, view.view.width, view.view.height);
    setRaster(true, false);
    const GLfloat farAway = 0;  // reversed z
    glClearNamedFramebufferfv(view.framebuffer, GL_DEPTH, 0, &farAway);

    // Orthographic maps have one texel size; there, what is smaller than a texel need not be drawn.
    const float texel = view.view.orthographic ? 2 / (view.view.clipFromView(0, 0) * float(view.view.width)) : 0;
    s.collect(view.view.clipFromWorld(), view.view.viewFromWorld, true, false, kLeastCasterTexels * texel);
    if (s.commands.runs().empty()) return;
    s.depthViewBlock.write(makeViewBlock(view.view));
    s.depthViewBlock.bindUniform(SHOAL_BLOCK_VIEW);
    s.bindShared();
    if (view.peel) {
        gl::bindTexture(SHOAL_UNIT_PASS, view.peel);
        glBindSampler(SHOAL_UNIT_PASS, 0);
        glTextureBarrier();
    }
    for (const DrawRun& run : s.commands.runs()) {
        const BatchKey& key = s.batches.at(run.batch);
        const gl::Program& program = *s.depthOnly[key.masked][bool(view.peel)];
        program.use();
        if (view.peel) program.set(0, Vec2{float(view.peelLayer), view.peelGap});
        (key.posed ? s.posedVertices[s.skinner.current()] : s.staticVertices).bind();
        if (key.material >= 0) s.materials.bind(key.material);
        setCulling(key);
        drawRun(s.commands, run);
    }
}

void Geometry::drawTransparent(const Context& context, gl::TextureView opaqueCopy, gl::TextureView viewDepth) {
    State& s = *state_;
    const gl::PassScope pass(context.timer, "draw transparent");
    const ViewBlock block = makeViewBlock(context);
    s.collect(block.clipFromWorld, block.viewFromWorld, false, true, 0);
    if (s.commands.runs().empty()) return;
    s.viewBlock.write(block);
    s.viewBlock.bindUniform(SHOAL_BLOCK_VIEW);
    s.bindShared();
    gl::bindTexture(SHOAL_UNIT_OPAQUE_COPY, opaqueCopy);
    glBindSampler(SHOAL_UNIT_OPAQUE_COPY, 0);
    gl::bindTexture(SHOAL_UNIT_OPAQUE_DEPTH, viewDepth);
    glBindSampler(SHOAL_UNIT_OPAQUE_DEPTH, 0);
    setRaster(false, true);
    for (const DrawRun& run : s.commands.runs()) {
        const BatchKey& key = s.batches.at(run.batch);
        s.transparent[int(key.variant)]->use();
        (key.posed ? s.posedVertices[s.skinner.current()] : s.staticVertices).bind();
        if (key.material >= 0) s.materials.bind(key.material);
        setCulling(key);
        if (!key.doubleSided) {
            drawRun(s.commands, run);
            continue;
        }
        // Insides first: the far side of a closed shape lies behind its near side.
        glEnable(GL_CULL_FACE);
        for (const GLenum hidden : {GLenum(GL_FRONT), GLenum(GL_BACK)}) {
            glCullFace(hidden);
            drawRun(s.commands, run);
        }
    }
}

}  // namespace shoal::frame
