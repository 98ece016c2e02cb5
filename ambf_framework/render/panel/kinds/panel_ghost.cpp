// Ghost objects in the panel: pose, and what they feel.
#include "render/panel/kinds/panel_kinds.h"
#include "state/ghosts.h"

namespace ambf::render {

namespace {

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  draw_pose_section(scene, object);
  if (!section(scene.ui, "Ghost object", true) || !begin_rows("ghost")) return;
  const state::Frame& frame = scene.model.frame();
  const state::TouchRange touches = state::touches_of(frame, object.slot);
  text_row(scene.ui, "Feels", "%zu", touches.size());
  note(scene.ui, "object/feels");
  for (const state::GhostTouch& touch : touches)
    text_row(scene.ui, "", "%s", frame.structure->objects[touch.object].name.c_str());
  const double drag = state::ghosts(*frame.structure)[object.slot].drag;
  if (drag > 0.0) text_row(scene.ui, "Drag", "%.3g a millisecond", drag);
  end_rows();
}

}  // namespace

PanelKind ghost_panel_kind() {
  PanelKind kind;
  kind.color = 2;
  kind.draw_details = draw_details;
  return kind;
}

}  // namespace ambf::render
