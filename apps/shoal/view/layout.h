// Everything drawn around and over the picture.
#pragma once

#include "view/viewer.h"

namespace shoal::viewer {

// The whole window: menu, viewport area, side panel, time bar, overlays, dialogs. Between ImGui::NewFrame and Render.
void drawLayout(Viewer& viewer);

void drawSidePanel(Viewer& viewer);    // panels.cpp
void drawPerformance(Viewer& viewer);  // performance.cpp
void drawOverlays(Viewer& viewer);     // overlays.cpp: errors, notes, hint, values under the cursor, divider
void drawHelp(Viewer& viewer);         // overlays.cpp
void drawDialogs(Viewer& viewer);      // dialogs.cpp

// Copies pictures and buffers into the window's framebuffer (blit.cpp).
void blitPictures(Viewer& viewer);
// What was drawn into the window and is not shown yet.
ByteImage readWindow(const gl::Window& window);

}  // namespace shoal::viewer
