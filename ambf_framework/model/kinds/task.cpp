// Tasks: which pieces belong where, and who may hold them. What is judged, and how, is in model/kinds/task/judge.cpp;
// here are names, structures, frames and saved states. A piece, place or holder that is removed later leaves its goals
// unmet.
#include <algorithm>
#include <any>
#include <variant>

#include "model/kinds/placed.h"
#include "model/kinds/registry.h"
#include "model/kinds/task/detail/live_task.h"
#include "model/kinds/task/detail/task_names.h"
#include "scene/task.h"

namespace ambf::model {
namespace {

constexpr double kMaxSaved = 1e12;
constexpr std::uint64_t kMaxSteps = std::uint64_t{1} << 53;

// What a row of the catalogue holds: slots of the info are found by these ids.
struct TaskRow {
  state::TaskInfo info;
  std::vector<state::ObjectId> holders, pieces, avoided;
  std::vector<state::ObjectId> places, sensors;  // by goal; not valid: none
};

struct SavedTask final : SavedPlaced {
  std::vector<WatchedPiece> pieces;
  std::vector<WatchedGoal> goals;
  std::uint64_t drops = 0, touches = 0, hand_overs = 0, wrong_order = 0, steps = 0;
  bool success = false, completed = false;
  double success_since_s = 0.0;
};

class TaskKind final : public PlacedKind {
 public:
  TaskKind() : PlacedKind(state::task_kind().kind) {}

  void load(Catalogue::Impl& all, const LoadedModel& model, const LoadOptions& options,
            Findings& findings) const override {
    each_block(model.description,
               [&](const scene::KindBlock& block) { load_task(all, block, model, options, findings); });
  }
  void erase_block(scene::Model& model, const std::string& identifier) const override {
    std::erase_if(model.blocks, [&](const scene::KindBlock& block) {
      return block.kind == &scene::kind::kTask && block.identity.identifier == identifier;
    });
  }
  void each_parent(const scene::Model& model, const ParentVisit& visit) const override {
    each_block(model, [&](const scene::KindBlock& block) { visit(block.identity, block.as<scene::Task>().parent); });
  }

  void add_row(const Entry& entry, const StructureDraft& draft, state::Structure& structure) const override {
    const auto& row = entry.row_as<TaskRow>();
    state::TaskInfo info = row.info;
    set_placed(info, entry, draft);
    const auto slot_of = [&](state::ObjectId id) {
      const std::uint32_t object = state::find(structure, id);
      return object == state::kNone ? state::kNone : structure.objects[object].slot;
    };
    for (std::size_t i = 0; i < info.holders.size(); ++i) info.holders[i].body = slot_of(row.holders[i]);
    for (std::size_t i = 0; i < info.pieces.size(); ++i) info.pieces[i].body = slot_of(row.pieces[i]);
    for (const state::ObjectId& id : row.avoided) info.avoided.push_back(slot_of(id));
    for (std::size_t i = 0; i < info.goals.size(); ++i) {
      if (!info.goals[i].at_task) info.goals[i].place_object = state::find(structure, row.places[i]);
      if (info.goals[i].needs_sensor) info.goals[i].sensor = slot_of(row.sensors[i]);
    }
    info.first_goal = static_cast<std::uint32_t>(state::count_goals(structure));
    info.first_piece = static_cast<std::uint32_t>(state::count_pieces(structure));
    state::table<state::TaskInfo>(structure, number()).push_back(std::move(info));
  }

  void link(LiveWorld::Impl& live, std::uint32_t slot, bool) const override {
    find_bodies(live, slot);
    measure(live, slot);
  }

  bool accepts(const state::Command& command) const override {
    const auto* own = std::get_if<state::KindCommand>(&command);
    return own != nullptr && std::any_cast<state::TaskCommand>(&own->value) != nullptr;
  }
  bool merge(LiveWorld::Impl&, std::uint32_t, const CommandSlots&) const override { return false; }
  void transfer(StateArchive& archive, state::Command& command) const override {
    if (archive.reads()) command = state::KindCommand{state::TaskCommand{}};
  }

  void add_actors(LiveWorld::Impl& live) const override {
    live.actors.add(StepPhase::readings, "tasks", [&live](double) { judge_tasks(live); });
  }

  void fill(const LiveWorld::Impl& live, state::Frame& frame) const override {
    const auto& infos = state::tasks(*live.structure);
    auto& rows = state::rows(frame, state::task_kind().column);
    auto& goals = state::task_goals(frame);
    auto& pieces = state::task_pieces(frame);
    goals.resize(state::count_goals(*live.structure));
    pieces.resize(state::count_pieces(*live.structure));
    const double h_s = live.physics->options().step;
    for (std::uint32_t slot = 0; slot < rows.size(); ++slot) {
      const LiveTask& task = task_at(live, slot);
      state::TaskState& row = rows[slot];
      row = {};
      row.T_parent_object = task.T_parent;
      row.T_world_object = pose(live, slot);
      row.active = task.active;
      row.drops = task.drops, row.touches = task.touches;
      row.hand_overs = task.hand_overs, row.wrong_order = task.wrong_order;
      row.success = task.success;
      row.success_since_s = task.success_since_s;
      row.time_s = static_cast<double>(task.steps) * h_s;
      for (std::size_t i = 0; i < task.goals.size(); ++i) {
        const WatchedGoal& goal = task.goals[i];
        row.goals_done += goal.done ? 1 : 0;
        goals[infos[slot].first_goal + i] = {goal.held_steps > 0, goal.done, static_cast<double>(goal.held_steps) * h_s,
                                             goal.distance_m, goal.angle_rad};
      }
      for (std::size_t i = 0; i < task.pieces.size(); ++i) {
        const WatchedPiece& piece = task.pieces[i];
        pieces[infos[slot].first_piece + i] = {piece.held_by, piece.touched_by, piece.drops, piece.hand_overs};
      }
    }
  }

  void reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    PlacedKind::reset(live, slot);
    bodies_reset(live, slot);
  }
  // A new attempt.
  void bodies_reset(LiveWorld::Impl& live, std::uint32_t slot) const override {
    task_at(live, slot).forget();
    measure(live, slot);
  }

  std::unique_ptr<SavedObject> make_saved() const override { return std::make_unique<SavedTask>(); }
  void save(const LiveWorld::Impl& live, std::uint32_t slot, SavedObject& saved) const override {
    PlacedKind::save(live, slot, saved);
    const LiveTask& task = task_at(live, slot);
    auto& to = static_cast<SavedTask&>(saved);
    to.pieces = task.pieces;
    to.goals = task.goals;
    to.drops = task.drops, to.touches = task.touches;
    to.hand_overs = task.hand_overs, to.wrong_order = task.wrong_order;
    to.steps = task.steps;
    to.success = task.success, to.completed = task.completed;
    to.success_since_s = task.success_since_s;
  }
  using PlacedKind::transfer;
  void transfer(StateArchive& archive, SavedObject& saved, const SavedContext& context) const override {
    PlacedKind::transfer(archive, saved, context);
    auto& task = static_cast<SavedTask&>(saved);
    const state::TaskInfo& info = state::tasks(context.structure)[context.slot];
    archive.size(task.pieces, info.pieces.size(), 1, "the number of a task's pieces");
    archive.size(task.goals, info.goals.size(), 1, "the number of a task's goals");
    archive.require(task.pieces.size() == info.pieces.size() && task.goals.size() == info.goals.size(),
                    "a task has other pieces or goals");
    for (WatchedPiece& piece : task.pieces) transfer_piece(archive, info, piece);
    for (WatchedGoal& goal : task.goals) {
      archive.count(goal.held_steps, 0, kMaxSteps, "how long a goal has been met");
      archive.flag(goal.done, "whether a goal is done");
      archive.flag(goal.armed, "whether a goal was unmet in its turn");
      archive.flag(goal.strayed, "whether a goal was met out of turn");
      archive.flag(goal.unmet_before, "whether a goal was unmet before");
    }
    for (std::uint64_t* count : {&task.drops, &task.touches, &task.hand_overs, &task.wrong_order})
      archive.count(*count, 0, UINT32_MAX, "what a task counted");
    archive.count(task.steps, 0, kMaxSteps, "how long a task has taken");
    archive.flag(task.success, "whether a task is done");
    archive.flag(task.completed, "whether a task was ever done");
    archive.number(task.success_since_s, 0.0, kMaxSaved, "since when a task is done");
  }
  void restore(LiveWorld::Impl& live, std::uint32_t slot, const SavedObject& saved) const override {
    PlacedKind::restore(live, slot, saved);
    const auto& from = static_cast<const SavedTask&>(saved);
    LiveTask& task = task_at(live, slot);
    task.pieces = from.pieces;
    task.goals = from.goals;
    task.drops = static_cast<std::uint32_t>(from.drops);
    task.touches = static_cast<std::uint32_t>(from.touches);
    task.hand_overs = static_cast<std::uint32_t>(from.hand_overs);
    task.wrong_order = static_cast<std::uint32_t>(from.wrong_order);
    task.steps = from.steps;
    task.success = from.success, task.completed = from.completed;
    task.success_since_s = from.success_since_s;
    measure(live, slot);
  }

 private:
  template <class Visit>
  static void each_block(const scene::Model& model, Visit visit) {
    for (const scene::KindBlock& block : model.blocks)
      if (block.kind == &scene::kind::kTask) visit(block);
  }

  static void transfer_steps(StateArchive& archive, std::uint32_t& steps, std::uint32_t max, const char* what) {
    std::uint64_t count = steps;
    archive.count(count, 0, max, what);
    steps = static_cast<std::uint32_t>(count);
  }
  static void transfer_piece(StateArchive& archive, const state::TaskInfo& info, WatchedPiece& piece) {
    const auto holders = static_cast<std::uint32_t>(info.holders.size());
    const std::uint32_t mask = holders == 32 ? UINT32_MAX : (1U << holders) - 1U;
    piece.gripped.resize(holders), piece.touched.resize(holders);
    for (Since& since : piece.gripped) transfer_steps(archive, since.steps, Since::kLong, "when a piece was gripped");
    for (Since& since : piece.touched) transfer_steps(archive, since.steps, Since::kLong, "when a piece was touched");
    transfer_steps(archive, piece.avoided.steps, Since::kLong, "when a piece touched what it must not");
    transfer_steps(archive, piece.held_by, mask, "who holds a piece");
    transfer_steps(archive, piece.touched_by, mask, "who touches a piece");
    std::uint32_t alone = piece.alone == state::kNone ? holders : piece.alone;  // the number of holders: none
    transfer_steps(archive, alone, holders, "who held a piece alone");
    piece.alone = alone == holders ? state::kNone : alone;
    archive.flag(piece.passed_in_air, "whether a piece is handed over");
    transfer_steps(archive, piece.hand_overs, UINT32_MAX, "how often a piece was handed over");
    archive.flag(piece.let_go, "whether a piece was let go");
    archive.number(piece.height_m, -kMaxSaved, kMaxSaved, "where a piece was held");
    transfer_steps(archive, piece.drops, UINT32_MAX, "how often a piece was dropped");
  }

  void load_task(Catalogue::Impl& all, const scene::KindBlock& block, const LoadedModel& model,
                 const LoadOptions& options, Findings& findings) const {
    const auto& described = block.as<scene::Task>();
    TaskNames names(all, block.identity, model, options, findings);
    TaskRow row;
    row.info.order = described.order;
    row.info.drop_height_m = described.drop_height_m;
    if (!described.parent.empty()) names.placed(described.parent, described.parent_at, "parent");
    for (const std::string& name : described.holders) {
      if (const Entry* body = names.body(name, described.holders_at, "holders")) {
        if (contains(row.holders, body))
          names.error(described.holders_at, "holders", "\"" + name + "\" is there twice");
        row.info.holders.push_back({body->info.local_name, state::kNone});
        row.holders.push_back(body->info.id);
      }
    }
    for (const std::string& name : described.avoid)
      if (const Entry* body = names.body(name, described.avoid_at, "avoid")) row.avoided.push_back(body->info.id);
    for (const scene::TaskGoal& goal : described.goals) add_goal(goal, described, names, row);
    if (!names.good()) return;
    auto live = std::make_unique<LiveTask>();
    live->pieces.resize(row.pieces.size());
    for (WatchedPiece& piece : live->pieces)
      piece.gripped.resize(row.holders.size()), piece.touched.resize(row.holders.size());
    live->goals.resize(row.info.goals.size());
    Entry* entry =
        add(all, std::move(live), block.identity, described.parent, described.T_parent_task, model, options, findings);
    if (entry != nullptr) entry->row = std::move(row);
  }

  static bool contains(const std::vector<state::ObjectId>& ids, const Entry* entry) {
    return std::find(ids.begin(), ids.end(), entry->info.id) != ids.end();
  }

  static void add_goal(const scene::TaskGoal& goal, const scene::Task& task, TaskNames& names, TaskRow& row) {
    const std::string path = "goals[" + std::to_string(row.info.goals.size()) + "]/";
    state::TaskGoal info;
    info.name = goal.name;
    info.point = goal.point;
    info.at_task = goal.place.empty();
    info.T_place_goal = goal.T_place_goal;
    info.tolerance_m = goal.tolerance_m;
    info.angle_tolerance_rad = goal.angle_tolerance_rad;
    info.axis = goal.axis;
    info.either_way = goal.either_way;
    info.needs_sensor = !goal.sensor.empty();
    info.hold_s = goal.hold_s;
    info.released = goal.released;
    info.hand_over = goal.hand_over;
    info.puncture = goal.puncture;
    for (std::uint32_t i = 0; i < task.holders.size(); ++i)
      if (task.holders[i] == goal.held_by) info.held_by = i;
    const Entry* place = goal.place.empty() ? nullptr : names.placed(goal.place, goal.where, path + "place");
    const Entry* sensor = goal.sensor.empty() ? nullptr : names.sensor(goal.sensor, goal.where, path + "sensor");
    for (const std::string& name : goal.pieces) {
      const Entry* piece = names.body(name, goal.where, path + "piece");
      if (piece == nullptr) continue;
      if (contains(row.holders, piece))
        names.error(goal.where, path + "piece", "\"" + name + "\" is a holder: no body holds itself");
      const auto known = std::find(row.pieces.begin(), row.pieces.end(), piece->info.id);
      info.pieces.push_back(static_cast<std::uint32_t>(known - row.pieces.begin()));
      if (known != row.pieces.end()) continue;
      row.pieces.push_back(piece->info.id);
      row.info.pieces.push_back({piece->info.local_name, state::kNone});
    }
    row.places.push_back(place == nullptr ? state::ObjectId{} : place->info.id);
    row.sensors.push_back(sensor == nullptr ? state::ObjectId{} : sensor->info.id);
    row.info.goals.push_back(std::move(info));
  }
};

}  // namespace

LiveTask& task_at(const LiveWorld::Impl& live, std::uint32_t slot) {
  return static_cast<LiveTask&>(*live.tables.of(state::task_kind().kind)[slot]);
}

std::unique_ptr<Kind> make_task_kind() { return std::make_unique<TaskKind>(); }

}  // namespace ambf::model
