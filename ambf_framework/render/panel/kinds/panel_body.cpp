// Rigid bodies in the panel: state, pushes, look and parameters.
#include <numbers>

#include "math/rotation.h"
#include "render/panel/kinds/panel_kinds.h"
#include "render/panel/relations.h"
#include "state/command.h"

namespace ambf::render {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

void draw_sign(const KindSign& sign) {
  const float r = sign.radius;
  const ImVec2 c = sign.centre;
  sign.list.AddRectFilled({c.x - r, c.y - r}, {c.x + r, c.y + r}, sign.color, 0.3F * r);
}

void draw_push(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  state::Push& push = scene.push;
  constexpr double kMax = 1e6;
  if (!section(ui, "Push", false) || !begin_rows("push")) return;
  row(ui, "Force N");
  vector_field(ui, "push/force", &push.force_world, -kMax, kMax, "%.3g");
  row(ui, "Torque Nm");
  vector_field(ui, "push/torque", &push.torque_world, -kMax, kMax, "%.3g");
  row(ui, "At point m");
  vector_field(ui, "push/point", &push.point_body, -kMax, kMax, "%.3g");
  tool_tip("where the force acts, in the body's own frame");
  row(ui, "For");
  if (push.seconds <= 0.0) push.seconds = 0.1;
  number_field(ui, "push/seconds", &push.seconds, 1e-4, 1e4, "%.3g s", 80.0F);
  ImGui::SameLine();
  if (button(ui, "push/go", "Push")) scene.model.run.push(object.id, push);
  tool_tip("force and torque in world axes, for so long in simulated time");
  end_rows();
}

const char* unit_of(const state::Structure& structure, std::uint32_t slot, state::Parameter parameter) {
  using state::ControllerOutput;
  using state::Parameter;
  const state::BodyInfo& body = structure.bodies[slot];
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

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  PanelModel& model = scene.model;
  const state::BodyState& body = model.frame().bodies[object.slot];
  const state::BodyInfo& info = model.structure().bodies[object.slot];
  if (section(ui, "State", true) && begin_rows("state")) {
    vector_row(ui, "Position", body.T_world_body.position, "%.4f", "m");
    plot_sign_of_row(scene, object.name, {"position x", "position y", "position z"});
    vector_row(ui, "Roll pitch yaw", math::to_rpy(body.T_world_body.orientation) * kDegrees, "%.2f", "\u00b0");
    plot_sign_of_row(scene, object.name, {"roll", "pitch", "yaw"});
    vector_row(ui, "Velocity", body.twist_world.linear, "%.4f", "m/s");
    plot_sign_of_row(scene, object.name, {"velocity x", "velocity y", "velocity z"});
    vector_row(ui, "Turn rate", body.twist_world.angular, "%.3f", "rad/s");
    plot_sign_of_row(scene, object.name, {"angular velocity x", "angular velocity y", "angular velocity z"});
    vector_row(ui, "Force", body.wrench_body.force, "%.3f", "N");
    plot_sign_of_row(scene, object.name, {"force x", "force y", "force z"});
    vector_row(ui, "Torque", body.wrench_body.torque, "%.3f", "Nm");
    plot_sign_of_row(scene, object.name, {"torque x", "torque y", "torque z"});
    if (info.mass > 0.0) {
      text_row(ui, "Mass", "%.4g kg", info.mass);
      vector_row(ui, "Inertia", info.inertia, "%.3g", "kg m\u00b2");
    } else {
      text_row(ui, "Mass", "static");
    }
    text_row(ui, "Status", "%s%s", body.active ? "commanded" : "not commanded",
             body.frozen   ? ", frozen: it diverged"
             : body.asleep ? ", asleep"
                           : "");
    for (const state::LawShare& share : model.frame().law_shares) {
      if (share.body != object.slot) continue;
      text_row(ui, "Held by", "%s: %.3g N, %.3g Nm", state::name_of(share.source), math::norm(share.wrench_world.force),
               math::norm(share.wrench_world.torque));
      note(ui, std::string("object/held by ") + state::name_of(share.source));
    }
    const double pulled = pulled_by(model.frame(), object.id);
    if (pulled > 0.0) {
      row(ui, "Pulled by");
      ImGui::TextColored(ui.accent, "%.2f N", pulled);
      note(ui, "object/pull");
    }
    end_rows();
  }
  draw_push(scene, object);
  draw_look(scene, object);
  draw_parameters(scene, object, {false, unit_of});
}

math::Vec3 centre_of_mass(const ScenePoses& poses, const state::Structure& structure, std::uint32_t slot) {
  return poses.bodies[slot] * structure.bodies[slot].T_body_com.position;
}

std::string pose_as_adf(const state::Frame& frame, std::uint32_t slot) {
  const math::Pose& T = frame.bodies[slot].T_world_body;
  return "location: {position: " + adf_vector(T.position) +
         ", orientation: " + adf_vector(math::to_rpy(T.orientation), "r", "p", "y") + "}\n";
}

}  // namespace

PanelKind body_panel_kind() {
  PanelKind kind;
  kind.color = 0;
  kind.draw_sign = draw_sign;
  kind.draw_details = draw_details;
  kind.centre = centre_of_mass;
  kind.pose_as_adf = pose_as_adf;
  return kind;
}

}  // namespace ambf::render
