// Text over a window's picture: the help, what happened lately, times and rates. Pure functions of what is to be said, main thread.
#pragma once

#include <string>
#include <vector>

#include "render/marks/flat_drawing.h"
#include "render/window/keys.h"

namespace ambf::render {

struct OverlayText {
  std::vector<HelpLine> help;         // upper left, in as many columns as it needs; empty: not shown
  std::vector<std::string> messages;  // lower left, newest last
  std::vector<std::string> labels;    // lower edge, in the middle
};

// `scale`: 2 on a high-density screen.
void draw_overlay(const OverlayText& text, int width_px, int height_px, double scale, FlatDrawing& drawing);

}  // namespace ambf::render
