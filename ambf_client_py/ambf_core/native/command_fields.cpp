// What Python programs command: the table of its arrays, and how they begin.
#include <algorithm>
#include <array>
#include <cstdint>

#include "fields.h"
#include "state/actuators.h"

namespace ambf::python {
namespace {

enum CommandField : std::size_t {
  kJointMode,
  kJointValue,
  kBodyMode,
  kBodyWrench,
  kBodyPoseWanted,
  kBodyTwistWanted,
  kActuatorMode,
  kActuatorBody,
  kCommandFields
};

constexpr std::array<Field, kCommandFields> kCommands{{
    {"joint_mode", Rows::joints, 1, Element::i8},
    {"joint_value", Rows::joints, 1, Element::f64},
    {"body_mode", Rows::bodies, 1, Element::i8},
    {"body_wrench", Rows::bodies, 6, Element::f64},
    {"body_pose", Rows::bodies, 7, Element::f64},
    {"body_twist", Rows::bodies, 6, Element::f64},
    {"actuator_mode", Rows::actuators, 1, Element::i8},
    {"actuator_body", Rows::actuators, 1, Element::i32},
}};

}  // namespace

std::span<const Field> command_fields() { return kCommands; }

void clear_commands(const state::Structure& structure, const Memory& commands) {
  std::fill_n(at<signed char>(commands, kJointMode), structure.joints.size(),
              static_cast<signed char>(JointMode::none));
  std::fill_n(at<double>(commands, kJointValue), structure.joints.size(), 0.0);
  const std::size_t bodies = structure.bodies.size();
  std::fill_n(at<signed char>(commands, kBodyMode), bodies, static_cast<signed char>(BodyMode::none));
  std::fill_n(at<double>(commands, kBodyWrench), 6 * bodies, 0.0);
  std::fill_n(at<double>(commands, kBodyTwistWanted), 6 * bodies, 0.0);
  double* pose = at<double>(commands, kBodyPoseWanted);
  for (std::size_t i = 0; i < 7 * bodies; ++i) pose[i] = i % 7 == 6 ? 1.0 : 0.0;
  const std::size_t actuators = state::actuators(structure).size();
  std::fill_n(at<signed char>(commands, kActuatorMode), actuators, static_cast<signed char>(ActuatorMode::none));
  std::fill_n(at<std::int32_t>(commands, kActuatorBody), actuators, 0);
}

CommandArrays::CommandArrays(const Memory& commands)
    : joint_mode(at<signed char>(commands, kJointMode)),
      joint_value(at<double>(commands, kJointValue)),
      body_mode(at<signed char>(commands, kBodyMode)),
      body_wrench(at<double>(commands, kBodyWrench)),
      body_pose(at<double>(commands, kBodyPoseWanted)),
      body_twist(at<double>(commands, kBodyTwistWanted)),
      actuator_mode(at<signed char>(commands, kActuatorMode)),
      actuator_body(at<std::int32_t>(commands, kActuatorBody)) {}

}  // namespace ambf::python
