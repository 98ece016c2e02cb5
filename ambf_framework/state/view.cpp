#include "state/view.h"

#include <algorithm>
#include <cmath>

namespace ambf::state {

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFarthest_m = 1e6;

}  // namespace

std::string check(const Optics& optics) {
  // Written so that NaN fails.
  constexpr double kRatio = Optics::kMaxRatio, kAside = Optics::kMaxAside;
  if (!(optics.focal_ratio >= 1.0 / kRatio && optics.focal_ratio <= kRatio))
    return "the focal lengths may differ by a factor of 100";
  if (!(std::abs(optics.axis_right) <= kAside && std::abs(optics.axis_down) <= kAside))
    return "the axis may be 10 heights of the picture away from its middle";
  if (!(std::abs(optics.skew) <= std::min(1.0, optics.focal_ratio)))
    return "the skew may be as much as the shorter focal length";
  return {};
}

std::string check(const Lens& lens) {
  // Written so that NaN fails.
  if (!(lens.near_m > 0.0 && lens.near_m < lens.far_m && lens.far_m <= kFarthest_m))
    return "clipping planes must be 0 < near < far <= 1e6 m";
  if (!(lens.field_of_view_rad > 0.0 && lens.field_of_view_rad < kPi)) return "field of view must be within 0 and pi";
  if (const std::string wrong = check(lens.optics); !wrong.empty()) return wrong;
  const bool width_used = lens.orthographic;
  if (!(lens.orthographic_width_m >= 0.0 && lens.orthographic_width_m <= kFarthest_m) ||
      (width_used && lens.orthographic_width_m == 0.0))
    return "the width of an orthographic view must be above 0, at most 1e6 m";
  if (!(std::abs(lens.eye_separation_m) <= kFarthest_m)) return "eye separation must be finite";
  if (!(lens.focal_length_m > 0.0 && lens.focal_length_m <= kFarthest_m)) return "focal length must be above 0";
  return {};
}

std::string check(const Beam& beam) {
  if (!(beam.cutoff_angle_rad >= 0.0 && beam.cutoff_angle_rad <= kPi)) return "cutoff angle must be within 0 and pi";
  if (!(beam.spot_exponent >= 0.0 && beam.spot_exponent <= 1e3)) return "spot exponent must be within 0 and 1000";
  for (const double part : {beam.attenuation_constant, beam.attenuation_linear, beam.attenuation_quadratic}) {
    if (!(part >= 0.0 && part <= 1e6)) return "attenuation must be within 0 and 1e6";
  }
  if (beam.shadow_quality < 0 || beam.shadow_quality > 5) return "shadow quality must be within 0 and 5";
  return {};
}

}  // namespace ambf::state
