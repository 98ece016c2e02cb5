// What the panel plots and watches, and which part of the plots is shown. Main thread.
#pragma once

#include <optional>
#include <string>

#include "render/panel/detail/settings.h"
#include "render/panel/notices.h"
#include "render/panel/plots/plot_zoom.h"
#include "render/panel/plots/values.h"

namespace ambf::render {

class Plots {
 public:
  // Begins with what the settings plot; they follow.
  Plots(PanelSettings& settings, const Notices& notices);

  void plot(const std::string& name, bool shown);
  void watch(const std::string& name, bool shown);
  bool watched(const std::string& name) const;
  void clear();
  // Shows a part of the time, and of the values of this plot; holds them still until all is shown again.
  void zoom_in(const std::string& name, const std::optional<PlotSpan>& time_s, const std::optional<PlotSpan>& values);
  void zoom_out();
  const PlotZoom& zoom() const { return zoom_; }
  void export_csv(const std::string& path);

  Traces traces;

 private:
  PanelSettings& settings_;
  const Notices& notices_;
  PlotZoom zoom_;
};

}  // namespace ambf::render
