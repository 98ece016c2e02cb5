// Actuators as all threads see them: their rows of a structure and of a frame, and their command. An actuator sits on a
// body, its holder, and holds other bodies there. Plain data, read by any thread. C++17.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/limits.h"
#include "state/command.h"
#include "state/kind_rows.h"

namespace ambf::state {

// Nodes of soft bodies that one actuator holds: three of each of 16 faces.
inline constexpr std::size_t kMaxHeldNodes = 48;

// As files spell them: `type` of an actuator block.
enum class ActuatorType : std::uint8_t { constraint, magnet, blade, needle };
const char* name_of(ActuatorType type);

// What makes an actuator hold while no command is in force. sensor: what its sensor senses; jaw: that, while a jaw is
// closed; contact: of blades, always.
enum class Trigger : std::uint8_t { command, sensor, jaw, contact };

struct ActuatorInfo : PlacedInfo {
  ActuatorType type = ActuatorType::constraint;
  Trigger trigger = Trigger::command;
  std::uint32_t sensor_object = kNone;  // index into Structure::objects; kNone: it names none, or none is there yet
  std::uint32_t jaw_body = kNone;       // slot of the body whose descendants are the jaw
  std::uint32_t thread_object = kNone;  // likewise: the soft body that a needle draws
  bool visible = false;                 // drawn also while the layer of actuators is off
  double visible_size_m = 0.02;
};

struct ActuatorState : PlacedState {
  std::array<std::uint32_t, base::kMaxHeldBodies> held = {};  // slots of bodies; the first held_count count
  std::uint32_t held_count = 0;
  std::uint32_t held_nodes = 0;  // of soft bodies: rows of the column of held nodes; of a needle, punctures
  // Of a needle's thread: how often it goes in and comes out, places of tissue that it goes through (those within
  // included), and those of them that it slides through no more.
  std::uint32_t bites = 0, stitches = 0, tied = 0;
  math::Vec3 force_world;  // N, on what it holds, in the last step

  bool actuated() const { return held_count + held_nodes > 0; }
};

// A node of a soft body that an actuator holds, or the nearest to where a needle or its thread goes through its
// surface.
struct HeldNode {
  std::uint32_t actuator = kNone, soft_body = kNone;  // slots
  std::uint32_t node = 0;                             // of that soft body
  math::Vec3 target_world;                            // m, where it would be without load
  math::Vec3 force_world;                             // N, on the node in the last step
  // Of a needle: whether its tip went in or came out there, and where that is in the tissue as loaded (m, in the frame
  // of the soft body).
  enum class Puncture : std::uint8_t { none, in, out } puncture = Puncture::none;
  math::Vec3 rest;
};

template <class Visit>
void visit_computed(ActuatorState& row, Visit& visit) {
  visit(row.T_parent_object), visit(row.T_world_object);
  visit(row.force_world);
}

template <class Visit>
void visit_computed(HeldNode& row, Visit& visit) {
  visit(row.target_world), visit(row.force_world);
}

// In force until replaced, or ended by its watchdog: then the actuator lets go. Of a needle with a thread: as `actuate`
// begins, it ties what is sewn and not tied yet, and that stays tied; with `use_sensor` it unties all.
struct ActuatorCommand {
  bool actuate = false;  // hold; false: let go
  ObjectId body;         // the one to hold, or a soft body; a magnet pulls what its sensor senses, whichever is named
  bool use_sensor = false;  // instead, each body that `sensor` senses, once; an invalid id: the actuator's own sensor
  ObjectId sensor;
  // The frame in the body's centre-of-mass frame that is brought to the actuator's; else the body stays where it is.
  bool use_offset = false;
  math::Pose T_held_grasp;
};

// Why a command to this actuator (index into Structure::objects) is refused, or empty: no holder, a body that is gone,
// the holder itself, no sensor, a needle without a thread, an offset that is no pose, any offset for a soft body. A
// quaternion with a norm of
// 0.9 to 1.1 is normalised in place.
std::string check(ActuatorCommand& command, const Structure& structure, std::uint32_t actuator);

// Slot of the body on which an object sits, itself or through what it hangs on; kNone: it hangs in the world.
std::uint32_t holder_of(const Structure& structure, std::uint32_t object);

const PlacedKind<ActuatorState>& actuator_kind();

// By actuator; at most their vector's capacity.
const std::vector<HeldNode>& held_nodes(const Frame& frame);
std::vector<HeldNode>& held_nodes(Frame& frame);

const std::vector<ActuatorInfo>& actuators(const Structure& structure);

}  // namespace ambf::state
