// Samples to one antialiased picture, and from radiance to display values.
#include <shoal/frame/post.h>

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "frame/bindings.shared.h"
#include "frame/bloom.h"
#include "frame/exposure.h"
#include "frame/fullscreen.h"

namespace shoal::frame {
namespace {

Result<gl::Texture> makeTarget(gl::Device& device, gl::Enum format, int width, int height, bool linear,
                               const char* label) {
    gl::TextureDesc desc;
    desc.format = format;
    desc.width = width, desc.height = height;
    if (linear) desc.minFilter = desc.magFilter = GL_LINEAR;
    desc.label = label;
    gl::Texture texture = gl::Texture::create(device, desc);
    if (!texture) return internalError(std::string("no memory for ") + label);
    return texture;
}

// What present.frag is compiled for; a curve adds 8 (AgX) or 16 (plain).
enum Variant { kAccumulated = 1, kBloom = 2, kLook = 4, kAgx = 8, kPlain = 16 };
constexpr int kPresentVariants = 24;

int variantOf(const PostParams& params) {
    const bool look = params.saturation != 1 || params.contrast != 1;
    return (look ? kLook : 0) | (params.toneCurve == "agx" ? kAgx : params.toneCurve == "plain" ? kPlain : 0);
}

Result<const gl::Program*> presentProgram(gl::Device& device, int variant) {
    static constexpr const char* kNames[] = {"ACCUMULATED", "BLOOM", "LOOK", "CURVE_AGX", "CURVE_PLAIN"};
    return fullscreenProgram(device, "frame/present.frag", definesOf(variant, kNames));
}

void bindInput(int unit, const gl::TextureView& texture) {
    gl::bindTexture(SHOAL_UNIT_PASS + unit, texture);
    glBindSampler(GLuint(SHOAL_UNIT_PASS + unit), 0);
}

}  // namespace

struct Post::State {
    explicit State(gl::Device& d) : device(d) {}

    gl::Device& device;
    Fullscreen fullscreen;
    Exposure exposure;
    Bloom bloom;
    const gl::Program *accumulate = nullptr, *resolve = nullptr, *temporal = nullptr;
    const gl::Program* bloomFirst[2] = {};  // [accumulated]
    const gl::Program* present[kPresentVariants] =
        {};  // by a sum of Variant; others than the default are built when first asked for

    int width = 0, height = 0;
    enum class Source { none, accumulated, temporal } source = Source::none;

    // Supersampling.
    gl::Texture linearSum, weightedSum, resolved;
    gl::Framebuffer toSums, toResolved;
    int sampleCount = 0;
    bool resolvedIsNew = false;

    // Temporal: two histories in turn.
    gl::Texture history[2], moments[2];
    gl::Framebuffer toHistory[2];
    int newest = 0;
    bool historyKnown = false;

    gl::Texture display;
    gl::Framebuffer toDisplay;
    float expectedExposure = 0;
    float fixedFactor = 1;
    bool automatic = false;

    Result<void> makePrograms();
    Result<void> resizeSums(int newWidth, int newHeight);
    Result<void> resizeHistory(int newWidth, int newHeight);
    Result<void> resizeDisplay();
    bool ready(const Result<void>& result, const char* what);
    gl::TextureView linear();
    bool accumulated() const { return source == Source::accumulated; }
    void weighSamples(gl::TextureView radiance);
    void bindSource() const;
    void setReprojection(const Context& context);
    const gl::Program* presentVariant(int wanted);
};

Result<void> Post::State::makePrograms() {
    SHOAL_TRY_ASSIGN(accumulate, fullscreenProgram(device, "frame/accumulate.frag"));
    SHOAL_TRY_ASSIGN(resolve, fullscreenProgram(device, "frame/resolve.frag"));
    SHOAL_TRY_ASSIGN(temporal, fullscreenProgram(device, "frame/temporal.frag"));
    for (int sums = 0; sums < 2; ++sums) {
        std::vector<std::pair<std::string, std::string>> defines;
        if (sums) defines.emplace_back("ACCUMULATED", "1");
        SHOAL_TRY_ASSIGN(bloomFirst[sums], fullscreenProgram(device, "frame/bloom_first.frag", defines));
        const int usual = variantOf(PostParams{}) | (sums ? kAccumulated : 0);
        SHOAL_TRY_ASSIGN(present[usual], presentProgram(device, usual));
    }
    return {};
}

Result<void> Post::State::resizeSums(int newWidth, int newHeight) {
    if (linearSum && linearSum.width() == newWidth && linearSum.height() == newHeight) return {};
    SHOAL_TRY_ASSIGN(linearSum, makeTarget(device, GL_RGBA32F, newWidth, newHeight, false, "sum of samples"));
    SHOAL_TRY_ASSIGN(weightedSum,
                     makeTarget(device, GL_RGBA32F, newWidth, newHeight, false, "weighted sum of samples"));
    SHOAL_TRY_ASSIGN(resolved, makeTarget(device, GL_RGBA32F, newWidth, newHeight, false, "mean of samples"));
    const gl::Framebuffer::Attachment sums[] = {{linearSum.view()}, {weightedSum.view()}}, mean[] = {{resolved.view()}};
    SHOAL_TRY_ASSIGN(toSums, gl::Framebuffer::create(device, sums, {}, "sums of samples"));
    SHOAL_TRY_ASSIGN(toResolved, gl::Framebuffer::create(device, mean, {}, "mean of samples"));
    return {};
}

Result<void> Post::State::resizeHistory(int newWidth, int newHeight) {
    if (history[0] && history[0].width() == newWidth && history[0].height() == newHeight) return {};
    for (int i = 0; i < 2; ++i) {
        SHOAL_TRY_ASSIGN(history[i], makeTarget(device, GL_RGBA32F, newWidth, newHeight, false, "history"));
        SHOAL_TRY_ASSIGN(moments[i], makeTarget(device, GL_RGBA16F, newWidth, newHeight, false, "history moments"));
        const gl::Framebuffer::Attachment colors[] = {{history[i].view()}, {moments[i].view()}};
        SHOAL_TRY_ASSIGN(toHistory[i], gl::Framebuffer::create(device, colors, {}, "history"));
    }
    historyKnown = false;
    return {};
}

Result<void> Post::State::resizeDisplay() {
    if (display && display.width() == width && display.height() == height) return {};
    SHOAL_TRY_ASSIGN(display, makeTarget(device, GL_RGBA8, width, height, true, "display"));
    const gl::Framebuffer::Attachment color[] = {{display.view()}};
    SHOAL_TRY_ASSIGN(toDisplay, gl::Framebuffer::create(device, color, {}, "display"));
    return {};
}

bool Post::State::ready(const Result<void>& result, const char* what) {
    if (!result) device.log(LogLevel::error, std::string(what) + ": " + result.error().message);
    return bool(result);
}

gl::TextureView Post::State::linear() {
    if (source == Source::none) return {};
    if (!accumulated()) return history[newest].view();
    if (resolvedIsNew || sampleCount == 0) return resolved.view();
    bindInput(0, linearSum);
    resolve->set(0, float(sampleCount));
    toResolved.bind();
    fullscreen.draw(*resolve);
    resolvedIsNew = true;
    return resolved.view();
}

void Post::State::weighSamples(gl::TextureView radiance) {
    if (expectedExposure > 0)
        exposure.setForAntialiasing(expectedExposure);
    else
        exposure.measureForAntialiasing(radiance);
}

void Post::State::bindSource() const {
    if (accumulated()) {
        bindInput(0, weightedSum);
        bindInput(1, linearSum);
    } else {
        bindInput(0, history[newest]);
    }
}

// Where what lies at infinity was in the frame before, as clip xyw that is affine in pixels.
void Post::State::setReprojection(const Context& context) {
    const light::View& view = context.view;
    const Mat4 toPrevious = context.previousView.clipFromView * context.previousView.viewFromWorld;
    const auto clipOf = [&](float x, float y) {
        const Vec3 p = transformPoint(view.viewFromClip, {x, y, 1});
        const Vec3 d = transformDirection(view.worldFromView, p * (-1 / p.z));
        const Vec4 clip = toPrevious * Vec4{d.x, d.y, d.z, 0};
        return Vec4{clip.x, clip.y, clip.w, 0};
    };
    if (view.orthographic || context.previousView.orthographic) {  // w = 0 tells that nothing moves
        for (int location = 1; location <= 3; ++location) temporal->set(location, Vec4{});
        return;
    }
    const Vec4 corner = clipOf(-1, -1);
    const auto slope = [&](Vec4 end, int pixels) {
        return Vec4{end.x - corner.x, end.y - corner.y, end.z - corner.z, 0} * (1 / float(pixels));
    };
    temporal->set(1, corner);
    temporal->set(2, slope(clipOf(1, -1), view.width));
    temporal->set(3, slope(clipOf(-1, 1), view.height));
}

const gl::Program* Post::State::presentVariant(int wanted) {
    if (!present[wanted]) {
        auto made = presentProgram(device, wanted);
        if (made)
            present[wanted] = *made;
        else
            device.log(LogLevel::error, made.error().message);
    }
    return present[wanted];
}

Post::Post(std::unique_ptr<State> state) : state_(std::move(state)) {}
Post::Post(Post&&) noexcept = default;
Post& Post::operator=(Post&&) noexcept = default;
Post::~Post() = default;

Result<Post> Post::create(gl::Device& device) {
    registerFrameShaders();
    auto state = std::make_unique<State>(device);
    state->fullscreen = Fullscreen::create(device);
    SHOAL_TRY(state->makePrograms());
    SHOAL_TRY_ASSIGN(state->exposure, Exposure::create(device));
    SHOAL_TRY_ASSIGN(state->bloom, Bloom::create(device));
    return Post(std::move(state));
}

void Post::setExpectedExposure(float factor) { state_->expectedExposure = factor; }

void Post::beginAccumulation(int width, int height) {
    State& s = *state_;
    if (!s.ready(s.resizeSums(width, height), "supersampling")) return;
    s.width = width, s.height = height;
    s.source = State::Source::accumulated;
    s.sampleCount = 0;
    s.resolvedIsNew = false;
}

void Post::accumulate(const Context& context, const Targets& targets) {
    State& s = *state_;
    SHOAL_ASSERT_MSG(s.accumulated(), "beginAccumulation() comes first");
    SHOAL_ASSERT(targets.radiance().width == s.width && targets.radiance().height == s.height);
    const gl::PassScope pass(context.timer, "accumulate");
    if (s.sampleCount == 0) s.weighSamples(targets.radiance());
    s.exposure.bind();
    bindInput(0, targets.radiance());
    s.toSums.bind();
    const bool add = s.sampleCount > 0;  // the first sample overwrites: nothing needs clearing
    if (add) {
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE, GL_ONE);
    }
    s.fullscreen.draw(*s.accumulate, Where::everywhere, add);
    glDisable(GL_BLEND);
    ++s.sampleCount;
    s.resolvedIsNew = false;
}

void Post::temporal(const Context& context, const Targets& targets, bool reset) {
    State& s = *state_;
    const gl::TextureView radiance = targets.radiance();
    if (!s.ready(s.resizeHistory(radiance.width, radiance.height), "temporal antialiasing")) return;
    s.width = radiance.width, s.height = radiance.height;
    s.source = State::Source::temporal;
    const gl::PassScope pass(context.timer, "temporal");
    const bool fresh = reset || !s.historyKnown;
    if (fresh) s.weighSamples(radiance);
    s.exposure.bind();
    bindInput(0, radiance);
    bindInput(1, targets.gbuffer().viewDepth);
    bindInput(2, targets.gbuffer().motion);
    bindInput(3, s.history[s.newest]);
    bindInput(4, s.moments[s.newest]);
    s.temporal->set(0, Vec4{fresh ? 1.0f : 0.0f, 1 / float(s.width), 1 / float(s.height), 0});
    s.setReprojection(context);
    s.newest = 1 - s.newest;
    s.toHistory[s.newest].bind();
    s.fullscreen.draw(*s.temporal);
    s.historyKnown = true;
}

gl::TextureView Post::radiance() const { return state_->linear(); }

void Post::present(const Context& context, const PostParams& params, bool reset) {
    State& s = *state_;
    SHOAL_ASSERT_MSG(s.source != State::Source::none, "present() before accumulate() or temporal()");
    if (!s.ready(s.resizeDisplay(), "display")) return;
    s.automatic = params.exposureMode == "automatic";
    s.fixedFactor = std::exp2(params.exposureEv);
    if (s.automatic) {
        const gl::PassScope pass(context.timer, "exposure");
        const float share = params.adaptation > 0 ? 1 - std::exp(-context.timeStep / params.adaptation) : 1.0f;
        s.exposure.adapt(s.accumulated() ? s.weightedSum.view() : s.history[s.newest].view(), s.accumulated(), share,
                         reset);
    }
    const bool bloom = params.bloom > 0 && s.ready(s.bloom.resize(s.width, s.height), "bloom");
    if (bloom) {
        const gl::PassScope pass(context.timer, "bloom");
        const gl::Program& first = *s.bloomFirst[s.accumulated()];
        s.bindSource();
        if (s.accumulated()) first.set(8, float(s.sampleCount));
        s.bloom.compute(first, s.width, s.height, s.fullscreen);
    }
    const gl::PassScope pass(context.timer, "present");
    const int variant = variantOf(params) | (s.accumulated() ? kAccumulated : 0) | (bloom ? kBloom : 0);
    const gl::Program* program = s.presentVariant(variant);
    if (!program) return;
    s.bindSource();
    if (bloom) bindInput(2, s.bloom.result());
    if (s.accumulated()) program->set(8, float(s.sampleCount));
    s.exposure.bind();
    program->set(0, Vec4{s.fixedFactor, s.automatic ? 1.0f : 0.0f, params.bloom, 0});
    if (variant & kLook) program->set(1, Vec4{params.saturation, params.contrast, 0, 0});
    s.toDisplay.bind();
    s.fullscreen.draw(*program);
}

gl::TextureView Post::display() const { return state_->display.view(); }

float Post::exposure() const { return state_->fixedFactor * (state_->automatic ? state_->exposure.adapted() : 1.0f); }

}  // namespace shoal::frame
