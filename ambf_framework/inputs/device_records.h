// What a cycle of an input device saw of the world around it, and the set-point that it posted.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "inputs/records.h"
#include "state/devices.h"
#include "state/set_point.h"

namespace ambf::inputs {

// As the driver gave it: before it is checked, in U.
struct RawSample {
  std::int64_t stamp_ns = 0;
  math::Pose T_u_tip;
  double jaw = 0.0;
  std::uint64_t buttons = 0;
  bool has_jaw = false, ready = true;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.stamp_ns), a(r.T_u_tip), a(r.jaw), a(r.buttons), a(r.has_jaw), a(r.ready);
  }
};

struct DeviceSetting {
  state::DeviceParameter parameter{};
  math::Vec3 value;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.parameter), a(r.value);
  }
};

// What the device moves from the cycle on whose record follows; `body` invalid: nothing.
struct BindingRecord {
  static constexpr Type kType = Type::binding;
  state::ObjectId body;
  state::EffectorGains own_gains;
  bool own_multibody = false;
  std::vector<state::ObjectId> jaw_joints, cameras;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.body), a(r.own_gains), a(r.own_multibody), a(r.jaw_joints), a(r.cameras);
  }
};

// What a client asks of the hand (DeviceAbility::push, pull_to).
struct DeviceExternal {
  std::int64_t posted_ns = 0;
  math::Wrench wrench_world;
  bool pulls = false;
  math::Pose T_world_target;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.posted_ns), a(r.wrench_world), a(r.pulls), a(r.T_world_target);
  }
};

struct CycleRecord {
  static constexpr Type kType = Type::cycle;
  enum class Reading : std::uint8_t { closed, sample, nothing_new, lost, count };

  std::uint64_t cycle = 0;
  std::int64_t now_ns = 0;
  std::uint64_t frame = 0;         // Frame::sequence of the newest one; 0: there was none
  std::uint16_t cameras_held = 0;  // bit n: the device moves its n-th camera
  bool forces = false;             // -e
  Reading reading = Reading::closed;
  std::optional<RawSample> sample;  // with Reading::sample
  std::string not_ready;            // why, while the newest sample is not
  std::optional<state::SetPoint> set_point;
  std::vector<DeviceSetting> settings;
  std::optional<DeviceExternal> external;

  template <class Self, class Archive>
  static void members(Self& r, Archive& a) {
    a(r.cycle), a(r.now_ns), a(r.frame), a(r.cameras_held), a(r.forces), a(r.reading), a(r.sample);
    a(r.not_ready), a(r.set_point), a(r.settings), a(r.external);
  }
};

}  // namespace ambf::inputs
