#include "state/tasks.h"

#include <cstdio>

#include "state/detail/built_in_kinds.h"

namespace ambf::state {
namespace {

PlacedKind<TaskState> registered_kind;
ColumnId<TaskGoalState> registered_goals;
ColumnId<TaskPieceState> registered_pieces;

ColumnTraits list(const char* name, std::size_t (*rows_of)(const Structure&)) {
  ColumnTraits traits;
  traits.name = name;
  traits.hashed = true;
  traits.while_diverged = WhileDiverged::last_good_structure;
  traits.rows_of = rows_of;
  return traits;
}

template <class Row>
TaskRows<Row> part(const std::vector<Row>& all, std::size_t first, std::size_t count) {
  if (first + count > all.size()) return {};
  return {all.data() + first, all.data() + first + count};
}

std::string counted(std::uint32_t count, const char* one, const char* several) {
  return count == 0 ? std::string() : ", " + std::to_string(count) + " " + (count == 1 ? one : several);
}

}  // namespace

void register_task_kind() {
  KindInfo info;
  info.name = "task";
  info.label = "task";
  info.plural = "tasks";
  registered_kind = register_placed_kind<TaskInfo, TaskState>(std::move(info));
  registered_goals = register_column<TaskGoalState>(list("task_goals", count_goals));
  registered_pieces = register_column<TaskPieceState>(list("task_pieces", count_pieces));
}

const PlacedKind<TaskState>& task_kind() {
  register_built_in_kinds();
  return registered_kind;
}

const std::vector<TaskInfo>& tasks(const Structure& structure) {
  static const std::vector<TaskInfo> none;
  const auto number = static_cast<std::size_t>(task_kind().kind);
  const bool has_table = number < structure.registered.size() && structure.registered[number].has_value();
  return has_table ? table<TaskInfo>(structure, task_kind().kind) : none;
}

std::size_t count_goals(const Structure& structure) {
  const std::vector<TaskInfo>& all = tasks(structure);
  return all.empty() ? 0 : all.back().first_goal + all.back().goals.size();
}
std::size_t count_pieces(const Structure& structure) {
  const std::vector<TaskInfo>& all = tasks(structure);
  return all.empty() ? 0 : all.back().first_piece + all.back().pieces.size();
}

TaskRows<TaskGoalState> goals_of(const Frame& frame, std::uint32_t task_slot) {
  const TaskInfo& task = tasks(*frame.structure)[task_slot];
  return part(rows(frame, registered_goals), task.first_goal, task.goals.size());
}
TaskRows<TaskPieceState> pieces_of(const Frame& frame, std::uint32_t task_slot) {
  const TaskInfo& task = tasks(*frame.structure)[task_slot];
  return part(rows(frame, registered_pieces), task.first_piece, task.pieces.size());
}

std::vector<TaskGoalState>& task_goals(Frame& frame) { return rows(frame, registered_goals); }
std::vector<TaskPieceState>& task_pieces(Frame& frame) { return rows(frame, registered_pieces); }

std::string names_of(const TaskInfo& task, std::uint32_t holders) {
  std::string names;
  for (std::size_t i = 0; i < task.holders.size(); ++i)
    if ((holders >> i & 1U) != 0) names += (names.empty() ? "" : ", ") + task.holders[i].name;
  return names;
}

std::string summary(const Structure& structure, const TaskInfo& task, const TaskState& state) {
  char time[32];
  const auto seconds = static_cast<unsigned>(state.time_s);
  std::snprintf(time, sizeof time, "%u:%02u", seconds / 60, seconds % 60);
  std::string text = structure.objects[task.object].local_name + ": ";
  text +=
      state.success ? "done in " : std::to_string(state.goals_done) + " of " + std::to_string(task.goals.size()) + ", ";
  text += time;
  text += counted(state.drops, "drop", "drops") + counted(state.touches, "touch", "touches");
  return text + counted(state.wrong_order, "in wrong order", "in wrong order");
}

std::vector<std::string> task_lines(const Frame& frame) {
  std::vector<std::string> lines;
  const std::vector<TaskInfo>& all = tasks(*frame.structure);
  const std::vector<TaskState>& states = rows(frame, registered_kind.column);
  for (std::size_t slot = 0; slot < all.size() && slot < states.size(); ++slot)
    lines.push_back(summary(*frame.structure, all[slot], states[slot]));
  return lines;
}

}  // namespace ambf::state
