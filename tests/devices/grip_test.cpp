// A hand's opening and a tool's jaw, in lockstep: both meeting rules, that of the device (devices/jaw.h) and that of
// physics (model/effectors/live_jaws.cpp), together. The jaw never jumps, and follows in the end.
#include <gtest/gtest.h>

#include <cmath>

#include "adf/adf.h"
#include "tests/devices/session_rig.h"

namespace ambf::devices::testing {
namespace {

constexpr double kJawStart = 0.35 / 0.6;  // of the shipped grippers: 0.35 rad of 0 .. 0.6

class Grip : public ::testing::Test {
 protected:
  static scene::Model model() {
    const auto file =
        adf::load_model(AMBF_SOURCE_DIR "/ambf_models/descriptions/multi-bodies/puzzles/peg_transfer.yaml");
    scene::Model model = *file.model;
    model.cameras.push_back(watching_camera("main_camera", {0.9, 0.4, 1.5}, {0.1, 0.0, 1.0}));
    return model;
  }
  User& join(double opening) {
    scene::InputDevice device;
    device.root_link = "left_gripper";
    device.cameras = {"main_camera"};
    device.ramp_s = 0.05;
    device.buttons.clutch = 0;
    User& user = session_.join(device);
    user.driver.traits_.gripper = true;
    user.driver.next.has_jaw = true;
    user.driver.next.jaw = opening;
    return user;
  }
  // 0 closed .. 1 open, as commanded (by the file: where the joints are).
  double commanded() const {
    const auto structure = session_.simulation.structure();
    const std::uint32_t object = state::find(*structure, "JOINT left_gripper-jaw_a", state::ObjectKind::joint);
    const std::uint32_t slot = structure->objects[object].slot;
    const state::JointState& joint = session_.frame.joints[slot];
    const state::JointInfo& info = structure->joints[slot];
    const bool by_hand = joint.commanded_type == state::JointCommandType::position;
    return ((by_hand ? joint.commanded : joint.position) - info.lower) / (info.upper - info.lower);
  }
  // Evenly, in 0.2 s.
  void open(User& user, double to) {
    const double from = user.driver.next.jaw;
    constexpr int kCycles = 200;
    for (int i = 1; i <= kCycles; ++i) {
      user.driver.next.jaw = from + (to - from) * i / kCycles;
      iterate();
    }
  }
  void iterate() {
    session_.iterate();
    const double now = commanded();
    if (known_) largest_step_ = std::max(largest_step_, std::abs(now - last_));
    last_ = now;
    known_ = true;
  }
  void wait(double seconds) {
    for (int i = 0; i < static_cast<int>(seconds / Session::kStep_s); ++i) iterate();
  }

  mutable Session session_{model()};
  double last_ = 0.0, largest_step_ = 0.0;
  bool known_ = false;
};

TEST_F(Grip, SurvivesTheStartAClutchALossAndAPartner) {
  User& first = join(0.95);
  session_.run_until_all_engaged();
  wait(0.2);
  EXPECT_NEAR(commanded(), kJawStart, 0.02) << "a hand that is wide open at the start opens nothing";
  open(first, 0.1);
  EXPECT_NEAR(commanded(), 0.1, 0.01) << "it follows once it has met the jaw";

  first.press(0, true);
  open(first, 0.8);
  first.press(0, false);
  wait(0.2);
  EXPECT_NEAR(commanded(), 0.1, 0.01) << "after a clutch the hand has to meet it again";
  open(first, 0.05);
  EXPECT_NEAR(commanded(), 0.05, 0.01);

  first.driver.reading = Reading::lost;
  wait(0.2);
  first.driver.next.jaw = 1.0;
  Session::plug_in(first);
  wait(0.4);
  EXPECT_TRUE(first.status().engaged);
  EXPECT_NEAR(commanded(), 0.05, 0.01) << "and after a loss";
  open(first, 0.0);
  open(first, 0.5);
  EXPECT_NEAR(commanded(), 0.5, 0.01);

  session_.log.expect_warning("add up to more");  // of two: about its shaft the gripper is light
  User& second = join(0.0);
  session_.run_until_all_engaged();
  wait(0.2);
  EXPECT_NEAR(commanded(), 0.5, 0.01) << "a partner who comes changes nothing";
  open(second, 0.7);
  EXPECT_NEAR(commanded(), 0.7, 0.01) << "who moved last leads";
  open(first, 0.9);
  EXPECT_NEAR(commanded(), 0.9, 0.01) << "and so on";
  EXPECT_LT(largest_step_, 0.031) << "of the whole opening, in a step";
}

}  // namespace
}  // namespace ambf::devices::testing
