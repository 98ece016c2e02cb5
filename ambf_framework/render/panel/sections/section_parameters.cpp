// Live parameters of one object, with marks on what was changed and the way back.
#include <cctype>

#include "render/panel/sections/sections.h"

namespace ambf::render {

namespace {

void draw_one(PanelScene& scene, const state::ObjectInfo& object, const state::ParameterInfo& info, const char* unit) {
  Ui& ui = scene.ui;
  const math::Vec3 now = scene.model.tune.now(object, info.parameter);
  const math::Vec3 loaded = scene.model.tune.loaded(object, info.parameter);
  const bool changed = !(now == loaded);
  const std::string name = std::string("parameter/") + info.name;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  std::string label = info.name;
  label.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(label.front())));
  ImGui::TextColored(changed ? ui.warning : ui.muted, "%s%s", label.c_str(), changed ? " *" : "");
  char tip[300];
  std::snprintf(tip, sizeof tip, "%s%s%s", info.meaning, *unit != '\0' ? "; " : "", unit);
  tool_tip(tip);
  ImGui::TableNextColumn();
  const float room = ImGui::GetContentRegionAvail().x / ui.scale - ImGui::GetFrameHeight() * 1.5F / ui.scale;
  math::Vec3 value = now;
  bool edited = false;
  if (info.per_axis) {
    const float gap = ImGui::GetStyle().ItemInnerSpacing.x;
    const float width = (room - 2.0F * gap / ui.scale) / 3.0F;
    edited = number_field(ui, name + "/x", &value.x, info.min, info.max, "%.4g", width);
    ImGui::SameLine(0.0F, gap);
    edited |= number_field(ui, name + "/y", &value.y, info.min, info.max, "%.4g", width);
    ImGui::SameLine(0.0F, gap);
    edited |= number_field(ui, name + "/z", &value.z, info.min, info.max, "%.4g", width);
  } else {
    edited = number_field(ui, name, &value.x, info.min, info.max, "%.4g", room);
    value = {value.x, value.x, value.x};
  }
  if (edited) scene.model.tune.set(object.id, info.parameter, value);
  if (!changed) return;
  ImGui::SameLine(0.0F, ui.points(3.0F));
  if (info.per_axis) {
    std::snprintf(tip, sizeof tip, "Back to %g, %g, %g", loaded.x, loaded.y, loaded.z);
  } else {
    std::snprintf(tip, sizeof tip, "Back to %g", loaded.x);
  }
  if (icon_button(ui, name + "/revert", Icon::reset, tip)) scene.model.tune.revert(object.id, info.parameter);
}

}  // namespace

void draw_parameters(PanelScene& scene, const state::ObjectInfo& object, const ParameterRows& rows) {
  if (!section(scene.ui, "Parameters", rows.open) || !begin_rows("parameters")) return;
  const state::Structure& structure = scene.model.structure();
  for (int i = 0; i < state::kParameterCount; ++i) {
    const state::ParameterInfo& info = state::info_of(static_cast<state::Parameter>(i));
    if (info.kind != object.kind) continue;
    if (rows.in_use != nullptr && !rows.in_use(structure, object.slot, info.parameter)) continue;
    draw_one(scene, object, info, rows.unit == nullptr ? "" : rows.unit(structure, object.slot, info.parameter));
  }
  end_rows();
}

}  // namespace ambf::render
