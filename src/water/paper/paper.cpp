// [Papadopoulos & Papaioannou 2010] Realistic Real-time Underwater Caustics and Godrays. include/shoal/water/paper.h
// lists what it leaves open and how that is settled here.
#include <shoal/water/paper.h>

#include <epoxy/gl.h>

#include <cmath>
#include <string>

#include <shoal/water/gpu_waves.h>

#include "frame/fullscreen.h"
#include "water/bindings.shared.h"
#include "water/paper/paper_block.h"
#include "water/surface/water_block.h"

namespace shoal::water {

namespace {

// A grid of points in the light's screen space, made once (4.1).
struct Grid {
    int side = 0;
    gl::Buffer points;
    gl::VertexArray array;
};

// A target at a fraction of the window, with the eye's depth at its size and a second one for the filter.
struct PaperBuffer {
    gl::Texture raw, filtered, depth;
    gl::Framebuffer toRaw, toFiltered;
    bool usable() const { return bool(toRaw) && bool(toFiltered); }
};

using Defines = std::vector<std::pair<std::string, std::string>>;

}  // namespace

struct PaperMethod::State {
    gl::Device* device = nullptr;
    frame::Fullscreen fullscreen;
    gl::VertexArray nothing;
    const gl::Program *mask = nullptr, *depth = nullptr, *filter = nullptr, *direct = nullptr, *inscatter = nullptr;
    const gl::Program *causticTracer = nullptr, *godrayTracer = nullptr;  // of this light and number of steps
    Defines tracerDefines;
    gl::BlockBuffer<PaperBlock> block;
    PaperBlock values{};  // of the last render
    gl::Texture shadow, waterMask;
    gl::Framebuffer toShadow, toMask;
    Grid causticGrid, godrayGrid;
    PaperBuffer caustics, godrays;
    bool filtered = true;
    PaperLight light;
    std::vector<frame::NeededView> views;
    Mat4 lastClipFromWorld;
    bool asked = false;

    Result<void> makePrograms();
    Result<void> makeLightTargets();
    Result<void> makeTracers(const Body& body, int steps, bool lamp);
    Result<void> makeGrid(Grid& grid, int side, const char* label);
    Result<void> makeBuffer(PaperBuffer& buffer, IVec2 size, const char* label);
    Result<void> makeSized(const frame::Context& context, const PaperParams& params, const Body& body);
    void drawMask(const frame::Context& context);
    void shrinkDepth(const PaperBuffer& buffer, gl::TextureView depth) const;
    void addUp(const PaperBuffer& buffer, const Grid& grid, const gl::Program& tracer) const;
    void lowPass(const PaperBuffer& buffer) const;
};

namespace {

using State = PaperMethod::State;

gl::Texture makeTexture(gl::Device& device, gl::Enum format, IVec2 size, gl::Enum filter, const char* label) {
    gl::TextureDesc desc;
    desc.format = format;
    desc.width = size.x, desc.height = size.y;
    desc.minFilter = desc.magFilter = filter;
    desc.label = label;
    return gl::Texture::create(device, desc);
}

void bindPlain(int unit, const gl::TextureView& texture) {
    gl::bindTexture(unit, texture);
    glBindSampler(GLuint(unit), 0);
}

void setPlainState() {
    glDisable(GL_CULL_FACE);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_STENCIL_TEST);
    glDisable(GL_BLEND);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void clearColor(const gl::Framebuffer& framebuffer) {
    const GLfloat zero[4] = {0, 0, 0, 0};
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, zero);
}

}  // namespace

Result<void> State::makePrograms() {
    gl::ProgramCache& programs = device->programs();
    SHOAL_TRY_ASSIGN(mask, programs.get({{"water/paper_mask.vert", "water/paper_mask.frag"}, {}, "paper water mask"}));
    SHOAL_TRY_ASSIGN(depth, frame::fullscreenProgram(*device, "water/paper_depth.frag"));
    SHOAL_TRY_ASSIGN(filter, frame::fullscreenProgram(*device, "water/paper_filter.frag"));
    SHOAL_TRY_ASSIGN(direct, programs.get({{"water/paper_direct.comp"}, {}, "paper caustics to full size"}));
    SHOAL_TRY_ASSIGN(inscatter, programs.get({{"water/paper_inscatter.comp"}, {}, "paper god rays to full size"}));
    return makeTracers({}, PaperParams{}.newtonSteps, false);
}

Result<void> State::makeTracers(const Body& body, int steps, bool lamp) {
    Defines defines = body.waves ? waveDefines(*body.waves) : Defines{};
    defines.emplace_back("NEWTON_STEPS", std::to_string(steps));
    if (lamp) defines.emplace_back("PAPER_LAMP", "1");
    if (causticTracer && godrayTracer && defines == tracerDefines) return {};
    gl::ProgramCache& programs = device->programs();
    SHOAL_TRY_ASSIGN(causticTracer,
                     programs.get({{"water/paper_grid.vert", "water/paper_caustics.geom", "water/paper_caustics.frag"},
                                   defines,
                                   "paper caustics"}));
    SHOAL_TRY_ASSIGN(godrayTracer,
                     programs.get({{"water/paper_grid.vert", "water/paper_godrays.geom", "water/paper_godrays.frag"},
                                   defines,
                                   "paper god rays"}));
    tracerDefines = std::move(defines);
    return {};
}

Result<void> State::makeLightTargets() {
    const IVec2 size{kPaperShadowResolution, kPaperShadowResolution};
    shadow = makeTexture(*device, GL_DEPTH_COMPONENT32F, size, GL_NEAREST, "paper shadow map");
    waterMask = makeTexture(*device, GL_R8, size, GL_NEAREST, "paper water mask");
    if (!shadow || !waterMask) return internalError("no memory for the paper's shadow map");
    const gl::Framebuffer::Attachment maskColor[] = {{waterMask.view()}};
    SHOAL_TRY_ASSIGN(toShadow, gl::Framebuffer::create(*device, {}, {shadow.view()}, "paper shadow map"));
    SHOAL_TRY_ASSIGN(toMask, gl::Framebuffer::create(*device, maskColor, {shadow.view()}, "paper water mask"));
    return {};
}

Result<void> State::makeGrid(Grid& grid, int side, const char* label) {
    if (grid.side == side) return {};
    std::vector<Vec2> points;
    points.reserve(std::size_t(side) * std::size_t(side));
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            points.push_back({(2 * float(x) + 1) / float(side) - 1, (2 * float(y) + 1) / float(side) - 1});
    grid.points = gl::Buffer::of<Vec2>(*device, points, label);
    if (!grid.points) return internalError("no memory for the paper's photon grid");
    const gl::VertexAttribute place{.location = 0, .buffer = 0, .componentCount = 2};
    grid.array = gl::VertexArray::create(*device, std::span(&place, 1), label);
    grid.array.setBuffer(0, grid.points.view(), int(sizeof(Vec2)));
    grid.side = side;
    return {};
}

Result<void> State::makeBuffer(PaperBuffer& buffer, IVec2 size, const char* label) {
    if (buffer.usable() && buffer.raw.width() == size.x && buffer.raw.height() == size.y) return {};
    buffer = {};
    buffer.raw = makeTexture(*device, GL_RGBA16F, size, GL_LINEAR, label);
    buffer.filtered = makeTexture(*device, GL_RGBA16F, size, GL_LINEAR, label);
    buffer.depth = makeTexture(*device, GL_DEPTH_COMPONENT32F, size, GL_NEAREST, label);
    if (!buffer.raw || !buffer.filtered || !buffer.depth) return internalError("no memory for the paper's buffers");
    const gl::Framebuffer::Attachment raw[] = {{buffer.raw.view()}}, filteredColor[] = {{buffer.filtered.view()}};
    SHOAL_TRY_ASSIGN(buffer.toRaw, gl::Framebuffer::create(*device, raw, {buffer.depth.view()}, label));
    SHOAL_TRY_ASSIGN(buffer.toFiltered, gl::Framebuffer::create(*device, filteredColor, {}, label));
    return {};
}

Result<void> State::makeSized(const frame::Context& context, const PaperParams& params, const Body& body) {
    const PaperBufferSizes sizes = paperBufferSizes(context.view, params);
    SHOAL_TRY(makeBuffer(caustics, sizes.caustics, "paper caustics"));
    SHOAL_TRY(makeBuffer(godrays, sizes.godrays, "paper god rays"));
    SHOAL_TRY(makeGrid(causticGrid, params.causticGrid, "paper caustic photons"));
    SHOAL_TRY(makeGrid(godrayGrid, params.godrayGrid, "paper god ray photons"));
    return makeTracers(body, params.newtonSteps, light.lamp);
}

// Where the light sees water: the level surface, tested against what stands above it.
void State::drawMask(const frame::Context& context) {
    const gl::PassScope pass(context.timer, "paper water mask");
    clearColor(toMask);
    if (light.maskMin.x >= light.maskMax.x || light.maskMin.y >= light.maskMax.y) return;
    toMask.bind();
    setPlainState();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);  // reversed z
    glDepthMask(GL_FALSE);
    nothing.bind();
    mask->use();
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

// The eye's depth, at the buffer's size: what points and lines are tested against.
void State::shrinkDepth(const PaperBuffer& buffer, gl::TextureView eyeDepth) const {
    buffer.toRaw.bind();
    setPlainState();
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    bindPlain(0, eyeDepth);
    depth->set(0, Vec2{float(eyeDepth.width) / float(buffer.raw.width()),
                       float(eyeDepth.height) / float(buffer.raw.height())});
    nothing.bind();
    depth->use();
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void State::addUp(const PaperBuffer& buffer, const Grid& grid, const gl::Program& tracer) const {
    clearColor(buffer.toRaw);
    buffer.toRaw.bind();
    setPlainState();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GEQUAL);  // reversed z
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    bindPlain(0, shadow.view());
    bindPlain(1, waterMask.view());
    grid.array.bind();
    tracer.use();
    glDrawArrays(GL_POINTS, 0, grid.side * grid.side);
    glDisable(GL_PROGRAM_POINT_SIZE);
    glDisable(GL_BLEND);
}

void State::lowPass(const PaperBuffer& buffer) const {
    bindPlain(0, buffer.raw.view());
    buffer.toFiltered.bind();
    fullscreen.draw(*filter);
}

PaperMethod::PaperMethod(std::unique_ptr<State> state) : state_(std::move(state)) {}
PaperMethod::PaperMethod(PaperMethod&&) noexcept = default;
PaperMethod& PaperMethod::operator=(PaperMethod&&) noexcept = default;
PaperMethod::~PaperMethod() = default;

Result<PaperMethod> PaperMethod::create(gl::Device& device) {
    frame::registerFrameShaders();
    registerWaterShaders();
    auto state = std::make_unique<State>();
    state->device = &device;
    state->fullscreen = frame::Fullscreen::create(device);
    state->nothing = gl::VertexArray::create(device, {}, "paper full screen");
    state->block = gl::BlockBuffer<PaperBlock>::create(device, "paper block");
    SHOAL_TRY(state->makePrograms());
    SHOAL_TRY(state->makeLightTargets());
    state->views.reserve(1);
    return PaperMethod(std::move(state));
}

void PaperMethod::prepare(const frame::Context& context, const PaperParams& params, const Body& body,
                          const BodyLights& lights, const Bounds& sceneBounds) {
    State& s = *state_;
    s.views.clear();
    s.light = fitPaperLight(context.view, params, body, lights, sceneBounds);
    if (!s.light.lit) {
        s.asked = false;
        return;
    }
    frame::NeededView needed;
    needed.purpose = frame::NeededView::Purpose::photonDepth;
    needed.view = s.light.view;
    needed.depth = s.shadow.view();
    needed.framebuffer = s.toShadow.name();
    const Mat4 clipFromWorld = s.light.view.clipFromWorld();
    needed.unchanged = s.asked && s.lastClipFromWorld == clipFromWorld;
    s.lastClipFromWorld = clipFromWorld;
    s.asked = true;
    s.views.push_back(needed);
}

std::span<frame::NeededView> PaperMethod::neededViews() { return state_->views; }

void PaperMethod::render(const frame::Context& context, const PaperParams& params, const Body& body, const BodyLights&,
                         const ReceiverInputs&, gl::TextureView depth) {
    State& s = *state_;
    if (const auto made = s.makeSized(context, params, body); !made) {
        s.device->log(LogLevel::error, "paper method: " + made.error().message);
        return;
    }
    s.filtered = params.filter;
    s.values = makePaperBlock(context, params, body, s.light);
    if (!s.light.lit) {
        for (const PaperBuffer* buffer : {&s.caustics, &s.godrays})
            clearColor(params.filter ? buffer->toFiltered : buffer->toRaw);
        return;
    }
    s.block.write(s.values);
    s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
    if (params.waterMask) s.drawMask(context);
    if (body.gpuWaves) body.gpuWaves->bind();
    {
        const gl::PassScope pass(context.timer, "paper caustics");
        s.shrinkDepth(s.caustics, depth);
        s.addUp(s.caustics, s.causticGrid, *s.causticTracer);
    }
    if (params.filter) {
        const gl::PassScope pass(context.timer, "paper caustics filter");
        s.lowPass(s.caustics);
    }
    {
        const gl::PassScope pass(context.timer, "paper god rays");
        s.shrinkDepth(s.godrays, depth);
        s.addUp(s.godrays, s.godrayGrid, *s.godrayTracer);
    }
    if (params.filter) {
        const gl::PassScope pass(context.timer, "paper god rays filter");
        s.lowPass(s.godrays);
    }
}

void PaperMethod::compose(const frame::Context& context, const PaperParams&, const ReceiverInputs& receivers,
                          const IrradianceOutputs& outputs, gl::TextureView inscatterOut) {
    State& s = *state_;
    if (!s.caustics.usable() || !s.godrays.usable()) return;
    const gl::PassScope pass(context.timer, "paper compose");
    if (outputs.direct) {
        setPaperPixels(s.values, context);
        s.block.write(s.values);
        s.block.bindUniform(SHOAL_BLOCK_WATER_PASS);
        bindPlain(0, caustics());
        bindPlain(1, receivers.viewDepth);
        gl::bindImage(0, outputs.direct, GL_WRITE_ONLY);
        s.direct->dispatch(outputs.direct.width, outputs.direct.height);
    }
    if (outputs.ambient) {
        const GLfloat nothing[4] = {0, 0, 0, 0};
        glClearTexImage(outputs.ambient.name, 0, GL_RGBA, GL_FLOAT, nothing);
    }
    if (inscatterOut) {
        bindPlain(0, godrays());
        gl::bindImage(0, inscatterOut, GL_WRITE_ONLY);
        s.inscatter->dispatch(inscatterOut.width, inscatterOut.height);
    }
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

gl::TextureView PaperMethod::caustics() const {
    return state_->filtered ? state_->caustics.filtered.view() : state_->caustics.raw.view();
}

gl::TextureView PaperMethod::godrays() const {
    return state_->filtered ? state_->godrays.filtered.view() : state_->godrays.raw.view();
}

frame::Stats PaperMethod::stats() const {
    const State& s = *state_;
    frame::Stats stats;
    constexpr std::int64_t kBytesPerPixel = 8 + 8 + 4;  // two RGBA16F, D32F
    for (const PaperBuffer* buffer : {&s.caustics, &s.godrays})
        if (buffer->usable()) stats.bytes += kBytesPerPixel * buffer->raw.width() * buffer->raw.height();
    stats.bytes += std::int64_t(4 + 1) * kPaperShadowResolution * kPaperShadowResolution;
    for (const Grid* grid : {&s.causticGrid, &s.godrayGrid}) stats.bytes += std::int64_t(grid->points.bytes());
    const auto photons = [](const Grid& grid) { return 4 * std::int64_t(grid.side) * grid.side; };
    stats.counts = {{"caustic photons", photons(s.causticGrid)}, {"god ray photons", photons(s.godrayGrid)}};
    return stats;
}

}  // namespace shoal::water
