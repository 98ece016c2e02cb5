#include "devices/detail/live_settings.h"

#include <algorithm>

#include "devices/detail/sharing.h"
#include "devices/hand_force.h"

namespace ambf::devices {

using math::Vec3;
using state::DeviceMode;
using state::DeviceParameter;
using state::EffectorGains;
using state::SharingScheme;

namespace {

// Steps of the original's modes: N/m, N m/rad, N s/m, N m s/rad; of the jaw's opening 0.1.
constexpr double kLinearStep = 10.0, kAngularStep = 1.0, kDampingStep = 1.0, kHapticLinearStep = 5.0,
                 kHapticAngularStep = 1.0, kJawStep = 0.1;

Vec3 changed(const Vec3& gains, double step) {
  return {std::max(0.0, gains.x + step), std::max(0.0, gains.y + step), std::max(0.0, gains.z + step)};
}

}  // namespace

LiveSettings::LiveSettings(const DeviceSettings& settings, const DriverTraits& traits)
    : file_(settings),
      traits_(traits),
      limits_(settings.limits),
      workspace_scaling_(settings.workspace_scaling),
      camera_scaling_(settings.camera_scaling),
      dominance_(settings.dominance),
      dominance_goal_(settings.dominance) {
  use_linear_gains(file_.controller);
  use_angular_gains(file_.controller);
  use_hand_gains_of_file();
}

void LiveSettings::bind(const EffectorBinding& binding) {
  own_ = binding.own_gains;
  if (!file_.linear_given) use_linear_gains(own_);
  if (!file_.angular_given) use_angular_gains(own_);
  if (scheme_ != SharingScheme::as_in_files) use_scheme();
}

void LiveSettings::use_linear_gains(const EffectorGains& gains) {
  effector_.linear_stiffness = gains.linear_stiffness;
  effector_.linear_damping = gains.linear_damping;
}

void LiveSettings::use_angular_gains(const EffectorGains& gains) {
  effector_.angular_stiffness = gains.angular_stiffness;
  effector_.angular_damping = gains.angular_damping;
}

void LiveSettings::use_hand_gains_of_file() {
  hand_is_ratio_ = file_.haptic_is_ratio;
  hand_ = {file_.haptic_linear, file_.haptic_linear_damping, file_.haptic_angular, file_.haptic_angular_damping};
}

// Where the file gives an axis no gain, a scheme that needs it has the effector's own, and the hand feels what pulls
// the tool.
void LiveSettings::use_scheme() {
  use_linear_gains(file_.linear_given ? file_.controller : own_);
  use_angular_gains(file_.angular_given ? file_.controller : own_);
  use_hand_gains_of_file();
  if (scheme_ == SharingScheme::as_in_files) return;
  effector_ = completed(effector_, own_);
  const UserShare share = share_of(scheme_, second_);
  hand_ = on_axes(completed(hand_stiffness(), effector_), share.feels);
  hand_is_ratio_ = false;
  effector_ = on_axes(effector_, share.moves);
}

void LiveSettings::set(DeviceParameter parameter, const Vec3& value) {
  // What is set is stiffness: shares of the effector's gains end where somebody sets the hand's own.
  if (parameter >= DeviceParameter::haptic_linear && parameter <= DeviceParameter::haptic_angular_damping &&
      hand_is_ratio_) {
    hand_ = hand_gains();
    hand_is_ratio_ = false;
  }
  switch (parameter) {
    case DeviceParameter::linear_stiffness: effector_.linear_stiffness = value; break;
    case DeviceParameter::linear_damping: effector_.linear_damping = value; break;
    case DeviceParameter::angular_stiffness: effector_.angular_stiffness = value; break;
    case DeviceParameter::angular_damping: effector_.angular_damping = value; break;
    case DeviceParameter::haptic_linear: hand_.linear_stiffness = value; break;
    case DeviceParameter::haptic_angular: hand_.angular_stiffness = value; break;
    case DeviceParameter::haptic_linear_damping: hand_.linear_damping = value; break;
    case DeviceParameter::haptic_angular_damping: hand_.angular_damping = value; break;
    case DeviceParameter::workspace_scaling: workspace_scaling_ = value.x; break;
    case DeviceParameter::camera_scaling: camera_scaling_ = value.x; break;
    case DeviceParameter::deadband: limits_.deadband_N = value.x; break;
    case DeviceParameter::max_force: limits_.max_force_N = value.x; break;
    case DeviceParameter::max_torque: limits_.max_torque_Nm = value.x; break;
    case DeviceParameter::max_jerk: limits_.max_jerk_N_per_ms = value.x; break;
    case DeviceParameter::dominance: dominance_goal_ = value.x; break;
    case DeviceParameter::rotation_reference:
      rotation_ = value.x < 0.5 ? state::RotationReference::camera : state::RotationReference::world;
      break;
    case DeviceParameter::mode: mode_ = static_cast<DeviceMode>(value.x); break;
    case DeviceParameter::scheme:
      scheme_ = static_cast<SharingScheme>(value.x);
      second_ = value.y > 0.5;
      use_scheme();
      break;
    case DeviceParameter::count: break;
  }
}

void LiveSettings::advance(double dt) {
  const double step = kDominanceRate * dt;
  dominance_ += std::clamp(dominance_goal_ - dominance_, -step, step);
}

void LiveSettings::press(std::uint64_t buttons) {
  const std::uint64_t pressed = buttons & ~buttons_;
  buttons_ = buttons;
  constexpr int kModes = static_cast<int>(DeviceMode::count);
  const int mode = static_cast<int>(mode_);
  if (down(pressed, file_.buttons.next_mode)) mode_ = static_cast<DeviceMode>((mode + 1) % kModes);
  if (down(pressed, file_.buttons.previous_mode)) mode_ = static_cast<DeviceMode>((mode + kModes - 1) % kModes);
  if (down(pressed, file_.buttons.clutch)) change(1.0);
  if (down(pressed, file_.buttons.camera_clutch)) change(-1.0);
}

void LiveSettings::change(double sign) {
  const auto by = [&](DeviceParameter parameter, const Vec3& now, double step) {
    set(parameter, changed(now, sign * step));
  };
  switch (mode_) {
    case DeviceMode::clutch:
    case DeviceMode::count: break;
    case DeviceMode::jaw: jaw_offset_ = std::clamp(jaw_offset_ + sign * kJawStep, -0.5, 0.5); break;
    case DeviceMode::linear_stiffness:
      by(DeviceParameter::linear_stiffness, effector_.linear_stiffness, kLinearStep);
      break;
    case DeviceMode::angular_stiffness:
      by(DeviceParameter::angular_stiffness, effector_.angular_stiffness, kAngularStep);
      break;
    case DeviceMode::linear_damping: by(DeviceParameter::linear_damping, effector_.linear_damping, kDampingStep); break;
    case DeviceMode::angular_damping:
      by(DeviceParameter::angular_damping, effector_.angular_damping, kDampingStep);
      break;
    case DeviceMode::haptic_linear:
      by(DeviceParameter::haptic_linear, hand_gains().linear_stiffness, kHapticLinearStep);
      break;
    case DeviceMode::haptic_angular:
      by(DeviceParameter::haptic_angular, hand_gains().angular_stiffness, kHapticAngularStep);
      break;
  }
}

EffectorGains LiveSettings::effector_gains() const {
  const double share = 2.0 * dominance_;  // 0.5: the file's gains
  EffectorGains out;
  out.linear_stiffness = effector_.linear_stiffness * share;
  out.linear_damping = effector_.linear_damping * share;
  if (!traits_.orientation) return out;
  out.angular_stiffness = effector_.angular_stiffness * share;
  out.angular_damping = effector_.angular_damping * share;
  return out;
}

// In N/m and N m/rad, also where they are shares of the tool's.
EffectorGains LiveSettings::hand_stiffness() const {
  EffectorGains out = hand_;
  if (hand_is_ratio_) {
    out.linear_stiffness = scaled(hand_.linear_stiffness, effector_.linear_stiffness);
    out.linear_damping = scaled(hand_.linear_stiffness, effector_.linear_damping);
    out.angular_stiffness = scaled(hand_.angular_stiffness, effector_.angular_stiffness);
    out.angular_damping = scaled(hand_.angular_stiffness, effector_.angular_damping);
  }
  return out;
}

EffectorGains LiveSettings::hand_gains() const {
  EffectorGains out = hand_stiffness();
  if (!traits_.orientation) out.angular_stiffness = out.angular_damping = {};
  return bounded(out, traits_.max_stiffness_N_m, workspace_scaling_);
}

state::HandLimits LiveSettings::limits() const { return combined(limits_, traits_.max_force_N, traits_.max_torque_Nm); }

}  // namespace ambf::devices
