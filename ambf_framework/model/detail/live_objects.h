// What lives in the simulation, one struct a kind: built by the loader, then touched by the physics thread only, freed by the loader.
// Plain structs; LiveWorld and LiveCommands act on them. For use inside model/ only.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "math/types.h"
#include "model/cartesian_controller.h"
#include "model/detail/command_slots.h"
#include "model/joint_controller.h"
#include "physics/body.h"
#include "physics/joint.h"
#include "state/command.h"
#include "state/ids.h"
#include "state/parameters.h"

namespace ambf::model {

struct LiveBody {
  LiveBody(std::unique_ptr<physics::Body> made, const CartesianController& control)
      : body(std::move(made)), controller(control) {}

  std::unique_ptr<physics::Body> body;
  CartesianController controller;
  std::shared_ptr<CommandSlots> slots;

  // All sources merged; in force while any of them is.
  bool active = false;
  math::Wrench wrench_world;                                             // at the COM
  state::CartesianCommandType mode = state::CartesianCommandType::none;  // none, position or velocity
  math::Pose T_world_target;
  math::Twist twist_world;

  state::Push push;
  std::uint64_t push_steps = 0;  // that it still lasts
};

// What is in force.
state::BodyParameters parameters_of(const LiveBody& live);
void set_parameters(LiveBody& live, const state::BodyParameters& parameters, double h_s);

// What a joint is told: by the source whose post is `order`; persistent.
struct JointOrder {
  state::JointCommandType type = state::JointCommandType::none;
  double value = 0.0;
  std::uint64_t order = 0;           // of the post that said so
  const CommandSlot* led = nullptr;  // the slot that leads; null: nobody any more
};

struct LiveJoint {
  LiveJoint(std::unique_ptr<physics::Joint> made, const JointController& control)
      : joint(std::move(made)), controller(control) {}

  std::unique_ptr<physics::Joint> joint;
  JointController controller;
  bool motor_holds = false;  // before anybody commands it, its motor keeps it where it is
  bool feedback = false;
  JointOrder order;
};

state::JointParameters parameters_of(const LiveJoint& live);
void set_parameters(LiveJoint& live, const state::JointParameters& parameters);

// A camera or a light: something with a pose in a parent.
struct LivePlaced {
  math::Pose T_parent_loaded;             // in the parent that its file names
  math::Pose T_parent_initial, T_parent;  // in the present one: where a reset puts it, and now
  bool orphaned = false;                  // its parent is gone: it stays where it was, reset or not
  state::Lens lens;                       // cameras
  state::Beam beam;                       // lights
  std::shared_ptr<CommandSlots> slots;
  bool active = false;
};

// Where a live object is: its kind and its slot among its kind.
struct ObjectRef {
  state::ObjectKind kind = state::ObjectKind::world;  // world: nobody
  std::uint32_t slot = state::kNone;
};

// Everything alive, by slot. Joints are destroyed before the bodies they hold to.
struct LiveTables {
  std::vector<std::unique_ptr<LiveBody>> bodies;
  std::vector<std::unique_ptr<LiveJoint>> joints;
  std::vector<std::unique_ptr<LivePlaced>> cameras, lights;
  std::vector<ObjectRef> by_index;   // ObjectId::index -> object; joints are not in it
  std::vector<ObjectRef> commanded;  // objects with a source in force; room for all
  std::vector<ObjectRef> noted;      // objects that were ever sent a command; room for all
};

}  // namespace ambf::model
