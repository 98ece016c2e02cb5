// The arrays in which a Python program sees a world and commands it: one table, from which Python allocates them, and
// how they are filled from a frame. Knows nothing of Python. SI units, radians, quaternions x y z w.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "state/frame.h"

namespace ambf::python {

enum class Rows { one, bodies, joints, contacts, sensors, elements, actuators, punctures, tasks, goals, pieces };
enum class Element { f64, i64, i32, i8, flag };

struct Field {
  const char* name;
  Rows rows;
  unsigned columns;  // 1: the array has no second axis
  Element element;
};

// Meanings, units and frames are documented where users read them: ambf_core/arrays.py.
std::span<const Field> state_fields();
std::span<const Field> command_fields();

const char* name_of(Rows rows);
std::size_t rows_of(const state::Structure& structure, Rows rows);
std::size_t bytes_of(const state::Structure& structure, const Field& field);

// Values of the command fields joint_mode and body_mode.
enum class JointMode : signed char { none = -1, effort = 0, position = 1, velocity = 2 };
enum class BodyMode : signed char { none = 0, wrench = 1, pose = 2, twist = 3 };
// none: its trigger decides. body: it holds the body of that row; sensed: what its sensor senses.
enum class ActuatorMode : signed char { none = -1, release = 0, body = 1, sensed = 2 };

// Memory of all fields of a table, in its order.
using Memory = std::vector<void*>;

template <class T>
T* at(const Memory& memory, std::size_t field) {
  return static_cast<T*>(memory[field]);
}

// Writes the frame into the state fields. Allocates nothing.
void show(const state::Frame& frame, const Memory& state);
// Nothing is commanded; poses are the identity.
void clear_commands(const state::Structure& structure, const Memory& commands);

// What the command fields hold, by their names.
struct CommandArrays {
  explicit CommandArrays(const Memory& commands);
  const signed char* joint_mode;
  const double* joint_value;
  const signed char* body_mode;
  const double *body_wrench, *body_pose, *body_twist;
  const signed char* actuator_mode;
  const std::int32_t* actuator_body;
};

}  // namespace ambf::python
