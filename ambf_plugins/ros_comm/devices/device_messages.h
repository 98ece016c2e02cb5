// Between input devices and their ROS messages. Pure functions. Private to ros_comm. C++17.
#pragma once

#include <ambf_msgs/DeviceInfo.h>
#include <ambf_msgs/DeviceMapping.h>
#include <ambf_msgs/DeviceRates.h>
#include <ambf_msgs/ObjectCmd.h>
#include <ambf_msgs/ObjectState.h>
#include <ambf_msgs/SetDevice.h>

#include <cstdint>
#include <string>
#include <vector>

#include "state/abilities/devices.h"
#include "state/devices.h"

namespace ambf::ros_comm {

// Where the simulation was when a device's message was made.
struct WorldTime {
  std::uint32_t sim_step = 0;
  double wall_time = 0.0, sim_time = 0.0;
};

// The clocks at one moment: devices stamp by the steady one, messages by the system's.
struct ClockPair {
  std::int64_t steady_ns = 0, system_ns = 0;
};
ros::Time stamp_of(std::int64_t steady_ns, const ClockPair& now);

// What changes only with the device's info.
void fill_names(const state::DeviceInfo& info, ambf_msgs::ObjectState& message);
void fill_names(const state::DeviceInfo& info, ambf_msgs::DeviceMapping& message);
// State: the hand's pose in the world, and the wrench that it feels, in world axes. `message` has its names.
void fill(const state::DeviceStatus& status, const WorldTime& time, const ClockPair& now,
          ambf_msgs::ObjectState& message);
void fill(const state::DeviceStatus& status, const WorldTime& time, const ClockPair& now,
          ambf_msgs::DeviceMapping& message);

void fill(const state::DeviceInfo& info, const state::DeviceStatus& status, std::int64_t steady_ns,
          ambf_msgs::DeviceRates& message);
// With the values of all parameters.
void fill(const state::DeviceInfo& info, const state::DeviceStatus& status, const std::string& topic,
          ambf_msgs::DeviceInfo& message);

// To the hand of one device: a wrench, or a target of its law. Empty, or why the message is refused.
struct HandCommand {
  bool has_target = false;
  math::Pose T_world_target;
  math::Wrench wrench_world;
};
std::string read(const ambf_msgs::ObjectCmd& message, HandCommand& command);

// DeviceParameter::count: there is none of this name.
state::DeviceParameter find_parameter(const std::string& name);
// One number counts for all axes. Empty, or why the list is refused.
std::string read_value(const std::vector<double>& list, state::DeviceParameter parameter, math::Vec3& value);

}  // namespace ambf::ros_comm
