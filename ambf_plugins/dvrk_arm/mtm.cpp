#include "dvrk_arm/mtm.h"

#include <algorithm>
#include <cmath>

#include "math/rotation.h"

namespace ambf::dvrk_arm {

namespace {

// T_i = Rz(theta) Tz(d) Tx(a) Rx(alpha), theta = q + offset.
struct DhRow {
  double alpha, a, d, offset, max_effort;
};
constexpr double kQuarter = M_PI / 2;
constexpr std::array<DhRow, kMtmJoints> kRows = {{
    {kQuarter, 0.0, 0.0, -kQuarter, 1.8608},
    {0.0, 0.2794, 0.0, -kQuarter, 3.2166},
    {-kQuarter, 0.3645, 0.0, kQuarter, 1.9598},
    {kQuarter, 0.0, 0.1506, 0.0, 0.30901},
    {-kQuarter, 0.0, 0.0, 0.0, 0.096844},
    {kQuarter, 0.0, 0.0, -kQuarter, 0.096844},
    {0.0, 0.0, 0.0, kQuarter, 0.022876},
}};
constexpr math::Vec3 kX{1.0, 0.0, 0.0}, kZ{0.0, 0.0, 1.0};

// Of the platform, as dVRK's own null-space controller has them.
constexpr double kStiffness = 0.5, kDamping = 0.05;  // N m/rad, N m s/rad

}  // namespace

MtmFrames mtm_frames(const MtmJoints& position) {
  MtmFrames frames;
  math::Pose& T = frames.T_base_tip;
  for (std::size_t i = 0; i < kMtmJoints; ++i) {
    const DhRow& row = kRows[i];
    frames.origin[i] = T.position;
    frames.axis[i] = math::rotate(T.orientation, kZ);
    const math::Quat turned = math::from_axis_angle(kZ, position[i] + row.offset);
    T = T * math::Pose{math::rotate(turned, {row.a, 0.0, row.d}), turned * math::from_axis_angle(kX, row.alpha)};
  }
  T.orientation = math::normalized(T.orientation);
  return frames;
}

MtmJoints mtm_efforts(const MtmFrames& frames, const math::Wrench& wrench_base) {
  MtmJoints efforts{};
  for (std::size_t i = 0; i < kMtmJoints; ++i) {
    const math::Vec3 lever = frames.T_base_tip.position - frames.origin[i];
    efforts[i] = math::dot(frames.axis[i], wrench_base.torque + math::cross(lever, wrench_base.force));
  }
  return efforts;
}

double mtm_platform_effort(const MtmJoints& position, const MtmJoints& velocity) {
  // e = pi/2 - acos(v7 . v4x) is joint 6 itself, up to a quarter of a rotation.
  const double error = std::asin(std::sin(position[5]));
  const double effort = kStiffness * std::cos(position[4]) * error - kDamping * velocity[3];
  return std::clamp(effort, -kRows[3].max_effort, kRows[3].max_effort);
}

MtmJoints mtm_bounded(const MtmJoints& efforts) {
  MtmJoints bounded{};
  for (std::size_t i = 0; i < kMtmJoints; ++i) {
    bounded[i] = std::clamp(efforts[i], -kRows[i].max_effort, kRows[i].max_effort);
  }
  return bounded;
}

}  // namespace ambf::dvrk_arm
