// Turns the axes of a device that springs back to its middle (gamepad, space mouse, keys) into a pose: deflection is
// velocity, the pose is its integral. Within the dead zone nothing moves, so that a worn stick causes no drift. One
// thread; allocates nothing. C++17.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "devices/drivers/options.h"
#include "math/types.h"

namespace ambf::devices {

// Along and about the axes of U: x (towards the operator), y (right), z (up), roll, pitch, yaw (right-handed about x,
// y, z).
constexpr std::size_t kRateAxes = 6;
using Deflections = std::array<double, kRateAxes>;  // -1 .. 1

class RatePose {
 public:
  struct Settings {
    double speed_m_s = 0.1, turn_rad_s = 1.0;  // at full deflection
    double dead_zone = 0.0;                    // share of the deflection, below 1
  };
  RatePose() = default;
  explicit RatePose(const Settings& settings) : settings_(settings) {}

  // The pose at that time (steady clock), after moving at these deflections since the call before. The first call
  // moves nothing; nor does a gap of over 0.1 s count for more than that.
  const math::Pose& advance(const Deflections& deflections, std::int64_t now_ns);
  const math::Pose& pose() const { return T_u_tip_; }
  void shift(const math::Vec3& motion_u) { T_u_tip_.position += motion_u; }
  // The next call moves nothing: the time until then is lost.
  void pause() { last_ns_ = 0; }

 private:
  double rate(double deflection) const;

  Settings settings_;
  math::Pose T_u_tip_;
  std::int64_t last_ns_ = 0;  // 0: not started
};

// Which axis of the hardware moves each of the six: options axes/x .. axes/yaw, the defaults in this order.
struct RateAxes {
  std::array<SourceAxis, kRateAxes> sources;

  static RateAxes read(Options& options, const std::array<const char*, kRateAxes>& defaults,
                       const std::vector<std::string>& names);
  template <class Value>
  Deflections deflections(const Value& value_of) const {
    Deflections out{};
    for (std::size_t i = 0; i < kRateAxes; ++i) {
      if (sources[i].number >= 0) out[i] = sources[i].sign * value_of(static_cast<unsigned>(sources[i].number));
    }
    return out;
  }
};

// Options `speed` (m/s), `turn speed` (rad/s) and `dead zone`.
RatePose::Settings read_rate_settings(Options& options, const RatePose::Settings& defaults);

}  // namespace ambf::devices
