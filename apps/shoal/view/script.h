// Synthetic input from a file, for tests and pictures of the documentation: one command a line, through the same queue
// as a hand's. `shoal view SCENE --script FILE`; docs/viewer.md lists the commands.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "view/viewer.h"

namespace shoal::viewer {

class Script {
public:
    static Result<Script> read(const std::string& file);

    // Called once a turn, before the events are handled; appends events and calls the viewer. After the last line the
    // viewer quits. A line that cannot be done is an error with its number.
    Result<void> step(Viewer& viewer, std::vector<Event>& events);
    // Called when a turn is drawn and not yet shown: pictures of the window, measurements.
    Result<void> drawn(const Viewer& viewer);
    // Turns last as long as they take; else each is a thirtieth of a second to the viewer.
    bool realTime() const { return realTime_; }

private:
    using Action = std::function<void(Viewer&, std::vector<Event>&)>;
    Result<void> start(Viewer& viewer, const std::vector<std::string>& words, const std::string& rest);
    void later(Action action) { actions_.push_back(std::move(action)); }
    void click(int button, double x, double y, int mods, int times);

    std::string file_, grab_;
    std::vector<std::string> lines_;
    std::size_t next_ = 0;
    std::deque<Action> actions_;  // one a turn
    std::function<bool(const Viewer&)> until_;
    int waited_ = 0;
    bool realTime_ = false, timing_ = false;
    std::optional<ByteImage> before_;  // latency: the window before the input
    int latencyTurns_ = -1;
    std::chrono::steady_clock::time_point turnStart_;
};

}  // namespace shoal::viewer
