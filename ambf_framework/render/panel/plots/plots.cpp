#include "render/panel/plots/plots.h"

#include <algorithm>
#include <fstream>

namespace ambf::render {

Plots::Plots(PanelSettings& settings, const Notices& notices) : settings_(settings), notices_(notices) {
  for (const std::string& name : settings.plotted) traces.add(name);
}

void Plots::plot(const std::string& name, bool shown) {
  if (shown == traces.has(name)) return;
  if (shown && !traces.add(name)) return notices_.show("six plots at most");
  if (!shown) {
    traces.remove(name);
    zoom_.values.erase(name);
    if (traces.traces().empty()) zoom_out();
  }
  settings_.plotted.clear();
  for (const Traces::Trace& trace : traces.traces()) settings_.plotted.push_back(trace.name);
}

bool Plots::watched(const std::string& name) const {
  return std::find(settings_.watched.begin(), settings_.watched.end(), name) != settings_.watched.end();
}

void Plots::watch(const std::string& name, bool shown) {
  if (shown == watched(name)) return;
  if (shown) settings_.watched.push_back(name);
  if (!shown) std::erase(settings_.watched, name);
}

void Plots::clear() {
  traces.clear();
  zoom_out();
}

void Plots::zoom_in(const std::string& name, const std::optional<PlotSpan>& time_s,
                    const std::optional<PlotSpan>& values) {
  if (!zoom_.any()) zoom_.was_paused = traces.paused();
  traces.set_paused(true);
  if (time_s) zoom_.time_s = time_s;
  if (values) zoom_.values[name] = *values;
}

void Plots::zoom_out() {
  if (!zoom_.any()) return;
  traces.set_paused(zoom_.was_paused);
  zoom_ = {};
}

void Plots::export_csv(const std::string& path) {
  std::ofstream out(path);
  out << traces.csv();
  out.close();
  notices_.show(out ? "written: " + path : "cannot write " + path);
}

}  // namespace ambf::render
