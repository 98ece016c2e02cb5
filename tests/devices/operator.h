// Somebody who works with a tool through a device: an emulated master in the hand, eyes on the picture. Plans a motion
// of the tool, moves the hand along, and corrects by what is seen. One thread.
#pragma once

#include <algorithm>
#include <cmath>

#include "tests/devices/emulated_mtm.h"

namespace ambf::devices::testing {

class Operator {
 public:
  Operator(Session& session, User& user, const dvrk_arm::MtmJoints& joints, double phase)
      : session_(session), user_(user), mtm_(joints), phase_(phase) {
    mtm_.opening = 0.7 + 0.1 * std::sin(phase);
    mtm_.step(user_);
  }
  // Once the device is engaged, the hand at rest.
  void begin() { wanted_ = goal_ = tool(); }

  void aim(const math::Pose& tool_world, double jaw, double seconds) {
    from_ = wanted_;
    goal_ = tool_world;
    jaw_from_ = mtm_.opening;
    jaw_goal_ = jaw;
    way_s_ = 0.0;
    seconds_ = seconds;
  }
  void step(double now_s) {
    const math::Pose before = wanted_;
    way_s_ = std::min(way_s_ + Session::kStep_s, seconds_);
    const double u = seconds_ > 0.0 ? way_s_ / seconds_ : 1.0, way = u * u * (3.0 - 2.0 * u);
    if (seconds_ > 0.0) {
      const math::Vec3 turn = math::log(goal_.orientation * inverse(from_.orientation));
      wanted_ = {from_.position + (goal_.position - from_.position) * way,
                 math::normalized(math::exp(turn * way) * from_.orientation)};
      mtm_.opening = jaw_from_ + (jaw_goal_ - jaw_from_) * way;
      // What is planned, and part of what is seen to be missing.
      const double seen = 3.0 * Session::kStep_s;
      draw(wanted_.position - before.position + (wanted_.position - tool().position) * seen,
           math::log(wanted_.orientation * inverse(before.orientation)) +
               math::log(wanted_.orientation * inverse(tool().orientation)) * seen);
    }
    const double angle = 2.0 * M_PI * 8.0 * now_s + phase_;  // physiological tremor
    mtm_.tremor_u = math::Vec3{std::sin(angle), std::cos(1.1 * angle), std::sin(0.9 * angle)} * 2e-4;
    mtm_.step(user_);
    force_N = std::max(force_N, norm(user_.driver.written.force));
    torque_Nm = std::max(torque_Nm, norm(user_.driver.written.torque));
  }
  const math::Pose& tool() const { return session_.tool(user_); }
  const math::Pose& wanted() const { return wanted_; }

  double force_N = 0.0, torque_Nm = 0.0;  // largest that the hand was given

 private:
  void draw(const math::Vec3& by_world, const math::Vec3& turn_world) {
    const math::Quat R_u_world = inverse(session_.camera(user_).orientation);
    mtm_.goal_u.position += rotate(R_u_world, by_world) / user_.file.workspace_scaling;
    mtm_.goal_u.orientation = math::normalized(math::exp(rotate(R_u_world, turn_world)) * mtm_.goal_u.orientation);
  }

  Session& session_;
  User& user_;
  EmulatedMtm mtm_;
  const double phase_;
  math::Pose from_, wanted_, goal_;
  double jaw_from_ = 1.0, jaw_goal_ = 1.0, way_s_ = 0.0, seconds_ = 0.0;
};

}  // namespace ambf::devices::testing
