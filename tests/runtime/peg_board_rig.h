// The peg board with its two grippers and tasks of the test's own, stepped by the test: rings are carried as a person
// would, by friction between jaws. One thread.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <string>

#include "runtime/local_simulation.h"
#include "state/tasks.h"
#include "tests/support/judged_log.h"

namespace ambf::runtime::test {

class PegBoard {
 public:
  enum Hand { left, right };
  static constexpr double kOpen = 0.22, kClosed = 0.0;  // rad, each jaw
  static constexpr double kAbove = 0.1;                 // m: no peg is in the way
  static constexpr double kWall = 0.009;                // m, from a ring's middle to the wall that is held
  static constexpr double kPin = 0.017;                 // m, of the gripper's pin above the middle of a ring it holds

  explicit PegBoard(const std::string& tasks);

  // In a straight line, the jaws pointing down; `after_step` sees every frame.
  void go(Hand hand, double x, double y, double z);
  void jaws(Hand hand, double angle_rad);
  void wait(unsigned steps);
  // Picks a ring by the wall at lower y, and lifts it.
  void pick(Hand hand, const std::string& ring);
  // Brings what a hand holds so to a place of the board's frame, without letting go.
  void bring(Hand hand, double x, double y);
  void let_go(Hand hand);

  const state::Frame& frame() const { return simulation.frame(); }
  const state::BodyState& body(const std::string& name) const;
  std::uint32_t slot(const std::string& body) const;
  const state::TaskState& task(std::uint32_t number = 0) const {
    return state::rows(frame(), state::task_kind().column).at(number);
  }

  JudgedLog log;
  LocalSimulation simulation;
  std::function<void(const state::Frame&)> after_step = [](const state::Frame&) {};

 private:
  struct Gripper {
    std::unique_ptr<state::CommandPort> port;
    math::Vec3 at;
    double opening = 0.35;
  };
  void step(unsigned steps);

  Gripper hands_[2];
};

}  // namespace ambf::runtime::test
