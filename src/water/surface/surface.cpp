// The water surface as it is seen: drawn as a grid, each pixel's way through the water followed, and composed.
#include <shoal/water/surface.h>

#include <epoxy/gl.h>

#include <cmath>
#include <cstdint>

#include <shoal/water/gpu_waves.h>

#include "frame/bindings.shared.h"
#include "frame/fullscreen.h"
#include "frame/view_block.h"
#include "water/bindings.shared.h"
#include "water/surface/surface_grid.h"
#include "water/surface/surface_views.h"
#include "water/surface/water_block.h"

namespace shoal::water {
namespace {

constexpr std::size_t kMostBlocks = 28 * 64;
constexpr int kIndexCount = SHOAL_GRID_CELLS * SHOAL_GRID_CELLS * 6;

std::vector<std::uint16_t> gridIndices() {
    std::vector<std::uint16_t> indices;
    constexpr int kSide = SHOAL_GRID_CELLS + 1;
    for (int j = 0; j < SHOAL_GRID_CELLS; ++j)
        for (int i = 0; i < SHOAL_GRID_CELLS; ++i) {
            const int a = j * kSide + i, b = a + 1, c = a + kSide, d = c + 1;
            for (const int v : {a, d, b, a, c, d}) indices.push_back(std::uint16_t(v));  // counter-clockwise from above
        }
    return indices;
}

// Whether pixels may begin on both sides of the surface: points of the near plane lie within its diagonal of the eye.
bool mayCross(const light::View& view, const Body& body) {
    const float height = body.waves ? float(body.waves->bounds().height) : 0.0f;
    const float reach = length(transformPoint(view.viewFromClip, {1, 1, 1})) * 1.5f + view.nearZ;
    return body.params.surfaceVisible && std::abs(view.eye.y - body.params.level) < height + reach;
}

using Defines = std::vector<std::pair<std::string, std::string>>;

struct TracePrograms {
    const gl::Program *mesh = nullptr, *path = nullptr;
};

}  // namespace

struct Surface::State {
    explicit State(gl::Device& d) : device(d) {}

    gl::Device& device;
    frame::Fullscreen fullscreen;
    TracePrograms traces[2][4];          // far from the surface and CROSSING; by what the waves lack
    const gl::Program* compose[2] = {};  // without and with foam
    const gl::Program* terms = nullptr;
    gl::BlockBuffer<frame::ViewBlock> viewBlock;
    gl::BlockBuffer<WaterBlock> waterBlock;
    gl::BlockBuffer<SurfaceBlock> block;
    gl::Buffer indices, blocks;
    gl::VertexArray vertices;
    gl::Sampler smooth;

    gl::Texture surfaceDepth, surfaceNormal, spread, path_, depth;
    gl::Framebuffer meshTarget, pathTarget;
    bool termsWanted = false;
    gl::Texture transmittance, waterDepth;
    gl::Framebuffer termsTarget;

    std::vector<ChosenView> chosen;
    std::vector<MirrorView> needed;
    std::vector<SurfaceInputs::Mirror> mirrors;
    SurfaceGrid grid;

    Result<TracePrograms> makeTrace(bool crossing, Defines defines);
    const TracePrograms& traceFor(bool crossing, const WaveField* waves);
    Result<void> makePrograms();
    Result<void> makeBuffers();
    Result<void> resize(int width, int height);
    Result<void> resizeTerms(int width, int height);
    SurfaceBlock blockFor(const SurfaceParams& params, std::span<const SurfaceInputs::Mirror> drawn,
                          bool inscatter) const;
    void drawMesh(const frame::Context& context, const Body& body, gl::TextureView opaque, const gl::Program& mesh);
    void bindPaths() const;
    void drawTerms(const frame::Context& context, const SurfaceInputs& inputs);
};

Result<TracePrograms> Surface::State::makeTrace(bool crossing, Defines defines) {
    if (crossing) defines.emplace_back("CROSSING", "1");
    TracePrograms made;
    SHOAL_TRY_ASSIGN(
        made.mesh,
        device.programs().get({{"water/surface_mesh.vert", "water/surface_mesh.frag"}, defines, "water surface"}));
    SHOAL_TRY_ASSIGN(made.path, frame::fullscreenProgram(device, "water/surface_path.frag", defines));
    return made;
}

// Those that leave out the kinds of waves which the field lacks are built when they are first needed.
const TracePrograms& Surface::State::traceFor(bool crossing, const WaveField* waves) {
    const Defines defines = waves ? waveDefines(*waves) : Defines{};
    std::size_t lacks = 0;
    for (const auto& define : defines) lacks |= define.first == "SHOAL_WAVES_NO_TILES" ? 1 : 2;
    TracePrograms& wanted = traces[crossing][lacks];
    if (wanted.mesh) return wanted;
    auto made = makeTrace(crossing, defines);
    if (!made) device.log(LogLevel::error, made.error().message);
    return wanted = made ? *made : traces[crossing][0];
}

Result<void> Surface::State::makePrograms() {
    for (const bool crossing : {false, true}) {
        SHOAL_TRY_ASSIGN(traces[crossing][0], makeTrace(crossing, {}));
    }
    SHOAL_TRY_ASSIGN(compose[0], frame::fullscreenProgram(device, "water/surface_compose.frag"));
    SHOAL_TRY_ASSIGN(compose[1], frame::fullscreenProgram(device, "water/surface_compose.frag", {{"FOAM", "1"}}));
    SHOAL_TRY_ASSIGN(terms, frame::fullscreenProgram(device, "water/surface_terms.frag"));
    return {};
}

Result<void> Surface::State::makeBuffers() {
    viewBlock = gl::BlockBuffer<frame::ViewBlock>::create(device, "water surface view");
    waterBlock = gl::BlockBuffer<WaterBlock>::create(device, "water surface body");
    block = gl::BlockBuffer<SurfaceBlock>::create(device, "water surface");
    const std::vector<std::uint16_t> order = gridIndices();
    indices = gl::Buffer::of(device, std::span<const std::uint16_t>(order), "water grid indices");
    blocks = gl::Buffer::create(device, kMostBlocks * sizeof(GridBlock), "water grid blocks");
    vertices = gl::VertexArray::create(device, {}, "water grid");
    smooth = gl::Sampler::create(device, GL_LINEAR, GL_LINEAR, GL_CLAMP_TO_EDGE, GL_CLAMP_TO_EDGE);
    if (!indices || !blocks || !vertices || !smooth) return internalError("no memory for the water surface");
    vertices.setIndices(indices.view());
    return {};
}

Result<void> Surface::State::resize(int width, int height) {
    if (path_ && path_.width() == width && path_.height() == height) return {};
    surfaceDepth = frame::makeTarget(device, GL_R32F, width, height, "water surface depth");
    surfaceNormal = frame::makeTarget(device, GL_RG16, width, height, "water surface normal");
    spread = frame::makeTarget(device, GL_R16F, width, height, "water surface slopes");
    path_ = frame::makeTarget(device, GL_RGBA16F, width, height, "water path");
    depth = frame::makeTarget(device, GL_DEPTH_COMPONENT32F, width, height, "water surface z");
    if (!surfaceDepth || !surfaceNormal || !spread || !path_ || !depth)
        return internalError("no memory for a water surface of this size");
    const gl::Framebuffer::Attachment seen[] = {{surfaceDepth.view()}, {surfaceNormal.view()}, {spread.view()}};
    SHOAL_TRY_ASSIGN(meshTarget, gl::Framebuffer::create(device, seen, {depth.view()}, "water surface"));
    const gl::Framebuffer::Attachment ways[] = {{path_.view()}};
    SHOAL_TRY_ASSIGN(pathTarget, gl::Framebuffer::create(device, ways, {}, "water path"));
    return {};
}

Result<void> Surface::State::resizeTerms(int width, int height) {
    if (termsTarget && transmittance.width() == width && transmittance.height() == height) return {};
    transmittance = frame::makeTarget(device, GL_RGBA16F, width, height, "water transmittance");
    waterDepth = frame::makeTarget(device, GL_R32F, width, height, "water depth");
    if (!transmittance || !waterDepth) return internalError("no memory for the water's terms");
    const gl::Framebuffer::Attachment to[] = {{transmittance.view()}, {waterDepth.view()}};
    SHOAL_TRY_ASSIGN(termsTarget, gl::Framebuffer::create(device, to, {}, "water terms"));
    return {};
}

SurfaceBlock Surface::State::blockFor(const SurfaceParams& params, std::span<const SurfaceInputs::Mirror> drawn,
                                      bool inscatter) const {
    SurfaceBlock b;
    b.grid = {grid.cell, grid.middle.x, grid.middle.y, inscatter ? 1.0f : 0.0f};
    b.look = {params.roughness * params.roughness, params.foam ? 1.0f : 0.0f, params.foamDepth, 0};
    for (Vec4& size : b.mirrorSize) size = {1, 1, 0, 0};
    for (std::size_t i = 0; i < std::min(chosen.size(), drawn.size()); ++i) {
        const SurfaceInputs::Mirror& m = drawn[i];
        if (!m.radiance || !m.viewDepth) continue;
        const int k = int(chosen[i].shows);
        b.clipFromWorld[k] = m.view.clipFromWorld();
        const Mat4& v = m.view.viewFromWorld;
        b.depthRow[k] = {-v(2, 0), -v(2, 1), -v(2, 2), -v(2, 3)};
        b.mirrorSize[k] = {float(m.viewDepth.width), float(m.viewDepth.height), 1, 0};
        if (k == kBentView) b.bentEye = {m.view.eye.x, m.view.eye.y, m.view.eye.z, 1};
    }
    return b;
}

void Surface::State::drawMesh(const frame::Context& context, const Body& body, gl::TextureView opaque,
                              const gl::Program& mesh) {
    const gl::PassScope pass(context.timer, "water surface");
    meshTarget.bind();
    const float zero[4] = {};
    for (int i = 0; i < 3; ++i) glClearNamedFramebufferfv(meshTarget.name(), GL_COLOR, i, zero);
    if (!body.params.surfaceVisible || grid.blocks.empty()) return;
    glCopyImageSubData(opaque.name, opaque.target, 0, 0, 0, 0, depth.name(), GL_TEXTURE_2D, 0, 0, 0, 0, depth.width(),
                       depth.height(), 1);
    blocks.writeAll(std::span<const GridBlock>(grid.blocks));
    blocks.bindStorage(SHOAL_STORAGE_WATER);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);  // reversed z
    glDepthMask(GL_TRUE);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (const GLenum off : {GL_BLEND, GL_CULL_FACE, GL_SCISSOR_TEST, GL_STENCIL_TEST, GL_POLYGON_OFFSET_FILL})
        glDisable(off);
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    mesh.use();
    vertices.bind();
    glDrawElementsInstanced(GL_TRIANGLES, kIndexCount, GL_UNSIGNED_SHORT, nullptr, GLsizei(grid.blocks.size()));
}

void Surface::State::bindPaths() const {
    const std::pair<int, gl::TextureView> textures[] = {{SHOAL_UNIT_WATER_SURFACE, surfaceDepth.view()},
                                                        {SHOAL_UNIT_WATER_NORMAL, surfaceNormal.view()},
                                                        {SHOAL_UNIT_WATER_PATH, path_.view()}};
    for (const auto& [unit, texture] : textures) {
        gl::bindTexture(unit, texture);
        glBindSampler(GLuint(unit), 0);
    }
}

void Surface::State::drawTerms(const frame::Context& context, const SurfaceInputs& inputs) {
    if (const auto made = resizeTerms(inputs.viewDepth.width, inputs.viewDepth.height); !made) {
        device.log(LogLevel::error, made.error().message);
        return;
    }
    const gl::PassScope pass(context.timer, "water terms");
    termsTarget.bind();
    fullscreen.draw(*terms);
}

Surface::Surface(std::unique_ptr<State> state) : state_(std::move(state)) {}
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;
Surface::~Surface() = default;

Result<Surface> Surface::create(gl::Device& device) {
    frame::registerFrameShaders();
    registerWaterShaders();
    auto state = std::make_unique<State>(device);
    state->fullscreen = frame::Fullscreen::create(device);
    SHOAL_TRY(state->makePrograms());
    SHOAL_TRY(state->makeBuffers());
    state->grid.blocks.reserve(kMostBlocks);
    return Surface(std::move(state));
}

void Surface::prepare(const frame::Context& context, const SurfaceParams& params, const Body& body,
                      const Bounds& sceneBounds) {
    State& s = *state_;
    s.chosen = chooseViews(context, params, body, sceneBounds);
    s.needed.clear();
    s.mirrors.clear();
    for (const ChosenView& view : s.chosen) s.needed.push_back(view.view);
}

std::span<const Surface::MirrorView> Surface::neededViews() const { return state_->needed; }

void Surface::useMirrors(std::span<const SurfaceInputs::Mirror> mirrors) {
    state_->mirrors.assign(mirrors.begin(), mirrors.end());
}

void Surface::trace(const frame::Context& context, const SurfaceParams& params, const Body& body,
                    gl::TextureView viewDepth, gl::TextureView depth) {
    State& s = *state_;
    if (const auto sized = s.resize(viewDepth.width, viewDepth.height); !sized) {
        s.device.log(LogLevel::error, sized.error().message);
        return;
    }
    layOutGrid(context.view, body, s.grid);
    s.viewBlock.write(frame::makeViewBlock(context));
    s.viewBlock.bindUniform(SHOAL_BLOCK_VIEW);
    s.waterBlock.write(makeWaterBlock(body, {}));
    s.waterBlock.bindUniform(SHOAL_BLOCK_WATER);
    s.block.write(s.blockFor(params, s.mirrors, false));
    s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
    body.gpuWaves->bind();
    const TracePrograms& programs = s.traceFor(mayCross(context.view, body), body.waves);
    s.drawMesh(context, body, depth, *programs.mesh);

    const gl::PassScope pass(context.timer, "water path");
    s.pathTarget.bind();
    s.bindPaths();
    gl::TextureView bentDepth = viewDepth;  // not looked at
    for (std::size_t i = 0; i < std::min(s.chosen.size(), s.mirrors.size()); ++i)
        if (s.chosen[i].shows == kBentView && s.mirrors[i].viewDepth) bentDepth = s.mirrors[i].viewDepth;
    gl::bindTexture(SHOAL_UNIT_PASS, viewDepth);
    gl::bindTexture(SHOAL_UNIT_PASS + 1, bentDepth);
    glBindSampler(SHOAL_UNIT_PASS, 0);
    glBindSampler(SHOAL_UNIT_PASS + 1, 0);
    s.fullscreen.draw(*programs.path);
}

WaterPaths Surface::paths() const {
    return {state_->surfaceDepth.view(), state_->surfaceNormal.view(), state_->path_.view()};
}

void Surface::compose(const frame::Context& context, const SurfaceParams& params, const Body& body,
                      const BodyLights& lights, const SurfaceInputs& inputs) {
    State& s = *state_;
    s.viewBlock.write(frame::makeViewBlock(context));
    s.viewBlock.bindUniform(SHOAL_BLOCK_VIEW);
    s.waterBlock.write(makeWaterBlock(body, lights));
    s.waterBlock.bindUniform(SHOAL_BLOCK_WATER);
    s.block.write(s.blockFor(params, inputs.mirrors, bool(inputs.inscatter)));
    s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
    body.gpuWaves->bind();
    s.bindPaths();
    const gl::TextureView none = inputs.viewDepth;  // not looked at
    gl::TextureView textures[] = {none, none, inputs.inscatter ? inputs.inscatter : none, s.spread.view(), none, none,
                                  none, none};
    constexpr int kFirstOf[] = {4, 6, 0};  // by Mirror
    for (std::size_t i = 0; i < std::min(s.chosen.size(), inputs.mirrors.size()); ++i)
        if (inputs.mirrors[i].radiance && inputs.mirrors[i].viewDepth) {
            textures[kFirstOf[s.chosen[i].shows]] = inputs.mirrors[i].radiance;
            textures[kFirstOf[s.chosen[i].shows] + 1] = inputs.mirrors[i].viewDepth;
        }
    for (int i = 0; i < 8; ++i) {
        gl::bindTexture(SHOAL_UNIT_PASS + i, textures[i]);
        glBindSampler(GLuint(SHOAL_UNIT_PASS + i), 0);
    }
    gl::bindTexture(SHOAL_UNIT_OPAQUE_COPY, inputs.radiance);
    s.smooth.bind(SHOAL_UNIT_OPAQUE_COPY);
    gl::bindTexture(SHOAL_UNIT_OPAQUE_DEPTH, inputs.viewDepth);
    glBindSampler(SHOAL_UNIT_OPAQUE_DEPTH, 0);
    {
        const gl::PassScope pass(context.timer, "water composition");
        s.fullscreen.draw(*s.compose[params.foam ? 1 : 0]);
    }
    glBindSampler(SHOAL_UNIT_OPAQUE_COPY, 0);
    if (s.termsWanted) s.drawTerms(context, inputs);
}

void Surface::setTermsWanted(bool wanted) { state_->termsWanted = wanted; }
gl::TextureView Surface::transmittance() const { return state_->transmittance.view(); }
gl::TextureView Surface::waterDepth() const { return state_->waterDepth.view(); }

frame::Stats Surface::stats() const {
    const State& s = *state_;
    const std::int64_t pixels = std::int64_t(s.path_.width()) * s.path_.height();
    constexpr std::int64_t kBytesPerPixel = 4 + 4 + 2 + 8 + 4;
    frame::Stats stats;
    stats.bytes = pixels * kBytesPerPixel + std::int64_t(s.indices.bytes() + s.blocks.bytes());
    if (s.termsTarget) stats.bytes += pixels * (8 + 4);
    stats.counts = {{"water grid blocks", std::int64_t(s.grid.blocks.size())},
                    {"mirrored views", std::int64_t(s.needed.size())}};
    return stats;
}

}  // namespace shoal::water
