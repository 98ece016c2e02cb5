// The live world as a whole: determinism, snapshots, reset, divergence, removal, allocation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "math/rotation.h"
#include "rig.h"

namespace ambf::model::test {
namespace {

// A closed four-bar with a motor, a falling pile beside it, a body under force control: contacts, a loop and commands
// at once.
scene::Model busy_scene() {
  scene::Model out = model("busy.yaml", {});
  scene::Body ground = box("ground", 0.0, {0, 0, -0.5}, 1.0);
  ground.collision.shapes.front().geometry.shape = scene::Shape::plane;
  ground.T_world_body = {};
  out.bodies.push_back(ground);
  for (int i = 0; i < 6; ++i)
    out.bodies.push_back(box("pile" + std::to_string(i), 0.3, {1.0 + 0.02 * (i % 2), 0.01 * i, 0.06 + 0.11 * i}));
  const math::Vec3 corners[4] = {{0, 0, 1}, {0, 0, 1.4}, {0.4, 0, 1.4}, {0.4, 0, 1}};
  const char* names[4] = {"base", "crank", "coupler", "rocker"};
  for (int i = 0; i < 4; ++i) {
    const math::Vec3 a = corners[(i + 3) % 4], b = corners[i];
    scene::Body bar = box(names[i], i == 0 ? 0.0 : 0.5, (a + b) * 0.5, 0.04);
    bar.collision.shapes.clear();
    bar.inertia = math::Vec3{0.01, 0.01, 0.01};
    out.bodies.push_back(bar);
  }
  for (int i = 0; i < 4; ++i) {  // base -> crank -> coupler -> rocker -> base closes
    const math::Vec3 at = corners[i];
    const int next = (i + 1) % 4;
    scene::Joint bar = joint("bar" + std::to_string(i), names[i], names[next]);
    bar.parent_axis = bar.child_axis = {0, 1, 0};
    bar.parent_pivot = at - (corners[(i + 3) % 4] + corners[i]) * 0.5;
    bar.child_pivot = at - (corners[i] + corners[next]) * 0.5;
    bar.enable_motor = false;
    if (i == 3) std::swap(bar.parent, bar.child), std::swap(bar.parent_pivot, bar.child_pivot);
    out.joints.push_back(bar);
  }
  scene::Body tool = box("tool", 1.0, {2, 0, 1});
  tool.linear = {{100, 100, 100}, {10, 10, 10}, {20, 20, 20}, scene::ControllerOutput::force};
  tool.angular = {{1, 1, 1}, {}, {0.1, 0.1, 0.1}, scene::ControllerOutput::force};
  out.bodies.push_back(tool);
  return out;
}

class Script {
 public:
  explicit Script(Rig& rig) : base_(rig.port("base")), tool_(rig.port("tool")), pile_(rig.port("pile3")) {}
  void at(int step) {
    if (step % 20 == 3) base_->post(joints({to_velocity(1.0 + 0.01 * step)}));
    if (step % 50 == 7) tool_->post(pose({{2, 0.001 * step, 1}, math::from_rpy(0, 0, 0.002 * step)}));
    if (step == 150) pile_->post(force({0.5, 0.2, 0}));
  }

 private:
  std::unique_ptr<state::CommandPort> base_, tool_, pile_;
};

// Hash of every frame.
std::vector<std::uint64_t> run(Rig& rig, Script& script, int from, int to) {
  std::vector<std::uint64_t> hashes;
  for (int i = from; i < to; ++i) {
    script.at(i);
    rig.step();
    hashes.push_back(state::state_hash(*rig.frame));
  }
  return hashes;
}

// The first frame in which two runs differ, for messages that can be read; the length when they are equal.
std::size_t first_difference(const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) {
  std::size_t i = 0;
  while (i < a.size() && i < b.size() && a[i] == b[i]) ++i;
  return i;
}

TEST(Determinism, EveryFrameOfThreeRunsIsTheSameBitForBit) {
  std::array<std::vector<std::uint64_t>, 3> hashes;
  for (auto& each : hashes) {
    Rig rig({0, 0, -9.8});
    rig.load(busy_scene());
    Script script(rig);
    each = run(rig, script, 0, 800);
    EXPECT_GT(rig.frame->contacts_total, 4u);
    EXPECT_GT(std::abs(rig.joint_state("bar0").position), 0.1);
  }
  EXPECT_EQ(first_difference(hashes[0], hashes[1]), 800u);
  EXPECT_EQ(first_difference(hashes[0], hashes[2]), 800u);
}

TEST(Determinism, AResetWorldRunsAsANewOne) {
  Rig rig({0, 0, -9.8});
  rig.load(busy_scene());
  Script script(rig);
  const auto first = run(rig, script, 0, 400);
  const std::uint64_t epoch = rig.live->epoch();
  rig.live->reset();
  EXPECT_EQ(rig.live->epoch(), epoch + 1);
  EXPECT_EQ(rig.live->sim_step(), 0u);
  EXPECT_EQ(rig.live->sim_time(), 0.0);
  EXPECT_EQ(first_difference(run(rig, script, 0, 400), first), 400u);
}

TEST(Snapshot, ContinuesBitForBitInTheSameAndInAFreshWorld) {
  Rig rig({0, 0, -9.8});
  rig.load(busy_scene());
  Script script(rig);
  run(rig, script, 0, 333);
  const std::vector<std::uint8_t> saved = rig.live->save();
  const auto after_saving = run(rig, script, 333, 900);

  EXPECT_EQ(rig.live->restore(saved), "");
  EXPECT_EQ(rig.live->sim_step(), 333u);
  EXPECT_EQ(first_difference(run(rig, script, 333, 900), after_saving), 900u - 333u);

  Rig fresh({0, 0, -9.8});
  fresh.load(busy_scene());
  EXPECT_EQ(fresh.live->restore(saved), "");
  Script fresh_script(fresh);
  EXPECT_EQ(first_difference(run(fresh, fresh_script, 333, 900), after_saving), 900u - 333u);
}

TEST(Snapshot, KeepsCommandsInForceUntilTheirWatchdogExpires) {
  Rig rig;
  rig.load(model("a", {box("a", 1.0, {0, 0, 0}), box("b", 0.0, {1, 0, 0})}));
  rig.port("a")->post(force({1, 0, 0}));
  rig.step(100);
  const auto saved = rig.live->save();
  rig.step(1000);
  const double expected = rig.body("a").twist_world.linear.x;
  Rig fresh;
  fresh.load(model("a", {box("a", 1.0, {0, 0, 0}), box("b", 0.0, {1, 0, 0})}));
  ASSERT_EQ(fresh.live->restore(saved), "");
  fresh.step(300);
  EXPECT_TRUE(fresh.body("a").active);
  fresh.step(700);
  EXPECT_FALSE(fresh.body("a").active);
  EXPECT_EQ(fresh.body("a").twist_world.linear.x, expected);
}

TEST(Snapshot, RefusesOtherStructuresAndDamagedBytes) {
  Rig rig;
  rig.load(model("a", {box("a", 1.0, {0, 0, 0})}));
  rig.step(10);
  const auto saved = rig.live->save();
  const auto position = rig.body("a").T_world_body.position;
  for (const std::size_t at : {std::size_t{9}, saved.size() / 3, saved.size() / 2, saved.size() - 1}) {
    auto damaged = saved;
    damaged[at] ^= 0x40;
    EXPECT_NE(rig.live->restore(damaged), "") << "byte " << at;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{40}, saved.size() - 8}) {
    const std::vector<std::uint8_t> cut(saved.begin(), saved.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_NE(rig.live->restore(cut), "") << size << " bytes";
  }
  Rig other;
  other.load(model("a", {box("b", 1.0, {0, 0, 0})}));
  EXPECT_NE(other.live->restore(saved).find("other objects"), std::string::npos);
  EXPECT_EQ(rig.body("a").T_world_body.position, position);
  EXPECT_EQ(rig.live->restore(saved), "");
}

TEST(Reset, OfBodiesPutsThemBackAtRestAndKeepsTime) {
  Rig rig({0, 0, -9.8});
  rig.load(model("a", {box("a", 1.0, {0, 0, 1})}));
  rig.step(100);
  rig.live->reset_bodies();
  rig.live->fill(*rig.frame);
  EXPECT_NEAR(rig.body("a").T_world_body.position.z, 1.0, 1e-12);
  EXPECT_EQ(math::norm(rig.body("a").twist_world.linear), 0.0);
  EXPECT_EQ(rig.live->sim_step(), 100u);
}

TEST(Divergence, IsCaughtInTheStepItHappensWithTheBodysName) {
  Rig rig;
  rig.load(model("a", {box("quiet", 1.0, {0, 0, 0})}));
  rig.step(5);
  ASSERT_EQ(rig.live->diverged_body(), state::kNone);
  scene::Model bomb = model("b", {box("wild", 1.0, {1, 0, 0})});
  bomb.gravity = math::Vec3{1e12, 0, 0};
  rig.load(bomb);
  rig.step();
  const std::uint32_t slot = rig.live->diverged_body();
  ASSERT_NE(slot, state::kNone);
  EXPECT_EQ(rig.live->structure()->objects[rig.live->structure()->bodies[slot].object].name, "/test/wild");
  rig.live->controllers_off();
  rig.live->reset();
  EXPECT_EQ(rig.live->diverged_body(), state::kNone);
}

// Fig. 4.12: a middle link goes; in the next frame lineage is right, and the rest moves on as if nothing had touched
// it.
TEST(Removal, OfAMiddleLinkSplitsTheChainAndTheRestMovesOn) {
  Rig rig({0, 0, -9.8});
  scene::Model arm = chain(5);
  for (scene::Joint& each : arm.joints) each.controller.output = scene::ControllerOutput::force;  // swings freely
  rig.load(arm);
  rig.step(100);
  EXPECT_EQ(rig.children_names("link0"),
            (std::vector<std::string>{"/test/link1", "/test/link2", "/test/link3", "/test/link4"}));
  const state::BodyState before = rig.body("link4");
  ASSERT_TRUE(rig.apply(rig.catalogue.prepare_remove("/test/link2")).success);

  EXPECT_EQ(rig.children_names("link0"), (std::vector<std::string>{"/test/link1"}));
  EXPECT_EQ(rig.info("link0").joints.size(), 1u);
  EXPECT_EQ(rig.children_names("link3"), (std::vector<std::string>{"/test/link4"}));
  EXPECT_EQ(rig.live->structure()->joints.size(), 2u);
  EXPECT_EQ(rig.frame->bodies.size(), 4u);
  EXPECT_EQ(rig.body("link4").T_world_body, before.T_world_body);
  EXPECT_EQ(rig.body("link4").twist_world.linear, before.twist_world.linear);
  rig.step(300);
  // The lower piece falls freely, still in one piece; link1 swings on.
  EXPECT_LT(rig.body("link3").T_world_body.position.z, -0.5);
  EXPECT_NEAR(math::norm(rig.body("link4").T_world_body.position - rig.body("link3").T_world_body.position), 0.2, 0.05);
  EXPECT_NEAR(math::norm(rig.body("link1").T_world_body.position - math::Vec3{0.1, 0, 0}), 0.1, 1e-3);
}

TEST(Loading, IntoARunningWorldLeavesTheRunningOnesUntouched) {
  Rig alone({0, 0, -9.8}), joined({0, 0, -9.8});
  for (Rig* rig : {&alone, &joined}) {
    scene::Model arm = chain(3);
    for (scene::Joint& each : arm.joints) each.controller.output = scene::ControllerOutput::force;
    rig->load(arm);
    rig->step(200);
  }
  const auto port = joined.port("link2");
  joined.load(model("far.yaml", {box("far", 1.0, {50, 0, 0})}));
  ASSERT_TRUE(joined.apply(joined.catalogue.prepare_unload("far.yaml")).success);
  alone.step(200);
  joined.step(200);
  EXPECT_EQ(alone.body("link2").T_world_body, joined.body("link2").T_world_body);
  port->post(force({0, 0, 50}));  // ports bound before the changes still work
  joined.step(50);
  EXPECT_TRUE(joined.body("link2").active);
}

TEST(Pick, NamesWhatTheRayHitsAndDragsIt) {
  Rig rig;
  rig.load(model("a", {box("near", 1.0, {0, 0, 0}), box("wall", 0.0, {-1, 0, 0})}));
  rig.step();
  state::PickHit hit;
  ASSERT_TRUE(rig.live->pick(0, 1, {1, 0, 0}, {-3, 0, 0}, hit));
  EXPECT_EQ(hit.object, rig.id("near"));
  EXPECT_NEAR(hit.distance_m, 0.95, 1e-3);
  PickSlot& pointer = rig.live->pick_table()[0];
  rig.step(800, [&](int i) {
    pointer.target.post({1, {0.05, 0.0004 * i, 0}}, 0);
    rig.live->take_picks(false);
  });
  EXPECT_GT(rig.body("near").T_world_body.position.y, 0.2);
  EXPECT_FALSE(rig.live->pick(0, 2, {1, 5, 0}, {-3, 5, 0}, hit));
}

}  // namespace
}  // namespace ambf::model::test
