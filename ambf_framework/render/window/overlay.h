// Text over a window's picture: recent messages, times and rates, input devices. Pure functions, main thread.
#pragma once

#include <string>
#include <vector>

#include "render/marks/device_text.h"
#include "render/text/text_drawing.h"

namespace ambf::render {

inline constexpr TextColor kOverlayPaper = {0.07F, 0.09F, 0.12F, 0.80F}, kOverlayInk = {0.93F, 0.95F, 0.97F, 1.0F},
                           kOverlayAccent = {0.55F, 0.80F, 1.0F, 1.0F};
inline constexpr double kOverlayMargin_px = 12.0;  // to the picture's edges, at scale 1

struct OverlayText {
  std::vector<std::string> messages;  // lower left, newest last; in as many lines as they need
  std::vector<std::string> labels;    // lower edge, in the middle
  std::vector<DeviceLine> devices{};  // upper left
  std::vector<std::string> tasks{};   // upper edge, in the middle
};

void draw_overlay(const OverlayText& text, TextDrawing& drawing);

}  // namespace ambf::render
