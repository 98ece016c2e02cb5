// Pointers hold and drag bodies while the simulation runs, waits or is paused, several at once.
#include <chrono>
#include <thread>

#include "model_rig.h"

namespace ambf::runtime::test {
namespace {

const std::string kScene = R"(
bodies: [BODY ground, BODY left, BODY right, BODY stand, BODY arm, BODY pair1, BODY pair2]
joints: [JOINT hinge, JOINT link]
namespace: /test/
BODY ground: {name: ground, mass: 0, collision shape: BOX, collision geometry: {x: 8, y: 8, z: 0.2}, shape: BOX,
  geometry: {x: 8, y: 8, z: 0.2},
  location: {position: {x: 0, y: 0, z: -0.1}, orientation: {r: 0, p: 0, y: 0}}}
BODY left: {name: left, mass: 1, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: BOX,
  geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: -1, y: 0, z: 0.05}, orientation: {r: 0, p: 0, y: 0}}}
BODY right: {name: right, mass: 2, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: BOX,
  geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 1, y: 0, z: 0.05}, orientation: {r: 0, p: 0, y: 0}}}
BODY stand: {name: stand, mass: 0, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: BOX,
  geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0, y: 1, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}}
BODY arm: {name: arm, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.4, y: 0.05, z: 0.05}, shape: BOX,
  geometry: {x: 0.4, y: 0.05, z: 0.05},
  location: {position: {x: 0.3, y: 1, z: 0.5}, orientation: {r: 0, p: 0, y: 0}}}
BODY pair1: {name: pair1, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: BOX,
  geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0, y: -1, z: 0.05}, orientation: {r: 0, p: 0, y: 0}}}
BODY pair2: {name: pair2, mass: 0.5, collision shape: BOX, collision geometry: {x: 0.1, y: 0.1, z: 0.1}, shape: BOX,
  geometry: {x: 0.1, y: 0.1, z: 0.1},
  location: {position: {x: 0.2, y: -1, z: 0.05}, orientation: {r: 0, p: 0, y: 0}}}
JOINT hinge: {name: hinge, parent: BODY stand, child: BODY arm, type: revolute,
  parent pivot: {x: 0.1, y: 0, z: 0}, child pivot: {x: -0.2, y: 0, z: 0}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
JOINT link: {name: link, parent: BODY pair1, child: BODY pair2, type: fixed,
  parent pivot: {x: 0.1, y: 0, z: 0}, child pivot: {x: -0.1, y: 0, z: 0}, parent axis: {x: 0, y: 1, z: 0},
  child axis: {x: 0, y: 1, z: 0}}
)";

class Picking : public testing::Test {
 protected:
  Picking() : rig(bare_world(), steps_on_request(true)) {
    EXPECT_TRUE(rig.load_text(kScene).success);
    EXPECT_TRUE(rig.step(10).success);
    rig.simulation.set_paused(false);  // it waits for step requests, as a throttled world for its clock
    EXPECT_TRUE(rig.step(10).success);
  }
  // The name of what is met from above there.
  state::ObjectId press(state::PickPort& pointer, double x, double y) {
    std::promise<state::ObjectId> met;
    pointer.pick({x, y, 3}, {x, y, -0.05},
                 [&](bool hit, const state::PickHit& where) { met.set_value(hit ? where.object : state::ObjectId{}); });
    return met.get_future().get();
  }
  const state::PickState* pick_of(const state::PickPort& pointer) {
    for (const state::PickState& pick : rig.frame().picks)
      if (pick.picker == pointer.id()) return &pick;
    return nullptr;
  }
  math::Vec3 at(const char* body) { return rig.body(body).T_world_body.position; }
  // Waits, without steps, for what a frame must show.
  template <class Shown>
  bool comes_true(Shown shown) {
    for (int i = 0; i < 2000; ++i) {
      if (shown()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return false;
  }
  void pause() {
    rig.simulation.set_paused(true);
    EXPECT_TRUE(comes_true([&] { return rig.frame().run.paused; }));
  }

  ModelRig rig;
};

TEST_F(Picking, TwoPointersHoldTwoBodiesAtOnceAndLetGoOnTheirOwn) {
  auto one = rig.simulation.make_pick_port(), other = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*one, -1, 0), rig.id("BODY left"));
  ASSERT_EQ(press(*other, 1, 0), rig.id("BODY right"));
  one->drag({-1, 0, 0.6});
  other->drag({1, 0, 0.4});
  ASSERT_TRUE(rig.step(1500).success);
  EXPECT_NEAR(at("BODY left").z, 0.55, 0.01);
  EXPECT_NEAR(at("BODY right").z, 0.35, 0.01);
  ASSERT_NE(pick_of(*one), nullptr);
  EXPECT_NEAR(pick_of(*one)->force_world.z, 9.81, 0.2);
  ASSERT_NE(pick_of(*other), nullptr);
  EXPECT_NEAR(pick_of(*other)->force_world.z, 2 * 9.81, 0.4);
  EXPECT_EQ(pick_of(*other)->target_world, (math::Vec3{1, 0, 0.4}));
  one->release();
  ASSERT_TRUE(rig.step(200).success);
  EXPECT_LT(at("BODY left").z, 0.45);
  EXPECT_NEAR(at("BODY right").z, 0.35, 0.01);
  EXPECT_EQ(pick_of(*one), nullptr);
  other.reset();  // its window closes
  ASSERT_TRUE(rig.step(1000).success);
  EXPECT_NEAR(at("BODY right").z, 0.05, 0.01);
  EXPECT_TRUE(rig.frame().picks.empty());
}

TEST_F(Picking, TwoPointersCarryOneBodyTogether) {
  auto one = rig.simulation.make_pick_port(), other = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*one, 0.96, 0), rig.id("BODY right"));
  ASSERT_EQ(press(*other, 1.04, 0), rig.id("BODY right"));
  one->drag({0.96, 0, 0.5});
  other->drag({1.04, 0, 0.5});
  ASSERT_TRUE(rig.step(1500).success);
  ASSERT_NE(pick_of(*one), nullptr);
  ASSERT_NE(pick_of(*other), nullptr);
  EXPECT_NEAR(pick_of(*one)->force_world.z + pick_of(*other)->force_world.z, 2 * 9.81, 0.5);
  EXPECT_GT(pick_of(*one)->force_world.z, 2.0);
  EXPECT_GT(pick_of(*other)->force_world.z, 2.0);
}

TEST_F(Picking, StaticBodiesAreMovedAndStayThere) {
  const auto pointer = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*pointer, 0, 1), rig.id("BODY stand"));
  pointer->drag({0.3, 1.2, 0.65});  // by its upper side, which is at 0.55
  ASSERT_TRUE(rig.step(5).success);
  EXPECT_LT(math::norm(at("BODY stand") - math::Vec3{0.3, 1.2, 0.6}), 1e-6);
  pointer->release();
  ASSERT_TRUE(rig.step(50).success);
  EXPECT_LT(math::norm(at("BODY stand") - math::Vec3{0.3, 1.2, 0.6}), 1e-6);
}

TEST_F(Picking, WhilePausedAFreeBodyIsMovedWithAllThatIsJointedToIt) {
  pause();
  const std::uint32_t step = rig.frame().sim_step;
  const auto pointer = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*pointer, 0, -1), rig.id("BODY pair1"));
  const math::Vec3 first = at("BODY pair1"), second = at("BODY pair2");
  const math::Vec3 held = rig.body("BODY pair1").T_world_body * pick_of(*pointer)->point_body;
  pointer->drag(held + math::Vec3{0.5, 0.1, 0.3});
  ASSERT_TRUE(comes_true([&] { return math::norm(at("BODY pair1") - first) > 0.1; }));
  EXPECT_LT(math::norm(at("BODY pair1") - first - math::Vec3{0.5, 0.1, 0.3}), 1e-9);
  EXPECT_LT(math::norm(at("BODY pair2") - second - math::Vec3{0.5, 0.1, 0.3}), 1e-9);
  EXPECT_EQ(pick_of(*pointer)->force_world, math::Vec3{});
  EXPECT_EQ(rig.frame().sim_step, step) << "no step was run for it";
}

TEST_F(Picking, WhilePausedWhatHangsOnSomethingStaticWaitsForTheRun) {
  pause();
  const auto pointer = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*pointer, 0.45, 1), rig.id("BODY arm"));
  const math::Vec3 before = at("BODY arm");
  pointer->drag({0.3, 1, 1.0});
  ASSERT_TRUE(comes_true([&] { return pick_of(*pointer) != nullptr && pick_of(*pointer)->target_world.z == 1.0; }));
  EXPECT_EQ(at("BODY arm"), before) << "its joint stays whole";
  rig.simulation.set_paused(false);
  ASSERT_TRUE(rig.step(500).success);
  EXPECT_GT(at("BODY arm").z, before.z + 0.05) << "then the spring acts";
}

TEST_F(Picking, EndsWithTheRemovalOfTheBody) {
  const auto pointer = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*pointer, -1, 0), rig.id("BODY left"));
  ASSERT_TRUE(rig.remove("BODY left").success);
  ASSERT_TRUE(rig.step(10).success);
  EXPECT_TRUE(rig.frame().picks.empty());
  pointer->drag({0, 0, 1});
  ASSERT_TRUE(rig.step(10).success);
  ASSERT_EQ(press(*pointer, 1, 0), rig.id("BODY right")) << "and the pointer can hold another";
  EXPECT_EQ(rig.frame().picks.size(), 1U);
}

TEST_F(Picking, EndsWithAResetOfTheBodies) {
  const auto pointer = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*pointer, -1, 0), rig.id("BODY left"));
  pointer->drag({-1, 0, 0.5});
  ASSERT_TRUE(rig.step(500).success);
  rig.simulation.reset_bodies();
  ASSERT_TRUE(rig.step(100).success);
  EXPECT_TRUE(rig.frame().picks.empty());
  EXPECT_NEAR(at("BODY left").z, 0.05, 0.01);
}

TEST_F(Picking, APointerThatIsLetGoBeforeTheRayArrivesHoldsNothing) {
  const auto pointer = rig.simulation.make_pick_port();
  for (int i = 0; i < 200; ++i) {
    pointer->pick({-1, 0, 3}, {-1, 0, 0}, {});
    pointer->release();
  }
  ASSERT_TRUE(rig.step(10).success);
  EXPECT_TRUE(rig.frame().picks.empty());
}

TEST_F(Picking, ALateTargetOfAnEarlierPressMovesNothing) {
  const auto pointer = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*pointer, -1, 0), rig.id("BODY left"));
  pointer->drag({5, 5, 5});  // may not have been looked at yet
  ASSERT_EQ(press(*pointer, 1, 0), rig.id("BODY right"));
  const math::Vec3 before = at("BODY right");
  ASSERT_TRUE(rig.step(50).success);
  EXPECT_LT(math::norm(at("BODY right") - before), 1e-3);
}

TEST_F(Picking, MorePointersThanThereIsRoomForAreRefusedUntilOneGoes) {
  std::vector<std::unique_ptr<state::PickPort>> pointers;
  for (std::size_t i = 0; i < base::kMaxPicks; ++i) {
    pointers.push_back(rig.simulation.make_pick_port());
    ASSERT_NE(pointers.back(), nullptr);
  }
  EXPECT_EQ(rig.simulation.make_pick_port(), nullptr);
  pointers.pop_back();
  const auto again = rig.simulation.make_pick_port();
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(press(*again, -1, 0), rig.id("BODY left"));
}

TEST_F(Picking, AnArmIsDraggedWithoutOpeningItsJoint) {
  const auto pointer = rig.simulation.make_pick_port();
  ASSERT_EQ(press(*pointer, 0.45, 1), rig.id("BODY arm"));
  pointer->drag({0.9, 1, 0.9});  // out of reach
  ASSERT_TRUE(rig.step(1500).success);
  const math::Vec3 hinge = rig.body("BODY arm").T_world_body * math::Vec3{-0.2, 0, 0};
  EXPECT_LT(math::norm(hinge - math::Vec3{0.1, 1, 0.5}), 1e-4);
  EXPECT_GT(at("BODY arm").z, 0.55);
}

}  // namespace
}  // namespace ambf::runtime::test
