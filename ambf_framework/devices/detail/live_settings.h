// A device's settings as they are now: what the device file says, what was set since, what buttons changed, and the
// gains that follow from these. Device's thread.
#pragma once

#include <cstdint>

#include "devices/device_settings.h"
#include "devices/driver.h"

namespace ambf::devices {

class LiveSettings {
 public:
  static constexpr double kDominanceRate = 2.0;  // a second: what a partner feels is no step

  LiveSettings(const DeviceSettings& settings, const DriverTraits& traits);

  // Gains of another effector count where the device file gives none.
  void bind(const EffectorBinding& binding);
  void set(state::DeviceParameter parameter, const math::Vec3& value);
  // Once a cycle: dominance approaches what was set.
  void advance(double dt);

  // Buttons that went down: modes change, and what the mode is about. Clutches: by clutch() and camera_clutch().
  void press(std::uint64_t buttons);
  bool clutch(std::uint64_t buttons) const {
    return mode_ == state::DeviceMode::clutch && down(buttons, file_.buttons.clutch);
  }
  bool camera_clutch(std::uint64_t buttons) const {
    return mode_ == state::DeviceMode::clutch && down(buttons, file_.buttons.camera_clutch);
  }
  static bool down(std::uint64_t buttons, int bit) { return bit >= 0 && bit < 64 && ((buttons >> bit) & 1) != 0; }

  state::EffectorGains effector_gains() const;  // with dominance
  state::EffectorGains hand_gains() const;      // within the device's
  state::HandLimits limits() const;
  double workspace_scaling() const { return workspace_scaling_; }
  double camera_scaling() const { return camera_scaling_; }
  double dominance() const { return dominance_; }
  double jaw_offset() const { return jaw_offset_; }
  state::RotationReference rotation() const { return rotation_; }
  state::SharingScheme scheme() const { return scheme_; }
  state::DeviceMode mode() const { return mode_; }
  const DeviceSettings& file() const { return file_; }

 private:
  void use_linear_gains(const state::EffectorGains& gains);
  void use_angular_gains(const state::EffectorGains& gains);
  void use_hand_gains_of_file();
  void use_scheme();
  state::EffectorGains hand_stiffness() const;
  void change(double sign);  // what the mode is about, by one step

  const DeviceSettings file_;
  const DriverTraits traits_;
  state::EffectorGains own_;  // of the effector, where the file gives none
  state::EffectorGains effector_, hand_;
  bool hand_is_ratio_ = false;
  state::HandLimits limits_;
  double workspace_scaling_, camera_scaling_, dominance_, dominance_goal_;
  double jaw_offset_ = 0.0;
  state::RotationReference rotation_ = state::RotationReference::camera;
  state::DeviceMode mode_ = state::DeviceMode::clutch;
  state::SharingScheme scheme_ = state::SharingScheme::as_in_files;
  bool second_ = false;  // of the two that share a tool
  std::uint64_t buttons_ = 0;
};

}  // namespace ambf::devices
