// Tasks on ROS: how far they are, and who holds their pieces.
#include <ambf_msgs/TaskCmd.h>
#include <ambf_msgs/TaskState.h>

#include "ros_comm/endpoints/object_endpoint.h"
#include "ros_comm/endpoints/placed_messages.h"
#include "state/tasks.h"

namespace ambf::ros_comm {

namespace {

struct Messages {
  using State = ambf_msgs::TaskState;
  using Command = ambf_msgs::TaskCmd;

  static void fill_names(const state::Structure& structure, std::uint32_t slot, State& message) {
    const state::TaskInfo& task = state::tasks(structure)[slot];
    fill_placed_names(structure, task, message);
    message.goals.clear();
    for (const state::TaskGoal& goal : task.goals) message.goals.push_back(goal.name);
    message.pieces.clear();
    for (const state::TaskPiece& piece : task.pieces) {
      const bool is_there = piece.body != state::kNone;
      message.pieces.push_back(is_there ? name_of(structure, structure.bodies[piece.body].object) : piece.name);
    }
    message.met.resize(task.goals.size());
    message.done.resize(task.goals.size());
    message.held.resize(task.goals.size());
    message.distance.resize(task.goals.size());
    message.angle.resize(task.goals.size());
    message.held_by.resize(task.pieces.size());
    message.touched_by.resize(task.pieces.size());
    message.dropped.resize(task.pieces.size());
  }

  static void fill(const state::Frame& frame, std::uint32_t slot, State& message) {
    const state::TaskInfo& task = state::tasks(*frame.structure)[slot];
    const state::TaskState& row = state::rows(frame, state::task_kind().column)[slot];
    fill_times(frame, message);
    message.pose = to_ros(row.T_parent_object);
    message.success = row.success ? 1 : 0;
    message.success_since = row.success_since_s;
    message.time = row.time_s;
    message.progress = static_cast<float>(row.goals_done) / static_cast<float>(task.goals.size());
    message.drops = row.drops;
    message.touches = row.touches;
    message.hand_overs = row.hand_overs;
    message.wrong_order = row.wrong_order;
    const state::TaskRows<state::TaskGoalState> goals = state::goals_of(frame, slot);
    for (std::size_t i = 0; i < goals.size(); ++i) {
      message.met[i] = goals[i].met ? 1 : 0;
      message.done[i] = goals[i].done ? 1 : 0;
      message.held[i] = static_cast<float>(goals[i].held_s);
      message.distance[i] = static_cast<float>(goals[i].distance_m);
      message.angle[i] = static_cast<float>(goals[i].angle_rad);
    }
    const state::TaskRows<state::TaskPieceState> pieces = state::pieces_of(frame, slot);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      message.held_by[i] = state::names_of(task, pieces[i].held_by);
      message.touched_by[i] = state::names_of(task, pieces[i].touched_by);
      message.dropped[i] = pieces[i].drops;
    }
  }

  static std::string read(const Command&, state::Command& out) {
    out = state::KindCommand{state::TaskCommand{}};
    return {};
  }
};

}  // namespace

EndpointKind task_endpoint_kind() {
  EndpointKind kind;
  kind.open = make_endpoint<ObjectEndpoint<Messages>>;
  return kind;
}

}  // namespace ambf::ros_comm
