#include "devices/drivers/rate_pose.h"

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "math/rotation.h"

namespace ambf::devices {

namespace {

constexpr double kMaxGap_s = 0.1;  // a thread that was held up does not make the tool leap

}  // namespace

double RatePose::rate(double deflection) const {
  const double bounded = std::clamp(deflection, -1.0, 1.0);
  const double excess = std::abs(bounded) - settings_.dead_zone;
  return excess > 0.0 ? std::copysign(excess / (1.0 - settings_.dead_zone), bounded) : 0.0;
}

const math::Pose& RatePose::advance(const Deflections& deflections, std::int64_t now_ns) {
  const double dt = last_ns_ == 0 ? 0.0 : std::clamp(base::to_seconds(now_ns - last_ns_), 0.0, kMaxGap_s);
  last_ns_ = now_ns;
  const math::Vec3 linear{rate(deflections[0]), rate(deflections[1]), rate(deflections[2])};
  const math::Vec3 angular{rate(deflections[3]), rate(deflections[4]), rate(deflections[5])};
  T_u_tip_.position += settings_.speed_m_s * dt * linear;
  if (angular != math::Vec3{}) {
    T_u_tip_.orientation = math::normalized(math::exp(settings_.turn_rad_s * dt * angular) * T_u_tip_.orientation);
  }
  return T_u_tip_;
}

RateAxes RateAxes::read(Options& options, const std::array<const char*, kRateAxes>& defaults,
                        const std::vector<std::string>& names) {
  constexpr std::array<const char*, kRateAxes> kNames = {"x", "y", "z", "roll", "pitch", "yaw"};
  RateAxes axes;
  for (std::size_t i = 0; i < kRateAxes; ++i) {
    axes.sources[i] = options.axis(std::string("axes/") + kNames[i], defaults[i], names);
  }
  return axes;
}

RatePose::Settings read_rate_settings(Options& options, const RatePose::Settings& defaults) {
  constexpr double kMaxSpeed_m_s = 10.0, kMaxTurn_rad_s = 20.0, kMaxDeadZone = 0.9;
  RatePose::Settings settings;
  settings.speed_m_s = options.number("speed", defaults.speed_m_s, 0.0, kMaxSpeed_m_s);
  settings.turn_rad_s = options.number("turn speed", defaults.turn_rad_s, 0.0, kMaxTurn_rad_s);
  settings.dead_zone = options.number("dead zone", defaults.dead_zone, 0.0, kMaxDeadZone);
  return settings;
}

}  // namespace ambf::devices
