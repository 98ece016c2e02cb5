// Actuators in the panel: pose, what they hold, and with what force.
#include <map>

#include "math/rotation.h"
#include "render/panel/kinds/panel_kinds.h"
#include "state/actuators.h"
#include "state/soft_bodies.h"

namespace ambf::render {

namespace {

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  draw_pose_section(scene, object);
  const state::Frame& frame = scene.model.frame();
  const state::Structure& structure = *frame.structure;
  const state::ActuatorInfo& actuator = state::actuators(structure)[object.slot];
  const state::ActuatorState& state = state::rows(frame, state::actuator_kind().column)[object.slot];
  if (!section(scene.ui, "Actuator", true) || !begin_rows("actuator")) return;
  text_row(scene.ui, "Type", "%s", state::name_of(actuator.type));
  if (actuator.sensor_object != state::kNone)
    text_row(scene.ui, "Sensor", "%s", structure.objects[actuator.sensor_object].local_name.c_str());
  if (!state.actuated()) text_row(scene.ui, "Holds", "-");
  for (std::uint32_t i = 0; i < state.held_count; ++i)
    text_row(scene.ui, "Holds", "%s", structure.objects[structure.bodies[state.held[i]].object].local_name.c_str());
  std::map<std::uint32_t, int> nodes;  // by soft body
  for (const state::HeldNode& held : state::held_nodes(frame))
    if (held.actuator == object.slot) ++nodes[held.soft_body];
  for (const auto& [slot, count] : nodes)
    text_row(scene.ui, "Holds", "%s, %d nodes",
             structure.objects[state::soft_bodies(structure)[slot].object].local_name.c_str(), count);
  vector_row(scene.ui, "Force on it", state.force_world, "%.3f", "N");
  end_rows();
}

std::string pose_as_adf(const state::Frame& frame, std::uint32_t slot) {
  const math::Pose& T = state::rows(frame, state::actuator_kind().column)[slot].T_parent_object;
  return "location: {position: " + adf_vector(T.position) +
         ", orientation: " + adf_vector(math::to_rpy(T.orientation), "r", "p", "y") + "}\n";
}

}  // namespace

PanelKind actuator_panel_kind() {
  PanelKind kind;
  kind.color = 1;
  kind.draw_details = draw_details;
  kind.pose_as_adf = pose_as_adf;
  return kind;
}

}  // namespace ambf::render
