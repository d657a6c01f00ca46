// What is open: a scene's text as it stands in its file, and the values changed since. Everything on screen follows
// from the two, and so does what is saved.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <shoal/scene/scene.h>

namespace shoal::viewer {

// What a change makes necessary.
enum class Effect {
    none,
    request,  // camera, time, size: only drawn again
    update,   // Pipeline::updateScene
    reload,   // models are read again
};
Effect effectOf(const std::string& key);

class Document {
public:
    // A scene file, or models (and one environment picture) to stand in a fitting default scene.
    static Result<Document> open(const std::vector<std::filesystem::path>& files,
                                 std::vector<scene::Override> overrides = {});

    const scene::Scene& scene() const { return scene_; }
    const std::filesystem::path& file() const { return file_; }
    bool isSceneFile() const { return isSceneFile_; }
    std::string title() const;

    // Changes one value; the scene stays as it is when that is an error.
    Result<void> set(const std::string& key, const std::string& value);
    // Back to what the file says.
    void reset(const std::string& key);
    bool isChanged(const std::string& key) const;
    const std::vector<scene::Override>& overrides() const { return overrides_; }
    void setOverrides(std::vector<scene::Override> overrides);  // of another document of the same file
    bool canUndo() const { return !undo_.empty(); }
    bool canRedo() const { return !redo_.empty(); }
    void undo();
    void redo();
    // One press of the mouse is one step of undo, however many values it runs through.
    void endGesture() { gestureKey_.clear(); }

    // Whether the file is another one than was read.
    bool fileChanged() const;
    // Reads it again with the changes kept. Changes that no longer fit are dropped. The scene stays when that fails;
    // the same failure is not told twice for the same file.
    Result<void> readAgain();

    // The scene as it is now with `more` values on top, as a file at `to`.
    Result<std::string> textFor(const std::filesystem::path& to, const std::vector<scene::Override>& more) const;
    // After saving: `to` is now the file.
    Result<void> becomeFile(const std::filesystem::path& to);

private:
    Result<void> parse();
    void remember(const std::string& key);

    std::filesystem::path file_;                 // the scene, or the first model
    std::vector<std::filesystem::path> opened_;  // as asked for
    bool isSceneFile_ = false;
    std::string text_;
    std::filesystem::file_time_type readTime_;
    std::vector<scene::Override> overrides_;
    std::vector<std::vector<scene::Override>> undo_, redo_;
    std::string gestureKey_;
    scene::Scene scene_;
};

// `shoal render` with all that is changed, quoted for a POSIX shell.
std::string renderCommand(const Document& document, const std::vector<scene::Override>& more);
std::string shellQuoted(const std::string& word);

}  // namespace shoal::viewer
