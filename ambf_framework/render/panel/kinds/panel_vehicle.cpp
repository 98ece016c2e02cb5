// Vehicles in the panel: pose, speed, and each wheel: steering, turning, suspension, load.
#include "math/types.h"
#include "render/panel/kinds/panel_kinds.h"
#include "state/vehicles.h"

namespace ambf::render {

namespace {

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  draw_pose_section(scene, object);
  if (!section(scene.ui, "Vehicle", true) || !begin_rows("vehicle")) return;
  const state::Frame& frame = scene.model.frame();
  const state::VehicleState& vehicle = state::rows(frame, state::vehicle_kind().column)[object.slot];
  text_row(scene.ui, "Speed", "%.3f m/s", vehicle.speed);
  note(scene.ui, "object/speed");
  text_row(scene.ui, "Handbrake", "%s", vehicle.handbrake ? "on" : "off");
  const state::WheelRange wheels = state::wheels_of(frame, object.slot);
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const state::WheelState& wheel = wheels[i];
    const std::string label = "Wheel " + std::to_string(i);
    if (!wheel.present) {
      text_row(scene.ui, label.c_str(), "waits for its body");
      continue;
    }
    text_row(scene.ui, label.c_str(), "%+.3f rad  %.2f rad/s  %.3f m  %.1f N", wheel.steering, wheel.rate,
             wheel.suspension_m, math::norm(wheel.force_world));
  }
  end_rows();
}

}  // namespace

PanelKind vehicle_panel_kind() {
  PanelKind kind;
  kind.color = 4;
  kind.draw_details = draw_details;
  return kind;
}

}  // namespace ambf::render
