// Moving the selected object by hand in the scene, and its pose as a file says it.
#include <cstdio>
#include <numbers>

#include "math/rotation.h"
#include "render/panel/sections/sections.h"
#include "render/panel/view_actions.h"

namespace ambf::render {

namespace {

std::string vector_text(const math::Vec3& v, const char* x, const char* y, const char* z) {
  char text[160];
  const auto clean = [](double value) { return std::abs(value) < 5e-10 ? 0.0 : value; };
  std::snprintf(text, sizeof text, "{%s: %.6g, %s: %.6g, %s: %.6g}", x, clean(v.x), y, clean(v.y), z, clean(v.z));
  return text;
}

}  // namespace

std::string pose_as_adf(const state::Frame& frame, const state::ObjectInfo& object) {
  if (object.kind == state::ObjectKind::rigid_body) {
    const math::Pose& T = frame.bodies[object.slot].T_world_body;
    return "location: {position: " + vector_text(T.position, "x", "y", "z") +
           ", orientation: " + vector_text(math::to_rpy(T.orientation), "r", "p", "y") + "}\n";
  }
  if (object.kind == state::ObjectKind::light) {
    const math::Pose& T = frame.lights[object.slot].T_parent_light;
    return "location: " + vector_text(T.position, "x", "y", "z") +
           "\ndirection: " + vector_text(math::rotate(T.orientation, {1, 0, 0}), "x", "y", "z") + "\n";
  }
  if (object.kind == state::ObjectKind::camera) {
    const math::Pose& T = frame.cameras[object.slot].T_parent_camera;
    return "location: " + vector_text(T.position, "x", "y", "z") +
           "\nlook at: " + vector_text(T.position - backward(T), "x", "y", "z") +
           "\nup: " + vector_text(up(T), "x", "y", "z") + "\n";
  }
  return {};
}

void draw_move(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  Gizmo& gizmo = scene.model.gizmo;
  check_box(ui, "gizmo/shown", "Move in the scene", &gizmo.shown);
  tool_tip("Arrows shift it along the axes of the world, rings turn it about them");
  ImGui::SameLine();
  if (button(ui, "gizmo/copy", "Copy pose") && scene.host.set_clipboard) {
    scene.host.set_clipboard(pose_as_adf(scene.model.frame(), object));
    scene.model.say("its pose is in the clipboard, for an ADF file");
  }
  tool_tip("where it is now, as the keys of its block in an ADF file");
  if (!gizmo.shown) return;
  check_box(ui, "gizmo/snaps", "in steps of", &gizmo.snaps);
  ImGui::BeginDisabled(!gizmo.snaps);
  double millimetres = gizmo.snap_m * 1e3, degrees = gizmo.snap_rad * 180.0 / std::numbers::pi;
  ImGui::SameLine();
  if (number_field(ui, "gizmo/snap_mm", &millimetres, 0.01, 1e4, "%.4g mm", 76.0F)) gizmo.snap_m = millimetres / 1e3;
  ImGui::SameLine();
  if (number_field(ui, "gizmo/snap_degrees", &degrees, 0.01, 180.0, "%.4g\u00b0", 64.0F)) {
    gizmo.snap_rad = degrees * std::numbers::pi / 180.0;
  }
  ImGui::EndDisabled();
  if (object.id == scene.moment.camera_object) {
    muted_text(ui, "This window looks through it: its mouse moves it.");
  } else if (!GizmoHand::can_turn(scene.model.frame(), object.id)) {
    muted_text(ui, "While paused it can be shifted, not turned.");
  }
}

}  // namespace ambf::render
