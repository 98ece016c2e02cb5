// What may be changed of bodies and joints while the simulation runs: one table of names, ranges and meanings that
// checks, panels and services are made from, and the values themselves, which ADF files set. Values as loaded stand in
// Structure, values in force in Frame; a world reset goes back to the former. Plain data, any thread, C++17.
#pragma once

#include <cstdint>
#include <string>

#include "math/types.h"
#include "state/ids.h"

namespace ambf::state {

enum class ControllerOutput : std::uint8_t { force, velocity, position };

enum class Parameter : std::uint8_t {
  friction,
  rolling_friction,
  restitution,
  linear_damping,
  angular_damping,
  linear_p,
  linear_i,
  linear_d,
  angular_p,
  angular_i,
  angular_d,
  joint_p,
  joint_i,
  joint_d,
  joint_damping,
  count
};
inline constexpr int kParameterCount = static_cast<int>(Parameter::count);

struct Surface {
  double friction = 0.5, rolling_friction = 0.01, restitution = 0.1;
  double linear_damping = 0.04, angular_damping = 0.1;  // fraction of velocity lost a second
};

// One channel of the Cartesian controller, gains per axis: linear in world axes, angular in the body's. A live body's
// are never more than is stable in the step that it takes.
struct ChannelGains {
  math::Vec3 p{10.0, 10.0, 10.0}, i, d{1.0, 1.0, 1.0};
  ControllerOutput output = ControllerOutput::velocity;  // not changed while the simulation runs
};

struct BodyParameters {
  Surface surface;
  ChannelGains linear, angular;
};

struct JointGains {
  double p = 10.0, i = 0.0, d = 1.0;
  ControllerOutput output = ControllerOutput::velocity;  // not changed while the simulation runs
};

struct JointParameters {
  JointGains gains;
  double damping = 0.0;  // viscous: Nms/rad or Ns/m
};

struct ParameterInfo {
  Parameter parameter;
  ObjectKind kind;  // rigid_body or joint
  const char* name;
  bool per_axis;    // x, y and z; else only x counts
  double min, max;  // of a file's value too
  const char* meaning;
};
const ParameterInfo& info_of(Parameter parameter);

// Scalars in all three components. A parameter of the other kind: zero.
math::Vec3 value_of(const BodyParameters& parameters, Parameter parameter);
math::Vec3 value_of(const JointParameters& parameters, Parameter parameter);
void set_value(BodyParameters& parameters, Parameter parameter, const math::Vec3& value);
void set_value(JointParameters& parameters, Parameter parameter, const math::Vec3& value);

// Of all that may be changed.
bool operator==(const BodyParameters& a, const BodyParameters& b);
bool operator==(const JointParameters& a, const JointParameters& b);

// Why `value` is refused, or empty when it is fit to act on.
std::string check(Parameter parameter, const math::Vec3& value);

// A push of a body for a time, on top of whatever else acts: force at a point of the body, and torque.
struct Push {
  math::Vec3 force_world, torque_world;  // N, Nm
  math::Vec3 point_body;                 // in the body (mesh) frame
  double seconds = 0.0;                  // of simulated time, rounded to whole steps, at least one
  Source source = Source::panel;         // who pushes
};
std::string check(const Push& push);

}  // namespace ambf::state
