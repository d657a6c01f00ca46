#include "view/script.h"

#include <cctype>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <shoal/io/image.h>

#include "view/layout.h"

namespace shoal::viewer {

namespace {

constexpr int kLongestWait = 20000;  // turns

Event moveTo(double x, double y) {
    Event event;
    event.x = x, event.y = y;
    return event;
}

Event buttonEvent(int button, bool pressed, int mods) {
    Event event;
    event.kind = Event::Kind::button;
    event.code = button, event.pressed = pressed, event.mods = mods;
    return event;
}

Event keyEvent(int key, bool pressed, int mods) {
    Event event;
    event.kind = Event::Kind::key;
    event.code = key, event.pressed = pressed, event.mods = mods;
    return event;
}

int keyNamed(const std::string& name) {
    static const std::map<std::string, int> kNames = {{"Escape", GLFW_KEY_ESCAPE}, {"Enter", GLFW_KEY_ENTER},
                                                      {"Tab", GLFW_KEY_TAB},       {"Space", GLFW_KEY_SPACE},
                                                      {"Home", GLFW_KEY_HOME},     {"F1", GLFW_KEY_F1},
                                                      {"F12", GLFW_KEY_F12},       {"Comma", GLFW_KEY_COMMA},
                                                      {"Period", GLFW_KEY_PERIOD}, {"Left", GLFW_KEY_LEFT},
                                                      {"Right", GLFW_KEY_RIGHT},   {"Up", GLFW_KEY_UP},
                                                      {"Down", GLFW_KEY_DOWN},     {"Backspace", GLFW_KEY_BACKSPACE},
                                                      {"KP0", GLFW_KEY_KP_0},      {"KP1", GLFW_KEY_KP_1},
                                                      {"KP3", GLFW_KEY_KP_3},      {"KP5", GLFW_KEY_KP_5},
                                                      {"KP7", GLFW_KEY_KP_7},      {"Shift", GLFW_KEY_LEFT_SHIFT}};
    if (const auto found = kNames.find(name); found != kNames.end()) return found->second;
    if (name.size() == 1 && std::isalnum(static_cast<unsigned char>(name[0])))
        return std::toupper(static_cast<unsigned char>(name[0]));
    return 0;
}

int buttonNamed(const std::string& name) {
    return name == "right"    ? GLFW_MOUSE_BUTTON_RIGHT
           : name == "middle" ? GLFW_MOUSE_BUTTON_MIDDLE
                              : GLFW_MOUSE_BUTTON_LEFT;
}

bool differs(const ByteImage& a, const ByteImage& b, const Area& where) {
    if (a.width != b.width || a.height != b.height) return true;
    for (int y = where.y; y < std::min(where.y + where.height, a.height); ++y) {
        const auto row = (std::ptrdiff_t(y) * a.width + where.x) * 4;
        if (!std::equal(a.pixels.begin() + row, a.pixels.begin() + row + std::ptrdiff_t(where.width) * 4,
                        b.pixels.begin() + row))
            return true;
    }
    return false;
}

void printState(const Viewer& v, const std::string& label) {
    std::printf("%s: objects=%lld bytes=%lld window=%dx%d picture=%dx%d time=%g error=\"%s\" status=\"%s\"\n",
                label.c_str(), static_cast<long long>(v.window.device().liveObjectCount()),
                static_cast<long long>(v.window.device().liveBytes()), v.window.width(), v.window.height(),
                v.viewport.width, v.viewport.height, double(v.timeline.time), v.error_.c_str(), v.statusLine().c_str());
    std::fflush(stdout);
}

}  // namespace

Result<Script> Script::read(const std::string& file) {
    std::ifstream stream(file);
    if (!stream) return badInput(file + ": cannot be read, expected a script of the viewer");
    Script script;
    script.file_ = file;
    for (std::string line; std::getline(stream, line);) script.lines_.push_back(line);
    return script;
}

void Script::click(int button, double x, double y, int mods, int times) {
    later([=](Viewer&, auto& events) { events.push_back(moveTo(x, y)); });
    for (int i = 0; i < times; ++i) {
        later([=](Viewer&, auto& events) { events.push_back(buttonEvent(button, true, mods)); });
        later([=](Viewer&, auto& events) { events.push_back(buttonEvent(button, false, mods)); });
    }
}

Result<void> Script::step(Viewer& viewer, std::vector<Event>& events) {
    if (until_) {
        if (!until_(viewer)) {
            if (++waited_ > kLongestWait) return badInput(file_ + ":" + std::to_string(next_) + ": waited for ever");
            return {};
        }
        until_ = nullptr;
        waited_ = 0;
    }
    if (actions_.empty()) {
        if (next_ >= lines_.size()) {
            viewer.quit = true;
            return {};
        }
        const std::string line = lines_[next_++];
        std::istringstream stream(line);
        std::vector<std::string> words;
        for (std::string word; stream >> word;) words.push_back(word);
        if (words.empty() || words[0][0] == '#') return {};
        const std::size_t after = line.find(words[0]) + words[0].size();
        const std::size_t rest = line.find_first_not_of(' ', after);
        const auto started = start(viewer, words, rest == std::string::npos ? "" : line.substr(rest));
        if (!started) return badInput(file_ + ":" + std::to_string(next_) + ": " + started.error().message);
    }
    if (actions_.empty()) return {};
    const Action action = std::move(actions_.front());
    actions_.pop_front();
    action(viewer, events);
    return {};
}

Result<void> Script::drawn(const Viewer& viewer) {
    if (const std::string file = std::exchange(grab_, ""); !file.empty())
        SHOAL_TRY(io::writeByteImage(file, readWindow(viewer.window)));
    if (latencyTurns_ >= 0 && before_) {
        ++latencyTurns_;
        if (differs(readWindow(viewer.window), *before_, viewer.viewport)) {
            std::printf("latency: frames=%d\n", latencyTurns_);
            latencyTurns_ = -1;
            before_.reset();
        }
    }
    const auto now = std::chrono::steady_clock::now();
    if (timing_)
        std::printf("turn %.3f %g\n", std::chrono::duration<double, std::milli>(now - turnStart_).count(),
                    double(viewer.picture.shownScale()));
    turnStart_ = now;
    return {};
}

Result<void> Script::start(Viewer& viewer, const std::vector<std::string>& words, const std::string& rest) {
    const std::string& verb = words[0];
    const auto number = [&](std::size_t i) { return i < words.size() ? std::atof(words[i].c_str()) : 0.0; };
    const auto word = [&](std::size_t i) { return i < words.size() ? words[i] : std::string(); };
    int mods = 0;
    for (const std::string& w : words) {
        if (w == "ctrl") mods |= GLFW_MOD_CONTROL;
        if (w == "shift") mods |= GLFW_MOD_SHIFT;
    }
    const auto place = [&](const std::string& name) -> Result<WidgetPlace> {
        const auto found = viewer.places.find(name);
        if (found == viewer.places.end()) return badInput("no widget " + name + " is on screen");
        return found->second;
    };
    if (verb == "wait") {
        if (word(1) == "loaded")
            until_ = [](const Viewer& v) { return v.picture.hasScene() && !v.picture.loading(); };
        else if (word(1) == "full")
            until_ = [](const Viewer& v) {
                return v.picture.hasScene() && !v.picture.loading() && !v.interacting() && v.picture.complete() &&
                       (!v.comparison || (v.comparison->picture.hasScene() && v.comparison->picture.complete()));
            };
        else
            for (int i = 0; i < int(number(1)); ++i) later([](Viewer&, auto&) {});
    } else if (verb == "move") {
        later([x = number(1), y = number(2)](Viewer&, auto& events) { events.push_back(moveTo(x, y)); });
    } else if (verb == "drag") {  // drag BUTTON X0 Y0 X1 Y1 STEPS
        const int button = buttonNamed(word(1)), steps = std::max(1, int(number(6)));
        const double x0 = number(2), y0 = number(3), x1 = number(4), y1 = number(5);
        later([=](Viewer&, auto& events) { events.push_back(moveTo(x0, y0)); });
        later([=](Viewer&, auto& events) { events.push_back(buttonEvent(button, true, mods)); });
        for (int i = 1; i <= steps; ++i)
            later([=](Viewer&, auto& events) {
                const double t = double(i) / steps;
                events.push_back(moveTo(x0 + (x1 - x0) * t, y0 + (y1 - y0) * t));
            });
        later([=](Viewer&, auto& events) { events.push_back(buttonEvent(button, false, mods)); });
    } else if (verb == "click" || verb == "doubleclick" || verb == "point" || verb == "slide") {
        SHOAL_TRY_ASSIGN(const WidgetPlace at, place(word(1)));
        const double x = double(at.x + 0.5f * at.width), y = double(at.y + 0.5f * at.height);
        if (verb == "point") {
            later([=](Viewer&, auto& events) { events.push_back(moveTo(x, y)); });
        } else if (verb == "slide") {  // slide WIDGET FROM TO: fractions of its width
            const double from = double(at.x) + number(2) * double(at.width),
                         to = double(at.x) + number(3) * double(at.width);
            later([=](Viewer&, auto& events) { events.push_back(moveTo(from, y)); });
            later([=](Viewer&, auto& events) { events.push_back(buttonEvent(0, true, 0)); });
            for (int i = 1; i <= 8; ++i)
                later([=](Viewer&, auto& events) { events.push_back(moveTo(from + (to - from) * i / 8, y)); });
            later([=](Viewer&, auto& events) { events.push_back(buttonEvent(0, false, 0)); });
        } else {
            click(buttonNamed(word(2)), x, y, 0, verb == "click" ? 1 : 2);
        }
    } else if (verb == "scroll") {
        later([steps = number(1)](Viewer&, auto& events) {
            Event event;
            event.kind = Event::Kind::scroll;
            event.y = steps;
            events.push_back(event);
        });
    } else if (verb == "key" || verb == "hold") {  // key NAME [ctrl] [shift]; hold NAME TURNS
        const int key = keyNamed(word(1));
        if (key == 0) return badInput("found no key called \"" + word(1) + "\"");
        later([=](Viewer&, auto& events) { events.push_back(keyEvent(key, true, mods)); });
        if (verb == "hold")
            for (int i = 0; i < int(number(2)); ++i) later([](Viewer&, auto&) {});
        later([=](Viewer&, auto& events) { events.push_back(keyEvent(key, false, mods)); });
    } else if (verb == "type") {
        for (const char c : rest)
            later([=](Viewer&, auto& events) {
                Event event;
                event.kind = Event::Kind::character;
                event.code = c;
                events.push_back(event);
            });
    } else if (verb == "resize") {
        later(
            [w = int(number(1)), h = int(number(2))](Viewer& v, auto&) { glfwSetWindowSize(v.window.handle(), w, h); });
    } else if (verb == "drop") {
        later([rest](Viewer&, auto& events) {
            Event event;
            event.kind = Event::Kind::drop;
            event.files = {rest};
            events.push_back(event);
        });
    } else if (verb == "copy") {  // copy FROM TO: another program saves the scene
        std::error_code error;
        std::filesystem::copy_file(word(1), word(2), std::filesystem::copy_options::overwrite_existing, error);
        if (error) return badInput("cannot copy " + rest + ": " + error.message());
    } else if (verb == "set") {
        later([key = word(1), value = rest.substr(std::min(rest.size(), word(1).size() + 1))](Viewer& v, auto&) {
            v.setValue(key, value);
        });
    } else if (verb == "save") {
        return viewer.saveScene(rest, true);
    } else if (verb == "screenshot") {
        return viewer.screenshot(rest);
    } else if (verb == "window") {
        later([this, rest](Viewer&, auto&) { grab_ = rest; });
    } else if (verb == "buffer") {
        SHOAL_TRY_ASSIGN(const std::vector<std::string> names, pipeline::parseAovList(rest == "picture" ? "" : rest));
        viewer.inspector.choose(names.size() == 1 ? names[0] : "");
    } else if (verb == "command") {
        std::printf("command: %s\n", viewer.command().c_str());
    } else if (verb == "print") {
        printState(viewer, rest.empty() ? "state" : rest);
    } else if (verb == "realtime") {
        realTime_ = true;
    } else if (verb == "times") {  // times on|off: the milliseconds of every turn
        timing_ = word(1) == "on";
    } else if (verb == "mark") {
        const auto now = std::chrono::steady_clock::now().time_since_epoch();
        std::printf("mark %s %.3f\n", rest.c_str(), std::chrono::duration<double, std::milli>(now).count());
    } else if (verb == "latency") {  // latency DX DY: turns until a drag is seen; the view is at rest before
        later([this](Viewer& v, auto&) { before_ = readWindow(v.window), latencyTurns_ = -1; });
        later([x = number(1), y = number(2), this](Viewer& v, auto& events) {
            events.push_back(moveTo(v.viewport.x + 0.5 * v.viewport.width, v.viewport.y + 0.5 * v.viewport.height));
            events.push_back(buttonEvent(0, true, 0));
            events.push_back(
                moveTo(v.viewport.x + 0.5 * v.viewport.width + x, v.viewport.y + 0.5 * v.viewport.height + y));
            latencyTurns_ = 0;
        });
        until_ = nullptr;
        for (int i = 0; i < 10; ++i) later([](Viewer&, auto&) {});
        later([](Viewer&, auto& events) { events.push_back(buttonEvent(0, false, 0)); });
    } else if (verb == "quit") {
        next_ = lines_.size();
    } else {
        return badInput("found \"" + verb + "\", expected a command of the viewer's scripts (docs/viewer.md)");
    }
    return {};
}

}  // namespace shoal::viewer
