// Cameras in the panel: pose and lens.
#include "render/camera/camera.h"
#include "render/panel/kinds/panel_kinds.h"

namespace ambf::render {

namespace {

void draw_sign(const KindSign& sign) {
  const float r = sign.radius;
  const ImVec2 c = sign.centre;
  sign.list.AddRectFilled({c.x - 1.2F * r, c.y - 0.8F * r}, {c.x + 0.5F * r, c.y + 0.8F * r}, sign.color, 0.2F * r);
  sign.list.AddTriangleFilled({c.x + 0.4F * r, c.y}, {c.x + 1.4F * r, c.y - 0.8F * r}, {c.x + 1.4F * r, c.y + 0.8F * r},
                              sign.color);
}

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  draw_pose_section(scene, object);
  draw_lens(scene, object);
}

std::string pose_as_adf(const state::Frame& frame, std::uint32_t slot) {
  const math::Pose& T = frame.cameras[slot].T_parent_camera;
  return "location: " + adf_vector(T.position) + "\nlook at: " + adf_vector(T.position - backward(T)) +
         "\nup: " + adf_vector(up(T)) + "\n";
}

}  // namespace

PanelKind camera_panel_kind() {
  PanelKind kind;
  kind.color = 2;
  kind.draw_sign = draw_sign;
  kind.draw_details = draw_details;
  kind.pose_as_adf = pose_as_adf;
  return kind;
}

}  // namespace ambf::render
