// What a Grasp holds stays where it is: without a jolt, without a gap, without a trace after it lets go.
#include <gtest/gtest.h>

#include <array>
#include <cstring>

#include "tests/physics/fixtures.h"

namespace ambf::physics {
namespace {

using namespace testing;

const math::Pose kHere;

WorldOptions weightless() {
  WorldOptions options;
  options.gravity = {};
  return options;
}

// How far the held body has moved in the holder's COM frame since it was made.
class Drift {
 public:
  Drift(const Body& holder, const Body& held) : holder_(holder), held_(held), at_first_(relative()) {}
  double metres() const { return math::norm(relative().position - at_first_.position); }
  double radians() const { return angle_between(at_first_.orientation, relative().orientation); }

 private:
  math::Pose relative() const { return math::inverse(holder_.com_pose()) * held_.com_pose(); }
  const Body &holder_, &held_;
  const math::Pose at_first_;
};

// A hand that a motor lifts, and a load 0.3 m beside it.
struct Lift {
  explicit Lift(double load_mass, double hand_mass = 2.0)
      : hand(parameters(hand_mass, {box(0.1, 0.1, 0.1)}, {0, 0, 0.5})),
        load(parameters(load_mass, {box(0.1, 0.1, 0.1)}, {0.3, 0, 0.5})) {
    for (Body* body : {&post, &hand, &load}) world.add(*body);
    world.add(rail);
    world.add(grasp);
  }
  static scene::Joint vertical() {
    scene::Joint joint;
    joint.type = state::JointType::prismatic;
    joint.max_motor_impulse = 10.0;
    return joint;
  }
  World world;
  Body post{mass_only(0.0, {}, {{0, 0, 0.5}, {}})};
  Body hand, load;
  Joint rail{vertical(), post, hand};
  Grasp grasp;
};

TEST(FixedGrasp, OpensByLessThanAHundredthOfAMillimetreUnderAHeavyLeverArm) {
  Lift lift(20.0);
  lift.rail.set_motor_velocity(0.0);
  ASSERT_TRUE(lift.grasp.hold(lift.hand, lift.load, kHere));
  const Drift drift(lift.hand, lift.load);
  double largest = 0.0, largest_turn = 0.0;
  for (int i = 0; i < 3000; ++i) {
    lift.rail.set_motor_velocity(0.2 * std::sin(0.005 * i));
    lift.world.step();
    largest = std::max(largest, drift.metres());
    largest_turn = std::max(largest_turn, drift.radians());
  }
  EXPECT_LT(largest, 1e-5);
  EXPECT_LT(largest_turn, 1e-5);
  EXPECT_LT(lift.grasp.gap().position, 1e-5);
  EXPECT_NEAR(lift.grasp.reaction_on_held().force.z, 20.0 * 9.8, 20.0) << "what it feels is the load's weight";
}

TEST(FixedGrasp, KeepsMomentumAcrossGraspAndRelease) {
  Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    World world(weightless());
    Body a(mass_only(1.3, {0.02, 0.03, 0.04}, random.pose(0.3))),
        b(mass_only(0.4, {0.004, 0.002, 0.003}, random.pose(0.3)));
    for (Body* body : {&a, &b}) {
      body->set_twist({random.vector(0.5), random.vector(1.0)});
      world.add(*body);
    }
    Grasp grasp;
    world.add(grasp);
    run(world, 0.01);
    const Momentum before = momentum({&a, &b});
    ASSERT_TRUE(grasp.hold(a, b, random.pose(0.1)));
    const Drift drift(a, b);
    run(world, 0.2);
    EXPECT_LT(drift.metres(), 1e-5);
    EXPECT_LT(drift.radians(), 1e-5);
    grasp.release();
    run(world, 0.05);
    const Momentum after = momentum({&a, &b});
    EXPECT_LT(math::norm(after.linear - before.linear), 1e-10) << trial;
    EXPECT_LT(math::norm(after.angular - before.angular), 1e-10) << trial;
  }
}

TEST(FixedGrasp, NeitherGraspNorReleaseMovesWhatRestsOnATable) {
  World world;
  Body table(parameters(0.0, {ground()}, {})), cube(parameters(0.5, {box(0.1, 0.1, 0.1)}, {0, 0, 0.05}));
  Body hand(mass_only(0.0, {}, {{0.1, 0, 0.3}, {}}));
  Grasp grasp;
  for (Body* body : {&table, &cube, &hand}) world.add(*body);
  world.add(grasp);
  run(world, 2.0);
  const math::Pose before = cube.pose();
  ASSERT_TRUE(grasp.hold(hand, cube, kHere));
  run(world, 0.2);
  EXPECT_LT(math::norm(cube.pose().position - before.position), 1e-6);
  grasp.release();
  EXPECT_FALSE(grasp.holds());
  double fastest = 0.0;
  for (int i = 0; i < 200; ++i) {
    world.step();
    fastest = std::max(fastest, math::norm(cube.twist().linear));
  }
  EXPECT_LT(fastest, 1e-3);
  EXPECT_LT(math::norm(cube.pose().position - before.position), 1e-5);
}

// Both grippers hang on motors; one takes the load over from the other.
TEST(FixedGrasp, HandsOverWithoutAStep) {
  Lift lift(1.0);
  Body post(mass_only(0.0, {}, {{0.6, 0, 0.5}, {}})), other(parameters(2.0, {box(0.1, 0.1, 0.1)}, {0.6, 0, 0.5}));
  Joint rail(Lift::vertical(), post, other);
  Grasp second;
  for (Body* body : {&post, &other}) lift.world.add(*body);
  lift.world.add(rail);
  lift.world.add(second);
  lift.rail.set_motor_velocity(0.0);
  rail.set_motor_velocity(0.0);
  ASSERT_TRUE(lift.grasp.hold(lift.hand, lift.load, kHere));
  run(lift.world, 0.1);
  math::Vec3 last = lift.load.pose().position;
  double largest = 0.0;
  for (int i = 0; i < 600; ++i) {
    if (i == 200) {
      ASSERT_TRUE(second.hold(other, lift.load, kHere));
    }
    if (i == 400) lift.grasp.release();
    lift.world.step();
    largest = std::max(largest, math::norm(lift.load.pose().position - last));
    last = lift.load.pose().position;
  }
  EXPECT_LT(largest, 1e-5);
  EXPECT_EQ(second.held(), &lift.load);
  EXPECT_LT(second.gap().position, 1e-5);
}

TEST(FixedGrasp, BringsAnOffsetFrameTogetherAtABoundedSpeed) {
  World world(weightless());
  Body hand(mass_only(0.0, {})), part(mass_only(0.5, {0.001, 0.001, 0.001}, {{0.3, 0.1, 0.0}, math::exp({0, 0, 0.8})}));
  Grasp grasp;
  for (Body* body : {&hand, &part}) world.add(*body);
  world.add(grasp);
  ASSERT_TRUE(grasp.hold(hand, part, {{0, 0, 0.1}, {}}, math::Pose{{0, 0, -0.05}, {}}));
  double fastest = 0.0;
  for (int i = 0; i < 600; ++i) {
    world.step();
    fastest = std::max(fastest, math::norm(part.twist().linear));
  }
  EXPECT_LT(math::norm(part.pose().position - math::Vec3{0, 0, 0.15}), 1e-6);
  EXPECT_LT(angle_between(part.pose().orientation, {}), 1e-6);
  EXPECT_LT(fastest, 6.0);
}

TEST(FixedGrasp, GivesWayBeyondItsImpulseAndTakesBackWhatItLost) {
  GraspOptions weak;
  weak.max_impulse = 0.005;  // 5 N
  World world(weightless());
  Body hand(mass_only(0.0, {})), part(mass_only(0.5, {0.01, 0.01, 0.01}));
  Grasp grasp(weak);
  for (Body* body : {&hand, &part}) world.add(*body);
  world.add(grasp);
  ASSERT_TRUE(grasp.hold(hand, part, kHere));
  const auto pull = [&](double force, int steps) {
    for (int i = 0; i < steps; ++i) {
      part.apply_force({force, 0, 0}, part.com_pose().position);
      world.step();
    }
  };
  pull(4.9, 500);
  EXPECT_LT(grasp.gap().position, 1e-6) << "below its limit it holds";
  pull(6.0, 200);
  EXPECT_NEAR(part.pose().position.x, 0.5 * (6.0 - 5.0) / 0.5 * 0.2 * 0.2, 1e-3) << "beyond it the rest accelerates";
  pull(0.0, 3000);
  EXPECT_LT(grasp.gap().position, 1e-4);
}

TEST(FixedGrasp, HolderAndHeldPassThroughEachOtherOnlyWhileItHolds) {
  World world;
  Body table(parameters(0.0, {box(1, 1, 0.1)}, {0, 0, -0.05})),
      cube(parameters(0.5, {box(0.1, 0.1, 0.1)}, {0, 0, 0.05}));
  Body other(parameters(0.2, {box(0.1, 0.1, 0.1)}, {0, 0, 0.15}));
  Grasp grasp;
  for (Body* body : {&table, &cube, &other}) world.add(*body);
  world.add(grasp);
  run(world, 0.5);
  std::array<Contact, 32> contacts;
  const auto touching = [&](const Body& a, const Body& b) {
    const std::size_t count = world.contacts(contacts);
    for (std::size_t i = 0; i < count; ++i)
      if ((contacts[i].body_a == &a && contacts[i].body_b == &b) ||
          (contacts[i].body_a == &b && contacts[i].body_b == &a))
        return true;
    return false;
  };
  ASSERT_TRUE(touching(table, cube));
  ASSERT_TRUE(grasp.hold(table, cube, kHere));
  run(world, 0.1);
  EXPECT_FALSE(touching(table, cube));
  EXPECT_TRUE(touching(cube, other)) << "all other contacts stay";
  grasp.release();
  run(world, 0.1);
  EXPECT_TRUE(touching(table, cube));
  EXPECT_NEAR(cube.pose().position.z, 0.05, 1e-4);
}

TEST(FixedGrasp, RefusesWhatItCannotHold) {
  World world, elsewhere;
  Body a(mass_only(1.0, {1, 1, 1})), b(mass_only(1.0, {1, 1, 1})), wall(mass_only(0.0, {})), floor(mass_only(0.0, {}));
  Body stranger(mass_only(1.0, {1, 1, 1}));
  Grasp grasp;
  EXPECT_FALSE(grasp.hold(a, b, kHere)) << "in no world";
  for (Body* body : {&a, &b, &wall, &floor}) world.add(*body);
  elsewhere.add(stranger);
  world.add(grasp);
  EXPECT_FALSE(grasp.hold(a, a, kHere));
  EXPECT_FALSE(grasp.hold(wall, floor, kHere));
  EXPECT_FALSE(grasp.hold(a, stranger, kHere));
  EXPECT_TRUE(grasp.hold(a, wall, kHere)) << "a hand may hold on to a wall";
  EXPECT_FALSE(grasp.hold(a, b, kHere)) << "it holds already";
  grasp.release();
  grasp.release();
  EXPECT_TRUE(grasp.hold(a, b, kHere));
}

TEST(FixedGrasp, EndsWithEitherBodyWithAResetAndWithItself) {
  World world;
  Body hand(mass_only(0.0, {}));
  world.add(hand);
  auto grasp = std::make_unique<Grasp>();
  world.add(*grasp);
  for (const bool of_holder : {false, true}) {
    auto part = std::make_unique<Body>(mass_only(1.0, {1, 1, 1}, {{0.2, 0, 0}, {}}));
    world.add(*part);
    ASSERT_TRUE(of_holder ? grasp->hold(*part, hand, kHere) : grasp->hold(hand, *part, kHere));
    run(world, 0.01);
    world.remove(*part);
    EXPECT_FALSE(grasp->holds());
    run(world, 0.01);
  }
  Body part(mass_only(1.0, {1, 1, 1}, {{0.2, 0, 0}, {}}));
  world.add(part);
  ASSERT_TRUE(grasp->hold(hand, part, kHere));
  world.reset();
  EXPECT_FALSE(grasp->holds());
  ASSERT_TRUE(grasp->hold(hand, part, kHere));
  run(world, 0.1);
  EXPECT_NEAR(part.pose().position.z, 0.0, 1e-6);
  grasp.reset();
  run(world, 0.1);
  EXPECT_NEAR(part.pose().position.z, -0.049, 1e-3) << "it falls";
}

TEST(FixedGrasp, IsResumedWithAllThatHangsOnWhatItHolds) {
  World world(weightless());
  Body hand(mass_only(0.0, {})), needle(mass_only(0.5, {1, 1, 1}, {{0.2, 0, 0}, {}}));
  Body thread(mass_only(0.1, {1, 1, 1}, {{0.3, 0, 0}, {}})), wall(mass_only(0.0, {}, {{0.4, 0, 0}, {}}));
  for (Body* body : {&hand, &needle, &thread, &wall}) world.add(*body);
  scene::Joint fixed;
  fixed.type = state::JointType::fixed;
  fixed.parent_pivot = {0.1, 0, 0};
  Joint knot(fixed, needle, thread), anchor(fixed, thread, wall);
  world.add(knot);
  Grasp grasp;
  world.add(grasp);
  ASSERT_FALSE(grasp.current());
  ASSERT_TRUE(grasp.hold(hand, needle, kHere));
  const Hold was = *grasp.current();
  grasp.release();
  const math::Pose turned{{0, 0, 1}, math::exp({0, 0, 1.0})};
  hand.set_pose(turned);
  ASSERT_TRUE(grasp.resume(was));
  EXPECT_LT(math::norm(needle.pose().position - (turned * needle.initial_com_pose()).position), 1e-12);
  EXPECT_LT(math::norm(thread.pose().position - (turned * thread.initial_com_pose()).position), 1e-12);
  run(world, 0.05);
  EXPECT_LT(math::norm(needle.twist().linear) + math::norm(thread.twist().linear), 1e-9) << "nothing pulls";

  grasp.release();
  world.add(anchor);
  EXPECT_FALSE(grasp.resume(was)) << "it cannot follow the hand";
  EXPECT_FALSE(grasp.holds());
  world.remove(anchor);
}

TEST(FixedGrasp, ContinuesBitForBitFromASnapshotInMidGrasp) {
  Lift one(1.0), two(1.0);
  one.rail.set_motor_velocity(0.1);
  run(one.world, 0.05);
  ASSERT_TRUE(one.grasp.hold(one.hand, one.load, {{0.05, 0, 0}, math::exp({0.1, 0.2, 0.3})}));
  run(one.world, 0.3);
  std::vector<std::byte> state;
  one.world.save_state(state);
  ASSERT_TRUE(two.world.restore_state(state));
  EXPECT_EQ(two.grasp.held(), &two.load);
  EXPECT_EQ(two.grasp.reaction_on_held().force, one.grasp.reaction_on_held().force);
  for (int i = 0; i < 500; ++i) {
    if (i == 300) one.grasp.release(), two.grasp.release();
    one.world.step();
    two.world.step();
  }
  EXPECT_EQ(one.load.pose(), two.load.pose());
  EXPECT_EQ(one.hand.pose(), two.hand.pose());
  ASSERT_TRUE(two.world.restore_state(state)) << "into a world in which it holds nothing any more";
  EXPECT_TRUE(two.grasp.holds());
}

// A turning hand holds three loads, in another order than that of their grasps.
TEST(FixedGrasp, GraspsBegunInAnyOrderContinueBitForBitInAFreshWorld) {
  struct Three {
    Three() {
      for (Body* body : {&post, &hand, &a, &b, &c}) world.add(*body);
      world.add(hinge);
      for (Grasp* each : {&of_a, &of_b, &of_c}) world.add(*each);
    }
    static scene::Joint motor() {
      scene::Joint joint;
      joint.type = state::JointType::revolute;
      joint.max_motor_impulse = 10.0;
      return joint;
    }
    World world;
    Body post{mass_only(0.0, {})}, hand{mass_only(2.0, {0.02, 0.03, 0.04})};
    Body a{mass_only(0.7, {0.001, 0.002, 0.003}, {{0.3, 0, 0}, {}})};
    Body b{mass_only(0.4, {0.002, 0.001, 0.003}, {{0, 0.2, 0.1}, {}})};
    Body c{mass_only(0.3, {0.002, 0.003, 0.001}, {{0, -0.1, 0.2}, {}})};
    Joint hinge{motor(), post, hand};
    Grasp of_a, of_b, of_c;
  };
  Three one, fresh;
  ASSERT_TRUE(one.of_c.hold(one.hand, one.c, kHere));
  ASSERT_TRUE(one.of_a.hold(one.hand, one.a, {{0.05, 0, 0}, math::exp({0.1, 0.2, 0.3})}));
  ASSERT_TRUE(one.of_b.hold(one.hand, one.b, kHere));
  for (Three* each : {&one, &fresh}) each->hinge.set_motor_velocity(8.0);
  run(one.world, 0.1);
  std::vector<std::byte> state;
  one.world.save_state(state);
  ASSERT_TRUE(fresh.world.restore_state(state));
  for (int i = 0; i < 300; ++i) {
    if (i == 150) one.of_a.release(), fresh.of_a.release();
    one.world.step();
    fresh.world.step();
    ASSERT_EQ(one.hand.pose(), fresh.hand.pose()) << i;
    ASSERT_EQ(one.c.pose(), fresh.c.pose()) << i;
  }
}

TEST(FixedGrasp, LetsNoDamagedStateIn) {
  Lift lift(1.0);
  ASSERT_TRUE(lift.grasp.hold(lift.hand, lift.load, kHere));
  std::vector<std::byte> state;
  lift.world.save_state(state);
  const StateLayout layout{{true, false, false}, 1, 1, 0.001};
  ASSERT_FALSE(World::check_state(state, layout));
  EXPECT_TRUE(World::check_state(state, {{true, false, false}, 1, 0, 0.001})) << "a world without grasps";
  // A grasp comes last: its number and its bodies, before two frames and its joint.
  Lift empty(1.0);
  std::vector<std::byte> without;
  empty.world.save_state(without);
  for (const std::size_t field : {0u, 1u, 2u}) {
    for (const std::uint64_t wrong : {std::uint64_t{3}, ~std::uint64_t{0}}) {
      std::vector<std::byte> damaged = state;
      std::memcpy(damaged.data() + without.size() + 8 * field, &wrong, sizeof wrong);
      const auto fault = World::check_state(damaged, layout);
      ASSERT_TRUE(fault) << field;
      EXPECT_EQ(fault->of, StateFault::Of::grasp);
    }
  }
}

}  // namespace
}  // namespace ambf::physics
