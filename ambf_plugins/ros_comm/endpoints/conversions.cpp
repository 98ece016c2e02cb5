#include "ros_comm/endpoints/conversions.h"

#include <ros/time.h>

#include "base/bounds.h"

namespace ambf::ros_comm {

namespace {

// No constant of the message: a new one would change its md5, and old clients could not talk to us any more.
constexpr std::int8_t kLeaveAlone = -1;

}  // namespace

geometry_msgs::Vector3 to_ros(const math::Vec3& v) {
  geometry_msgs::Vector3 out;
  out.x = v.x, out.y = v.y, out.z = v.z;
  return out;
}

geometry_msgs::Twist to_ros(const math::Twist& twist) {
  geometry_msgs::Twist out;
  out.linear = to_ros(twist.linear), out.angular = to_ros(twist.angular);
  return out;
}

geometry_msgs::Wrench to_ros(const math::Wrench& wrench) {
  geometry_msgs::Wrench out;
  out.force = to_ros(wrench.force), out.torque = to_ros(wrench.torque);
  return out;
}

geometry_msgs::Pose to_ros(const math::Pose& pose) {
  geometry_msgs::Pose out;
  out.position.x = pose.position.x, out.position.y = pose.position.y, out.position.z = pose.position.z;
  out.orientation.x = pose.orientation.x, out.orientation.y = pose.orientation.y;
  out.orientation.z = pose.orientation.z, out.orientation.w = pose.orientation.w;
  return out;
}

math::Vec3 from_ros(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

math::Pose from_ros(const geometry_msgs::Pose& pose) {
  return {{pose.position.x, pose.position.y, pose.position.z},
          {pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w}};
}

std::string read(const ambf_msgs::RigidBodyCmd& message, state::RigidBodyCommand& command) {
  switch (message.cartesian_cmd_type) {
    case ambf_msgs::RigidBodyCmd::TYPE_FORCE: command.type = state::CartesianCommandType::force; break;
    case ambf_msgs::RigidBodyCmd::TYPE_POSITION: command.type = state::CartesianCommandType::position; break;
    case ambf_msgs::RigidBodyCmd::TYPE_VELOCITY: command.type = state::CartesianCommandType::velocity; break;
    case kLeaveAlone: command.type = state::CartesianCommandType::none; break;
    default:
      return "cartesian_cmd_type must be 0 (force), 1 (position), 2 (velocity) or -1 (none), not " +
             std::to_string(message.cartesian_cmd_type);
  }
  command.wrench_world = {from_ros(message.wrench.force), from_ros(message.wrench.torque)};
  command.T_world_body = from_ros(message.pose);
  command.twist_world = {from_ros(message.twist.linear), from_ros(message.twist.angular)};
  if (message.joint_cmds.size() > base::kMaxJointCommands)
    return "joint_cmds has more than " + std::to_string(base::kMaxJointCommands) + " entries";
  if (message.joint_cmds_types.size() > message.joint_cmds.size()) return "joint_cmds_types is longer than joint_cmds";
  command.joints.resize(message.joint_cmds.size());
  for (std::size_t i = 0; i < message.joint_cmds.size(); ++i) {
    state::JointCommand& joint = command.joints[i];
    joint.value = static_cast<double>(message.joint_cmds[i]);
    // Missing types mean effort, as they always did; a type outside 0..2 leaves the joint alone.
    const int type = i < message.joint_cmds_types.size() ? message.joint_cmds_types[i] : 0;
    joint.type = type >= 0 && type <= 2 ? static_cast<state::JointCommandType>(type) : state::JointCommandType::none;
  }
  return state::check(command);
}

std::string read_pose_command(bool enabled, const geometry_msgs::Pose& pose, state::PoseCommand& command) {
  command.enabled = enabled;
  command.T_parent_object = from_ros(pose);
  return state::check(command);
}

ambf_msgs::Diagnostic to_ros(const base::Diagnostic& diagnostic) {
  ambf_msgs::Diagnostic out;
  out.severity = static_cast<std::uint8_t>(diagnostic.severity);
  out.file = diagnostic.file;
  out.line = static_cast<std::uint32_t>(diagnostic.line);
  out.column = static_cast<std::uint32_t>(diagnostic.column);
  out.block = diagnostic.block;
  out.key = diagnostic.key;
  out.message = diagnostic.message;
  out.hint = diagnostic.hint;
  return out;
}

ros::Time stamp_of(const state::Frame& frame) {
  ros::Time stamp;
  return stamp.fromNSec(static_cast<std::uint64_t>(frame.system_ns));
}

void fill(const state::Frame& frame, ambf_msgs::WorldState& message) {
  fill_times(frame, message);
  message.graphics_loop_freq = static_cast<std::uint64_t>(frame.run.graphics_rate + 0.5);
  message.dynamic_loop_freq = static_cast<std::uint64_t>(frame.run.turns_per_second + 0.5);
}

void fill(const state::Frame& frame, std::uint32_t slot, ambf_msgs::RigidBodyState& message) {
  fill_times(frame, message);
  const state::BodyState& body = frame.bodies[slot];
  message.pose = to_ros(body.T_world_body);
  message.twist = to_ros(body.twist_world);
  message.wrench = to_ros(body.wrench_body);
  const state::IndexList& joints = frame.structure->bodies[slot].joints;
  for (std::size_t i = 0; i < message.joint_positions.size(); ++i) {
    const state::JointState& joint = frame.joints[joints[i]];
    message.joint_positions[i] = static_cast<float>(joint.position);
    message.joint_velocities[i] = static_cast<float>(joint.velocity);
    message.joint_efforts[i] = static_cast<float>(joint.effort);
  }
}

void fill_names(const state::Structure& structure, std::uint32_t slot, ambf_msgs::RigidBodyState& message,
                const WantedLists& wanted) {
  const state::BodyInfo& body = structure.bodies[slot];
  message.name.data = structure.objects[body.object].local_name;
  message.identifier.data = structure.objects[body.object].identifier;
  message.mass = static_cast<float>(body.mass);
  message.pInertia.x = body.inertia.x, message.pInertia.y = body.inertia.y, message.pInertia.z = body.inertia.z;
  message.children_names.clear();
  if (body.publish_children_names || wanted.children_names) {
    for (const std::uint32_t child : body.children) message.children_names.push_back(structure.objects[child].name);
  }
  message.joint_names.clear();
  if (body.publish_joint_names || wanted.joint_names) {
    for (const std::uint32_t joint : body.joints) message.joint_names.push_back(structure.joints[joint].name);
  }
  const std::size_t values = body.publish_joint_positions || wanted.joint_positions ? body.joints.size() : 0;
  message.joint_positions.resize(values);
  message.joint_velocities.resize(values);
  message.joint_efforts.resize(values);
}

const std::string& name_of(const state::Structure& structure, std::uint32_t object) {
  static const std::string world;
  return object == state::kNone ? world : structure.objects[object].name;
}

}  // namespace ambf::ros_comm
