// Reads what arms and other devices publish, whichever of several message types they use. Pure functions on serialized
// messages, any thread: they return empty, or why the message is refused. C++17.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "dvrk_arm/mtm.h"
#include "math/types.h"

namespace ambf::dvrk_arm {

struct Message {
  std::string type;  // "geometry_msgs/PoseStamped"
  const std::uint8_t* bytes = nullptr;
  std::size_t size = 0;
};

struct StampedPose {
  math::Pose pose;
  std::int64_t stamp_ns = 0;  // of a stamped type; 0 means that the pose is not valid (CRTK)
  bool stamped = false;
};
// PoseStamped, TransformStamped (dVRK before 2.2), Pose, Transform.
std::string read_pose(const Message& message, StampedPose& pose);

// Twist, TwistStamped.
std::string read_twist(const Message& message, math::Twist& twist);

struct JoyValues {
  std::vector<double> axes;
  std::uint64_t buttons = 0;  // bit n: button n is down
};
std::string read_joy(const Message& message, JoyValues& joy);

// A pedal or switch: the first button of a Joy (pressed is 1, a quick tap 2), or a Bool.
std::string read_switch(const Message& message, bool& on);

// The first position of a JointState, or a Float64.
std::string read_angle(const Message& message, double& angle_rad);

// The positions and velocities of a JointState of an MTM; velocities may be absent, and are then zero.
std::string read_joints(const Message& message, MtmJoints& position, MtmJoints& velocity);

// crtk_msgs/OperatingState, or the String of older releases. `why`: static text, empty when the arm can be used.
std::string read_state(const Message& message, const char*& why);

}  // namespace ambf::dvrk_arm
