// How the panels look: font, size, light and dark.
#pragma once

namespace shoal::viewer {

enum class Theme { dark, light };

// Colours and spacing for pixels of `scale` (1: a screen of about 96 dots an inch). Between frames.
void applyStyle(Theme theme, float scale);
// The fonts for that scale; before the first frame.
void loadFonts(float scale);
// A colour of the theme for lines and marks over the picture.
unsigned accentColor();
unsigned warningColor();
// Fixed-width, for numbers in columns; the plain font where there is none.
struct MonoScope {
    MonoScope();
    ~MonoScope();
};

}  // namespace shoal::viewer
