#include "ros_comm/devices/device_messages.h"

#include <algorithm>

#include "base/clock.h"
#include "ros_comm/endpoints/conversions.h"
#include "state/command.h"

namespace ambf::ros_comm {

namespace {

constexpr const char* kUserData =
    "opening asked of the tool (0 .. 1), engaged, clutched, camera clutched, forces on, fault (DeviceMapping.fault has "
    "its name), then each button";
constexpr std::size_t kFixedUserData = 6;

void fill(const state::RunPercentiles& times, ambf_msgs::RunPercentiles& out) {
  out.count = times.count;
  out.p50 = times.p50_s, out.p99 = times.p99_s, out.p999 = times.p999_s, out.max = times.max_s;
}

std::string text_of(state::DeviceFault fault) {
  return fault == state::DeviceFault::none ? std::string() : state::name_of(fault);
}

std::string fault_of(const state::DeviceStatus& status) {
  const bool has_reason = status.fault == state::DeviceFault::not_ready && status.not_ready[0] != '\0';
  return has_reason ? status.not_ready : text_of(status.fault);
}

}  // namespace

ros::Time stamp_of(std::int64_t steady_ns, const ClockPair& now) {
  ros::Time stamp;
  return stamp.fromNSec(
      static_cast<std::uint64_t>(std::max<std::int64_t>(0, now.system_ns - now.steady_ns + steady_ns)));
}

void fill_names(const state::DeviceInfo& info, ambf_msgs::ObjectState& message) {
  message.identifier.data = info.name;
  message.name.data = info.name;
  message.userdata_description = kUserData;
  message.children_names.assign(1, info.effector_name);
  message.joint_names.assign(info.gripper ? 1 : 0, "gripper");
  message.joint_positions.resize(message.joint_names.size());
  message.userdata.resize(kFixedUserData + std::min(info.buttons, 64U));
}

void fill_names(const state::DeviceInfo& info, ambf_msgs::DeviceMapping& message) {
  message.name = info.name;
  message.effector = info.effector.valid() ? info.effector_name : std::string();
  message.camera = info.camera_names.empty() ? std::string() : info.camera_names.front();
}

void fill(const state::DeviceStatus& status, const WorldTime& time, const ClockPair& now,
          ambf_msgs::ObjectState& message) {
  message.header.stamp = stamp_of(status.steady_ns, now);
  message.sim_step = time.sim_step;
  message.wall_time = static_cast<float>(time.wall_time);
  message.sim_time = static_cast<float>(time.sim_time);
  const math::Pose& T_world_u = status.frames.T_world_u;
  message.pose = to_ros(T_world_u * status.frames.T_u_iid);
  message.wrench = to_ros(math::Wrench{math::rotate(T_world_u.orientation, status.wrench_u_written.force),
                                       math::rotate(T_world_u.orientation, status.wrench_u_written.torque)});
  if (!message.joint_positions.empty()) message.joint_positions[0] = static_cast<float>(status.jaw_hand);
  message.userdata[0] = static_cast<float>(status.jaw_tool);
  message.userdata[1] = status.engaged ? 1.0F : 0.0F;
  message.userdata[2] = status.clutched ? 1.0F : 0.0F;
  message.userdata[3] = status.camera_clutched ? 1.0F : 0.0F;
  message.userdata[4] = status.forces_on ? 1.0F : 0.0F;
  message.userdata[5] = static_cast<float>(status.fault);
  for (std::size_t i = kFixedUserData; i < message.userdata.size(); ++i) {
    message.userdata[i] = (status.buttons >> (i - kFixedUserData) & 1U) != 0 ? 1.0F : 0.0F;
  }
}

void fill(const state::DeviceStatus& status, const WorldTime& time, const ClockPair& now,
          ambf_msgs::DeviceMapping& message) {
  message.header.stamp = stamp_of(status.steady_ns, now);
  message.sim_step = time.sim_step;
  message.cycle = status.cycle;
  message.sample = status.sample;
  message.sample_age = status.sampled_ns == 0 ? -1.0 : base::to_seconds(status.steady_ns - status.sampled_ns);
  const state::MappingFrames& frames = status.frames;
  message.T_world_u = to_ros(frames.T_world_u);
  message.T_u_iid = to_ros(frames.T_u_iid);
  message.T_u_base = to_ros(frames.T_u_base);
  message.T_base_e = to_ros(frames.T_base_e);
  message.T_base_bo = to_ros(frames.T_base_bo);
  message.T_e_to = to_ros(frames.T_e_to);
  message.T_u_iid_cl = to_ros(frames.T_u_iid_cl);
  message.T_u_iid_pre_cl = to_ros(frames.T_u_iid_pre_cl);
  message.T_world_sde = to_ros(frames.T_world_sde);
  message.T_world_sde_bo = to_ros(frames.T_world_sde_bo);
  message.T_sde_to = to_ros(frames.T_sde_to);
  message.T_world_ref = to_ros(frames.T_world_ref);
  message.T_world_ref_o = to_ros(frames.T_world_ref_o);
  message.T_world_cam = to_ros(frames.T_world_cam);
  message.T_world_cam_cl = to_ros(frames.T_world_cam_cl);
  message.T_world_cam_pre_cl = to_ros(frames.T_world_cam_pre_cl);
  message.twist_world_ref = to_ros(status.twist_world_ref);
  message.connected = status.connected;
  message.ready = status.ready;
  message.started = status.started;
  message.engaged = status.engaged;
  message.clutched = status.clutched;
  message.camera_clutched = status.camera_clutched;
  message.camera_locked = status.camera_locked;
  message.forces_on = status.forces_on;
  message.follows_partner = status.follows_partner;
  message.at_limit = status.at_limit;
  message.fault = fault_of(status);
  message.mode = state::name_of(status.mode);
  message.world_rotation = status.rotation == state::RotationReference::world;
  message.buttons = status.buttons;
  message.jaw_hand = status.jaw_hand;
  message.jaw_tool = status.jaw_tool;
  message.jaw_follows = status.jaw_follows;
  message.linear_stiffness = to_ros(status.gains.linear_stiffness);
  message.linear_damping = to_ros(status.gains.linear_damping);
  message.angular_stiffness = to_ros(status.gains.angular_stiffness);
  message.angular_damping = to_ros(status.gains.angular_damping);
  message.haptic_linear_stiffness = to_ros(status.hand_gains.linear_stiffness);
  message.haptic_linear_damping = to_ros(status.hand_gains.linear_damping);
  message.haptic_angular_stiffness = to_ros(status.hand_gains.angular_stiffness);
  message.haptic_angular_damping = to_ros(status.hand_gains.angular_damping);
  message.workspace_scaling = status.workspace_scaling;
  message.camera_scaling = status.camera_scaling;
  message.dominance = status.dominance;
  message.wrench_u_wanted = to_ros(status.wrench_u_wanted);
  message.wrench_u_written = to_ros(status.wrench_u_written);
}

void fill(const state::DeviceInfo& info, const state::DeviceStatus& status, std::int64_t steady_ns,
          ambf_msgs::DeviceRates& message) {
  message.name = info.name;
  message.driver = info.driver;
  message.effector = info.effector.valid() ? info.effector_name : std::string();
  message.connected = status.connected;
  message.real_time_priority = status.fifo;
  message.rate = status.rate_hz;
  message.sample_rate = status.sample_rate_hz;
  message.cycles = status.cycle;
  message.samples = status.sample;
  fill(status.period, message.period);
  fill(status.set_point_age, message.set_point_age);
  fill(status.sample_to_force, message.sample_to_force);
  message.slips = status.slips;
  message.faults = status.faults;
  message.refused_samples = status.refused_samples;
  message.fault = fault_of(status);
  const bool faulty = status.fault != state::DeviceFault::none;
  message.fault_seconds = faulty ? base::to_seconds(steady_ns - status.fault_since_ns) : 0.0;
  message.message = info.message;
}

void fill(const state::DeviceInfo& info, const state::DeviceStatus& status, const std::string& topic,
          ambf_msgs::DeviceInfo& message) {
  message.name = info.name;
  message.hardware_name = info.hardware_name;
  message.driver = info.driver;
  message.topic = topic;
  message.effector = info.effector_name;
  message.multibody = info.multibody;
  message.cameras = info.camera_names;
  message.color[0] = static_cast<float>(info.color.x);
  message.color[1] = static_cast<float>(info.color.y);
  message.color[2] = static_cast<float>(info.color.z);
  message.orientation = info.orientation;
  message.force = info.force;
  message.torque = info.torque;
  message.gripper = info.gripper;
  message.buttons = info.buttons;
  message.rate = info.rate_hz;
  message.max_force = info.device_max_force_N;
  message.max_torque = info.device_max_torque_Nm;
  message.max_stiffness = info.device_max_stiffness_N_m;
  message.clutch_button = info.button_mapping.clutch;
  message.camera_clutch_button = info.button_mapping.camera_clutch;
  message.gripper_button = info.button_mapping.gripper;
  message.next_mode_button = info.button_mapping.next_mode;
  message.previous_mode_button = info.button_mapping.previous_mode;
  message.message = info.message;
  message.parameters.resize(static_cast<std::size_t>(state::DeviceParameter::count));
  for (std::size_t i = 0; i < message.parameters.size(); ++i) {
    const auto parameter = static_cast<state::DeviceParameter>(i);
    const state::DeviceParameterInfo& row = state::info_of(parameter);
    ambf_msgs::DeviceParameter& out = message.parameters[i];
    out.name = row.name;
    out.unit = row.unit;
    out.by_axis = row.by_axis;
    out.min = row.min;
    out.max = row.max;
    out.value = to_ros(state::value_of(status, parameter));
  }
}

std::string read(const ambf_msgs::ObjectCmd& message, HandCommand& command) {
  command.has_target = message.enable_position_controller != 0;
  // Judged as the same command to a body.
  state::RigidBodyCommand judged;
  judged.type = command.has_target ? state::CartesianCommandType::position : state::CartesianCommandType::force;
  judged.T_world_body = from_ros(message.pose);
  judged.wrench_world = {from_ros(message.wrench.force), from_ros(message.wrench.torque)};
  std::string refusal = state::check(judged);
  command.T_world_target = judged.T_world_body;
  command.wrench_world = judged.wrench_world;
  return refusal;
}

state::DeviceParameter find_parameter(const std::string& name) {
  std::size_t i = 0;
  constexpr auto kCount = static_cast<std::size_t>(state::DeviceParameter::count);
  while (i < kCount && name != state::info_of(static_cast<state::DeviceParameter>(i)).name) ++i;
  return static_cast<state::DeviceParameter>(i);
}

std::string read_value(const std::vector<double>& list, state::DeviceParameter parameter, math::Vec3& value) {
  const bool by_axis = state::info_of(parameter).by_axis;
  if (list.size() != 1 && !(by_axis && list.size() == 3)) {
    return std::string("value has ") + std::to_string(list.size()) + " numbers; expected " +
           (by_axis ? "one, or three by axis" : "one");
  }
  value = list.size() == 3 ? math::Vec3{list[0], list[1], list[2]} : math::Vec3{list[0], list[0], list[0]};
  return {};
}

}  // namespace ambf::ros_comm
