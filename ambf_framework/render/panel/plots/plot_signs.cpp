// The small signs beside values that plot them.
#include <algorithm>

#include "render/panel/sections/sections.h"

namespace ambf::render {

void plot_sign(PanelScene& scene, const std::string& object, std::initializer_list<const char*> components,
               float side) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const std::string first = object + " " + *components.begin();
  const bool plotted = std::all_of(components.begin(), components.end(), [&](const char* component) {
    return model.plots.traces.has(object + " " + component);
  });
  ImGui::PushStyleColor(ImGuiCol_Text, plotted ? ui.accent : ui.muted);
  ImGui::PushStyleColor(ImGuiCol_Button, ImVec4(0.0F, 0.0F, 0.0F, 0.0F));
  const bool pressed = small_icon_button(ui, "plot_it/" + first, Icon::curve,
                                         plotted ? "Plot it no longer" : "Plot it: see Plots", side);
  ImGui::PopStyleColor(2);
  if (!pressed) return;
  for (const char* component : components) model.plots.plot(object + " " + component, !plotted);
}

void plot_sign_of_row(PanelScene& scene, const std::string& object, std::initializer_list<const char*> components) {
  ImGui::TableSetColumnIndex(0);
  const float side = ImGui::GetTextLineHeight();
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + ImGui::GetContentRegionAvail().x - side);
  plot_sign(scene, object, components, side);
}

}  // namespace ambf::render
