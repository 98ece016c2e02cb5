// A CRTK arm without ROS and without a world, for tests of ArmControl.
#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "crtk/arm_control.h"
#include "crtk/arm_layout.h"

namespace ambf::crtk::rig {

// A PSM whose joints follow their set-points at once.
class Arm {
 public:
  explicit Arm(const std::string& more = {}) : control(description(more)) { update(0.0); }

  static adf::CrtkArm description(const std::string& more = {}) {
    const auto read = adf::parse_crtk_arms(
        "crtk arms: {PSM1: {kinematics: PSM, base: base, max velocity: [1, 1, 0.2, 1, 1, 1], "
        "max acceleration: [2, 2, 1, 2, 2, 2]" +
            more + "}}",
        "arms.yaml");
    EXPECT_TRUE(read.diagnostics.empty());
    return read.arms.at(0);
  }
  void update(double seconds) {
    time_s += seconds;
    obey_news();
    for (int i = 0; i < std::lround(seconds / 1e-3); ++i) {
      advance(motion, limits, at, 1e-3);
      at = motion.position;
    }
    show();
  }
  // What the simulation does before a step, and what it shows in a frame.
  void obey_news() {
    const auto command = control.take_command();
    if (!command) return;
    active = true;
    obey(motion, limits, *command, at);
    if (motion.arm.order.mode != Mode::effort) at = motion.position;
  }
  void show() {
    Measured measured;
    measured.valid = true;
    measured.position.assign(at.begin(), at.begin() + 7);
    measured.velocity = velocities;
    measured.effort = efforts;
    measured.motion = motion;
    measured.active = active;
    measured.stands = stands;
    measured.sim_time = time_s;
    measured.epoch = epoch;
    measured.stamp_ns = 1 + static_cast<std::int64_t>(time_s * 1e9);
    control.update(measured, now_ns += 3'000'000'000);
  }
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds * 100); ++i) update(0.01);
  }
  void home() {
    control.state_command("home");
    run(5.0);
    ASSERT_TRUE(control.homed());
    control.take_events();
  }
  std::vector<bool> busy_events() {
    std::vector<bool> seen;
    for (const Event& event : control.take_events()) {
      if (event.kind == Event::Kind::state) seen.push_back(event.busy);
    }
    return seen;
  }

  ArmControl control;
  ArmMotion motion;
  ArmLimits limits = limits_of(description());
  Axes at{};
  bool active = false;
  Joints efforts = Joints(7, 0.0), velocities = Joints(7, 0.0);  // the jaw's last
  bool stands = false;
  double time_s = 0.0;
  std::uint64_t epoch = 1;
  std::int64_t now_ns = 0;
};

}  // namespace ambf::crtk::rig
