// Text over a window's picture: the help, recent messages, times and rates. Pure functions, main thread.
#pragma once

#include <string>
#include <vector>

#include "render/text/text_drawing.h"
#include "render/window/keys.h"

namespace ambf::render {

struct OverlayText {
  std::vector<HelpLine> help;         // upper left, in as many columns as it needs; empty: not shown
  std::vector<std::string> messages;  // lower left, newest last
  std::vector<std::string> labels;    // lower edge, in the middle
};

void draw_overlay(const OverlayText& text, TextDrawing& drawing);

}  // namespace ambf::render
