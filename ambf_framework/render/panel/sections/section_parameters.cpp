// Live parameters of one object, with marks on what was changed and the way back.
#include <cctype>

#include "render/panel/sections/sections.h"
#include "render/scene/object_kind.h"

namespace ambf::render {

namespace {

const char* unit_of(const PanelModel& model, const state::ObjectInfo& object, state::Parameter parameter) {
  using state::ControllerOutput;
  using state::Parameter;
  if (is_joint(object)) {
    const state::JointInfo& joint = model.structure().joints[object.slot];
    const bool force = joint.output == ControllerOutput::force;
    const bool slides = joint.type == state::JointType::prismatic || joint.type == state::JointType::linear_spring;
    switch (parameter) {
      case Parameter::joint_p: return !force ? "1/s" : slides ? "N/m" : "Nm/rad";
      case Parameter::joint_i: return !force ? "1/s\u00b2" : slides ? "N/(m s)" : "Nm/(rad s)";
      case Parameter::joint_d: return !force ? "" : slides ? "Ns/m" : "Nms/rad";
      default: return slides ? "Ns/m" : "Nms/rad";
    }
  }
  const state::BodyInfo& body = model.structure().bodies[object.slot];
  const bool linear = body.linear_output == ControllerOutput::force;
  const bool angular = body.angular_output == ControllerOutput::force;
  switch (parameter) {
    case Parameter::linear_p: return linear ? "N/m" : "1/s";
    case Parameter::linear_i: return linear ? "N/(m s)" : "1/s\u00b2";
    case Parameter::linear_d: return linear ? "Ns/m" : "";
    case Parameter::angular_p: return angular ? "Nm/rad" : "1/s";
    case Parameter::angular_i: return angular ? "Nm/(rad s)" : "1/s\u00b2";
    case Parameter::angular_d: return angular ? "Nms/rad" : "";
    default: return "";
  }
}

// Gains of a joint that no controller moves.
bool idle(const PanelModel& model, const state::ObjectInfo& object, state::Parameter parameter) {
  if (!is_joint(object) || parameter == state::Parameter::joint_damping) return false;
  switch (model.structure().joints[object.slot].type) {
    case state::JointType::revolute:
    case state::JointType::prismatic:
    case state::JointType::linear_spring:
    case state::JointType::torsion_spring: return false;
    default: return true;
  }
}

void draw_one(PanelScene& scene, const state::ObjectInfo& object, const state::ParameterInfo& info) {
  Ui& ui = scene.ui;
  const math::Vec3 now = scene.model.tune.now(object, info.parameter);
  const math::Vec3 loaded = scene.model.tune.loaded(object, info.parameter);
  const bool changed = !(now == loaded);
  const std::string name = std::string("parameter/") + info.name;
  const char* unit = unit_of(scene.model, object, info.parameter);
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
    edited = number_field(ui, name + "/x", &value.x, info.least, info.most, "%.4g", width);
    ImGui::SameLine(0.0F, gap);
    edited |= number_field(ui, name + "/y", &value.y, info.least, info.most, "%.4g", width);
    ImGui::SameLine(0.0F, gap);
    edited |= number_field(ui, name + "/z", &value.z, info.least, info.most, "%.4g", width);
  } else {
    edited = number_field(ui, name, &value.x, info.least, info.most, "%.4g", room);
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

void draw_parameters(PanelScene& scene, const state::ObjectInfo& object) {
  if (!section(scene.ui, "Parameters", is_joint(object)) || !begin_rows("parameters")) return;
  for (int i = 0; i < state::kParameterCount; ++i) {
    const state::ParameterInfo& info = state::info_of(static_cast<state::Parameter>(i));
    if (info.kind == object.kind && !idle(scene.model, object, info.parameter)) draw_one(scene, object, info);
  }
  end_rows();
}

}  // namespace ambf::render
