// Any named value over the last half minute, and as numbers.
#include <algorithm>

#include "render/panel/plots/plot_box.h"
#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

constexpr std::size_t kMaxFound = 200;

std::string last_part(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? name : name.substr(slash + 1);
}

constexpr float kMinPlot_points = 110.0F, kMaxPlot_points = 260.0F;

void draw_trace(PanelScene& scene, const Traces::Trace& trace, int number, float height_points, std::string& removed) {
  Ui& ui = scene.ui;
  ImGui::PushID(trace.name.c_str());
  ImGui::TextColored(curve_color(ui, number), "%s", last_part(trace.name).c_str());
  tool_tip(trace.name.c_str());
  ImGui::SameLine();
  if (!trace.value) {
    ImGui::TextColored(ui.muted, "is not there");
  } else if (!trace.numbers.empty()) {
    ImGui::Text("%.5g %s", trace.numbers.back(), trace.value->unit);
  }
  ImGui::SameLine();
  ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::GetFrameHeight() * 1.15F);
  if (icon_button(ui, "plot/remove/" + trace.name, Icon::close, "Remove this plot")) removed = trace.name;
  const std::deque<double>& times = scene.model.plots.traces.times();
  const PlotZoom& zoom = scene.model.plots.zoom();
  const PlotSpan all =
      times.empty() ? PlotSpan{0.0, 1.0} : PlotSpan{times.front(), std::max(times.back(), times.front() + 1e-3)};
  const PlotSpan shown = zoom.time_s.value_or(all);
  const auto zoomed = zoom.values.find(trace.name);
  const PlotSpan range = zoomed != zoom.values.end() ? zoomed->second : range_of(times, trace.numbers, shown);
  const PlotGesture gesture = plot_box(ui,
                                       {"plot/" + trace.name, times, trace.numbers, shown, range,
                                        trace.value ? trace.value->unit : "", curve_color(ui, number)},
                                       height_points);
  if (gesture.zoom_out) {
    scene.model.plots.zoom_out();
  } else if (gesture.time_s || gesture.range) {
    scene.model.plots.zoom_in(trace.name, gesture.time_s, gesture.range);
  }
  ImGui::PopID();
}

void draw_search(PanelScene& scene, std::string& search) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  text_field(ui, "values/search", "Search values: a body or joint, then position, velocity ...", &search);
  if (search_words(search).empty()) return;
  const std::vector<Value> found = find_values(model.structure(), search, kMaxFound);
  const float line = ImGui::GetFrameHeightWithSpacing();
  ImGui::BeginChild("found", {0.0F, line * std::min(6.3F, static_cast<float>(found.size()) + 0.3F)});
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(found.size()));
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const Value& value = found[static_cast<std::size_t>(i)];
      ImGui::PushID(i);
      bool plotted = model.plots.traces.has(value.name), watched = model.plots.watched(value.name);
      if (check_box(ui, "values/plot/" + value.name, "", &plotted)) model.plots.plot(value.name, plotted);
      tool_tip("plot it");
      ImGui::SameLine();
      if (check_box(ui, "values/watch/" + value.name, "", &watched)) model.plots.watch(value.name, watched);
      tool_tip("watch it as a number");
      ImGui::SameLine();
      ImGui::TextUnformatted(last_part(value.name).c_str());
      tool_tip(value.name.c_str());
      ImGui::PopID();
    }
  }
  if (found.empty()) ImGui::TextColored(ui.muted, "Nothing of that name");
  ImGui::EndChild();
}

void draw_watched(PanelScene& scene) {
  Ui& ui = scene.ui;
  if (scene.model.settings.watched.empty()) return;
  heading(ui, "Watched");
  std::string removed;
  for (const std::string& name : scene.model.settings.watched) {
    ImGui::PushID(name.c_str());
    if (icon_button(ui, "watch/remove/" + name, Icon::close, "Watch it no longer")) removed = name;
    ImGui::SameLine();
    const std::optional<Value> value = find_value(scene.model.structure(), name);
    ImGui::AlignTextToFramePadding();
    ImGui::TextColored(ui.muted, "%s", last_part(name).c_str());
    tool_tip(name.c_str());
    ImGui::SameLine();
    if (value) {
      ImGui::Text("%.6g %s", read_value(scene.model.frame(), *value), value->unit);
    } else {
      ImGui::TextColored(ui.muted, "is not there");
    }
    ImGui::PopID();
  }
  if (!removed.empty()) scene.model.plots.watch(removed, false);
}

class PlotsTab final : public PanelTab {
 public:
  const char* name() const override { return "Plots"; }
  void draw(PanelScene& scene) override;

 private:
  std::string search_, csv_path_ = "ambf_plot.csv";
};

void PlotsTab::draw(PanelScene& scene) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  draw_search(scene, search_);
  ImGui::BeginChild("plots", {0.0F, 0.0F}, false, ImGuiWindowFlags_NoBackground);
  draw_watched(scene);
  if (model.plots.traces.traces().empty()) {
    muted_text(
        ui,
        "Search for a value above, and tick the first box to plot it, the second to watch it. The small curves beside "
        "values of objects and joints plot them, too.");
  } else {
    heading(ui, "Plots");
    ImGui::SameLine();
    const double span = model.plots.traces.times().size() < 2
                            ? 0.0
                            : model.plots.traces.times().back() - model.plots.traces.times().front();
    if (model.plots.zoom().time_s) {
      ImGui::TextColored(ui.accent, "%.3f to %.3f s", model.plots.zoom().time_s->from, model.plots.zoom().time_s->to);
    } else {
      ImGui::TextColored(ui.muted, "the last %.1f s simulated", span);
    }
    const bool paused = model.plots.traces.paused();
    if (icon_button(ui, "plots/pause", paused ? Icon::play : Icon::pause, paused ? "Go on" : "Hold the plots still")) {
      model.plots.traces.set_paused(!paused);
    }
    ImGui::SameLine();
    if (button(ui, "plots/clear", "Clear")) model.plots.clear();
    ImGui::SameLine();
    if (button(ui, "plots/all", "Show all", model.plots.zoom().any())) model.plots.zoom_out();
    tool_tip(
        "A rectangle dragged in a plot zooms in and holds the plots still; this, or a double click, shows all again");
    ImGui::SameLine();
    if (button(ui, "plots/export", "Write CSV")) model.plots.export_csv(csv_path_);
    ImGui::SameLine();
    text_field(ui, "plots/path", "file", &csv_path_);
    std::string removed;
    int number = 0;
    // They share what the tab has left.
    const auto count = static_cast<float>(model.plots.traces.traces().size());
    const float each = ImGui::GetContentRegionAvail().y / count - 1.6F * ImGui::GetFrameHeightWithSpacing();
    const float height_points = std::clamp(each / ui.points(1.0F), kMinPlot_points, kMaxPlot_points);
    for (const Traces::Trace& trace : model.plots.traces.traces())
      draw_trace(scene, trace, number++, height_points, removed);
    if (!removed.empty()) model.plots.plot(removed, false);
  }
  ImGui::EndChild();
}

}  // namespace

std::unique_ptr<PanelTab> make_plots_tab() { return std::make_unique<PlotsTab>(); }

}  // namespace ambf::render
