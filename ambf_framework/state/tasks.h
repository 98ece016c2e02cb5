// Tasks as all threads see them: their rows of a structure and of a frame. A task has goals, each a piece at a place;
// pieces, each of which holders may hold. What each goal and piece is in is a row of a column of its own, in the order
// of the tasks. Judged in every step (model/kinds/task.cpp). Plain data, read by any thread. C++17.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "state/actuators.h"
#include "state/kind_rows.h"

namespace ambf::state {

inline constexpr std::size_t kMaxTaskGoals = 64, kMaxTaskHolders = 32;  // of one task; holders are bits of a mask

// A hold or a touch ends when there was no contact for so long, s: contacts flicker.
inline constexpr double kLetGo_s = 0.02;

// any: goals count while they are met, and all must be at the same time. listed: one after the other; what is done
// stays done.
enum class TaskOrder : std::uint8_t { any, listed };

// A body and what joints carry below it: an instrument, a gripper, a hand.
struct TaskHolder {
  std::string name;            // of the body, without its namespace
  std::uint32_t body = kNone;  // slot; kNone: it is gone
};

struct TaskPiece {
  std::string name;            // of the body, without its namespace
  std::uint32_t body = kNone;  // slot; kNone: it is gone
};

struct TaskGoal {
  std::string name;
  std::vector<std::uint32_t> pieces;   // indices into TaskInfo::pieces: any of them
  math::Vec3 point;                    // of the piece, in its body frame, m
  bool at_task = true;                 // the place is in the task's own frame
  std::uint32_t place_object = kNone;  // else in that of this object; kNone: it is gone, and cannot be met
  math::Pose T_place_goal;
  std::optional<math::Vec3> tolerance_m;  // along each axis of the place, both ways; none: where it is does not count
  std::optional<double> angle_tolerance_rad;  // none: how it is turned does not count
  std::optional<math::Vec3> axis;             // unit: only this axis of piece and place must agree
  bool either_way = false;                    // the axis may point the other way
  bool needs_sensor = false;
  std::uint32_t sensor = kNone;  // slot of the sensor that must match or sense the piece
  double hold_s = 0.0;
  bool released = true;           // no holder touches it
  std::uint32_t held_by = kNone;  // index of the holder that must hold it; kNone: none must
  bool hand_over = false;         // it was handed over since it was last grasped
  // Instead of `point`: where the needle on the piece went into tissue, or came out of it. In the frame of a soft body
  // it counts where that is in the tissue as loaded.
  HeldNode::Puncture puncture = HeldNode::Puncture::none;
};

struct TaskInfo : PlacedInfo {
  TaskOrder order = TaskOrder::any;
  double drop_height_m = 0.01;
  std::vector<TaskHolder> holders;
  std::vector<TaskPiece> pieces;
  std::vector<TaskGoal> goals;
  std::vector<std::uint32_t> avoided;             // slots of bodies that pieces must not touch; kNone: gone
  std::uint32_t first_goal = 0, first_piece = 0;  // their rows of the columns
};

struct TaskState : PlacedState {
  std::uint32_t goals_done = 0;
  std::uint32_t drops = 0, touches = 0, hand_overs = 0, wrong_order = 0;  // since loading or the last reset
  bool success = false;
  double success_since_s = 0.0;  // simulated time; 0 without success
  double time_s = 0.0;           // from loading or the last reset to the first success; until then, to now
};

struct TaskGoalState {
  bool met = false;   // all that it asks for, but for how long
  bool done = false;  // for long enough
  double held_s = 0.0;
  double distance_m = 0.0, angle_rad = 0.0;  // between place and nearest piece; 0 where either is gone
};

struct TaskPieceState {
  std::uint32_t held_by = 0, touched_by = 0;  // masks of holders
  std::uint32_t drops = 0;
  std::uint32_t hand_overs = 0;  // since it was last grasped
};

template <class Visit>
void visit_computed(TaskState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object);
  visit(row.success_since_s), visit(row.time_s);
}
template <class Visit>
void visit_computed(TaskGoalState& row, Visit& visit) {
  visit(row.held_s), visit(row.distance_m), visit(row.angle_rad);
}

// A task obeys no command: one only raises its publishing rate, as for every object.
struct TaskCommand {};

const PlacedKind<TaskState>& task_kind();

const std::vector<TaskInfo>& tasks(const Structure& structure);

// The rows of a task, begin and end; empty where the frame has none (a diverged world, new structure).
template <class Row>
struct TaskRows {
  const Row* first = nullptr;
  const Row* last = nullptr;
  const Row* begin() const { return first; }
  const Row* end() const { return last; }
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
  const Row& operator[](std::size_t i) const { return first[i]; }
};
TaskRows<TaskGoalState> goals_of(const Frame& frame, std::uint32_t task_slot);
TaskRows<TaskPieceState> pieces_of(const Frame& frame, std::uint32_t task_slot);

// All rows, for the physics thread to fill.
std::vector<TaskGoalState>& task_goals(Frame& frame);
std::vector<TaskPieceState>& task_pieces(Frame& frame);

// How many of them a structure's tasks have.
std::size_t count_goals(const Structure& structure);
std::size_t count_pieces(const Structure& structure);

// "left, right": the holders of a mask; empty: none.
std::string names_of(const TaskInfo& task, std::uint32_t holders);
// "peg_transfer: 2 of 6, 0:41, 1 drop" or "peg_transfer: done in 1:12"
std::string summary(const Structure& structure, const TaskInfo& task, const TaskState& state);
// That of each task, in their order.
std::vector<std::string> task_lines(const Frame& frame);

}  // namespace ambf::state
