// One widget a parameter: slider by its range, a word list, a check box; tooltip, double-click to type, back to
// default.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "view/fields.h"

namespace shoal::viewer {

// Where the widgets of this frame are, by the key of what they change: scripts point at them.
struct WidgetPlace {
    float x = 0, y = 0, width = 0, height = 0;  // pixels from the window's top left
};
using WidgetPlaces = std::map<std::string, WidgetPlace>;
// Remembers the last item drawn under `name`.
void notePlace(WidgetPlaces& places, const std::string& name);

struct FieldActions {
    std::function<void(const std::string& key, const std::string& value)> set;
    std::function<void(const std::string& key)> reset;      // to what the file says
    std::function<bool(const std::string& key)> isChanged;  // from what the file says
    std::function<void()> gestureEnded;
    WidgetPlaces* places = nullptr;
};

void drawField(const FieldInfo& info, const FieldActions& actions);
void drawGroup(const FieldGroup& group, const FieldActions& actions, const std::string& filter);

}  // namespace shoal::viewer
