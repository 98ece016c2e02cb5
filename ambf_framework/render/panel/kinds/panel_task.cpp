// Tasks in the panel: how far they are, each goal, and who holds which piece.
#include "math/rotation.h"
#include "render/panel/kinds/panel_kinds.h"
#include "state/tasks.h"

namespace ambf::render {

namespace {

void draw_goals(PanelScene& scene, const state::TaskInfo& task, std::uint32_t slot) {
  if (!section(scene.ui, "Goals", true) || !begin_rows("goals")) return;
  const state::TaskRows<state::TaskGoalState> goals = state::goals_of(scene.model.frame(), slot);
  for (std::size_t i = 0; i < goals.size(); ++i) {
    const char* how = goals[i].done ? "done" : goals[i].met ? "holds" : "";
    text_row(scene.ui, task.goals[i].name.c_str(), "%.1f mm  %s", 1e3 * goals[i].distance_m, how);
  }
  end_rows();
}

void draw_pieces(PanelScene& scene, const state::TaskInfo& task, std::uint32_t slot) {
  if (!section(scene.ui, "Pieces", true) || !begin_rows("pieces")) return;
  const state::TaskRows<state::TaskPieceState> pieces = state::pieces_of(scene.model.frame(), slot);
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const std::string holders = state::names_of(task, pieces[i].held_by);
    text_row(scene.ui, task.pieces[i].name.c_str(), "%s", holders.empty() ? "-" : holders.c_str());
  }
  end_rows();
}

void draw_details(PanelScene& scene, const state::ObjectInfo& object) {
  const state::Frame& frame = scene.model.frame();
  const state::TaskInfo& task = state::tasks(*frame.structure)[object.slot];
  const state::TaskState& now = state::rows(frame, state::task_kind().column)[object.slot];
  if (section(scene.ui, "Task", true) && begin_rows("task")) {
    text_row(scene.ui, "Done", "%u of %zu%s", now.goals_done, task.goals.size(), now.success ? ": success" : "");
    note(scene.ui, "object/task_done");
    text_row(scene.ui, "Time", "%.1f s", now.time_s);
    text_row(scene.ui, "Drops", "%u", now.drops);
    if (!task.avoided.empty()) text_row(scene.ui, "Touches", "%u", now.touches);
    if (task.holders.size() > 1) text_row(scene.ui, "Hand-overs", "%u", now.hand_overs);
    if (task.order == state::TaskOrder::listed) text_row(scene.ui, "Out of order", "%u", now.wrong_order);
    end_rows();
  }
  draw_goals(scene, task, object.slot);
  draw_pieces(scene, task, object.slot);
}

std::string pose_as_adf(const state::Frame& frame, std::uint32_t slot) {
  const math::Pose& T = state::rows(frame, state::task_kind().column)[slot].T_parent_object;
  return "location: {position: " + adf_vector(T.position) +
         ", orientation: " + adf_vector(math::to_rpy(T.orientation), "r", "p", "y") + "}\n";
}

}  // namespace

PanelKind task_panel_kind() {
  PanelKind kind;
  kind.color = 4;
  kind.draw_details = draw_details;
  kind.pose_as_adf = pose_as_adf;
  return kind;
}

}  // namespace ambf::render
