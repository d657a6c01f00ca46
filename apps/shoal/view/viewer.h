// The viewer's state and what can be done with it. Panels and scripts call the same functions.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <shoal/gl/window.h>

#include "view/camera.h"
#include "view/document.h"
#include "view/events.h"
#include "view/inspector.h"
#include "view/picture.h"
#include "view/settings.h"
#include "view/widgets.h"

namespace shoal::viewer {

struct Timeline {
    float time = 0, speed = 1;
    bool playing = false, loop = true;
};

// A rectangle of the window, pixels from its top left.
struct Area {
    int x = 0, y = 0, width = 0, height = 0;
    bool contains(double px, double py) const { return px >= x && py >= y && px < x + width && py < y + height; }
};

// Two sets of parameters side by side: the document left, `other` right of the divider.
struct Comparison {
    Document other;
    Picture picture;
    float divider = 0.5f;   // of the viewport's width
    bool editOther = true;  // which side the panels change
};

// What one frame cost.
struct FrameCost {
    double totalMs = 0;
    std::vector<gl::PassTime> passes;
};

enum class Dialog { none, open, save, screenshot };

class Viewer {
public:
    Viewer(gl::Window& window, Document document, Picture picture);

    // One turn of the loop: input, time, drawing. `seconds`: since the turn before.
    void handle(const Event& event);
    void update(double seconds);
    void draw();              // the viewport; panels are drawn by drawPanels
    bool wantsFrame() const;  // whether something changes without input

    void openFiles(const std::vector<std::filesystem::path>& files);
    Result<void> saveScene(const std::filesystem::path& to, bool windowSize);
    Result<void> screenshot(const std::filesystem::path& to);
    std::string command() const;
    void setValue(const std::string& key, const std::string& value);
    void resetValue(const std::string& key);
    void startComparison();
    void stopComparison();
    void say(const std::string& note) { note_ = note, noteSeconds_ = 4; }
    void fail(const std::string& error) { error_ = error; }

    Document& shownDocument();  // which the panels change
    Picture::Wanted wanted(const Picture& picture) const;
    scene::CameraSpec cameraSpec() const;  // the one on screen
    std::vector<scene::Override> pictureOverrides(bool windowSize) const;
    void useOwnCamera();  // from the scene's to one that is moved by hand
    void goToSceneCamera();
    bool interacting() const { return movingSeconds_ > 0 || timeline.playing; }
    std::string statusLine() const;
    void press(int key, int mods);  // a key of the viewport
    void undo();
    void redo();

    gl::Window& window;
    Document document;
    Picture picture;
    std::optional<Comparison> comparison;
    ViewCamera camera;
    Timeline timeline;
    ScaleController scale;
    Inspector inspector;
    Settings settings;
    WidgetPlaces places;
    Area viewport;  // set by the layout
    float uiScale = 1;
    bool showPanels = true, showHelp = false, showPerformance = false, flyMode = false, quit = false;
    Dialog dialog = Dialog::none;
    bool styleChanged = true;
    std::deque<FrameCost> costs;
    std::string error_, note_;
    double noteSeconds_ = 0;
    double cursorX = 0, cursorY = 0;
    float flySpeed = 1;  // times the scene's size a second
    bool recordSettings = true;

private:
    void watchFiles(double seconds);
    void flyByKeys(float seconds);
    void dragTo(double x, double y);
    void applied(Effect effect);
    void takeResult(const Result<void>& result);
    float aspect() const { return float(std::max(viewport.width, 1)) / float(std::max(viewport.height, 1)); }
    const Bounds& sceneBounds() const;
    void touch() { movingSeconds_ = 0.2, touched_ = true; }

    enum class Drag { none, orbit, pan, dolly, look, divider } drag_ = Drag::none;
    double dragX_ = 0, dragY_ = 0;
    std::set<int> keysDown_;
    double movingSeconds_ = 0, watchSeconds_ = 0;
    bool touched_ = false;  // in this turn, however long the one before took
    bool freshDocument_ = true;
    float documentTime_ = 0;
    std::optional<Document> before_;  // what was open before `document`, until that is shown
    void applyDifference(const std::vector<scene::Override>& before);
};

}  // namespace shoal::viewer
