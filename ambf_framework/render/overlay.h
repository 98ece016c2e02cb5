// Text over a window's picture: the help, what happened lately. Pure functions of what is to be said, main thread.
#pragma once

#include <string>
#include <vector>

#include "render/flat_drawing.h"

namespace ambf::render {

struct OverlayText {
  std::vector<std::string> help;      // upper left; empty: not shown
  std::vector<std::string> messages;  // lower left, newest last
  std::vector<std::string> labels;    // lower edge, in the middle
};

void draw_overlay(const OverlayText& text, int width_px, int height_px, FlatDrawing& drawing);

}  // namespace ambf::render
