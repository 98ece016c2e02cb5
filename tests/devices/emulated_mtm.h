// A surgeon's hand on a master (MTM): seven joints with inertia and friction, moved by the efforts of the forces that
// the device is sent and by the arm of its operator, a spring and damper that draws the tip to where the operator wants
// it. Nothing is played back: a force that is wrong moves the hand away. It feeds and reads the driver's double of a
// User. One thread. SI units.
#pragma once

#include <algorithm>
#include <cmath>

#include "dvrk_arm/mtm.h"
#include "tests/devices/session_rig.h"

namespace ambf::devices::testing {

class EmulatedMtm {
 public:
  explicit EmulatedMtm(const dvrk_arm::MtmJoints& position) : position_(position) {
    // Mounted as PLUGINS 4 has it: quarter turns between the base, the operator's view and the tip. The hand rests in
    // the origin of U.
    mounting_.T_base_offset = {frames().T_base_tip.position, math::from_rpy(0.0, 0.0, -M_PI / 2)};
    mounting_.T_tip_offset.orientation = math::from_rpy(0.0, M_PI / 2, 0.0);
    goal_u = T_u_tip();
  }

  math::Pose goal_u;     // where the operator draws the hand
  double opening = 1.0;  // of the operator's fingers
  math::Vec3 tremor_u;   // of the operator, m

  math::Pose T_u_tip() const { return to_user_frame(mounting_, frames().T_base_tip); }

  // A millisecond, with the force that the device has been sent.
  void step(User& user) {
    constexpr int kParts = 4;
    for (int i = 0; i < kParts; ++i) move(user.driver.written, Session::kStep_s / kParts);
    user.driver.next.T_u_tip = T_u_tip();
    user.driver.next.has_jaw = true;
    user.driver.next.jaw = opening;
  }

 private:
  static constexpr dvrk_arm::MtmJoints kInertia{0.08, 0.08, 0.04, 0.01, 0.004, 0.003, 0.001};   // kg m^2
  static constexpr dvrk_arm::MtmJoints kFriction{0.05, 0.05, 0.03, 0.01, 0.004, 0.003, 0.001};  // N m s/rad
  static constexpr double kArm_N_m = 400.0, kArm_Ns_m = 20.0, kWrist_Nm = 0.6, kWrist_Nms = 0.1;

  dvrk_arm::MtmFrames frames() const { return dvrk_arm::mtm_frames(position_); }

  void move(const math::Wrench& sent_u, double h) {
    const dvrk_arm::MtmFrames at = frames();
    math::Twist tip;  // in the base's axes
    for (std::size_t i = 0; i < dvrk_arm::kMtmJoints; ++i) {
      const math::Vec3 lever = at.T_base_tip.position - at.origin[i];
      tip.linear += cross(at.axis[i], lever) * velocity_[i];
      tip.angular += at.axis[i] * velocity_[i];
    }
    const math::Pose hand = to_user_frame(mounting_, at.T_base_tip);
    const math::Vec3 turn_u = math::log(goal_u.orientation * inverse(hand.orientation));
    math::Wrench arm =
        to_base_axes(mounting_, {(goal_u.position + tremor_u - hand.position) * kArm_N_m, turn_u * kWrist_Nm});
    arm.force += tip.linear * -kArm_Ns_m;
    arm.torque += tip.angular * -kWrist_Nms;

    dvrk_arm::MtmJoints motors = dvrk_arm::mtm_efforts(at, to_base_axes(mounting_, sent_u));
    motors[3] += dvrk_arm::mtm_platform_effort(position_, velocity_);
    motors = dvrk_arm::mtm_bounded(motors);
    const dvrk_arm::MtmJoints operator_efforts = dvrk_arm::mtm_efforts(at, arm);
    for (std::size_t i = 0; i < dvrk_arm::kMtmJoints; ++i) {
      velocity_[i] += (motors[i] + operator_efforts[i] - kFriction[i] * velocity_[i]) * (h / kInertia[i]);
      position_[i] += velocity_[i] * h;
    }
  }

  DriverRequest mounting_;
  dvrk_arm::MtmJoints position_, velocity_{};
};

}  // namespace ambf::devices::testing
