// Our scenes do what docs/models.md says of them: they load without a warning, hold still, follow, drive, turn and
// grip.
#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/runtime/model_rig.h"

namespace ambf::runtime {
namespace {

using namespace test;
using state::JointCommandType;

constexpr const char* kFiles[] = {
    "robots/arm7.yaml",         "mechanisms/four_bar.yaml",  "mechanisms/stewart_platform.yaml",
    "grippers/two_finger.yaml", "puzzles/peg_transfer.yaml", "puzzles/cubes_300.yaml",
    "vehicles/toy_car.yaml"};

TEST(OwnScenes, LoadWithoutAWarning) {
  ModelRig rig(own_world());
  for (const char* file : kFiles) {
    const state::Outcome outcome = rig.load(own_model(file));
    EXPECT_TRUE(outcome.success) << file << ": " << outcome.message;
    for (const base::Diagnostic& found : outcome.diagnostics) ADD_FAILURE() << base::to_string(found);
  }
}

TEST(OwnScenes, TheArmHoldsStillWithoutCommands) {
  ModelRig rig(own_world());
  ASSERT_TRUE(rig.load(own_model("robots/arm7.yaml")).success);
  std::vector<math::Vec3> start;
  for (const state::BodyState& body : rig.frame().bodies) start.push_back(body.T_world_body.position);
  ASSERT_TRUE(rig.run(10.0).success);
  double drift = 0.0;
  for (std::size_t slot = 0; slot < start.size(); ++slot)
    drift = std::max(drift, math::norm(rig.frame().bodies[slot].T_world_body.position - start[slot]));
  std::printf("arm7 after 10 s without commands: %.5f mm\n", drift * 1e3);
  EXPECT_LT(drift, 0.1e-3);
}

TEST(OwnScenes, TheArmLetsGoWhenItsLastCommandExpires) {
  ModelRig rig(own_world());
  ASSERT_TRUE(rig.load(own_model("robots/arm7.yaml")).success);
  const auto height = [&] { return rig.body("link7").T_world_body.position.z; };
  const auto bend = [&] {
    return rig.joint_command("base", JointCommandType::position, {{"joint2", 0.5}, {"joint4", -0.5}});
  };
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(rig.step(100, {bend()}).success);
  const double held = height();
  ASSERT_TRUE(rig.step(400, {bend()}).success);
  EXPECT_NEAR(height(), held, 1e-3);
  ASSERT_TRUE(rig.run(2.0).success);
  EXPECT_LT(height(), held - 0.05);
}

TEST(OwnScenes, TheCarDrivesAndTurns) {
  ModelRig rig(own_world());
  ASSERT_TRUE(rig.load(own_model("vehicles/toy_car.yaml")).success);
  ASSERT_TRUE(rig.run(0.5).success);
  constexpr double kWheelRadius = 0.035, kWheelSpeed = 10.0;  // m, rad/s
  const auto drive = [&](double steer, double seconds) {
    for (double t = 0.0; t < seconds; t += 0.1) {
      const state::AddressedCommand motors = rig.joint_command(
          "chassis", JointCommandType::velocity, {{"rear_left_motor", kWheelSpeed}, {"rear_right_motor", kWheelSpeed}});
      state::AddressedCommand all =
          rig.joint_command("chassis", JointCommandType::position, {{"steer_left", steer}, {"steer_right", steer}});
      auto& joints = std::get<state::RigidBodyCommand>(all.command).joints;
      const auto& speeds = std::get<state::RigidBodyCommand>(motors.command).joints;
      for (std::size_t i = 0; i < joints.size(); ++i)
        if (speeds[i].type != JointCommandType::none) joints[i] = speeds[i];
      ASSERT_TRUE(rig.step(100, {all}).success);
    }
  };
  drive(0.0, 1.0);
  const math::Pose start = rig.body("chassis").T_world_body;
  drive(0.0, 2.0);
  const math::Pose end = rig.body("chassis").T_world_body;
  const math::Vec3 way = math::inverse(start) * end.position;
  EXPECT_NEAR(way.x, kWheelRadius * kWheelSpeed * 2.0, 0.05);
  EXPECT_NEAR(way.y, 0.0, 0.02);
  drive(0.3, 1.0);
  const math::Vec3 turned = math::log(math::inverse(end.orientation) * rig.body("chassis").T_world_body.orientation);
  std::printf("toy car: %.3f m forwards in 2 s, then %.2f rad to the left in 1 s\n", way.x, turned.z);
  EXPECT_GT(turned.z, 0.2);
}

TEST(OwnScenes, TheStewartPlatformFollowsItsLegs) {
  ModelRig rig(own_world());
  ASSERT_TRUE(rig.load(own_model("mechanisms/stewart_platform.yaml")).success);
  const math::Pose home = rig.body("platform").T_world_body;
  std::vector<std::pair<std::string, double>> legs;
  for (int leg = 1; leg <= 6; ++leg) legs.emplace_back("leg" + std::to_string(leg), 0.03);
  for (int i = 0; i < 20; ++i)
    ASSERT_TRUE(rig.step(100, {rig.joint_command("base", JointCommandType::position, legs)}).success);
  const math::Pose raised = rig.body("platform").T_world_body;
  for (const auto& [name, value] : legs) EXPECT_NEAR(rig.frame().joints[rig.joint_slot(name)].position, value, 1e-4);
  // All legs alike: straight up, by a little more than the legs grow since they lean.
  EXPECT_GT(raised.position.z - home.position.z, 0.03);
  EXPECT_LT(raised.position.z - home.position.z, 0.045);
  EXPECT_NEAR(raised.position.x, home.position.x, 1e-4);
  EXPECT_NEAR(raised.position.y, home.position.y, 1e-4);
  EXPECT_LT(math::norm(math::log(math::inverse(home.orientation) * raised.orientation)), 1e-3);
}

TEST(OwnScenes, TheFourBarsCrankTurnsRoundAndRound) {
  ModelRig rig(own_world());
  ASSERT_TRUE(rig.load(own_model("mechanisms/four_bar.yaml")).success);
  const std::uint32_t crank = rig.joint_slot("base-crank");
  const double start = rig.frame().joints[crank].position;
  double gap = 0.0, slowest = 1e9;
  const double speed = 2.0 * std::numbers::pi;
  for (int step = 0; step < 3000; ++step) {
    std::vector<state::AddressedCommand> command;
    if (step % 100 == 0) command = {rig.joint_command("base", JointCommandType::velocity, {{"base-crank", speed}})};
    ASSERT_TRUE(rig.step(1, std::move(command)).success);
    gap = std::max(gap, rig.largest_gap());
    if (step > 200) slowest = std::min(slowest, rig.frame().joints[crank].velocity);
  }
  std::printf("four-bar: %.3f turns in 3 s, slowest %.2f of %.2f rad/s, largest gap %.5f mm\n",
              (rig.frame().joints[crank].position - start) / (2.0 * std::numbers::pi), slowest, speed, gap * 1e3);
  EXPECT_NEAR(rig.frame().joints[crank].position - start, 3.0 * speed, 0.3);
  EXPECT_GT(slowest, 0.9 * speed);
  EXPECT_LT(gap, 0.05e-3);
}

// --- grasping ------------------------------------------------------------------------------------

// Moves a floating gripper along straight lines, jaws going with it, in steps of 10 ms.
class Operator {
 public:
  Operator(ModelRig& rig, std::string base, std::vector<std::string> jaws)
      : rig_(rig), base_(std::move(base)), jaws_(std::move(jaws)) {
    at_ = rig_.body(base_).T_world_body;
    for (const std::string& jaw : jaws_) opening_ = rig_.frame().joints[rig_.joint_slot(jaw)].position;
  }

  template <class Look>
  void move(const math::Vec3& to_world, double opening, double seconds, Look look) {
    const math::Vec3 from = at_.position;
    const double opened = opening_;
    const int pieces = static_cast<int>(seconds * 100.0 + 0.5);
    for (int i = 1; i <= pieces; ++i) {
      const double u = static_cast<double>(i) / pieces, s = u * u * (3.0 - 2.0 * u);
      at_.position = from + (to_world - from) * s;
      opening_ = opened + (opening - opened) * s;
      std::vector<std::pair<std::string, double>> values;
      for (const std::string& jaw : jaws_) values.emplace_back(jaw, opening_);
      state::AddressedCommand command = rig_.joint_command(base_, JointCommandType::position, values);
      auto& body = std::get<state::RigidBodyCommand>(command.command);
      body.type = state::CartesianCommandType::position;
      body.T_world_body = at_;
      ASSERT_TRUE(rig_.step(10, {command}).success);
      look();
    }
  }
  void move(const math::Vec3& to_world, double opening, double seconds) {
    move(to_world, opening, seconds, [] {});
  }
  double jaw(std::size_t which) { return rig_.frame().joints[rig_.joint_slot(jaws_[which])].position; }
  double grip(std::size_t which) { return rig_.frame().joints[rig_.joint_slot(jaws_[which])].effort; }

 private:
  ModelRig& rig_;
  const std::string base_;
  const std::vector<std::string> jaws_;
  math::Pose at_;
  double opening_ = 0.0;
};

// Where a point of what is held is in the frame of what holds it.
math::Vec3 held_at(ModelRig& rig, const std::string& holder, const std::string& held) {
  return math::inverse(rig.body(holder).T_world_body) * rig.body(held).T_world_body.position;
}

// The jaw gripper takes a triangle by its wall, one jaw between wall and peg, and lifts it off the peg.
TEST(Grasp, TheJawGripperLiftsATriangleOffItsPegWithoutSlip) {
  ModelRig rig(own_world());
  ASSERT_TRUE(rig.load(own_model("puzzles/peg_transfer.yaml")).success);
  ASSERT_TRUE(rig.run(0.5).success);
  const math::Vec3 triangle = rig.body("triangle4").T_world_body.position;
  constexpr double kWallFromMiddle = 0.00675, kPinAboveTop = 0.014, kHalfHeight = 0.0075;
  constexpr double kOpen = 0.12, kStiffness = 0.3, kForce = 5.0;
  // Told this far inside of where they touch (0.08 rad, 14 mm below the pin), the jaws press with kForce.
  constexpr double kGrip = 0.08 - kForce * kPinAboveTop / kStiffness;
  const math::Vec3 grasp{triangle.x, triangle.y - kWallFromMiddle, triangle.z + kHalfHeight + kPinAboveTop};
  const math::Vec3 above = grasp + math::Vec3{0, 0, 0.04};

  Operator hand(rig, "left_gripper", {"left_gripper-jaw_a", "left_gripper-jaw_b"});
  hand.move(above, kOpen, 1.0);
  hand.move(above, kOpen, 0.5);
  hand.move(grasp, kOpen, 1.0);
  hand.move(grasp, kOpen, 0.3);
  EXPECT_LT(math::norm(rig.body("triangle4").T_world_body.position - triangle), 1e-3);  // not pushed on the way
  hand.move(grasp, kGrip, 0.5);
  hand.move(grasp + math::Vec3{0, 0, 0.002}, kGrip, 0.5);

  const math::Vec3 start = held_at(rig, "left_jaw_a", "triangle4");
  const math::Vec3 start_b = held_at(rig, "left_jaw_b", "triangle4");
  double slip = 0.0, runaway = 0.0;
  const double jaw_a = hand.jaw(0);
  const auto watch = [&] {
    slip = std::max({slip, math::norm(held_at(rig, "left_jaw_a", "triangle4") - start),
                     math::norm(held_at(rig, "left_jaw_b", "triangle4") - start_b)});
    runaway = std::max(runaway, std::abs(hand.jaw(0) - jaw_a));
  };
  hand.move(above, kGrip, 1.0, watch);
  hand.move(above, kGrip, 2.4, watch);
  std::printf(
      "jaw gripper, %.1f N, 3.4 s: slip %.5f mm, jaw drift %.5f rad, jaws at %.3f and %.3f rad, %.4f and %.4f Nm\n",
      kForce, slip * 1e3, runaway, hand.jaw(0), hand.jaw(1), hand.grip(0), hand.grip(1));
  EXPECT_GT(rig.body("triangle4").T_world_body.position.z - triangle.z, 0.03);
  EXPECT_LT(slip, 0.05e-3);
  EXPECT_LT(runaway, 5e-3);
  EXPECT_NEAR(hand.jaw(0), hand.jaw(1), 0.02);  // neither has run away

  hand.move(above, kOpen, 0.5);
  hand.move(above, kOpen, 0.5);
  EXPECT_LT(rig.body("triangle4").T_world_body.position.z, above.z - 0.03);  // and lets go
}

struct Load {
  const char* name;
  double force, mass, bar_m;
};

class FingerGrasp : public testing::TestWithParam<Load> {};

TEST_P(FingerGrasp, TheTwoFingerGripperLiftsABoxWithoutSlip) {
  const Load& load = GetParam();
  ModelRig rig(own_world());
  ASSERT_TRUE(rig.load(own_model("grippers/two_finger.yaml")).success);
  char box[512];
  std::snprintf(
      box, sizeof box,
      "bodies: [BODY parcel]\nnamespace: /test/\nBODY parcel: {name: parcel, mass: %g, collision shape: BOX, "
      "collision geometry: {x: 0.04, y: 0.04, z: 0.06}, shape: BOX, geometry: {x: 0.04, y: 0.04, z: 0.06}, "
      "friction: {static: 0.8}, location: {position: {x: 0, y: 0, z: 0.03}, orientation: {r: 0, p: 0, y: 0}}}\n",
      load.mass);
  ASSERT_TRUE(rig.load_text(box).success);
  constexpr double kStiffness = 1500.0, kHalfBox = 0.02;
  const double grip = kHalfBox - 0.0002 - load.force / kStiffness;
  const math::Vec3 grasp{0, 0, 0.11}, above{0, 0, 0.25};
  Operator hand(rig, "palm", {"palm-finger_a", "palm-finger_b"});
  hand.move(grasp, 0.03, 1.0);
  hand.move(grasp, 0.03, 0.3);
  hand.move(grasp, grip, 0.5);
  hand.move(grasp, grip, 0.5);
  const math::Vec3 start = held_at(rig, "finger_a", "parcel");
  double slip = 0.0;
  const auto watch = [&] { slip = std::max(slip, math::norm(held_at(rig, "finger_a", "parcel") - start)); };
  hand.move(above, grip, 1.0, watch);
  hand.move(above, grip, 2.4, watch);
  std::printf("two-finger gripper, %.0f N, %.2f kg, 3.4 s: slip %.5f mm, fingers at %.5f and %.5f m, %.2f and %.2f N\n",
              load.force, load.mass, slip * 1e3, hand.jaw(0), hand.jaw(1), hand.grip(0), hand.grip(1));
  EXPECT_GT(rig.body("BODY parcel").T_world_body.position.z, 0.1);
  EXPECT_LT(slip, load.bar_m);
}

INSTANTIATE_TEST_SUITE_P(Loads, FingerGrasp,
                         testing::Values(Load{"five_newtons", 5.0, 0.1, 0.05e-3},
                                         Load{"fifty_newtons", 50.0, 1.0, 0.25e-3}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace ambf::runtime
