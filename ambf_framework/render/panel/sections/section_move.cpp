// Moving the selected object by hand in the scene, and its pose as text for an ADF file.
#include <numbers>

#include "render/panel/kinds/panel_kinds.h"
#include "render/panel/sections/sections.h"

namespace ambf::render {

std::string pose_as_adf(const state::Frame& frame, const state::ObjectInfo& object) {
  const PanelKind& kind = panel_kind(object.kind);
  return kind.pose_as_adf == nullptr ? std::string() : kind.pose_as_adf(frame, object.slot);
}

void draw_move(PanelScene& scene, const state::ObjectInfo& object) {
  Ui& ui = scene.ui;
  Gizmo& gizmo = scene.model.gizmo;
  check_box(ui, "gizmo/shown", "Move in the scene", &gizmo.shown);
  tool_tip("Arrows shift it along the axes of the world, rings turn it about them");
  ImGui::SameLine();
  const std::string text = pose_as_adf(scene.model.frame(), object);
  if (button(ui, "gizmo/copy", "Copy pose", !text.empty()) && scene.host.set_clipboard) {
    scene.host.set_clipboard(text);
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
