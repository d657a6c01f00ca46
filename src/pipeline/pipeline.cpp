// One frame in its order: needed views, opaque surfaces, light, media, transparent surfaces, post.
#include <shoal/pipeline/pipeline.h>

#include <cmath>

#include <epoxy/gl.h>

#include <shoal/core/random.h>
#include <shoal/frame/geometry.h>
#include <shoal/frame/lighting.h>
#include <shoal/frame/post.h>
#include <shoal/frame/shadows.h>
#include <shoal/frame/targets.h>

#include "pipeline/aov.h"
#include "pipeline/draft_shadows.h"
#include "pipeline/water_pass.h"

namespace shoal::pipeline {

namespace {

constexpr int kPreRoll = 8;         // samples of a temporal sequence's first frame: it has no history to rest on
constexpr int kEndlessPattern = 0;  // samplePattern's count for temporal antialiasing

// What a scene is on a device.
struct Loaded {
    scene::Scene scene;
    scene::Content content;
    frame::ShadowParams shadowParams;
    frame::LightingParams lightingParams;
    frame::PostParams postParams;
    frame::ShadowSetup shadowSetup;
    std::optional<frame::Geometry> geometry;
    std::optional<frame::Shadows> shadows;
    std::optional<DraftShadows> draft;         // what drafts are shaded with in their place
    float shadowTime = 0;                      // of the last frame that was no draft
    bool drewDraft = false;                    // the last frame was one
    std::vector<frame::InstanceId> instances;  // one a content instance
    bool moves = false;                        // whether any instance walks
    std::unique_ptr<WaterPass> water;          // null: none
};

// The tables of techniques that this version does not draw yet.
Result<void> refuseUnbuilt(const scene::Scene& scene) {
    for (const scene::RawTable& table : scene.tables) {
        const std::string root = table.name.substr(0, table.name.find('.'));
        if (root == "crowd" || root == "fluid" || root == "volume")
            return badInput(table.place.describe() + ": [" + table.name + "]: this version of shoal has no " + root +
                            " yet");
        if (root != table.name && root != "water")
            return badInput(table.place.describe() + ": [" + table.name +
                            "]: unknown table, expected plain values in [" + root + "]");
    }
    return {};
}

// The water's own checks know fields, not lines.
Error atWater(const scene::Scene& scene, const Error& error) {
    const scene::RawTable* table = scene.table("water");
    if (error.kind != ErrorKind::badInput || !table) return error;
    return {error.kind, table->place.describe() + ": water: " + error.message};
}

template <class Params>
Result<void> bindNamed(const scene::Scene& scene, const char* name, Params& params) {
    if (const scene::RawTable* table = scene.table(name)) return scene::bindTable(*table, params);
    return {};
}

Result<void> addInstances(Loaded& loaded) {
    std::vector<frame::ModelId> ids;
    for (const Model& model : loaded.content.models) {
        SHOAL_TRY_ASSIGN(const frame::ModelId id, loaded.geometry->addModel(model));
        ids.push_back(id);
    }
    for (const scene::Instance& instance : loaded.content.instances) {
        frame::InstanceDesc desc;
        desc.model = ids[std::size_t(instance.model)];
        desc.worldFromModel = scene::transformAt(instance, 0);
        desc.clip = instance.clip;
        desc.speed = instance.speed;
        desc.startTime = instance.startTime;
        desc.loop = instance.loop;
        desc.castsShadow = instance.castsShadow;
        desc.visible = instance.visible;
        desc.hiddenNodes = instance.hide;
        desc.tint = {instance.tint.x, instance.tint.y, instance.tint.z, 1};
        SHOAL_TRY_ASSIGN(const frame::InstanceId id, loaded.geometry->addInstance(desc));
        loaded.instances.push_back(id);
        loaded.moves = loaded.moves || instance.walk.has_value();
    }
    return {};
}

// Pattern point `index`, moved round the pixel by the seed: the points stay evenly spread.
Vec2 sampleOffset(int index, int count, std::uint32_t seed) {
    Vec2 p = frame::samplePattern(index, count);
    if (seed == 1) return p;
    p = p + Vec2{randomFloat(seed, 0), randomFloat(seed, 1)};
    return {p.x > 0.5f ? p.x - 1 : p.x, p.y > 0.5f ? p.y - 1 : p.y};
}

// By the ranges that a scene file's [render] has.
Result<void> checkRequest(const FrameRequest& request) {
    scene::RenderSpec spec;
    spec.width = request.width;
    spec.height = request.height;
    spec.time = request.time;
    spec.antialiasing = request.antialiasing;
    spec.samples = request.samples;
    if (const auto valid = validate(spec); !valid) return badInput("frame request: " + valid.error().message);
    return {};
}

}  // namespace

FrameRequest requestFor(const scene::RenderSpec& spec) {
    FrameRequest request;
    request.width = spec.width;
    request.height = spec.height;
    request.time = spec.time;
    request.antialiasing = spec.antialiasing;
    request.samples = spec.samples;
    request.seed = spec.seed;
    return request;
}

struct Pipeline::State {
    gl::Device& device;
    gl::FrameTimer timer;
    frame::Lighting lighting;
    frame::Post post;
    std::optional<frame::Targets> targets;
    std::unique_ptr<Loaded> loaded;
    std::vector<std::string> aovNames;
    light::View view;
    bool hasView = false;
    std::uint32_t frameCount = 0;
    bool draftsWanted = false;

    State(gl::Device& device, frame::Lighting lighting, frame::Post post)
        : device(device), timer(device), lighting(std::move(lighting)), post(std::move(post)) {}

    Result<void> prepareTargets(int width, int height);
    frame::Context makeContext(const FrameRequest& request);
    void moveInstances(float time);
    void drawNeededViews(const frame::Context& context);
    frame::Shadows& shadowsOf(const frame::Context& context);
    void drawSample(const frame::Context& context);
    frame::Lights lights() const;
    WaterScene waterScene(const frame::Context& context);
    bool wantsTerms() const;
};

Result<void> Pipeline::State::prepareTargets(int width, int height) {
    if (targets) return targets->resize(width, height);
    SHOAL_TRY_ASSIGN(targets, frame::Targets::create(device, width, height));
    return {};
}

frame::Context Pipeline::State::makeContext(const FrameRequest& request) {
    const float aspect = float(request.width) / float(request.height);
    const auto viewAt = [&](float time) {
        return light::makeView(scene::cameraAt(loaded->scene, loaded->content, time, aspect), request.width,
                               request.height);
    };
    frame::Context context;
    context.device = &device;
    context.timer = &timer;
    context.view =
        request.camera ? light::makeView(*request.camera, request.width, request.height) : viewAt(request.time);
    context.time = request.time;
    context.timeStep = request.frameIndex == 0 ? 0 : request.timeStep;
    context.frameIndex = ++frameCount;  // request.frameIndex may be the same twice: two stills
    context.previousView = context.view;
    context.draft = request.draft;
    if (request.frameIndex > 0) {
        if (!request.camera)
            context.previousView = viewAt(request.time - request.timeStep);
        else if (hasView && view.width == request.width && view.height == request.height)
            context.previousView = view;
    }
    view = context.view;
    hasView = true;
    return context;
}

void Pipeline::State::moveInstances(float time) {
    if (!loaded->moves) return;
    for (std::size_t i = 0; i < loaded->instances.size(); ++i) {
        const scene::Instance& instance = loaded->content.instances[i];
        if (instance.walk) loaded->geometry->setTransform(loaded->instances[i], scene::transformAt(instance, time));
    }
}

frame::Shadows& Pipeline::State::shadowsOf(const frame::Context& context) {
    return context.draft && loaded->draft ? loaded->draft->shadows() : *loaded->shadows;
}

void Pipeline::State::drawNeededViews(const frame::Context& context) {
    // What moved while the other set of maps was in use is not known to have moved.
    const bool draft = context.draft && loaded->draft;
    const bool switched = draft != loaded->drewDraft;
    loaded->drewDraft = draft;
    if (draft) return loaded->draft->draw(context, loaded->shadowParams, lights(), *loaded->geometry, switched);
    const bool stale = switched && loaded->shadowTime != context.time;
    loaded->shadowTime = context.time;
    loaded->shadows->prepare(context, loaded->shadowParams, loaded->content.sun ? &*loaded->content.sun : nullptr,
                             loaded->content.lights, loaded->geometry->bounds());
    for (frame::NeededView& needed : loaded->shadows->neededViews()) {
        if (needed.unchanged && !stale && !loaded->geometry->changed(needed.view)) continue;
        loaded->geometry->drawDepth(context, needed);
    }
}

frame::Lights Pipeline::State::lights() const {
    frame::Lights lights{loaded->content.sun ? &*loaded->content.sun : nullptr, loaded->content.lights};
    if (loaded->water) lights.medium = loaded->water->medium();
    return lights;
}

WaterScene Pipeline::State::waterScene(const frame::Context& context) {
    return {*loaded->geometry, lighting, shadowsOf(context), loaded->lightingParams, lights()};
}

bool Pipeline::State::wantsTerms() const {
    for (const std::string& name : aovNames)
        if (name == "direct" || name == "shadow" || name == "occlusion" || name == "transmittance" ||
            name == "waterDepth")
            return true;
    return false;
}

void Pipeline::State::drawSample(const frame::Context& context) {
    frame::Geometry& geometry = *loaded->geometry;
    targets->beginSurfaces();
    geometry.drawSurfaces(context, targets->gbuffer());
    targets->finishSurfaces(context);
    frame::LightOverrides overrides;
    if (loaded->water) overrides = loaded->water->light(context, waterScene(context), *targets);
    lighting.prepare(context, loaded->lightingParams, lights(), *targets);
    lighting.shade(context, loaded->lightingParams, shadowsOf(context), overrides, *targets);
    if (loaded->water) loaded->water->draw(context, waterScene(context), *targets);
    if (!geometry.hasTransparent()) return;
    {
        gl::PassScope pass(&timer, "copy opaque");
        targets->copyOpaque();
    }
    targets->forward().bind();
    lighting.bind();
    shadowsOf(context).bind();
    geometry.drawTransparent(context, targets->opaqueCopy(), targets->gbuffer().viewDepth);
}

Pipeline::Pipeline(std::unique_ptr<State> state) : state_(std::move(state)) {}
Pipeline::~Pipeline() = default;

Result<std::unique_ptr<Pipeline>> Pipeline::create(gl::Device& device) {
    // Builds the geometry's programs too, which setScene then finds ready: hosts create while they load.
    SHOAL_TRY(frame::Geometry::create(device));
    SHOAL_TRY_ASSIGN(frame::Lighting lighting, frame::Lighting::create(device));
    SHOAL_TRY_ASSIGN(frame::Post post, frame::Post::create(device));
    return std::unique_ptr<Pipeline>(
        new Pipeline(std::make_unique<State>(device, std::move(lighting), std::move(post))));
}

Result<void> Pipeline::setScene(const scene::Scene& scene, scene::Content content) {
    auto loaded = std::make_unique<Loaded>();
    SHOAL_TRY(refuseUnbuilt(scene));
    SHOAL_TRY(bindNamed(scene, "shadows", loaded->shadowParams));
    SHOAL_TRY(bindNamed(scene, "lighting", loaded->lightingParams));
    SHOAL_TRY(bindNamed(scene, "post", loaded->postParams));
    loaded->lightingParams.environmentIntensity *= scene.environment.intensity;
    loaded->lightingParams.sunDisc = loaded->lightingParams.sunDisc && content.sunInBackground;
    loaded->scene = scene;
    loaded->content = std::move(content);
    SHOAL_TRY_ASSIGN(loaded->geometry, frame::Geometry::create(state_->device));
    loaded->geometry->setDraftsWanted(state_->draftsWanted);
    SHOAL_TRY_ASSIGN(loaded->shadows, frame::Shadows::create(state_->device, loaded->shadowSetup));
    SHOAL_TRY(addInstances(*loaded));
    if (state_->draftsWanted) {
        const Bounds& focus = loaded->content.focus.empty() ? loaded->content.bounds : loaded->content.focus;
        SHOAL_TRY_ASSIGN(loaded->draft, DraftShadows::create(state_->device, loaded->shadowSetup, focus));
    }
    SHOAL_TRY_ASSIGN(std::optional<WaterSpec> water, readWater(scene));
    if (water) {
        const Vec3 sky = skyIrradiance(loaded->content, loaded->lightingParams.environmentIntensity);
        auto made = WaterPass::create(state_->device, std::move(*water), sky);
        if (!made) return atWater(scene, made.error());
        loaded->water = std::move(*made);
    }
    light::Environment black;
    black.radiance = Image(8, 4, 3);
    SHOAL_TRY(state_->lighting.setEnvironment(loaded->content.environment ? *loaded->content.environment : black));
    state_->loaded = std::move(loaded);
    state_->hasView = false;
    return {};
}

Result<void> Pipeline::updateScene(const scene::Scene& scene) {
    SHOAL_ASSERT_MSG(state_->loaded, "setScene comes before updateScene");
    Loaded& loaded = *state_->loaded;
    SHOAL_TRY(refuseUnbuilt(scene));
    frame::ShadowParams shadows;
    frame::LightingParams lighting;
    frame::PostParams post;
    SHOAL_TRY(bindNamed(scene, "shadows", shadows));
    SHOAL_TRY(bindNamed(scene, "lighting", lighting));
    SHOAL_TRY(bindNamed(scene, "post", post));
    SHOAL_TRY_ASSIGN(std::optional<WaterSpec> water, readWater(scene));
    const bool relit = !scene::sameLights(scene, loaded.scene);
    const auto relight = [&](const scene::Scene& by) -> Result<void> {
        scene::Content& content = loaded.content;
        SHOAL_TRY(scene::reloadLights(by, content));
        light::Environment black;
        black.radiance = Image(8, 4, 3);
        return state_->lighting.setEnvironment(content.environment ? *content.environment : black);
    };
    if (relit) SHOAL_TRY(relight(scene));
    lighting.environmentIntensity *= scene.environment.intensity;
    const bool skyChanged = relit || lighting.environmentIntensity != loaded.lightingParams.environmentIntensity;
    if (water && (skyChanged || !scene::sameTables(scene, loaded.scene, "water"))) {
        const Vec3 sky = skyIrradiance(loaded.content, lighting.environmentIntensity);
        auto made = WaterPass::create(state_->device, std::move(*water), sky);
        if (!made) {
            if (relit) SHOAL_TRY(relight(loaded.scene));
            return atWater(scene, made.error());
        }
        loaded.water = std::move(*made);
    } else if (!water) {
        loaded.water.reset();
    }
    lighting.sunDisc = lighting.sunDisc && loaded.content.sunInBackground;
    loaded.shadowParams = shadows;
    loaded.lightingParams = lighting;
    loaded.postParams = post;
    loaded.scene = scene;
    return {};
}

Result<void> Pipeline::open(const std::filesystem::path& file, std::span<const scene::Override> overrides) {
    SHOAL_TRY_ASSIGN(const scene::Scene scene, scene::openScene(file, overrides));
    SHOAL_TRY_ASSIGN(scene::Content content,
                     scene::loadContent(scene, [this](LogLevel level, std::string_view message) {
                         state_->device.log(level, message);
                     }));
    return setScene(scene, std::move(content));
}

const scene::Scene& Pipeline::scene() const {
    SHOAL_ASSERT_MSG(state_->loaded, "setScene comes first");
    return state_->loaded->scene;
}

const scene::Content& Pipeline::content() const {
    SHOAL_ASSERT_MSG(state_->loaded, "setScene comes first");
    return state_->loaded->content;
}

Result<void> Pipeline::render(const FrameRequest& request) {
    State& s = *state_;
    SHOAL_ASSERT_MSG(s.loaded, "setScene comes before render");
    SHOAL_TRY(checkRequest(request));
    SHOAL_TRY(s.prepareTargets(request.width, request.height));
    gl::setKnownState();
    s.timer.beginFrame();
    frame::Context context = s.makeContext(request);
    const bool temporal = request.antialiasing == "temporal";
    const bool first = request.frameIndex == 0;
    const int sampleCount = temporal                                ? (first ? kPreRoll : 1)
                            : request.antialiasing == "supersample" ? request.samples
                                                                    : 1;
    const bool goesOn = !temporal && request.sampleBegin > 0;  // all below is as the call before left it
    const int sampleEnd = temporal || request.sampleEnd <= 0 ? sampleCount : std::min(request.sampleEnd, sampleCount);
    if (!goesOn) {
        s.moveInstances(request.time);
        s.loaded->geometry->update(context);
        s.drawNeededViews(context);
    }
    s.lighting.setTermsWanted(false);
    if (s.loaded->water) {
        SHOAL_TRY(s.loaded->water->resize(request.width, request.height));
        s.loaded->water->setTermsWanted(false);
        if (!goesOn) s.loaded->water->renderFrame(context, s.waterScene(context));
    }
    const frame::PostParams& look = s.loaded->postParams;
    s.post.setExpectedExposure(look.exposureMode == "fixed" ? std::exp2(look.exposureEv) : 0);
    if (!temporal && !goesOn) s.post.beginAccumulation(request.width, request.height);
    const std::uint32_t firstSample = (request.seed - 1) * 4099;  // another place in the noise
    for (int i = goesOn ? request.sampleBegin : 0; i < sampleEnd; ++i) {
        context.sampleIndex = firstSample + std::uint32_t(i);
        if (temporal)
            context.jitterPx =
                sampleOffset(i + (first ? 0 : int(request.frameIndex) + kPreRoll - 1), kEndlessPattern, request.seed);
        else if (sampleCount > 1)
            context.jitterPx = sampleOffset(i, sampleCount, request.seed);
        s.drawSample(context);
        if (temporal)
            s.post.temporal(context, *s.targets, first && i == 0);
        else
            s.post.accumulate(context, *s.targets);
    }
    s.post.present(context, look, first);
    s.timer.endFrame();
    const bool centred = context.jitterPx == Vec2{};
    if (!s.aovNames.empty() && !(centred && !s.wantsTerms())) {
        context.jitterPx = {};
        context.sampleIndex = firstSample;
        s.lighting.setTermsWanted(s.wantsTerms());
        if (s.loaded->water) s.loaded->water->setTermsWanted(s.wantsTerms());
        s.drawSample(context);
    }
    return {};
}

gl::TextureView Pipeline::display() const { return state_->post.display(); }
gl::TextureView Pipeline::radiance() const { return state_->post.radiance(); }
Result<ByteImage> Pipeline::readDisplay() { return frame::readByteImage(state_->device, display()); }

Result<Image> Pipeline::readRadiance() {
    SHOAL_TRY_ASSIGN(Image image, frame::readImage(state_->device, radiance(), 4));
    image.channelNames = {"R", "G", "B", "A"};
    return image;
}

void Pipeline::setAovs(std::span<const std::string> names) { state_->aovNames.assign(names.begin(), names.end()); }

Result<std::vector<Layer>> Pipeline::readAovs() {
    SHOAL_ASSERT_MSG(state_->targets, "render comes before readAovs");
    WaterPass* water = state_->loaded ? state_->loaded->water.get() : nullptr;
    std::vector<Layer> layers;
    for (const std::string& name : state_->aovNames) {
        SHOAL_TRY_ASSIGN(Layer layer,
                         readAov({state_->device, *state_->targets, state_->lighting, state_->post, water}, name));
        layers.push_back(std::move(layer));
    }
    return layers;
}

void Pipeline::blit(std::uint32_t framebuffer, int width, int height) {
    const gl::TextureView from = display();
    GLuint source = 0;
    glCreateFramebuffers(1, &source);
    glNamedFramebufferTexture(source, GL_COLOR_ATTACHMENT0, from.name, 0);
    glBlitNamedFramebuffer(source, framebuffer, 0, 0, from.width, from.height, 0, 0, width, height, GL_COLOR_BUFFER_BIT,
                           from.width == width && from.height == height ? GL_NEAREST : GL_LINEAR);
    glDeleteFramebuffers(1, &source);
}

light::View Pipeline::view() const { return state_->view; }
void Pipeline::setDraftsWanted(bool wanted) { state_->draftsWanted = wanted; }
void Pipeline::setTiming(bool on) { state_->timer.setEnabled(on); }

frame::Stats Pipeline::stats() const {
    frame::Stats stats;
    stats.passes = state_->timer.passes();
    stats.bytes = state_->device.liveBytes();
    if (state_->loaded) {
        const frame::GeometryStats& g = state_->loaded->geometry->stats();
        stats.counts = {{"drawn triangles", g.drawnTriangles},
                        {"draws", g.draws},
                        {"instances", g.instances},
                        {"skinned vertices", g.skinnedVertices}};
    }
    if (state_->loaded && state_->loaded->water) {
        const frame::Stats water = state_->loaded->water->stats();
        stats.counts.insert(stats.counts.end(), water.counts.begin(), water.counts.end());
    }
    return stats;
}

}  // namespace shoal::pipeline
