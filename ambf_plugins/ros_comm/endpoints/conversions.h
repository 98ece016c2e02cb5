// Between our values and ROS messages. Pure functions; for ros_comm and for endpoints of registered kinds. C++17.
#pragma once

#include <ambf_msgs/Diagnostic.h>
#include <ambf_msgs/RigidBodyCmd.h>
#include <ambf_msgs/RigidBodyState.h>
#include <ambf_msgs/WorldState.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Wrench.h>

#include <string>

#include "base/diagnostic.h"
#include "state/command.h"
#include "state/frame.h"

namespace ambf::ros_comm {

geometry_msgs::Pose to_ros(const math::Pose& pose);
geometry_msgs::Vector3 to_ros(const math::Vec3& vector);
geometry_msgs::Twist to_ros(const math::Twist& twist);
geometry_msgs::Wrench to_ros(const math::Wrench& wrench);
math::Pose from_ros(const geometry_msgs::Pose& pose);
math::Vec3 from_ros(const geometry_msgs::Vector3& vector);

// Empty, or why a message is refused; `command` is valid only when it is empty.
std::string read(const ambf_msgs::RigidBodyCmd& message, state::RigidBodyCommand& command);
// Of objects that take poses in their parent's frame: CameraCmd and LightCmd have the same fields.
std::string read_pose_command(bool enabled, const geometry_msgs::Pose& pose, state::PoseCommand& command);

ambf_msgs::Diagnostic to_ros(const base::Diagnostic& diagnostic);

ros::Time stamp_of(const state::Frame& frame);
// The fields that every State message begins with.
template <class Message>
void fill_times(const state::Frame& frame, Message& message) {
  message.header.stamp = stamp_of(frame);
  message.sim_step = frame.sim_step;
  message.wall_time = static_cast<float>(frame.wall_time);
  message.sim_time = static_cast<float>(frame.sim_time);
}
void fill(const state::Frame& frame, ambf_msgs::WorldState& message);
// What changes each frame; names are filled by fill_names when the structure changed.
void fill(const state::Frame& frame, std::uint32_t slot, ambf_msgs::RigidBodyState& message);

// What changes only with the structure: names, mass, lengths of the joint arrays. `wanted` switches lists on
// that the file leaves off.
struct WantedLists {
  bool children_names = false, joint_names = false, joint_positions = false;
};
// Full name; empty for state::kNone, the world.
const std::string& name_of(const state::Structure& structure, std::uint32_t object);
void fill_names(const state::Structure& structure, std::uint32_t slot, ambf_msgs::RigidBodyState& message,
                const WantedLists& wanted = {true, true, true});

}  // namespace ambf::ros_comm
