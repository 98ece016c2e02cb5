// A curve in a box with values at its edges; the pointer reads and zooms it. Main thread.
#pragma once

#include <deque>
#include <string>

#include "render/panel/plots/plot_zoom.h"
#include "render/panel/ui.h"

namespace ambf::render {

struct PlotBox {
  std::string name;  // of the widget, too: "plot/..."
  const std::deque<double>& times;
  const std::deque<double>& values;  // as many
  PlotSpan time_s, range;            // shown
  const char* unit = "";
  ImVec4 color;
};

// What the pointer did in it.
struct PlotGesture {
  bool zoom_out = false;
  std::optional<PlotSpan> time_s,
      range;  // of the rectangle that was dragged; none in the direction in which it is flat
};

// The values between two times, with some room around them.
PlotSpan range_of(const std::deque<double>& times, const std::deque<double>& values, const PlotSpan& time_s);
// `height_points` is that of the box and the time axis below it.
PlotGesture plot_box(Ui& ui, const PlotBox& box, float height_points);

}  // namespace ambf::render
