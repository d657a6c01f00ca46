#include "view/settings.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <shoal/io/file.h>

namespace shoal::viewer {

namespace {

constexpr std::size_t kMostRecent = 12;

std::filesystem::path settingsFile() {
    if (const char* state = std::getenv("XDG_STATE_HOME"); state && *state)
        return std::filesystem::path(state) / "shoal/view";
    if (const char* home = std::getenv("HOME"); home && *home)
        return std::filesystem::path(home) / ".local/state/shoal/view";
    return {};
}

}  // namespace

void Settings::addRecent(const std::string& file) {
    std::erase(recent, file);
    recent.insert(recent.begin(), file);
    if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

Settings readSettings() {
    Settings settings;
    const std::filesystem::path file = settingsFile();
    if (file.empty()) return settings;
    const auto bytes = io::readFile(file);
    if (!bytes) return settings;
    std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size()));
    for (std::string line; std::getline(lines, line);) {
        const std::size_t space = line.find(' ');
        const std::string key = line.substr(0, space), value = space == std::string::npos ? "" : line.substr(space + 1);
        if (key == "theme") settings.theme = value == "light" ? Theme::light : Theme::dark;
        if (key == "hintRead") settings.hintRead = value == "true";
        if (key == "recent" && settings.recent.size() < kMostRecent) settings.recent.push_back(value);
    }
    return settings;
}

void writeSettings(const Settings& settings) {
    const std::filesystem::path file = settingsFile();
    if (file.empty()) return;
    std::string text = std::string("theme ") + (settings.theme == Theme::light ? "light" : "dark") + "\nhintRead " +
                       (settings.hintRead ? "true" : "false") + "\n";
    for (const std::string& recent : settings.recent)
        if (recent.find('\n') == std::string::npos) text += "recent " + recent + "\n";
    (void)io::writeFileAtomically(file, std::string_view(text));
}

}  // namespace shoal::viewer
