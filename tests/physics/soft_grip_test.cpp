// Nodes of soft bodies that a body holds (EQUATIONS 16): springs of known hardness, both ways, for any mesh.
#include <gtest/gtest.h>

#include "physics/soft_grip.h"
#include "tests/physics/fixtures.h"
#include "tests/physics/soft_sheet.h"

namespace ambf::physics {
namespace {

using namespace testing;

struct Scene {
  explicit Scene(const SoftDefinition& definition, const math::Vec3& gravity = {0, 0, -9.81})
      : world([&] {
          WorldOptions options;
          options.gravity = gravity;
          return options;
        }()),
        cloth(definition) {
    add(world, cloth);
  }
  ~Scene() { remove(world, cloth); }
  World world;
  SoftBody cloth;
};

std::vector<math::Vec3> positions(const SoftBody& body) {
  std::vector<math::Vec3> all;
  for (std::size_t i = 0; i < body.node_count(); ++i) all.push_back(body.position(i));
  return all;
}

math::Vec3 force_on(const SoftGrip& grip) {
  math::Vec3 sum;
  for (const HeldNode& each : grip.held()) sum += each.force_world;
  return sum;
}

double largest_gap(const SoftGrip& grip) {
  double largest = 0.0;
  for (const HeldNode& each : grip.held())
    largest = std::max(largest, math::norm(grip.target(each) - each.body->position(each.node)));
  return largest;
}

// Everything that steps do with links, contacts, velocities and clusters is still Bullet's.
TEST(SoftGrip, WithoutHardnessChangesNoBitOfHowASoftBodyMoves) {
  SoftDefinition cloth = sheet(8, 0.3);
  cloth.config.kDP = 0.01;
  cloth.config.bending_distance = 2;
  cloth.config.viterations = 2;
  cloth.config.piterations = 3;
  cloth.config.diterations = 1;
  cloth.config.kVCF = 0.5;
  cloth.config.clusters = 4;
  cloth.config.flags = 0x11 | 64;
  cloth.config.kMT = 0.02;
  cloth.fixed = {0};
  cloth.T_world_body = {{-0.15, -0.15, 0.2}, {}};
  const auto moved = [&](bool held) {
    Scene scene(cloth);
    Body ball(parameters(0.0, {sphere(0.1)}, {0, 0, 0.05})), hand(mass_only(1.0, {0.1, 0.1, 0.1}, {{0, 0, 2}, {}}));
    scene.world.add(ball);
    scene.world.add(hand);
    SoftGrip grip({0.0, 0.0});
    if (held) {
      EXPECT_TRUE(grip.hold(hand, scene.cloth, 30));
    }
    run(scene.world, 0.5);
    return positions(scene.cloth);
  };
  EXPECT_EQ(moved(true), moved(false));
}

TEST(SoftGrip, HangsAWeightByItsHardnessWhateverTheMesh) {
  struct Case {
    std::uint32_t nodes;
    int iterations;
  };
  for (const Case& c : {Case{2, 1}, Case{8, 4}, Case{20, 4}})
    for (const double hardness : {100.0, 1000.0, 1e4}) {
      SoftDefinition cloth = sheet(c.nodes, 0.1);
      cloth.mass = 0.2;
      cloth.config.kDP = 0.05;
      cloth.config.piterations = c.iterations;
      cloth.T_world_body = {{0, 0, 1}, math::exp({math::Vec3{0.5 * kPi, 0, 0}})};
      Scene scene(cloth);
      Body hand(mass_only(0.0, {}, {{0, 0, 1.2}, {}}));
      scene.world.add(hand);
      SoftGrip grip({hardness, 1.0});
      const std::size_t node = c.nodes * c.nodes - 1;
      ASSERT_TRUE(grip.hold(hand, scene.cloth, node));
      run(scene.world, 2.0);
      const double weight = 0.2 * 9.81;
      EXPECT_NEAR(force_on(grip).z, weight, 0.03 * weight) << c.nodes << " " << hardness;
      EXPECT_NEAR(largest_gap(grip), weight / hardness, 0.05 * weight / hardness) << c.nodes << " " << hardness;
    }
}

TEST(SoftGrip, FollowsItsHolderAsItTurns) {
  SoftDefinition cloth = sheet(10, 0.1);
  cloth.mass = 0.05;
  cloth.config.kDP = 0.02;
  cloth.T_world_body.position = {0.05, 0, 0};
  Scene scene(cloth, {});
  Body hand(mass_only(0.0, {}));
  scene.world.add(hand);
  SoftGrip grip({5000.0, 2.0});
  for (const std::size_t node : {0U, 1U, 10U}) ASSERT_TRUE(grip.hold(hand, scene.cloth, node));
  for (int i = 1; i <= 1000; ++i) {
    hand.move_to({{}, math::exp({math::Vec3{0, 0, 0.5 * kPi * i / 1000.0}})});
    scene.world.step();
  }
  run(scene.world, 0.5);
  EXPECT_LT(math::norm(scene.cloth.position(0) - math::Vec3{0, 0.05, 0}), 2e-3);
  EXPECT_LT(largest_gap(grip), 2e-3);
}

TEST(SoftGrip, KeepsTheMomentumOfHandAndCloth) {
  SoftDefinition cloth = sheet(6, 0.1);
  cloth.mass = 0.3;
  cloth.config.kDP = 0.0;
  Scene scene(cloth, {});
  BodyDefinition free_hand = mass_only(0.5, {1e-3, 2e-3, 1.5e-3}, {{0.12, 0.05, 0.02}, {}});
  Body hand(free_hand);
  scene.world.add(hand);
  hand.set_twist({{0.3, -0.2, 0.5}, {1.0, 2.0, -1.0}});
  SoftGrip grip({1000.0, 1.0});
  for (const std::size_t node : {5U, 11U, 4U}) ASSERT_TRUE(grip.hold(hand, scene.cloth, node));
  const auto total = [&] {
    Momentum sum = momentum({&hand});
    for (std::size_t i = 0; i < scene.cloth.node_count(); ++i) {
      const math::Vec3 p = scene.cloth.velocity(i) * (0.3 / 36);
      sum.linear += p;
      sum.angular += math::cross(scene.cloth.position(i), p);
    }
    return sum;
  };
  const Momentum before = total();
  for (int i = 0; i < 1000; ++i) scene.world.step();
  const Momentum after = total();
  EXPECT_LT(math::norm(after.linear - before.linear), 1e-6 * math::norm(before.linear));
  EXPECT_LT(math::norm(after.angular - before.angular), 0.01 * math::norm(before.angular));
  EXPECT_LT(math::norm(hand.twist().linear - scene.cloth.velocity(5)), 1.0) << "the cloth goes along";
}

TEST(SoftGrip, NeitherGraspNorReleaseIsAJump) {
  SoftDefinition cloth = sheet(8, 0.1);
  cloth.config.kDP = 0.02;
  cloth.fixed = {0, 7};
  Scene scene(cloth);
  Body hand(mass_only(0.0, {}, {{0, 0, 0.3}, {}}));
  scene.world.add(hand);
  run(scene.world, 1.0);
  const auto speeds = [&] {
    std::vector<math::Vec3> all;
    for (std::size_t i = 0; i < scene.cloth.node_count(); ++i) all.push_back(scene.cloth.velocity(i));
    return all;
  };
  const auto largest_change = [&](const std::vector<math::Vec3>& before) {
    double largest = 0.0;
    const auto after = speeds();
    for (std::size_t i = 0; i < after.size(); ++i) largest = std::max(largest, math::norm(after[i] - before[i]));
    return largest;
  };
  const auto hanging = speeds();
  scene.world.step();
  const double usual = largest_change(hanging);
  SoftGrip grip({1e4, 1.0});
  ASSERT_TRUE(grip.hold(hand, scene.cloth, 60));
  const auto before_grasp = speeds();
  scene.world.step();
  EXPECT_LT(largest_change(before_grasp), 2.0 * usual + 9.81e-3);
  run(scene.world, 0.3);
  const auto before_release = speeds();
  const auto places = positions(scene.cloth);
  grip.release();
  EXPECT_EQ(speeds(), before_release);
  EXPECT_EQ(positions(scene.cloth), places);
  scene.world.step();
  EXPECT_LT(largest_change(before_release), 0.1);
}

// Two stiff hands pull a fine, light cloth apart, further than it stretches.
TEST(SoftGrip, IsStableWhereTwoHandsPullApart) {
  for (const double hardness : {1e3, 1e4}) {
    SoftDefinition cloth = sheet(20, 0.3);
    cloth.mass = 0.1;
    cloth.config.kDP = 0.05;
    cloth.config.piterations = 4;
    cloth.T_world_body.position = {0, 0, 1};
    Scene scene(cloth);
    Body left(mass_only(0.0, {}, {{0, 0, 1}, {}})), right(mass_only(0.0, {}, {{0.3, 0, 1}, {}}));
    scene.world.add(left);
    scene.world.add(right);
    SoftGrip a({hardness, 1.0}), b({hardness, 1.0});
    for (const std::size_t node : {0U, 1U, 20U}) ASSERT_TRUE(a.hold(left, scene.cloth, node));
    for (const std::size_t node : {19U, 18U, 39U}) ASSERT_TRUE(b.hold(right, scene.cloth, node));
    for (int i = 1; i <= 1000; ++i) {
      right.move_to({{0.3 + 5e-5 * i, 0, 1}, {}});
      scene.world.step();
    }
    run(scene.world, 0.5);
    EXPECT_FALSE(scene.cloth.divergence({5.0, 5.0})) << hardness;
    EXPECT_GT(force_on(b).x, 0.5);
    EXPECT_NEAR(force_on(a).x, -force_on(b).x, 0.1 * force_on(b).x) << "one pulls as hard as the other";
    std::vector<math::Vec3> before;
    for (std::size_t i = 0; i < scene.cloth.node_count(); ++i) before.push_back(scene.cloth.velocity(i));
    scene.world.step();
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_LT(math::norm(scene.cloth.velocity(i) - before[i]), 0.05) << "it sinks without trembling " << i;
  }
}

TEST(SoftGrip, HandsOver) {
  SoftDefinition cloth = sheet(10, 0.1);
  cloth.mass = 0.05;
  cloth.config.kDP = 0.02;
  Scene scene(cloth);
  Body left(mass_only(0.0, {}, {{0, 0, 0.1}, {}})), right(mass_only(0.0, {}, {{0.1, 0, 0.1}, {}}));
  scene.world.add(left);
  scene.world.add(right);
  SoftGrip a({2000.0, 1.0}), b({2000.0, 1.0});
  for (const std::size_t node : {0U, 1U, 10U}) ASSERT_TRUE(a.hold(left, scene.cloth, node));
  run(scene.world, 1.0);
  EXPECT_NEAR(force_on(a).z, 0.05 * 9.81, 0.05);
  for (const std::size_t node : {0U, 1U, 10U}) ASSERT_TRUE(b.hold(right, scene.cloth, node)) << "both hold it";
  run(scene.world, 0.5);
  EXPECT_NEAR(force_on(a).z + force_on(b).z, 0.05 * 9.81, 0.05);
  a.release();
  run(scene.world, 1.0);
  EXPECT_NEAR(force_on(b).z, 0.05 * 9.81, 0.05);
  EXPECT_EQ(a.holder(), nullptr);
}

// A gripper of two links on a slide pulls with 20 N at a cloth whose other edge is fixed.
TEST(SoftGrip, IsFeltByTheHandAndOpensNoJoint) {
  SoftDefinition cloth = sheet(12, 0.2);
  cloth.mass = 0.05;
  cloth.config.kDP = 0.03;
  cloth.config.kLST = 1.0;
  cloth.config.piterations = 10;
  for (std::uint32_t i = 0; i < 12; ++i) cloth.fixed.push_back(i);
  Scene scene(cloth, {});
  Body base(mass_only(0.0, {}, {{0.1, 0.2, 0}, {}})), wrist(mass_only(0.3, {1e-4, 1e-4, 1e-4}, {{0.1, 0.23, 0}, {}})),
      finger(mass_only(0.05, {2e-5, 2e-5, 2e-5}, {{0.1, 0.2, 0}, {}}));
  for (Body* body : {&base, &wrist, &finger}) scene.world.add(*body);
  scene::Joint slides;
  slides.type = state::JointType::prismatic;
  slides.parent_axis = slides.child_axis = {0, 1, 0};
  slides.parent_pivot = {0, 0.03, 0};
  scene::Joint hinge;
  hinge.type = state::JointType::revolute;
  hinge.parent_axis = hinge.child_axis = {0, 0, 1};
  hinge.parent_pivot = {0, -0.02, 0};
  hinge.child_pivot = {0, 0.01, 0};
  Joint slide(slides, base, wrist), knuckle(hinge, wrist, finger);
  scene.world.add(slide);
  scene.world.add(knuckle);
  SoftGrip grip({1e4, 1.0});
  for (const std::size_t node : {137U, 138U, 126U}) ASSERT_TRUE(grip.hold(finger, scene.cloth, node));
  double widest = 0.0;
  for (int i = 0; i < 6000; ++i) {
    slide.set_effort(20.0 * std::min(1.0, i / 1000.0));
    scene.world.step();
    for (const Joint* joint : {&slide, &knuckle}) widest = std::max(widest, joint->gap().position);
  }
  EXPECT_NEAR(force_on(grip).y, 20.0, 1.0);
  EXPECT_LT(widest, 1e-5);
  EXPECT_LT(math::norm(wrist.twist().linear), 0.01);
  scene.world.remove(slide);
  scene.world.remove(knuckle);
}

TEST(SoftGrip, EndsWithEitherBodyAndWithResets) {
  SoftDefinition definition = sheet(6, 0.1);
  definition.config.kDP = 0.02;
  Scene scene(definition);
  auto hand = std::make_unique<Body>(mass_only(0.5, {0.01, 0.01, 0.01}, {{0, 0, 0.1}, {}}));
  scene.world.add(*hand);
  auto second = std::make_unique<SoftBody>(definition);
  add(scene.world, *second);
  SoftGrip grip;
  EXPECT_TRUE(grip.hold(*hand, scene.cloth, 0));
  EXPECT_FALSE(grip.hold(*hand, scene.cloth, 0)) << "twice";
  EXPECT_FALSE(grip.hold(*hand, scene.cloth, 36)) << "there is no such node";
  EXPECT_TRUE(grip.hold(*hand, *second, 3));
  run(scene.world, 0.01);
  remove(scene.world, *second);
  second.reset();
  EXPECT_EQ(grip.held().size(), 1U);
  run(scene.world, 0.01);
  scene.cloth.reset();
  EXPECT_EQ(grip.holder(), nullptr);
  EXPECT_TRUE(grip.hold(*hand, scene.cloth, 1));
  scene.world.reset();
  EXPECT_TRUE(grip.held().empty());
  EXPECT_TRUE(grip.hold(*hand, scene.cloth, 1));
  hand->reset();
  EXPECT_TRUE(grip.held().empty());
  EXPECT_TRUE(grip.hold(*hand, scene.cloth, 1));
  scene.world.remove(*hand);
  EXPECT_TRUE(grip.held().empty());
  EXPECT_FALSE(grip.hold(*hand, scene.cloth, 1)) << "it is in no world";
  hand.reset();
  run(scene.world, 0.01);
  {
    Body other(mass_only(0.0, {}, {{0, 0, 0.1}, {}}));
    scene.world.add(other);
    SoftGrip brief;
    EXPECT_TRUE(brief.hold(other, scene.cloth, 1));
  }
  run(scene.world, 0.01);
}

}  // namespace
}  // namespace ambf::physics
