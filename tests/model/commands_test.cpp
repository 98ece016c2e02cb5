// From posted commands to motion: merging of sources, watchdog, what each kind of command does.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "math/rotation.h"
#include "rig.h"
#include "tests/support/views.h"

namespace ambf::model::test {
namespace {

using state::JointCommandType;
using state::Source;

// Damping of Bullet bodies would eat momentum.
scene::Body undamped(scene::Body body) {
  body.surface.linear_damping = body.surface.angular_damping = 0.0;
  return body;
}

TEST(Wrench, GivesExactlyItsImpulseBecauseItActsInEveryStep) {
  Rig rig;
  rig.load(model("a", {undamped(box("a", 2.0, {0, 0, 0}))}));
  const auto port = rig.port("a");
  port->post(force({1.0, 0, 0}, {0, 0, 0.01}));
  rig.step(400);
  EXPECT_NEAR(2.0 * rig.body("a").twist_world.linear.x, 0.4, 1e-12);  // 1 N for 0.4 s
  const double inertia = rig.info("a").inertia.z;
  EXPECT_NEAR(inertia * rig.body("a").twist_world.angular.z, 0.004, 1e-9);
}

TEST(Wrench, OfSeveralSourcesAddsAndEachEndsAlone) {
  Rig rig;
  rig.load(model("a", {undamped(box("a", 1.0, {0, 0, 0}))}));
  const auto ros = rig.port("a", Source::ros);
  const auto device = rig.port("a", Source::device_0);
  ros->post(force({1.0, 0, 0}));
  device->post(force({0, 2.0, 0}));
  rig.step(100);
  EXPECT_NEAR(rig.body("a").twist_world.linear.x, 0.1, 1e-12);
  EXPECT_NEAR(rig.body("a").twist_world.linear.y, 0.2, 1e-12);
  ros->release();
  rig.step(100);
  EXPECT_NEAR(rig.body("a").twist_world.linear.x, 0.1, 1e-12);
  EXPECT_NEAR(rig.body("a").twist_world.linear.y, 0.4, 1e-12);
  EXPECT_TRUE(rig.body("a").active);
}

TEST(Watchdog, EndsAWrenchHalfASecondAfterTheLastPost) {
  Rig rig;
  rig.load(model("a", {undamped(box("a", 1.0, {0, 0, 0}))}));
  const auto port = rig.port("a");
  port->post(force({1.0, 0, 0}));
  rig.step(499);
  EXPECT_TRUE(rig.body("a").active);
  rig.step(1000);
  EXPECT_FALSE(rig.body("a").active);
  EXPECT_NEAR(rig.body("a").twist_world.linear.x, 0.5, 0.0021);
  port->post(force({1.0, 0, 0}));
  rig.step(100);
  EXPECT_TRUE(rig.body("a").active);  // the first command after silence acts at once
  EXPECT_NEAR(rig.body("a").twist_world.linear.x, 0.6, 0.0021);
}

TEST(Watchdog, IsFedByKeepAliveAndStandsStillWithItsClock) {
  Rig rig;
  rig.load(model("a", {undamped(box("a", 1.0, {0, 0, 0}))}));
  const auto port = rig.port("a");
  port->post(force({1.0, 0, 0}));
  rig.step(900, [&](int i) {
    if (i % 400 == 0) port->keep_alive();
  });
  EXPECT_TRUE(rig.body("a").active);
  rig.live->take_commands(rig.watchdog_s);  // paused: the clock stands
  rig.live->fill(*rig.frame);
  EXPECT_TRUE(rig.body("a").active);
  rig.watchdog_s += 0.6;
  rig.live->take_commands(rig.watchdog_s);
  EXPECT_TRUE(rig.live->changed());
  rig.live->fill(*rig.frame);
  EXPECT_FALSE(rig.body("a").active);
  port->keep_alive();  // too late: what has expired needs a new post
  rig.step();
  EXPECT_FALSE(rig.body("a").active);
}

TEST(Watchdog, LeavesExpiredJointsLimp) {
  Rig rig({0, 0, -9.8});
  scene::Model arm = chain(2);
  rig.load(arm);
  const auto port = rig.port("link0");
  port->post(joints({to_position(0.3)}));
  rig.step(400, [&](int) { port->keep_alive(); });
  rig.step(2000, [&](int) { port->keep_alive(); });
  EXPECT_NEAR(rig.joint_state("j1").position, 0.3, 1e-3);
  EXPECT_EQ(rig.joint_state("j1").commanded_type, JointCommandType::position);
  rig.step(1500);
  EXPECT_EQ(rig.joint_state("j1").commanded_type, JointCommandType::effort);
  EXPECT_EQ(rig.joint_state("j1").commanded, 0.0);
  EXPECT_GT(rig.joint_state("j1").position, 0.6);  // it fell (+ is downwards about +y)
}

TEST(JointCommand, EntriesNeverCommandedAreLeftAlone) {
  Rig rig({0, 0, -9.8});
  rig.load(chain(4));
  const auto port = rig.port("link0");
  rig.step(300, [&](int) { port->post(joints({kLeaveAlone, kLeaveAlone, to_position(0.2)})); });
  rig.step(1000, [&](int) { port->keep_alive(); });
  EXPECT_NEAR(rig.joint_state("j3").position, 0.2, 2e-3);
  // Their motors hold the others where they were.
  EXPECT_NEAR(rig.joint_state("j1").position, 0.0, 1e-3);
  EXPECT_NEAR(rig.joint_state("j2").position, 0.0, 1e-3);
  EXPECT_EQ(rig.joint_state("j1").commanded_type, JointCommandType::none);
}

TEST(JointCommand, FollowsTheSourceThatWroteLastUntilItExpires) {
  Rig rig;
  rig.load(chain(2));
  const auto ros = rig.port("link0", Source::ros);
  const auto panel = rig.port("link0", Source::panel);
  ros->post(joints({to_position(0.2)}));
  rig.step();
  EXPECT_EQ(rig.joint_state("j1").commanded, 0.2);
  panel->post(joints({to_position(-0.4)}));
  rig.step();
  EXPECT_EQ(rig.joint_state("j1").commanded, -0.4);
  rig.step(600, [&](int) { ros->keep_alive(); });  // the panel falls silent
  EXPECT_EQ(rig.joint_state("j1").commanded, 0.2);
  EXPECT_EQ(rig.joint_state("j1").commanded_type, JointCommandType::position);
}

TEST(JointCommand, WorksThroughAnyBodyAboveTheJoint) {
  Rig rig;
  rig.load(chain(3));
  const auto port = rig.port("link1");  // has j2 only
  rig.step(1500, [&](int) { port->post(joints({to_position(0.25)})); });
  EXPECT_NEAR(rig.joint_state("j2").position, 0.25, 1e-3);
  EXPECT_EQ(rig.joint_state("j1").commanded_type, JointCommandType::none);
}

TEST(JointCommand, PostsFromTwoBodiesMeetAtTheJointInTheOrderOfWriting) {
  Rig rig;
  rig.load(chain(3));
  const auto root = rig.port("link0");
  const auto link = rig.port("link1");
  link->post(joints({to_position(0.1)}));
  root->post(joints({kLeaveAlone, to_position(0.3)}));
  rig.step();
  EXPECT_EQ(rig.joint_state("j2").commanded, 0.3);
  root->post(joints({kLeaveAlone, to_position(0.5)}));
  link->post(joints({to_position(0.7)}));
  rig.step();
  EXPECT_EQ(rig.joint_state("j2").commanded, 0.7);
}

TEST(Pose, ForceControllerBringsAnOffsetBodyToItsPoseAndHoldsItAgainstGravity) {
  Rig rig({0, 0, -9.8});
  scene::Body body = box("a", 1.0, {0, 0, 1});
  body.inertial_offset = math::Pose{{0.02, -0.01, 0.03}, math::from_rpy(0.3, 0.2, 0.1)};
  body.linear = {{200, 200, 200}, {400, 400, 400}, {40, 40, 40}, scene::ControllerOutput::force};
  body.angular = {{2, 2, 2}, {2, 2, 2}, {0.2, 0.2, 0.2}, scene::ControllerOutput::force};
  rig.load(model("a", {body}));
  const math::Pose target{{0.3, -0.2, 1.4}, math::from_rpy(0.5, -0.4, 1.0)};
  const auto port = rig.port("a");
  rig.step(8000, [&](int) { port->post(pose(target)); });
  const math::Pose reached = rig.body("a").T_world_body;
  EXPECT_LT(math::norm(reached.position - target.position), 1e-3);
  EXPECT_LT(math::norm(math::log(math::inverse(target.orientation) * reached.orientation)), 0.01);
}

TEST(Pose, DefaultVelocityControllerReachesItsPoseWithoutSag) {
  Rig rig({0, 0, -9.8});
  rig.load(model("a", {box("a", 3.0, {0, 0, 1})}));
  const math::Pose target{{-0.5, 0.4, 1.2}, math::from_rpy(-0.7, 0.2, 2.0)};
  const auto port = rig.port("a");
  rig.step(4000, [&](int) { port->post(pose(target)); });
  EXPECT_LT(math::norm(rig.body("a").T_world_body.position - target.position), 1e-4);
  EXPECT_LT(math::norm(math::log(math::inverse(target.orientation) * rig.body("a").T_world_body.orientation)), 1e-4);
}

TEST(Pose, EachChannelGoesByItsOwnOutput) {
  Rig rig({0, 0, -9.8});
  scene::Body body = box("a", 1.0, {0, 0, 1});
  body.linear = {{100, 100, 100}, {}, {20, 20, 20}, scene::ControllerOutput::force};  // angular: velocity
  rig.load(model("a", {body}));
  const auto port = rig.port("a");
  const math::Pose target{{0, 0, 1}, math::from_rpy(0, 0, 0.8)};
  rig.step(3000, [&](int) { port->post(pose(target)); });
  // A force with P alone sags under gravity (m g / P); the velocity channel does not.
  EXPECT_NEAR(rig.body("a").T_world_body.position.z, 1.0 - 9.8 / 100.0, 1e-3);
  EXPECT_NEAR(math::to_rpy(rig.body("a").T_world_body.orientation).z, 0.8, 1e-3);
}

TEST(Pose, AbsurdGainsAreCutToStableOnesAndSaidSo) {
  Rig rig;
  scene::Body body = box("a", 0.05, {0, 0, 0}, 0.02);
  body.linear = {{1e7, 1e7, 1e7}, {}, {1e5, 1e5, 1e5}, scene::ControllerOutput::force};
  body.angular = {{1e4, 1e4, 1e4}, {}, {1e3, 1e3, 1e3}, scene::ControllerOutput::force};
  const Prepared prepared = rig.load(model("a", {body}));
  EXPECT_TRUE(base::has_warnings(prepared.diagnostics));
  const auto port = rig.port("a");
  const math::Pose target{{0.3, 0.1, 0}, math::from_rpy(0.5, 0, 0)};
  rig.step(2000, [&](int) { port->post(pose(target)); });
  EXPECT_LT(math::norm(rig.body("a").T_world_body.position - target.position), 1e-3);
}

TEST(Pose, IntegralDoesNotWindUpWhileTheBodyIsHeld) {
  Rig rig;
  scene::Body body = box("a", 1.0, {0, 0, 0});
  body.linear = {{100, 100, 100}, {200, 200, 200}, {40, 40, 40}, scene::ControllerOutput::force};
  scene::Body wall = box("wall", 0.0, {0.1, 0, 0});  // touches it
  rig.load(model("a", {body, wall}));
  const auto port = rig.port("a");
  rig.step(20000, [&](int) { port->post(pose({{0.05, 0, 0}, {}})); });  // 20 s against the wall
  // Unbounded, the integral would push with 200 * 0.05 * 20 = 200 N; bounded it adds 50 N and is unwound soon.
  double farthest = 0.0;
  rig.step(3000, [&](int) {
    port->post(pose({{-0.2, 0, 0}, {}}));
    farthest = std::min(farthest, rig.body("a").T_world_body.position.x);
  });
  EXPECT_NEAR(rig.body("a").T_world_body.position.x, -0.2, 0.03);
  EXPECT_GT(farthest, -0.6);
}

TEST(Twist, SetsMovingBodiesAndCarriesStaticOnes) {
  Rig rig;
  rig.load(model("a", {box("moving", 1.0, {0, 0, 1}), box("fixed", 0.0, {1, 0, 0})}));
  const auto moving = rig.port("moving");
  const auto fixed = rig.port("fixed");
  rig.step(400, [&](int) {
    moving->post(twist({{0.1, 0, 0}, {0, 0, 0.5}}));
    fixed->post(twist({{0, 0.2, 0}, {0, 0, -1.0}}));
  });
  EXPECT_NEAR(rig.body("moving").T_world_body.position.x, 0.04, 1e-4);
  EXPECT_NEAR(math::to_rpy(rig.body("moving").T_world_body.orientation).z, 0.2, 1e-3);
  EXPECT_NEAR(rig.body("fixed").T_world_body.position.y, 0.08, 1e-9);
  EXPECT_NEAR(math::to_rpy(rig.body("fixed").T_world_body.orientation).z, -0.4, 1e-9);
}

TEST(Pose, TeleportsStaticBodies) {
  Rig rig;
  rig.load(model("a", {box("fixed", 0.0, {1, 0, 0})}));
  const auto port = rig.port("fixed");
  const math::Pose target{{0.5, 0.25, -1}, math::from_rpy(0, 0.3, 0)};
  port->post(pose(target));
  rig.step(2);
  EXPECT_LT(math::norm(rig.body("fixed").T_world_body.position - target.position), 1e-12);
  EXPECT_LT(math::norm(rig.body("fixed").twist_world.linear), 1e-9);
}

// Device, mouse and ROS alike (EQUATIONS 4): the first one holds the camera.
TEST(Camera, IsMovedByTheFirstMasterUntilItLetsGo) {
  for (const auto& [first, second] :
       {std::pair{Source::device_0, Source::ros}, std::pair{Source::ros, Source::device_0},
        std::pair{Source::device_0, Source::pointer}, std::pair{Source::pointer, Source::step_service}}) {
    Rig rig;
    scene::Model scene = model("a", {box("a", 0.0, {1, 0, 0})});
    scene.cameras.push_back(test_camera({2, 0, 0}, "BODY a"));
    rig.load(scene);
    const auto holder = rig.port("eye", first, state::ObjectKind::camera);
    const auto other = rig.port("eye", second, state::ObjectKind::camera);
    const auto height = [&] { return rig.frame->cameras[0].T_parent_camera.position.z; };
    const auto command = [](double z) { return state::PoseCommand{true, {{0.0, 0.0, z}, {}}}; };
    holder->post(command(1.0));
    rig.step();
    other->post(command(9.0));
    rig.step();
    EXPECT_EQ(height(), 1.0) << static_cast<int>(first);
    holder->post(command(2.0));
    rig.step();
    EXPECT_EQ(height(), 2.0);
    holder->release();
    rig.step(3);
    EXPECT_EQ(height(), 2.0) << "what was ignored stays without effect";
    other->post(command(3.0));
    rig.step();
    EXPECT_EQ(height(), 3.0);
    holder->post(command(4.0));
    rig.step();
    EXPECT_EQ(height(), 3.0);
    rig.step(600);  // silent for longer than the watchdog allows
    holder->post(command(5.0));
    rig.step();
    EXPECT_EQ(height(), 5.0);
  }
}

TEST(Camera, MovesInItsParentAndStaysWhenItsCommandEnds) {
  Rig rig;
  scene::Model scene = model("a", {box("a", 0.0, {1, 0, 0})});
  scene.cameras.push_back(test_camera({2, 0, 0}, "BODY a"));
  rig.load(scene);
  // Looks along -x with z up: R_world_camera is the identity.
  EXPECT_LT(math::norm(math::log(rig.frame->cameras[0].T_world_camera.orientation)), 1e-12);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.x, 3.0, 1e-12);
  const auto port = rig.port("eye", Source::ros, state::ObjectKind::camera);
  state::PoseCommand command;
  command.enabled = true;
  command.T_parent_object.position = {0, 0, 5};
  port->post(command);
  rig.step();
  EXPECT_TRUE(rig.frame->cameras[0].active);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.z, 5.0, 1e-12);
  EXPECT_NEAR(rig.frame->cameras[0].T_world_camera.position.x, 1.0, 1e-12);
  rig.step(600);
  EXPECT_FALSE(rig.frame->cameras[0].active);
  EXPECT_NEAR(rig.frame->cameras[0].T_parent_camera.position.z, 5.0, 1e-12);
}

TEST(Port, ToARemovedObjectIsSilentAndNobodyCanBindToIt) {
  Rig rig;
  rig.load(model("a", {box("a", 1.0, {0, 0, 0}), box("b", 1.0, {1, 0, 0})}));
  const auto port = rig.port("a");
  const state::ObjectId id = rig.id("a");
  port->post(force({1, 0, 0}));
  rig.step();
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("/test/a")).success);
  port->post(force({1, 0, 0}));
  rig.step(10);
  EXPECT_EQ(rig.commands.bind(id, Source::ros), nullptr);
  EXPECT_EQ(rig.body("b").twist_world.linear.x, 0.0);
  // A new object in the same place is not moved by the old port either.
  rig.load(model("c", {box("c", 1.0, {3, 0, 0})}));
  EXPECT_EQ(rig.id("c").index, id.index);
  port->post(force({1, 0, 0}));
  rig.step(10);
  EXPECT_EQ(rig.body("c").twist_world.linear.x, 0.0);
}

}  // namespace
}  // namespace ambf::model::test
