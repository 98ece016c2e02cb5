// Joints in the panel: state and parameters.
#include <cmath>

#include "render/marks/joint_span.h"
#include "render/panel/kinds/panel_kinds.h"

namespace ambf::render {

namespace {

void draw_sign(const KindSign& sign) {
  sign.list.AddCircle(sign.centre, sign.radius, sign.color, 12, sign.stroke_width);
}

// One row for each free direction of a joint that has several. False: it has not.
bool draw_span_rows(PanelScene& scene, const state::JointInfo& joint) {
  const state::Frame& frame = scene.model.frame();
  const auto coordinates = span_coordinates(joint, frame.bodies[joint.parent_body].T_world_body,
                                            frame.bodies[joint.child_body].T_world_body);
  for (const SpanCoordinate& each : coordinates) {
    row(scene.ui, each.name);
    const char* unit = each.turns ? "rad" : "m";
    const double value = std::abs(each.value) < 5e-5 ? 0.0 : each.value;
    const ImVec4 color = each.at_limit() ? scene.ui.warning : ImGui::GetStyle().Colors[ImGuiCol_Text];
    ImGui::TextColored(color, "%.4f %s", value, unit);
    note(scene.ui, std::string("object/span/") + each.name);
    ImGui::SameLine();
    if (each.free()) {
      ImGui::TextColored(scene.ui.muted, "free");
    } else if (each.locked()) {
      ImGui::TextColored(scene.ui.muted, "locked");
    } else {
      ImGui::TextColored(scene.ui.muted, "%.4g to %.4g", each.low, each.high);
    }
  }
  return !coordinates.empty();
}

void draw_state(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  const state::JointInfo& info = scene.model.structure().joints[object.slot];
  const state::JointState& joint = scene.model.frame().joints[object.slot];
  const state::Structure& all = scene.model.structure();
  if (!section(ui, "State", true) || !begin_rows("state")) return;
  const auto body = [&](const char* label, const char* name, std::uint32_t slot) {
    row(ui, label);
    const state::ObjectInfo& it = all.objects[all.bodies[slot].object];
    if (button(ui, name, it.local_name.c_str())) scene.model.selection.select(it.id);
  };
  body("Parent", "object/joint_parent", info.parent_body);
  body("Child", "object/joint_child", info.child_body);
  const bool slides = info.type == state::JointType::prismatic || info.type == state::JointType::linear_spring;
  if (draw_span_rows(scene, info)) {
    end_rows();
    return;
  }
  text_row(ui, "Position", "%.4f %s", joint.position, slides ? "m" : "rad");
  plot_sign_of_row(scene, object.name, {"position"});
  text_row(ui, "Velocity", "%.4f %s", joint.velocity, slides ? "m/s" : "rad/s");
  plot_sign_of_row(scene, object.name, {"velocity"});
  text_row(ui, "Effort", "%.4f %s", joint.effort, slides ? "N" : "Nm");
  plot_sign_of_row(scene, object.name, {"effort"});
  if (info.has_limits) text_row(ui, "Limits", "%.4g to %.4g %s", info.lower, info.upper, slides ? "m" : "rad");
  if (info.passive) text_row(ui, "Status", "passive: nobody commands it");
  end_rows();
}

const char* unit_of(const state::Structure& structure, std::uint32_t slot, state::Parameter parameter) {
  using state::Parameter;
  const state::JointInfo& joint = structure.joints[slot];
  const bool force = joint.output == state::ControllerOutput::force;
  const bool slides = joint.type == state::JointType::prismatic || joint.type == state::JointType::linear_spring;
  switch (parameter) {
    case Parameter::joint_p: return !force ? "1/s" : slides ? "N/m" : "Nm/rad";
    case Parameter::joint_i: return !force ? "1/s\u00b2" : slides ? "N/(m s)" : "Nm/(rad s)";
    case Parameter::joint_d: return !force ? "" : slides ? "Ns/m" : "Nms/rad";
    default: return slides ? "Ns/m" : "Nms/rad";
  }
}

// All but gains of a joint that no controller moves.
bool in_use(const state::Structure& structure, std::uint32_t slot, state::Parameter parameter) {
  if (parameter == state::Parameter::joint_damping) return true;
  switch (structure.joints[slot].type) {
    case state::JointType::revolute:
    case state::JointType::prismatic:
    case state::JointType::linear_spring:
    case state::JointType::torsion_spring: return true;
    default: return false;
  }
}

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  draw_state(scene, object);
  draw_parameters(scene, object, {true, unit_of, in_use});
}

math::Vec3 pivot(const ScenePoses& poses, const state::Structure& structure, std::uint32_t slot) {
  const state::JointInfo& joint = structure.joints[slot];
  return poses.bodies[joint.parent_body] * joint.pivot_parent;
}

}  // namespace

PanelKind joint_panel_kind() {
  PanelKind kind;
  kind.color = 1;
  kind.draw_sign = draw_sign;
  kind.draw_details = draw_details;
  kind.centre = pivot;
  return kind;
}

}  // namespace ambf::render
