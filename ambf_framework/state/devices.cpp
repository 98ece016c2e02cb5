#include "state/devices.h"

#include <array>
#include <cstddef>
#include <cstdio>

#include "base/bounds.h"

namespace ambf::state {

namespace {

constexpr double kMaxGain = base::kMaxGain;
constexpr double kMaxScaling = 1e3;
constexpr double kMaxForce = base::kMaxForce;

constexpr std::array<DeviceParameterInfo, static_cast<std::size_t>(DeviceParameter::count)> kParameters = {{
    {"linear stiffness", "N/m", true, 0.0, kMaxGain},
    {"linear damping", "N s/m", true, 0.0, kMaxGain},
    {"angular stiffness", "N m/rad", true, 0.0, kMaxGain},
    {"angular damping", "N m s/rad", true, 0.0, kMaxGain},
    {"haptic linear", "N/m", true, 0.0, kMaxGain},
    {"haptic angular", "N m/rad", true, 0.0, kMaxGain},
    {"haptic linear damping", "N s/m", true, 0.0, kMaxGain},
    {"haptic angular damping", "N m s/rad", true, 0.0, kMaxGain},
    {"workspace scaling", "", false, 1e-3, kMaxScaling},
    {"camera scaling", "", false, 0.0, kMaxScaling},
    {"deadband", "N", false, 0.0, kMaxForce},
    {"max force", "N", false, 0.0, kMaxForce},
    {"max torque", "N m", false, 0.0, kMaxForce},
    {"max jerk", "N/ms", false, 0.0, kMaxForce},
    {"dominance", "", false, 0.0, 1.0},
    {"rotation reference", "", false, 0.0, 1.0},
    {"mode", "", false, 0.0, static_cast<double>(DeviceMode::count) - 1.0},
    {"scheme", "", false, 0.0, static_cast<double>(SharingScheme::count) - 1.0},
}};

constexpr std::array<const char*, static_cast<std::size_t>(DeviceMode::count)> kModes = {
    "clutch",          "jaw",           "linear stiffness", "angular stiffness", "linear damping",
    "angular damping", "haptic linear", "haptic angular"};

constexpr std::array<const char*, static_cast<std::size_t>(SharingScheme::count)> kSchemes = {
    "as in the files", "siso", "siao", "aiso", "aiao", "sino", "aino"};

constexpr std::array<const char*, static_cast<std::size_t>(DeviceFault::count)> kFaults = {
    "none",
    "the hardware does not answer",
    "the hardware is gone",
    "no sample arrives",
    "samples are no numbers or no rotations",
    "the hand jumped",
    "samples go back in time",
    "the device is not ready",
    "its effector is not loaded",
    "the simulation is paused",
    "the simulation was reset or restored",
    "its effector is frozen",
    "the simulation stands still"};

}  // namespace

const char* name_of(DeviceMode mode) { return mode < DeviceMode::count ? kModes[static_cast<std::size_t>(mode)] : ""; }

const char* name_of(SharingScheme scheme) {
  return scheme < SharingScheme::count ? kSchemes[static_cast<std::size_t>(scheme)] : "";
}

const char* name_of(DeviceFault fault) {
  return fault < DeviceFault::count ? kFaults[static_cast<std::size_t>(fault)] : "";
}

std::string thread_name_of(unsigned device) { return "device " + std::to_string(device); }

const DeviceParameterInfo& info_of(DeviceParameter parameter) {
  return kParameters.at(static_cast<std::size_t>(parameter));
}

std::string check(DeviceParameter parameter, const math::Vec3& value) {
  if (parameter >= DeviceParameter::count) return "there is no such parameter";
  const DeviceParameterInfo& info = info_of(parameter);
  // Written so that NaN fails.
  const auto fits = [&info](double x) { return x >= info.min && x <= info.max; };
  if (fits(value.x) && (!info.by_axis || (fits(value.y) && fits(value.z)))) return {};
  char text[128];
  std::snprintf(text, sizeof text, "%s must be within %g and %g %s", info.name, info.min, info.max, info.unit);
  return text;
}

math::Vec3 value_of(const DeviceStatus& status, DeviceParameter parameter) {
  switch (parameter) {
    case DeviceParameter::linear_stiffness: return status.gains.linear_stiffness;
    case DeviceParameter::linear_damping: return status.gains.linear_damping;
    case DeviceParameter::angular_stiffness: return status.gains.angular_stiffness;
    case DeviceParameter::angular_damping: return status.gains.angular_damping;
    case DeviceParameter::haptic_linear: return status.hand_gains.linear_stiffness;
    case DeviceParameter::haptic_angular: return status.hand_gains.angular_stiffness;
    case DeviceParameter::haptic_linear_damping: return status.hand_gains.linear_damping;
    case DeviceParameter::haptic_angular_damping: return status.hand_gains.angular_damping;
    case DeviceParameter::workspace_scaling: return {status.workspace_scaling, 0.0, 0.0};
    case DeviceParameter::camera_scaling: return {status.camera_scaling, 0.0, 0.0};
    case DeviceParameter::deadband: return {status.limits.deadband_N, 0.0, 0.0};
    case DeviceParameter::max_force: return {status.limits.max_force_N, 0.0, 0.0};
    case DeviceParameter::max_torque: return {status.limits.max_torque_Nm, 0.0, 0.0};
    case DeviceParameter::max_jerk: return {status.limits.max_jerk_N_per_ms, 0.0, 0.0};
    case DeviceParameter::dominance: return {status.dominance, 0.0, 0.0};
    case DeviceParameter::rotation_reference: return {static_cast<double>(status.rotation), 0.0, 0.0};
    case DeviceParameter::mode: return {static_cast<double>(status.mode), 0.0, 0.0};
    case DeviceParameter::scheme: return {static_cast<double>(status.scheme), 0.0, 0.0};
    case DeviceParameter::count: break;
  }
  return {};
}

}  // namespace ambf::state
