// Commands of objects: in force until replaced, or ended by the watchdog. Plain data, C++17.
#pragma once

#include <any>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "math/types.h"
#include "state/frame.h"

namespace ambf::state {

enum class CartesianCommandType : std::uint8_t { none, force, position, velocity };

// One joint's entry; type none leaves the joint alone.
struct JointCommand {
  JointCommandType type = JointCommandType::none;
  double value = 0.0;  // Nm or N; rad or m; rad/s or m/s
};

struct RigidBodyCommand {
  CartesianCommandType type = CartesianCommandType::none;
  math::Wrench wrench_world;  // at the centre of mass
  math::Pose T_world_body;    // body (mesh) frame
  math::Twist twist_world;
  std::vector<JointCommand> joints;  // i-th active descendant joint of the body; entries beyond the list are ignored
};

// Objects of kinds with a parent: their pose in the parent's frame.
struct PoseCommand {
  bool enabled = false;
  math::Pose T_parent_object;
};

// A registered kind's own command, of a type that its kind knows. The poster allocates and frees it; the physics thread
// only reads it.
struct KindCommand {
  std::any value;
};

using Command = std::variant<RigidBodyCommand, PoseCommand, KindCommand>;

struct WorldCommand {
  bool enable_step_throttling = false;
  bool step_clock = false;
  unsigned n_skip_steps = 10;
  std::uint64_t client =
      0;  // which connection sent it: the clock of each starts low (runtime/detail/throttle.h); 0: unknown
};

// For reports: "topic", "step service", "pointer", "panel", "plugin" or "device".
const char* name_of(Source source);

// Why a command was refused, or empty when it is fit to act on: NaN, infinities, absurd sizes, quaternions that are
// none. A quaternion with norm within [0.9, 1.1] is normalised in place.
std::string check(RigidBodyCommand& command);
std::string check(PoseCommand& command);

}  // namespace ambf::state
