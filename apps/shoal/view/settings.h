// What the viewer remembers from one start to the next: theme, recent files, whether the hint was read.
// One line each in $XDG_STATE_HOME/shoal/view (default ~/.local/state); a file that cannot be read or written is no
// error.
#pragma once

#include <string>
#include <vector>

#include "view/style.h"

namespace shoal::viewer {

struct Settings {
    Theme theme = Theme::dark;
    bool hintRead = false;
    std::vector<std::string> recent;  // newest first
    void addRecent(const std::string& file);
};

Settings readSettings();
void writeSettings(const Settings& settings);

}  // namespace shoal::viewer
