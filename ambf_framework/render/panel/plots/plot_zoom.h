// The visible part of the plots: a time span that all share, and a span of values for each. Plain data, any thread.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace ambf::render {

struct PlotSpan {
  double from = 0.0, to = 0.0;
  bool operator==(const PlotSpan&) const = default;
};

struct PlotZoom {
  std::optional<PlotSpan> time_s;          // simulated
  std::map<std::string, PlotSpan> values;  // by name of the trace; the others show all there is in that time
  bool was_paused = false;                 // before: zooming holds the plots still

  bool any() const { return time_s.has_value() || !values.empty(); }
};

}  // namespace ambf::render
