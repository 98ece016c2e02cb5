#include "state/parameters.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <type_traits>

#include "base/bounds.h"

namespace ambf::state {

namespace {

constexpr double kMaxGain = base::kMaxGain;
constexpr double kMaxForce = base::kMaxForce;
constexpr double kMaxLength = base::kMaxLength_m;
constexpr double kLongestPush = 1e5;  // s

// Where a value lies: a number, or one for each axis.
struct Place {
  double* number = nullptr;
  math::Vec3* axes = nullptr;
};
Place place_of(double& number) { return {&number, nullptr}; }
Place place_of(math::Vec3& axes) { return {nullptr, &axes}; }

struct Row {
  ParameterInfo info;
  Place (*in_body)(BodyParameters&) = nullptr;
  Place (*in_joint)(JointParameters&) = nullptr;
};

template <auto Part, auto Member>
constexpr Row of_body(Parameter parameter, const char* name, double min, double max, const char* meaning) {
  constexpr bool kPerAxis = std::is_same_v<decltype(Member), math::Vec3 ChannelGains::*>;
  const auto place = [](BodyParameters& body) { return place_of(body.*Part.*Member); };
  return {{parameter, ObjectKind::rigid_body, name, kPerAxis, min, max, meaning}, place, nullptr};
}

constexpr Row of_joint(Parameter parameter, const char* name, double min, double max, const char* meaning,
                       Place (*place)(JointParameters&)) {
  return {{parameter, ObjectKind::joint, name, false, min, max, meaning}, nullptr, place};
}

template <auto Member>
constexpr Row of_gains(Parameter parameter, const char* name) {
  return of_joint(parameter, name, -kMaxGain, kMaxGain, "joint controller",
                  [](JointParameters& joint) { return place_of(joint.gains.*Member); });
}

template <auto Member>
constexpr Row of_surface(Parameter parameter, const char* name, double max, const char* meaning) {
  return of_body<&BodyParameters::surface, Member>(parameter, name, 0.0, max, meaning);
}

template <auto Member>
constexpr Row of_linear(Parameter parameter, const char* name) {
  return of_body<&BodyParameters::linear, Member>(parameter, name, -kMaxGain, kMaxGain,
                                                  "Cartesian controller, position, world axes");
}

template <auto Member>
constexpr Row of_angular(Parameter parameter, const char* name) {
  return of_body<&BodyParameters::angular, Member>(parameter, name, -kMaxGain, kMaxGain,
                                                   "Cartesian controller, orientation, body axes");
}

constexpr std::array<Row, kParameterCount> kTable = {{
    of_surface<&Surface::friction>(Parameter::friction, "friction", 1e6,
                                   "of sliding; multiplied with that of what it touches"),
    of_surface<&Surface::rolling_friction>(Parameter::rolling_friction, "rolling friction", 1e6,
                                           "of rolling: a lever, m; bounded on bodies with flat sides"),
    of_surface<&Surface::restitution>(Parameter::restitution, "restitution", 1e6,
                                      "0 stays, 1 bounces back as fast as it came"),
    of_surface<&Surface::linear_damping>(Parameter::linear_damping, "linear damping", 1.0,
                                         "fraction of velocity lost a second"),
    of_surface<&Surface::angular_damping>(Parameter::angular_damping, "angular damping", 1.0,
                                          "fraction of angular velocity lost a second"),
    of_linear<&ChannelGains::p>(Parameter::linear_p, "linear P"),
    of_linear<&ChannelGains::i>(Parameter::linear_i, "linear I"),
    of_linear<&ChannelGains::d>(Parameter::linear_d, "linear D"),
    of_angular<&ChannelGains::p>(Parameter::angular_p, "angular P"),
    of_angular<&ChannelGains::i>(Parameter::angular_i, "angular I"),
    of_angular<&ChannelGains::d>(Parameter::angular_d, "angular D"),
    of_gains<&JointGains::p>(Parameter::joint_p, "P"),
    of_gains<&JointGains::i>(Parameter::joint_i, "I"),
    of_gains<&JointGains::d>(Parameter::joint_d, "D"),
    of_joint(Parameter::joint_damping, "damping", 0.0, kMaxGain, "viscous, of the joint itself",
             [](JointParameters& joint) { return place_of(joint.damping); }),
}};

const Row& row_of(Parameter parameter) { return kTable[static_cast<std::size_t>(parameter)]; }

// Nowhere for a parameter of the other kind.
Place find(BodyParameters& in, Parameter parameter) {
  const Row& row = row_of(parameter);
  return row.in_body == nullptr ? Place{} : row.in_body(in);
}
Place find(JointParameters& in, Parameter parameter) {
  const Row& row = row_of(parameter);
  return row.in_joint == nullptr ? Place{} : row.in_joint(in);
}

template <class Parameters>
math::Vec3 value_in(Parameters parameters, Parameter parameter) {
  const Place place = find(parameters, parameter);
  if (place.number != nullptr) return {*place.number, *place.number, *place.number};
  return place.axes == nullptr ? math::Vec3{} : *place.axes;
}

template <class Parameters>
void set_value_in(Parameters& parameters, Parameter parameter, const math::Vec3& value) {
  const Place place = find(parameters, parameter);
  if (place.number != nullptr) *place.number = value.x;
  if (place.axes != nullptr) *place.axes = value;
}

template <class Parameters>
bool equal(const Parameters& a, const Parameters& b) {
  for (const Row& row : kTable) {
    if (!(value_in(a, row.info.parameter) == value_in(b, row.info.parameter))) return false;
  }
  return true;
}

bool within(const math::Vec3& v, double limit) {
  return std::abs(v.x) <= limit && std::abs(v.y) <= limit && std::abs(v.z) <= limit;  // false for NaN
}

}  // namespace

const ParameterInfo& info_of(Parameter parameter) { return row_of(parameter).info; }

math::Vec3 value_of(const BodyParameters& parameters, Parameter parameter) { return value_in(parameters, parameter); }
math::Vec3 value_of(const JointParameters& parameters, Parameter parameter) { return value_in(parameters, parameter); }

void set_value(BodyParameters& parameters, Parameter parameter, const math::Vec3& value) {
  set_value_in(parameters, parameter, value);
}
void set_value(JointParameters& parameters, Parameter parameter, const math::Vec3& value) {
  set_value_in(parameters, parameter, value);
}

bool operator==(const BodyParameters& a, const BodyParameters& b) { return equal(a, b); }
bool operator==(const JointParameters& a, const JointParameters& b) { return equal(a, b); }

std::string check(Parameter parameter, const math::Vec3& value) {
  const ParameterInfo& info = info_of(parameter);
  const auto bad = [&](double v) { return !(v >= info.min && v <= info.max); };  // true for NaN
  const bool refused = bad(value.x) || (info.per_axis && (bad(value.y) || bad(value.z)));
  if (!refused) return {};
  char text[160];
  std::snprintf(text, sizeof text, "%s must lie between %g and %g", info.name, info.min, info.max);
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
