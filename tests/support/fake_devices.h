// Input devices without hardware or threads: what each one is and does is set by the test; calls are recorded. One
// thread at a time.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "state/abilities/devices.h"

namespace ambf {

class FakeDevices : public state::DeviceAbility {
 public:
  struct Device {
    state::DeviceInfo info;
    state::DeviceStatus status;
  };
  struct SetCall {
    unsigned device;
    state::DeviceParameter parameter;
    math::Vec3 value;
  };
  std::vector<Device> devices;
  std::vector<SetCall> calls;  // of set(), accepted ones
  std::vector<std::pair<unsigned, math::Wrench>> pushes;
  std::vector<std::pair<unsigned, math::Pose>> pulls;
  bool forces_on = false;

  // One that is connected, engaged and without a fault.
  Device& add(const std::string& name) {
    Device device;
    device.info.name = name;
    device.info.driver = "scripted";
    device.info.rate_hz = 1000.0;
    device.info.source = static_cast<state::Source>(static_cast<unsigned>(state::Source::device_0) + devices.size());
    device.status.cycle = device.status.sample = 1;
    device.status.connected = device.status.ready = device.status.started = device.status.engaged = true;
    devices.push_back(std::move(device));
    return devices.back();
  }

  unsigned count() const override { return static_cast<unsigned>(devices.size()); }
  std::shared_ptr<const state::DeviceInfo> info(unsigned device) const override {
    return std::make_shared<state::DeviceInfo>(devices[device].info);
  }
  bool status(unsigned device, state::DeviceStatus& status) const override {
    if (device >= count() || devices[device].status.cycle == 0) return false;
    status = devices[device].status;
    return true;
  }
  // Accepted values of the mode, the rotations and the gains show in the status.
  std::string set(unsigned device, state::DeviceParameter parameter, const math::Vec3& value) override {
    std::string refusal = state::check(parameter, value);
    if (!refusal.empty()) return refusal;
    calls.push_back({device, parameter, value});
    state::DeviceStatus& status = devices[device].status;
    switch (parameter) {
      case state::DeviceParameter::linear_stiffness: status.gains.linear_stiffness = value; break;
      case state::DeviceParameter::linear_damping: status.gains.linear_damping = value; break;
      case state::DeviceParameter::angular_stiffness: status.gains.angular_stiffness = value; break;
      case state::DeviceParameter::angular_damping: status.gains.angular_damping = value; break;
      case state::DeviceParameter::haptic_linear: status.hand_gains.linear_stiffness = value; break;
      case state::DeviceParameter::haptic_angular: status.hand_gains.angular_stiffness = value; break;
      case state::DeviceParameter::dominance: status.dominance = value.x; break;
      case state::DeviceParameter::mode: status.mode = static_cast<state::DeviceMode>(value.x); break;
      case state::DeviceParameter::scheme: status.scheme = static_cast<state::SharingScheme>(value.x); break;
      case state::DeviceParameter::rotation_reference:
        status.rotation = static_cast<state::RotationReference>(value.x);
        break;
      default: break;
    }
    return {};
  }
  bool forces() const override { return forces_on; }
  void set_forces(bool on) override { forces_on = on; }
  void push(unsigned device, const math::Wrench& wrench_world) override { pushes.emplace_back(device, wrench_world); }
  void pull_to(unsigned device, const math::Pose& T_world_target) override {
    pulls.emplace_back(device, T_world_target);
  }
};

}  // namespace ambf
