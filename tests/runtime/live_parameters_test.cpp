// What may be changed while the simulation runs: surfaces, gains, damping, speed, pushes; and what a reset makes of it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "simulation_rig.h"

namespace ambf::runtime {
namespace {

using state::Parameter;
using test::Rig;

const std::string kSlide = R"(
bodies: [BODY floor, BODY box, BODY free]
namespace: /test/
BODY floor: {name: floor, mass: 0, friction: {static: 1.0, rolling: 0.0}, collision shape: BOX,
  collision geometry: {x: 4, y: 4, z: 0.2},
  location: {position: {x: 0, y: 0, z: 0.9}, orientation: {r: 0, p: 0, y: 0}}}
BODY box: {name: box, mass: 1, friction: {static: 0.5, rolling: 0.0}, damping: {linear: 0.0, angular: 0.0},
  collision shape: BOX,
  collision geometry: {x: 0.1, y: 0.1, z: 0.1}, location: {position: {x: 0, y: 0, z: 1.05}, orientation: {r: 0, p: 0,
  y: 0}},
  controller: {linear: {P: 20, I: 0, D: 2}, angular: {P: 5, I: 0, D: 0.5}}, controller output type: FORCE}
BODY free: {name: free, mass: 1, gravity: {x: 0, y: 0, z: 0}, damping: {linear: 0.0, angular: 0.0},
  collision shape: BOX,
  collision geometry: {x: 0.1, y: 0.1, z: 0.1}, location: {position: {x: 0, y: 0, z: 2}, orientation: {r: 0, p: 0,
  y: 0}}}
)";

const std::string kDoor = R"(
bodies: [BODY frame, BODY door]
joints: [JOINT hinge]
namespace: /test/
BODY frame: {name: frame, mass: 0, collision shape: SPHERE, collision geometry: {radius: 0.01},
  location: {position: {x: 0, y: 0, z: 3}, orientation: {r: 0, p: 0, y: 0}}}
BODY door: {name: door, mass: 1, inertia: {ix: 0.01, iy: 0.01, iz: 0.01}, damping: {linear: 0.0, angular: 0.0},
  location: {position: {x: 0.5, y: 0, z: 3}, orientation: {r: 0, p: 0, y: 0}}, collision shape: SPHERE,
  collision geometry: {radius: 0.01}}
JOINT hinge: {name: hinge, parent: BODY frame, child: BODY door, type: revolute, enable motor: false, damping: 0.0,
  parent pivot: {x: 0, y: 0, z: 0}, child pivot: {x: -0.5, y: 0, z: 0}, parent axis: {x: 0, y: 0, z: 1},
  child axis: {x: 0, y: 0, z: 1}}
)";

state::Outcome set(Rig& rig, state::ObjectId object, Parameter parameter, const math::Vec3& value) {
  return rig.wait_for([&](state::Completion done) { rig.simulation.set_parameter(object, parameter, value, done); });
}
state::Outcome set(Rig& rig, state::ObjectId object, Parameter parameter, double value) {
  return set(rig, object, parameter, {value, value, value});
}

state::ObjectId joint_id(Rig& rig, const std::string& name) {
  const auto structure = rig.simulation.structure();
  const std::uint32_t index = state::find(*structure, name, state::ObjectKind::joint);
  return index == state::kNone ? state::ObjectId{} : structure->objects[index].id;
}

std::uint32_t slot_of(const state::Frame& frame, const std::string& name) {
  const std::uint32_t index = state::find(*frame.structure, name, state::ObjectKind::rigid_body);
  return frame.structure->objects[index].slot;
}

const state::BodyParameters& parameters(Rig& rig, const std::string& name) {
  const state::Frame& frame = rig.frame();
  return frame.body_parameters[slot_of(frame, name)];
}

class LiveParameters : public ::testing::Test {
 protected:
  Rig rig{test::free_running(), kSlide};
  void SetUp() override {
    ASSERT_TRUE(rig.loaded.success) << rig.loaded.message;
    rig.simulation.begin();
    rig.step(200);
  }
};

TEST_F(LiveParameters, FrictionChangesContactsThatExistAlready) {
  const state::ObjectId box = rig.id("BODY box");
  rig.step(300, {test::push(rig, "BODY box", {3, 0, 0})});  // 0.5 * 9.81 N hold it
  EXPECT_LT(std::abs(rig.body("BODY box").T_world_body.position.x), 1e-3);

  ASSERT_TRUE(set(rig, box, Parameter::friction, 0.0).success);
  EXPECT_EQ(parameters(rig, "BODY box").surface.friction, 0.0);
  rig.step(300, {test::push(rig, "BODY box", {3, 0, 0})});
  EXPECT_NEAR(rig.body("BODY box").T_world_body.position.x, 0.5 * 3.0 * 0.09, 0.01);
}

TEST_F(LiveParameters, AWorldResetRestoresThemAndAResetOfBodiesDoesNot) {
  const state::ObjectId box = rig.id("BODY box");
  const state::BodyParameters loaded = rig.frame().structure->bodies[slot_of(rig.frame(), "BODY box")].parameters;
  EXPECT_EQ(loaded.surface.friction, 0.5);
  EXPECT_EQ(loaded.linear.p, (math::Vec3{20, 20, 20}));
  EXPECT_TRUE(parameters(rig, "BODY box") == loaded);
  set(rig, box, Parameter::friction, 0.25);
  set(rig, box, Parameter::linear_damping, 0.5);
  set(rig, box, Parameter::linear_p, {1, 2, 3});

  rig.simulation.reset_bodies();
  rig.step(1);
  EXPECT_EQ(parameters(rig, "BODY box").surface.friction, 0.25);
  EXPECT_EQ(parameters(rig, "BODY box").surface.linear_damping, 0.5);
  EXPECT_EQ(parameters(rig, "BODY box").linear.p, (math::Vec3{1, 2, 3}));

  rig.simulation.reset_world();
  rig.step(1);
  EXPECT_TRUE(parameters(rig, "BODY box") == loaded);
}

TEST_F(LiveParameters, WhatNoFileMaySayIsRefusedCountedAndChangesNothing) {
  const state::ObjectId box = rig.id("BODY box");
  const state::BodyParameters before = parameters(rig, "BODY box");
  const std::uint64_t refused = rig.frame().run.commands_refused;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(set(rig, box, Parameter::friction, nan).success);
  EXPECT_FALSE(set(rig, box, Parameter::friction, -0.1).success);
  EXPECT_FALSE(set(rig, box, Parameter::linear_damping, 1.5).success);
  EXPECT_FALSE(set(rig, box, Parameter::linear_p, {1, 1, nan}).success);
  EXPECT_FALSE(set(rig, box, Parameter::joint_p, 1.0).success) << "a body is no joint";
  EXPECT_FALSE(set(rig, {box.index, box.generation + 1}, Parameter::friction, 1.0).success) << "nobody";
  rig.step(1);
  EXPECT_TRUE(parameters(rig, "BODY box") == before);
  EXPECT_EQ(rig.frame().run.commands_refused, refused + 4);
}

TEST_F(LiveParameters, GainsBeyondWhatIsStableAreCutAndSaidSo) {
  const state::Outcome outcome = set(rig, rig.id("BODY box"), Parameter::linear_p, 1e9);
  EXPECT_TRUE(outcome.success);
  EXPECT_NE(outcome.message.find("cut"), std::string::npos);
  rig.step(1);
  EXPECT_NEAR(parameters(rig, "BODY box").linear.p.x, 0.25 * 1.0 / 1e-6, 1.0);  // m / (4 h^2)
  EXPECT_TRUE(set(rig, rig.id("BODY box"), Parameter::linear_p, 30.0).message.empty());
}

TEST_F(LiveParameters, ASnapshotKeepsThem) {
  const state::ObjectId box = rig.id("BODY box");
  set(rig, box, Parameter::friction, 0.1);
  const auto run_on = [&] {
    rig.step(250, {test::push(rig, "BODY box", {3, 0, 0})});
    return state::state_hash(rig.frame());
  };
  ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.snapshot("s", "", done); }).success);
  const std::uint64_t first = run_on();
  set(rig, box, Parameter::friction, 0.9);
  ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.restore("s", "", done); }).success);
  rig.step(0);
  EXPECT_EQ(parameters(rig, "BODY box").surface.friction, 0.1);
  EXPECT_EQ(run_on(), first);
}

TEST_F(LiveParameters, AreRightWhenOthersComeAndGo) {
  set(rig, rig.id("BODY box"), Parameter::friction, 0.3);
  ASSERT_TRUE(rig.load(kDoor).success);
  rig.step(1);
  EXPECT_EQ(parameters(rig, "BODY box").surface.friction, 0.3);
  EXPECT_EQ(parameters(rig, "BODY door").surface.friction, 0.5);
  ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.remove("/test/floor", done); }).success);
  rig.step(1);
  EXPECT_EQ(parameters(rig, "BODY box").surface.friction, 0.3) << "its slot has moved";
}

TEST_F(LiveParameters, ChangesShowWhilePaused) {
  rig.simulation.set_paused(true);
  set(rig, rig.id("BODY box"), Parameter::restitution, 0.7);
  EXPECT_TRUE(rig.wait_until([&](const state::Frame& frame) {
    return frame.body_parameters[slot_of(frame, "BODY box")].surface.restitution == 0.7;
  }));
  rig.simulation.set_gravity({0, 0, -1});
  EXPECT_TRUE(rig.wait_until([&](const state::Frame& frame) { return frame.gravity_world.z == -1.0; }));
}

TEST_F(LiveParameters, APushLastsExactlyAsLongAsAsked) {
  const state::ObjectId free = rig.id("BODY free");
  state::Push push;
  push.force_world = {0, 0, 2};
  push.seconds = 0.1;
  ASSERT_TRUE(rig.wait_for([&](auto done) { rig.simulation.push(free, push, done); }).success);
  rig.step(300);
  EXPECT_NEAR(rig.body("BODY free").twist_world.linear.z, 0.2, 1e-9);
  EXPECT_NEAR(math::norm(rig.body("BODY free").twist_world.angular), 0.0, 1e-9);

  push.force_world = {};
  push.torque_world = {0, 0, 1e-3};
  push.point_body = {1, 0, 0};
  rig.wait_for([&](auto done) { rig.simulation.push(free, push, done); });
  rig.step(300);
  EXPECT_NEAR(rig.body("BODY free").twist_world.angular.z, 1e-4 / (1.0 / 6.0 * 0.01), 1e-6);

  push.seconds = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(rig.wait_for([&](auto done) { rig.simulation.push(free, push, done); }).success);
  push.seconds = 0.1;
  EXPECT_FALSE(rig.wait_for([&](auto done) { rig.simulation.push(rig.id("BODY floor"), push, done); }).success);
}

TEST_F(LiveParameters, APushAtAPointTurnsTheBody) {
  state::Push push;
  push.force_world = {0, 0, 1};
  push.point_body = {0.05, 0, 0};
  push.seconds = 0.01;
  rig.wait_for([&](auto done) { rig.simulation.push(rig.id("BODY free"), push, done); });
  rig.step(20);
  EXPECT_NEAR(rig.body("BODY free").twist_world.angular.y, -0.05 * 0.01 / (1.0 / 6.0 * 0.01), 1e-3);
}

TEST_F(LiveParameters, OneBodyIsResetAndTheOthersAreNot) {
  ASSERT_TRUE(rig.load(kDoor).success);
  rig.step(200, {test::push(rig, "BODY door", {0, 1, 0}), test::push(rig, "BODY box", {0, 0, 20})});
  const double box_z = rig.body("BODY box").T_world_body.position.z;
  ASSERT_GT(box_z, 1.1);
  ASSERT_GT(rig.body("BODY door").T_world_body.position.y, 0.005);
  rig.simulation.reset_bodies({rig.id("BODY door"), rig.id("BODY door"), {999, 0}});
  rig.step(1);
  EXPECT_LT(std::abs(rig.body("BODY door").T_world_body.position.y), 1e-4);
  EXPECT_LT(std::abs(rig.frame().joints[0].position), 1e-4);
  EXPECT_NEAR(rig.body("BODY box").T_world_body.position.z, box_z, 0.01);
}

TEST(LiveJointParameters, DampingAndGainsActAtOnce) {
  Rig rig(test::free_running(), kDoor);
  rig.simulation.set_gravity({});
  rig.simulation.begin();
  rig.step(200, {test::push(rig, "BODY door", {0, 1, 0})});
  const double fast = rig.frame().joints[0].velocity;
  ASSERT_GT(fast, 0.2);
  rig.step(300);
  rig.step(400);  // the push has expired
  const double coasting = rig.frame().joints[0].velocity;
  ASSERT_TRUE(set(rig, joint_id(rig, "hinge"), Parameter::joint_damping, 5.0).success);
  rig.step(300);
  EXPECT_EQ(rig.frame().joint_parameters[0].damping, 5.0);
  EXPECT_LT(rig.frame().joints[0].velocity, 0.1 * coasting);

  // Velocity output: a higher P is faster.
  const auto moved = [&](double p) {
    rig.simulation.reset_bodies();
    EXPECT_TRUE(set(rig, joint_id(rig, "hinge"), Parameter::joint_p, p).success);
    state::RigidBodyCommand command;
    command.joints = {{state::JointCommandType::position, 1.0}};
    rig.step(100, {{rig.id("BODY frame"), command}});
    return rig.frame().joints[0].position;
  };
  const double slow = moved(1.0);
  EXPECT_GT(moved(20.0), 2.0 * slow);
}

}  // namespace
}  // namespace ambf::runtime
