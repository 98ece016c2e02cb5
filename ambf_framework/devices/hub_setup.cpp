// From a block of the device file to settings and a driver.
#include "devices/driver_library.h"
#include "devices/hub.h"

namespace ambf::devices {

DeviceSettings settings_of(const scene::InputDevice& device) {
  DeviceSettings out;
  out.linear_given = device.controller_linear.given();
  out.angular_given = device.controller_angular.given();
  out.controller.linear_stiffness = device.controller_linear.p.value_or(math::Vec3{});
  out.controller.linear_damping = device.controller_linear.d.value_or(math::Vec3{});
  out.controller.angular_stiffness = device.controller_angular.p.value_or(math::Vec3{});
  out.controller.angular_damping = device.controller_angular.d.value_or(math::Vec3{});
  out.haptic_is_ratio = device.haptic_gain_kind == scene::HapticGainKind::ratio;
  out.haptic_linear = device.haptic_linear.p.value_or(out.haptic_linear);
  out.haptic_angular = device.haptic_angular.p.value_or(out.haptic_angular);
  out.haptic_linear_damping = device.haptic_linear.d.value_or(math::Vec3{});
  out.haptic_angular_damping = device.haptic_angular.d.value_or(math::Vec3{});
  out.limits = {device.deadband_N, device.max_force_N, device.max_torque_Nm, device.max_jerk_N_per_ms};
  out.workspace_scaling = device.workspace_scaling;
  out.camera_scaling = device.camera_scaling;
  out.dominance = device.dominance;
  out.ramp_s = device.ramp_s;
  out.on_loss = device.on_loss;
  out.buttons = device.buttons;
  out.joint_control = device.enable_joint_control;
  out.T_world_sde_bo = device.location.value_or(math::Pose{});
  out.R_sde_to = device.orientation_offset;
  out.T_base_bo = device.driver.T_base_offset.value_or(math::Pose{});
  out.T_e_to = device.driver.T_tip_offset.value_or(math::Pose{});
  return out;
}

DriverRequest request_of(const scene::InputDevice& device, const std::string& folder) {
  DriverRequest request;
  request.device = device.name;
  request.hardware_name = device.hardware_name;
  request.type = device.driver.type;
  request.options = device.driver.options;
  request.T_base_offset = device.driver.T_base_offset.value_or(math::Pose{});
  request.T_tip_offset = device.driver.T_tip_offset.value_or(math::Pose{});
  request.folder = folder;
  return request;
}

std::unique_ptr<Driver> make_driver(const DriverRequest& request, std::string& type, std::string& problem) {
  const DriverKind* kind = find_driver(request);
  if (kind == nullptr) {
    problem = why_no_driver(request);
    return nullptr;
  }
  type = kind->type;
  std::unique_ptr<Driver> driver = kind->make(request);
  if (driver == nullptr) problem = "the driver '" + type + "' cannot work with its options";
  return driver;
}

}  // namespace ambf::devices
