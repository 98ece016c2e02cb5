#include "adf/detail/task_parser.h"

#include <algorithm>

#include "adf/detail/bind.h"
#include "scene/task.h"

namespace ambf::adf {

namespace {

scene::Location at(Mark mark) { return {mark.line, mark.column}; }

// "BODY ring2" and "/ambf/env/BODY ring2" are ring2.
std::string short_name(const std::string& written) {
  const std::string name = written.substr(written.find_last_of('/') + 1);
  return name.starts_with("BODY ") ? name.substr(5) : name;
}

// False, and an error, when a name is in the list twice or there are more than `most`.
bool check_list(const Fields& fields, const char* key, const std::vector<std::string>& names, std::size_t most,
                Report& report) {
  if (names.size() > most) {
    report.error(fields.mark(key), key,
                 "expected at most " + std::to_string(most) + ", found " + std::to_string(names.size()),
                 "the task is left out");
    return false;
  }
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(names.begin(), name, *name) == name) continue;
    report.error(fields.mark(key), key, in_quotes(*name) + " is listed twice", "the task is left out: name each once");
    return false;
  }
  return true;
}

struct GoalReader {
  const Fields& fields;
  const std::string path;  // of its keys, for reports
  const scene::Task& task;
  Report& report;

  bool error(const char* key, const std::string& message, const std::string& hint) const {
    report.error(fields.mark(key), path + key, message, "the task is left out: " + hint);
    return false;
  }

  // False, and an error, when the goal makes no sense.
  bool read(scene::TaskGoal& goal) const {
    goal.where = at(fields.mark());
    if (goal.piece.empty() == goal.pieces.empty())
      return error("piece", goal.piece.empty() ? "missing" : "given, and so are `pieces`", "give `piece` or `pieces`");
    if (!goal.piece.empty()) goal.pieces = {goal.piece};
    if (!check_list(fields, "pieces", goal.pieces, state::kMaxTaskGoals, report)) return false;
    if (fields.has("position tolerance")) goal.tolerance_m = fields.number_or_vector("position tolerance", {});
    if (!goal.tolerance_m && goal.sensor.empty())
      return error("position tolerance", "missing, and so is `sensor`", "say what counts as there");
    if (goal.puncture != state::HeldNode::Puncture::none) {
      for (const char* key : {"point", "angle tolerance", "axis", "either way", "sensor"})
        if (fields.has(key)) return error(key, "given, and so is `puncture`", "a puncture is a place in tissue alone");
    }
    if (fields.has("axis")) {
      goal.axis = parse_axis(fields, "axis", {}, report);
      if (!goal.axis) return false;
    }
    if ((goal.axis || goal.either_way) && !goal.angle_tolerance_rad)
      return error(goal.axis ? "axis" : "either way", "there is no `angle tolerance`",
                   "it says how far it may be turned");
    if (goal.either_way && !goal.axis)
      return error("either way", "there is no `axis`", "it is what may point both ways");
    return check_holders(goal) && check_name(goal);
  }

 private:
  bool check_holders(const scene::TaskGoal& goal) const {
    const auto is_holder = [&](const std::string& name) {
      return std::find(task.holders.begin(), task.holders.end(), name) != task.holders.end();
    };
    for (const std::string& piece : goal.pieces)
      if (is_holder(piece)) return error("piece", in_quotes(piece) + " is a holder", "no body holds itself");
    if (!goal.held_by.empty() && !is_holder(goal.held_by))
      return error("held by", in_quotes(goal.held_by) + " is no holder of this task", "list it under `holders`");
    if (goal.hand_over && task.holders.size() < 2)
      return error("hand over", "there are fewer than two `holders`", "name those that hand it over");
    return true;
  }
  // A goal without a name has its piece's, with a number if there are several.
  bool check_name(scene::TaskGoal& goal) const {
    const auto is_taken = [&](const std::string& name) {
      return std::any_of(task.goals.begin(), task.goals.end(), [&](const auto& other) { return other.name == name; });
    };
    if (!goal.name.empty()) {
      if (!is_taken(goal.name)) return true;
      return error("name", "another goal is called " + in_quotes(goal.name) + ", too", "give each its own");
    }
    goal.name = short_name(goal.pieces.front());
    for (int number = 2; is_taken(goal.name); ++number)
      goal.name = short_name(goal.pieces.front()) + " " + std::to_string(number);
    return true;
  }
};

}  // namespace

std::optional<scene::KindBlock> parse_task(const Block& block, const FileContext& file, NameBook& names) {
  const Fields& fields = block.fields;
  Report& report = file.report;
  auto task = std::make_shared<scene::Task>(
      read<scene::Task>(fields.value(), *scene::kind::kTask.group, file.options.defaults));
  task->parent_at = at(fields.mark("parent"));
  task->holders_at = at(fields.mark("holders"));
  task->avoid_at = at(fields.mark("avoid"));
  bool good = check_list(fields, "holders", task->holders, state::kMaxTaskHolders, report) &&
              check_list(fields, "avoid", task->avoid, state::kMaxTaskGoals, report);
  const std::vector<Fields> goals = fields.maps("goals");
  if (goals.empty() || goals.size() > state::kMaxTaskGoals) {
    report.error(fields.mark("goals"), "goals", "expected 1 to 64, found " + std::to_string(goals.size()),
                 "the task is left out");
    return std::nullopt;
  }
  for (const Fields& each : goals) {
    auto goal = read<scene::TaskGoal>(each.value(), scene::group::kTaskGoal, file.options.defaults);
    good &= GoalReader{each, "goals[" + std::to_string(task->goals.size()) + "]/", *task, report}.read(goal);
    task->goals.push_back(std::move(goal));
  }
  if (!good) return std::nullopt;
  return scene::KindBlock{&scene::kind::kTask, parse_identity(block, file, names), std::move(task)};
}

}  // namespace ambf::adf
