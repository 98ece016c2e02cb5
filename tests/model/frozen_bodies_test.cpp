// Bodies that diverged are frozen with what joints connect them to; the rest goes on. Commands are cut to what a body
// bears.
#include <gtest/gtest.h>

#include <cmath>

#include "base/limits.h"
#include "math/rotation.h"
#include "model/saved_state.h"
#include "rig.h"

namespace ambf::model::test {
namespace {

using state::ObjectKind;

constexpr math::Vec3 kAbsurd{0, 0, -1e12};  // of what follows the world's gravity

scene::Model weightless(scene::Model model) {
  model.gravity = math::Vec3{};
  return model;
}

// A pair of boxes on a hinge that follows the world's gravity, and a hinge and a box that do not.
struct World : Rig {
  World() {
    load(model("pair", {box("a", 1.0, {0, 0, 2}), box("b", 1.0, {0.2, 0, 2})}, {pivoted(joint("ab", "a", "b"))}));
    scene::Model quiet = chain(3);
    quiet.bodies.push_back(box("floating", 1.0, {0, 3, 0}));
    for (scene::Joint& each : quiet.joints) each.controller.output = scene::ControllerOutput::force;
    load(weightless(quiet));
    witness = port("floating");
    hinge = port("link0");
  }

  static scene::Joint pivoted(scene::Joint joint) {
    joint.parent_pivot = {0.1, 0, 0};
    joint.child_pivot = {-0.1, 0, 0};
    joint.parent_axis = joint.child_axis = {0, 1, 0};
    joint.controller.output = scene::ControllerOutput::force;
    return joint;
  }

  // As the physics loop does it.
  void run(int count) {
    for (int i = 0; i < count; ++i) {
      witness->post(force({0.3, 0, 0}));
      hinge->post(joints({to_effort(0.01), to_effort(-0.02)}));
      step();
      if (live->diverged_body() == state::kNone) continue;
      for (const FrozenReport& each : live->freeze_diverged()) reports.push_back(each);
      live->fill(*frame);
    }
  }
  void diverge() {
    live->set_gravity(kAbsurd);
    run(1);
    live->set_gravity({});
  }
  std::vector<math::Pose> poses(const std::vector<std::string>& names) const {
    std::vector<math::Pose> out;
    for (const std::string& name : names) out.push_back(body(name).T_world_body);
    return out;
  }

  std::unique_ptr<state::CommandPort> witness, hinge;
  std::vector<FrozenReport> reports;
};

TEST(FrozenBodies, StandWhereTheyWereWithAllThatIsJointedAndTheRestGoesOnBitForBit) {
  World calm, wild;
  calm.run(20);
  wild.run(20);
  const auto before = wild.poses({"a", "b"});
  wild.diverge();
  calm.run(1);
  ASSERT_EQ(wild.reports.size(), 1u);
  EXPECT_EQ(wild.reports[0].body, wild.slot("a"));
  EXPECT_EQ(wild.reports[0].jointed, 1u);
  EXPECT_GT(wild.reports[0].linear_speed, 1e4);
  EXPECT_EQ(wild.frame->frozen_bodies, 2u);
  for (World* world : {&calm, &wild}) world->run(300);
  EXPECT_EQ(wild.poses({"a", "b"}), before);
  EXPECT_EQ(math::norm(wild.body("a").twist_world.linear), 0.0);
  EXPECT_TRUE(wild.body("a").frozen && wild.body("b").frozen);
  EXPECT_FALSE(wild.body("link1").frozen || wild.body("floating").frozen);
  EXPECT_EQ(wild.poses({"link1", "link2", "floating"}), calm.poses({"link1", "link2", "floating"}));
  EXPECT_GT(calm.body("floating").T_world_body.position.x, 0.01);
  EXPECT_TRUE(wild.live->anything_moves());
}

TEST(FrozenBodies, ObeyNothingButANewCommandWithinBounds) {
  World world;
  const auto port = world.port("a");
  world.run(5);
  world.diverge();
  const auto before = world.poses({"a", "b"});
  for (const state::Command& wild : {force({1e9, 0, 0}), force({}, {0, 1e9, 0}), twist({{1e6, 0, 0}, {}}),
                                     twist({{}, {0, 2e3, 0}}), pose({{0, 0, 1e6}, {}})}) {
    port->post(wild);
    world.run(5);
    EXPECT_EQ(world.frame->frozen_bodies, 2u);
    EXPECT_EQ(world.poses({"a", "b"}), before);
  }
  port->post(force({1, 0, 0}));
  world.run(200);
  EXPECT_EQ(world.frame->frozen_bodies, 0u);
  EXPECT_NEAR(math::norm(world.body("a").twist_world.linear + world.body("b").twist_world.linear), 0.2, 0.01)
      << "2 kg, 1 N, 0.2 s";
  EXPECT_LT(std::abs(world.joint_state("ab").position), 1.0);
}

TEST(FrozenBodies, AJointsCommandReleasesThem) {
  World world;
  const auto port = world.port("a");
  world.diverge();
  port->post(joints({to_effort(1e9)}));
  world.run(2);
  EXPECT_EQ(world.frame->frozen_bodies, 2u);
  port->post(joints({to_velocity(1.0)}));
  world.run(100);
  EXPECT_EQ(world.frame->frozen_bodies, 0u);
  EXPECT_NEAR(world.joint_state("ab").velocity, 1.0, 0.05);
}

TEST(FrozenBodies, APushAndEveryResetReleaseThem) {
  const auto frozen_after = [](auto act) {
    World world;
    world.diverge();
    EXPECT_EQ(world.frame->frozen_bodies, 2u);
    act(world);
    world.run(10);
    EXPECT_GT(world.live->physics().awake_count(), 1u);
    return world.frame->frozen_bodies;
  };
  state::Push push;
  push.force_world = {1, 0, 0};
  push.seconds = 0.1;
  EXPECT_EQ(frozen_after([&](World& world) { world.live->push(world.id("b"), push); }), 0u);
  EXPECT_EQ(frozen_after([](World& world) { world.live->reset(); }), 0u);
  EXPECT_EQ(frozen_after([](World& world) { world.live->reset_bodies(); }), 0u);
  EXPECT_EQ(frozen_after([](World& world) { world.live->reset_bodies({world.id("a"), world.id("b")}); }), 0u);
}

TEST(FrozenBodies, OthersRestOnThem) {
  World world;
  world.diverge();
  world.load(model("load", {box("load", 1.0, {0, 0, 2.2})}));
  world.live->set_gravity({0, 0, -9.8});
  world.run(1000);
  EXPECT_NEAR(world.body("load").T_world_body.position.z, 2.1, 1e-3);
}

TEST(FrozenBodies, AreInSnapshotsBitForBit) {
  World world;
  world.diverge();
  world.run(10);
  const auto saved = world.live->save();
  const auto hash_after = [&] {
    world.watchdog_s = 1.0;
    world.run(50);
    const auto port = world.port("b", state::Source::panel);
    port->post(force({0, 0, 2}));
    world.run(200);
    EXPECT_EQ(world.frame->frozen_bodies, 0u);
    return state::state_hash(*world.frame);
  };
  const std::uint64_t first = hash_after();
  ASSERT_EQ(world.live->restore(saved), "");
  world.live->fill(*world.frame);
  EXPECT_EQ(world.frame->frozen_bodies, 2u);
  EXPECT_EQ(hash_after(), first);
  world.live->reset();
  world.live->fill(*world.frame);
  EXPECT_EQ(world.frame->frozen_bodies, 0u);
  ASSERT_EQ(world.live->restore(saved), "");
  world.live->fill(*world.frame);
  EXPECT_EQ(world.frame->frozen_bodies, 2u);
}

TEST(FrozenBodies, MayBeRemoved) {
  World world;
  world.diverge();
  ASSERT_TRUE(world.apply(world.catalogue.prepare_remove("/test/a")).success);
  world.run(10);
  EXPECT_EQ(world.frame->frozen_bodies, 1u);
  ASSERT_TRUE(world.apply(world.catalogue.prepare_remove("/test/b")).success);
  world.run(10);
  EXPECT_EQ(world.frame->frozen_bodies, 0u);
}

// A ring of 2 g: a torque of 0.1 N m is some 10^6 rad/s^2.
TEST(CommandBounds, NoCommandTakesABodyBeyondTheBoundAndTheFirstCutIsReported) {
  for (const state::Command& wild :
       {force({1e9, 0, 0}), force({}, {0, 0.1, 0}), twist({{0, 1e6, 0}, {1e6, 0, 0}}), pose({{0, 0, 1e6}, {}})}) {
    Rig rig;
    scene::Body light = box("light", 0.002, {});
    light.inertia = math::Vec3{9e-8, 9e-8, 1.7e-7};
    rig.load(model("m", {light, box("other", 1.0, {-3, 0, 0})}));
    const auto port = rig.port("light");
    int cuts = 0;
    for (int i = 0; i < 400; ++i) {
      port->post(wild);
      rig.step();
      ASSERT_EQ(rig.live->diverged_body(), state::kNone);
      while (const auto report = rig.live->take_cut_report()) {
        ++cuts;
        EXPECT_EQ(report->body, rig.slot("light"));
        EXPECT_EQ(report->source, state::Source::ros);
      }
    }
    EXPECT_EQ(cuts, 1);
    EXPECT_GE(rig.frame->commands.at(0).bounded, 10u);
    const math::Twist now = rig.body("light").twist_world;
    const double speed = std::max(math::norm(now.linear), math::norm(now.angular));
    EXPECT_LE(speed, base::kMaxCommandedSpeed * (1.0 + 1e-9));
    EXPECT_GE(speed, 0.5 * base::kMaxCommandedSpeed) << "it goes where it is sent, as fast as it may";
    EXPECT_EQ(math::norm(rig.body("other").twist_world.linear), 0.0);
  }
}

TEST(CommandBounds, EffortsAndJointTargetsKeepToThem) {
  for (const state::JointCommand& wild : {to_effort(9e8), to_velocity(9e8), to_position(9e8)}) {
    Rig rig;
    scene::Model arm = chain(2);
    arm.joints[0].type = state::JointType::prismatic;  // the angles of a revolute one would wrap
    arm.joints[0].controller.output = scene::ControllerOutput::force;
    rig.load(arm);
    const auto port = rig.port("link0");
    for (int i = 0; i < 400; ++i) {
      port->post(joints({wild}));
      rig.step();
      ASSERT_EQ(rig.live->diverged_body(), state::kNone) << i;
    }
    EXPECT_LE(std::abs(rig.joint_state("j1").velocity), 1.1 * base::kMaxCommandedSpeed);
    EXPECT_TRUE(rig.live->take_cut_report());
    EXPECT_FALSE(rig.live->take_cut_report());
  }
}

TEST(CommandBounds, WhatAJointedBodyCanBearIsNotCut) {
  Rig rig;
  scene::Model arm = chain(4);
  arm.bodies[1].mass = 1e-3;  // a light link that carries heavy ones
  arm.bodies[1].inertia = math::Vec3{1e-9, 1e-9, 1e-9};
  for (scene::Joint& each : arm.joints) each.controller.output = scene::ControllerOutput::force;
  rig.load(arm);
  const auto port = rig.port("link0"), on_link = rig.port("link1");
  for (int i = 0; i < 100; ++i) {
    port->post(joints({to_effort(5.0), to_effort(2.0)}));
    on_link->post(force({5, 0, 0}, {0, 2, 0}));
    rig.step();
  }
  EXPECT_FALSE(rig.live->take_cut_report());
}

// With stiff gains, a target some metres away asks for more than the bound in one step.
TEST(CommandBounds, ReachableTargetsAreNoReasonToWarn) {
  Rig rig;
  scene::Model arm = chain(2);
  arm.joints[0].controller.p = 1e6;
  scene::Body free = box("free", 1.0, {0, 5, 0});
  free.linear.p = {1e6, 1e6, 1e6};
  arm.bodies.push_back(free);
  rig.load(arm);
  const auto hinge = rig.port("link0"), body = rig.port("free");
  for (int i = 0; i < 50; ++i) {
    hinge->post(joints({to_position(2.0)}));
    body->post(pose({{0, 8, 0}, {}}));
    rig.step();
    EXPECT_FALSE(rig.live->take_cut_report());
  }
  EXPECT_NEAR(rig.body("free").T_world_body.position.y, 8.0, 1e-3);
}

TEST(CommandBounds, AStaticBodyThatIsSentFarAwayThrowsNothing) {
  Rig rig;
  rig.load(model("m", {box("table", 0.0, {}), box("cup", 1.0, {0, 0, 0.1})}));
  const auto port = rig.port("table");
  port->post(pose({{0, 0, 1e6}, {}}));
  rig.step(5);
  EXPECT_EQ(rig.body("table").T_world_body.position.z, 1e6);
  EXPECT_LT(math::norm(rig.body("cup").twist_world.linear), 0.1);
}

}  // namespace
}  // namespace ambf::model::test
