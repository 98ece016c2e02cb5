// Lights in the panel: pose and beam.
#include "math/rotation.h"
#include "render/panel/kinds/panel_kinds.h"

namespace ambf::render {

namespace {

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  draw_pose_section(scene, object);
  draw_beam(scene, object);
}

std::string pose_as_adf(const state::Frame& frame, std::uint32_t slot) {
  const math::Pose& T = frame.lights[slot].T_parent_light;
  return "location: " + adf_vector(T.position) + "\ndirection: " + adf_vector(math::rotate(T.orientation, {1, 0, 0})) +
         "\n";
}

}  // namespace

PanelKind light_panel_kind() {
  PanelKind kind;
  kind.color = 4;
  kind.draw_details = draw_details;
  kind.pose_as_adf = pose_as_adf;
  return kind;
}

}  // namespace ambf::render
