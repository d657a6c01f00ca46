#include "view/document.h"

#include <algorithm>

#include <shoal/io/file.h>
#include <shoal/io/image.h>
#include <shoal/io/model.h>
#include <shoal/scene/write.h>

namespace shoal::viewer {

namespace {

namespace fs = std::filesystem;

bool isPicture(const fs::path& file) {
    const std::string extension = io::lowerExtension(file);
    return extension == ".hdr" || extension == ".exr";
}

fs::file_time_type timeOf(const fs::path& file) {
    std::error_code error;
    const auto time = fs::last_write_time(file, error);
    return error ? fs::file_time_type::min() : time;
}

Result<std::string> readText(const fs::path& file) {
    SHOAL_TRY_ASSIGN(const std::vector<std::byte> bytes, io::readFile(file));
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

bool startsWith(const std::string& text, const char* head) { return text.rfind(head, 0) == 0; }

}  // namespace

Effect effectOf(const std::string& key) {
    if (startsWith(key, "camera.") || startsWith(key, "render.")) return Effect::request;
    for (const char* head : {"post.", "lighting.", "shadows.", "sun", "environment", "light[", "water."})
        if (startsWith(key, head)) return Effect::update;
    return Effect::reload;
}

Result<Document> Document::open(const std::vector<fs::path>& files, std::vector<scene::Override> overrides) {
    Document document;
    document.opened_ = files;
    document.overrides_ = std::move(overrides);
    std::vector<fs::path> models;
    for (const fs::path& file : files) {
        if (io::lowerExtension(file) == ".toml") {
            if (files.size() > 1 && !(files.size() == 2 && isPicture(files[file == files[0] ? 1 : 0])))
                return usageError("view: " + file.string() +
                                  " is a scene, expected it alone or with one environment picture");
            document.file_ = file;
            document.isSceneFile_ = true;
        } else if (isPicture(file)) {
            document.overrides_.push_back({"environment.kind", "file"});
            document.overrides_.push_back({"environment.file", fs::absolute(file).lexically_normal().string()});
        } else if (io::isModelFile(file)) {
            models.push_back(file);
        } else {
            SHOAL_TRY(scene::openScene(file));  // says what is wrong with it
        }
    }
    if (!document.isSceneFile_) {
        if (models.empty())
            return usageError("view: found only an environment picture, expected a scene or model to light with it");
        for (const fs::path& model : models) SHOAL_TRY(io::readFile(model));  // that there is one
        document.file_ = models.front();
        document.text_ = scene::sceneTextForModels(models);
    } else {
        document.readTime_ = timeOf(document.file_);
        SHOAL_TRY_ASSIGN(document.text_, readText(document.file_));
    }
    SHOAL_TRY(document.parse());
    return document;
}

Result<void> Document::parse() {
    SHOAL_TRY_ASSIGN(scene_, scene::parseScene(text_, file_, overrides_));
    return {};
}

std::string Document::title() const {
    return file_.filename().string() + (overrides_.empty() ? "" : " (changed)") + " - Shoal";
}

void Document::remember(const std::string& key) {
    if (!gestureKey_.empty() && gestureKey_ == key) return;
    gestureKey_ = key;
    constexpr std::size_t kMostSteps = 200;
    undo_.push_back(overrides_);
    if (undo_.size() > kMostSteps) undo_.erase(undo_.begin());
    redo_.clear();
}

Result<void> Document::set(const std::string& key, const std::string& value) {
    std::vector<scene::Override> changed = overrides_;
    const auto same = [&](const scene::Override& change) { return change.key == key; };
    const auto found = std::find_if(changed.begin(), changed.end(), same);
    if (found != changed.end()) {
        if (found->value == value) return {};
        found->value = value;
    } else {
        changed.push_back({key, value});
    }
    SHOAL_TRY_ASSIGN(scene::Scene scene, scene::parseScene(text_, file_, changed));
    remember(key);
    overrides_ = std::move(changed);
    scene_ = std::move(scene);
    return {};
}

void Document::reset(const std::string& key) {
    if (!isChanged(key)) return;
    std::vector<scene::Override> changed = overrides_;
    std::erase_if(changed, [&](const scene::Override& change) { return change.key == key; });
    auto scene = scene::parseScene(text_, file_, changed);
    if (!scene) return;
    remember("");
    overrides_ = std::move(changed);
    scene_ = std::move(*scene);
}

bool Document::isChanged(const std::string& key) const {
    return std::any_of(overrides_.begin(), overrides_.end(),
                       [&](const scene::Override& change) { return change.key == key; });
}

void Document::setOverrides(std::vector<scene::Override> overrides) {
    auto scene = scene::parseScene(text_, file_, overrides);
    if (!scene) return;
    remember("");
    overrides_ = std::move(overrides);
    scene_ = std::move(*scene);
}

void Document::undo() {
    if (undo_.empty()) return;
    redo_.push_back(overrides_);
    overrides_ = std::move(undo_.back());
    undo_.pop_back();
    gestureKey_.clear();
    if (auto scene = scene::parseScene(text_, file_, overrides_)) scene_ = std::move(*scene);
}

void Document::redo() {
    if (redo_.empty()) return;
    undo_.push_back(overrides_);
    overrides_ = std::move(redo_.back());
    redo_.pop_back();
    gestureKey_.clear();
    if (auto scene = scene::parseScene(text_, file_, overrides_)) scene_ = std::move(*scene);
}

bool Document::fileChanged() const { return isSceneFile_ && timeOf(file_) != readTime_; }

Result<void> Document::readAgain() {
    if (!isSceneFile_) return {};
    const auto time = timeOf(file_);
    readTime_ = time;
    SHOAL_TRY_ASSIGN(std::string text, readText(file_));
    auto scene = scene::parseScene(text, file_, overrides_);
    if (!scene && scene.error().kind == ErrorKind::usage) {
        // A change speaks of what is no longer there: keep those that still fit.
        std::vector<scene::Override> fitting;
        for (const scene::Override& change : overrides_) {
            fitting.push_back(change);
            if (!scene::parseScene(text, file_, fitting)) fitting.pop_back();
        }
        scene = scene::parseScene(text, file_, fitting);
        if (scene) overrides_ = std::move(fitting);
    }
    if (!scene) return std::move(scene).error();
    text_ = std::move(text);
    scene_ = std::move(*scene);
    return {};
}

Result<std::string> Document::textFor(const fs::path& to, const std::vector<scene::Override>& more) const {
    std::vector<scene::Override> changes = overrides_;
    changes.insert(changes.end(), more.begin(), more.end());
    return scene::changedSceneText(text_, file_, to, changes);
}

Result<void> Document::becomeFile(const fs::path& to) {
    SHOAL_TRY_ASSIGN(std::string text, readText(to));
    SHOAL_TRY_ASSIGN(scene::Scene scene, scene::parseScene(text, to, {}));
    file_ = to;
    opened_ = {to};
    isSceneFile_ = true;
    readTime_ = timeOf(to);
    text_ = std::move(text);
    overrides_.clear();
    undo_.clear();
    redo_.clear();
    scene_ = std::move(scene);
    return {};
}

std::string shellQuoted(const std::string& word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-./=,:+@%") == std::string::npos;
    if (plain) return word;
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

std::string renderCommand(const Document& document, const std::vector<scene::Override>& more) {
    std::string command = "shoal render " + shellQuoted(fs::absolute(document.file()).lexically_normal().string());
    std::vector<scene::Override> changes = document.overrides();
    changes.insert(changes.end(), more.begin(), more.end());
    for (std::size_t i = 0; i < changes.size(); ++i) {
        bool again = false;  // a later one of the same key counts
        for (std::size_t j = i + 1; j < changes.size(); ++j) again = again || changes[j].key == changes[i].key;
        if (!again) command += " --set " + shellQuoted(changes[i].key + "=" + changes[i].value);
    }
    return command + " -o " + shellQuoted(document.file().stem().string() + ".png");
}

}  // namespace shoal::viewer
