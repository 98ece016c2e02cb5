// A whole state of the simulation as plain data, and as bytes of one version. decode() trusts the bytes in nothing: whatever it lets
// pass may be put into a world without another look. Any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "math/types.h"
#include "model/cartesian_controller.h"
#include "model/joint_controller.h"
#include "state/command.h"
#include "state/ids.h"
#include "state/parameters.h"
#include "state/structure.h"
#include "state/view.h"

namespace ambf::model {

// One source's command in force.
struct SavedCommand {
  std::int32_t source = 0;
  std::uint64_t order = 0;
  double age_s = 0.0;  // since its last sign of life
  state::Command command;
};

struct SavedBody {
  state::BodyParameters parameters;
  state::Push push;
  std::uint64_t push_steps = 0;  // 0: nothing pushes
  CartesianController::State controller;
  std::vector<SavedCommand> commands;
};

struct SavedJoint {
  state::JointParameters parameters;
  JointController::State controller;
  state::JointCommandType type = state::JointCommandType::none;
  double value = 0.0;
  std::uint64_t order = 0;  // 0: nobody leads
};

// A camera or a light: its lens or its beam counts.
struct SavedPlaced {
  std::uint32_t parent_object = state::kNone;  // index into Structure::objects; kNone: the world
  std::string parent_name;                     // as it was asked for
  math::Pose T_parent_initial, T_parent;
  bool orphaned = false;
  state::Lens lens;
  state::Beam beam;
  std::vector<SavedCommand> commands;
};

struct SavedState {
  std::vector<std::byte> physics;  // World::save_state()
  std::uint64_t steps = 0;
  double sim_time = 0.0;  // s
  std::uint64_t last_order = 0;
  std::vector<SavedBody> bodies;
  std::vector<SavedJoint> joints;
  std::vector<SavedPlaced> cameras, lights;
};

// A camera or light that hangs, or is to hang, on another parent; an invalid one is the world.
struct ParentChange {
  state::ObjectId object, parent;
  std::string parent_name;  // as it was asked for
};
// What must change in `structure` before `state` is restored.
std::vector<ParentChange> parent_changes(const SavedState& state, const state::Structure& structure);

// `state` has one entry for each body, joint, camera and light of `structure`.
std::vector<std::uint8_t> encode(SavedState state, const state::Structure& structure);

// Empty when done; else what was expected where, and `out` is of no use. It must be a state of these very objects (whatever cameras and
// lights hang on) in a world of steps of `step_s`.
std::string decode(const std::vector<std::uint8_t>& bytes, const state::Structure& structure, double step_s,
                   SavedState& out);

}  // namespace ambf::model
