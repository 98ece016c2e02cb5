// The description of a task: which pieces belong where, who may hold them, in which order. Beside description.h,
// because few files read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "math/types.h"
#include "scene/block_kinds.h"
#include "scene/description.h"
#include "state/tasks.h"

namespace ambf::scene {

// Names are as written; `where` is the goal's place in the file.
struct TaskGoal {
  std::string name;                 // empty: of the piece and the place
  std::string piece;                // body
  std::vector<std::string> pieces;  // instead: any of them
  math::Vec3 point;                 // of the piece, in its body frame
  std::string place;                // object whose frame the place is in; empty: the task's own
  math::Pose T_place_goal;
  std::optional<math::Vec3> tolerance_m;      // half lengths of a box; none: only the sensor counts
  std::optional<double> angle_tolerance_rad;  // none: any orientation
  std::optional<math::Vec3> axis;             // of piece and place; none: the whole orientation
  bool either_way = false;
  std::string sensor;
  double hold_s = 0.0;
  bool released = true;
  std::string held_by;  // one of the holders
  bool hand_over = false;
  state::HeldNode::Puncture puncture = state::HeldNode::Puncture::none;
  Location where;
};

struct Task {
  std::string parent;  // empty: the world
  math::Pose T_parent_task;
  state::TaskOrder order = state::TaskOrder::any;
  double drop_height_m = 0.01;
  std::vector<std::string> holders, avoid;
  std::vector<TaskGoal> goals;
  Location parent_at, holders_at, avoid_at;
};

namespace group {
extern const Group kTask, kTaskGoal;
}
namespace kind {
extern const BlockKind kTask;
}

}  // namespace ambf::scene
