#include "state/parameters.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace ambf::state {

namespace {

constexpr double kMaxGain = 1e12;
constexpr double kMaxForce = 1e9;     // as for commands
constexpr double kMaxLength = 1e6;    // m
constexpr double kLongestPush = 1e5;  // s

constexpr ObjectKind kBody = ObjectKind::rigid_body, kJoint = ObjectKind::joint;

constexpr std::array<ParameterInfo, kParameterCount> kTable = {{
    {Parameter::friction, kBody, "friction", false, 0.0, 1e6, "of sliding; multiplied with that of what it touches"},
    {Parameter::rolling_friction, kBody, "rolling friction", false, 0.0, 1e6, "of rolling"},
    {Parameter::restitution, kBody, "restitution", false, 0.0, 1e6, "0 stays, 1 bounces back as fast as it came"},
    {Parameter::linear_damping, kBody, "linear damping", false, 0.0, 1.0, "fraction of velocity lost a second"},
    {Parameter::angular_damping, kBody, "angular damping", false, 0.0, 1.0,
     "fraction of angular velocity lost a second"},
    {Parameter::linear_p, kBody, "linear P", true, -kMaxGain, kMaxGain, "Cartesian controller, position, world axes"},
    {Parameter::linear_i, kBody, "linear I", true, -kMaxGain, kMaxGain, "Cartesian controller, position, world axes"},
    {Parameter::linear_d, kBody, "linear D", true, -kMaxGain, kMaxGain, "Cartesian controller, position, world axes"},
    {Parameter::angular_p, kBody, "angular P", true, -kMaxGain, kMaxGain,
     "Cartesian controller, orientation, body axes"},
    {Parameter::angular_i, kBody, "angular I", true, -kMaxGain, kMaxGain,
     "Cartesian controller, orientation, body axes"},
    {Parameter::angular_d, kBody, "angular D", true, -kMaxGain, kMaxGain,
     "Cartesian controller, orientation, body axes"},
    {Parameter::joint_p, kJoint, "P", false, -kMaxGain, kMaxGain, "joint controller"},
    {Parameter::joint_i, kJoint, "I", false, -kMaxGain, kMaxGain, "joint controller"},
    {Parameter::joint_d, kJoint, "D", false, -kMaxGain, kMaxGain, "joint controller"},
    {Parameter::joint_damping, kJoint, "damping", false, 0.0, kMaxGain, "viscous, of the joint itself"},
}};

// Null for a parameter of the other kind.
double* scalar_in(BodyParameters& p, Parameter parameter) {
  switch (parameter) {
    case Parameter::friction: return &p.friction;
    case Parameter::rolling_friction: return &p.rolling_friction;
    case Parameter::restitution: return &p.restitution;
    case Parameter::linear_damping: return &p.linear_damping;
    case Parameter::angular_damping: return &p.angular_damping;
    default: return nullptr;
  }
}

math::Vec3* gains_in(BodyParameters& p, Parameter parameter) {
  switch (parameter) {
    case Parameter::linear_p: return &p.linear_p;
    case Parameter::linear_i: return &p.linear_i;
    case Parameter::linear_d: return &p.linear_d;
    case Parameter::angular_p: return &p.angular_p;
    case Parameter::angular_i: return &p.angular_i;
    case Parameter::angular_d: return &p.angular_d;
    default: return nullptr;
  }
}

double* scalar_in(JointParameters& p, Parameter parameter) {
  switch (parameter) {
    case Parameter::joint_p: return &p.p;
    case Parameter::joint_i: return &p.i;
    case Parameter::joint_d: return &p.d;
    case Parameter::joint_damping: return &p.damping;
    default: return nullptr;
  }
}

bool within(const math::Vec3& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;  // false for NaN
}

math::Vec3 all(double value) { return {value, value, value}; }

}  // namespace

const ParameterInfo& info_of(Parameter parameter) { return kTable[static_cast<std::size_t>(parameter)]; }

math::Vec3 value_of(const BodyParameters& parameters, Parameter parameter) {
  BodyParameters copy = parameters;
  if (const double* scalar = scalar_in(copy, parameter)) return all(*scalar);
  const math::Vec3* gains = gains_in(copy, parameter);
  return gains == nullptr ? math::Vec3{} : *gains;
}

math::Vec3 value_of(const JointParameters& parameters, Parameter parameter) {
  JointParameters copy = parameters;
  const double* scalar = scalar_in(copy, parameter);
  return scalar == nullptr ? math::Vec3{} : all(*scalar);
}

void set_value(BodyParameters& parameters, Parameter parameter, const math::Vec3& value) {
  if (double* scalar = scalar_in(parameters, parameter)) *scalar = value.x;
  if (math::Vec3* gains = gains_in(parameters, parameter)) *gains = value;
}

void set_value(JointParameters& parameters, Parameter parameter, const math::Vec3& value) {
  if (double* scalar = scalar_in(parameters, parameter)) *scalar = value.x;
}

bool operator==(const BodyParameters& a, const BodyParameters& b) {
  for (int i = 0; i < kParameterCount; ++i) {
    const auto parameter = static_cast<Parameter>(i);
    if (!(value_of(a, parameter) == value_of(b, parameter))) return false;
  }
  return true;
}

bool operator==(const JointParameters& a, const JointParameters& b) {
  return a.p == b.p && a.i == b.i && a.d == b.d && a.damping == b.damping;
}

std::string check(Parameter parameter, const math::Vec3& value) {
  const ParameterInfo& info = info_of(parameter);
  const auto bad = [&](double v) { return !(v >= info.least && v <= info.most); };  // true for NaN
  const bool refused = bad(value.x) || (info.per_axis && (bad(value.y) || bad(value.z)));
  if (!refused) return {};
  char text[160];
  std::snprintf(text, sizeof text, "%s must lie between %g and %g", info.name, info.least, info.most);
  return text;
}

std::string check(const Push& push) {
  if (!within(push.force_world, kMaxForce) || !within(push.torque_world, kMaxForce)) {
    return "force or torque is not finite or beyond 1e9";
  }
  if (!within(push.point_body, kMaxLength)) return "the point is not finite or beyond 1e6 m";
  if (!(push.seconds > 0.0 && push.seconds <= kLongestPush)) return "the length of the push must be above 0 and finite";
  return {};
}

}  // namespace ambf::state
