#include "view/viewer.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <shoal/gl/program.h>
#include <shoal/io/file.h>
#include <shoal/io/image.h>

#include "view/fields.h"

namespace shoal::viewer {

namespace {

double milliseconds(std::chrono::steady_clock::time_point since) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - since).count();
}

const scene::CameraKey& nearestKey(const std::vector<scene::CameraKey>& keys, float time) {
    return *std::min_element(keys.begin(), keys.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.time - time) < std::abs(b.time - time);
    });
}

// To the nearest box that the middle of the picture meets from outside, else to the middle of everything.
float distanceAhead(const light::Camera& camera, const scene::Content& content, const Bounds& all) {
    const Mat4& m = camera.worldFromView;
    const Vec3 eye = camera.position(), ahead{-m(0, 2), -m(1, 2), -m(2, 2)};
    float nearest = 1e30f;
    for (const Bounds& box : content.focusBoxes) {
        float enter = -1e30f, leave = 1e30f;
        const auto slab = [&](float from, float along, float lo, float hi) {
            if (std::abs(along) < 1e-9f) {
                if (from < lo || from > hi) leave = -1e30f;
                return;
            }
            const float a = (lo - from) / along, b = (hi - from) / along;
            enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
        };
        slab(eye.x, ahead.x, box.lo.x, box.hi.x);
        slab(eye.y, ahead.y, box.lo.y, box.hi.y);
        slab(eye.z, ahead.z, box.lo.z, box.hi.z);
        if (enter > 0 && enter <= leave) nearest = std::min(nearest, 0.5f * (enter + std::min(leave, 2 * enter)));
    }
    if (nearest < 1e30f) return nearest;
    return std::max(dot(all.center() - eye, ahead), 0.1f * std::max(all.radius(), 0.01f));
}

}  // namespace

Viewer::Viewer(gl::Window& window, Document document, Picture picture)
    : window(window), document(std::move(document)), picture(std::move(picture)) {
    this->picture.load(this->document.scene());
    timeline.time = this->document.scene().render.time;
}

Document& Viewer::shownDocument() { return comparison && comparison->editOther ? comparison->other : document; }

const Bounds& Viewer::sceneBounds() const {
    const scene::Content& content = picture.content();
    return content.focus.empty() ? content.bounds : content.focus;
}

void Viewer::takeResult(const Result<void>& result) {
    if (!result) fail(result.error().message);
}

void Viewer::update(double seconds) {
    const bool wasShown = picture.hasScene();
    if (auto taken = picture.takeLoaded(); !taken) {
        fail(taken.error().message);
        // What cannot be shown is not open either.
        if (before_) {
            document = *std::exchange(before_, {});
            timeline.time = documentTime_;
            freshDocument_ = false;
        }
    } else if (*taken) {
        error_.clear();
        before_.reset();
        if (freshDocument_) goToSceneCamera();
        freshDocument_ = false;
        if (!wasShown) movingSeconds_ = 0;
    }
    if (comparison)
        if (auto taken = comparison->picture.takeLoaded(); !taken) fail(taken.error().message);
    watchFiles(seconds);
    if (!std::exchange(touched_, false)) movingSeconds_ = std::max(0.0, movingSeconds_ - seconds);
    noteSeconds_ = std::max(0.0, noteSeconds_ - seconds);
    flyByKeys(float(seconds));
    if (timeline.playing) {
        const scene::RenderSpec& render = document.scene().render;
        timeline.time += float(seconds) * timeline.speed;
        const float end = std::max(render.duration, 1e-3f);
        if (timeline.time > end || timeline.time < 0) {
            if (timeline.loop) {
                timeline.time = std::fmod(timeline.time, end);
                if (timeline.time < 0) timeline.time += end;
            } else {
                timeline.time = std::clamp(timeline.time, 0.0f, end);
                timeline.playing = false;
            }
        }
        touch();
    }
}

// Hot reload: the scene file four times a second, shaders too where they come from a folder.
void Viewer::watchFiles(double seconds) {
    watchSeconds_ += seconds;
    if (watchSeconds_ < 0.25) return;
    watchSeconds_ = 0;
    if (document.fileChanged()) {
        if (const auto read = document.readAgain(); !read) {
            fail(read.error().message);
        } else {
            error_.clear();
            say("read again: " + document.file().filename().string());
            picture.load(document.scene());
            if (comparison) {
                takeResult(comparison->other.readAgain());
                comparison->picture.load(comparison->other.scene());
            }
        }
    }
    if (std::getenv("SHOAL_SHADER_DIR")) {
        const std::string before = std::exchange(error_, "");
        const int rebuilt = window.device().programs().reload();  // tells errors by the device's log
        if (rebuilt == 0 && error_.empty()) error_ = before;
        if (rebuilt > 0) {
            say(std::to_string(rebuilt) + (rebuilt == 1 ? " program" : " programs") + " built again");
            picture.begin();
            if (comparison) comparison->picture.begin();
        }
    }
}

scene::CameraSpec Viewer::cameraSpec() const {
    if (camera.isFree() || !picture.hasScene()) return camera.spec();
    const scene::Scene& scene = document.scene();
    const light::Camera seen = scene::cameraAt(picture.scene(), picture.content(), timeline.time, aspect());
    float pivot = length(scene.camera.target - scene.camera.position);
    if (scene.cameraKind == scene::CameraKind::orbit)
        pivot = scene.orbit.radius;
    else if (scene.cameraKind == scene::CameraKind::path)
        pivot = length(nearestKey(scene.cameraKeys, timeline.time).target -
                       nearestKey(scene.cameraKeys, timeline.time).position);
    else if (scene.cameraKind != scene::CameraKind::fixed)
        pivot = distanceAhead(seen, picture.content(), sceneBounds());
    ViewCamera own;
    own.take(seen, scene.camera, pivot);
    return own.spec();
}

void Viewer::useOwnCamera() {
    if (!camera.isFree()) camera.set(cameraSpec());
}

void Viewer::goToSceneCamera() {
    camera.follow();
    camera.set(cameraSpec());
    camera.follow();
    touch();
}

std::vector<scene::Override> Viewer::pictureOverrides(bool windowSize) const {
    std::vector<scene::Override> overrides;
    if (camera.isFree()) {
        std::vector<FieldInfo> now, written;
        addFields(now, "camera", camera.spec());
        addFields(written, "camera", document.scene().camera);
        for (std::size_t i = 0; i < now.size(); ++i) {
            const bool place = now[i].name == "position" || now[i].name == "target";
            if (place || now[i].value != written[i].value) overrides.push_back({now[i].key, now[i].value});
        }
    }
    const scene::RenderSpec& render = document.scene().render;
    if (windowSize && viewport.width != render.width)
        overrides.push_back({"render.width", std::to_string(viewport.width)});
    if (windowSize && viewport.height != render.height)
        overrides.push_back({"render.height", std::to_string(viewport.height)});
    if (timeline.time != render.time) overrides.push_back({"render.time", shoal::detail::showField(timeline.time)});
    return overrides;
}

Picture::Wanted Viewer::wanted(const Picture& of) const {
    Picture::Wanted w;
    w.width = viewport.width, w.height = viewport.height;
    w.time = timeline.time;
    if (camera.isFree() && of.hasScene()) w.camera = camera.camera(document.scene(), of.content(), aspect());
    w.moving = interacting();
    w.scale = scale.scale();
    w.aovs = inspector.wantedAovs(w.moving);
    return w;
}

void Viewer::draw() {
    if (!picture.hasScene()) return;
    const auto start = std::chrono::steady_clock::now();
    const bool moving = interacting(), timed = showPerformance;
    const int before = picture.revision() + (comparison ? comparison->picture.revision() : 0);
    picture.pipeline().setTiming(timed);
    takeResult(picture.draw(wanted(picture)));
    if (comparison && comparison->picture.hasScene()) takeResult(comparison->picture.draw(wanted(comparison->picture)));
    if (inspector.active() && picture.complete())
        takeResult(inspector.take(window.device(), picture.pipeline(), picture.revision()));
    if (picture.revision() + (comparison ? comparison->picture.revision() : 0) == before) return;
    FrameCost cost;
    if (timed) cost.passes = picture.pipeline().stats().passes;
    cost.totalMs = milliseconds(start);
    costs.push_back(std::move(cost));
    constexpr std::size_t kMostCosts = 120;
    if (costs.size() > kMostCosts) costs.pop_front();
    (void)moving;
}

bool Viewer::wantsFrame() const {
    const bool unfinished = picture.hasScene() && !picture.complete();
    const bool otherUnfinished = comparison && (!comparison->picture.hasScene() || !comparison->picture.complete());
    return interacting() || unfinished || otherUnfinished || picture.loading() || noteSeconds_ > 0 ||
           !keysDown_.empty();
}

void Viewer::applied(Effect effect) {
    Document& changed = shownDocument();
    Picture& shown = comparison && comparison->editOther ? comparison->picture : picture;
    switch (effect) {
        case Effect::none:
            break;
        case Effect::request:
        case Effect::update:
            takeResult(shown.update(changed.scene()));
            break;
        case Effect::reload:
            shown.load(changed.scene());
            break;
    }
    if (ImGui::IsMouseDown(0)) touch();  // a slider is being dragged
}

void Viewer::setValue(const std::string& key, const std::string& value) {
    if (key.rfind("camera.", 0) == 0) {
        useOwnCamera();
        scene::CameraSpec spec = camera.spec();
        const auto parsed = parseFieldValue(value);
        const auto set = parsed ? setField(spec, key.substr(7), *parsed) : Result<void>(parsed.error());
        if (!set) return fail(key + ": " + set.error().message);
        if (length(spec.position - spec.target) > 0) camera.set(spec);
        touch();
        return;
    }
    if (key == "sun.elevationDeg" || key == "sun.azimuthDeg") {
        const Vec3 d = normalize(shownDocument().scene().sun.toSun);
        const auto parsed = parseFieldValue(value);
        if (!parsed || parsed->kind != FieldValue::Kind::number) return fail(key + ": expected a number");
        const float given = radians(float(parsed->numbers[0]));
        const float elevation = key == "sun.elevationDeg" ? given : std::asin(std::clamp(d.y, -1.0f, 1.0f));
        const float azimuth = key == "sun.azimuthDeg" ? given : std::atan2(d.x, d.z);
        return setValue("sun.toSun",
                        shoal::detail::showField(Vec3{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                                                      std::cos(elevation) * std::cos(azimuth)}));
    }
    const auto set = shownDocument().set(key, value);
    if (!set) return fail(set.error().message);
    error_.clear();
    if (key == "render.time") timeline.time = document.scene().render.time;
    const bool groundToo = key == "environment.groundAlbedo" && document.scene().bareModel;
    applied(groundToo ? Effect::reload : effectOf(key));
}

void Viewer::resetValue(const std::string& key) {
    if (key.rfind("camera.", 0) == 0) return goToSceneCamera();
    const bool sunAngle = key == "sun.elevationDeg" || key == "sun.azimuthDeg";
    shownDocument().reset(sunAngle ? "sun.toSun" : key);
    applied(effectOf(key));
}

// The least that shows what became of `before`.
void Viewer::applyDifference(const std::vector<scene::Override>& before) {
    const std::vector<scene::Override>& after = shownDocument().overrides();
    Effect most = Effect::none;
    const auto count = [&](const std::vector<scene::Override>& some, const std::vector<scene::Override>& others) {
        for (const scene::Override& change : some) {
            const bool same = std::any_of(others.begin(), others.end(), [&](const scene::Override& other) {
                return other.key == change.key && other.value == change.value;
            });
            if (!same) most = std::max(most, effectOf(change.key));
        }
    };
    count(before, after);
    count(after, before);
    applied(most);
}

void Viewer::undo() {
    const std::vector<scene::Override> before = shownDocument().overrides();
    shownDocument().undo();
    applyDifference(before);
}

void Viewer::redo() {
    const std::vector<scene::Override> before = shownDocument().overrides();
    shownDocument().redo();
    applyDifference(before);
}

void Viewer::openFiles(const std::vector<std::filesystem::path>& files) {
    if (files.empty()) return;
    // A picture of an environment lights what is open already.
    const auto format = io::imageFormatOf(files[0]);
    if (files.size() == 1 && (format == io::ImageFormat::hdr || format == io::ImageFormat::exr)) {
        const auto file = std::filesystem::absolute(files[0]).lexically_normal().string();
        const auto set = document.set("environment.file", file);  // the kind asks for one
        const auto named = set ? document.set("environment.kind", "file") : set;
        if (!named) return fail(named.error().message);
        if (auto updated = picture.update(document.scene()); !updated) {
            document.undo();
            document.undo();
            return fail(updated.error().message);
        }
        return say("environment: " + files[0].filename().string());
    }
    auto opened = Document::open(files);
    if (!opened) return fail(opened.error().message);
    stopComparison();
    error_.clear();
    if (!before_ && picture.hasScene()) before_ = document, documentTime_ = timeline.time;
    document = std::move(*opened);
    freshDocument_ = true;
    timeline = {};
    timeline.time = document.scene().render.time;
    picture.load(document.scene());
    settings.addRecent(std::filesystem::absolute(files[0]).lexically_normal().string());
    if (recordSettings) writeSettings(settings);
}

Result<void> Viewer::saveScene(const std::filesystem::path& to, bool windowSize) {
    if (io::lowerExtension(to) != ".toml") return usageError(to.string() + ": expected a name that ends in .toml");
    SHOAL_TRY_ASSIGN(const std::string text, document.textFor(to, pictureOverrides(windowSize)));
    SHOAL_TRY(io::writeFileAtomically(to, std::string_view(text)));
    SHOAL_TRY(document.becomeFile(to));
    settings.addRecent(std::filesystem::absolute(to).lexically_normal().string());
    if (recordSettings) writeSettings(settings);
    say("saved " + to.string());
    return {};
}

Result<void> Viewer::screenshot(const std::filesystem::path& to) {
    const std::string extension = io::lowerExtension(to);
    if (extension != ".png" && extension != ".jpg" && extension != ".exr")
        return usageError(to.string() + ": expected a name that ends in .png, .jpg or .exr");
    picture.waitForLoading();
    SHOAL_TRY_ASSIGN(const bool taken, picture.takeLoaded());
    (void)taken;
    if (!picture.hasScene()) return usageError("there is no picture yet");
    Picture::Wanted still = wanted(picture);
    still.moving = false;
    if (extension == ".exr") {
        still.aovs.clear();
        for (const pipeline::AovInfo& info : pipeline::aovs()) still.aovs.push_back(info.name);
    }
    SHOAL_TRY(picture.finish(still));
    if (extension == ".exr") {
        SHOAL_TRY_ASSIGN(Image radiance, picture.pipeline().readRadiance());
        std::vector<Layer> layers;
        layers.push_back({"", std::move(radiance)});
        SHOAL_TRY_ASSIGN(std::vector<Layer> aovs, picture.pipeline().readAovs());
        for (Layer& layer : aovs) layers.push_back(std::move(layer));
        SHOAL_TRY(io::writeExr(to, layers, {}));
    } else {
        SHOAL_TRY_ASSIGN(const ByteImage pixels, picture.pipeline().readDisplay());
        SHOAL_TRY(io::writeByteImage(to, pixels));
    }
    say("saved " + to.string());
    return {};
}

std::string Viewer::command() const { return renderCommand(document, pictureOverrides(true)); }

void Viewer::startComparison() {
    auto made = Picture::create(window.device());
    if (!made) return fail(made.error().message);
    comparison.emplace(Comparison{document, std::move(*made)});
    comparison->picture.load(comparison->other.scene());
}

void Viewer::stopComparison() {
    if (comparison) comparison->picture.waitForLoading();
    comparison.reset();
}

std::string Viewer::statusLine() const {
    if (!picture.hasScene())
        return picture.loading() ? "reading " + document.file().filename().string() + " ..." : "no picture";
    char text[200];
    const int width = viewport.width, height = viewport.height;
    const scene::RenderSpec& shown = picture.scene().render;
    if (picture.shownScale() < 1 || interacting())
        std::snprintf(text, sizeof text, "moving: %.0f %% of %d x %d, 1 sample a pixel",
                      double(100 * picture.shownScale()), width, height);
    else if (!picture.complete())
        std::snprintf(text, sizeof text, "sharpening: %d of %d samples, %d x %d", picture.samplesDrawn(),
                      picture.samplesWanted(), width, height);
    else
        std::snprintf(text, sizeof text, "full quality: %d x %d, %s: what `shoal render` draws", width, height,
                      shown.antialiasing == "supersample"
                          ? (std::to_string(shown.samples) + (shown.samples == 1 ? " sample" : " samples")).c_str()
                          : ("antialiasing " + shown.antialiasing).c_str());
    std::string line = text;
    if (picture.loading()) line += " (reading again)";
    return line;
}

}  // namespace shoal::viewer
