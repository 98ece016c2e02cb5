#include "devices/sample_check.h"

#include <cmath>

#include "base/clock.h"
#include "math/rotation.h"

namespace ambf::devices {

state::DeviceFault SampleCheck::check(Sample& sample) {
  constexpr double kMaxPosition_m = 100.0, kMaxNormError = 0.1;
  math::Pose& T = sample.T_u_tip;
  // Written so that NaN fails.
  const bool is_pose = norm(T.position) <= kMaxPosition_m && std::abs(norm(T.orientation) - 1.0) <= kMaxNormError;
  if (!is_pose || !std::isfinite(sample.jaw)) return state::DeviceFault::bad_sample;
  T.orientation = math::normalized(T.orientation);
  if (known_ && sample.stamp_ns < last_.stamp_ns) return state::DeviceFault::backward_stamp;

  const double seconds = base::to_seconds(sample.stamp_ns - last_.stamp_ns);
  const bool jumped =
      known_ && (norm(T.position - last_.T_u_tip.position) > kRoom_m + kMaxSpeed * seconds ||
                 norm(math::log(T.orientation * inverse(last_.T_u_tip.orientation))) > kRoom_rad + kMaxTurn * seconds);
  last_ = sample;
  known_ = true;
  return jumped ? state::DeviceFault::jump : state::DeviceFault::none;
}

}  // namespace ambf::devices
